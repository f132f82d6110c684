#include "swirl/study/crossing.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "swirl/run/failure.hpp"

namespace swirl {
namespace {

using ::testing::HasSubstr;

CrossingSettings short_search(double mu) {
    CrossingSettings settings;
    settings.config.mu_disc = settings.config.mu_wall = mu;
    settings.config.events = 20'000;
    settings.from = 24;
    settings.rounds = 1;
    settings.tolerance = 5.0;
    settings.seeds = 2;
    settings.least_swirls = 50;
    return settings;
}

TEST(CrossingSearch, FindsWhereTheCounterrotationBegins) {
    const CrossingSearch search = search_crossing(short_search(1.0));
    ASSERT_EQ(search.crossing.verdict, Crossing::Verdict::crosses);
    // Long runs give 37 to 38; these are short.
    EXPECT_NEAR(search.crossing.discs, 37.5, 4.0);
    EXPECT_THAT(crossing_report(short_search(1.0), search), HasSubstr("N_c = "));
}

TEST(CrossingSearch, DoesNotDependOnTheNumberOfCores) {
    CrossingControl one, three;
    one.threads = 1;
    three.threads = 3;
    const CrossingSearch a = search_crossing(short_search(1.0), one);
    const CrossingSearch b = search_crossing(short_search(1.0), three);
    EXPECT_EQ(a.crossing.discs, b.crossing.discs);
    EXPECT_EQ(a.events, b.events);
}

TEST(CrossingSearch, WithoutWallFrictionThereIsNoneAndItSaysWhy) {
    CrossingSettings settings = short_search(1.0);
    settings.config.mu_wall = 0.0;
    settings.from = 8;
    settings.to = 20;  // a thin dish: short runs are enough to be certain
    const CrossingSearch search = search_crossing(settings);
    EXPECT_EQ(search.crossing.verdict, Crossing::Verdict::always_rotates);
    const std::string report = crossing_report(settings, search);
    EXPECT_THAT(report, HasSubstr("No crossing: the discs always rotate"));
    EXPECT_THAT(report, HasSubstr("between N = 8 and 20 the lowest is"));
}

TEST(CrossingSearch, ItsJsonCallsTheNumberOfDiscsNc) {
    CrossingSearch found;
    found.crossing.discs = 36.5;
    found.crossing.error = 0.25;
    const std::string json = crossing_json(CrossingSettings{}, found, "swirl crossing");
    EXPECT_THAT(json, HasSubstr("\"N_c\": 36.5"));
    EXPECT_THAT(json, HasSubstr("\"N_c_error\": 0.25"));
    EXPECT_THAT(json, HasSubstr("\"command\": \"swirl crossing\""));
}

// A run of 20,000 events is over after six swirls at N = 48.
TEST(CrossingSearch, EveryRunCoversTheSwirlsThatAreAskedFor) {
    CrossingSettings settings = short_search(1.0);
    settings.from = 46;
    settings.rounds = 0;
    const CrossingSearch search = search_crossing(settings);
    EXPECT_EQ(search.too_short, 0);
    EXPECT_EQ(search.runs, 6u);  // two seeds at each of 46, 47, 48
    EXPECT_GT(search.events, 6u * 50u * 2000u);
    for (const std::int64_t runs : search.runs_made) EXPECT_EQ(runs, 2);
}

// The sign is certain nowhere in the window of a crossing that later runs move: numbers of discs
// that had not been looked at were asked for, and the search died of it.
TEST(CrossingSearchSlow, ACrossingThatMovesIsFollowed) {
    CrossingSettings settings = short_search(1.0);
    settings.config.amplitude = 3.0;
    settings.config.events = 20'000;
    settings.from = 10;
    settings.to = 54;
    settings.tolerance = 0.1;
    settings.rounds = 3;
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        settings.config.seed = seed;
        EXPECT_NO_THROW(search_crossing(settings)) << "seed " << seed;
    }
}

// One seed of the dense dish that collapses by friction had ended the search, and all was lost.
TEST(CrossingSearch, RunsThatFailAreLeftOutCountedAndTold) {
    CrossingSettings settings = short_search(1.0);
    settings.from = 51;
    settings.to = 56;
    settings.config.seed = 2;
    const CrossingSearch search = search_crossing(settings);
    ASSERT_FALSE(search.failures.empty());
    ASSERT_FALSE(search.points.empty());
    ASSERT_EQ(search.points.size(), search.runs_made.size());
    std::int64_t made = 0;
    for (const std::int64_t runs : search.runs_made) {
        EXPECT_GT(runs, 0);
        made += runs;
    }
    EXPECT_EQ(made, std::int64_t(search.runs));
    for (const FailedRuns& f : search.failures) {
        EXPECT_GT(f.failed, 0);
        EXPECT_LE(f.failed, f.runs);
    }
    // What is left out is just what fails by itself.
    for (const FailedRuns& f : search.failures) {
        std::int64_t failed = 0;
        for (std::int64_t k = 0; k < f.runs; ++k) {
            RunConfig config = settings.config;
            config.discs = f.discs;
            config.seed += std::uint64_t(k);
            config.periods = default_warmup + settings.least_swirls;
            try {
                run(config);
            } catch (const Failure&) {
                ++failed;
            }
        }
        EXPECT_EQ(failed, f.failed) << f.discs;
    }
    const std::string report = crossing_report(settings, search);
    EXPECT_THAT(report, HasSubstr("left out: "));
    EXPECT_THAT(report, HasSubstr(fmt::format("at N = {}", search.failures.front().discs)));
    EXPECT_THAT(report, HasSubstr("a collapse"));
    EXPECT_THAT(crossing_json(settings, search, ""), HasSubstr("\"first_failure\": \"The last "));
}

TEST(CrossingSearch, RefusesWhatCannotBeSearched) {
    CrossingSettings backwards = short_search(1.0);
    backwards.from = 48;
    EXPECT_THROW(search_crossing(backwards), WrongCall);
    CrossingSettings certain = short_search(1.0);
    certain.tolerance = 0.0;
    EXPECT_THROW(search_crossing(certain), WrongCall);
}

TEST(CrossingSearch, StopsWhenAsked) {
    const std::atomic<bool> stop = true;
    CrossingControl control;
    control.stop = &stop;
    EXPECT_THROW(search_crossing(short_search(1.0), control), Interrupted);
}

}  // namespace
}  // namespace swirl
