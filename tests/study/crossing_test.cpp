#include "swirl/study/crossing.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <functional>
#include <mutex>
#include <set>

#include "swirl/math/random.hpp"
#include "swirl/run/failure.hpp"

namespace swirl {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

CrossingSettings short_search(double mu) {
    CrossingSettings settings;
    settings.config.mu_disc = settings.config.mu_wall = mu;
    settings.config.events = 20'000;
    settings.from = 24;
    settings.rounds = 1;
    settings.tolerance = 5.0;
    settings.seeds = 2;
    settings.min_periods = 50;
    return settings;
}

/// Replaces runs by a known curve. The mean over the discs is curve(N), and the rate of the rigid
/// body is smaller by `lower`. Both have normal errors of `error` for a hundred periods after the
/// warm-up.
CrossingControl planted(const std::function<double(double)>& curve, double error,
                        double lower = 0.02) {
    CrossingControl control;
    control.make_run = [=](const RunConfig& config, const RunControl&) {
        RunResult r;
        r.config = config;
        r.complete = true;
        r.warmup = default_warmup;
        r.periods = static_cast<double>(config.periods.value_or(1000));
        r.events.disc_disc = static_cast<std::uint64_t>(config.events);
        Random random(config.seed * 1000 + static_cast<std::uint64_t>(config.discs));
        double gauss = -6.0;
        for (int k = 0; k < 12; ++k) gauss += random.uniform();
        const double own = error * std::sqrt(100.0 / (r.periods - default_warmup));
        const double n = static_cast<double>(config.discs), mean = curve(n) + own * gauss;
        const Estimate individual{.mean = mean, .error = own, .effective_samples = 100.0};
        Estimate rigid = individual;
        rigid.mean -= lower;
        r.rotation = {individual, individual, rigid, rigid};
        return r;
    };
    return control;
}

double bent(double n) { return -0.007 * (n - 47.5) + 0.0004 * (n - 47.5) * (n - 47.5); }
/// The zero of bent() between 47 and 48.
const double zero_of_bent = 47.0 + bent(47.0) / (bent(47.0) - bent(48.0));

TEST(CrossingSearch, FindsTheSameForEveryRangeThatContainsTheCrossing) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        CrossingSettings settings;
        settings.config.seed = 1000 * seed;
        settings.to = 53;
        const CrossingResult first = search_crossing(settings, planted(bent, 0.002));
        ASSERT_TRUE(first.crossing().last() && first.crossing().last()->resolved());
        for (const auto& [from, to] : {std::pair(5, 50), {5, 52}, {20, 55}, {43, 51}}) {
            settings.from = from;
            settings.to = to;
            const CrossingResult other = search_crossing(settings, planted(bent, 0.002));
            for (std::size_t r = 0; r < rotation_rates.size(); ++r) {
                if (r >= 2 && from > 40) continue;  // the rigid body crosses below this range
                EXPECT_EQ(other.crossings[r].discs, first.crossings[r].discs) << from << to << r;
                EXPECT_EQ(other.crossings[r].error, first.crossings[r].error);
                EXPECT_EQ(other.crossings[r].lower, first.crossings[r].lower);
                EXPECT_EQ(other.crossings[r].upper, first.crossings[r].upper);
            }
        }
        // A range that ends at a number with an undetermined sign has other replicates.
        settings.from = 5;
        settings.to = 48;
        const Crossing edge = search_crossing(settings, planted(bent, 0.002)).crossing();
        ASSERT_TRUE(edge.last() && edge.last()->resolved());
        EXPECT_NEAR(edge.discs, first.crossing().discs,
                    3.0 * std::hypot(edge.error, first.crossing().error));
    }
}

