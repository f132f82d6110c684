// A predicted event, and the order of events. The earlier event comes first. Of events at the same
// instant, the one with the smaller first disc comes first, then the one with the smaller second
// disc; the wall counts as the disc itself. So the order does not depend on which disc predicted
// which event.
//
// For the events of one disc this is the order of the partners' numbers, no matter which of the two
// discs comes first in each event. A search among one disc's partners need not compare more.
#pragma once

#include <cstdint>

#include "swirl/math/vec2.hpp"

namespace swirl {

/// As a partner: the sphere begins to roll on the floor. Larger than any disc number.
inline constexpr std::uint32_t the_floor = 0xffffff10u;

/// `disc` collides with `partner`. For the wall `partner` is the disc itself; if a sphere begins to
/// roll it is `the_floor`. At the end of a path segment both are N, the number of discs.
struct PendingEvent {
    double time;
    std::uint32_t disc, partner;

    SWIRL_INLINE constexpr bool is_with_wall() const { return disc == partner; }
    SWIRL_INLINE constexpr std::uint32_t first() const { return disc < partner ? disc : partner; }
    SWIRL_INLINE constexpr std::uint32_t second() const { return disc < partner ? partner : disc; }
};

/// True if event a comes before event b at the same instant.
SWIRL_INLINE constexpr bool is_first_in_order(const PendingEvent& a, const PendingEvent& b) {
    return a.first() < b.first() || (a.first() == b.first() && a.second() < b.second());
}
SWIRL_INLINE constexpr bool precedes(const PendingEvent& a, const PendingEvent& b) {
    return a.time < b.time || (a.time == b.time && is_first_in_order(a, b));
}

}  // namespace swirl
