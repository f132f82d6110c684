#include "swirl/measure/cluster_centre.hpp"

#include <gtest/gtest.h>

#include "measure/snapshots.hpp"

namespace swirl {
namespace {

/// A container with discs at rest at these positions in the M-frame.
Snapshot resting_at(const std::vector<Vec2>& places, double u = 0.0) {
    Snapshot s = empty_container(u);
    const MFrame frame = m_frame(s);
    for (const Vec2& p : places) add_disc(s, frame.lab_position(p), frame.lab_velocity(p, {}));
    return s;
}

TEST(ClusterCentre, CentreLeftOfMHasASmallerTheta) {
    for (const double u : {0.0, 0.3, 0.8}) {
        ClusterCentre centre(1);
        // At 240°: 30° clockwise of M.
        const Vec2 c{-2.0, -2.0 * std::sqrt(3.0)};
        centre.sample(resting_at({c + Vec2{1.5, 0.0}, c - Vec2{1.5, 0.0}}, u));
        centre.close_block();
        EXPECT_NEAR(row_of(centre, "x").mean, -2.0, 1e-9);
        EXPECT_NEAR(row_of(centre, "distance").mean, 4.0, 1e-9);
        EXPECT_NEAR(centre.direction().angle().mean * degrees_per_radian, 240.0, 1e-9);
        EXPECT_EQ(row_of(centre, "left").mean, 1.0);
    }
}

TEST(ClusterCentre, ElongationIsTheRatioOfTheAxes) {
    ClusterCentre centre(1);
    // Mean squares 9/2 and 1/2: three times as long as wide, in any direction.
    const Vec2 along = unit_circle(0.1), across = perpendicular(along);
    centre.sample(resting_at({3.0 * along, -3.0 * along, across, -1.0 * across}));
    centre.close_block();
    EXPECT_NEAR(row_of(centre, "elongation").mean, 3.0, 1e-9);
    ClusterCentre line(1);
    line.sample(resting_at({3.0 * along, -3.0 * along, 0.0 * along}));
    line.close_block();
    EXPECT_TRUE(std::isnan(row_of(line, "elongation").mean));
}

TEST(ClusterCentre, ForcesAtMAndOnADiscThatMovesWithTheWall) {
    Snapshot s = resting_at({{0.0, -7.6}});
    ClusterCentre at_M(1);
    at_M.sample(s);
    at_M.close_block();
    EXPECT_NEAR(row_of(at_M, "centrifugal").mean, Omega * Omega * (7.6 + paper_amplitude), 1e-9);
    EXPECT_NEAR(row_of(at_M, "coriolis").mean, 0.0, 1e-9);
    // A disc at rest relative to the container: in the M-frame it rotates with the wall, at −Ω
    // about C.
    Snapshot dragged = empty_container();
    add_disc(dragged, dragged.container_centre + Vec2{0.0, 5.0}, dragged.container_velocity);
    ClusterCentre with_wall(1);
    with_wall.sample(dragged);
    with_wall.close_block();
    EXPECT_NEAR(row_of(with_wall, "coriolis").mean, 2.0 * Omega * Omega * 5.0, 1e-9);
}

TEST(ClusterCentre, UsesEveryEighthSample) {
    ClusterCentre centre;
    for (int k = 0; k < 17; ++k)
        centre.sample(resting_at({{k == 8 ? 1.0 : k == 16 ? 2.0 : 0.1 * (k % 8), 1.0}}));
    centre.close_block();
    EXPECT_NEAR(row_of(centre, "x").mean, (0.0 + 1.0 + 2.0) / 3.0, 1e-12);
}

TEST(ClusterCentre, IsNaNWithoutSamples) {
    ClusterCentre centre(1);
    centre.sample(empty_container());
    centre.close_block();
    EXPECT_TRUE(std::isnan(row_of(centre, "x").mean));
    EXPECT_TRUE(std::isnan(centre.direction().angle().mean));
}

}  // namespace
}  // namespace swirl
