#include "swirl/measure/segregation.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "measure/snapshots.hpp"
#include "swirl/math/random.hpp"

namespace swirl {
namespace {

/// G from all pairs.
double all_pairs(const std::vector<double>& size, const std::vector<double>& distance) {
    double outside = 0.0, inside = 0.0;
    for (std::size_t i = 0; i < size.size(); ++i)
        for (std::size_t j = 0; j < size.size(); ++j) {
            if (!(size[i] > size[j]) || distance[i] == distance[j]) continue;
            (distance[i] > distance[j] ? outside : inside) += 1.0;
        }
    return (outside - inside) / (outside + inside);
}

TEST(RadialSegregation, CountsAllPairs) {
    Random random(2);
    RadialSegregation radial;
    for (int trial = 0; trial < 200; ++trial) {
        std::vector<double> size, distance;
        const std::size_t n = 2 + random.below(40);
        // Few values, so that ties occur in both.
        for (std::size_t i = 0; i < n; ++i) {
            size.push_back(static_cast<double>(1 + random.below(5)));
            distance.push_back(static_cast<double>(random.below(9)));
        }
        const double expected = all_pairs(size, distance);
        if (std::isnan(expected))
            EXPECT_TRUE(std::isnan(radial(size, distance)));
        else
            EXPECT_EQ(radial(size, distance), expected);
    }
}

TEST(RadialSegregation, HasItsIdealAnswers) {
    RadialSegregation radial;
    EXPECT_EQ(radial({1, 1, 2, 2}, {0, 1, 2, 3}), 1.0);
    EXPECT_EQ(radial({2, 2, 1, 1}, {0, 1, 2, 3}), -1.0);
    EXPECT_EQ(radial({1, 2, 2, 1}, {0, 1, 2, 3}), 0.0);
    EXPECT_TRUE(std::isnan(radial({1, 1, 1}, {0, 1, 2})));
    EXPECT_TRUE(std::isnan(radial({1, 2, 3}, {1, 1, 1})));
    EXPECT_TRUE(std::isnan(radial({}, {})));
}

TEST(LargeClass, IsAboveTheMedian) {
    using Flags = std::vector<bool>;
    EXPECT_EQ(large_class({1, 1, 1, 2}), (Flags{false, false, false, true}));
    EXPECT_EQ(large_class({1, 2, 2, 2}), (Flags{false, true, true, true}));
    EXPECT_EQ(large_class({3, 1, 2, 4}), (Flags{true, false, false, true}));
    EXPECT_EQ(large_class({1, 1}), Flags{});
    EXPECT_EQ(large_class({}), Flags{});
}

/// Radii are nearly equal, so that all inner discs have six neighbours.
Snapshot small_discs(int rings) {
    Snapshot s = triangular_lattice(rings);
    s.container_radius += 1.0;
    for (double& radius : s.radius) radius = 1.0 - 1e-9;
    return s;
}
template <class IsLarge>
Snapshot with_large(Snapshot s, IsLarge is_large) {
    for (std::size_t i = 0; i < s.size(); ++i)
        if (is_large(s.position(i) - s.container_centre, i)) s.radius[i] = 1.0;
    return s;
}
Segregation measured(const Snapshot& s) {
    Segregation segregation;
    const MFrameView view(s);
    Voronoi cells;
    cells.find(view);
    segregation.sample(view, cells);
    segregation.close_block();
    return segregation;
}
double mean_of(const Segregation& s, const char* row) { return row_of(s, row).mean; }

TEST(Segregation, OfARandomMixtureIsZero) {
    const Snapshot s = small_discs(5);
    Random random(4);
    double radial = 0.0, neighbours = 0.0, squares = 0.0;
    constexpr int trials = 400;
    for (int k = 0; k < trials; ++k) {
        const Segregation found =
            measured(with_large(s, [&](const Vec2&, std::size_t) { return random.below(3) == 0; }));
        const double G = mean_of(found, "radial"), S = mean_of(found, "neighbours");
        radial += G / trials;
        neighbours += S / trials;
        squares += (G * G + S * S) / trials;
    }
    // Four standard errors of the mean.
    EXPECT_NEAR(radial, 0.0, 4.0 * std::sqrt(squares / trials));
    EXPECT_NEAR(neighbours, 0.0, 4.0 * std::sqrt(squares / trials));
    EXPECT_LT(std::sqrt(squares), 0.25);
}

TEST(Segregation, OfLargeDiscsOutsideIsOne) {
    const Snapshot s = small_discs(6);
    const Segregation outside =
        measured(with_large(s, [](const Vec2& p, std::size_t) { return dot(p, p) > 5.5 * 5.5; }));
    EXPECT_EQ(mean_of(outside, "radial"), 1.0);
    EXPECT_GT(mean_of(outside, "neighbours"), 0.5);  // but for the interface
    EXPECT_GT(mean_of(outside, "large_distance"), 5.5);
    EXPECT_LT(mean_of(outside, "small_distance"), 5.5);
    const Segregation inside =
        measured(with_large(s, [](const Vec2& p, std::size_t) { return dot(p, p) < 5.5 * 5.5; }));
    EXPECT_EQ(mean_of(inside, "radial"), -1.0);
}

// Half discs are separated, but not radially: one number alone would not show it.
TEST(Segregation, OfHalfDiscsIsSeenAmongNeighboursOnly) {
    double last = 0.0;
    for (const int rings : {4, 8, 16}) {
        const Segregation halves = measured(with_large(
            small_discs(rings), [](const Vec2& p, std::size_t) { return p.y + 0.1 * p.x > 0.2; }));
        EXPECT_NEAR(mean_of(halves, "radial"), 0.0, 0.1) << rings;
        const double S = mean_of(halves, "neighbours");
        EXPECT_GT(S, last);  // 1 is the limit as the interface becomes a smaller part
        last = S;
    }
    EXPECT_GT(last, 0.85);
}

TEST(Segregation, OfAlternatingRowsIsNegative) {
    const Segregation rows = measured(with_large(small_discs(8), [](const Vec2& p, std::size_t) {
        return static_cast<int>(std::lround(p.y / std::sqrt(3.0))) % 2 != 0;
    }));
    // Of six neighbours four are unlike, of two random ones one in two: S = 1 − (2/3)/(1/2).
    EXPECT_NEAR(mean_of(rows, "neighbours"), -1.0 / 3.0, 0.06);
}

TEST(Segregation, OfEqualDiscsIsNotAvailable) {
    const Segregation equal = measured(small_discs(3));
    for (const char* row : {"radial", "neighbours", "small_distance", "large_distance"})
        EXPECT_TRUE(std::isnan(mean_of(equal, row))) << row;
}

TEST(Segregation, UsesMassesIfRadiiAreEqual) {
    Snapshot s = small_discs(6);
    for (std::size_t i = 0; i < s.size(); ++i) {
        const Vec2 p = s.position(i) - s.container_centre;
        s.mass[i] = dot(p, p) > 5.5 * 5.5 ? 2.0 : 1.0;
    }
    EXPECT_EQ(mean_of(measured(s), "radial"), 1.0);
}

TEST(Segregation, DoesNotDependOnWhenStatesAreStored) {
    const Snapshot s =
        with_large(random_discs(30, 3, 0.4), [](const Vec2&, std::size_t i) { return i % 3 == 0; });
    Snapshot t = s;
    for (std::size_t i = 0; i < t.size(); ++i) t.radius[i] = i % 3 == 0 ? 0.9 : 0.5;
    EXPECT_NEAR(mean_of(measured(t), "small_distance"),
                mean_of(measured(held_earlier(t)), "small_distance"), 1e-12);
}

}  // namespace
}  // namespace swirl
