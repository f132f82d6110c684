// The event loops of the browser page, in place of src/swirl/engine/simd/event_loop_baseline.cpp.
// Each is compiled for one size and once: run() calls observe() instead of containing a loop. The
// page loads faster, and every result is the same, because no search and no size changes a
// trajectory.
#include "swirl/engine/simd/event_loops.hpp"
#include "swirl/math/cpu_width.hpp"

namespace swirl {
inline namespace SWIRL_TARGET {
namespace {

/// As run() in event_loop.hpp.
template <NeighborSearch Search>
void run_unobserved(EngineState& shared, EventSpan& span, std::uint64_t count, std::int64_t periods,
                    double clock) {
    observe<Search>(shared, nullptr, nullptr, span, count, periods, clock);
}

template <NeighborSearch Search>
constexpr EventLoop loop_of() {
    return {baseline_name, start<Search>, run_unobserved<Search>, observe<Search>};
}

constexpr EventLoop loop_of_few_discs = loop_of<AllPairs<4>>();
constexpr EventLoop loop_of_few_spheres = loop_of<FewSpheres<max_spheres_in_columns / 8>>();

}  // namespace
}  // namespace SWIRL_TARGET

const EventLoops event_loops_baseline = {
    loop_of<VerletLists>(),
    loop_of<LinkedCells>(),
    {loop_of_few_discs, loop_of_few_discs, loop_of_few_discs, loop_of_few_discs, loop_of_few_discs},
    {never, never, never, 0.385, 0.0},  // packing fractions
    {loop_of_few_spheres, loop_of_few_spheres, loop_of_few_spheres, loop_of_few_spheres},
    loop_of<ManySpheres>()};

}  // namespace swirl
