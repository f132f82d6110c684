// Estimates of the remaining time, with given times instead of a clock.
#include "swirl/statistics/remaining_time.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

namespace swirl {
namespace {

/// Expects the estimates after five seconds to be correct within a factor of two or within two
/// seconds.
void expect_within_a_factor_of_two(const RemainingTime& estimate, double now, double end) {
    if (now < 5.0 || now >= end) return;
    const auto left = estimate.seconds_left();
    ASSERT_TRUE(left) << "at " << now;
    EXPECT_LE(*left, 2.0 * (end - now) + 2.0) << "at " << now;
    EXPECT_GE(*left, 0.5 * (end - now) - 2.0) << "at " << now;
}

/// A task whose share at a time is `share_at`, reported ten times per second.
void follow(double end, const std::function<double(double)>& share_at) {
    RemainingTime estimate;
    for (double now = 0.1; now < end; now += 0.1) {
        estimate.add(now, "", share_at(now));
        expect_within_a_factor_of_two(estimate, now, end);
    }
}

TEST(RemainingTime, OfAConstantRateIsExact) {
    RemainingTime estimate;
    for (int k = 1; k < 1'000; ++k) {
        estimate.add(0.1 * k, "", 0.001 * k);
        ASSERT_TRUE(estimate.seconds_left());
        // Rounding of the shares.
        EXPECT_NEAR(*estimate.seconds_left(), 100.0 - 0.1 * k, 1e-6);
    }
}

TEST(RemainingTime, TheTimeBeforeTheFirstProgressDoesNotCount) {
    // Four seconds to place the discs, then thirty of progress.
    follow(34.0, [](double now) { return now < 4.0 ? 0.0 : (now - 4.0) / 30.0; });
}

TEST(RemainingTime, ASlowBeginningIsForgotten) {
    // The first 2 % take four seconds, the others thirty.
    follow(34.0,
           [](double now) { return now < 4.0 ? 0.005 * now : 0.02 + 0.98 * (now - 4.0) / 30.0; });
}

TEST(RemainingTime, FollowsARunThatMeasuresAfterItsWarmUp) {
    // One fifth of the run at 1.74 times the speed: the measurements of the paper's figures
    // (docs/reference/measurements.md).
    const double fast = 0.2 * 100.0 / 1.74, end = fast + 80.0;
    follow(end,
           [&](double now) { return now < fast ? 0.2 * now / fast : 0.2 + (now - fast) / 100.0; });
}

TEST(RemainingTime, FollowsASweepThatReportsWholeRuns) {
    // Two runs end every three seconds.
    follow(60.0, [](double now) { return std::floor(now / 3.0) / 20.0; });
}

TEST(RemainingTime, OfAResumedTaskDoesNotCountTheShareDoneBefore) {
    RemainingTime estimate;
    for (int k = 0; k <= 60; ++k) estimate.add(3.0 + 0.1 * k, "", 0.9 + 0.001 * k);
    EXPECT_NEAR(*estimate.seconds_left(), 4.0, 1e-6);
}

TEST(RemainingTime, IsUnknownWithoutProgress) {
    RemainingTime estimate;
    EXPECT_FALSE(estimate.seconds_left());
    estimate.add(1.0, "", 0.0);
    estimate.add(9.0, "", 0.0);
    EXPECT_FALSE(estimate.seconds_left());
}

TEST(RemainingTime, OfKnownStagesIncludesThoseToCome) {
    RemainingTime estimate({{"first", 1.0}, {"second", 3.0}});
    for (int k = 1; k <= 50; ++k) estimate.add(0.1 * k, "first", 0.01 * k);
    EXPECT_NEAR(*estimate.seconds_left(), 5.0 + 30.0, 1e-6);
    EXPECT_NEAR(estimate.fraction(), 0.125, 1e-12);
    estimate.add(10.0, "second", 0.0);
    EXPECT_NEAR(estimate.fraction(), 0.25, 1e-12);
    estimate.add(13.0, "second", 0.1);
    estimate.add(16.0, "second", 0.2);
    EXPECT_NEAR(*estimate.seconds_left(), 24.0, 1e-6);
}

TEST(RemainingTime, ALongTaskKeepsFewSamplesAndStaysExact) {
    RemainingTime estimate;
    for (int k = 1; k < 100'000; ++k) estimate.add(0.1 * k, "", 1e-5 * k);
    EXPECT_NEAR(*estimate.seconds_left(), 0.1, 1e-3);
}

// Recorded, as processor time on one core: `swirl track VIDEO --spin` with the video of
// `swirl synthetic-video --frame-count 600 --scale 20`. The shares are the per cent of the bar.
constexpr const char *survey = "surveying the video", *discs = "finding discs",
                     *missing = "finding missing discs", *spins = "measuring spins";
struct Report {
    double seconds;
    const char* stage;
    int percent;
};
const std::vector<Report> tracking{
    {0.02, survey, 2},  {2.06, discs, 1},   {2.48, discs, 10},  {2.91, discs, 19},
    {3.32, discs, 29},  {3.73, discs, 38},  {4.15, discs, 47},  {4.56, discs, 57},
    {4.97, discs, 66},  {5.37, discs, 75},  {5.78, discs, 84},  {6.19, discs, 93},
    {6.58, missing, 0}, {6.82, spins, 0},   {7.27, spins, 7},   {7.69, spins, 11},
    {8.12, spins, 15},  {8.57, spins, 19},  {9.01, spins, 23},  {9.43, spins, 27},
    {9.88, spins, 31},  {10.3, spins, 35},  {10.74, spins, 39}, {11.18, spins, 43},
    {11.61, spins, 47}, {12.05, spins, 51}, {12.5, spins, 55},  {12.94, spins, 59},
    {13.37, spins, 63}, {13.8, spins, 67},  {14.24, spins, 71}, {14.67, spins, 75},
    {15.09, spins, 79}, {15.51, spins, 83}, {15.93, spins, 87}, {16.36, spins, 91},
    {16.76, spins, 95}, {17.17, spins, 99}};
constexpr double tracking_end = 17.17;

TEST(RemainingTime, FollowsTheStagesOfARecordedTracking) {
    // The weights of cli/tracked_video.cpp for 600 frames.
    RemainingTime estimate({{survey, 270.0}, {discs, 600.0}, {missing, 30.0}, {spins, 1380.0}});
    for (const Report& report : tracking) {
        estimate.add(report.seconds, report.stage, 0.01 * report.percent);
        if (report.percent > 0)
            expect_within_a_factor_of_two(estimate, report.seconds, tracking_end);
    }
}

}  // namespace
}  // namespace swirl
