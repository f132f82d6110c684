// Friction against the floor: spheres that roll and slide on the container's floor, and coins that
// slide on it. (The paper's experiment has spheres; its simulation has discs without friction
// against the floor.) The floor moves with the velocity u of the container and does not rotate.
//
//        ___            The sphere touches the floor at −R ẑ, where it slips with the velocity
//      /  ω  \              c = v − u + ω × (−R ẑ) = v − u − R ω × ẑ
//     |   ·→ v|               = (v_x − u_x − R ω_y,  v_y − u_y + R ω_x).
//   ___\_____/___ →u    It presses on the floor with m g.
//
// Sliding, |c| > 0: the friction force is −μ_f m g ĉ, its torque (−R ẑ) × (−μ_f m g ĉ), so
//     dv/dt = −μ_f g ĉ =: a,      dω/dt = (μ_f m g R / I) ẑ × ĉ = (m R / I) (a_y, −a_x),
//     dc/dt = a − R (dω/dt) × ẑ = −μ_f g (1 + m R²/I) ĉ.
// While the floor's velocity is constant, ĉ is constant, too. The centre moves along a parabola
// until c is 0, after t = |c| / (μ_f g (1 + m R²/I)); that is 2|c| / (7 μ_f g) for a solid sphere.
//
// Rolling, c = 0: no friction is needed, so the sphere continues to roll uniformly.
//
// End of a path segment: u jumps by Δu, and c by −Δu. A sphere that rolled slides for a moment.
// When it rolls again it has gained
//     Δv = Δu / (1 + m R²/I), that is 2/7 Δu for a solid sphere.
// The floor does not act on ω_z: the contact is a point without a lever arm.
//
// Rolling resistance is a torque μ_r m g R against the rolling. Let w = v − u be the velocity of
// rolling. The floor's friction f and this torque slow it down together: m dw/dt = −f and
// I dω/dt = f R − μ_r m g R with w = ω R, so
//     dw/dt = −μ_r g / (1 + I/(m R²)) ŵ,    5/7 μ_r g for a solid sphere,
// until it rests on the floor, after |w| divided by that rate. Then it moves with the floor. The
// force on the floor is below μ_f m g if μ_r ≤ μ_f, which is required, so the sphere does not
// slide. While a sphere slides this torque is neglected. It is along ω, not along c, and would turn
// ĉ; its ratio to the torque of sliding is μ_r/μ_f.
//
// A coin is a disc that lies flat on the floor, without a lever arm that could turn it over. It
// slips with c = v − u, so everything is as above without rotation: dc/dt = −μ_f g ĉ. It stops
// on the floor, v = u, after |c| / (μ_f g). This is the same kind of event as for a sphere
// that begins to roll. Then the coin moves with the floor until the segment ends. The floor's
// effect on the spin of a coin is neglected. (Friction also acts at its rim, and hinders sliding
// less while the coin spins.)
//
// Limits: one coefficient for sliding and sticking; rolling resistance only while a sphere rolls;
// no resistance to pivoting; the floor's velocity must not turn while a sphere slides, so the path
// must be a polygon, not the exact circle. Without a floor (μ_f g = 0) a sphere moves as a disc
// does.
#pragma once

#include "swirl/math/by_name.hpp"
#include "swirl/math/real.hpp"
#include "swirl/math/vec2.hpp"
#include "swirl/physics/disc.hpp"

namespace swirl {

/// The shape of the particles. A disc has one spin and no floor; a sphere has three spins; a coin
/// is a disc on a floor.
enum class Shape : unsigned char { disc, sphere, coin };

/// Moments of inertia of spheres.
inline constexpr double solid_sphere_inertia(double mass, double radius) {
    return 0.4 * mass * radius * radius;
}
inline constexpr double shell_inertia(double mass, double radius) {
    return mass * radius * radius / 1.5;
}

struct Floor {
    [[no_unique_address]] ByName by_name{};
    double deceleration = 0.0;        // μ_f g, while sliding without rotation; 0: no floor
    bool bodies_lie_flat = false;     // coins
    double rolling_resistance = 0.0;  // μ_r g, of spheres
};

/// Uniformly accelerated motion, with the state at `time` (compare Flight).
template <class Real>
struct Parabola {
    BasicVec2<Real> position, velocity, acceleration;
    Real time;

