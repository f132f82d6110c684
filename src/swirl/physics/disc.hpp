// A disc, and how it moves between collisions: in a straight line at constant speed, turning at
// constant rate. There is no friction with the floor (paper, SI "Overview"). A sphere, seen from
// above, is a disc with two spins more; what the floor does to it is in floor.hpp.
#pragma once

#include "swirl/math/real.hpp"
#include "swirl/math/vec2.hpp"

namespace swirl {

/// Uniform motion: `position` held at `time`. A contact time may depend on nothing but this.
template <class Real>
struct Flight {
    BasicVec2<Real> position, velocity;
    Real time;

    SWIRL_INLINE constexpr BasicVec2<Real> position_at(const Real& t) const {
        const Real elapsed = t - time;
        return position + elapsed * velocity;
    }
};

/// Units: length = disc radius, mass = disc mass, speed of the container = 1. The state is that at
/// `time`, which is counted from the start of the current swirl.
struct Disc {
    Vec2 position, velocity;
    double angle, spin, time;  // spin: the paper's ω_i, positive counter-clockwise
    double radius, mass, inertia;
    // Of spheres alone; a disc has none of it.
    Vec2 rolling_spin{0.0, 0.0};  // (ω_x, ω_y)
    double last_collision = 0.0;  // when; `time` is also that of other changes

    constexpr Flight<double> flight() const { return {position, velocity, time}; }

    /// The same disc, brought up to date.
    constexpr Disc at(double t) const {
        Disc d = *this;
        d.position = flight().position_at(t);
        d.angle = angle + (t - time) * spin;
        d.time = t;
        return d;
    }
};

/// The paper's table gives I = 10 for m = r = 1, which no rigid plane disc can have (a ring has 1,
/// a solid disc ½). It matters: with ½ the cluster counterrotates only beyond N = 52.
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
