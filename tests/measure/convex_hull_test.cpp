#include "swirl/measure/convex_hull.hpp"

#include <gtest/gtest.h>

#include "measure/snapshots.hpp"

namespace swirl {
namespace {

TEST(ConvexHull, OfASquareWithPointsInsideAndOnItsSides) {
    std::vector<Vec2> points{{0, 0}, {2, 0}, {2, 2}, {0, 2}, {1, 1}, {1, 0}, {2, 1}, {0, 0}};
    const std::vector<Vec2> hull = convex_hull(points);
    EXPECT_EQ(hull.size(), 4u);
    EXPECT_EQ(perimeter(hull), 8.0);
}

TEST(ConvexHull, OfFewPointsAndPointsOnALine) {
    std::vector<Vec2> none, one{{1, 2}}, same{{1, 2}, {1, 2}, {1, 2}}, line{{0, 0}, {3, 0}, {1, 0}};
    EXPECT_EQ(perimeter(convex_hull(none)), 0.0);
    EXPECT_EQ(perimeter(convex_hull(one)), 0.0);
    EXPECT_EQ(perimeter(convex_hull(same)), 0.0);
    EXPECT_EQ(perimeter(convex_hull(line)), 6.0);
}

TEST(ConvexHull, EnclosesEveryPointAndIsConvex) {
    for (std::uint64_t seed = 1; seed <= 50; ++seed) {
        Noise noise(seed);
        std::vector<Vec2> points;
        for (int k = 0; k < 40; ++k) points.push_back({noise(), noise()});
        const std::vector<Vec2> hull = convex_hull(points);
        for (std::size_t k = 0; k < hull.size(); ++k) {
            const Vec2 a = hull[k], b = hull[(k + 1) % hull.size()];
            for (const Vec2& p : points) EXPECT_GE(cross(b - a, p - a), -1e-15);
        }
    }
}

}  // namespace
}  // namespace swirl
