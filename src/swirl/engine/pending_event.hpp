// What may happen next, and in which order things happen: the earlier first; of events at the same
// instant the one with the smaller first disc, then the one with the smaller second, the wall
// counting as the disc itself. So the order of events does not depend on who found which.
//
// Of the events of one disc that is the order of its partners' numbers, whichever of the two discs
// comes first in each; a search through one disc's partners need compare no more than these.
#pragma once

#include <cstdint>

#include "swirl/math/vec2.hpp"

namespace swirl {

/// In the place of a partner: the sphere no longer slides on the floor. Larger than the number of
/// any disc.
inline constexpr std::uint32_t the_floor = 0xffffff10u;

/// `disc` meets `partner`, or the wall: then `partner` is the disc itself; or it begins to roll.
/// When the leg ends both are N, the number of discs.
struct PendingEvent {
    double time;
    std::uint32_t disc, partner;

    SWIRL_INLINE constexpr bool is_with_wall() const { return disc == partner; }
    SWIRL_INLINE constexpr std::uint32_t first() const { return disc < partner ? disc : partner; }
    SWIRL_INLINE constexpr std::uint32_t second() const { return disc < partner ? partner : disc; }
};

/// Of two events at the same instant.
SWIRL_INLINE constexpr bool is_first_in_order(const PendingEvent& a, const PendingEvent& b) {
    return a.first() < b.first() || (a.first() == b.first() && a.second() < b.second());
}
SWIRL_INLINE constexpr bool precedes(const PendingEvent& a, const PendingEvent& b) {
    return a.time < b.time || (a.time == b.time && is_first_in_order(a, b));
}

}  // namespace swirl
