// Search a disc may meet: those on its list (verlet_skin.hpp). For the pack, and whatever is as
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
SWIRL_INLINE Prediction earliest_beyond_eight(const EngineState& state, std::uint32_t i,
                                              Prediction soonest) {
    const HotDisc& disc = state.discs[i];
    const std::uint32_t* const list = state.cold(i).neighbours();
    for (std::uint32_t k = 8; k < disc.neighbours; k += 4)
        soonest = earliest_contact<4>(state, disc, list + k, soonest);
    return soonest;
}

SWIRL_INLINE Leaving leaving_times(const EngineState& state, std::uint32_t i, double t) {
    const HotDisc& disc = state.discs[i];
    const Leg& leg = state.legs[state.leg];
    const Skin& mine = state.skins[i];
    const Flight<double> flight = flight_of(disc);
    const Flight<double> container = container_flight(leg);
    const double now = larger(flight.time, container.time);
    const Vec2 s = flight.position_at(now) - container.position_at(now);
    const Vec2 v = flight.velocity - container.velocity;
    const Vec2 offset =
        flight.position_at(t) - state.comoving_frame.position_at(t) - Vec2{mine.X, mine.Y};
    const Vec2 stray = flight.velocity - state.comoving_frame.velocity;
    const double clearance = state.container_radius - disc.radius;
    const double skin_radius = static_cast<double>(mine.skin_radius) * (1.0 - skin_margin);
    const BasicVec2<Lanes<2>> from{two_lanes(s.x, offset.x), two_lanes(s.y, offset.y)};
    const BasicVec2<Lanes<2>> velocity{two_lanes(v.x, stray.x), two_lanes(v.y, stray.y)};
    const Lanes<2> wait = time_to_leave(from, velocity, two_lanes(clearance, skin_radius));
    const double skin = t + lane(wait, 1);
    if (leg.turning != 0.0) [[unlikely]]
        return {time_of_turning_wall_contact(flight, leg, clearance), skin};
    return {disc.far_from_wall ? never : now + lane(wait, 0), skin};
}

/// The same for D discs that have just changed, at time t.
template <int D>
SWIRL_INLINE void leaving_from_now(const EngineState& state, const std::uint32_t (&who)[D],
                                   double t, Leaving (&leaving)[D]) {
    const Leg& leg = state.legs[state.leg];
    const Flight<double> container = container_flight(leg);
    const Vec2 centre = container.position_at(t), carried = state.comoving_frame.position_at(t);
    Double2 x[D], y[D], vx[D], vy[D], clearance[D];
#pragma GCC unroll 2
    for (int d = 0; d < D; ++d) {
        const HotDisc& disc = state.discs[who[d]];
        const Skin& mine = state.skins[who[d]];
        x[d] = disc.position.x - Double2{centre.x, carried.x} - Double2{0.0, mine.X};
        y[d] = disc.position.y - Double2{centre.y, carried.y} - Double2{0.0, mine.Y};
        vx[d] = disc.velocity.x - Double2{container.velocity.x, state.comoving_frame.velocity.x};
        vy[d] = disc.velocity.y - Double2{container.velocity.y, state.comoving_frame.velocity.y};
        clearance[d] = Double2{state.container_radius - disc.radius,
                               static_cast<double>(mine.skin_radius) * (1.0 - skin_margin)};
    }
    const Lanes<2 * D> wait =
        time_to_leave(BasicVec2<Lanes<2 * D>>{beside(x), beside(y)},
                      BasicVec2<Lanes<2 * D>>{beside(vx), beside(vy)}, beside(clearance));
    const Lanes<2 * D> time = Lanes<2 * D>(t) + wait;
#pragma GCC unroll 2
    for (int d = 0; d < D; ++d) {
        const HotDisc& disc = state.discs[who[d]];
        leaving[d] = {lane(time, 2 * d) + far_wait[disc.far_from_wall], lane(time, 2 * d + 1)};
        if (leg.turning != 0.0) [[unlikely]]
            leaving[d].wall = time_of_turning_wall_contact(flight_of(disc), leg, clearance[d][0]);
    }
}

/// Everything that may happen to disc i, which may have held its state for a while.
SWIRL_INLINE void predict(EngineState& state, std::uint32_t i, double t) {
    const Prediction soonest = earliest_contact<8>(
        state, state.discs[i], state.cold(i).neighbours(), {never, leaves_skin});
    write_card(state, i, earliest_beyond_eight(state, i, soonest), leaving_times(state, i, t));
}

