#include "swirl/measure/velocity_distribution.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "measure/snapshots.hpp"

namespace swirl {
namespace {

/// A normal deviate from twelve uniform ones has kurtosis 3 − 0.1; Box and Muller's is exact.
Vec2 normal_pair(Noise& noise) {
    const double u = 0.5 * (noise() + 1.0), v = 0.5 * (noise() + 1.0);
    const double size = std::sqrt(-2.0 * std::log1p(-u));
    return size * unit_circle(v);
}

Snapshot normal_gas(std::size_t n, std::uint64_t seed) {
    Snapshot s = empty_container(0.2);
    Noise noise(seed);
    for (std::size_t k = 0; k < n; ++k)
        add_disc(s, s.container_centre, s.container_velocity + 0.3 * normal_pair(noise),
                 2.0 + 0.5 * normal_pair(noise).x);
    return s;
}

class FewDiscs : public ::testing::TestWithParam<std::size_t> {};

TEST_P(FewDiscs, HaveTheKurtosisAndTheDistributionOfMaxwell) {
    const std::size_t n = GetParam();
    VelocityDistribution found(1);
    for (std::uint64_t seed = 1; seed <= 60000 / n; ++seed) {
        found.sample(normal_gas(n, seed));
        found.close_block();
    }
    for (const char* row : {"kurtosis", "spin_kurtosis"}) {
        const Estimate e = row_of(found, row);
        EXPECT_NEAR(e.mean, 3.0, 4.0 * e.error) << row;
        EXPECT_LT(e.error, 0.05) << row;
    }
    // Of 2N − 2 components with a given sum of squares, the share with c > x is exactly
    // (1 − x²/(N − 1))^(N − 2); for many discs, exp(−x²).
    const double others = static_cast<double>(n) - 1.0;
    const auto beyond = [&](double x) {
        return x * x < others ? std::pow(1.0 - x * x / others, others - 1.0) : 0.0;
    };
    for (std::size_t bin = 0; bin < VelocityDistribution::speed_bins; ++bin) {
        const double x = VelocityDistribution::speed_of(bin);
        const double expected = (beyond(x - 0.05) - beyond(x + 0.05)) / 0.1;
        const Estimate e = found.speed_density(bin);
        // Bins with a few of 60,000 discs have no normal deviates: one disc is 1/6000.
        EXPECT_NEAR(e.mean, expected, 4.5 * e.error + 1e-3) << x;
    }
}
INSTANTIATE_TEST_SUITE_P(Velocities, FewDiscs, ::testing::Values(3, 6, 200));

// Components of ±a only: ⟨x⁴⟩ = ⟨x²⟩², kurtosis 1 (times N/(N − 1)).
TEST(VelocityDistribution, TwoValuesHaveTheSmallestKurtosis) {
    VelocityDistribution found(1);
    Snapshot s = empty_container();
    const MFrame f = m_frame(s);
    for (const double x : {-0.3, 0.3})
        for (const double y : {-0.3, 0.3})
            add_disc(s, s.container_centre, s.container_velocity + f.rotate_back({x, y}), x);
    found.sample(s);
    found.close_block();
    EXPECT_NEAR(row_of(found, "kurtosis").mean, 4.0 / 3.0, 1e-13);
    EXPECT_NEAR(row_of(found, "spin_kurtosis").mean, 5.0 / 3.0, 1e-13);
    EXPECT_NEAR(row_of(found, "speed").mean, 0.3 * std::sqrt(2.0), 1e-14);
    EXPECT_NEAR(row_of(found, "spin").mean, 0.3 / (2.0 * pi / paper_period), 1e-13);
    // All discs have the speed s: c = 1 up to rounding.
    double share = 0.0;
    for (const std::size_t bin : {9u, 10u}) share += 0.1 * found.speed_density(bin).mean;
    EXPECT_NEAR(share, 1.0, 1e-14);
}

TEST(VelocityDistribution, OmitsDiscsAtRestEqualSpinsAndMissingSpins) {
    VelocityDistribution found(1);
    Snapshot s = empty_container(0.7);
    for (int k = 0; k < 5; ++k)
        add_disc(s, s.container_centre + Vec2{1.0 * k, 0.0}, s.container_velocity, 0.1);
    found.sample(s);
    found.close_block();
    EXPECT_TRUE(std::isnan(row_of(found, "kurtosis").mean));
    EXPECT_TRUE(std::isnan(row_of(found, "spin_kurtosis").mean));
    Snapshot moving = random_discs(5, 1);
    moving.spin[2] = not_available;
    found.sample(moving);
    found.close_block();
    EXPECT_FALSE(std::isnan(row_of(found, "kurtosis").mean));
    EXPECT_TRUE(std::isnan(row_of(found, "spin_kurtosis").mean));
    EXPECT_TRUE(std::isnan(row_of(VelocityDistribution(), "speed").mean));
}

// Speeds from 0 to 4 and spins from −4 to 4, in steps of 0.1.
TEST(VelocityDistribution, TablesHaveTheirRange) {
    Report report;
    VelocityDistribution().report(report);
    ASSERT_EQ(report.tables.size(), 2u);
    EXPECT_EQ(report.tables[0].rows(), 40u);
    EXPECT_EQ(report.tables[1].rows(), 80u);
    EXPECT_NEAR(report.tables[0].at(0, 0), 0.05, 1e-15);
    EXPECT_NEAR(report.tables[0].at(39, 0), 3.95, 1e-15);
    EXPECT_NEAR(report.tables[1].at(0, 0), -3.95, 1e-15);
    EXPECT_NEAR(report.tables[1].at(79, 0), 3.95, 1e-14);
}

}  // namespace
}  // namespace swirl
