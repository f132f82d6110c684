#include "swirl/measure/angular_profile.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "measure/snapshots.hpp"

namespace swirl {
namespace {

TEST(AngularProfile, IsMinusOneForDiscsThatMoveWithTheWall) {
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

TEST(AngularProfile, ResolvesTheWallAboutAnOffCentreClusterAtRest) {
    // Discs at rest in the M-frame: ϖ_M,i = 0 there. The wall passes the centre of mass at
    // −Ω (d·p)/d², d = p − r_cm; for a slice at θ with the centre of mass at (0, −h).
    AngularProfile profile(4);
    Snapshot s = empty_container(0.2);
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
    EXPECT_NEAR(profile.wall(0).mean, -R * R / (R * R + h * h), 1e-9);
    EXPECT_NEAR(profile.theta(0), pi / 4.0, 1e-15);
    EXPECT_TRUE(std::isnan(profile.plain(1).mean));
}

TEST(AngularProfile, IsNaNWithoutDiscsAndForOneDisc) {
    AngularProfile profile(8);
    profile.sample(empty_container());
    Snapshot s = empty_container();
    add_disc(s, {3.0, 1.0}, {0.0, 0.0});
    profile.sample(s);
    profile.close_block();
    for (std::size_t k = 0; k < 8; ++k) EXPECT_TRUE(std::isnan(profile.normalised(k).mean));
}

/// Discs at these positions in the M-frame, with velocities relative to the container.
Snapshot discs_at(const std::vector<std::pair<Vec2, Vec2>>& discs) {
    Snapshot s = empty_container(0.2);
    const MFrame f = m_frame(s);
    for (const auto& [place, velocity] : discs)
        add_disc(s, f.lab_position(place), s.container_velocity + f.rotate_back(velocity));
    return s;
}

// Two discs with the same velocity rotate at the rate 0 about their centre of mass (½, 0), so at −Ω
// in the M-frame. There their speed is that of the frame's rotation, Ω·½·|(5, 0)|. The wall at
// (±R, 0) has the velocity −(0.5, 0.2) relative to the centre of mass, and passes it at ∓0.2/(R ∓
// ½).
TEST(AngularProfile, UsesTheVelocityOfTheCentreOfMass) {
    AngularProfile profile(2);
    profile.sample(discs_at({{{3.0, 1e-9}, {0.5, 0.2}}, {{-2.0, -1e-9}, {0.5, 0.2}}}));
    profile.close_block();
    for (const std::size_t k : {0u, 1u}) {
        const double sign = k == 0 ? 1.0 : -1.0;
        EXPECT_NEAR(profile.plain(k).mean, -1.0, 1e-12);
        // The positions are 10⁻⁹ off the axis.
        EXPECT_NEAR(profile.wall(k).mean, -sign * 0.2 / (R - sign * 0.5) / Omega - 1.0, 1e-8);
        EXPECT_NEAR(profile.distance(k).mean, 2.5, 1e-8);
        EXPECT_NEAR(profile.speed(k).mean, 2.5 * Omega, 1e-8);
    }
}

TEST(AngularProfile, OmitsADiscWithinItsRadiusOfTheCentreOfMass) {
    AngularProfile profile(1);
    profile.sample(discs_at({{{4.0, 0.0}, {0.0, 0.0}},
                             {{-4.0, 0.0}, {0.0, 0.0}},
                             {{0.0, 0.9}, {5.0, 0.0}},
                             {{0.0, -0.9}, {-5.0, 0.0}}}));
    profile.close_block();
    EXPECT_EQ(profile.visits(0), 2.0);
    EXPECT_NEAR(profile.plain(0).mean, -1.0, 1e-12);
}

TEST(AngularProfile, NormalisedErrorIsPositive) {
    AngularProfile profile(1);
    for (const double speed : {0.1, 0.3, 0.2}) {
        profile.sample(discs_at({{{4.0, 0.0}, {0.0, speed}}, {{-4.0, 0.0}, {0.0, -speed}}}));
        profile.close_block();
    }
    // The wall rotates at −1 (in units of Ω) in the M-frame, because the centre of mass rests at C.
    EXPECT_NEAR(profile.normalised(0).mean, -profile.plain(0).mean, 1e-12);
    EXPECT_GT(profile.plain(0).error, 0.0);
    EXPECT_NEAR(profile.normalised(0).error, profile.plain(0).error, 1e-12);
}

}  // namespace
}  // namespace swirl
