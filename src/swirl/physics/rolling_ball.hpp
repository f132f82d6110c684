// The minimal model: one rigid ball in a swirled container (paper, main text after Fig. 4; SI
// videos "minimal model").
//
// The centrifugal force presses the ball against the wall. In the M-frame it settles at a fixed
// point of the wall and turns there about its own centre at the constant rate ϖ_M. One parameter,
// the slip parameter s, interpolates between no slip (the ball rolls like a gear inside a ring) and
// perfect slip (nothing turns it):
//
//     γ = |ϖ_M|/Ω = s γ_c,   γ_c = R_container/R_ball,   ϖ_M = −γ Ω,   ϖ = ϖ_M + Ω = (1 − γ) Ω
//
// At the contact the wall moves with −ΩR and the ball's surface with ϖ_M R_ball = −s ΩR: for s = 1
// both move together. γ < 1 is rotation in the lab, γ > 1 is counterrotation, with the boundary at
// s = R_ball/R_container.
//
// The paper takes s = 0 for perfect slip. But a ball that nothing turns keeps its spin in the lab,
// so in the M-frame it turns with −Ω: γ = 1 and s = R_ball/R_container, where it neither rotates
// nor counterrotates. With s = 0 it rotates with Ω, as if it were fixed to the M-frame. `swirl
// paper --figure ball` simulates the ball; this header computes the paper's formula.
//
// Without rolling resistance, and without slip anywhere, the ball settles at M itself. `lag` turns
// that point clockwise, as friction that balances the centrifugal force would.
//
// Units: those of the container. Limits: 0 < R_ball < R_container, 0 ≤ s ≤ 1.
#pragma once

#include "swirl/math/unit_circle.hpp"
#include "swirl/physics/container_path.hpp"
#include "swirl/physics/snapshot.hpp"

namespace swirl {

struct RollingBall {
    double container_radius = paper_container_radius;
    double ball_radius = 0.5 * paper_container_radius;
    double slip = 1.0;  // s: 1 rolls without slip, 0 is fixed to the M-frame
    double lag = 0.0;   // clockwise from M, rad

    double gamma_no_slip() const { return container_radius / ball_radius; }  // γ_c
    double gamma() const { return slip * gamma_no_slip(); }
    /// In units of Ω; −γ in the M-frame.
    double rotation() const { return 1.0 - gamma(); }
};

/// Ball and container at the time t ≥ 0 on the exact circle of amplitude A, as one disc.
inline Snapshot snapshot_at(const RollingBall& ball, double amplitude, double period, double t) {
    const double turns = t / period;
    const double omega = 2.0 * pi / period;
    Snapshot s;
    s.periods = static_cast<std::int64_t>(turns);
    const double phase = turns - static_cast<double>(s.periods);
    s.clock = phase * period;
    s.period = period;
    s.container_radius = ball.container_radius;
    s.container_centre = amplitude * unit_circle(phase);
    s.container_velocity = omega * perpendicular(s.container_centre);
    // A point at rest in the M-frame turns with Ω about S.
    const Vec2 from_centre =
        (ball.container_radius - ball.ball_radius) * unit_circle(phase - ball.lag / (2.0 * pi));
    const Vec2 position = s.container_centre + from_centre;
    const double mass = ball.ball_radius * ball.ball_radius;
    s.resize(1);
    s.set(0, {position, omega * perpendicular(position), 2.0 * pi * turns * ball.rotation(),
              omega * ball.rotation(), s.clock, ball.ball_radius, mass,
              solid_inertia(mass, ball.ball_radius)});
    return s;
}

}  // namespace swirl
