#include "swirl/measure/several_runs.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "math/deviate.hpp"
#include "swirl/math/random.hpp"

namespace swirl {
namespace {

Estimate run_of(double mean, double error, double samples = 1e9) {
    return {.mean = mean, .error = error, .effective_samples = samples, .blocks = 100};
}

TEST(SeveralRuns, StudentsQuantilesAreThoseOfTheTables) {
    EXPECT_NEAR(student_95(1.0), 12.706, 1e-3);
    EXPECT_NEAR(student_95(2.0), 4.303, 1e-3);
    EXPECT_NEAR(student_95(7.0), 2.365, 1e-3);
    EXPECT_NEAR(student_95(10.0), 2.228, 3e-3);  // from here on by the expansion
    EXPECT_NEAR(student_95(30.0), 2.042, 1e-3);
    EXPECT_NEAR(student_95(1e9), 1.960, 1e-3);
    // Between whole numbers, by integration of the density: a little too large is on the safe side.
    EXPECT_GT(student_95(1.5), 6.0167);
    EXPECT_LT(student_95(1.5), 6.0167 * 1.2);
    EXPECT_GT(student_95(2.5), 3.5746);
    EXPECT_LT(student_95(2.5), 3.5746 * 1.05);
    EXPECT_EQ(student_95(0.2), student_95(1.0));
    for (double v = 1.0; v < 12.0; v += 0.25) EXPECT_GT(student_95(v), student_95(v + 0.25)) << v;
}

// One-sided 0.99865: 23.6 for 7 degrees of freedom, 10.3 for one, where the approximation is 6 %
// off.
TEST(SeveralRuns, TooMuchScatterIsBeyondThreeDeviations) {
    EXPECT_FALSE(beyond_chance(23.0, 7.0));
    EXPECT_TRUE(beyond_chance(24.5, 7.0));
    EXPECT_FALSE(beyond_chance(9.5, 1.0));
    EXPECT_TRUE(beyond_chance(11.5, 1.0));
}

TEST(SeveralRuns, OneRunKeepsItsOwnError) {
    const std::vector<Estimate> one{run_of(2.0, 0.5)};
    const SeveralRuns all = several_runs(one);
    EXPECT_EQ(all.estimate.mean, 2.0);
    EXPECT_EQ(all.estimate.error, 0.5);
    EXPECT_EQ(all.runs, 1u);
    EXPECT_FALSE(all.disagree);
}

TEST(SeveralRuns, RunsThatAgreeHaveTheErrorOfTheirBlocks) {
    const std::vector<Estimate> runs{run_of(1.0, 0.2), run_of(1.1, 0.2), run_of(0.9, 0.2),
                                     run_of(1.0, 0.2)};
    const SeveralRuns all = several_runs(runs);
    EXPECT_DOUBLE_EQ(all.estimate.mean, 1.0);
    EXPECT_NEAR(all.estimate.error, 0.1, 1e-6);
    EXPECT_LT(all.scatter, 1.0);
    EXPECT_FALSE(all.disagree);
}

// By hand: mean 2, Σ(m − 2)² = 4, V_b = 4/3 · ½ /16 · … = Σ/(n(n − 1)) = 4/12.
TEST(SeveralRuns, RunsThatDisagreeHaveTheErrorBetweenThem) {
    const std::vector<Estimate> runs{run_of(1.0, 0.01), run_of(3.0, 0.01), run_of(1.0, 0.01),
                                     run_of(3.0, 0.01)};
    const SeveralRuns all = several_runs(runs);
    EXPECT_DOUBLE_EQ(all.estimate.mean, 2.0);
    EXPECT_TRUE(all.disagree);
    EXPECT_NEAR(all.between, std::sqrt(4.0 / 12.0), 1e-12);
    EXPECT_NEAR(all.estimate.error, std::sqrt(4.0 / 12.0) * 3.182446 / 1.959964, 1e-5);
    EXPECT_NEAR(all.scatter, std::sqrt(4.0 / 0.0001 / 3.0), 1e-6);
}

TEST(SeveralRuns, WeightsAreLengths) {
    const std::vector<Estimate> runs{run_of(0.0, 0.4), run_of(0.4, 0.2)};
    const std::vector<double> lengths{1.0, 3.0};
    const SeveralRuns all = several_runs(runs, lengths);
    EXPECT_DOUBLE_EQ(all.estimate.mean, 0.3);
    // Between: 2/1 · (0.3² + (3 · 0.1)²)/16 = 0.0225; within: (0.4² + 0.6²)/16 = 0.0325.
    EXPECT_NEAR(all.between, 0.15, 1e-12);
    EXPECT_NEAR(all.within, std::sqrt(0.0325), 1e-12);
    EXPECT_NEAR(all.estimate.error, std::sqrt(0.0325), 1e-6);
}

TEST(SeveralRuns, WhatIsNotKnownIsLeftOut) {
    const std::vector<Estimate> runs{run_of(not_known, not_known), run_of(1.0, 0.1)};
    EXPECT_EQ(several_runs(runs).estimate.mean, 1.0);
    EXPECT_EQ(several_runs(runs).runs, 1u);
    EXPECT_TRUE(std::isnan(several_runs({}).estimate.mean));
    const std::vector<Estimate> without_errors{run_of(1.0, not_known), run_of(2.0, not_known)};
    const SeveralRuns all = several_runs(without_errors);
    EXPECT_NEAR(all.estimate.error, 0.5 * 12.7062 / 1.959964, 1e-4);
    EXPECT_FALSE(all.disagree);
}

TEST(SeveralRuns, DirectionsPassThroughZero) {
    const std::vector<Estimate> runs{run_of(350.0, 2.0), run_of(10.0, 2.0), run_of(not_known, 1.0),
                                     run_of(357.0, 2.0)};
    const SeveralRuns all = several_directions(runs);
    EXPECT_NEAR(all.estimate.mean, 359.0, 1e-9);
    EXPECT_EQ(all.runs, 3u);
    EXPECT_TRUE(std::isnan(several_directions({}).estimate.mean));
}

TEST(SeveralRuns, ExactRunsThatAgreeAreExact) {
    const std::vector<Estimate> runs{run_of(1.0, 0.0), run_of(1.0, 0.0)};
    EXPECT_EQ(several_runs(runs).estimate.error, 0.0);
    EXPECT_FALSE(several_runs(runs).disagree);
}

// How often the 95 % interval holds the truth, over 4000 repetitions: a binomial deviate with a
// standard deviation of 0.35 %. The maximum of two estimates is on the safe side, so what is asked
// is not less than 93.5 %, also where blocks understate the error.
TEST(SeveralRuns, NinetyFivePercentHoldTheTruth) {
    Random random(17);
    for (const int seeds : {2, 3, 8})
        for (const double understated : {1.0, 2.0, 5.0}) {
            int held = 0;
            const int repetitions = 4000;
            for (int k = 0; k < repetitions; ++k) {
                std::vector<Estimate> runs;
                for (int s = 0; s < seeds; ++s)
                    runs.push_back(run_of(deviate(random), 1.0 / understated, 200.0));
                const Estimate e = several_runs(runs).estimate;
                held += std::fabs(e.mean) <= 1.96 * e.error ? 1 : 0;
            }
            const double share = double(held) / repetitions;
            // Two runs cannot tell an error that is understated by 2 from chance.
            const double least = understated == 1.0 ? 0.935 : seeds == 8 ? 0.90 : 0.75;
            EXPECT_GT(share, least) << seeds << " seeds, understated by " << understated;
        }
}

}  // namespace
}  // namespace swirl
