// The error of a recording of a few periods (few_blocks_factor): the share of short windows of a
// long run whose mean lies beyond two errors.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "swirl/run/parallel_for.hpp"
#include "swirl/run/period_series.hpp"
#include "swirl/run/run.hpp"
#include "swirl/statistics/few_blocks.hpp"

namespace swirl {
namespace {

/// ϖ by time of the 600 periods after the warm-up.
std::vector<double> rotation_of_periods(std::uint64_t seed) {
    RunConfig config;
    config.discs = 28;
    config.seed = seed;
    config.warmup = 100;
    config.periods = 700;
    PeriodSeries series(config, {});
    RunControl control;
    control.series = &series;
    run(config, control);
    std::size_t column = 0;
    while (series.columns()[column].name != "mean_by_time") ++column;
    std::vector<double> values;
    for (std::size_t k = 0; k < series.periods(); ++k)
        if (series.at(k, 1) != 0.0) values.push_back(series.at(k, column));
    return values;
}

/// Windows whose mean lies beyond two errors of the mean of their run: without and with the factor.
struct Windows {
    int all = 0, plain = 0, corrected = 0;

    void add(const std::vector<double>& values, std::size_t width) {
        const double mean = estimate_of_series(values).estimate.mean;
        for (std::size_t begin = 0; begin + width <= values.size(); begin += width) {
            const Estimate e = estimate_of_series(std::span(values).subspan(begin, width)).estimate;
            const double off = std::abs(e.mean - mean) / e.error;
            ++all;
            plain += off > 2.0;
            corrected += off > 2.0 * few_blocks_factor(e.blocks);
        }
    }
};

TEST(FewBlocks, ShortWindowsOfARunLieWithinTwoErrorsAsOftenAsNormalDeviates) {
    Windows four, eight;
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
        const std::vector<double> values = rotation_of_periods(seed);
        ASSERT_EQ(values.size(), 600u);
        four.add(values, 4);
        eight.add(values, 8);
    }
    // 4.6 % of normal deviates are beyond: 27 ± 5.1 of 600 windows, and 13.7 ± 3.6 of 300. The
    // limits are three standard deviations higher.
    EXPECT_LT(four.corrected, 43);
    EXPECT_LT(eight.corrected, 25);
    // The test can fail: two errors without the factor are too small for four periods, for which
    // Student's distribution has 13.9 % beyond, 84 ± 8.5 windows.
    EXPECT_GT(four.plain, 58);
}

/// Short runs of one N, and how many of them hold the mean of all within two of their errors.
struct ShortRuns {
    static constexpr std::int64_t warmup = 30;
    std::int64_t discs, periods, seeds;
    int covered = 0;

    void count() {
        std::vector<Estimate> found(static_cast<std::size_t>(seeds));
        parallel_for(found.size(), [&](std::size_t k) {
            RunConfig config;
            config.discs = discs;
            config.seed = 5000 + k;
            config.warmup = warmup;
            config.periods = warmup + periods;
            found[k] = run(config).rotation.mean_by_time;
        });
        double sum = 0.0;
        for (const Estimate& e : found) sum += e.mean;
        const double mean = sum / double(seeds);
        for (const Estimate& e : found) covered += std::abs(e.mean - mean) < 2.0 * e.error ? 1 : 0;
    }
    double share() const { return double(covered) / double(seeds); }
};

// The test prints the table of docs/explanation/statistics.md.
TEST(FewBlocks, Slow_TwoErrorsOfAShortRunHoldTheMeanOfManyRuns) {
    std::int64_t covered = 0, seeds = 0;
    for (ShortRuns runs : {ShortRuns{12, 20, 200},
                           {12, 60, 200},
                           {28, 5, 200},
                           {28, 10, 200},
                           {28, 20, 200},
                           {28, 60, 200},
                           {44, 10, 200},
                           {44, 40, 100}}) {
        runs.count();
        fmt::print("| {} | {} | {} | {:.1f} % |\n", runs.discs, runs.periods, runs.seeds,
                   100.0 * runs.share());
        // The lower limit is three standard deviations of a count with 95.4 % below 93 %: block
        // sums of few periods are correlated, which few blocks cannot show.
        const double scatter = std::sqrt(0.954 * 0.046 / double(runs.seeds));
        EXPECT_GT(runs.share(), 0.93 - 3.0 * scatter) << runs.discs << " " << runs.periods;
        covered += runs.covered;
        seeds += runs.seeds;
    }
    fmt::print("{} of {} short runs: {:.1f} %\n", covered, seeds,
               100.0 * double(covered) / double(seeds));
}

TEST(FewBlocks, FewerThanFourHaveNoErrorAndManyNeedNoFactor) {
    EXPECT_TRUE(std::isnan(few_blocks_factor(1)));
    EXPECT_TRUE(std::isnan(few_blocks_factor(3)));
    EXPECT_NEAR(few_blocks_factor(4), 3.182 / 1.960, 1e-3);  // tables of Student's t
    EXPECT_NEAR(few_blocks_factor(8), 2.365 / 1.960, 1e-3);
    EXPECT_EQ(few_blocks_factor(20), 1.0);
}

}  // namespace
}  // namespace swirl
