// The loops for one vector width. Included by one file per width.
#pragma once

#include "swirl/simulation/event_loop.hpp"
#include "swirl/simulation/search/all_pairs.hpp"
#include "swirl/simulation/search/linked_cells.hpp"
#include "swirl/simulation/search/verlet_lists.hpp"

namespace swirl {
inline namespace SWIRL_TARGET {

constexpr EventLoops event_loops(const char* width, std::uint32_t few) {
#if defined(SWIRL_INTERNAL_CHECKS)
    // The longest serves everybody: the sanitizers need a minute to compile each.
    constexpr EventLoop (*loop)(const char*) = all_pairs::loop<SideBySide::most / 8>;
    return {event_loop<Lists>(width, lists::start),
            event_loop<Cells>(width, cells::start),
            {loop(width), loop(width), loop(width), loop(width), loop(width)},
            few};
#else
    return {event_loop<Lists>(width, lists::start),
            event_loop<Cells>(width, cells::start),
            {all_pairs::loop<1>(width), all_pairs::loop<2>(width), all_pairs::loop<3>(width),
             all_pairs::loop<4>(width), all_pairs::loop<5>(width)},
            few};
#endif
}

}  // namespace SWIRL_TARGET
}  // namespace swirl
