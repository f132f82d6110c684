// The event loops of the browser page, in place of src/swirl/engine/simd/event_loop_baseline.cpp.
// Each is compiled for one size and once: run() calls step() instead of containing it. The page
// loads faster, and every result is the same, because no search and no size changes a trajectory.
#include "swirl/engine/simd/event_loops.hpp"
#include "swirl/math/cpu_width.hpp"

namespace swirl {
inline namespace SWIRL_TARGET {
namespace {

template <NeighborSearch Search>
[[gnu::noinline]] Event step_once(EngineState& shared) {
    return step<Search>(shared);
}

/// As run() in event_loop.hpp.
template <NeighborSearch Search>
void run_by_steps(EngineState& shared, EventSpan& span, std::uint64_t count, std::int64_t periods,
                  double clock) {
    auto& state = static_cast<typename Search::State&>(shared);
    while (span.events < count) {
        const PendingEvent next = next_event<Search>(state);
        if (state.periods > periods || (state.periods == periods && next.time > clock)) return;
        const Event event = step_once<Search>(shared);
        span.discs[span.events++ % EventSpan::capacity] = {event.i, event.j};
        if (event.overlap > span.max_overlap) span.max_overlap = event.overlap;
        if constexpr (CanAskToBeReplaced<Search>)
            if (Search::should_switch_search(state)) return;
    }
}

template <NeighborSearch Search>
constexpr EventLoop loop_of() {
    return {baseline_name, start<Search>, step_once<Search>, run_by_steps<Search>};
}

constexpr EventLoop loop_of_few_discs = loop_of<AllPairs<4>>();
constexpr EventLoop loop_of_few_spheres = loop_of<FewSpheres<max_spheres_in_columns / 8>>();

}  // namespace
}  // namespace SWIRL_TARGET

const EventLoops event_loops_baseline = {
    loop_of<VerletLists>(),
    loop_of<LinkedCells>(),
    {loop_of_few_discs, loop_of_few_discs, loop_of_few_discs, loop_of_few_discs, loop_of_few_discs},
    32,  // discs
    {loop_of_few_spheres, loop_of_few_spheres, loop_of_few_spheres, loop_of_few_spheres},
    loop_of<ManySpheres>()};

}  // namespace swirl
