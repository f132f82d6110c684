// Whom a disc may meet: those on its list (verlet_skin.hpp). For the pack, and whatever is as
// dense.
//
// Included by one file per vector width, like event_loop.hpp, and under the same rule.
#pragma once

#include "swirl/math/lanes.hpp"
#include "swirl/physics/contact_time.hpp"
#include "swirl/simulation/resolve.hpp"
#include "swirl/simulation/search/prediction.hpp"
#include "swirl/simulation/search/state.hpp"
#include "swirl/simulation/search/tournament.hpp"
#include "swirl/simulation/search/verlet_skin.hpp"

namespace swirl {
inline namespace SWIRL_TARGET {
namespace lists {

/// The tail of a list that is longer than one vector.
SWIRL_INLINE Prediction earliest_beyond_eight(const Machine& m, std::uint32_t i,
                                              Prediction soonest) {
    const HotDisc& disc = m.discs[i];
    const std::uint32_t* const list = m.plan(i).neighbours();
    for (std::uint32_t k = 8; k < disc.neighbours; k += 4)
        soonest = earliest_contact<4>(m, disc, list + k, soonest);
    return soonest;
}

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
    const double neighbourhood = t + lane(wait, 1);
    if (leg.turning != 0.0) [[unlikely]]
        return {time_of_turning_wall_contact(flight, leg, clearance), neighbourhood};
    return {disc.far_from_wall ? never : now + lane(wait, 0), neighbourhood};
}

/// The same for D discs that have just changed, at time t.
template <int D>
SWIRL_INLINE void leaving_from_now(const Machine& m, const std::uint32_t (&who)[D], double t,
                                   Leaving (&leaving)[D]) {
    const Leg& leg = m.legs[m.leg];
    const Flight<double> container = container_flight(leg);
    const Vec2 centre = container.position_at(t), carried = m.carrier.position_at(t);
    Double2 x[D], y[D], vx[D], vy[D], clearance[D];
#pragma GCC unroll 2
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
#pragma GCC unroll 2
    for (int d = 0; d < D; ++d) {
        const HotDisc& disc = m.discs[who[d]];
        leaving[d] = {lane(time, 2 * d) + far_wait[disc.far_from_wall], lane(time, 2 * d + 1)};
        if (leg.turning != 0.0) [[unlikely]]
            leaving[d].wall = time_of_turning_wall_contact(flight_of(disc), leg, clearance[d][0]);
    }
}

/// Everything that may happen to disc i, which may have held its state for a while.
SWIRL_INLINE void predict(Machine& m, std::uint32_t i, double t) {
    const Prediction soonest =
        earliest_contact<8>(m, m.discs[i], m.plan(i).neighbours(), {never, leaves_place});
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
            earlier<8>(m.plan(who[d]).neighbours(), contacts[d], {never, leaves_place});
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

[[gnu::noinline]] static void renew_place(Machine& m, std::uint32_t i, double t) {
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
    const bool wall_first = leaving.wall <= leaving.place;
    const double first = wall_first ? leaving.wall : leaving.place;
    if (first < pending || (first == pending && plan.partner >= i)) {
        plan.partner = wall_first ? i : leaves_place;
        plan.partner_changes = m.discs[i].changes;
        put_in(m, i, first);
    } else if (plan.partner == i || plan.partner == leaves_place) {
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

}  // namespace lists

/// For event_loop.hpp.
struct Lists {
    SWIRL_INLINE static Event end_leg(Machine& m) { return lists::end_leg(m); }
    SWIRL_INLINE static void predict(Machine& m, std::uint32_t i, double t) {
        lists::predict(m, i, t);
    }
    template <int D>
    SWIRL_INLINE static void predict_changed(Machine& m, const std::uint32_t (&who)[D], double t) {
        lists::predict_changed<D>(m, who, t);
    }
    SWIRL_INLINE static void renew_place(Machine& m, std::uint32_t i, double t) {
        lists::renew_place(m, i, t);
    }
};

}  // namespace SWIRL_TARGET
}  // namespace swirl
