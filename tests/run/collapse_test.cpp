#include "swirl/run/collapse_guard.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <string>

namespace swirl {
namespace {

constexpr std::uint64_t always_progresses = std::numeric_limits<std::uint64_t>::max();

/// The event at which a collapse is found in a run that makes no progress after `stops_after`
/// events. The run is checked after every 250 events.
std::string found(std::size_t discs, std::uint64_t stops_after, std::uint64_t end) {
    RunMark now{0, 0.0};
    CollapseWatch watch(discs, now);
    while (now.events < end) {
        now.events += 250;
        if (now.events <= stops_after) now.periods += 0.001;
        if (watch.check(now)) return std::to_string(now.events);
    }
    return watch.check_at_end(now) ? "at the end" : "never";
}

TEST(Collapse, IsNotFoundInARunThatProgresses) {
    EXPECT_EQ(found(48, always_progresses, 1'000'000), "never");
}

// Windows of 20,000 events, or of 200 per disc. The window in which time stops contains progress.
TEST(Collapse, IsFoundInTheFirstWindowWithoutProgress) {
    EXPECT_EQ(found(48, 0, 1'000'000), "20000");
    EXPECT_EQ(found(48, 100'000, 1'000'000), "120000");
    EXPECT_EQ(found(2000, 0, 1'000'000), "400000");
}

TEST(Collapse, IsFoundAtTheEndWithAtLeast500Events) {
    EXPECT_EQ(found(48, 100'000, 105'000), "at the end");
    EXPECT_EQ(found(48, 100'000, 101'000), "at the end");
    EXPECT_EQ(found(48, 100'000, 100'250), "never");
}

// 10⁸ events per disc and period: for two discs, 20,000 events in a ten-thousandth of a period.
// With three discs these are too few.
TEST(Collapse, ThresholdIsEventsPerDiscAndPeriod) {
    const RunMark begin{0, 0.0}, now{20'000, 0.99e-4};
    EXPECT_TRUE(CollapseWatch(2, begin).check(now));
    EXPECT_FALSE(CollapseWatch(3, begin).check(now));
    const auto collapse = CollapseWatch(2, begin).check(now);
    EXPECT_EQ(collapse->events, 20'000u);
    EXPECT_EQ(collapse->periods, 0.99e-4);
}

TEST(Collapse, TextDoesNotCountZeroPeriods) {
    EXPECT_EQ(duration_of({20'000, 0.99e-4}).english(), "only 9.9e-05 periods");
    EXPECT_EQ(duration_of({500, 0.0}).english(), "no measurable time");
}

}  // namespace
}  // namespace swirl
