// The error of a recording of a few periods (few_blocks_factor): the share of short windows of a
// long run whose mean lies beyond two errors.
#include <gtest/gtest.h>

#include <cmath>
#include <span>
#include <vector>

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

TEST(FewBlocks, FewerThanFourHaveNoErrorAndManyNeedNoFactor) {
    EXPECT_TRUE(std::isnan(few_blocks_factor(1)));
    EXPECT_TRUE(std::isnan(few_blocks_factor(3)));
    EXPECT_NEAR(few_blocks_factor(4), 3.182 / 1.960, 1e-3);  // tables of Student's t
    EXPECT_NEAR(few_blocks_factor(8), 2.365 / 1.960, 1e-3);
    EXPECT_EQ(few_blocks_factor(20), 1.0);
}

}  // namespace
}  // namespace swirl
