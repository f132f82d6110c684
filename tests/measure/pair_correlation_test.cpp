#include "swirl/measure/pair_correlation.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "measure/snapshots.hpp"

namespace swirl {
namespace {

// The mean distance of two points in a circle of radius 1 is 128/(45π): ∫ (1 − F) ds.
TEST(PairCorrelation, DistancesInACircleHaveTheirMean) {
    double mean = 0.0;
    constexpr int steps = 20000;
    for (int k = 0; k < steps; ++k)
        mean += (1.0 - closer_in_circle(2.0 * (k + 0.5) / steps)) * 2.0 / steps;
    // The midpoint rule is exact to 1/steps².
    EXPECT_NEAR(mean, 128.0 / (45.0 * pi), 1e-8);
    EXPECT_EQ(closer_in_circle(2.5), 1.0);
    EXPECT_NEAR(closer_in_circle(0.0), 0.0, 1e-15);
}

/// Independent points in the circle that the centres can reach: an ideal gas of overlapping discs.
Snapshot ideal_gas(std::size_t n, std::uint64_t seed) { return random_discs(n, seed, 0.3); }

TEST(PairCorrelation, IsOneForAnIdealGas) {
    PairCorrelation correlation({R, 1.0}, 1);
    for (std::uint64_t seed = 1; seed <= 400; ++seed) {
        correlation.sample(ideal_gas(60, seed));
        correlation.close_block();
    }
    // 120 values; of the normal deviates that the errors promise, none is beyond 4.5.
    int checked = 0;
    for (std::size_t bin = 1; bin < correlation.bins().count; ++bin)
        for (const Estimate& e : {correlation.g(bin), correlation.inner_g(bin)}) {
            if (std::isnan(e.mean) || e.mean == 0.0) continue;
            EXPECT_NEAR(e.mean, 1.0, 4.5 * e.error) << bin;
            ++checked;
        }
    EXPECT_GT(checked, 150);
    // Points overlap, so their value at contact is that of an ideal gas, too.
    EXPECT_NEAR(correlation.contact().mean, 1.0, 4.5 * correlation.contact().error);
    EXPECT_NEAR(correlation.inner_packing().mean,
                60.0 * 0.25 * R * R / (7.6 * 7.6) / (0.25 * R * R),
                4.5 * correlation.inner_packing().error);
}

TEST(PairCorrelation, SumsToOneOverAllDistances) {
    PairCorrelation correlation({R, 1.0}, 1);
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        correlation.sample(ideal_gas(30, seed));
        correlation.close_block();
    }
    double sum = 0.0;
    const DistanceBins& bins = correlation.bins();
    for (std::size_t bin = 0; bin < bins.count; ++bin) {
        const double g = correlation.g(bin).mean;
        const double share =
            closer_in_circle(bins.upper(bin) / 7.6) - closer_in_circle(bins.lower(bin) / 7.6);
        if (!std::isnan(g)) sum += g * share;
    }
    EXPECT_NEAR(sum, 1.0, 1e-12);  // rounding errors of the sum over bins
}

// Two discs in the inner circle at a distance of 2.04: N − 1 = 1 partner for both references. The
// first of the cells of width 0.1 at contact has the area π (2.1² − 2²), ρ = 2/(π (R/2)²).
TEST(PairCorrelation, ContactIsTheParabolaThroughThreeCells) {
    const double density = 2.0 / (pi * 0.25 * R * R);
    constexpr double weights[] = {11.0 / 6.0, -7.0 / 6.0, 2.0 / 6.0, 0.0};
    for (int cell = 0; cell < 4; ++cell) {
        PairCorrelation correlation({R, 1.0}, 1);
        Snapshot s = empty_container(0.1);
        const double distance = 2.04 + 0.1 * cell;
        for (const double x : {-0.5 * distance, 0.5 * distance})
            add_disc(s, s.container_centre + Vec2{x, 0.3}, {0.0, 0.0});
        correlation.sample(s);
        correlation.close_block();
        const double inner = 2.0 + 0.1 * cell, outer = inner + 0.1;
        EXPECT_NEAR(correlation.contact().mean,
                    weights[cell] / (density * pi * (outer * outer - inner * inner)), 1e-10)
            << cell;
    }
}

TEST(PairCorrelation, IsNaNBeyondTheContainerAndForASingleDisc) {
    PairCorrelation correlation({R, 1.0}, 1);
    EXPECT_TRUE(std::isnan(correlation.g(30).mean));
    Snapshot one = empty_container();
    add_disc(one, one.container_centre, {0.0, 0.0});
    correlation.sample(one);
    correlation.close_block();
    EXPECT_TRUE(std::isnan(correlation.g(30).mean));
    EXPECT_TRUE(std::isnan(correlation.contact().mean));
    correlation.sample(ideal_gas(20, 1));
    correlation.close_block();
    const DistanceBins& bins = correlation.bins();
    EXPECT_TRUE(std::isnan(correlation.g(bins.bin_of(15.25)).mean));  // larger than 2 · 7.6
    EXPECT_FALSE(std::isnan(correlation.g(bins.bin_of(15.05)).mean));
    EXPECT_TRUE(std::isnan(correlation.inner_g(bins.bin_of(3.35)).mean));  // larger than R/2 − 1
    EXPECT_FALSE(std::isnan(correlation.inner_g(bins.bin_of(3.15)).mean));
}

}  // namespace
}  // namespace swirl
