#include "swirl/physics/container_path.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace swirl {
namespace {

// Positions of order 1 after a handful of roundings.
constexpr double rounding = 1e-14;

double length(const Vec2& v) { return std::hypot(v.x, v.y); }

TEST(ContainerPath, ThePaperDishMovesAtSpeedOne) {
    const ContainerPath path = polygon_path(paper_amplitude, paper_period, paper_sides);
    ASSERT_EQ(path.legs.size(), 30u);
    // The SI's numbers are given to seven digits (T) and four (A): A = 1.892 gives 0.99999.
    for (const Leg& leg : path.legs) EXPECT_NEAR(length(leg.velocity), 1.0, 5e-4);
}

TEST(ContainerPath, LegsFollowOneAnotherAndClose) {
    for (const int sides : {3, 4, 30, 301}) {
        const ContainerPath path = polygon_path(1.892, 11.866071, sides);
        ASSERT_EQ(path.legs.size(), static_cast<std::size_t>(sides));
        EXPECT_EQ(path.legs.front().begin, 0.0);
        EXPECT_EQ(path.legs.back().end, path.period);
        for (std::size_t k = 0; k < path.legs.size(); ++k) {
            const Leg& leg = path.legs[k];
            const Leg& next = path.legs[(k + 1) % path.legs.size()];
            EXPECT_EQ(leg.end, k + 1 < path.legs.size() ? next.begin : path.period);
            EXPECT_LT(length(leg.position_at(leg.end) - next.start), rounding) << "side " << k;
        }
    }
}

TEST(ContainerPath, VerticesLieOnTheCircleStartingAtThePositiveXAxisAndRunCounterClockwise) {
    const ContainerPath path = polygon_path(2.0, 10.0, 7);
    EXPECT_EQ(path.legs[0].start.x, 2.0);
    EXPECT_EQ(path.legs[0].start.y, 0.0);
    for (const Leg& leg : path.legs) {
        EXPECT_NEAR(length(leg.start), 2.0, rounding);
        EXPECT_GT(cross(leg.start, leg.velocity), 0.0);
    }
}

TEST(ContainerPath, SidesHaveTheSpeedOfTheClosedForm) {
    for (const int sides : {3, 30, 300}) {
        const double speed = 2.0 * 1.5 * sides * std::sin(pi / sides) / 8.0;
        for (const Leg& leg : polygon_path(1.5, 8.0, sides).legs)
            EXPECT_NEAR(length(leg.velocity), speed, 1e-13 * sides);  // difference of two vertices
    }
}

TEST(ContainerPath, TheExactCircleIsOneTurningLeg) {
    const ContainerPath path = circular_path(1.892, 11.866071);
    ASSERT_EQ(path.legs.size(), 1u);
    const Leg& leg = path.legs[0];
    EXPECT_EQ(leg.turning, path.omega());
    for (int k = 0; k <= 100; ++k) {
        const double t = path.period * k / 100;
        const Vec2 C = leg.position_at(t), V = leg.velocity_at(t);
        EXPECT_NEAR(C.x, 1.892 * std::cos(path.omega() * t), rounding);
        EXPECT_NEAR(C.y, 1.892 * std::sin(path.omega() * t), rounding);
        const Vec2 expected = path.omega() * perpendicular(C);
        EXPECT_LT(length(V - expected), rounding);
    }
}

TEST(ContainerPath, ThePolygonTendsToTheCircle) {
    const ContainerPath circle = circular_path(1.892, 11.866071);
    const ContainerPath polygon = polygon_path(1.892, 11.866071, 3000);
    // The sagitta A (π/M)²/2 is the farthest a chord is from its arc.
    const double sagitta = 1.892 * (pi / 3000) * (pi / 3000) / 2.0;
    double farthest = 0.0;
    for (int k = 0; k < 10000; ++k) {
        const double t = circle.period * (k + 0.5) / 10000;
        farthest = std::max(
            farthest, length(circle.legs[0].position_at(t) - polygon.leg_at(t).position_at(t)));
    }
    EXPECT_LT(farthest, 1.001 * sagitta);
    EXPECT_GT(farthest, 0.9 * sagitta);
}

TEST(ContainerPath, LegAtFindsTheLegAndTheEndBelongsToTheNext) {
    const ContainerPath path = polygon_path(1.0, 6.0, 3);
    EXPECT_EQ(&path.leg_at(0.0), &path.legs[0]);
    EXPECT_EQ(&path.leg_at(path.legs[0].end), &path.legs[1]);
    EXPECT_EQ(&path.leg_at(5.999), &path.legs[2]);
    EXPECT_EQ(&path.leg_at(6.0), &path.legs[2]);
}

TEST(ContainerPath, WithoutAmplitudeTheContainerStandsStillOnEveryPath) {
    for (const ContainerPath& path : {polygon_path(0.0, 7.0, 30), circular_path(0.0, 7.0)}) {
        ASSERT_EQ(path.legs.size(), 1u);
        EXPECT_EQ(length(path.legs[0].velocity), 0.0);
        EXPECT_EQ(length(path.legs[0].position_at(3.3)), 0.0);
        EXPECT_EQ(path.period, 7.0);
    }
}

}  // namespace
}  // namespace swirl
