#include "swirl/engine/simd/event_loops.hpp"
#include "swirl/math/cpu_width.hpp"

namespace swirl {
#if defined(SWIRL_FALLBACK)
constexpr EventLoop few = event_loop<FewSpheres<max_spheres_in_columns / 8>>(baseline_name);
const EventLoops event_loops_baseline = {.lists = event_loop<VerletLists>(baseline_name),
                                         .cells = {},
                                         .all_pairs = {},
                                         .all_pairs_up_to_packing = {},
                                         .few_spheres = {few, few, few, few},
                                         .many_spheres = event_loop<ManySpheres>(baseline_name)};
#else
const EventLoops event_loops_baseline =
    event_loops<false>(baseline_name, {{never, never, 0.385, 0.385, 0.0}});
#endif
}  // namespace swirl
