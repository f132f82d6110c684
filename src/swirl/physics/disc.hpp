// A disc and its motion between collisions: uniform translation and constant spin. There is no
// friction against the floor (paper, SI "Overview"). A sphere, seen from above, is a disc with two
// more spins; floor.hpp describes how the floor acts on it.
#pragma once

#include "swirl/math/real.hpp"
#include "swirl/math/vec2.hpp"

namespace swirl {

/// Uniform motion, with `position` at `time`. Contact times depend on nothing else.
template <class Real>
struct Flight {
    BasicVec2<Real> position, velocity;
    Real time;

    SWIRL_INLINE constexpr BasicVec2<Real> position_at(const Real& t) const {
        const Real elapsed = t - time;
        return position + elapsed * velocity;
    }
};

/// Units: disc radius, disc mass, and the container's speed are 1. The state is that at `time`,
/// which counts from the start of the current period.
struct Disc {
    Vec2 position, velocity;
    double angle, spin, time;  // spin: the paper's ω_i, positive counter-clockwise
    double radius, mass, inertia;
    // For spheres only.
    Vec2 rolling_spin{0.0, 0.0};  // (ω_x, ω_y)
    double last_collision = 0.0;  // time of the last collision; `time` may be later
    /// 1, or 0 for a particle that cannot spin: it responds to no torque about the vertical axis,
    /// as if its moment of inertia were infinite. A sphere that cannot spin rolls like any other.
    double can_spin = 1.0;

    /// 1/I for the spin about the vertical axis.
    constexpr double inverse_inertia() const { return can_spin / inertia; }

    constexpr Flight<double> flight() const { return {position, velocity, time}; }

    /// The same disc with its state at time t.
    constexpr Disc at(double t) const {
        Disc d = *this;
        d.position = flight().position_at(t);
        d.angle = angle + (t - time) * spin;
        d.time = t;
        return d;
    }
};

/// The paper's table gives I = 10 for m = r = 1. No rigid plane disc can have that: a ring has 1, a
/// solid disc ½. The value matters: with ½ the cluster counterrotates only beyond N = 52.
inline constexpr double paper_inertia = 10.0;
inline constexpr double ring_inertia(double mass, double radius) { return mass * radius * radius; }
inline constexpr double solid_inertia(double mass, double radius) {
    return 0.5 * mass * radius * radius;
}

/// Kinetic energy of translation and spin, in the frame in which the velocities are given.
constexpr double kinetic_energy(const Disc& d) {
    return 0.5 * (d.mass * dot(d.velocity, d.velocity) + d.inertia * d.spin * d.spin +
                  d.inertia * dot(d.rolling_spin, d.rolling_spin));
}

}  // namespace swirl
