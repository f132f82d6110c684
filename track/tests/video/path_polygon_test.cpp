#include "track/video/path_polygon.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "math/deviate.hpp"
#include "swirl/math/random.hpp"
#include "swirl/math/unit_circle.hpp"
#include "track/video/container_path_fit.hpp"

namespace swirl::tracking {
namespace {

/// Positions on a polygon with a vertex at angle 0; 0 sides: a circle.
std::vector<Vec2> on_polygon(double amplitude, int sides, double per_period, int number) {
    std::vector<Vec2> positions;
    for (int k = 0; k < number; ++k) {
        const double turn = k / per_period - std::floor(k / per_period);
        Vec2 p = amplitude * unit_circle(turn);
        if (sides > 0) {
            const double segment = sides * turn, u = segment - std::floor(segment);
            p = (amplitude * (1.0 - u)) * unit_circle(std::floor(segment) / sides) +
                (amplitude * u) * unit_circle(std::fmod(std::floor(segment) + 1.0, sides) / sides);
        }
        positions.push_back({200.0 + p.x, 180.0 - p.y});
    }
    return positions;
}

TEST(PathPolygon, CountsSidesAndDistinguishesACircle) {
    Random random(11);
    constexpr double amplitude = 40.0, rim_noise = 0.06;
    for (const int sides : {0, 4, 12, 30}) {
        // 149.3 frames per period.
        std::vector<Vec2> centres = on_polygon(amplitude, sides, 149.3, 600);
        std::vector<double> times;
        for (std::size_t k = 0; k < centres.size(); ++k) {
            centres[k] = centres[k] + rim_noise * Vec2{deviate(random), deviate(random)};
            times.push_back(double(k));
        }
        const auto path = fit_container_path(centres, times);
        ASSERT_TRUE(path) << sides;
        const PathPolygon shape = find_path_polygon(centres, times, *path);
        EXPECT_EQ(shape.sides, sides);
        EXPECT_GE(shape.max_sides, sides == 0 ? 30 : sides);
        if (sides == 0) continue;
        // The fit's weights omit the vertices of a square as outliers, which biases its radius.
        EXPECT_NEAR(shape.vertex_distance, amplitude, sides > 6 ? 0.1 : 0.5);
    }
}

TEST(PathPolygon, FewFramesGiveNoWrongNumberOfSides) {
    Random random(13);
    constexpr double per_period = 64.0;
    std::vector<double> times;
    for (int k = 0; k < 74; ++k) times.push_back(k);
    const auto sides_of = [&](double amplitude, int sides, double every_other) {
        std::vector<Vec2> centres = on_polygon(amplitude, sides, per_period, 74);
        for (std::size_t k = 0; k < centres.size(); ++k) {
            const Vec2 out = (1.0 / amplitude) * (centres[k] - Vec2{200.0, 180.0});
            centres[k] = centres[k] + (k % 2 ? every_other : -every_other) * out +
                         0.004 * Vec2{deviate(random), deviate(random)};
        }
        const auto path = fit_container_path(centres, times);
        EXPECT_TRUE(path);
        const PathPolygon shape = find_path_polygon(centres, times, *path);
        // The true number of sides is not excluded, either.
        if (shape.sides == 0) {
            EXPECT_LT(shape.max_sides, sides);
        }
        return shape.sides;
    };
    for (int trial = 0; trial < 20; ++trial) {
        // A codec that treats every other frame differently imitates two frames per side.
        EXPECT_NE(sides_of(8.0, 30, 0.01), 32);
        // At 64 frames per period, a polygon of 34 sides looks like one of 30, except for its size.
        const int sides = sides_of(30.0, 34, 0.0);
        EXPECT_TRUE(sides == 0 || sides == 34) << sides;
        EXPECT_EQ(sides_of(30.0, 20, 0.0), 20);
    }
}

}  // namespace
}  // namespace swirl::tracking
