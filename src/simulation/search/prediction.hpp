// What a disc does next: whom it meets first, of those it may meet, when it reaches the wall, and
// when it leaves the place where those it may meet were looked up.
//
// Included by one file per vector width, like event_loop.hpp, and under the same rule.
#pragma once

#include "swirl/math/lanes.hpp"
#include "swirl/physics/contact_time.hpp"
#include "swirl/simulation/search/state.hpp"
#include "swirl/simulation/search/tournament.hpp"

namespace swirl {
inline namespace SWIRL_TARGET {

struct Prediction {
    double time;
    std::uint32_t partner;
};

/// W discs of a list, side by side.
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

/// The earliest of W contacts, or `soonest` if that is earlier. Of several at the same instant, the
/// one with the smallest number.
template <int W>
SWIRL_INLINE Prediction earlier(const std::uint32_t* neighbours, const Lanes<W>& contact,
                                Prediction soonest) {
    const double time = smallest(contact);
    if (time > soonest.time || time == never) return soonest;
    unsigned equal = lanes_equal(contact, time);
    std::uint32_t partner = neighbours[__builtin_ctz(equal)];
    while (equal &= equal - 1) {
        const std::uint32_t other = neighbours[__builtin_ctz(equal)];
        if (other < partner) partner = other;
    }
    if (time == soonest.time && soonest.partner < partner) return soonest;
    return {time, partner};
}

/// When `disc` meets W discs of its list.
template <int W>
SWIRL_INLINE Prediction earliest_contact(const EngineState& state, const HotDisc& disc,
                                         const std::uint32_t* neighbours, Prediction soonest) {
    const Others<W> others = load_others<W>(state, neighbours);
    const Flight<Lanes<W>> mine{{Lanes<W>(disc.position.x), Lanes<W>(disc.position.y)},
                                {Lanes<W>(disc.velocity.x), Lanes<W>(disc.velocity.y)},
                                Lanes<W>(disc.time)};
    return earlier<W>(neighbours,
                      time_of_contact(mine, others.flight, Lanes<W>(disc.radius) + others.radius),
                      soonest);
}

/// The same for a disc that holds its state at the very moment t, as none of the others holds a
/// later one: the general formula with a term that is zero left out, and the same bits.
template <int W>
SWIRL_INLINE Lanes<W> contacts_from_now(const HotDisc& disc, const Others<W>& others, double t) {
    const Lanes<W> now(t);
    const BasicVec2<Lanes<W>> at{Lanes<W>(disc.position.x), Lanes<W>(disc.position.y)};
    const BasicVec2<Lanes<W>> velocity{Lanes<W>(disc.velocity.x), Lanes<W>(disc.velocity.y)};
    return now + time_until_contact(others.flight.position_at(now) - at,
                                    others.flight.velocity - velocity,
                                    Lanes<W>(disc.radius) + others.radius);
}

/// When a disc touches the wall, and when it leaves the place where those it may meet were looked
/// up, its skin or its cell. The first follows from the state the disc holds alone; the
/// second, which decides nothing but when to look again, is counted from the moment of asking.
struct Leaving {
    double wall, skin;
    std::uint32_t mark = leaves_skin;  // or by which edge a cell
};
/// Added to the time of the wall, by HotDisc::far_from_wall: a branch would often be mispredicted.
static constexpr double far_wait[2] = {0.0, never};

/// Writes disc i's earliest event on its card. At equal times a disc comes before the wall exactly
/// if its number is smaller, as in comes_first().
SWIRL_INLINE void write_card(EngineState& state, std::uint32_t i, Prediction soonest,
                             const Leaving& leaving) {
    if (leaving.wall < soonest.time || (leaving.wall == soonest.time && i < soonest.partner))
        soonest = {leaving.wall, i};
    if (leaving.skin < soonest.time) soonest = {leaving.skin, leaving.mark};
    ColdDisc& pending = state.cold(i);
    pending.partner = soonest.partner;
    pending.partner_collisions =
        soonest.partner < state.size ? state.discs[soonest.partner].collisions : 0;
    put_in(state, i, soonest.time);
}

}  // namespace SWIRL_TARGET
}  // namespace swirl
