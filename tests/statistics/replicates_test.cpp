#include "swirl/statistics/replicates.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "math/deviate.hpp"
#include "swirl/math/random.hpp"

namespace swirl {
namespace {

Estimate run_of(double mean, double error, double samples = 1e9) {
    return {.mean = mean, .error = error, .effective_samples = samples, .blocks = 100};
}

TEST(Ensemble, StudentQuantilesAgreeWithTables) {
    EXPECT_NEAR(student_95(1.0), 12.706, 1e-3);
    EXPECT_NEAR(student_95(2.0), 4.303, 1e-3);
    EXPECT_NEAR(student_95(7.0), 2.365, 1e-3);
    EXPECT_NEAR(student_95(10.0), 2.228, 3e-3);  // the expansion begins here
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
TEST(Ensemble, ChiSquareThresholdIsThreeStandardDeviations) {
    EXPECT_FALSE(beyond_chance(23.0, 7.0));
    EXPECT_TRUE(beyond_chance(24.5, 7.0));
    EXPECT_FALSE(beyond_chance(9.5, 1.0));
    EXPECT_TRUE(beyond_chance(11.5, 1.0));
}

TEST(Ensemble, OneRunKeepsItsOwnError) {
    const std::vector<Estimate> one{run_of(2.0, 0.5)};
    const Ensemble all = ensemble(one);
    EXPECT_EQ(all.estimate.mean, 2.0);
    EXPECT_EQ(all.estimate.error, 0.5);
    EXPECT_EQ(all.runs, 1u);
    EXPECT_FALSE(all.disagree);
}

TEST(Ensemble, RunsThatAgreeHaveTheErrorOfTheirBlocks) {
    const std::vector<Estimate> runs{run_of(1.0, 0.2), run_of(1.1, 0.2), run_of(0.9, 0.2),
                                     run_of(1.0, 0.2)};
    const Ensemble all = ensemble(runs);
    EXPECT_DOUBLE_EQ(all.estimate.mean, 1.0);
    EXPECT_NEAR(all.estimate.error, 0.1, 1e-6);
    EXPECT_LT(all.scatter, 1.0);
    EXPECT_FALSE(all.disagree);
}

// By hand: mean 2, Σ(m − 2)² = 4, V_b = 4/3 · ½ /16 · … = Σ/(n(n − 1)) = 4/12.
TEST(Ensemble, RunsThatDisagreeHaveTheErrorBetweenThem) {
    const std::vector<Estimate> runs{run_of(1.0, 0.01), run_of(3.0, 0.01), run_of(1.0, 0.01),
                                     run_of(3.0, 0.01)};
    const Ensemble all = ensemble(runs);
    EXPECT_DOUBLE_EQ(all.estimate.mean, 2.0);
    EXPECT_TRUE(all.disagree);
    EXPECT_NEAR(all.between, std::sqrt(4.0 / 12.0), 1e-12);
    EXPECT_NEAR(all.estimate.error, std::sqrt(4.0 / 12.0) * 3.182446 / 1.959964, 1e-5);
    EXPECT_NEAR(all.scatter, std::sqrt(4.0 / 0.0001 / 3.0), 1e-6);
}

TEST(Ensemble, WeightsAreLengths) {
    const std::vector<Estimate> runs{run_of(0.0, 0.4), run_of(0.4, 0.2)};
    const std::vector<double> lengths{1.0, 3.0};
    const Ensemble all = ensemble(runs, lengths);
    EXPECT_DOUBLE_EQ(all.estimate.mean, 0.3);
    // Within: (0.4² + 0.6²)/16 = 0.0325. Between: of two runs 0.4² = 0.4² + 0.2² + 2 τ², so that
    // τ² = −0.02, and 0.0325 + τ² (1² + 3²)/16 = 0.02.
    EXPECT_NEAR(all.between, std::sqrt(0.02), 1e-12);
    EXPECT_NEAR(all.within, std::sqrt(0.0325), 1e-12);
    EXPECT_NEAR(all.estimate.error, std::sqrt(0.0325), 1e-6);
}

TEST(Ensemble, RunsWithoutAMeanAreOmitted) {
    const std::vector<Estimate> runs{run_of(not_available, not_available), run_of(1.0, 0.1)};
    EXPECT_EQ(ensemble(runs).estimate.mean, 1.0);
    EXPECT_EQ(ensemble(runs).runs, 1u);
    EXPECT_TRUE(std::isnan(ensemble({}).estimate.mean));
    const std::vector<Estimate> without_errors{run_of(1.0, not_available),
                                               run_of(2.0, not_available)};
    const Ensemble all = ensemble(without_errors);
    EXPECT_NEAR(all.estimate.error, 0.5 * 12.7062 / 1.959964, 1e-4);
    EXPECT_FALSE(all.disagree);
}

TEST(Ensemble, DirectionsPassThroughZero) {
    const std::vector<Estimate> runs{run_of(350.0, 2.0), run_of(10.0, 2.0),
                                     run_of(not_available, 1.0), run_of(357.0, 2.0)};
    const Ensemble all = several_directions(runs);
    EXPECT_NEAR(all.estimate.mean, 359.0, 1e-9);
    EXPECT_EQ(all.runs, 3u);
    EXPECT_TRUE(std::isnan(several_directions({}).estimate.mean));
}

TEST(Ensemble, ExactRunsThatAgreeAreExact) {
    const std::vector<Estimate> runs{run_of(1.0, 0.0), run_of(1.0, 0.0)};
    EXPECT_EQ(ensemble(runs).estimate.error, 0.0);
    EXPECT_FALSE(ensemble(runs).disagree);
}

// Share of 4000 repetitions in which the 95 % interval contains the true value: binomial, with a
// standard deviation of 0.35 %. The maximum of two estimates is on the safe side. So the test
// requires at least 93.5 %, also if the blocks underestimate the error.
TEST(Ensemble, IntervalHasNominalCoverageIfSeedsAgree) {
    Random random(17);
    for (const int seeds : {2, 3, 8})
        for (const double understated : {1.0, 2.0, 5.0}) {
            int held = 0;
            const int repetitions = 4000;
            for (int k = 0; k < repetitions; ++k) {
                std::vector<Estimate> runs;
                for (int s = 0; s < seeds; ++s)
                    runs.push_back(run_of(deviate(random), 1.0 / understated, 200.0));
                const Estimate e = ensemble(runs).estimate;
                held += std::fabs(e.mean) <= 1.96 * e.error ? 1 : 0;
            }
            const double share = double(held) / repetitions;
            // Two runs cannot distinguish an error that is too small by a factor of 2 from chance.
            const double minimum = understated == 1.0 ? 0.935 : seeds == 8 ? 0.90 : 0.75;
            EXPECT_GT(share, minimum) << seeds << " seeds, understated by " << understated;
        }
}

// Two runs disagree, and a third is too uncertain to decide: the error from its blocks still
// counts. V_w = (2 · 0.01² + 10²)/9.
TEST(Ensemble, ErrorIsAtLeastThatOfTheBlocksIfSeedsDisagree) {
    const std::vector<Estimate> runs{run_of(0.0, 0.01), run_of(1.0, 0.01), run_of(0.5, 10.0)};
    const Ensemble all = ensemble(runs);
    EXPECT_TRUE(all.disagree);
    EXPECT_GE(all.estimate.error, std::sqrt((2e-4 + 100.0) / 9.0));
}

/// Shares of the repetitions in which the true value, 0, is within 1.96 errors, and beyond three.
struct Shares {
    double held = 0.0, beyond_three = 0.0;
};

/// Runs with these lengths. Their blocks give an error proportional to 1/√length; in addition, the
/// seeds differ by `between`.
Shares shares_of(const std::vector<double>& lengths, double between, bool with_errors,
                 Random& random) {
    const int repetitions = 4000;
    Shares shares;
    for (int k = 0; k < repetitions; ++k) {
        std::vector<Estimate> runs;
        for (const double length : lengths) {
            const double own = std::sqrt(lengths.front() / length);
            const double mean = std::hypot(own, between) * deviate(random);
            runs.push_back(run_of(mean, with_errors ? own : not_available, 50.0));
        }
        const Estimate e = ensemble(runs, lengths).estimate;
        shares.held += std::fabs(e.mean) <= 1.96 * e.error ? 1.0 / repetitions : 0.0;
        shares.beyond_three += std::fabs(e.mean) > 3.0 * e.error ? 1.0 / repetitions : 0.0;
    }
    return shares;
}

// A long run pulls the mean towards itself, so its distance from the mean contains little about its
// error. The standard deviation of a share is 0.35 %.
TEST(Ensemble, CoverageHoldsForUnequalLengths) {
    Random random(18);
    for (const std::vector<double>& lengths : std::vector<std::vector<double>>{
             {295, 8}, {295, 295, 8}, {100, 50, 20}, {400, 100, 100}, {400, 400, 400, 100, 100}}) {
        EXPECT_GT(shares_of(lengths, 30.0, false, random).held, 0.935)
            << lengths.front() << " … " << lengths.back() << ", " << lengths.size();
        // The same holds if the blocks contain the whole error, and the short run is merely
        // uncertain.
        EXPECT_GT(shares_of(lengths, 0.0, true, random).held, 0.935)
            << lengths.front() << " … " << lengths.back() << ", " << lengths.size();
    }
}

// The coverage that the header documents for few seeds with differences of the size of their
// errors.
TEST(Ensemble, CoverageOfFewSeedsIsAsDocumented) {
    struct Said {
        std::size_t seeds;
        double held, beyond_three;
    };
    Random random(19);
    for (const Said said :
         {Said{2, 0.74, 0.17}, {3, 0.84, 0.08}, {5, 0.89, 0.04}, {8, 0.92, 0.02}}) {
        Shares worst{1.0, 0.0};
        for (const double between : {1.0, 1.5, 2.0, 3.0, 5.0, 7.0}) {
            const Shares s = shares_of(std::vector<double>(said.seeds, 1.0), between, true, random);
            worst.held = std::min(worst.held, s.held);
            worst.beyond_three = std::max(worst.beyond_three, s.beyond_three);
        }
        // The tolerance is the last documented digit plus two standard deviations, √(p (1 −
        // p)/4000).
        EXPECT_NEAR(worst.held, said.held, 0.02) << said.seeds;
        EXPECT_NEAR(worst.beyond_three, said.beyond_three, 0.015) << said.seeds;
    }
}

TEST(ReplicateWeights, ShortRunsCountOnlyIfAllAreShort) {
    using Weights = std::vector<double>;
    EXPECT_EQ(replicate_weights(std::vector{4.9, 5.0, 10.0}, true), (Weights{0.0, 5.0, 10.0}));
    EXPECT_EQ(replicate_weights(std::vector{4.9, 5.0, 10.0}, false), (Weights{0.0, 1.0, 1.0}));
    EXPECT_EQ(replicate_weights(std::vector{3.0, 1.0}, true), (Weights{3.0, 1.0}));
    EXPECT_EQ(replicate_weights(std::vector{3.0, 1.0}, false), (Weights{1.0, 1.0}));
    EXPECT_EQ(replicate_weights(std::vector{0.0, 0.0}, true), (Weights{1.0, 1.0}));
    // Equal lengths are no weights at all, bitwise.
    EXPECT_EQ(replicate_weights(std::vector{80.0, 80.0, 2.0}, true), (Weights{1.0, 1.0, 0.0}));
    const std::vector<Estimate> runs{run_of(1.0, 0.1), run_of(3.0, 0.1), run_of(99.0, 0.1)};
    const Ensemble all = ensemble(runs, Weights{1.0, 1.0, 0.0});
    EXPECT_EQ(all.estimate.mean, 2.0);
    EXPECT_EQ(all.runs, 2u);
}

// Independent of the order: angles that differ by whole turns are the same direction.
TEST(Ensemble, DirectionsOnBothSidesOfZeroAverageToZero) {
    for (const auto& [first, second] : {std::pair{10.0, 350.0}, std::pair{350.0, 10.0}}) {
        const std::vector<Estimate> runs{run_of(first, 20.0), run_of(second, 20.0)};
        const double mean = several_directions(runs).estimate.mean;
        EXPECT_NEAR(std::remainder(mean, 360.0), 0.0, 1e-12) << first;
        EXPECT_GE(mean, 0.0);
        EXPECT_LT(mean, 360.0);
    }
}

}  // namespace
}  // namespace swirl
