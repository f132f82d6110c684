#include "swirl/measure/wall_stress.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "measure/snapshots.hpp"

namespace swirl {
namespace {

/// A disc hits the wall at the angle 2πu_M in the M-frame, at phase u of the period.
void hit(WallStress& stress, double u, double u_M, const Impulse& J) {
    Snapshot s = empty_container(u);
    const MFrame f = m_frame(s);
    const Vec2 n = f.rotate_back(unit_circle(u_M));
    add_disc(s, s.container_centre + (R - 1.0) * n, {0.0, 0.0});
    stress.sample_event({0, s.clock, EventKind::disc_wall, 0, 0, n, J, 0.0}, s);
}

TEST(WallStress, IsImpulsePerLengthAndTimeInItsSlice) {
    WallStress stress(R, 8);
    for (int block = 0; block < 4; ++block) {
        for (const double u : {0.0, 0.3, 0.8}) hit(stress, u, 0.70, {2.0, -0.5, true});
        stress.close_event_block(10.0);
    }
    const double length = 2.0 * pi * R / 8.0;
    EXPECT_NEAR(stress.pressure(5).mean, 6.0 / (10.0 * length), 1e-15);
    // J_t < 0 along the clockwise tangent pushes the wall counter-clockwise.
    EXPECT_NEAR(stress.traction(5).mean, 1.5 / (10.0 * length), 1e-15);
    EXPECT_NEAR(stress.theta(5), 2.0 * pi * 5.5 / 8.0, 1e-15);
    EXPECT_EQ(stress.pressure(0).mean, 0.0);
    EXPECT_NEAR(stress.mean_pressure().mean, 6.0 / (10.0 * 2.0 * pi * R), 1e-15);
}

TEST(WallStress, CountsOnlyWallCollisionsAndIsNaNWithoutTime) {
    WallStress stress(R, 8);
    EXPECT_TRUE(std::isnan(stress.pressure(0).mean));
    Snapshot s = random_discs(2, 1);
    stress.sample_event({0, 0.0, EventKind::disc_disc, 0, 1, {1.0, 0.0}, {9.0, 9.0, false}, 0.0},
                        s);
    stress.sample_event({0, 0.0, EventKind::path_vertex, 0, 0, {1.0, 0.0}, {9.0, 9.0, false}, 0.0},
                        s);
    stress.close_event_block(1.0);
    EXPECT_EQ(stress.mean_pressure().mean, 0.0);
    EXPECT_EQ(stress.mean_traction().mean, 0.0);
}

}  // namespace
}  // namespace swirl
