#include "swirl/measure/collision_angles.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "measure/snapshots.hpp"
#include "swirl/physics/collision_law.hpp"

namespace swirl {
namespace {

TEST(CollisionAngles, FindTheVelocitiesBeforeTheCollisionFromThoseAfterIt) {
    // i at rest; j comes from the right with impact parameter b σ, moving in −x.
    for (const double b : {-0.9, -0.3, 0.0, 0.5}) {
        const Vec2 n{std::sqrt(1.0 - b * b), b};
        const Vec2 g{-0.7, 0.0};  // (n × g)/|g| = n_y = b
        const double normal = -2.0 * dot(g, n) / (1.0 / 2.0 + 1.0 / 3.0), tangential = 0.15;
        const Vec2 J = normal * n + tangential * Vec2{n.y, -n.x};
        Snapshot after = empty_container(0.6);
        add_disc(after, {0.0, 0.0}, Vec2{0.2, 0.1} - (1.0 / 2.0) * J, 0.0, 1.0, 2.0);
        add_disc(after, 2.0 * n, Vec2{0.2, 0.1} + g + (1.0 / 3.0) * J, 0.0, 1.0, 3.0);
        const Event event{0, 0.0, EventKind::disc_disc, 0, 1, n, {normal, tangential, false}, 0.0};
        EXPECT_NEAR(impact_parameter(event, after), b, 1e-14);
    }
}

TEST(CollisionAngles, AtTheWallCounterClockwiseIsPositive) {
    for (const double b : {-0.8, 0.0, 0.6}) {
        Snapshot after = empty_container(0.25);
        const Vec2 n = unit_circle(0.1), along = perpendicular(n);
        const Vec2 relative =
            std::sqrt(1.0 - b * b) * n + b * along;  // velocity before, towards the wall
        const double normal = 2.0 * dot(relative, n), tangential = 0.3;
        const Vec2 J = normal * n + tangential * Vec2{n.y, -n.x};
        add_disc(after, after.container_centre + 7.6 * n, after.container_velocity + relative - J);
        const Event event{0, 0.0, EventKind::disc_wall, 0, 0, n, {normal, tangential, false}, 0.0};
        EXPECT_NEAR(impact_parameter(event, after), b, 1e-14);
    }
}

Event contact(const Vec2& n) {
    return {0, 0.0, EventKind::disc_disc, 0, 1, n, {0.0, 0.0, false}, 0.0};
}

TEST(CollisionAngles, AreNormalisedPerCollision) {
    CollisionAngles angles;
    Snapshot after = empty_container(0.0);  // down is +x of the lab
    const MFrame f = m_frame(after);
    add_disc(after, {0.0, 0.0}, {0.0, 0.0});
    add_disc(after, {2.0, 0.0}, {0.0, 0.0});
    for (int k = 0; k < 4; ++k) {
        // Head-on along 45° of the M-frame, and, from the other disc, along 225°.
        const Vec2 n = f.rotate_back(unit_circle(0.125 + (k % 2) * 0.5));
        after.vx[1] = -n.x;
        after.vy[1] = -n.y;
        angles.sample_event(contact(n), after);
    }
    angles.sample_event({0, 0.0, EventKind::path_vertex, 0, 0, {}, {}, 0.0}, after);
    angles.close_event_block(1.0);
    EXPECT_NEAR(row_of(angles, "impact").mean, 0.0, 1e-15);
    double sum = 0.0, directions = 0.0;
    for (std::size_t k = 0; k < CollisionAngles::bins; ++k)
        sum += angles.density(k).mean * 2.0 / CollisionAngles::bins;
    for (std::size_t k = 0; k < CollisionAngles::direction_bins; ++k)
        directions += angles.direction_density(k).mean / CollisionAngles::direction_bins;
    EXPECT_NEAR(sum, 1.0, 1e-14);
    EXPECT_NEAR(directions, 1.0, 1e-14);
    // 45° is the lower end of bin 9, up to rounding.
    EXPECT_NEAR(angles.direction_density(8).mean + angles.direction_density(9).mean, 36.0, 1e-12);
    EXPECT_TRUE(std::isnan(row_of(angles, "wall_impact").mean));
    EXPECT_TRUE(std::isnan(angles.wall_density(3).mean));
}

TEST(CollisionAngles, OmitACollisionWithoutARelativeVelocity) {
    CollisionAngles angles;
    Snapshot after = empty_container(0.0);
    add_disc(after, {0.0, 0.0}, {0.1, 0.0});
    add_disc(after, {2.0, 0.0}, {0.1, 0.0});
    angles.sample_event(contact({1.0, 0.0}), after);
    angles.close_event_block(1.0);
    EXPECT_TRUE(std::isnan(row_of(angles, "impact").mean));
}

}  // namespace
}  // namespace swirl
