#include "swirl/measure/velocity_correlation.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "measure/snapshots.hpp"

namespace swirl {
namespace {

// The velocities relative to the centre of mass sum to 0, so Σ over pairs δu_i · δu_j is
// −½ Σ δu_i², for each component: −1/(N − 1) of its mean square, at every distance.
TEST(VelocityCorrelation, IndependentVelocitiesHaveTheValueOfTheirSumRule) {
    constexpr std::size_t n = 20;
    VelocityCorrelation correlation({R, 1.0}, 1);
    for (std::uint64_t seed = 1; seed <= 500; ++seed) {
        correlation.sample(random_discs(n, seed, 0.2));
        correlation.close_block();
    }
    int checked = 0;
    for (std::size_t bin = 5; bin < 120; ++bin) {
        for (const Estimate& e : {correlation.along(bin), correlation.across(bin)}) {
            // 230 values: none is beyond 4.5 errors.
            EXPECT_NEAR(e.mean, -1.0 / (n - 1.0), 4.5 * e.error) << bin;
            EXPECT_LT(e.error, 0.1);
            ++checked;
        }
        EXPECT_NEAR(correlation.spin(bin).mean, 0.0, 4.5 * correlation.spin(bin).error) << bin;
    }
    EXPECT_EQ(checked, 230);
}

/// Two touching discs on the x axis of the lab.
Snapshot two_discs(const Vec2& a, const Vec2& b, double spin_a, double spin_b) {
    Snapshot s = empty_container(0.4);
    add_disc(s, s.container_centre + Vec2{-1.0, 0.0}, s.container_velocity + a, spin_a);
    add_disc(s, s.container_centre + Vec2{1.0, 0.0}, s.container_velocity + b, spin_b);
    return s;
}

TEST(VelocityCorrelation, GearsHaveMinusOneAndARigidBodyOne) {
    for (const double sign : {-1.0, 1.0}) {
        VelocityCorrelation correlation({R, 1.0}, 1);
        correlation.sample(two_discs({0.0, 0.0}, {0.0, 0.0}, 0.7, sign * 0.7));
        correlation.close_block();
        EXPECT_DOUBLE_EQ(row_of(correlation, "near_spin").mean, sign);
        EXPECT_TRUE(std::isnan(row_of(correlation, "near_along").mean));  // discs at rest
    }
}

TEST(VelocityCorrelation, DistinguishesAlongAndAcross) {
    VelocityCorrelation correlation({R, 1.0}, 1);
    Snapshot s = two_discs({0.3, 0.5}, {0.3, 0.5}, 1.0, 3.0);
    add_disc(s, s.container_centre + Vec2{0.0, 6.0}, s.container_velocity + Vec2{-0.6, 0.7});
    correlation.sample(s);
    correlation.close_block();
    // The mean velocity is (0, 17/30), so δu of both neighbours is (0.3, −1/15).
    EXPECT_NEAR(row_of(correlation, "near_along").mean, 1.0, 1e-14);
    EXPECT_NEAR(row_of(correlation, "near_across").mean, 1.0, 1e-12);
    EXPECT_NEAR(row_of(correlation, "near_spin").mean, 3.0 / 5.0, 1e-14);
    // Opposite velocities along the line: −1; nothing across it.
    VelocityCorrelation opposite({R, 1.0}, 1);
    opposite.sample(two_discs({0.3, 0.0}, {-0.3, 0.0}, 0.0, 0.0));
    opposite.close_block();
    EXPECT_NEAR(row_of(opposite, "near_along").mean, -1.0, 1e-14);
    EXPECT_TRUE(std::isnan(row_of(opposite, "near_spin").mean));
}

TEST(VelocityCorrelation, DoesNotDependOnTheVelocityOfTheContainer) {
    const auto value = [](double u) {
        VelocityCorrelation correlation({R, 1.0}, 1);
        Snapshot s = empty_container(u);
        const MFrame f = m_frame(s);
        for (const double x : {-2.0, 0.1, 2.2})
            add_disc(s, f.lab_position({x, 0.3 * x}),
                     s.container_velocity + f.rotate_back({x * x, 0.2 - x}));
        correlation.sample(s);
        correlation.close_block();
        return row_of(correlation, "near_along").mean;
    };
    EXPECT_NEAR(value(0.0), value(0.37), 1e-12);
}

TEST(VelocityCorrelation, IsNaNForMissingSpinsOnly) {
    VelocityCorrelation correlation({R, 1.0}, 1);
    correlation.sample(two_discs({0.3, 0.0}, {0.1, 0.0}, not_available, 1.0));
    correlation.close_block();
    EXPECT_TRUE(std::isnan(row_of(correlation, "near_spin").mean));
    EXPECT_FALSE(std::isnan(row_of(correlation, "near_along").mean));
}

}  // namespace
}  // namespace swirl
