// Speed only; results stay bitwise identical. When discs reach the wall (contact_time.hpp): for one
// disc, for two that have just collided, or for all of them in vectors. Where a disc has a skin,
// the same vector computes when it leaves that.
#pragma once

#include "swirl/engine/neighbors/search_states.hpp"
#include "swirl/engine/neighbors/verlet_skin.hpp"
#include "swirl/math/lanes.hpp"
#include "swirl/physics/contact_time.hpp"

namespace swirl {
inline namespace SWIRL_TARGET {

/// How old the states are that a prediction at time t uses. `any`: they may be older than t. `now`:
/// the predicted disc has its state at t, as after a collision, so no other disc has a later one.
/// Then terms that are zero in the general formulas are omitted. The results are bitwise identical.
enum class StateAge { any, now };

/// Motion of the container's centre on a straight segment.
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

/// When disc i reaches the wall, on any segment.
SWIRL_INLINE double wall_time(const EngineState& state, std::uint32_t i) {
    const HotDisc& disc = state.discs[i];
    return time_of_wall_contact(disc.flight(), state.segments[state.segment],
                                state.container_radius - disc.radius);
}

// On an arc this is expensive. A time before which a disc cannot reach the wall is found by vector
// arithmetic, and usually another event comes first.

/// Prepares that bound. The distance of a disc from the container's centre is bounded by a
/// parabola, up to a time h. Let g and j be the acceleration and jerk of a point at rest, as seen
/// from the centre, which has velocity V. A disc at s with velocity u, both relative to the centre,
/// has
///
///     |s + uτ + gτ²/2 + jτ³/6 …|² ≤ s² + 2 s·u τ + (u² + s·g + h (max(k, 0) + h L)) τ²,   τ ≤ h,
///
/// with k = u·g + s·j/3 and L = Ω² (2u² + 8.7 V² + (Ω clearance)²/2)/12. L exceeds 1/24 of the
/// fourth derivative within a sixth of a turn; contact_time.hpp derives this for slightly other
/// terms.
SWIRL_INLINE void renew_arc_bound(EngineState& state, double t) {
    const Segment& segment = state.segments[state.segment];
    const double O = segment.turn_rate, O2 = O * O, turn = 2.0 * pi / magnitude(O);
    const double speed2 = dot(segment.velocity, segment.velocity);
    ArcBound& bound = state.arc_bound;
    bound.centre = segment.flight_at(t);
    bound.turn_rate = O;
    bound.inverse_turn_rate = 1.0 / O;
    bound.valid_for = turn / 30.0;
    bound.search_at_once = turn / 90.0;
    bound.horizon = turn / state.horizons_per_turn;
    bound.L = O2 * (8.7 / 12.0) * speed2;
    bound.L_of_u2 = O2 * (2.0 / 12.0);
    bound.L_of_square = O2 * O2 * (0.5 / 12.0);
    // Rounding errors of positions grow with the radius of the path.
    bound.margin = 1e-8 + 1e-12 * square_root(speed2 / O2) / state.container_radius;
}

/// The container at time t, on an arc. It is stored, because one event needs it several times.
SWIRL_INLINE const Flight<double>& arc_centre_at(EngineState& state, double t) {
    if (state.arc_centre.time != t) state.arc_centre = state.segments[state.segment].flight_at(t);
    return state.arc_centre;
}

/// The container at a time t near the last renewal of the bound: cosine and sine of an angle of at
/// most π/15, as series up to the eighth and ninth power. The error is below (π/15)¹⁰/10! =
/// 5·10⁻¹⁴.
SWIRL_INLINE Flight<double> container_near(EngineState& state, double t) {
    if (!(magnitude(t - state.arc_bound.centre.time) <= state.arc_bound.valid_for)) [[unlikely]]
        renew_arc_bound(state, t);
    const ArcBound& bound = state.arc_bound;
    const Vec2 V = bound.centre.velocity, W = perpendicular(V);
    const double phi = (t - bound.centre.time) * bound.turn_rate, q = phi * phi;
    const auto next = [q](double n, double rest) {
        return 1.0 - q * (1.0 / (n * (n + 1.0))) * rest;
    };
    const double sine = phi * next(2.0, next(4.0, next(6.0, next(8.0, 1.0))));
    const double versine = (0.5 * q) * next(3.0, next(5.0, next(7.0, 1.0)));
    return {bound.centre.position + bound.inverse_turn_rate * (sine * V + versine * W),
            (1.0 - versine) * V + sine * W, t};
}

/// When W discs reach the wall, on a straight segment.
template <int W>
SWIRL_INLINE Lanes<W> wall_times(const EngineState& state, const Flight<Lanes<W>>& flights,
                                 const Lanes<W>& radii) {
    return time_of_wall_contact(flights,
                                in_lanes<W>(container_flight(state.segments[state.segment])),
                                Lanes<W>(state.container_radius) - radii);
}

/// When two discs that have just collided, at time t, reach the wall, on a straight segment.
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

/// When a disc reaches the wall, and when it leaves its skin or cell. `wall` depends only on the
/// disc's stored state; on an arc it may be a lower bound, which is refined if it matters. `skin`
/// only decides when to look for neighbours again; it is computed from the position at the
/// prediction.
struct Leaving {
    double wall, skin;
    std::uint32_t mark = leaves_skin;  // edge of the cell
};
/// Added to the wall's time, by HotDisc::far_from_wall: a branch would often be mispredicted.
static constexpr double far_wait[2] = {0.0, never};

/// For D discs, predicted at time t. Wall and skin are both circles that a disc leaves from inside,
/// so both times are computed in one vector, disc after disc.
template <StateAge age, int D>
SWIRL_INLINE void find_leaving(const VerletListsState& state, const std::uint32_t (&ids)[D],
                               double t, Leaving (&leaving)[D]) {
    const Segment& segment = state.segments[state.segment];
    const Flight<double> container = container_flight(segment);
    Double2 now[D], x[D], y[D], vx[D], vy[D], clearance[D];
#pragma GCC unroll 2
    for (int d = 0; d < D; ++d) {
        const HotDisc& disc = state.discs[ids[d]];
        const Skin& skin = state.skins[ids[d]];
        const bool just_now = age == StateAge::now;
        const double wall_now = just_now ? t : larger(disc.time, container.time);
        const Vec2 at_wall_now = just_now ? disc.position : disc.flight().position_at(wall_now);
        const Vec2 at = just_now ? disc.position : disc.flight().position_at(t);
        const Vec2 centre = container.position_at(wall_now);
        const Flight<double> skin_flight = state.comoving_frame.flight_of(skin.centre());
        const Vec2 skin_at = skin_flight.position_at(t);
        now[d] = Double2{wall_now, t};
        x[d] = Double2{at_wall_now.x, at.x} - Double2{centre.x, skin_at.x};
        y[d] = Double2{at_wall_now.y, at.y} - Double2{centre.y, skin_at.y};
        vx[d] = disc.velocity.x - Double2{container.velocity.x, skin_flight.velocity.x};
        vy[d] = disc.velocity.y - Double2{container.velocity.y, skin_flight.velocity.y};
        clearance[d] = Double2{state.container_radius - disc.radius, inner_skin_radius(skin)};
    }
    const Lanes<2 * D> wait =
        time_to_leave(BasicVec2<Lanes<2 * D>>{joined(x), joined(y)},
                      BasicVec2<Lanes<2 * D>>{joined(vx), joined(vy)}, joined(clearance));
    const Lanes<2 * D> time = joined(now) + wait;
#pragma GCC unroll 2
    for (int d = 0; d < D; ++d) {
        const bool far = state.discs[ids[d]].far_from_wall;
        leaving[d] = {lane(time, 2 * d) + far_wait[far], lane(time, 2 * d + 1)};
    }
}

/// The earliest time at which W discs inside a circle can reach it. Let s be their positions and v
/// their velocities. `slack` is (radius² − s²), and τ later it is at least slack − 2 s·v τ − a τ².
template <int W>
SWIRL_INLINE Lanes<W> wait_for_parabola(const Lanes<W>& a, const Lanes<W>& b,
                                        const Lanes<W>& slack) {
    const Lanes<W> zero(0.0), discriminant = b * b + a * slack;
    const Lanes<W> root = square_root(larger(discriminant, zero));
    const auto approaching = b > zero;
    const Lanes<W> wait = select(approaching, slack, root - b) / select(approaching, b + root, a);
    return select(select(approaching, discriminant, a) > zero, wait, Lanes<W>(never));
}

/// The same for the parabola that bounds the wall on an arc (renew_arc_bound). `g` and `third_of_j`
/// are the acceleration and a third of the jerk, `h` the horizon, `square` is clearance². In lanes
/// where these three are zero the parabola is exact.
template <int W>
SWIRL_INLINE Lanes<W> wait_on_arc(const ArcBound& bound, const BasicVec2<Lanes<W>>& s,
                                  const BasicVec2<Lanes<W>>& u, const BasicVec2<Lanes<W>>& g,
                                  const BasicVec2<Lanes<W>>& third_of_j, const Lanes<W>& h,
                                  const Lanes<W>& square, const Lanes<W>& slack) {
    const Lanes<W> u2 = dot(u, u), zero(0.0);
    const Lanes<W> k = dot(u, g) + dot(s, third_of_j);
    const Lanes<W> L =
        Lanes<W>(bound.L) + Lanes<W>(bound.L_of_u2) * u2 + Lanes<W>(bound.L_of_square) * square;
    const Lanes<W> a = (u2 + dot(s, g)) + h * (larger(k, zero) + h * L);
    return wait_for_parabola(a, dot(s, u), slack);
}

/// W discs do not reach the wall of an arc before these times, predicted at time t. The bound takes
/// the wall a little nearer, and all times a little earlier, by far more than rounding errors
/// (ArcBound::margin).
template <int W>
SWIRL_INLINE Lanes<W> earliest_wall_times(const EngineState& state, const Flight<double>& centre,
                                          const BasicVec2<Lanes<W>>& position,
                                          const BasicVec2<Lanes<W>>& velocity,
                                          const Lanes<W>& radius) {
    const double t = centre.time;
    const ArcBound& bound = state.arc_bound;
    const BasicVec2<Lanes<W>> s = position - in_lanes<W>(centre.position);
    const BasicVec2<Lanes<W>> u = velocity - in_lanes<W>(centre.velocity);
    const BasicVec2<Lanes<W>> g = in_lanes<W>((-bound.turn_rate) * perpendicular(centre.velocity));
    const BasicVec2<Lanes<W>> third_of_j =
        in_lanes<W>((bound.turn_rate * bound.turn_rate * (1.0 / 3.0)) * centre.velocity);
    const Lanes<W> clearance = Lanes<W>(state.container_radius) - radius;
    const Lanes<W> square = clearance * clearance, h(bound.horizon);
    const Lanes<W> slack = larger(Lanes<W>(1.0 - bound.margin) * square - dot(s, s), Lanes<W>(0.0));
    const Lanes<W> wait = smaller(wait_on_arc(bound, s, u, g, third_of_j, h, square, slack), h);
    return Lanes<W>(t - bound.margin * bound.horizon) + Lanes<W>(1.0 - bound.margin) * wait;
}

/// When W discs reach the wall, predicted at time t. On an arc it is a lower bound.
template <int W>
SWIRL_INLINE Lanes<W> soonest_wall_times(EngineState& state, const Flight<Lanes<W>>& flights,
                                         const Lanes<W>& radii, double t) {
    if (!state.on_arc()) return wall_times<W>(state, flights, radii);
    return earliest_wall_times<W>(state, container_near(state, t), flights.position_at(Lanes<W>(t)),
                                  flights.velocity, radii);
}

/// The same bound for one disc or two.
template <int D>
SWIRL_INLINE Lanes<2> earliest_wall_times(const EngineState& state, const Flight<double>& centre,
                                          const std::uint32_t (&ids)[D]) {
    const double t = centre.time;
    const HotDisc &a = state.discs[ids[0]], &b = state.discs[ids[D - 1]];
    const Vec2 p = a.flight().position_at(t), q = b.flight().position_at(t);
    return earliest_wall_times<2>(
        state, centre, {two_lanes(p.x, q.x), two_lanes(p.y, q.y)},
        {two_lanes(a.velocity.x, b.velocity.x), two_lanes(a.velocity.y, b.velocity.y)},
        two_lanes(a.radius, b.radius));
}

/// find_leaving on an arc, where a parabola bounds the motion of the wall. The second of each pair
/// of lanes is the skin; its time is exact, so its terms for the bound are zero.
template <int D>
SWIRL_INLINE void find_leaving_on_arc(VerletListsState& state, const std::uint32_t (&ids)[D],
                                      double t, Leaving (&leaving)[D]) {
    // After a wall contact at this time the exact centre is known.
    const Flight<double> centre =
        D == 1 && state.arc_centre.time == t ? state.arc_centre : container_near(state, t);
    const ArcBound& bound = state.arc_bound;
    Double2 x[D], y[D], vx[D], vy[D], clearance[D];
#pragma GCC unroll 2
    for (int d = 0; d < D; ++d) {
        const HotDisc& disc = state.discs[ids[d]];
        const Skin& skin = state.skins[ids[d]];
        const Flight<double> skin_flight = state.comoving_frame.flight_of(skin.centre());
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
        return joined(pairs);
    };
    const BasicVec2<Pairs> s{joined(x), joined(y)}, u{joined(vx), joined(vy)};
    const Vec2 at_rest = (-bound.turn_rate) * perpendicular(centre.velocity);
    const double third = bound.turn_rate * bound.turn_rate * (1.0 / 3.0);
    const BasicVec2<Pairs> g{both(at_rest.x, 0.0), both(at_rest.y, 0.0)};
    const BasicVec2<Pairs> third_of_j{both(third * centre.velocity.x, 0.0),
                                      both(third * centre.velocity.y, 0.0)};
    const Pairs R = joined(clearance), square = R * R, h = both(bound.horizon, 0.0);
    const Pairs slack =
        larger(both(1.0 - bound.margin, 1.0) * square - dot(s, s), both(0.0, 0x1p-52) * square);
    const Pairs wait = smaller(wait_on_arc(bound, s, u, g, third_of_j, h, square, slack),
                               both(bound.horizon, never));
    const Pairs time =
        (Pairs(t) - both(bound.margin * bound.horizon, 0.0)) + both(1.0 - bound.margin, 1.0) * wait;
#pragma GCC unroll 2
    for (int d = 0; d < D; ++d) {
        const bool far = state.discs[ids[d]].far_from_wall;
        leaving[d] = {lane(time, 2 * d) + far_wait[far], lane(time, 2 * d + 1)};
    }
}

/// On an arc: the contact of disc i with the wall, if it comes by the time `latest`. `known` may be
/// the container at the disc's last collision; then it is not computed again.
SWIRL_INLINE WallContact seek_wall(const EngineState& state, std::uint32_t i,
                                   const Flight<double>& known, double latest) {
    const HotDisc& disc = state.discs[i];
    const Segment& segment = state.segments[state.segment];
    const double now = beginning_on(segment, disc.flight());
    return arc_wall_contact(disc.flight(), known.time == now ? known : segment.flight_at(now),
                            segment, state.container_radius - disc.radius, latest);
}
/// The time of this contact; `never` if it is later than `latest`.
[[maybe_unused, gnu::noinline]] static double wall_time_by(const EngineState& state,
                                                           std::uint32_t i, double latest) {
    const WallContact contact = seek_wall(state, i, state.arc_centre, latest);
    return contact.is_later ? never : contact.time;
}
/// On an arc disc i does not reach the wall before leaving.wall, as predicted at time t. If that is
/// soon, computes the contact. Otherwise the disc is predicted again at that time, because most
/// discs collide with another disc before.
SWIRL_INLINE void approach_wall(const EngineState& state, std::uint32_t i, double t, double latest,
                                Leaving& leaving) {
    if (leaving.wall > latest) return;
    if (leaving.wall - t > state.arc_bound.search_at_once) {
        leaving = {never, leaving.wall, approaches_wall};
        return;
    }
    leaving.wall = wall_time_by(state, i, latest);
}

}  // namespace SWIRL_TARGET
}  // namespace swirl
