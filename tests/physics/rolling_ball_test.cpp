#include "swirl/physics/rolling_ball.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace swirl {
namespace {

constexpr double T = paper_period, A = paper_amplitude;
const double omega = 2.0 * pi / T;

TEST(RollingBall, GammaIsBetweenZeroAndTheRatioOfRadii) {
    EXPECT_EQ((RollingBall{9.0, 6.0, 0.0}).gamma(), 0.0);
    EXPECT_EQ((RollingBall{9.0, 6.0, 1.0}).gamma(), 1.5);
    EXPECT_EQ((RollingBall{9.0, 6.0, 0.0}).rotation(), 1.0);
    EXPECT_EQ((RollingBall{9.0, 6.0, 1.0}).rotation(), -0.5);
    // The boundary of rotation and counterrotation is s = R_ball/R_container.
    EXPECT_NEAR((RollingBall{9.0, 6.0, 6.0 / 9.0}).rotation(), 0.0, 1e-15);
}

TEST(RollingBall, ContactMovesWithTheWallWithoutSlip) {
    const RollingBall ball{8.6, 5.0, 1.0, 0.3};
    for (const double t : {0.0, 3.0, 11.0, 40.0}) {
        const Snapshot s = snapshot_at(ball, A, T, t);
        const Vec2 n = (1.0 / (8.6 - 5.0)) * (s.position(0) - s.container_centre);
        const Vec2 contact = s.velocity(0) + (s.spin[0] * 5.0) * perpendicular(n);
        EXPECT_NEAR(contact.x, s.container_velocity.x, 1e-14);
        EXPECT_NEAR(contact.y, s.container_velocity.y, 1e-14);
    }
}

TEST(RollingBall, TouchesTheWallAndMovesWithItsVelocity) {
    const RollingBall ball{8.6, 5.0, 0.5};
    const double dt = 1e-6;
    for (const double t : {0.5, 11.8, 30.0}) {
        const Snapshot a = snapshot_at(ball, A, T, t - dt), b = snapshot_at(ball, A, T, t + dt);
        const Snapshot s = snapshot_at(ball, A, T, t);
        const Vec2 off = s.position(0) - s.container_centre;
        EXPECT_NEAR(std::hypot(off.x, off.y), 3.6, 1e-14);
        const Vec2 moved = b.position(0) - a.position(0);
        // Errors of the central difference: rounding gives 1e-15/dt, and the third derivative is
        // negligible.
        EXPECT_NEAR(moved.x / (2.0 * dt), s.vx[0], 1e-8);
        EXPECT_NEAR(moved.y / (2.0 * dt), s.vy[0], 1e-8);
        EXPECT_NEAR((b.angle[0] - a.angle[0]) / (2.0 * dt), s.spin[0], 1e-8);
    }
}

TEST(RollingBall, IsOppositeTheSwirlCentreWithoutLag) {
    const Snapshot s = snapshot_at({8.6, 5.0, 1.0, 0.0}, A, T, 4.0);
    EXPECT_NEAR(cross(s.container_centre, s.position(0)), 0.0, 1e-14);
    EXPECT_GT(dot(s.container_centre, s.position(0)), 0.0);
    EXPECT_EQ(snapshot_at({}, A, T, 3.0 * T + 1.0).periods, 3);
}

TEST(RollingBall, CounterrotatesInTheMFrame) {
    EXPECT_EQ((RollingBall{9.0, 6.0, 1.0}).gamma(), 1.5);
    EXPECT_EQ((RollingBall{9.0, 6.0, 0.5}).gamma(), 0.75);
}

TEST(RollingBall, LagsClockwiseBehindTheDirectionFromTheSwirlCentre) {
    for (const double t : {0.0, 4.0, 11.0}) {
        const Snapshot s = snapshot_at({8.6, 5.0, 1.0, 0.3}, A, T, t);
        const Vec2 C = s.container_centre, out = s.position(0) - C;
        // Lengths A and 3.6, each known to a few 10⁻¹⁵.
        EXPECT_NEAR(cross(C, out), -A * 3.6 * std::sin(0.3), 1e-13);
        EXPECT_NEAR(dot(C, out), A * 3.6 * std::cos(0.3), 1e-13);
    }
}

}  // namespace
}  // namespace swirl