/// The same for D discs that have just changed, one step at a time for all of them, so that the
/// processor works on one while it waits for the other.
template <int D>
SWIRL_INLINE void predict_changed(EngineState& state, const std::uint32_t (&who)[D], double t) {
    Others<8> others[D];
    Lanes<8> contacts[D];
    Leaving leaving[D];
    for (int d = 0; d < D; ++d) others[d] = load_others<8>(state, state.cold(who[d]).neighbours());
    for (int d = 0; d < D; ++d) contacts[d] = contacts_from_now(state.discs[who[d]], others[d], t);
    leaving_from_now<D>(state, who, t, leaving);
#pragma GCC unroll 2
    for (int d = 0; d < D; ++d) {
        Prediction soonest =
            earlier<8>(state.cold(who[d]).neighbours(), contacts[d], {never, leaves_skin});
        if (state.discs[who[d]].neighbours > 8)
            soonest = earliest_beyond_eight(state, who[d], soonest);
        write_card(state, who[d], soonest, leaving[d]);
    }
}

[[gnu::noinline]] static void predict_all(EngineState& state, double t) {
    empty_queue(state);
    for (std::uint32_t i = 0; i < state.size; ++i) predict(state, i, t);
}

SWIRL_INLINE SkinRadiusRange skin_radius_range(const EngineState& state) {
    return {0.005 * state.smallest_radius, state.largest_skin_radius};
}

/// With a skin_radius this small a list holds only discs that all but touch, for which its capacity
/// is made; each widens again when its disc next leaves.
static void rebuild_all_narrow(EngineState& state, double t) {
    SkinRadiusRange narrow = skin_radius_range(state);
    narrow.largest = 0.02 * state.smallest_radius;
    narrow.least = 0.001 * state.smallest_radius;
    rebuild_all_lists(state, t, narrow);
}

[[gnu::noinline]] static void renew_place(EngineState& state, std::uint32_t i, double t) {
    ++state.list_rebuilds;
    const double before = recentre_skin(state, i, t);
    if (build_list(state, i, t, before, skin_radius_range(state))) {
        predict(state, i, t);
        return;
    }
    ++state.overflows;
    std::uint32_t settled[256];
    const std::uint32_t count = resolve_overflow(state, i, t, skin_radius_range(state), settled);
    for (std::uint32_t k = 0; k < count; ++k) {
        take_out(state, settled[k]);
        predict(state, settled[k], t);
    }
    if (count > 0) return;
    ++state.full_rebuilds;
    rebuild_all_narrow(state, t);
    predict_all(state, t);
}

[[gnu::noinline]] static void start(EngineState& state) {
    renew_comoving_frame(state, state.legs[state.leg].position_at(state.clock), state.clock);
    rebuild_all_narrow(state, state.clock);
    for (std::uint32_t i = 0; i < state.size; ++i) {
        if (build_list(state, i, state.clock, recentre_skin(state, i, state.clock),
                       skin_radius_range(state)))
            continue;
        rebuild_all_narrow(state, state.clock);
        break;
    }
    predict_all(state, state.clock);
}

/// The container takes its next leg. Only what depends on the container's motion is renewed: wall
/// and skin. A wall event that now comes later leaves its disc to predict again at the
/// time it held, which is early enough for whatever comes next.
SWIRL_INLINE void renew_leaving(EngineState& state, std::uint32_t i, const Leaving& leaving) {
    ColdDisc& pending = state.cold(i);
    const double due = pending_time(state, i);
    const bool wall_first = leaving.wall <= leaving.skin;
    const double first = wall_first ? leaving.wall : leaving.skin;
    if (first < due || (first == due && pending.partner >= i)) {
        pending.partner = wall_first ? i : leaves_skin;
        pending.partner_collisions = state.discs[i].collisions;
        put_in(state, i, first);
    } else if (pending.partner == i || pending.partner == leaves_skin) {
        pending.partner = no_event;
    }
}

