#include "swirl/statistics/block_average.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include "measure/snapshots.hpp"
#include "swirl/statistics/student.hpp"

namespace swirl {
namespace {

TEST(Statistics, MeanAndErrorOfThreeBlocksByHand) {
    BlockSeries series;
    for (const double value : {1.0, 2.0, 6.0}) series.add(value, 1.0);
    const Estimate e = series.estimate();
    EXPECT_DOUBLE_EQ(e.mean, 3.0);
    EXPECT_EQ(e.blocks, 3u);
    // Residuals −2, −1, 3: Γ_0 = (14 + (2 − 3))/3 = 13/3, then Γ ends; τ = (2·13 − 14)/14 < 1 → 1.
    EXPECT_DOUBLE_EQ(e.effective_samples, 3.0);
    EXPECT_DOUBLE_EQ(e.error, std::sqrt(14.0 / 2.0 / 3.0));
}

TEST(Statistics, EverySampleHasTheSameWeight) {
    BlockSeries series;
    series.add(10.0, 1.0);
    series.add(0.0, 9.0);
    EXPECT_DOUBLE_EQ(series.estimate().mean, 1.0);
    // Residuals 9 and −9; error² = 2/1 · 162 / 100.
    EXPECT_DOUBLE_EQ(series.estimate().error, std::sqrt(3.24));
}

TEST(Statistics, IsNaNWithoutBlocksOrErrorOfOneOrForNaN) {
    BlockSeries series;
    EXPECT_TRUE(std::isnan(series.estimate().mean));
    EXPECT_TRUE(std::isnan(series.estimate().error));
    series.add(0.0, 0.0);
    EXPECT_TRUE(std::isnan(series.estimate().mean));
    series.add(4.0, 2.0);
    EXPECT_DOUBLE_EQ(series.estimate().mean, 2.0);
    BlockSeries one;
    one.add(4.0, 2.0);
    EXPECT_DOUBLE_EQ(one.estimate().mean, 2.0);
    EXPECT_TRUE(std::isnan(one.estimate().error));
    one.add(not_available, 2.0);
    EXPECT_TRUE(std::isnan(one.estimate().mean));
}

TEST(Statistics, ErrorOfIndependentBlocksIsTheirScatter) {
    Noise noise(7);
    BlockSeries series;
    for (int i = 0; i < 1000; ++i) series.add(noise(), 1.0);
    const Estimate e = series.estimate();
    // The error is the scatter 1/√3 over √1000. It is known to 1/√2000 = 2.2 %, and τ to twice
    // that.
    EXPECT_NEAR(e.error, std::sqrt(1.0 / 3000.0), 0.15 * std::sqrt(1.0 / 3000.0));
    EXPECT_NEAR(e.mean, 0.0, 4.0 * e.error);
}

TEST(Statistics, CorrelatedBlocksCountForLess) {
    // Autoregressive, a = 0.8: τ = (1 + a)/(1 − a) = 9, variance 1/3/(1 − a²).
    const double a = 0.8;
    Noise noise(3);
    BlockSeries series;
    double value = 0.0;
    for (int i = 0; i < 2000; ++i) series.add(value = a * value + noise(), 1.0);
    const Estimate e = series.estimate();
    // τ of a chain of 2000 is known to about √(2·(2·20+1)/2000) = 20 %. The tolerance is three
    // times this error.
    EXPECT_NEAR(2000.0 / e.effective_samples, 9.0, 5.4);
    EXPECT_NEAR(e.error, std::sqrt(9.0 / 3.0 / (1.0 - a * a) / 2000.0), 0.02);
}

// Γ_k = γ_2k + γ_2k+1, and 10 γ_k = 22, 4, 1, 0, −1, 4, …: Γ = 2.6, 0.1, 0.3, and below zero after
// that. A later Γ counts no more than an earlier one, so τ = 2 (2.6 + 0.1 + 0.1)/2.2 − 1 = 17/11.
TEST(Statistics, SumOfCorrelationPairsIsMonotone) {
    BlockSeries series;
    for (const double value : {6.0, 7.0, 6.0, 6.0, 3.0, 6.0, 6.0, 3.0, 4.0, 3.0})
        series.add(value, 1.0);
    EXPECT_NEAR(series.autocorrelation_time(5.0), 17.0 / 11.0, 1e-15);
    const Estimate e = series.estimate();
    EXPECT_DOUBLE_EQ(e.mean, 5.0);
    EXPECT_NEAR(e.effective_samples, 110.0 / 17.0, 1e-14);
    // error² = τ · 10/9 · Σ d² / 10², Σ d² = 22.
    EXPECT_NEAR(e.error, std::sqrt(17.0 / 11.0 * 10.0 / 9.0 * 22.0) / 10.0, 1e-15);
}

TEST(Statistics, ErrorsHaveTheirNominalCoverage) {
    const double a = 0.5;
    int within = 0;
    for (std::uint64_t seed = 1; seed <= 400; ++seed) {
        Noise noise(seed);
        BlockSeries series;
        double value = 0.0;
        for (int i = 0; i < 200; ++i) series.add(value = a * value + noise(), 1.0);
        const Estimate e = series.estimate();
        within += std::abs(e.mean) < 2.0 * e.error ? 1 : 0;
    }
    // 95.4 % of 400 = 382 with a scatter of 4; short chains underestimate a little.
    EXPECT_GE(within, 364);
    EXPECT_LE(within, 398);
}

TEST(Statistics, MergedRunsHaveTheMeanOfOneLongRun) {
    Noise noise(11);
    BlockSeries whole, first, second;
    for (int i = 0; i < 300; ++i) {
        const double value = noise(), weight = 2.0 + noise();
        whole.add(value, weight);
        (i < 120 ? first : second).add(value, weight);
    }
    first.merge(second);
    EXPECT_EQ(first.size(), whole.size());
    EXPECT_EQ(first.runs(), 2u);
    EXPECT_NEAR(first.mean(), whole.mean(), 1e-15);  // another order of additions
    // Only products across the seam are missing.
    EXPECT_NEAR(first.estimate().error, whole.estimate().error, 0.1 * whole.estimate().error);
}

TEST(Statistics, MergingIntoAnEmptySeriesCopiesAndAddingContinuesTheOwnRun) {
    BlockSeries a, b;
    b.add(1.0, 1.0);
    b.add(3.0, 1.0);
    a.merge(b);
    EXPECT_DOUBLE_EQ(a.estimate().mean, 2.0);
    EXPECT_DOUBLE_EQ(a.estimate().error, b.estimate().error);
    b.merge(a);
    b.add(5.0, 1.0);
    EXPECT_EQ(b.block_means(0), (std::vector<double>{1.0, 3.0, 5.0}));
    EXPECT_EQ(b.block_means(1), (std::vector<double>{1.0, 3.0}));
}

// 520 periods, of which five have a sample: the error is that of five numbers, √(Σ d²/(5·4)).
TEST(Statistics, EffectiveSamplesAreThoseOfBlocksWithSamples) {
    BlockSeries series, five;
    for (int period = 0; period < 520; ++period) {
        const double value = period % 208 == 0 ? 1.0 : 4.0;
        const bool is_sampled = period % 104 == 0;
        series.add(is_sampled ? value : 0.0, is_sampled ? 1.0 : 0.0);
        if (is_sampled) five.add(value, 1.0);
    }
    EXPECT_EQ(series.estimate().blocks, 520u);
    EXPECT_EQ(series.estimate().effective_samples, 5.0);
    EXPECT_DOUBLE_EQ(series.estimate().mean, five.estimate().mean);
    // 1, 4, 1, 4, 1: a mean of 2.2 and Σ d² = 10.8.
    EXPECT_NEAR(series.estimate().error, std::sqrt(10.8 / 20.0), 1e-12);
    BlockSeries one;
    for (int period = 0; period < 10; ++period) one.add(period == 3 ? 7.0 : 0.0, period == 3);
    EXPECT_EQ(one.estimate().effective_samples, 1.0);
    EXPECT_TRUE(std::isnan(one.estimate().error));
}

TEST(Statistics, VeryLongRunsAreCoarsenedWithoutChangingTheMean) {
    BlockSeries series;
    EXPECT_EQ(series.periods_per_block(), 1u);
    double sum = 0.0;
    for (int i = 0; i < 10240; ++i) {
        series.add(i % 7, 1.0);
        sum += i % 7;
    }
    EXPECT_LT(series.size(), BlockSeries::max_blocks_per_run);
    EXPECT_EQ(series.periods_per_block(), 8u);
    EXPECT_EQ(series.size(), 1280u);
    EXPECT_DOUBLE_EQ(series.mean(), sum / 10240.0);
}

TEST(Statistics, StudentQuantilesAgreeWithTables) {
    // Two-sided 5 %: t = 2.228 for 10 degrees of freedom, 2.042 for 30 (normal: 1.960).
    EXPECT_NEAR(student_quantile(1.960, 10.0), 2.228, 0.004);
    EXPECT_NEAR(student_quantile(1.960, 30.0), 2.042, 0.001);
    EXPECT_DOUBLE_EQ(student_quantile(3.0, 1e18), 3.0);
}

}  // namespace
}  // namespace swirl
