// Speed only, changes no bit: when discs reach the wall (contact_time.hpp), one at a time, two that
// have just collided, all of them side by side; and, in the same vector, when they leave their
// skins.
//
// Included by one file per vector width, like event_loop.hpp, and under the same rule.
#pragma once

#include "swirl/engine/neighbors/engine_state.hpp"
#include "swirl/engine/neighbors/verlet_skin.hpp"
#include "swirl/math/lanes.hpp"
#include "swirl/physics/contact_time.hpp"

namespace swirl {
inline namespace SWIRL_TARGET {

/// Whether discs have held their states for a while, or since this very moment, as after a
/// collision. Then no disc holds a later state, and what is zero in the general formulas is left
/// out: the same bits for less.
enum class Held { for_a_while, since_now };

/// Where the centre of the container is, on a straight leg.
SWIRL_INLINE Flight<double> container_flight(const Segment& segment) {
    return {segment.start, segment.velocity, segment.begin};
}

template <int W>
SWIRL_INLINE BasicVec2<Lanes<W>> in_lanes(const Vec2& a) {
    return {Lanes<W>(a.x), Lanes<W>(a.y)};
}
template <int W>
SWIRL_INLINE Flight<Lanes<W>> in_lanes(const Flight<double>& flight) {
    return {in_lanes<W>(flight.position), in_lanes<W>(flight.velocity), Lanes<W>(flight.time)};
}

/// When disc i reaches the wall, on whatever leg.
SWIRL_INLINE double wall_time(const EngineState& state, std::uint32_t i) {
    const HotDisc& disc = state.discs[i];
    return time_of_wall_contact(disc.flight(), state.segments[state.segment],
                                state.container_radius - disc.radius);
}

// On a turning leg that is some work. A time before which a disc does not reach the wall is had by
// vectors, and mostly something else comes first.

/// The wall of a turning leg as a parabola that it is not nearer than, up to a time h: with g the
/// acceleration and j the jerk of what is at rest, as seen from the centre, which has velocity V, a
/// disc at s with velocity u has
///
///     |s + uτ + gτ²/2 + jτ³/6 …|² ≤ s² + 2 s·u τ + (u² + s·g + h (max(k, 0) + h L)) τ²,   τ ≤ h,
///
/// k = u·g + s·j/3 and L = Ω² (2u² + 8.7 V² + (Ω clearance)²/2)/12, more than a 24th of the fourth
/// derivative in a sixth of a turn; as in contact_time.hpp, where the terms are others.
SWIRL_INLINE void renew_turning_bound(EngineState& state, double t) {
    const Segment& segment = state.segments[state.segment];
    const double O = segment.turning, O2 = O * O, turn = 2.0 * pi / magnitude(O);
    const double speed2 = dot(segment.velocity, segment.velocity);
    TurningBound& bound = state.turning_bound;
    bound.centre = segment.flight_at(t);
    bound.turning = O;
    bound.per_turning = 1.0 / O;
    bound.lasts = turn / 30.0;
    bound.soon = turn / 90.0;
    bound.horizon = state.columns ? turn / 6.0 : turn / 30.0;
    bound.L = O2 * (8.7 / 12.0) * speed2;
    bound.L_of_u2 = O2 * (2.0 / 12.0);
    bound.L_of_square = O2 * O2 * (0.5 / 12.0);
    // Those of places grow with the radius of the path.
    bound.margin = 1e-8 + 1e-12 * square_root(speed2 / O2) / state.container_radius;
}

/// The container at time t, of a turning leg. Several ask within an event.
SWIRL_INLINE const Flight<double>& turning_centre_at(EngineState& state, double t) {
    if (state.turning_centre.time != t)
        state.turning_centre = state.segments[state.segment].flight_at(t);
    return state.turning_centre;
}

/// The container near time t: cosine and sine of a turn by at most π/15, to the eighth and ninth
/// power; what is left out is below (π/15)¹⁰/10! = 5·10⁻¹⁴.
SWIRL_INLINE Flight<double> container_near(EngineState& state, double t) {
    if (!(magnitude(t - state.turning_bound.centre.time) <= state.turning_bound.lasts)) [[unlikely]]
        renew_turning_bound(state, t);
    const TurningBound& bound = state.turning_bound;
    const Vec2 V = bound.centre.velocity, W = perpendicular(V);
    const double phi = (t - bound.centre.time) * bound.turning, q = phi * phi;
    const auto next = [q](double n, double rest) {
        return 1.0 - q * (1.0 / (n * (n + 1.0))) * rest;
    };
    const double sine = phi * next(2.0, next(4.0, next(6.0, next(8.0, 1.0))));
    const double versine = (0.5 * q) * next(3.0, next(5.0, next(7.0, 1.0)));
    return {bound.centre.position + bound.per_turning * (sine * V + versine * W),
            (1.0 - versine) * V + sine * W, t};
}

/// When W discs reach the wall, on a straight leg.
template <int W>
SWIRL_INLINE Lanes<W> wall_times(const EngineState& state, const Flight<Lanes<W>>& flights,
                                 const Lanes<W>& radii) {
    return time_of_wall_contact(flights,
                                in_lanes<W>(container_flight(state.segments[state.segment])),
                                Lanes<W>(state.container_radius) - radii);
}

/// When two discs that have just collided, at time t, reach the wall, on a straight leg.
SWIRL_INLINE Lanes<2> wall_times_from_now(const EngineState& state, const HotDisc& a,
                                          const HotDisc& b, double t) {
    const Flight<double> container = container_flight(state.segments[state.segment]);
    const Vec2 centre = container.position_at(t);
    const auto from = [](const Vec2& p, const Vec2& q, const Vec2& origin) {
        return BasicVec2<Lanes<2>>{two_lanes(p.x, q.x) - Lanes<2>(origin.x),
                                   two_lanes(p.y, q.y) - Lanes<2>(origin.y)};
    };
    return Lanes<2>(t) +
           time_to_leave(from(a.position, b.position, centre),
                         from(a.velocity, b.velocity, container.velocity),
                         Lanes<2>(state.container_radius) - two_lanes(a.radius, b.radius));
}

/// When a disc reaches the wall, and when it leaves its skin or its cell. The first follows from
/// the state the disc holds alone, but on a turning leg is the earliest time possible until it is
/// asked whether that matters; the second, which decides nothing but when to look for neighbours
/// again, is counted from the moment of asking.
struct Leaving {
    double wall, skin;
    std::uint32_t mark = leaves_skin;  // or by which edge a cell
};
/// Added to the time of the wall, by HotDisc::far_from_wall: a branch would often be mispredicted.
static constexpr double far_wait[2] = {0.0, never};

/// For D discs asked at time t. Both are circles to be left from inside, so they are neighbours in
/// one vector, disc after disc.
template <Held held, int D>
SWIRL_INLINE void find_leaving(const EngineState& state, const std::uint32_t (&who)[D], double t,
                               Leaving (&leaving)[D]) {
    const Segment& segment = state.segments[state.segment];
    const Flight<double> container = container_flight(segment);
    Double2 now[D], x[D], y[D], vx[D], vy[D], clearance[D];
#pragma GCC unroll 2
    for (int d = 0; d < D; ++d) {
        const HotDisc& disc = state.discs[who[d]];
        const Skin& skin = state.skins[who[d]];
        const bool just_now = held == Held::since_now;
        const double wall_now = just_now ? t : larger(disc.time, container.time);
        const Vec2 at_wall_now = just_now ? disc.position : disc.flight().position_at(wall_now);
        const Vec2 at = just_now ? disc.position : disc.flight().position_at(t);
        const Vec2 centre = container.position_at(wall_now);
        const Flight<double> skin_flight = state.comoving_frame.flight_of(skin);
        const Vec2 skin_at = skin_flight.position_at(t);
        now[d] = Double2{wall_now, t};
        x[d] = Double2{at_wall_now.x, at.x} - Double2{centre.x, skin_at.x};
        y[d] = Double2{at_wall_now.y, at.y} - Double2{centre.y, skin_at.y};
        vx[d] = disc.velocity.x - Double2{container.velocity.x, skin_flight.velocity.x};
        vy[d] = disc.velocity.y - Double2{container.velocity.y, skin_flight.velocity.y};
        clearance[d] = Double2{state.container_radius - disc.radius, inner_skin_radius(skin)};
    }
    const Lanes<2 * D> wait =
        time_to_leave(BasicVec2<Lanes<2 * D>>{beside(x), beside(y)},
                      BasicVec2<Lanes<2 * D>>{beside(vx), beside(vy)}, beside(clearance));
    const Lanes<2 * D> time = beside(now) + wait;
#pragma GCC unroll 2
    for (int d = 0; d < D; ++d) {
        const bool far = state.discs[who[d]].far_from_wall;
        leaving[d] = {lane(time, 2 * d) + far_wait[far], lane(time, 2 * d + 1)};
    }
}

/// The first time at which W discs may be at a circle which they are inside of. With s their
/// places, v their velocities, the room to it nowhere grows slower than `room` − 2 s·v τ − a τ².
template <int W>
SWIRL_INLINE Lanes<W> wait_for_parabola(const Lanes<W>& a, const Lanes<W>& b,
                                        const Lanes<W>& room) {
    const Lanes<W> zero(0.0), discriminant = b * b + a * room;
    const Lanes<W> root = square_root(larger(discriminant, zero));
    const auto approaching = b > zero;
    const Lanes<W> wait = select(approaching, room, root - b) / select(approaching, b + root, a);
    return select(select(approaching, discriminant, a) > zero, wait, Lanes<W>(never));
}

/// W discs, asked at time t, do not reach the wall of a turning leg before this. The wall is taken
/// to be a little nearer and all to come a little earlier, which is far more than rounding errors
/// (TurningBound::margin).
template <int W>
SWIRL_INLINE Lanes<W> earliest_wall_times(const EngineState& state, const Flight<double>& centre,
                                          const BasicVec2<Lanes<W>>& position,
                                          const BasicVec2<Lanes<W>>& velocity,
                                          const Lanes<W>& radius) {
    const double t = centre.time;
    const TurningBound& bound = state.turning_bound;
    const BasicVec2<Lanes<W>> s = position - in_lanes<W>(centre.position);
    const BasicVec2<Lanes<W>> u = velocity - in_lanes<W>(centre.velocity);
    const BasicVec2<Lanes<W>> g = in_lanes<W>((-bound.turning) * perpendicular(centre.velocity));
    const BasicVec2<Lanes<W>> third_of_j =
        in_lanes<W>((bound.turning * bound.turning * (1.0 / 3.0)) * centre.velocity);
    const Lanes<W> clearance = Lanes<W>(state.container_radius) - radius;
    const Lanes<W> square = clearance * clearance, u2 = dot(u, u), zero(0.0), h(bound.horizon);
    const Lanes<W> k = dot(u, g) + dot(s, third_of_j);
    const Lanes<W> L =
        Lanes<W>(bound.L) + Lanes<W>(bound.L_of_u2) * u2 + Lanes<W>(bound.L_of_square) * square;
    const Lanes<W> a = (u2 + dot(s, g)) + h * (larger(k, zero) + h * L);
    const Lanes<W> room = larger(Lanes<W>(1.0 - bound.margin) * square - dot(s, s), zero);
    return Lanes<W>(t - bound.margin * bound.horizon) +
           Lanes<W>(1.0 - bound.margin) * smaller(wait_for_parabola(a, dot(s, u), room), h);
}

/// When W discs, asked at time t, reach the wall; or, on a turning leg, what they do not reach it
/// before.
template <int W>
SWIRL_INLINE Lanes<W> soonest_wall_times(EngineState& state, const Flight<Lanes<W>>& flights,
                                         const Lanes<W>& radii, double t) {
    if (!state.on_turning_segment()) return wall_times<W>(state, flights, radii);
    return earliest_wall_times<W>(state, container_near(state, t), flights.position_at(Lanes<W>(t)),
                                  flights.velocity, radii);
}

/// Of one disc or two.
template <int D>
SWIRL_INLINE Lanes<2> earliest_wall_times(const EngineState& state, const Flight<double>& centre,
                                          const std::uint32_t (&who)[D]) {
    const double t = centre.time;
    const HotDisc &a = state.discs[who[0]], &b = state.discs[who[D - 1]];
    const Vec2 p = a.flight().position_at(t), q = b.flight().position_at(t);
    return earliest_wall_times<2>(
        state, centre, {two_lanes(p.x, q.x), two_lanes(p.y, q.y)},
        {two_lanes(a.velocity.x, b.velocity.x), two_lanes(a.velocity.y, b.velocity.y)},
        two_lanes(a.radius, b.radius));
}

/// find_leaving on a turning leg: the wall is no parabola, but bounded by one. The second of each
/// pair of lanes is the skin, of which nothing is known to be nearer than it is.
template <int D>
SWIRL_INLINE void find_leaving_on_turn(EngineState& state, const std::uint32_t (&who)[D], double t,
                                       Leaving (&leaving)[D]) {
    // After a collision with the wall it is known.
    const Flight<double> centre =
        D == 1 && state.turning_centre.time == t ? state.turning_centre : container_near(state, t);
    const TurningBound& bound = state.turning_bound;
    Double2 x[D], y[D], vx[D], vy[D], clearance[D];
#pragma GCC unroll 2
    for (int d = 0; d < D; ++d) {
        const HotDisc& disc = state.discs[who[d]];
        const Skin& skin = state.skins[who[d]];
        const Flight<double> skin_flight = state.comoving_frame.flight_of(skin);
        const Vec2 at = disc.flight().position_at(t), skin_at = skin_flight.position_at(t);
        x[d] = at.x - Double2{centre.position.x, skin_at.x};
        y[d] = at.y - Double2{centre.position.y, skin_at.y};
        vx[d] = disc.velocity.x - Double2{centre.velocity.x, skin_flight.velocity.x};
        vy[d] = disc.velocity.y - Double2{centre.velocity.y, skin_flight.velocity.y};
        clearance[d] = Double2{state.container_radius - disc.radius, inner_skin_radius(skin)};
    }
    using Pairs = Lanes<2 * D>;
    const auto both = [](double wall, double skin) {
        Double2 pairs[D];
        for (int d = 0; d < D; ++d) pairs[d] = Double2{wall, skin};
        return beside(pairs);
    };
    const BasicVec2<Pairs> s{beside(x), beside(y)}, u{beside(vx), beside(vy)};
    const Vec2 at_rest = (-bound.turning) * perpendicular(centre.velocity);
    const double third = bound.turning * bound.turning * (1.0 / 3.0);
    const BasicVec2<Pairs> g{both(at_rest.x, 0.0), both(at_rest.y, 0.0)};
    const BasicVec2<Pairs> third_of_j{both(third * centre.velocity.x, 0.0),
                                      both(third * centre.velocity.y, 0.0)};
    const Pairs R = beside(clearance), square = R * R, u2 = dot(u, u), zero(0.0);
    const Pairs k = dot(u, g) + dot(s, third_of_j), h = both(bound.horizon, 0.0);
    const Pairs L = Pairs(bound.L) + Pairs(bound.L_of_u2) * u2 + Pairs(bound.L_of_square) * square;
    const Pairs a = (u2 + dot(s, g)) + h * (larger(k, zero) + h * L);
    const Pairs room =
        larger(both(1.0 - bound.margin, 1.0) * square - dot(s, s), both(0.0, 0x1p-52) * square);
    const Pairs wait = smaller(wait_for_parabola(a, dot(s, u), room), both(bound.horizon, never));
    const Pairs time =
        (Pairs(t) - both(bound.margin * bound.horizon, 0.0)) + both(1.0 - bound.margin, 1.0) * wait;
#pragma GCC unroll 2
    for (int d = 0; d < D; ++d) {
        const bool far = state.discs[who[d]].far_from_wall;
        leaving[d] = {lane(time, 2 * d) + far_wait[far], lane(time, 2 * d + 1)};
    }
}

/// On a turning leg: when disc i reaches the wall, if it does by `latest`. If `known` is how the
/// container was when it collided last, it need not be computed again.
SWIRL_INLINE WallContact seek_wall(const EngineState& state, std::uint32_t i,
                                   const Flight<double>& known, double latest) {
    const HotDisc& disc = state.discs[i];
    const Segment& segment = state.segments[state.segment];
    const double now = beginning_on(segment, disc.flight());
    return turning_wall_contact(disc.flight(), known.time == now ? known : segment.flight_at(now),
                                segment, state.container_radius - disc.radius, latest);
}
/// The same as a time; if it is later, that or never.
[[maybe_unused, gnu::noinline]] static double wall_time_by(const EngineState& state,
                                                           std::uint32_t i, double latest) {
    const WallContact contact = seek_wall(state, i, state.turning_centre, latest);
    return contact.is_later ? never : contact.time;
}
/// The same, asked at time t, where it does not reach the wall before leaving.wall. If that is soon
/// the contact is sought; else the disc is asked again then, as most meet somebody before.
SWIRL_INLINE void approach_wall(const EngineState& state, std::uint32_t i, double t, double latest,
                                Leaving& leaving) {
    if (leaving.wall > latest) return;
    if (leaving.wall - t > state.turning_bound.soon) {
        leaving = {never, leaving.wall, approaches_wall};
        return;
    }
    leaving.wall = wall_time_by(state, i, latest);
}

}  // namespace SWIRL_TARGET
}  // namespace swirl