// 400 searches of a bent curve: the standard deviation of a fraction of 0.95 is 0.011, that of
// 0.683 is 0.023. The interval is conservative if an undetermined point takes part.
TEST(CrossingSearch, IntervalsContainTheZeroOfAKnownCurve) {
    constexpr int searches = 400;
    for (const double tolerance : {1.0, 0.1}) {
        int contained = 0, within_error = 0;
        double off = 0.0, error = 0.0;
        for (std::uint64_t seed = 1; seed <= searches; ++seed) {
            CrossingSettings settings;
            settings.from = 38;
            settings.to = 52;
            settings.config.seed = 1000 * seed;
            settings.tolerance = tolerance;
            const Crossing c = search_crossing(settings, planted(bent, 0.004)).crossing();
            ASSERT_EQ(c.verdict, Crossing::Verdict::crosses);
            contained += c.lower <= zero_of_bent && zero_of_bent <= c.upper;
            within_error += std::fabs(c.discs - zero_of_bent) <= c.error;
            off += std::pow(c.discs - zero_of_bent, 2);
            error += c.error * c.error;
        }
        EXPECT_GE(contained, 0.91 * searches) << tolerance;
        EXPECT_LE(contained, 0.995 * searches) << tolerance;
        EXPECT_GE(within_error, 0.61 * searches) << tolerance;
        EXPECT_LE(within_error, 0.80 * searches) << tolerance;
        const double ratio = std::sqrt(off / error);
        EXPECT_GT(ratio, 0.7) << tolerance;
        EXPECT_LT(ratio, 1.1) << tolerance;
    }
}

// With the variance v of a mean over one period and the slope b, the tolerance t needs v/(t b)²
// periods at the two numbers next to the zero (crossing_search.hpp). The search does not know v and
// b before, and needs certain signs at the numbers around: a quarter more from overshooting, and as
// much again.
TEST(CrossingSearch, MakesAtMostThreeTimesTheRunsThatTheToleranceNeeds) {
    constexpr double slope = 0.005, error = 0.0025;  // the error is that of 100 periods
    constexpr int searches = 50;
    const auto straight = [](double n) { return -slope * (n - 38.4); };
    const auto periods_of = [&](double tolerance) {
        double periods = 0.0;
        for (int seed = 1; seed <= searches; ++seed) {
            CrossingSettings settings;
            settings.config.seed = 1000 * std::uint64_t(seed);
            settings.tolerance = tolerance;
            CrossingControl control = planted(straight, error);
            control.threads = 1;
            control.make_run = [&, make = control.make_run](const RunConfig& c,
                                                            const RunControl& inner) {
                RunResult r = make(c, inner);
                periods += r.periods;
                return r;
            };
            EXPECT_TRUE(search_crossing(settings, control).within_tolerance);
        }
        return periods / searches;
    };
    const double scan = periods_of(10.0);
    for (const double tolerance : {0.1, 0.05, 0.02})
        EXPECT_LT(periods_of(tolerance) - scan,
                  3.0 * 100.0 * std::pow(error / (tolerance * slope), 2))
            << tolerance;
}

TEST(CrossingSearch, ContinuesUntilTheToleranceIsReached) {
    CrossingSettings settings;
    for (const double tolerance : {0.3, 0.1, 0.03}) {
        settings.tolerance = tolerance;
        const CrossingResult search = search_crossing(settings, planted(bent, 0.004));
        EXPECT_TRUE(search.within_tolerance) << tolerance;
        EXPECT_LE(search.crossing().error, tolerance);
        EXPECT_THAT(crossing_report(settings, search), Not(HasSubstr("stopped")));
    }
}

TEST(CrossingSearch, ReportsWhyItStoppedBeforeTheTolerance) {
    CrossingSettings settings;
    settings.tolerance = 0.001;
    settings.rounds = 4;
    settings.min_periods = 100;  // so that four rounds resolve the bracket
    const CrossingResult search = search_crossing(settings, planted(bent, 0.004));
    EXPECT_FALSE(search.within_tolerance);
    EXPECT_GT(search.crossing().error, 0.001);
    EXPECT_THAT(crossing_report(settings, search),
                HasSubstr("stopped before --tolerance 0.001 was reached, after 4 batches of "
                          "longer runs"));
    // 3 runs in the coarse scan, and 3 more in each of four rounds.
    EXPECT_EQ(*std::max_element(search.runs_made.begin(), search.runs_made.end()), 15);
}