/// leaving_times() of the eight discs from `first` on, on a straight leg; all of them hold states
/// from before the leg, so that now is t.
SWIRL_INLINE void renew_eight(EngineState& state, std::uint32_t first, double t) {
    const std::uint32_t count = state.size - first < 8 ? state.size - first : 8;
    std::uint32_t who[8];
    alignas(64) double X[8], Y[8], skin_radius[8];
    for (std::uint32_t k = 0; k < 8; ++k) {
        who[k] = k < count ? first + k : state.size;
        const Skin& mine = state.skins[k < count ? first + k : first];
        X[k] = mine.X;
        Y[k] = mine.Y;
        skin_radius[k] = static_cast<double>(mine.skin_radius) * (1.0 - skin_margin);
    }
    const Others<8> discs = load_others<8>(state, who);
    const Flight<double> container = container_flight(state.legs[state.leg]);
    const auto lanes = [](const Vec2& a) {
        return BasicVec2<Lanes<8>>{Lanes<8>(a.x), Lanes<8>(a.y)};
    };
    const Lanes<8> now(t);
    const BasicVec2<Lanes<8>> at = discs.flight.position_at(now);
    const BasicVec2<Lanes<8>> s = at - lanes(container.position_at(t));
    const BasicVec2<Lanes<8>> v = discs.flight.velocity - lanes(container.velocity);
    const Vec2 carried = state.comoving_frame.position_at(t);
    const BasicVec2<Lanes<8>> offset =
        at - lanes(carried) - BasicVec2<Lanes<8>>{Lanes<8>::load(X), Lanes<8>::load(Y)};
    const BasicVec2<Lanes<8>> stray = discs.flight.velocity - lanes(state.comoving_frame.velocity);
    alignas(64) double wall[8], skin[8];
    (now + time_to_leave(s, v, Lanes<8>(state.container_radius) - discs.radius)).store(wall);
    (now + time_to_leave(offset, stray, Lanes<8>::load(skin_radius))).store(skin);
    const BasicVec2<Lanes<8>> centre = lanes(carried - container.position_at(t)) +
                                       BasicVec2<Lanes<8>>{Lanes<8>::load(X), Lanes<8>::load(Y)};
    alignas(64) double beyond[8];
    beyond_reach(Lanes<8>(reach_far_from_wall(state, t)), centre, Lanes<8>::load(skin_radius),
                 discs.radius)
        .store(beyond);
    const unsigned far = lanes_below(beyond, 0.0);
    for (std::uint32_t k = 0; k < count; ++k) {
        const unsigned is_far = far >> k & 1u;
        state.discs[first + k].far_from_wall = is_far & 1u;
        renew_leaving(state, first + k, {wall[k] + far_wait[is_far], skin[k]});
    }
}

[[gnu::noinline]] static Event end_leg(EngineState& state) {
    const double end = state.legs[state.leg].end;
    const Vec2 carried = state.comoving_frame.position_at(end);
    const Event event = take_next_leg(state);
    if (state.leg != 0) {
        renew_comoving_frame(state, carried, state.clock);
        if (state.legs[state.leg].turning == 0.0) {
            for (std::uint32_t i = 0; i < state.size; i += 8) renew_eight(state, i, state.clock);
        } else {
            for (std::uint32_t i = 0; i < state.size; ++i)
                renew_leaving(state, i, leaving_times(state, i, state.clock));
        }
        return event;
    }
    const Vec2 drift = carried - state.legs[0].start;
    if (state.cells_per_side > 1 && square_root(dot(drift, drift)) * state.cells_per_length > 1.0) {
        // The cells have been carried off the dish.
        renew_comoving_frame(state, state.legs[0].start, 0.0);
        rebuild_all_narrow(state, 0.0);
    } else {
        renew_comoving_frame(state, carried, 0.0);
        for (std::uint32_t i = 0; i < state.size; ++i) note_far_from_wall(state, i, 0.0);
    }
    predict_all(state, state.clock);
    return event;
}

}  // namespace lists

/// For event_loop.hpp.
struct Lists {
    SWIRL_INLINE static Event end_leg(EngineState& state) { return lists::end_leg(state); }
    SWIRL_INLINE static void predict(EngineState& state, std::uint32_t i, double t) {
        lists::predict(state, i, t);
    }
    template <int D>
    SWIRL_INLINE static void predict_changed(EngineState& state, const std::uint32_t (&who)[D],
                                             double t) {
        lists::predict_changed<D>(state, who, t);
    }
    SWIRL_INLINE static void renew_place(EngineState& state, std::uint32_t i, double t) {
        lists::renew_place(state, i, t);
    }
};

}  // namespace SWIRL_TARGET
}  // namespace swirl
