// The loops for one vector width. Included by one file per width.
#pragma once

#include "swirl/engine/event_loop.hpp"
#include "swirl/engine/neighbors/all_pairs.hpp"
#include "swirl/engine/neighbors/few_spheres.hpp"
#include "swirl/engine/neighbors/linked_cells.hpp"
#include "swirl/engine/neighbors/many_spheres.hpp"
#include "swirl/engine/neighbors/verlet_lists.hpp"

namespace swirl {
inline namespace SWIRL_TARGET {

/// All pairs up to `few` discs; the loop for n discs is compiled for the next multiple of eight.
template <std::uint32_t few>
constexpr EventLoops event_loops(const char* width) {
#if defined(SWIRL_INTERNAL_CHECKS)
    // The longest serves everybody: the sanitizers need a minute to compile each.
    const EventLoop all_pairs = event_loop<AllPairs<Columns::maximum / 8>>(width);
    const EventLoop few_spheres = event_loop<FewSpheres<SphereColumns::maximum / 8>>(width);
    return {event_loop<VerletLists>(width),
            event_loop<LinkedCells>(width),
            {all_pairs, all_pairs, all_pairs, all_pairs, all_pairs},
            few,
            {few_spheres, few_spheres, few_spheres, few_spheres},
            event_loop<ManySpheres>(width)};
#else
    // Where there is no AVX2, which is nearly nowhere, every second size does: these loops take the
    // compiler longest.
    constexpr bool every_size = few > 32;
    return {event_loop<VerletLists>(width),
            event_loop<LinkedCells>(width),
            {event_loop<AllPairs<every_size ? 1 : 2>>(width), event_loop<AllPairs<2>>(width),
             event_loop<AllPairs<every_size ? 3 : 4>>(width), event_loop<AllPairs<4>>(width),
             event_loop<AllPairs<every_size ? 5 : 4>>(width)},
            few,
            {event_loop<FewSpheres<every_size ? 2 : 4>>(width), event_loop<FewSpheres<4>>(width),
             event_loop<FewSpheres<every_size ? 6 : 8>>(width), event_loop<FewSpheres<8>>(width)},
            event_loop<ManySpheres>(width)};
#endif
}

}  // namespace SWIRL_TARGET
}  // namespace swirl