TEST(CrossingSearch, EachRateHasACrossingAndOneControlsTheSearch) {
    CrossingSettings settings;
    const auto straight = [](double n) { return -0.01 * (n - 38.3); };
    const CrossingResult mean_by_time = search_crossing(settings, planted(straight, 0.001));
    EXPECT_NEAR(mean_by_time.crossings[1].discs, 38.3, 0.5);
    EXPECT_NEAR(mean_by_time.crossings[3].discs, 36.3, 0.5);
    EXPECT_EQ(mean_by_time.crossing().discs, mean_by_time.crossings[1].discs);
    EXPECT_THAT(crossing_report(settings, mean_by_time),
                HasSubstr(": fewer discs rotate with the swirl, more rotate against it."));
    EXPECT_THAT(rigid_body_crossing(mean_by_time), HasSubstr("N_c = 36."));
    EXPECT_THAT(other_rates_report(mean_by_time.crossings, mean_by_time.rate),
                HasSubstr(" (rigid body, by event)"));
    settings.rate = rate_named("rigid_by_time");
    const CrossingResult rigid = search_crossing(settings, planted(straight, 0.001));
    EXPECT_NEAR(rigid.crossing().discs, 36.3, 0.5);
    EXPECT_THAT(crossing_report(settings, rigid), HasSubstr(" (rigid body, by time): fewer discs"));
    EXPECT_THROW(rate_named("rigid"), UsageError);
}

// If all runs at a number in the bracket fail, there is no estimate.
TEST(CrossingSearch, ReportsABracketWhereAllRunsFail) {
    CrossingSettings settings;
    CrossingControl control = planted([](double n) { return -0.01 * (n - 38.3); }, 0.001);
    control.make_run = [make = control.make_run](const RunConfig& c, const RunControl& inner) {
        if (c.discs == 38 || c.discs == 39) throw Failure("frictional collapse");
        return make(c, inner);
    };
    const CrossingResult search = search_crossing(settings, control);
    EXPECT_TRUE(std::isnan(search.crossing().discs));
    EXPECT_EQ(search.crossing().lower, 37.0);
    EXPECT_EQ(search.crossing().upper, 40.0);
    EXPECT_FALSE(search.within_tolerance);
    EXPECT_THAT(crossing_report(settings, search), HasSubstr("N_c is between 37 and 40"));
    EXPECT_THAT(crossing_json(settings, search, ""), HasSubstr("\"N_c\": null"));
}

// A search and a table of the same curve report the same changes and undetermined numbers.
TEST(CrossingSearch, ListsAllSignChangesAndUndeterminedNumbers) {
    const auto wave = [](double n) {
        return n < 22.4 ? 0.02 : n < 25.4 ? -0.02 : n < 32.4 ? 0.02 : n == 40.0 ? 0.00001 : -0.02;
    };
    CrossingSettings settings;
    settings.from = 16;
    settings.step = 2;
    const CrossingResult search = search_crossing(settings, planted(wave, 0.001, 0.0));
    ASSERT_EQ(search.crossing().changes.size(), 3u);
    EXPECT_EQ(search.crossing().last()->before, 32.0);
    EXPECT_EQ(search.crossing().undetermined, std::vector<double>{40.0});
    const Crossing table = find_crossing(search.points());
    EXPECT_EQ(table.discs, search.crossing().discs);
    const std::string report = crossing_report(settings, search) + other_crossings_report(search);
    EXPECT_THAT(report, HasSubstr("its sign changes 3 times"));
    EXPECT_THAT(report, HasSubstr("The sign is undetermined at N = 40: a later change"));
}

TEST(CrossingSearch, FindsTheOnsetOfCounterrotation) {
    const CrossingResult search = search_crossing(short_search(1.0));
    ASSERT_EQ(search.crossing().verdict, Crossing::Verdict::crosses);
    // Long runs give 37 to 38; these are short.
    EXPECT_NEAR(search.crossing().discs, 37.5, 4.0);
    EXPECT_THAT(crossing_report(short_search(1.0), search), HasSubstr("N_c = "));
}

TEST(CrossingSearch, DoesNotDependOnTheNumberOfCores) {
    CrossingControl one, three;
    one.threads = 1;
    three.threads = 3;
    const CrossingResult a = search_crossing(short_search(1.0), one);
    const CrossingResult b = search_crossing(short_search(1.0), three);
    EXPECT_EQ(a.crossing().discs, b.crossing().discs);
    EXPECT_EQ(a.events, b.events);
}

