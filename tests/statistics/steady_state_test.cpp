#include "swirl/statistics/steady_state.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include "measure/snapshots.hpp"

namespace swirl {
namespace {

using Verdict = SteadyState::Verdict;

/// Autoregressive noise with a variance of one.
std::vector<double> correlated_noise(std::size_t blocks, double a, std::uint64_t seed) {
    Noise noise(seed);
    std::vector<double> all;
    double value = 0.0;
    for (std::size_t b = 0; b < blocks + 100; ++b) {
        value = a * value + std::sqrt(3.0 * (1.0 - a * a)) * noise();
        if (b >= 100) all.push_back(value);
    }
    return all;
}

/// The number of 200 such series, with `shape(block)` added, for which `is_found(state)` is true.
template <class Shape, class IsFound>
int count_if(std::size_t blocks, double a, const Shape& shape, const IsFound& is_found) {
    int found = 0;
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
        std::vector<double> all = correlated_noise(blocks, a, seed);
        for (std::size_t b = 0; b < blocks; ++b) all[b] += shape(b);
        found += is_found(find_steady_state(all)) ? 1 : 0;
    }
    return found;
}
/// The number that have this verdict.
template <class Shape>
int count(Verdict verdict, std::size_t blocks, double a, const Shape& shape) {
    return count_if(blocks, a, shape,
                    [&](const SteadyState& state) { return state.verdict == verdict; });
}

TEST(SteadyState, SteadySeriesAreSteady) {
    const auto nothing = [](std::size_t) { return 0.0; };
    // Measured: below 0.1 % with 100 effective samples, so that 200 series have one at most.
    EXPECT_GE(count(Verdict::steady, 200, 0.0, nothing), 199);
    EXPECT_GE(count(Verdict::steady, 1000, 0.6, nothing), 199);
    // Below 1.5 % with fewer: 3 of 200, with a scatter of 1.7; three scatters more are 8.
    const auto is_alarm = [](const SteadyState& state) {
        return state.verdict != SteadyState::Verdict::steady &&
               state.verdict != SteadyState::Verdict::too_short;
    };
    EXPECT_LE(count_if(250, 0.8, nothing, is_alarm), 8);
    EXPECT_LE(count_if(50, 0.6, nothing, is_alarm), 8);
}

// With a limit of 79 standard errors, a change of 16 errors would pass as steady. 50 blocks with
// these correlations have 12 and 3 effective samples, 250 have 28, and 1000 have 110.
TEST(SteadyState, LargeLimitIsNoTest) {
    const auto nothing = [](std::size_t) { return 0.0; };
    for (const auto& [blocks, a] : {std::pair{50u, 0.6}, {50u, 0.9}, {250u, 0.8}, {1000u, 0.8}})
        EXPECT_EQ(
            count_if(blocks, a, nothing,
                     [](const SteadyState& state) {
                         const MeanChange& change = state.change;
                         return state.verdict == Verdict::steady &&
                                (std::abs(change.size) > 10.0 || change.effective_samples < 25.0);
                     }),
            0)
            << blocks;
    // Most series with three effective samples, and none with 250.
    EXPECT_GE(count(Verdict::too_short, 50, 0.9, nothing), 150);
    EXPECT_EQ(count(Verdict::too_short, 1000, 0.6, nothing), 0);
}

// A jump by three standard deviations of the blocks, or 16 errors of the difference where one part
// has a tenth of the run. A test that dropped the blocks before the jump would miss it, though the
// average contains them.
TEST(SteadyState, AJumpDoesNotHideItself) {
    for (const std::size_t at : {100u, 300u, 500u, 900u}) {
        const auto jump = [at](std::size_t b) { return b < at ? 3.0 : 0.0; };
        EXPECT_GE(count(Verdict::jumping, 1000, 0.5, jump), 195) << at;
    }
    std::vector<double> blocks = correlated_noise(300, 0.0, 5);
    for (int b = 0; b < 60; ++b) blocks[b] += 10.0;
    const SteadyState state = find_steady_state(blocks);
    EXPECT_EQ(state.verdict, Verdict::jumping);
    EXPECT_EQ(state.change.at, 60u);
    EXPECT_NEAR(state.change.before, 10.0, 0.5);
    EXPECT_NEAR(state.change.after, 0.0, 0.3);
}

// From a noisy state to a quiet one, as five discs with little friction do.
TEST(SteadyState, ChangeOfTheNoiseDoesNotHideAJump) {
    std::vector<double> blocks = correlated_noise(1500, 0.5, 3);
    for (std::size_t b = 0; b < blocks.size(); ++b)
        blocks[b] = b < 430 ? 0.7 + 0.15 * blocks[b] : 1.0 + 0.01 * blocks[b];
    EXPECT_EQ(find_steady_state(blocks).verdict, Verdict::jumping);
}

TEST(SteadyState, GradualChangeIsADrift) {
    const auto line = [](std::size_t b) { return 0.004 * double(b); };
    EXPECT_GE(count(Verdict::drifting, 1000, 0.5, line), 195);
    // A slow transient would enlarge its own error.
    const auto saturation = [](std::size_t b) { return -20.0 * std::exp(-double(b) / 40.0); };
    EXPECT_GE(count(Verdict::drifting, 300, 0.0, saturation), 195);
}

TEST(SteadyState, TwoStatesAreFoundIfTheyLast) {
    const auto switches = [](std::size_t b) { return b / 60 % 2 == 0 ? 0.0 : 5.0; };
    EXPECT_GE(count(Verdict::switching, 1000, 0.3, switches), 195);
    std::vector<double> blocks = correlated_noise(1000, 0.3, 8);
    for (std::size_t b = 0; b < blocks.size(); ++b) blocks[b] = 0.2 * blocks[b] + switches(b);
    const TwoStates states = find_steady_state(blocks).states;
    EXPECT_EQ(states.changes, 16u);  // 1000/60 = 16.7 visits: 17 begin
    EXPECT_NEAR(states.low, 0.0, 0.1);
    EXPECT_NEAR(states.high, 5.0, 0.1);
    // A single outlier is not a state.
    blocks = correlated_noise(1000, 0.3, 8);
    blocks[500] = -300.0;
    EXPECT_EQ(find_steady_state(blocks).verdict, Verdict::steady);
}

TEST(Mser5, MinimisesTheSquaredStandardErrorAndNotTheVariance) {
    // Ten batches that alternate, ±1.1 and then ±1. The last five have the smaller variance, 0.96
    // against 1.105, but the mean of fewer batches has the larger squared error: 0.96/5 = 0.192
    // against 0.1105. So nothing is cut off.
    std::vector<double> blocks;
    for (int batch = 0; batch < 10; ++batch)
        blocks.insert(blocks.end(), 5, (batch % 2 == 0 ? 1.0 : -1.0) * (batch < 5 ? 1.1 : 1.0));
    EXPECT_EQ(mser5_truncation(blocks), 0u);
    // A beginning far from the remainder is cut off.
    for (int block = 0; block < 10; ++block) blocks[static_cast<std::size_t>(block)] += 100.0;
    EXPECT_EQ(mser5_truncation(blocks), 10u);
}

TEST(BeginningIsForgotten, OnlyAfterATransientHasEnded) {
    // A mean spin that saturates as exp(−t/60), as it does without disc friction.
    int early = 0, late = 0;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        Noise noise(seed);
        std::vector<double> blocks;
        std::size_t forgotten = 0;
        for (int t = 0; t < 1000 && forgotten == 0; ++t) {
            blocks.push_back(1.0 - std::exp(-t / 60.0) + 0.05 * noise());
            if (t % 10 == 0 && beginning_is_forgotten(blocks)) forgotten = blocks.size();
        }
        early += forgotten > 0 && forgotten < 120 ? 1 : 0;  // still 13 % to go
        // MSER-5 detects the transient until it vanishes in the noise after some 300 blocks. It
        // then cuts off less than half.
        late += forgotten == 0 || forgotten > 900 ? 1 : 0;
    }
    EXPECT_EQ(early, 0);
    EXPECT_LE(late, 2);  // a run ends the search after half of itself
}