    SWIRL_INLINE constexpr BasicVec2<Real> position_at(const Real& t) const {
        const Real elapsed = t - time;
        return position + elapsed * velocity + (Real(0.5) * elapsed * elapsed) * acceleration;
    }
    SWIRL_INLINE constexpr BasicVec2<Real> velocity_at(const Real& t) const {
        const Real elapsed = t - time;
        return velocity + elapsed * acceleration;
    }
};

/// How the floor moves a sphere until its next event.
struct FloorMotion {
    Vec2 acceleration{0.0, 0.0};
    Vec2 spin_rate{0.0, 0.0};  // (dω_x/dt, dω_y/dt)
    /// The time when sliding ends: a sphere begins to roll, a coin rests on the floor. Or the time
    /// when a rolling sphere that slows down has stopped. `never` if neither happens.
    double begins_to_roll = never;
    bool slows_down = false;        // it rolls, against a resistance
    Vec2 floor_velocity{0.0, 0.0};  // velocity of the floor under it
};

/// (ω_x, ω_y) of a sphere that rolls with this velocity relative to the floor.
SWIRL_INLINE constexpr Vec2 spin_of_rolling(const Vec2& over_floor, double radius) {
    return {-(over_floor.y / radius), over_floor.x / radius};
}
/// The slip velocity c. For a rolling sphere c = 0 only up to rounding, so floor_motion tests the
/// spin instead.
SWIRL_INLINE constexpr Vec2 slip_on_floor(const Disc& d, const Vec2& floor_velocity) {
    const Vec2 over_floor = d.velocity - floor_velocity;
    return {over_floor.x - d.radius * d.rolling_spin.y, over_floor.y + d.radius * d.rolling_spin.x};
}
/// 1 + m R²/I: slip ends this much faster than without rotation.
SWIRL_INLINE constexpr double slip_factor(double mass, double radius, double inertia) {
    return 1.0 + mass * radius * radius / inertia;
}

/// (dω_x/dt, dω_y/dt).
SWIRL_INLINE constexpr Vec2 rolling_spin_rate(const Vec2& acceleration, double mass, double radius,
                                              double inertia) {
    const double rate = mass * radius / inertia;
    return {rate * acceleration.y, -(rate * acceleration.x)};
}

/// The motion of a sphere that rolls.
SWIRL_INLINE FloorMotion rolling_motion(const Disc& d, const Floor& floor,
                                        const Vec2& floor_velocity) {
    if (floor.rolling_resistance == 0.0) return {};
    const Vec2 w = d.velocity - floor_velocity;
    const double speed = square_root(dot(w, w));
    if (speed == 0.0) return {};
    const double rate =
        floor.rolling_resistance / (1.0 + d.inertia / (d.mass * d.radius * d.radius));
    const Vec2 a = (-rate / speed) * w;
    return {a, spin_of_rolling(a, d.radius), d.time + speed / rate, true, floor_velocity};
}

/// The motion that follows from a stored state.
SWIRL_INLINE FloorMotion floor_motion(const Disc& d, const Floor& floor,
                                      const Vec2& floor_velocity) {
    if (floor.deceleration == 0.0) return {};
    // A coin at rest on the floor has the horizontal spin of a sphere at rest on it: none.
    const Vec2 rolls = spin_of_rolling(d.velocity - floor_velocity, d.radius);
    if (d.rolling_spin.x == rolls.x && d.rolling_spin.y == rolls.y)
        return rolling_motion(d, floor, floor_velocity);
    const Vec2 c = slip_on_floor(d, floor_velocity);
    const double slip = square_root(dot(c, c));
    if (slip == 0.0) return rolling_motion(d, floor, floor_velocity);
    const Vec2 a = (-floor.deceleration / slip) * c;
    if (floor.bodies_lie_flat) return {a, {0.0, 0.0}, d.time + slip / floor.deceleration};
    return {a, rolling_spin_rate(a, d.mass, d.radius, d.inertia),
            d.time + slip / (floor.deceleration * slip_factor(d.mass, d.radius, d.inertia))};
}

/// The parabola of a sphere.
SWIRL_INLINE constexpr Parabola<double> parabola(const Disc& d, const FloorMotion& motion) {
    return {d.position, d.velocity, motion.acceleration, d.time};
}

/// The same sphere with its state at time t.
SWIRL_INLINE constexpr Disc moved_to(const Disc& d, const FloorMotion& motion, double t) {
    Disc after = d;
    const double elapsed = t - d.time;
    after.position = parabola(d, motion).position_at(t);
    after.velocity = parabola(d, motion).velocity_at(t);
    after.angle = d.angle + elapsed * d.spin;
    after.rolling_spin = motion.slows_down
                             ? spin_of_rolling(after.velocity - motion.floor_velocity, d.radius)
                             : d.rolling_spin + elapsed * motion.spin_rate;
    after.time = t;
    return after;
}

/// The sphere at the end of sliding or slowing down: from then on it rolls or rests exactly.
SWIRL_INLINE constexpr Disc set_rolling(const Disc& d, const FloorMotion& motion,
                                        const Floor& floor, const Vec2& floor_velocity) {
    Disc after = moved_to(d, motion, motion.begins_to_roll);
    if (floor.bodies_lie_flat || motion.slows_down) after.velocity = floor_velocity;
    after.rolling_spin = spin_of_rolling(after.velocity - floor_velocity, d.radius);
    return after;
}

}  // namespace swirl
