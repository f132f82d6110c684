#include "swirl/physics/snapshot.hpp"

#include <gtest/gtest.h>

namespace swirl {
namespace {

TEST(Snapshot, ResizingSpheresResizesAllColumns) {
    Snapshot s;
    s.resize_for_spheres(2);
    s.turned.resize(2);
    s.resize(5);
    for (const auto* column : {&s.x, &s.held_at, &s.inertia, &s.spin_x, &s.spin_y, &s.ax, &s.ay})
        EXPECT_EQ(column->size(), 5u);
    EXPECT_EQ(s.turned.size(), 5u);
    Snapshot discs;
    discs.resize(5);
    EXPECT_FALSE(discs.are_spheres());
    EXPECT_TRUE(discs.spin_x.empty() && discs.turned.empty());
}

// All numbers have short binary forms, so nothing is rounded.
Snapshot two_bodies(bool spheres) {
    Snapshot s;
    s.periods = 3;
    s.clock = 3.0;
    s.period = 8.0;
    if (spheres) s.resize_for_spheres(2);
    s.resize(2);
    s.set(0, {{1.0, 2.0}, {2.0, -1.0}, 0.25, 0.5, 1.0, 1.0, 1.0, 2.0});
    s.set(1, {{-4.0, 0.0}, {0.0, 0.0}, 0.0, 0.0, 3.0, 1.0, 1.0, 2.0});
    if (spheres) s.set_floor_motion(0, {0.5, 0.125}, {0.5, -0.25});
    return s;
}

TEST(Snapshot, DiscMovesUniformlyFromItsOwnTime) {
    const Snapshot s = two_bodies(false);
    EXPECT_EQ(s.time(), 27.0);
    EXPECT_EQ(s.position(0).x, 5.0);
    EXPECT_EQ(s.position(0).y, 0.0);
    EXPECT_EQ(s.velocity(0).x, 2.0);
    EXPECT_EQ(s.orientation(0), 1.25);
    EXPECT_EQ(s.position(1).x, -4.0);
}

// x + v t + ½ a t² and v + a t after the time 2.
TEST(Snapshot, SphereMovesAlongItsParabola) {
    const Snapshot s = two_bodies(true);
    EXPECT_EQ(s.position(0).x, 6.0);
    EXPECT_EQ(s.position(0).y, -0.5);
    EXPECT_EQ(s.velocity(0).x, 3.0);
    EXPECT_EQ(s.velocity(0).y, -1.5);
    // m R/I = ½: dω_x/dt = ½ a_y, dω_y/dt = −½ a_x.
    EXPECT_EQ(s.spin_rate(0).x, -0.125);
    EXPECT_EQ(s.spin_rate(0).y, -0.25);
}

TEST(Snapshot, UpToDateKeepsPositionsAndSetsTheTime) {
    for (const bool spheres : {false, true}) {
        const Snapshot s = two_bodies(spheres), now = s.up_to_date();
        for (std::size_t i = 0; i < s.size(); ++i) {
            EXPECT_EQ(now.held_at[i], s.clock);
            EXPECT_EQ(now.x[i], s.position(i).x);
            EXPECT_EQ(now.y[i], s.position(i).y);
            EXPECT_EQ(now.vx[i], s.velocity(i).x);
            EXPECT_EQ(now.vy[i], s.velocity(i).y);
            EXPECT_EQ(now.angle[i], s.orientation(i));
        }
        if (!spheres) continue;
        EXPECT_EQ(now.spin_x[0], 0.25);
        EXPECT_EQ(now.spin_y[0], -0.375);
    }
}

TEST(Snapshot, IsOfDiscsWithoutFloorUnlessSaid) {
    const Snapshot s;
    EXPECT_FALSE(s.on_floor || s.lie_flat || s.are_spheres() || s.are_balls());
    EXPECT_EQ(s.time(), 0.0);
}

}  // namespace
}  // namespace swirl