TEST(CrossingSearch, ReportsEvidenceIfThereIsNoCrossing) {
    CrossingSettings settings = short_search(1.0);
    settings.config.mu_wall = 0.0;
    settings.from = 8;
    settings.to = 20;  // dilute: short runs suffice
    const CrossingResult search = search_crossing(settings);
    EXPECT_EQ(search.crossing().verdict, Crossing::Verdict::always_rotates);
    const std::string report = crossing_report(settings, search);
    EXPECT_THAT(report, HasSubstr("No crossing: the discs always rotate"));
    EXPECT_THAT(report, HasSubstr("between N = 8 and 20 the lowest is"));
}

TEST(CrossingSearch, JsonKeysOfTheNumberOfDiscsAreNc) {
    CrossingResult found;
    found.crossings[default_rate].discs = 36.5;
    found.crossings[default_rate].error = 0.25;
    const std::string json = crossing_json(CrossingSettings{}, found, "swirl crossing");
    EXPECT_THAT(json, HasSubstr("\"N_c\": 36.5"));
    EXPECT_THAT(json, HasSubstr("\"N_c_error\": 0.25"));
    EXPECT_THAT(json, HasSubstr("\"command\": \"swirl crossing\""));
}

// At N = 48, 20,000 events cover only six periods.
TEST(CrossingSearch, EveryRunCoversTheRequestedPeriods) {
    CrossingSettings settings = short_search(1.0);
    settings.from = 46;
    settings.rounds = 0;
    const CrossingResult search = search_crossing(settings);
    EXPECT_EQ(search.too_short, 0);
    EXPECT_EQ(search.runs, 6u);  // two seeds at each of 46, 47, 48
    EXPECT_GT(search.events, 6u * 50u * 2000u);
    for (const std::int64_t runs : search.runs_made) EXPECT_EQ(runs, 2);
}