TEST(BeginningIsForgotten, AtOnceWithoutATransient) {
    int waited = 0;
    for (std::uint64_t seed = 1; seed <= 100; ++seed) {
        Noise noise(seed);
        std::vector<double> blocks;
        for (int t = 0; t < 50; ++t) blocks.push_back(noise());
        EXPECT_FALSE(beginning_is_forgotten(std::span(blocks).first(49)));
        waited += beginning_is_forgotten(blocks) ? 0 : 1;
    }
    EXPECT_LE(waited, 30);  // a false alarm costs ten more periods
}

TEST(WithoutTrend, StraightLineHasNoResiduals) {
    std::vector<double> line;
    for (int i = 0; i < 20; ++i) line.push_back(3.0 - 0.5 * i);
    for (const double residual : without_trend(line)) EXPECT_NEAR(residual, 0.0, 1e-14);
    EXPECT_EQ(without_trend(std::vector<double>{7.0}), std::vector<double>{0.0});
}

TEST(WithoutTrend, EmptySeriesStaysEmpty) { EXPECT_TRUE(without_trend({}).empty()); }

TEST(SteadyState, NaNBlocksHaveNoVerdict) {
    const std::vector<double> unknown(100, not_available);
    EXPECT_EQ(find_steady_state(unknown).verdict, Verdict::too_short);
    EXPECT_FALSE(beginning_is_forgotten(unknown));
}

