#include "swirl/measure/angular_profile.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "measure/snapshots.hpp"

namespace swirl {
namespace {

TEST(AngularProfile, DiscsThatMoveWithTheWallHaveMinusOneEverywhere) {
    AngularProfile profile(36);
    for (int k = 0; k < 30; ++k) {
        Snapshot s = random_discs(40, k, k / 30.0);
        for (std::size_t i = 0; i < s.size(); ++i) {
            s.vx[i] = s.container_velocity.x;
            s.vy[i] = s.container_velocity.y;
        }
        profile.sample(s);
        profile.close_block();
    }
    for (std::size_t k = 0; k < profile.slices(); ++k) {
        ASSERT_GT(profile.visits(k), 0.0);
        EXPECT_NEAR(profile.plain(k).mean, -1.0, 1e-12);
        EXPECT_NEAR(profile.wall(k).mean, -1.0, 1e-12);
        EXPECT_NEAR(profile.normalised(k).mean, 1.0, 1e-12);
    }
}

TEST(AngularProfile, AClusterAtRestInTheLabAndAWallSeenFromOffCentre) {
    // Discs at rest in the M-frame: ϖ_M,i = 0 there. The wall passes the centre of mass at
    // −Ω (d·p)/d², d = p − r_cm; for a slice at θ with the centre of mass at (0, −h).
    AngularProfile profile(4);
    Snapshot s = empty_dish(0.2);
    const MFrame f = m_frame(s);
    const double h = 3.0;
    const auto rest = [&](const Vec2& p) {
        add_disc(s, f.lab_position(p), f.lab_velocity(p, {0.0, 0.0}));
    };
    rest({0.1, -h});
    rest({-0.1, -h});
    rest({2.0, 1e-9});
    rest({-2.0, -2.0 * h - 1e-9});
    const MFrameView view(s);
    ASSERT_NEAR(view.centre_of_mass().position.x, 0.0, 1e-14);
    ASSERT_NEAR(view.centre_of_mass().position.y, -1.5 * 2.0, 1e-9);
    profile.sample(view);
    profile.close_block();
    EXPECT_NEAR(profile.plain(0).mean, 0.0, 1e-12);
    // θ = 0: p = (R, 0), d = (R, h), d·p = R², so −R²/(R² + h²).
    const double R = paper_container_radius;
    EXPECT_NEAR(profile.wall(0).mean, -R * R / (R * R + h * h), 1e-9);
    EXPECT_NEAR(profile.theta(0), pi / 4.0, 1e-15);
    EXPECT_TRUE(std::isnan(profile.plain(1).mean));
}

TEST(AngularProfile, NothingAndOneDiscAreNoProfile) {
    AngularProfile profile(8);
    profile.sample(empty_dish());
    Snapshot s = empty_dish();
    add_disc(s, {3.0, 1.0}, {0.0, 0.0});
    profile.sample(s);
    profile.close_block();
    for (std::size_t k = 0; k < 8; ++k) EXPECT_TRUE(std::isnan(profile.normalised(k).mean));
}

}  // namespace
}  // namespace swirl
