#include "swirl/measure/cell_averages.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "measure/snapshots.hpp"

namespace swirl {
namespace {

TEST(CellAverages, AgreeWithBlockAverages) {
    CellMeans<1> means(3);
    CellRates rates(3);
    BlockSeries mean_blocks, rate_blocks;
    Noise noise(2);
    for (int block = 0; block < 50; ++block) {
        double sum = 0.0, visits = 0.0;
        for (int sample = 0; sample < 10; ++sample) {
            rates.add_weight();
            if (noise() < 0.3) continue;
            const double value = 1.0 + noise();
            means.add(1, {value});
            rates.add(1, value);
            sum += value;
            visits += 1.0;
        }
        means.close_block();
        rates.close_block();
        mean_blocks.add(sum, visits);
        rate_blocks.add(sum, 10.0);
    }
    EXPECT_NEAR(means.estimate(1).mean, mean_blocks.estimate().mean, 1e-14);
    EXPECT_NEAR(rates.estimate(1).mean, rate_blocks.estimate().mean, 1e-14);
    // Independent blocks: τ is 1 within its noise.
    const auto uncorrelated = [](const BlockSeries& b) {
        return b.estimate().error / std::sqrt(b.autocorrelation_time(b.mean()));
    };
    EXPECT_NEAR(means.estimate(1).error, uncorrelated(mean_blocks), 1e-12);
    EXPECT_NEAR(rates.estimate(1).error, uncorrelated(rate_blocks), 1e-12);
}

TEST(CellAverages, UnvisitedCellHasNaNMeanAndZeroRate) {
    CellMeans<2> means(2);
    CellRates rates(2);
    means.add(0, {1.0, 2.0});
    rates.add_weight();
    means.close_block();
    rates.close_block();
    EXPECT_TRUE(std::isnan(means.estimate(1).mean));
    EXPECT_EQ(means.estimate(0, 1).mean, 2.0);
    EXPECT_EQ(rates.estimate(1).mean, 0.0);
    EXPECT_TRUE(std::isnan(rates.estimate(1).error));
    EXPECT_TRUE(std::isnan(CellRates(1).estimate(0).mean));
}

// The error of a cell that was visited in one block would be 0.
TEST(CellAverages, BlocksWithoutAVisitDoNotCount) {
    CellMeans<1> means(1);
    CellRates rates(1);
    for (int block = 0; block < 10; ++block) {
        if (block == 4) {
            means.add(0, {3.0});
            rates.add(0);
            rates.add_weight();
        }
        means.close_block();
        rates.close_block();
    }
    for (const Estimate& e : {means.estimate(0), rates.estimate(0)}) {
        EXPECT_EQ(e.effective_samples, 1.0);
        EXPECT_TRUE(std::isnan(e.error));
    }
}

TEST(CellAverages, MergedEqualsOneLongRun) {
    CellMeans<1> whole(4), first(4), second(4);
    CellRates all(4), one(4), two(4);
    Noise noise(5);
    for (int block = 0; block < 20; ++block) {
        CellMeans<1>& part = block < 7 ? first : second;
        CellRates& rate = block < 7 ? one : two;
        for (int sample = 0; sample < 30; ++sample) {
            const std::size_t cell = static_cast<std::size_t>(2.0 + 2.0 * noise()) % 4;
            const double value = 0.25 * static_cast<int>(8.0 * noise());  // sums without rounding
            whole.add(cell, {value});
            part.add(cell, {value});
            all.add(cell, value);
            rate.add(cell, value);
            all.add_weight();
            rate.add_weight();
        }
        whole.close_block();
        part.close_block();
        all.close_block();
        rate.close_block();
    }
    first.merge(second);
    one.merge(two);
    for (std::size_t c = 0; c < 4; ++c) {
        EXPECT_EQ(first.estimate(c).mean, whole.estimate(c).mean);
        EXPECT_EQ(first.estimate(c).error, whole.estimate(c).error);
        EXPECT_EQ(one.estimate(c).mean, all.estimate(c).mean);
        EXPECT_EQ(one.estimate(c).error, all.estimate(c).error);
    }
}

TEST(CellAverages, ScaledErrorIsPositive) {
    const Estimate e = scaled({.mean = 2.0, .error = 0.5}, -3.0);
    EXPECT_EQ(e.mean, -6.0);
    EXPECT_EQ(e.error, 1.5);
}

}  // namespace
}  // namespace swirl
