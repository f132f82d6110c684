#include "swirl/measure/slip.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "measure/snapshots.hpp"
#include "swirl/physics/rolling_ball.hpp"

namespace swirl {
namespace {

/// Of the wall at p, in the M-frame.
Vec2 wall_velocity(const MFrame& f, const Vec2& p) { return -f.omega * perpendicular(p); }

/// A full rim of discs along the wall that follows the wall with the fraction `grip` of its speed.
Snapshot rim(double u, double grip, int discs = 23) {
    Snapshot s = empty_container(u);
    const MFrame f = m_frame(s);
    for (int k = 0; k < discs; ++k) {
        const Vec2 p = (R - 1.0) * unit_circle(static_cast<double>(k) / discs);
        add_disc(s, f.lab_position(p), f.lab_velocity(p, grip * wall_velocity(f, p)));
    }
    return s;
}

TEST(Slip, IsOneForARimThatMovesWithTheWall) {
    Slip slip(1);
    const std::vector<std::uint8_t> everybody(23, 1);
    for (int k = 0; k < 10; ++k) {
        slip.sample(rim(k / 10.0, 1.0), everybody);
        slip.close_block();
    }
    // The band around 23 discs is a polygon with rounded corners, a little shorter than the wall.
    const double P = 23.0 * 2.0 * (R - 1.0) * std::sin(pi / 23.0) + 2.0 * pi;
    const double s = P / (2.0 * pi * R);
    EXPECT_NEAR(s, 1.0, 0.003);
    EXPECT_NEAR(row_of(slip, "cluster").mean, s, 1e-13);
    EXPECT_NEAR(row_of(slip, "pinned_region").mean, s, 1e-13);
    EXPECT_NEAR(row_of(slip, "cluster_perimeter").mean, P, 1e-12);
    EXPECT_NEAR(row_of(slip, "pancake").mean, 1.0 - 1.0 / s, 1e-13);
}

TEST(Slip, IsTheSpeedRelativeToTheWall) {
    for (const double grip : {0.0, 0.5}) {
        Slip half(1), whole(1);
        half.sample(rim(0.1, grip));
        half.close_block();
        whole.sample(rim(0.1, 1.0));
        whole.close_block();
        EXPECT_NEAR(row_of(half, "cluster").mean, grip * row_of(whole, "cluster").mean, 1e-13);
        EXPECT_TRUE(std::isnan(row_of(half, "pinned_region").mean));
    }
}

// Two opposite discs of the 24 on the rim are at rest in the M-frame, and these are pinned.
TEST(Slip, ThePinnedRegionHasTheRotationOfThePinnedDiscs) {
    Snapshot s = rim(0.3, 1.0, 24);
    const MFrame f = m_frame(s);
    std::vector<std::uint8_t> pinned(24, 0);
    for (const std::size_t i : {3u, 15u}) {
        const Vec2 p = f.position(s.position(i));
        s.set(i, {s.position(i), f.lab_velocity(p, {}), 0.0, 0.0, s.clock, 1.0, 1.0, 10.0});
        pinned[i] = 1;
    }
    Slip slip(1), rims(1);
    slip.sample(s, pinned);
    rims.sample(rim(0.3, 1.0, 24));
    slip.close_block();
    rims.close_block();
    EXPECT_NEAR(row_of(slip, "pinned_region").mean, 0.0, 1e-13);
    EXPECT_NEAR(row_of(slip, "cluster").mean, 22.0 / 24.0 * row_of(rims, "cluster").mean, 1e-13);
}

TEST(Slip, RotationsOfBothSignsCancel) {
    Slip slip(1);
    for (const double grip : {1.0, -1.0}) slip.sample(rim(0.3, grip));
    slip.close_block();
    EXPECT_NEAR(row_of(slip, "cluster").mean, 0.0, 1e-13);
}

TEST(Slip, OnlyPinnedDiscsCountForThePinnedRegion) {
    Snapshot s = rim(0.3, 1.0);
    const Snapshot still = rim(0.3, 0.0);
    // Every other pair of opposite discs at rest in the M-frame would move the centre of mass;
    // flags alone decide here.
    std::vector<std::uint8_t> pinned(23, 0);
    pinned[4] = 1;
    Slip slip(1);
    slip.sample(s, pinned);
    slip.close_block();
    EXPECT_NEAR(row_of(slip, "pinned_region").mean, row_of(slip, "cluster").mean, 1e-13);
    Slip none(1);
    none.sample(still, pinned);
    none.close_block();
    EXPECT_NEAR(row_of(none, "pinned_region").mean, 0.0, 1e-13);
}

// Two discs half a radius from the centre of mass, one on each side, turn about it 40 times as fast
// as the rim: they do not count. Two at one and a half radii do.
TEST(Slip, OmitsADiscWithinItsRadiusOfTheCentreOfMass) {
    for (const double distance : {0.5, 1.5}) {
        Snapshot s = rim(0.3, 1.0);
        const MFrame f = m_frame(s);
        for (const double sign : {1.0, -1.0}) {
            const Vec2 p{sign * distance, 0.0};
            add_disc(s, f.lab_position(p), f.lab_velocity(p, 40.0 * wall_velocity(f, p)));
        }
        Slip slip(1), rims(1);
        slip.sample(s);
        rims.sample(rim(0.3, 1.0));
        slip.close_block();
        rims.close_block();
        const double counted = distance < 1.0 ? 1.0 : (23.0 + 2.0 * 40.0) / 25.0;
        EXPECT_NEAR(row_of(slip, "cluster").mean, counted * row_of(rims, "cluster").mean, 1e-12);
    }
}

// A disc in the wall layer counts from the first sample of a residence on, once it has
// lasted long enough. A disc that flies along far inside never counts, even if it is pinned by the
// SI's criterion.
TEST(Slip, ResidentRegionHasOnlyResidentDiscs) {
    constexpr int samples = 511;
    for (const bool long_enough : {true, false}) {
        Slip slip(1), rims(1);
        LongResidences residences;
        for (int k = 0; k < 60; ++k) {
            const double u = static_cast<double>(k) / samples;
            Snapshot s = rim(u, 1.0, k < (long_enough ? 45 : 30) ? 23 : 0);
            const MFrame f = m_frame(s);
            while (s.size() < 27) {
                const Vec2 p = 3.0 * unit_circle(0.25 * static_cast<double>(s.size()));
                add_disc(s, f.lab_position(p), f.lab_velocity(p, {}));
            }
            residences.sample(s);
            slip.sample(s, std::vector<std::uint8_t>(27, 1));
            slip.sample_residences(residences);
        }
        rims.sample(rim(0.0, 1.0));
        slip.close_block();
        rims.close_block();
        // Four discs at rest inside, placed symmetrically, do not change the ϖ of the rim.
        if (long_enough) {
            EXPECT_NEAR(row_of(slip, "resident").mean, row_of(rims, "cluster").mean, 1e-9);
        } else {
            EXPECT_TRUE(std::isnan(row_of(slip, "resident").mean));
        }
        EXPECT_LT(row_of(slip, "pinned_region").mean, 0.9 * row_of(rims, "cluster").mean);
    }
}

TEST(Slip, ThePancakeRollsLikeTheMinimalModel) {
    const RollingBall ball{R, 6.0, 1.0};
    EXPECT_NEAR(pancake_rotation(2.0 * pi * 6.0, 2.0 * pi * R), ball.rotation(), 1e-15);
    EXPECT_EQ(pancake_rotation(10.0, 10.0), 0.0);
}

TEST(Slip, IsNaNWithoutDiscsForOneDiscAndForNaN) {
    Slip slip(1);
    slip.sample(empty_container());
    slip.close_block();
    EXPECT_TRUE(std::isnan(row_of(slip, "cluster").mean));
    EXPECT_TRUE(std::isnan(cluster_perimeter(empty_container())));
    Snapshot s = empty_container();
    add_disc(s, {1.0, 1.0}, {0.0, 0.0});
    EXPECT_NEAR(cluster_perimeter(s), 2.0 * pi, 1e-15);
    slip.sample(s);
    s.x[0] = not_available;
    slip.sample(s);
    slip.close_block();
    EXPECT_TRUE(std::isnan(row_of(slip, "cluster").mean));
    EXPECT_NEAR(row_of(slip, "cluster_perimeter").mean, 2.0 * pi, 1e-15);
}

TEST(Slip, UsesEvery64thSample) {
    Slip slip;
    for (int k = 0; k < 128; ++k) slip.sample(rim(0.1, k % 64 == 0 ? 1.0 : 0.3));
    slip.close_block();
    EXPECT_NEAR(row_of(slip, "cluster").mean, 1.0, 0.003);
}

}  // namespace
}  // namespace swirl
