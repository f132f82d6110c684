// Speed only, changes no bit: when discs reach the wall (contact_time.hpp), one at a time, two that
// have just collided, all of them side by side; and, in the same vector, when they leave their
// skins.
//
// Included by one file per vector width, like event_loop.hpp, and under the same rule.
#pragma once

#include "swirl/math/lanes.hpp"
#include "swirl/physics/contact_time.hpp"
#include "swirl/simulation/search/state.hpp"
#include "swirl/simulation/search/verlet_skin.hpp"

namespace swirl {
inline namespace SWIRL_TARGET {

/// Whether discs have held their states for a while, or since this very moment, as after a
/// collision. Then no disc holds a later state, and what is zero in the general formulas is left
/// out: the same bits for less.
enum class Held { for_a_while, since_now };

/// Where the centre of the container is, on a straight leg.
SWIRL_INLINE Flight<double> container_flight(const Leg& leg) {
    return {leg.start, leg.velocity, leg.begin};
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
    return time_of_wall_contact(disc.flight(), state.legs[state.leg],
                                state.container_radius - disc.radius);
}

/// When W discs reach the wall, on a straight leg.
template <int W>
SWIRL_INLINE Lanes<W> wall_times(const EngineState& state, const Flight<Lanes<W>>& flights,
                                 const Lanes<W>& radii) {
    return time_of_wall_contact(flights, in_lanes<W>(container_flight(state.legs[state.leg])),
                                Lanes<W>(state.container_radius) - radii);
}

/// When two discs that have just collided, at time t, reach the wall, on a straight leg.
SWIRL_INLINE Lanes<2> wall_times_from_now(const EngineState& state, const HotDisc& a,
                                          const HotDisc& b, double t) {
    const Flight<double> container = container_flight(state.legs[state.leg]);
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
/// the state the disc holds alone; the second, which decides nothing but when to look for
/// neighbours again, is counted from the moment of asking.
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
    const Leg& leg = state.legs[state.leg];
    const Flight<double> container = container_flight(leg);
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
        const Vec2 origin = state.comoving_frame.position_at(t);
        now[d] = Double2{wall_now, t};
        x[d] = Double2{at_wall_now.x, at.x} - Double2{centre.x, origin.x} - Double2{0.0, skin.X};
        y[d] = Double2{at_wall_now.y, at.y} - Double2{centre.y, origin.y} - Double2{0.0, skin.Y};
        vx[d] = disc.velocity.x - Double2{container.velocity.x, state.comoving_frame.velocity.x};
        vy[d] = disc.velocity.y - Double2{container.velocity.y, state.comoving_frame.velocity.y};
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
        if (leg.turning != 0.0) [[unlikely]]
            leaving[d].wall = wall_time(state, who[d]);
    }
}

}  // namespace SWIRL_TARGET
}  // namespace swirl
