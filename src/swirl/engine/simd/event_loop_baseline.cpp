#include "swirl/engine/simd/event_loops.hpp"
#include "swirl/math/cpu_width.hpp"

namespace swirl {
#if defined(SWIRL_FALLBACK)
// Discs run in the loops with partial friction (simulation_storage.cpp).
constexpr EventLoop few = event_loop<FewSpheres<max_spheres_in_columns / 8>>(baseline_name);
const EventLoops event_loops_baseline = {
    {}, {}, {}, 32, {few, few, few, few}, event_loop<ManySpheres>(baseline_name)};
#else
const EventLoops event_loops_baseline = event_loops<32>(baseline_name);
#endif
}  // namespace swirl