TEST(SteadyState, ShortSeriesHasNoVerdict) {
    EXPECT_EQ(find_steady_state({}).verdict, Verdict::too_short);
    const std::vector<double> few(49, 1.0);
    EXPECT_EQ(find_steady_state(few).verdict, Verdict::too_short);
    const std::vector<double> constant(50, 1.0);
    EXPECT_EQ(find_steady_state(constant).verdict, Verdict::steady);
    EXPECT_EQ(mser5_truncation(constant), 0u);
}

// Two equal halves without correlation: n effective samples each, of which a line takes two.
TEST(SteadyState, LinesCostTwoDegreesOfFreedomEach) {
    std::vector<double> half, both;
    for (int k = 0; k < 20; ++k) half.push_back(k % 4 == 1 || k % 4 == 2 ? 1.0 : -1.0);
    both = half;
    both.insert(both.end(), half.begin(), half.end());
    ASSERT_EQ(estimate_of(half).effective_samples, 20.0);
    EXPECT_NEAR(errors_of_difference(both, 20).separate.freedom, 2.0 * (20.0 - 2.0), 1e-9);
    // With a correlation over both, all of them are one sample, less two lines.
    std::vector<double> drift;
    for (int k = 0; k < 40; ++k) drift.push_back(k < 20 ? 1.0 : -1.0);
    const DifferenceError slow = errors_of_difference(drift, 20).joint;
    EXPECT_EQ(slow.freedom, estimate_of(drift).effective_samples - 4.0);
}

TEST(SteadyState, ConstantSeriesHasNoChange) {
    const std::vector<double> same(100, 0.25);
    EXPECT_EQ(transient(same).size, 0.0);
    EXPECT_EQ(most_likely_change(same).size, 0.0);
}

// Batches of +1 and −1 in turn: every batch that is dropped makes the error of the mean larger.
TEST(Mser5, DropsNothingOfASteadySeries) {
    std::vector<double> blocks;
    for (int k = 0; k < 200; ++k) blocks.push_back(k / 5 % 2 ? 1.0 : -1.0);
    EXPECT_EQ(mser5_truncation(blocks), 0u);
}

}  // namespace
}  // namespace swirl
