// The loop: take the event that comes first, execute it, predict again for those it changed.
//
// Each disc has one pending event, its earliest (Lubachevsky 1991; Smallenburg 2022). When i and k
// are due to meet, at least one of them, the one that changed last, has seen the other as it is
// now; so the soonest of all meetings is on somebody's card. A card whose partner has changed
// since, `changes` tells, is too early rather than too late: when its time comes, its owner
// predicts again.
//
// Each disc keeps the state it had after its last collision, at its own time, until the next; no
// prediction and no list touches it.
//
// Included by one file per vector width, and compiled with that width's instructions. So that the
// linker cannot mix them up, nothing in here may leave a symbol of its own: functions are inlined
// or static, and a test looks at the objects.
#pragma once

#include "physics/contact_time.hpp"
#include "physics/lanes.hpp"
#include "simulation/event_queue.hpp"
#include "simulation/execution.hpp"
#include "simulation/machine.hpp"
#include "simulation/neighbours.hpp"

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
SWIRL_INLINE Others<W> load_others(const Machine& m, const std::uint32_t* neighbours) {
    const double *flights[W], *times[W];
    for (int k = 0; k < W; ++k) {
        const HotDisc& other = m.discs[neighbours[k]];
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
SWIRL_INLINE Prediction earliest_contact(const Machine& m, const HotDisc& disc,
                                         const std::uint32_t* neighbours, Prediction soonest) {
    const Others<W> others = load_others<W>(m, neighbours);
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

/// The tail of a list that is longer than one vector.
SWIRL_INLINE Prediction earliest_beyond_eight(const Machine& m, std::uint32_t i,
                                              Prediction soonest) {
    const HotDisc& disc = m.discs[i];
    const std::uint32_t* const list = m.plan(i).neighbours();
    for (std::uint32_t k = 8; k < disc.neighbours; k += 4)
        soonest = earliest_contact<4>(m, disc, list + k, soonest);
    return soonest;
}

/// When a disc touches the wall, and when it leaves its neighbourhood; both are circles seen from
/// inside that move with the container. The first follows from the state the disc holds alone; the
/// second, which decides nothing but when to make a list, is counted from the moment t of asking:
/// the disc was perhaps outside the neighbourhood when it last changed.
struct Leaving {
    double wall, neighbourhood;
};
/// Added to the time of the wall, by HotDisc::far_from_wall: a branch would often be mispredicted.
static constexpr double far_wait[2] = {0.0, never};
SWIRL_INLINE Leaving leaving_times(const Machine& m, std::uint32_t i, double t) {
    const HotDisc& disc = m.discs[i];
    const Leg& leg = m.legs[m.leg];
    const Neighbourhood& mine = m.neighbourhoods[i];
    const Flight<double> flight = flight_of(disc);
    const Flight<double> container = container_flight(leg);
    const double now = larger(flight.time, container.time);
    const Vec2 s = flight.position_at(now) - container.position_at(now);
    const Vec2 v = flight.velocity - container.velocity;
    const Vec2 offset = flight.position_at(t) - m.carrier.position_at(t) - Vec2{mine.X, mine.Y};
    const Vec2 stray = flight.velocity - m.carrier.velocity;
    const double clearance = m.container_radius - disc.radius;
    const double freedom = static_cast<double>(mine.freedom) * (1.0 - freedom_margin);
    const BasicVec2<Lanes<2>> from{two_lanes(s.x, offset.x), two_lanes(s.y, offset.y)};
    const BasicVec2<Lanes<2>> velocity{two_lanes(v.x, stray.x), two_lanes(v.y, stray.y)};
    const Lanes<2> wait = time_to_leave(from, velocity, two_lanes(clearance, freedom));
    const double neighbourhood = t + wait.part[0][1];
    if (leg.turning != 0.0) [[unlikely]]
        return {time_of_turning_wall_contact(flight, leg, clearance), neighbourhood};
    return {disc.far_from_wall ? never : now + wait.part[0][0], neighbourhood};
}

/// The same for D discs that have just changed, at time t.
template <int D>
SWIRL_INLINE void leaving_from_now(const Machine& m, const std::uint32_t (&who)[D], double t,
                                   Leaving (&leaving)[D]) {
    const Leg& leg = m.legs[m.leg];
    const Flight<double> container = container_flight(leg);
    const Vec2 centre = container.position_at(t), carried = m.carrier.position_at(t);
    Double2 x[D], y[D], vx[D], vy[D], clearance[D];
    for (int d = 0; d < D; ++d) {
        const HotDisc& disc = m.discs[who[d]];
        const Neighbourhood& mine = m.neighbourhoods[who[d]];
        x[d] = disc.position.x - Double2{centre.x, carried.x} - Double2{0.0, mine.X};
        y[d] = disc.position.y - Double2{centre.y, carried.y} - Double2{0.0, mine.Y};
        vx[d] = disc.velocity.x - Double2{container.velocity.x, m.carrier.velocity.x};
        vy[d] = disc.velocity.y - Double2{container.velocity.y, m.carrier.velocity.y};
        clearance[d] = Double2{m.container_radius - disc.radius,
                               static_cast<double>(mine.freedom) * (1.0 - freedom_margin)};
    }
    const Lanes<2 * D> wait =
        time_to_leave(BasicVec2<Lanes<2 * D>>{beside(x), beside(y)},
                      BasicVec2<Lanes<2 * D>>{beside(vx), beside(vy)}, beside(clearance));
    const Lanes<2 * D> time = Lanes<2 * D>(t) + wait;
    for (int d = 0; d < D; ++d) {
        const HotDisc& disc = m.discs[who[d]];
        leaving[d] = {lane(time, 2 * d) + far_wait[disc.far_from_wall], lane(time, 2 * d + 1)};
        if (leg.turning != 0.0) [[unlikely]]
            leaving[d].wall = time_of_turning_wall_contact(flight_of(disc), leg, clearance[d][0]);
    }
}

/// Writes disc i's earliest event on its card. At equal times a disc comes before the wall exactly
/// if its number is smaller, as in comes_first().
SWIRL_INLINE void write_card(Machine& m, std::uint32_t i, Prediction soonest,
                             const Leaving& leaving) {
    if (leaving.wall < soonest.time || (leaving.wall == soonest.time && i < soonest.partner))
        soonest = {leaving.wall, i};
    if (leaving.neighbourhood < soonest.time)
        soonest = {leaving.neighbourhood, leaves_neighbourhood};
    Plan& plan = m.plan(i);
    plan.partner = soonest.partner;
    plan.partner_changes = soonest.partner < m.size ? m.discs[soonest.partner].changes : 0;
    put_in(m, i, soonest.time);
}

/// Everything that may happen to disc i, which may have held its state for a while.
SWIRL_INLINE void predict(Machine& m, std::uint32_t i, double t) {
    const Prediction soonest =
        earliest_contact<8>(m, m.discs[i], m.plan(i).neighbours(), {never, leaves_neighbourhood});
    write_card(m, i, earliest_beyond_eight(m, i, soonest), leaving_times(m, i, t));
}

/// The same for D discs that have just changed, one step at a time for all of them, so that the
/// processor works on one while it waits for the other.
template <int D>
SWIRL_INLINE void predict_changed(Machine& m, const std::uint32_t (&who)[D], double t) {
    Others<8> others[D];
    Lanes<8> contacts[D];
    Leaving leaving[D];
    for (int d = 0; d < D; ++d) others[d] = load_others<8>(m, m.plan(who[d]).neighbours());
    for (int d = 0; d < D; ++d) contacts[d] = contacts_from_now(m.discs[who[d]], others[d], t);
    leaving_from_now<D>(m, who, t, leaving);
#pragma GCC unroll 2
    for (int d = 0; d < D; ++d) {
        Prediction soonest =
            earlier<8>(m.plan(who[d]).neighbours(), contacts[d], {never, leaves_neighbourhood});
        if (m.discs[who[d]].neighbours > 8) soonest = earliest_beyond_eight(m, who[d], soonest);
        write_card(m, who[d], soonest, leaving[d]);
    }
}

[[gnu::noinline]] static void predict_all(Machine& m, double t) {
    empty_queue(m);
    for (std::uint32_t i = 0; i < m.size; ++i) predict(m, i, t);
}

SWIRL_INLINE FreedomRange freedom_range(const Machine& m) {
    return {0.005 * m.smallest_radius, m.longest_freedom};
}

/// With a freedom this small a list holds only discs that all but touch, for which its capacity is
/// made; each widens again when its disc next leaves.
static void start_narrow(Machine& m, double t) {
    FreedomRange narrow = freedom_range(m);
    narrow.longest = 0.02 * m.smallest_radius;
    narrow.least = 0.001 * m.smallest_radius;
    make_all_neighbourhoods(m, t, narrow);
}

[[gnu::noinline]] static void renew_neighbourhood(Machine& m, std::uint32_t i, double t) {
    ++m.relists;
    const double before = settle(m, i, t);
    if (claim(m, i, t, before, freedom_range(m))) {
        predict(m, i, t);
        return;
    }
    ++m.crowded;
    std::uint32_t settled[256];
    const std::uint32_t count = make_room(m, i, t, freedom_range(m), settled);
    for (std::uint32_t k = 0; k < count; ++k) {
        take_out(m, settled[k]);
        predict(m, settled[k], t);
    }
    if (count > 0) return;
    ++m.overcrowded;
    start_narrow(m, t);
    predict_all(m, t);
}

[[gnu::noinline]] static void start(Machine& m) {
    renew_carrier(m, m.legs[m.leg].position_at(m.clock), m.clock);
    start_narrow(m, m.clock);
    for (std::uint32_t i = 0; i < m.size; ++i) {
        if (claim(m, i, m.clock, settle(m, i, m.clock), freedom_range(m))) continue;
        start_narrow(m, m.clock);
        break;
    }
    predict_all(m, m.clock);
}

/// The container takes its next leg. Only what depends on the container's motion is renewed: wall
/// and neighbourhood. A wall event that now comes later leaves its disc to predict again at the
/// time it held, which is early enough for whatever comes next.
SWIRL_INLINE void renew_leaving(Machine& m, std::uint32_t i, const Leaving& leaving) {
    Plan& plan = m.plan(i);
    const double pending = pending_time(m, i);
    const bool wall_first = leaving.wall <= leaving.neighbourhood;
    const double first = wall_first ? leaving.wall : leaving.neighbourhood;
    if (first < pending || (first == pending && plan.partner >= i)) {
        plan.partner = wall_first ? i : leaves_neighbourhood;
        plan.partner_changes = m.discs[i].changes;
        put_in(m, i, first);
    } else if (plan.partner == i || plan.partner == leaves_neighbourhood) {
        plan.partner = predict_again;
    }
}

/// leaving_times() of the eight discs from `first` on, on a straight leg; all of them hold states
/// from before the leg, so that now is t.
SWIRL_INLINE void renew_eight(Machine& m, std::uint32_t first, double t) {
    const std::uint32_t count = m.size - first < 8 ? m.size - first : 8;
    std::uint32_t who[8];
    alignas(64) double X[8], Y[8], freedom[8];
    for (std::uint32_t k = 0; k < 8; ++k) {
        who[k] = k < count ? first + k : m.size;
        const Neighbourhood& mine = m.neighbourhoods[k < count ? first + k : first];
        X[k] = mine.X;
        Y[k] = mine.Y;
        freedom[k] = static_cast<double>(mine.freedom) * (1.0 - freedom_margin);
    }
    const Others<8> discs = load_others<8>(m, who);
    const Flight<double> container = container_flight(m.legs[m.leg]);
    const auto lanes = [](const Vec2& a) {
        return BasicVec2<Lanes<8>>{Lanes<8>(a.x), Lanes<8>(a.y)};
    };
    const Lanes<8> now(t);
    const BasicVec2<Lanes<8>> at = discs.flight.position_at(now);
    const BasicVec2<Lanes<8>> s = at - lanes(container.position_at(t));
    const BasicVec2<Lanes<8>> v = discs.flight.velocity - lanes(container.velocity);
    const Vec2 carried = m.carrier.position_at(t);
    const BasicVec2<Lanes<8>> offset =
        at - lanes(carried) - BasicVec2<Lanes<8>>{Lanes<8>::load(X), Lanes<8>::load(Y)};
    const BasicVec2<Lanes<8>> stray = discs.flight.velocity - lanes(m.carrier.velocity);
    alignas(64) double wall[8], neighbourhood[8];
    (now + time_to_leave(s, v, Lanes<8>(m.container_radius) - discs.radius)).store(wall);
    (now + time_to_leave(offset, stray, Lanes<8>::load(freedom))).store(neighbourhood);
    const BasicVec2<Lanes<8>> centre = lanes(carried - container.position_at(t)) +
                                       BasicVec2<Lanes<8>>{Lanes<8>::load(X), Lanes<8>::load(Y)};
    alignas(64) double beyond[8];
    beyond_reach(Lanes<8>(reach_far_from_wall(m, t)), centre, Lanes<8>::load(freedom), discs.radius)
        .store(beyond);
    const unsigned far = lanes_below(beyond, 0.0);
    for (std::uint32_t k = 0; k < count; ++k) {
        const unsigned is_far = far >> k & 1u;
        m.discs[first + k].far_from_wall = is_far & 1u;
        renew_leaving(m, first + k, {wall[k] + far_wait[is_far], neighbourhood[k]});
    }
}

[[gnu::noinline]] static Event end_leg(Machine& m) {
    const double end = m.legs[m.leg].end;
    const Vec2 carried = m.carrier.position_at(end);
    const Event event = take_next_leg(m);
    if (m.leg != 0) {
        renew_carrier(m, carried, m.clock);
        if (m.legs[m.leg].turning == 0.0) {
            for (std::uint32_t i = 0; i < m.size; i += 8) renew_eight(m, i, m.clock);
        } else {
            for (std::uint32_t i = 0; i < m.size; ++i)
                renew_leaving(m, i, leaving_times(m, i, m.clock));
        }
        return event;
    }
    const Vec2 drift = carried - m.legs[0].start;
    if (m.cells_per_side > 1 && square_root(dot(drift, drift)) * m.cells_per_length > 1.0) {
        // The cells have been carried off the dish.
        renew_carrier(m, m.legs[0].start, 0.0);
        start_narrow(m, 0.0);
    } else {
        renew_carrier(m, carried, 0.0);
        for (std::uint32_t i = 0; i < m.size; ++i) note_far_from_wall(m, i, 0.0);
    }
    predict_all(m, m.clock);
    return event;
}

/// Whether the disc's card is an event that happens.
SWIRL_INLINE bool is_due(const Machine& m, const Plan& plan) {
    return plan.partner < m.size && m.discs[plan.partner].changes == plan.partner_changes;
}

/// Writes a new card for a disc whose card is no event.
SWIRL_INLINE void renew_card(Machine& m, const Next& next) {
    const bool leaves = m.plan(next.disc).partner == leaves_neighbourhood;
    take_out(m, next.disc);
    if (leaves) {
        renew_neighbourhood(m, next.disc, next.time);
    } else {
        ++m.stale;
        predict(m, next.disc, next.time);
    }
}

/// Brings the cards in order until the first one is an event that happens, and says when.
SWIRL_INLINE Next next_event(Machine& m) {
    for (;;) {
        const Next next = next_pending(m);
        if (next.time >= m.legs[m.leg].end) return {m.legs[m.leg].end, m.size};
        if (is_due(m, m.plan(next.disc))) return next;
        renew_card(m, next);
    }
}

SWIRL_INLINE void take_out_both(Machine& m, std::uint32_t disc, std::uint32_t partner) {
    if (partner != disc) take_out(m, partner);
    take_out(m, disc);
}

/// If several events come at the same instant: their first, in order. The discs of the one that was
/// found have been taken out and are put back; those of the first are taken out.
[[gnu::noinline]] static Next first_of_simultaneous(Machine& m, const Next& found,
                                                    double partner_pending) {
    put_in(m, m.plan(found.disc).partner, partner_pending);
    put_in(m, found.disc, found.time);
    for (;;) {
        const Next next{found.time, first_of_equals(m, found.time, m.levels - 1, 0, m.size)};
        if (is_due(m, m.plan(next.disc))) {
            take_out_both(m, next.disc, m.plan(next.disc).partner);
            return next;
        }
        renew_card(m, next);
    }
}

/// Takes the discs of an event out of the queue.
SWIRL_INLINE Next take_event(Machine& m, const Next& next) {
    const std::uint32_t partner = m.plan(next.disc).partner;
    const double partner_pending = pending_time(m, partner);
    take_out_both(m, next.disc, partner);
    if (next_pending(m).time == next.time) [[unlikely]]
        return first_of_simultaneous(m, next, partner_pending);
    return next;
}

SWIRL_INLINE Event execute(Machine& m, const Next& due) {
    if (due.disc == m.size) return end_leg(m);
    m.clock = due.time;
    const Next next = take_event(m, due);
    const std::uint32_t partner = m.plan(next.disc).partner;
    if (partner == next.disc) {
        const Event event = collide_with_wall(m, partner, next.time);
        predict_changed<1>(m, {partner}, next.time);
        return event;
    }
    if (m.prefetches) prefetch_neighbours(m, partner);
    const std::uint32_t i = next.disc < partner ? next.disc : partner;
    const std::uint32_t j = next.disc < partner ? partner : next.disc;
    const Event event = collide_discs(m, i, j, next.time);
    predict_changed<2>(m, {i, j}, next.time);
    return event;
}

static Event step(Machine& m) { return execute(m, next_event(m)); }

static std::uint64_t run(Machine& m, std::uint64_t count, std::int64_t swirls, double clock) {
    for (std::uint64_t done = 0; done < count; ++done) {
        const Next next = next_event(m);
        if (m.swirls > swirls || (m.swirls == swirls && next.time > clock)) return done;
        execute(m, next);
    }
    return count;
}

}  // namespace SWIRL_TARGET
}  // namespace swirl