// Later runs may move a crossing to numbers without runs, which must not end the search.
TEST(CrossingSearch, Slow_AMovingCrossingIsFollowed) {
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

// A run that collapses by friction must not end the search.
TEST(CrossingSearch, FailedRunsAreExcludedCountedAndReported) {
    CrossingSettings settings = short_search(1.0);
    settings.from = 51;
    settings.to = 56;
    settings.config.seed = 2;
    const CrossingResult search = search_crossing(settings);
    ASSERT_FALSE(search.failures.empty());
    ASSERT_FALSE(search.points().empty());
    ASSERT_EQ(search.points().size(), search.runs_made.size());
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
    // The excluded runs are those that fail on their own.
    for (const FailedRuns& f : search.failures) {
        std::int64_t failed = 0;
        for (std::int64_t k = 0; k < f.runs; ++k) {
            RunConfig config = settings.config;
            config.discs = f.discs;
            config.seed += std::uint64_t(k);
            config.periods = default_warmup + settings.min_periods;
            try {
                run(config);
            } catch (const Failure&) {
                ++failed;
            }
        }
        EXPECT_EQ(failed, f.failed) << f.discs;
    }
    const std::string report = crossing_report(settings, search);
    EXPECT_THAT(report, HasSubstr("excluded: "));
    EXPECT_THAT(report, HasSubstr(fmt::format("at N = {}", search.failures.front().discs)));
    EXPECT_THAT(report, HasSubstr("frictional collapse"));
    EXPECT_THAT(crossing_json(settings, search, ""), HasSubstr("\"first_failure\": \"the last "));
}

TEST(CrossingSearch, RejectsInvalidSettings) {
    CrossingSettings backwards = short_search(1.0);
    backwards.from = 48;
    EXPECT_THROW(search_crossing(backwards), UsageError);
    CrossingSettings certain = short_search(1.0);
    certain.tolerance = 0.0;
    EXPECT_THROW(search_crossing(certain), UsageError);
}

/// The report of a search with a known curve.
std::string report_on(const std::function<double(double)>& curve) {
    const CrossingSettings settings;
    return crossing_report(settings, search_crossing(settings, planted(curve, 0.001)));
}

TEST(CrossingSearch, TheRateNearestToZeroIsTheEvidence) {
    EXPECT_THAT(report_on([](double n) { return -0.02 - 0.001 * n; }),
                HasSubstr("always counterrotate; between N = 5 and 48 the highest is ϖ/Ω = −0.02"));
    EXPECT_THAT(report_on([](double n) { return 0.02 + 0.001 * n; }),
                HasSubstr("always rotate; between N = 5 and 48 the lowest is ϖ/Ω = 0.02"));
}

TEST(CrossingSearch, WithoutACrossingNoRunsDecideOnIt) {
    CrossingResult search;
    search.not_steady = search.too_short = search.disagreeing = 2;
    for (const std::string& warning : warnings(search)) EXPECT_THAT(warning, Not(HasSubstr("N_c")));
    search.crossings[search.rate].changes.push_back({38.0, 39.0, true});
    for (const std::string& warning : warnings(search))
        EXPECT_THAT(warning, HasSubstr("that N_c depends on"));
}

// Each seed has another rate, as if it had drawn other sizes. Longer runs do not help.
TEST(CrossingSearch, ScatteringReplicatesGetMoreSeedsAndNotLongerRuns) {
    std::mutex mutex;
    std::set<std::int64_t> lengths;
    CrossingControl control = planted([](double n) { return -0.01 * (n - 38.3); }, 0.001);
    control.make_run = [&, make = control.make_run](const RunConfig& c, const RunControl& inner) {
        RunResult r = make(c, inner);
        const double shift =
            0.06 * (Random(c.seed * 7919 + std::uint64_t(c.discs)).uniform() - 0.5);
        for (Estimate* rate : {&r.rotation.mean_by_event, &r.rotation.mean_by_time,
                               &r.rotation.rigid_by_event, &r.rotation.rigid_by_time})
            rate->mean += shift;
        const std::lock_guard lock(mutex);
        if (c.discs >= 37 && c.discs <= 40) lengths.insert(c.periods.value_or(0));
        return r;
    };
    const CrossingSettings settings;  // tolerance 0.3
    const CrossingResult search = search_crossing(settings, control);
    EXPECT_TRUE(search.within_tolerance);
    EXPECT_NEAR(search.crossing().discs, 38.3, 3.0 * settings.tolerance);
    // Chance may hide the scatter of the first three seeds once, but not twice.
    EXPECT_LE(lengths.size(), 2u);
    EXPECT_GT(*std::max_element(search.runs_made.begin(), search.runs_made.end()), 6);
    EXPECT_LT(search.runs, 500u);
}

// Rates count with the swirl, so the mirror image of a run has the same rate and the same crossing.
TEST(CrossingSearch, AClockwisePathHasTheCrossingOfItsMirrorImage) {
    CrossingSettings settings;
    const CrossingControl control = planted(bent, 0.002);
    const Crossing expected = search_crossing(settings, control).crossing();
    settings.config.clockwise = true;
    const Crossing found = search_crossing(settings, control).crossing();
    EXPECT_EQ(found.discs, expected.discs);
    EXPECT_EQ(found.error, expected.error);
    settings.config.path = PathShape::line;  // no swirl
    EXPECT_THROW(search_crossing(settings, control), UsageError);
}

TEST(CrossingSearch, AStoppedSearchHasItsPoints) {
    CrossingControl control = planted(bent, 0.002);
    std::atomic<int> runs = 0;
    control.make_run = [&, make = control.make_run](const RunConfig& c, const RunControl& inner) {
        RunResult r = make(c, inner);
        r.complete = ++runs <= 10;
        return r;
    };
    control.threads = 1;
    const CrossingSettings settings;
    try {
        search_crossing(settings, control);
        FAIL() << "the search was not stopped";
    } catch (const StoppedSearch& stopped) {
        EXPECT_EQ(stopped.search.runs, 10u);
        EXPECT_EQ(stopped.search.points().size(), 4u);  // three runs each, and one more
        EXPECT_THAT(crossing_report(settings, stopped.search), HasSubstr("was stopped before"));
    }
}

TEST(CrossingSearch, StopsOnRequest) {
    const std::atomic<bool> stop = true;
    CrossingControl control;
    control.stop = &stop;
    EXPECT_THROW(search_crossing(short_search(1.0), control), Interrupted);
}

}  // namespace
}  // namespace swirl
