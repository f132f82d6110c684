#include "swirl/measure/spin_frustration.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "measure/snapshots.hpp"

namespace swirl {
namespace {

/// A square lattice whose discs spin like gears.
Snapshot gears(double sign = -1.0) {
    Snapshot s = empty_container(0.2);
    for (int row = -1; row <= 1; ++row)
        for (int column = -1; column <= 1; ++column) {
            const bool odd = ((row + column) & 1) != 0;
            add_disc(s, s.container_centre + Vec2{2.0 * column, 2.0 * row}, {0.0, 0.0},
                     odd ? 0.7 * sign : 0.7);
        }
    return s;
}

/// A disc and its six neighbours, all touching, all with the same spin.
Snapshot hexagon(double spin) {
    Snapshot s = empty_container(0.4);
    add_disc(s, s.container_centre, {0.0, 0.0}, spin);
    for (int k = 0; k < 6; ++k)
        add_disc(s, s.container_centre + 2.0 * unit_circle(k / 6.0), {0.0, 0.0}, spin);
    return s;
}

TEST(SpinFrustration, GearsHaveMinusOneAndNoTriangles) {
    SpinFrustration frustration(0.1, 1);
    frustration.sample(gears());
    frustration.close_block();
    EXPECT_NEAR(row_of(frustration, "spin_correlation").mean, -1.0, 1e-15);
    EXPECT_EQ(row_of(frustration, "triangles").mean, 0.0);
    EXPECT_NEAR(row_of(frustration, "coordination").mean, 24.0 / 9.0, 1e-15);
}

TEST(SpinFrustration, IsOneForARigidlyRotatingTriangularBody) {
    SpinFrustration frustration(0.1, 1);
    frustration.sample(hexagon(0.3));
    frustration.close_block();
    EXPECT_NEAR(row_of(frustration, "spin_correlation").mean, 1.0, 1e-15);
    EXPECT_EQ(row_of(frustration, "triangles").mean, 1.0);
    EXPECT_NEAR(row_of(frustration, "coordination").mean, 24.0 / 7.0, 1e-15);
}

// A chain of gears can roll; a triangle of equal spins cannot. Both in one sample stay apart.
TEST(SpinFrustration, SeparatesPairsInTrianglesFromOthers) {
    Snapshot s = empty_container(0.4);
    for (int k = 0; k < 3; ++k)
        add_disc(s, s.container_centre + Vec2{2.0 * k, 0.0}, {0.0, 0.0}, k % 2 ? -0.5 : 0.5);
    const Vec2 corner = s.container_centre + Vec2{-4.0, -4.0};
    for (int k = 0; k < 3; ++k)
        add_disc(s, corner + (2.0 / std::sqrt(3.0)) * unit_circle(k / 3.0), {0.0, 0.0}, 0.3);
    SpinFrustration frustration(0.1, 1);
    frustration.sample(s);
    frustration.close_block();
    EXPECT_EQ(row_of(frustration, "chain_correlation").mean, -1.0);
    EXPECT_EQ(row_of(frustration, "triangle_correlation").mean, 1.0);
    EXPECT_EQ(row_of(frustration, "triangles").mean, 0.6);
}

TEST(SpinFrustration, IsZeroForIndependentSpins) {
    SpinFrustration frustration(0.1, 1);
    Noise noise(4);
    for (int k = 0; k < 400; ++k) {
        Snapshot s = hexagon(0.0);
        for (double& spin : s.spin) spin = noise();
        frustration.sample(s);
        frustration.close_block();
    }
    EXPECT_NEAR(row_of(frustration, "spin_correlation").mean, 0.0,
                4.0 * row_of(frustration, "spin_correlation").error);
    EXPECT_LT(row_of(frustration, "spin_correlation").error, 0.02);
}

TEST(SpinFrustration, WallSpinIsOfTheDiscsAtTheWallAndOfThePinnedOnes) {
    Snapshot s = empty_container(0.7);
    add_disc(s, s.container_centre + 7.6 * unit_circle(0.1), {0.0, 0.0}, -2.0 * Omega);
    add_disc(s, s.container_centre + 7.55 * unit_circle(0.4), {0.0, 0.0}, 0.0);
    add_disc(s, s.container_centre + Vec2{1.0, 0.0}, {0.0, 0.0}, 9.0 * Omega);
    const std::vector<std::uint8_t> pinned{0, 1, 1};
    SpinFrustration frustration(0.1, 1);
    frustration.sample(s, pinned);
    frustration.close_block();
    EXPECT_NEAR(row_of(frustration, "wall_spin").mean, 1.0, 1e-15);
    EXPECT_EQ(row_of(frustration, "pinned_wall_spin").mean, 0.0);
    EXPECT_TRUE(std::isnan(row_of(frustration, "spin_correlation").mean));
}

TEST(SpinFrustration, CountsTheCollisionsThatStick) {
    SpinFrustration frustration(0.1, 1);
    const auto collide = [&](EventKind kind, bool sticks) {
        frustration.sample_event(Event{0, 0.0, kind, 0, 0, {1.0, 0.0}, {1.0, 0.1, sticks}, 0.0},
                                 gears());
    };
    collide(EventKind::disc_disc, true);
    collide(EventKind::disc_disc, true);
    collide(EventKind::disc_disc, false);
    collide(EventKind::disc_disc, false);
    collide(EventKind::disc_wall, true);
    collide(EventKind::path_vertex, false);
    frustration.close_block();
    EXPECT_EQ(row_of(frustration, "disc_sticking").mean, 0.5);
    EXPECT_EQ(row_of(frustration, "wall_sticking").mean, 1.0);
}

TEST(SpinFrustration, IsNaNForMissingSpinsAndWithoutDiscs) {
    SpinFrustration frustration(0.1, 1);
    frustration.sample(empty_container());
    frustration.close_block();
    EXPECT_TRUE(std::isnan(row_of(frustration, "wall_spin").mean));
    EXPECT_TRUE(std::isnan(row_of(frustration, "triangles").mean));
    Snapshot s = hexagon(0.3);
    s.spin[2] = not_available;
    frustration.sample(s);
    frustration.close_block();
    EXPECT_TRUE(std::isnan(row_of(frustration, "spin_correlation").mean));
    EXPECT_EQ(row_of(frustration, "triangles").mean, 1.0);
}

TEST(SpinFrustration, UsesEvery64thSample) {
    SpinFrustration frustration;
    for (int k = 0; k < 128; ++k) frustration.sample(k % 64 == 0 ? gears() : hexagon(0.3));
    frustration.close_block();
    EXPECT_NEAR(row_of(frustration, "spin_correlation").mean, -1.0, 1e-15);
}

TEST(TouchingPairs, EqualThoseOfAnExhaustiveSearch) {
    TouchingPairs touching;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        Snapshot s = random_discs(50, seed, 0.05 * static_cast<double>(seed));
        Noise noise(seed);
        for (double& r : s.radius) r = 0.6 + 0.4 * noise();
        const MFrameView view(s);
        std::vector<std::pair<unsigned, unsigned>> found, expected;
        for (const Pair& p : touching.find(view, 0.2))
            found.emplace_back(std::min(p.i, p.j), std::max(p.i, p.j));
        for (unsigned i = 0; i < s.size(); ++i)
            for (unsigned j = i + 1; j < s.size(); ++j) {
                const Vec2 d = view.position(j) - view.position(i);
                if (std::hypot(d.x, d.y) < s.radius[i] + s.radius[j] + 0.2)
                    expected.emplace_back(i, j);
            }
        std::sort(found.begin(), found.end());
        EXPECT_EQ(found, expected);
        EXPECT_FALSE(found.empty());
    }
}

// Two strong collisions of gears and a weak one of discs that spin alike: (−2·2 + 1·1)/(2·2 + 1·1).
TEST(SpinFrustration, CollisionsAreWeightedWithTheirImpulse) {
    SpinFrustration frustration;
    Snapshot pair = empty_container();
    add_disc(pair, {0.0, 0.0}, {}, 0.5);
    add_disc(pair, {2.0, 0.0}, {}, -0.5);
    Event hit{0, 0.0, EventKind::disc_disc, 0, 1, {1.0, 0.0}, {2.0, 0.0, false}, 0.0};
    frustration.sample_event(hit, pair);
    frustration.sample_event(hit, pair);
    pair.spin[1] = 0.5;
    hit.impulse.normal = 1.0;
    frustration.sample_event(hit, pair);
    hit.kind = EventKind::disc_wall;  // the wall does not spin
    frustration.sample_event(hit, pair);
    frustration.close_block();
    EXPECT_NEAR(row_of(frustration, "correlation_by_impulse").mean, -0.6, 1e-12);
}

/// Three discs in a chain along the wall, where they stay, and a fourth that touches the last from
/// inside.
Snapshot along_the_wall(int k) {
    Snapshot s = empty_container(k / 511.0);
    const MFrame f = m_frame(s);
    const auto add = [&](double radius, double angle, double spin) {
        const Vec2 p = radius * unit_circle(angle / (2.0 * pi));
        add_disc(s, f.lab_position(p), f.lab_velocity(p, {}), spin);
    };
    const double step = 2.0 * std::asin(2.02 / (2.0 * 7.55));  // two centres 2.02 apart
    add(7.55, 0.0, 0.5 * Omega);
    add(7.55, step, -0.5 * Omega);
    add(7.55, 2.0 * step, 0.5 * Omega);
    add(5.53, 2.0 * step, 0.5 * Omega);
    return s;
}

TEST(SpinFrustration, ResidentSpinIsKnownAfterTheMinimumLength) {
    SpinFrustration frustration(0.1, 1);
    LongResidences residences;
    for (int k = 0; k < 45; ++k) {
        residences.sample(along_the_wall(k));
        frustration.sample(along_the_wall(k));
        frustration.sample_residences(residences);
        frustration.close_block();
        EXPECT_EQ(std::isnan(row_of(frustration, "resident_spin").mean), k < 40) << k;
    }
    EXPECT_NEAR(row_of(frustration, "resident_spin").mean, 0.5, 1e-12);
    // The fourth, which spins like its neighbour, is not resident.
    EXPECT_NEAR(row_of(frustration, "along_wall").mean, -1.0, 1e-12);
    EXPECT_NEAR(row_of(frustration, "resident_correlation").mean, -1.0 / 3.0, 1e-12);
    EXPECT_NEAR(row_of(frustration, "spin_correlation").mean, -1.0 / 3.0, 1e-12);
}

TEST(SpinFrustration, PairsOfPinnedDiscsAreSeparate) {
    SpinFrustration frustration(0.1, 1);
    Snapshot chain = empty_container();
    add_disc(chain, {0.0, 0.0}, {}, 0.5);
    add_disc(chain, {2.05, 0.0}, {}, -0.5);
    add_disc(chain, {4.1, 0.0}, {}, -0.5);
    frustration.sample(chain, std::vector<std::uint8_t>{1, 1, 0});
    frustration.close_block();
    EXPECT_NEAR(row_of(frustration, "pinned_correlation").mean, -1.0, 1e-12);
    EXPECT_NEAR(row_of(frustration, "spin_correlation").mean, 0.0, 1e-12);
}

}  // namespace
}  // namespace swirl
