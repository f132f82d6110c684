#include "swirl/measure/coarse_graining.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "measure/snapshots.hpp"

namespace swirl {
namespace {

/// A line near the point, a width, and x − r_i.
struct LineCase {
    CoarseKernel kernel;
    Vec2 q, line;
};
LineCase random_line(Noise& noise) {
    const CoarseKernel kernel{1.5 + 1.2 * noise()};
    const double reach = 2.0 * kernel.width;
    return {kernel, {reach * noise(), reach * noise()}, {3.0 * noise(), 3.0 * noise()}};
}

TEST(CoarseKernel, IsNormalised) {
    // ∫ W 2πr dr = ∫ π W(√u) du, a polynomial of degree 2 in u: Gauss's nodes are exact.
    for (const double width : {0.3, 1.0, 7.0}) {
        const CoarseKernel kernel{width};
        double integral = 0.0;
        for_each_node(gauss_5, {0.0, width * width}, [&](double u, double weight) {
            integral += weight * pi * kernel.value({std::sqrt(u), 0.0});
        });
        EXPECT_NEAR(integral, 1.0, 1e-15);
        EXPECT_EQ(kernel.value({width, 0.0}), 0.0);
        EXPECT_EQ(kernel.value({0.0, 1.1 * width}), 0.0);
    }
}

TEST(CoarseKernel, GradientIsThatOfTheValue) {
    const CoarseKernel kernel{1.7};
    Noise noise(3);
    for (int k = 0; k < 100; ++k) {
        const Vec2 d{1.2 * noise(), 1.2 * noise()};
        constexpr double h = 1e-5;
        const double x = (kernel.value(d + Vec2{h, 0}) - kernel.value(d - Vec2{h, 0})) / (2 * h);
        const double y = (kernel.value(d + Vec2{0, h}) - kernel.value(d - Vec2{0, h})) / (2 * h);
        // The third derivative is of order 1: h² and rounding/h.
        EXPECT_NEAR(kernel.gradient(d).x, x, 1e-9);
        EXPECT_NEAR(kernel.gradient(d).y, y, 1e-9);
    }
}

// The kernel by its definition, and the mean over many equal steps.
LineAverage brute_average(const LineCase& c) {
    constexpr int steps = 20000;
    const double w = c.kernel.width;
    LineAverage sum;
    for (int k = 0; k < steps; ++k) {
        const double s = (k + 0.5) / steps;
        const double x = c.q.x - s * c.line.x, y = c.q.y - s * c.line.y;
        const double part = 1.0 - (x * x + y * y) / (w * w);
        const double value = part > 0.0 ? 3.0 * part * part / (pi * w * w) : 0.0;
        sum.whole += value / steps;
        sum.weighted += s * value / steps;
    }
    return sum;
}

TEST(StretchInside, OfALineThatLeavesAtRightAnglesIsHalfAChord) {
    // |q − s ℓ|² = 1 + 4 s² is below w² = 4 up to s = √3/2, in both directions of the line.
    for (const double side : {1.0, -1.0}) {
        const Stretch inside = stretch_inside({2.0}, {0.0, 1.0}, {2.0 * side, 0.0});
        EXPECT_EQ(inside.begin, 0.0);
        EXPECT_NEAR(inside.end, std::sqrt(0.75), 1e-15);
    }
}

TEST(LineAverage, EqualsTheMeanAlongTheLine) {
    Noise noise(1);
    int inside = 0;
    for (int k = 0; k < 300; ++k) {
        const LineCase c = random_line(noise);
        const LineAverage exact = line_average(c.kernel, c.q, c.line), brute = brute_average(c);
        // The midpoint rule errs by the curvature of W times step²/24, and by 1/step³ at the edge.
        EXPECT_NEAR(exact.whole, brute.whole, 3e-8);
        EXPECT_NEAR(exact.weighted, brute.weighted, 3e-8);
        inside += exact.whole > 0.0 ? 1 : 0;
    }
    EXPECT_GT(inside, 80);
}

// ℓ·∇W along the line is −dW/ds, so these two follow from W at the ends alone.
TEST(LineGradient, FollowsFromTheValuesAtTheEnds) {
    Noise noise(2);
    for (int k = 0; k < 10000; ++k) {
        const LineCase c = random_line(noise);
        const LineAverage b = line_average(c.kernel, c.q, c.line);
        const LineGradient g = line_gradient(c.kernel, c.q, c.line);
        const double at_i = c.kernel.value(c.q), at_j = c.kernel.value(c.q - c.line);
        // Rounding: W is at most 10 for the narrowest kernel, its gradient 60.
        EXPECT_NEAR(dot(c.line, g.whole), at_i - at_j, 3e-14);
        EXPECT_NEAR(dot(c.line, g.weighted), b.whole - at_j, 3e-14);
    }
}

TEST(LineAverage, OfAPointIsTheValueThere) {
    const CoarseKernel kernel{2.0};
    for (const Vec2 q : {Vec2{0.3, -0.4}, Vec2{1.9, 0.0}, Vec2{2.0, 0.0}, Vec2{3.0, 0.0}}) {
        EXPECT_NEAR(line_average(kernel, q, {0.0, 0.0}).whole, kernel.value(q), 1e-16);
        EXPECT_NEAR(line_average(kernel, q, {1e-200, 0.0}).whole, kernel.value(q), 1e-16);
    }
}

TEST(Transfer, TorquesAddUpToThatOfTheImpulse) {
    Snapshot s = empty_container();
    add_disc(s, {0.5, -1.0}, {0.0, 0.0}, 0.0, 1.3);
    const Vec2 n = unit_circle(0.2);
    add_disc(s, Vec2{0.5, -1.0} + 2.0 * n, {0.0, 0.0}, 0.0, 0.7);
    const Impulse J{2.0, -0.6, false};
    const Transfer t = transfer_of({0, 0.0, EventKind::disc_disc, 0, 1, n, J, 0.0}, s);
    EXPECT_NEAR(t.torque_i + t.torque_j, -cross(t.line, t.impulse), 1e-15);
    EXPECT_NEAR(t.torque_i, 1.3 * -0.6, 1e-15);
    const Transfer wall = transfer_of({0, 0.0, EventKind::disc_wall, 0, 0, n, J, 0.0}, s);
    EXPECT_NEAR(wall.torque_i, -cross(wall.line, wall.impulse), 1e-15);
    EXPECT_EQ(wall.torque_j, 0.0);
    EXPECT_NEAR(wall.end().x, 0.5 + 1.3 * n.x, 1e-15);
}

}  // namespace
}  // namespace swirl
