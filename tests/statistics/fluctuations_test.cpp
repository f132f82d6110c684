// Moments, correlation times and lifetimes of series with known ones.
#include "swirl/statistics/fluctuations.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "swirl/math/normal_deviate.hpp"
#include "swirl/math/random.hpp"

namespace swirl {
namespace {

using Values = std::vector<double>;

Fluctuations fluctuations_of_one(const Values& run) { return fluctuations_of({&run, 1}); }

Values normal_noise(std::size_t n, double mean, std::uint64_t seed) {
    Random random(seed);
    Values values;
    for (std::size_t k = 0; k < n; ++k) values.push_back(mean + normal_deviate(random));
    return values;
}

/// x' = a x + noise of variance 1, from its stationary distribution on.
Values autoregressive(std::size_t n, double a, Random& random) {
    Values values;
    double x = normal_deviate(random) / std::sqrt(1.0 - a * a);
    for (std::size_t k = 0; k < n; ++k) {
        values.push_back(x);
        x = a * x + normal_deviate(random);
    }
    return values;
}

TEST(Fluctuations, OfNormalNoiseHaveNoSkewnessKurtosisAndBinderCumulant) {
    constexpr double n = 20'000.0;
    const Fluctuations f = fluctuations_of_one(normal_noise(20'000, 0.0, 5));
    // Four standard errors of the moments of n independent normal values.
    EXPECT_NEAR(f.variance.mean, 1.0, 4.0 * std::sqrt(2.0 / n));
    EXPECT_NEAR(f.skewness.mean, 0.0, 4.0 * std::sqrt(6.0 / n));
    EXPECT_NEAR(f.excess_kurtosis.mean, 0.0, 4.0 * std::sqrt(24.0 / n));
    EXPECT_NEAR(f.binder.mean, 0.0, 4.0 * std::sqrt(24.0 / n) / 3.0);
    // An error from 64 blocks has a relative error of 1/√126 = 0.09; four of these.
    EXPECT_NEAR(f.variance.error, std::sqrt(2.0 / n), 0.36 * std::sqrt(2.0 / n));
    EXPECT_NEAR(f.skewness.error, std::sqrt(6.0 / n), 0.36 * std::sqrt(6.0 / n));
    EXPECT_NEAR(f.excess_kurtosis.error, std::sqrt(24.0 / n), 0.36 * std::sqrt(24.0 / n));
    EXPECT_NEAR(f.binder.error, std::sqrt(24.0 / n) / 3.0, 0.36 * std::sqrt(24.0 / n) / 3.0);
    EXPECT_TRUE(std::isnan(f.low.mean));
    EXPECT_TRUE(std::isnan(f.high_lifetime.mean));
}

TEST(Fluctuations, DoNotDependOnTheMean) {
    const Fluctuations zero = fluctuations_of_one(normal_noise(20'000, 0.0, 6));
    for (const double m : {-0.5, 1.0, 3.0}) {
        const Fluctuations f = fluctuations_of_one(normal_noise(20'000, m, 6));
        // Rounding of x − m.
        EXPECT_NEAR(f.variance.mean, zero.variance.mean, 1e-12);
        EXPECT_NEAR(f.binder.mean, zero.binder.mean, 1e-12);
        EXPECT_NEAR(f.binder.error, zero.binder.error, 1e-12);
    }
}

TEST(Fluctuations, OfTwoSharpValuesAreExact) {
    Values values;
    for (int k = 0; k < 400; ++k) values.push_back(k % 2 == 0 ? 0.25 : -0.25);
    const Fluctuations f = fluctuations_of_one(values);
    EXPECT_EQ(f.skewness.mean, 0.0);
    EXPECT_EQ(f.excess_kurtosis.mean, -2.0);
    EXPECT_EQ(f.binder.mean, 1.0 - 1.0 / 3.0);
    // τ of alternating values is below 1 and counts as 1.
    EXPECT_EQ(f.autocorrelation_time.mean, 1.0);
    EXPECT_DOUBLE_EQ(f.variance.mean, 0.0625 / (1.0 - 1.0 / 400.0));
}

TEST(Fluctuations, OfASkewedSeriesAreThoseOfItsFourValues) {
    // 0, 0, 0, 1: variance 3/16, skewness 2/√3, kurtosis 7/3, Binder 1 − 7/9 = 2/9.
    Values values;
    for (int k = 0; k < 4'000; ++k) values.push_back(k % 4 == 0 ? 1.0 : 0.0);
    const Fluctuations f = fluctuations_of_one(values);
    EXPECT_NEAR(f.skewness.mean, 2.0 / std::sqrt(3.0), 1e-12);
    EXPECT_NEAR(f.excess_kurtosis.mean, 7.0 / 3.0 - 3.0, 1e-12);
    EXPECT_NEAR(f.binder.mean, 2.0 / 9.0, 1e-12);
}

TEST(Fluctuations, OfAnAutoregressiveSeriesHaveItsTimeAndVariance) {
    constexpr double a = 0.8;
    Random random(7);
    const Fluctuations f = fluctuations_of_one(autoregressive(40'000, a, random));
    const double time = (1.0 + a) / (1.0 - a), variance = 1.0 / (1.0 - a * a);
    // τ over a window of W lags has the relative error √(2 (2W + 1)/n): 0.06 for W = 4 τ. Geyer's
    // window ends where noise begins, so the bound is three times that.
    EXPECT_NEAR(f.autocorrelation_time.mean, time, 0.18 * time);
    // The squares of the values have the correlation a², so the variance has the relative error
    // √(2/n · (1 + a²)/(1 − a²)).
    const double error = variance * std::sqrt(2.0 / 40'000.0 * (1.0 + a * a) / (1.0 - a * a));
    EXPECT_NEAR(f.variance.mean, variance, 4.0 * error);
    EXPECT_NEAR(f.variance.error, error, 0.36 * error);
}

TEST(Fluctuations, TheVarianceOfShortCorrelatedSeriesHasNoLargeBias) {
    constexpr double a = 0.6, variance = 1.0 / (1.0 - a * a);
    constexpr int trials = 2'000;
    Random random(11);
    double sum = 0.0, squares = 0.0, plain = 0.0;
    for (int k = 0; k < trials; ++k) {
        const Values values = autoregressive(100, a, random);
        const Fluctuations f = fluctuations_of_one(values);
        sum += f.variance.mean / trials;
        squares += f.variance.mean * f.variance.mean / trials;
        plain += f.variance.mean * (1.0 - f.autocorrelation_time.mean / 100.0) / trials;
    }
    const double error = std::sqrt((squares - sum * sum) / trials);
    // The mean takes up τ/n = 4 % of the variance. τ itself is estimated from the same series, so
    // at least two thirds of the bias are removed, not all of it.
    EXPECT_LT(plain, variance * (1.0 - 0.04) + 4.0 * error);
    EXPECT_NEAR(sum, variance, 0.04 / 3.0 * variance + 4.0 * error);
}

TEST(Fluctuations, LifetimesAreThoseOfATelegraphSignal) {
    // The signal leaves its states with the probabilities 1/60 and 1/25 in each period.
    Random random(3);
    Values values;
    bool is_high = false;
    for (int k = 0; k < 30'000; ++k) {
        values.push_back((is_high ? 0.3 : -0.1) + 0.03 * normal_deviate(random));
        if (random.uniform() < (is_high ? 1.0 / 25.0 : 1.0 / 60.0)) is_high = !is_high;
    }
    const Fluctuations f = fluctuations_of_one(values);
    // Means of 20,000 and 9,000 values with the scatter 0.03; values in passing belong to neither.
    EXPECT_NEAR(f.low.mean, -0.1, 0.002);
    EXPECT_NEAR(f.high.mean, 0.3, 0.002);
    EXPECT_GT(f.low_lifetime.error, 0.0);
    EXPECT_NEAR(f.low_lifetime.mean, 60.0, 4.0 * f.low_lifetime.error);
    EXPECT_NEAR(f.high_lifetime.mean, 25.0, 4.0 * f.high_lifetime.error);
    // About 30,000/85 cycles.
    EXPECT_NEAR(f.low_lifetime.error, 60.0 / std::sqrt(353.0), 0.5);
}

TEST(Fluctuations, NoVisitExtendsOverTwoRuns) {
    // Each run is in one state only; together they would look like a series with two states.
    const std::vector<Values> runs{normal_noise(200, -9.0, 1), normal_noise(200, 9.0, 2),
                                   normal_noise(200, -9.0, 3), normal_noise(200, 9.0, 4)};
    EXPECT_TRUE(std::isnan(fluctuations_of(runs).low_lifetime.mean));
}

TEST(Fluctuations, OfSeveralRunsDoNotDependOnTheOrder) {
    const Values a = normal_noise(300, 0.1, 1), b = normal_noise(200, 0.1, 2);
    const Fluctuations ab = fluctuations_of(std::vector{a, b}),
                       ba = fluctuations_of(std::vector{b, a});
    // The same sums in another order.
    EXPECT_NEAR(ab.variance.mean, ba.variance.mean, 1e-12);
    EXPECT_NEAR(ab.binder.mean, ba.binder.mean, 1e-12);
    EXPECT_NEAR(ab.binder.error, ba.binder.error, 1e-12);
    EXPECT_EQ(ab.binder.blocks, 500u);
}

TEST(Fluctuations, OfAConstantAreZeroOrNotAvailable) {
    const Fluctuations f = fluctuations_of_one(Values(100, 0.1));
    EXPECT_EQ(f.variance.mean, 0.0);
    EXPECT_TRUE(std::isnan(f.skewness.mean));
    EXPECT_TRUE(std::isnan(f.excess_kurtosis.mean));
    EXPECT_TRUE(std::isnan(f.binder.mean));
}

TEST(Fluctuations, NeedTwoValuesAndEightBlocksForAnError) {
    EXPECT_TRUE(std::isnan(fluctuations_of_one({}).variance.mean));
    EXPECT_TRUE(std::isnan(fluctuations_of_one({1.0}).variance.mean));
    const Fluctuations short_run = fluctuations_of_one(normal_noise(20, 0.0, 1));
    EXPECT_FALSE(std::isnan(short_run.variance.mean));
    EXPECT_TRUE(std::isnan(short_run.variance.error));
}

TEST(PeriodMeans, OmitMissingValuesAndEmptyPeriods) {
    PeriodMeans means;
    means.add(1.0);
    means.add(not_available);
    means.add(2.0);
    means.close_block();
    means.close_block();
    means.add(5.0);
    means.close_block();
    means.add(100.0);  // an open period does not count
    ASSERT_EQ(means.runs().size(), 1u);
    EXPECT_EQ(means.runs()[0], (Values{1.5, 5.0}));
    PeriodMeans both;
    both.merge(means);
    both.merge(means);
    both.add(3.0);
    both.close_block();
    ASSERT_EQ(both.runs().size(), 3u);
    EXPECT_EQ(both.runs()[0], Values{3.0});
}

}  // namespace
}  // namespace swirl
