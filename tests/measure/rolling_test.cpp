#include "swirl/measure/rolling.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "measure/snapshots.hpp"
#include "swirl/physics/collision_law.hpp"

namespace swirl {
namespace {

void add_sphere(Snapshot& s, const Vec2& position, const Vec2& velocity, const Vec2& rolling) {
    const std::size_t i = s.size();
    s.resize_for_spheres(i + 1);
    s.set(i, {position, velocity, 0.0, 0.0, s.clock, 1.0, 1.0, 0.4});
    s.set_floor_motion(i, rolling, {0.0, 0.0});
}
void add_rolling(Snapshot& s, const Vec2& position, const Vec2& velocity) {
    add_sphere(s, position, velocity, spin_of_rolling(velocity - s.container_velocity, 1.0));
}

Rolling seen(const Snapshot& s) {
    Rolling rolling;
    rolling.sample_in_lab(s);
    rolling.close_block();
    return rolling;
}

TEST(Rolling, SharesAndSlipAreThoseOfTheSpheres) {
    Snapshot s = empty_container();
    const Vec2 u = s.container_velocity, C = s.container_centre;
    add_rolling(s, C, {0.3, 0.1});
    add_rolling(s, C + Vec2{4.0, 0.0}, u);
    // This sphere is at the wall and slides over the floor with its whole velocity, 0.5.
    add_sphere(s, C + Vec2{0.0, s.container_radius - 1.05}, u + Vec2{0.3, 0.4}, {0.0, 0.0});
    const Rolling r = seen(s);
    EXPECT_DOUBLE_EQ(row_of(r, "rolling_share").mean, 2.0 / 3.0);
    EXPECT_DOUBLE_EQ(row_of(r, "wall_rolling_share").mean, 0.0);
    EXPECT_NEAR(row_of(r, "floor_slip").mean, 0.5 / 3.0, 1e-15);
}

// Two spheres that move side by side roll alike, and their contact does not slip. If one follows
// the other, the contact slips with the sum of both speeds. If they approach each other, it does
// not slip.
TEST(Rolling, CorrelationsOfAPairAreExact) {
    const auto pair = [](const Vec2& a, const Vec2& b) {
        Snapshot s = empty_container();
        const Vec2 u = s.container_velocity, C = s.container_centre;
        add_rolling(s, C, u + a);
        add_rolling(s, C + Vec2{2.05, 0.0}, u + b);
        return seen(s);
    };
    const Rolling side_by_side = pair({0.0, 0.5}, {0.0, 0.5}),
                  behind = pair({0.5, 0.0}, {0.5, 0.0}), towards = pair({0.5, 0.0}, {-0.5, 0.0});
    EXPECT_NEAR(row_of(side_by_side, "axis_correlation").mean, 1.0, 1e-15);
    EXPECT_TRUE(std::isnan(row_of(side_by_side, "contact_correlation").mean));
    EXPECT_NEAR(row_of(behind, "axis_correlation").mean, 1.0, 1e-15);
    EXPECT_NEAR(row_of(behind, "contact_correlation").mean, 1.0, 1e-15);
    EXPECT_NEAR(row_of(towards, "axis_correlation").mean, -1.0, 1e-15);
    EXPECT_NEAR(row_of(towards, "contact_correlation").mean, -1.0, 1e-15);
}

// A rolling sphere hits the wall head-on: it slips only vertically. With sufficient friction 2/7 of
// its spin remain. The energy ½ I ω² (1 − 4/49) is lost, including the part that lifted the sphere.
TEST(Rolling, VerticalFrictionAtTheWallDissipatesTheEnergyOfTheSpin) {
    Snapshot s = empty_container();
    const Vec2 n{1.0, 0.0};
    add_sphere(s, s.container_centre + (s.container_radius - 1.0) * n, {0.8, 0.0}, {0.0, 0.8});
    s.container_velocity = {0.0, 0.0};
    SphereBody ball{{{0.8, 0.0}, 0.0, 1.0, 1.0, 2.5}, {0.0, 0.8}}, wall = wall_for_spheres({0, 0});
    const Impulse J = collide(ball, wall, n, Surface{.mu = 100.0});
    s.set_floor_motion(0, ball.rolling_spin, {0.0, 0.0});
    Rolling r;
    r.sample_in_lab(s);
    r.sample_event({0, s.clock, EventKind::disc_wall, 0, 0, n, J, 0.0}, s);
    r.close_event_block(2.0, 1);
    EXPECT_NEAR(row_of(r, "vertical_power_at_wall").mean, 0.5 * 0.4 * 0.64 * (45.0 / 49.0) / 2.0,
                1e-15);
    EXPECT_DOUBLE_EQ(row_of(r, "vertical_share_at_wall").mean, 1.0);
    EXPECT_NEAR(row_of(r, "vertical_friction_at_wall").mean, std::abs(J.vertical) / J.normal,
                1e-15);
    EXPECT_TRUE(std::isnan(row_of(r, "vertical_share").mean));
}

TEST(Rolling, IsNaNForDiscs) {
    const Rolling r = seen(random_discs(9, 1));
    EXPECT_TRUE(std::isnan(row_of(r, "rolling_share").mean));
    EXPECT_TRUE(std::isnan(row_of(r, "vertical_power").mean));
}

}  // namespace
}  // namespace swirl
