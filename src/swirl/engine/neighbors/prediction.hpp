// Speed only, changes no bit: what a disc does next. When it meets those it may meet, W of them
// side by side, and which of that, the wall and the end of its skin comes first.
//
// Included by one file per vector width, like event_loop.hpp, and under the same rule.
#pragma once

#include "swirl/engine/neighbors/engine_state.hpp"
#include "swirl/engine/neighbors/wall_times.hpp"
#include "swirl/engine/pending_event.hpp"
#include "swirl/math/lanes.hpp"
#include "swirl/physics/contact_time.hpp"

namespace swirl {
inline namespace SWIRL_TARGET {

/// W discs side by side.
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

/// When `disc` meets W others, asked at time t.
template <Held held, int W>
SWIRL_INLINE Lanes<W> contact_times(const HotDisc& disc, const Others<W>& others, double t) {
    const Flight<Lanes<W>> mine = in_lanes<W>(disc.flight());
    const Lanes<W> sum_of_radii = Lanes<W>(disc.radius) + others.radius;
    if constexpr (held == Held::for_a_while) {
        return time_of_contact(mine, others.flight, sum_of_radii);
    } else {
        const Lanes<W> now(t);
        return now + time_until_contact(others.flight.position_at(now) - mine.position,
                                        others.flight.velocity - mine.velocity, sum_of_radii);
    }
}

/// Disc i has met nobody yet.
SWIRL_INLINE PendingEvent no_meeting(std::uint32_t i) { return {never, i, no_event}; }

/// The first of W contacts, or `first` if that comes before them (pending_event.hpp: the smaller
/// partner comes before).
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

/// The first of W contacts of disc i; never with somebody, if there is none.
template <int W>
SWIRL_INLINE PendingEvent first_meeting(const std::uint32_t* neighbours, const Lanes<W>& contact,
                                        std::uint32_t i) {
    const double time = smallest(contact);
    unsigned equal = lanes_equal(contact, time);
    std::uint32_t partner = neighbours[__builtin_ctz(equal)];
    // Where nobody is met all are equal.
    const bool several = (equal & (equal - 1)) != 0;
    if (several & (time < never)) [[unlikely]] {
        while (equal &= equal - 1) {
            const std::uint32_t other = neighbours[__builtin_ctz(equal)];
            if (other < partner) partner = other;
        }
    }
    return {time, i, partner};
}

/// The first of a disc's first meeting and the wall.
SWIRL_INLINE PendingEvent first_of(const PendingEvent& meeting, double wall_time) {
    const PendingEvent wall{wall_time, meeting.disc, meeting.disc};
    return precedes(wall, meeting) ? wall : meeting;
}
/// The first of these and the end of its skin.
SWIRL_INLINE PendingEvent first_of(const PendingEvent& meeting, const Leaving& leaving) {
    const PendingEvent first = first_of(meeting, leaving.wall);
    return leaving.skin < first.time ? PendingEvent{leaving.skin, first.disc, leaving.mark} : first;
}

/// Writes down a disc's pending event, with its partner's collision counter. When it comes is
/// written where the search looks for the first of all.
SWIRL_INLINE void note_partner(EngineState& state, const PendingEvent& event) {
    ColdDisc& cold = state.cold(event.disc);
    cold.partner = event.partner;
    cold.partner_collisions = state.discs[state.disc_or_nobody(event.partner)].collisions;
}

}  // namespace SWIRL_TARGET
}  // namespace swirl
