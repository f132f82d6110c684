// The event loops of all searches for one vector width. One file per width includes this header.
#pragma once

#include "swirl/engine/event_loop.hpp"
#include "swirl/engine/neighbors/all_pairs.hpp"
#include "swirl/engine/neighbors/few_spheres.hpp"
#include "swirl/engine/neighbors/linked_cells.hpp"
#include "swirl/engine/neighbors/many_spheres.hpp"
#include "swirl/engine/neighbors/verlet_lists.hpp"

namespace swirl {
inline namespace SWIRL_TARGET {

/// The packing fractions up to which all pairs are tested, for up to 8, 16, 24, 32 and 40 discs.
struct PackingLimits {
    double up_to[max_discs_in_columns / 8];
};

/// The loop for n discs is compiled for the next multiple of eight.
template <bool every_size>
constexpr EventLoops event_loops(const char* width, const PackingLimits& limits) {
    const auto& [p8, p16, p24, p32, p40] = limits.up_to;
#if defined(SWIRL_INTERNAL_CHECKS)
    // The largest size serves all: the sanitizers compile each for a minute.
    const EventLoop all_pairs = event_loop<AllPairs<max_discs_in_columns / 8>>(width);
    const EventLoop few_spheres = event_loop<FewSpheres<max_spheres_in_columns / 8>>(width);
    return {event_loop<VerletLists>(width),
            event_loop<LinkedCells>(width),
            {all_pairs, all_pairs, all_pairs, all_pairs, all_pairs},
            {p8, p16, p24, p32, p40},
            {few_spheres, few_spheres, few_spheres, few_spheres},
            event_loop<ManySpheres>(width)};
#else
    // These loops take the compiler longest. The rare processors without AVX2 get every second
    // size.
    return {event_loop<VerletLists>(width),
            event_loop<LinkedCells>(width),
            {event_loop<AllPairs<every_size ? 1 : 2>>(width), event_loop<AllPairs<2>>(width),
             event_loop<AllPairs<every_size ? 3 : 4>>(width), event_loop<AllPairs<4>>(width),
             event_loop<AllPairs<every_size ? 5 : 4>>(width)},
            {p8, p16, p24, p32, p40},
            {event_loop<FewSpheres<every_size ? 2 : 4>>(width), event_loop<FewSpheres<4>>(width),
             event_loop<FewSpheres<every_size ? 6 : 8>>(width), event_loop<FewSpheres<8>>(width)},
            event_loop<ManySpheres>(width)};
#endif
}

}  // namespace SWIRL_TARGET
}  // namespace swirl
