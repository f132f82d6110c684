#include "swirl/measure/container_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "measure/snapshots.hpp"

namespace swirl {
namespace {

TEST(ContainerFit, WallGapIsThatOfTheOutermostDisc) {
    Snapshot s = empty_container(0.2);
    EXPECT_EQ(wall_gap(s), paper_container_radius);
    add_disc(s, s.container_centre + Vec2{0.0, 3.0}, {});
    add_disc(s, s.container_centre + Vec2{-7.0, 0.0}, {}, 0.0, 1.25);
    EXPECT_NEAR(wall_gap(s), paper_container_radius - 8.25, 1e-14);
    EXPECT_NEAR(wall_gap(held_earlier(s)), paper_container_radius - 8.25, 1e-14);
    add_disc(s, s.container_centre + Vec2{0.0, -9.0}, {});
    EXPECT_NEAR(wall_gap(s), paper_container_radius - 10.0, 1e-14);
}

TEST(ContainerFit, ClosestPairEqualsThatOfAllPairs) {
    EXPECT_EQ(closest_pair(empty_container()), never);
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        Snapshot s = random_discs(40, seed);
        Noise noise(seed);
        for (double& radius : s.radius) radius = 1.0 + 0.6 * noise();
        double minimum = never;
        for (std::size_t i = 0; i < s.size(); ++i)
            for (std::size_t j = i + 1; j < s.size(); ++j) {
                const Vec2 d = s.position(i) - s.position(j);
                minimum = std::min(minimum, std::hypot(d.x, d.y) / (s.radius[i] + s.radius[j]));
            }
        EXPECT_NEAR(closest_pair(s), minimum, 1e-13);
    }
}

/// Discs all along the wall of a container that began at this angle and moves in this direction.
/// The snapshots give another position of the container.
FittingPhase seen(double degrees, double sense) {
    FittingPhase fit;
    for (int k = 0; k < 50; ++k) {
        Snapshot s = empty_container(k / 50.0);
        const Vec2 centre = paper_amplitude * unit_circle(degrees / 360.0 + sense * k / 50.0);
        for (int d = 0; d < 12; ++d)
            add_disc(s, centre + (paper_container_radius - 1.0) * unit_circle(d / 12.0), {});
        fit.sample(s);
    }
    return fit;
}

TEST(ContainerFit, PhaseIsFoundIfDiscsTouchTheWall) {
    for (const double degrees : {0.0, 47.0, 301.0}) {
        const FittingPhase fit = seen(degrees, 1.0);
        EXPECT_NEAR(fit.best().phase * 180.0 / pi, degrees, 1e-9);
        EXPECT_LT(fit.best().protrusion, 1e-20);
        EXPECT_GT(fit.best(true).protrusion, 100.0);
        EXPECT_EQ(fit.protrusion() < 1e-20, degrees == 0.0);
    }
    const FittingPhase reverse = seen(120.0, -1.0);
    EXPECT_NEAR(reverse.best(true).phase * 180.0 / pi, 120.0, 1e-9);
    EXPECT_LT(reverse.best(true).protrusion, 1e-20);
}

TEST(ContainerFit, PhaseIsTheMiddleOfThoseThatFit) {
    FittingPhase fit;
    Snapshot s = empty_container();
    add_disc(s, paper_amplitude * unit_circle(90.0 / 360.0) + 7.5 * unit_circle(0.25), {});
    fit.sample(s);
    EXPECT_NEAR(fit.best().phase * 180.0 / pi, 90.0, 1e-9);
}

}  // namespace
}  // namespace swirl
