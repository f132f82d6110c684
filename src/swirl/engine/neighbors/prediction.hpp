// Speed only; results stay bitwise identical. What a disc does next: when it collides with the
// discs around it, W of them per vector; and which comes first of that, the wall and the end of its
// skin.
#pragma once

#include "swirl/engine/neighbors/engine_state.hpp"
#include "swirl/engine/neighbors/wall_times.hpp"
#include "swirl/engine/pending_event.hpp"
#include "swirl/math/lanes.hpp"
#include "swirl/physics/contact_time.hpp"

namespace swirl {
inline namespace SWIRL_TARGET {

/// W discs as struct of arrays.
template <int W>
struct Others {
    Flight<Lanes<W>> flight;
    Lanes<W> radius;
};
template <int W>
SWIRL_INLINE Others<W> load_others(const EngineState& state, const std::uint32_t* neighbours) {
    const double *flights[W], *times[W];
    for (int k = 0; k < W; ++k) {
        const HotDisc& other = state.discs[neighbours[k]];
        flights[k] = &other.position.x;
        times[k] = &other.time;
    }
    Lanes<W> columns[4];
    load_fours<W>(flights, columns);
    Others<W> others;
    others.flight.position = {columns[0], columns[1]};
    others.flight.velocity = {columns[2], columns[3]};
    load_pairs<W>(times, others.flight.time, others.radius);
    return others;
}

/// The times when `disc` touches W others, predicted at time t.
template <StateAge age, int W>
SWIRL_INLINE Lanes<W> contact_times(const HotDisc& disc, const Others<W>& others, double t) {
    const Flight<Lanes<W>> mine = in_lanes<W>(disc.flight());
    const Lanes<W> sum_of_radii = Lanes<W>(disc.radius) + others.radius;
    if constexpr (age == StateAge::any) {
        return time_of_contact(mine, others.flight, sum_of_radii);
    } else {
        const Lanes<W> now(t);
        return now + time_until_contact(others.flight.position_at(now) - mine.position,
                                        others.flight.velocity - mine.velocity, sum_of_radii);
    }
}

/// No contact of disc i is known.
SWIRL_INLINE PendingEvent no_contact(std::uint32_t i) { return {never, i, no_event}; }

/// The earliest of W contacts, or `first` if that comes before them. Of simultaneous contacts the
/// one with the smaller partner comes first (pending_event.hpp).
template <int W>
SWIRL_INLINE PendingEvent earlier(const std::uint32_t* neighbours, const Lanes<W>& contact,
                                  const PendingEvent& first) {
    const double time = smallest(contact);
    if (time > first.time || time == never) return first;
    unsigned equal = lanes_equal(contact, time);
    std::uint32_t partner = neighbours[__builtin_ctz(equal)];
    while (equal &= equal - 1) {
        const std::uint32_t other = neighbours[__builtin_ctz(equal)];
        if (other < partner) partner = other;
    }
    if (time == first.time && first.partner < partner) return first;
    return {time, first.disc, partner};
}

/// The earliest of W contacts of disc i. If there is none its time is `never`, its partner
/// arbitrary.
template <int W>
SWIRL_INLINE PendingEvent first_contact(const std::uint32_t* neighbours, const Lanes<W>& contact,
                                        std::uint32_t i) {
    const double time = smallest(contact);
    unsigned equal = lanes_equal(contact, time);
    std::uint32_t partner = neighbours[__builtin_ctz(equal)];
    // Without a contact all lanes are equal.
    const bool several = (equal & (equal - 1)) != 0;
    if (several & (time < never)) [[unlikely]] {
        while (equal &= equal - 1) {
            const std::uint32_t other = neighbours[__builtin_ctz(equal)];
            if (other < partner) partner = other;
        }
    }
    return {time, i, partner};
}

/// The earlier of a disc's first contact and the wall.
SWIRL_INLINE PendingEvent first_of(const PendingEvent& contact, double wall_time) {
    const PendingEvent wall{wall_time, contact.disc, contact.disc};
    return precedes(wall, contact) ? wall : contact;
}
/// The earliest of these and the end of its skin.
SWIRL_INLINE PendingEvent first_of(const PendingEvent& contact, const Leaving& leaving) {
    const PendingEvent first = first_of(contact, leaving.wall);
    return leaving.skin < first.time ? PendingEvent{leaving.skin, first.disc, leaving.mark} : first;
}

/// Stores the partner of a disc's pending event, and the partner's collision counter. The time is
/// stored by the search, where it looks for the earliest event.
SWIRL_INLINE void store_partner(EngineState& state, const PendingEvent& event) {
    ColdDisc& cold = state.cold(event.disc);
    cold.partner = event.partner;
    cold.partner_collisions = state.discs[state.disc_or_sentinel(event.partner)].collisions;
}

}  // namespace SWIRL_TARGET
}  // namespace swirl
