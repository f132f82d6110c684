#include "swirl/statistics/crossing_search.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <set>

namespace swirl {
namespace {

using Curve = std::function<double(double)>;

/// A run with the known mean and an error of 0.02/√length; the length of the first runs is 100.
SearchedRun run_of(const Curve& curve, const ProposedRun& run) {
    const double length = 100.0 * double(run.length);
    Estimate e{.mean = curve(double(run.discs)), .error = 0.02 / std::sqrt(length)};
    e.effective_samples = length;
    return {{e}, length};
}

/// Continues the search to its end. Returns the number of runs at each number of discs.
std::map<std::int64_t, int> complete(CrossingSearch& search, const Curve& curve) {
    std::map<std::int64_t, int> made;
    for (auto runs = search.next(); !runs.empty(); runs = search.next())
        for (const ProposedRun& run : runs) {
            const SearchedRun result = run_of(curve, run);
            search.take(run, &result);
            ++made[run.discs];
        }
    return made;
}

double falling(double n) { return 0.01 * (38.4 - n); }

// The three ways to search with the same rules: command line and map (three or two runs at a time),
// page (one).
TEST(CrossingSearch, FindsTheZeroOfALineWithAnyNumberOfRunsAtATime) {
    for (const std::int64_t seeds : {1, 2, 3})
        for (const bool longer : {true, false})
            for (const std::int64_t at_once : {1, 3}) {
                CrossingSearch search(
                    {.tolerance = 0.02, .seeds = seeds, .longer_runs = longer, .at_once = at_once});
                const auto made = complete(search, falling);
                EXPECT_NEAR(search.crossing().discs, 38.4, 1e-9);  // a line: rounding only
                EXPECT_TRUE(search.is_within_tolerance());
                EXPECT_GT(made.at(38), made.at(5));
                EXPECT_EQ(made.at(5), int(seeds));
                EXPECT_TRUE(search.next().empty());
            }
}

// A search next to the N_c of a neighbour goes beyond its numbers where N_c is not between them.
TEST(CrossingSearch, GoesBeyondTheNumbersAtWhichItStarts) {
    CrossingSearch near({.start = {37, 40}}), far({.start = {12, 14}});
    const auto made = complete(near, falling);
    EXPECT_EQ(made.begin()->first, 37);
    EXPECT_EQ(made.rbegin()->first, 40);
    complete(far, falling);
    EXPECT_NEAR(far.crossing().discs, 38.4, 1e-9);
}

TEST(CrossingSearch, BeginsWithEveryNumberOfItsStep) {
    for (const std::int64_t step : {1, 4}) {
        CrossingSearch search({.from = 20, .to = 30, .seeds = 1, .step = step});
        std::set<std::int64_t> numbers, expected{30};
        for (const ProposedRun& run : search.next()) numbers.insert(run.discs);
        for (std::int64_t n = 20; n < 30; n += step) expected.insert(n);
        EXPECT_EQ(numbers, expected) << step;
    }
}

TEST(CrossingSearch, NarrowsFromTheMiddleOfABracket) {
    CrossingSearch search({.from = 10, .to = 40, .seeds = 1, .step = 30});
    const auto take_all = [&](const std::vector<ProposedRun>& runs) {
        for (const ProposedRun& run : runs) {
            const SearchedRun result = run_of(falling, run);
            search.take(run, &result);
        }
    };
    take_all(search.next());
    const auto runs = search.next();
    ASSERT_EQ(runs.size(), 1u);
    EXPECT_EQ(runs[0].discs, 25);
}

TEST(CrossingSearch, NarrowsTheLastOfTwoChangesOrBoth) {
    // Zeros at 12.3 and 38.4.
    const auto twice = [](double n) { return 0.001 * (38.4 - n) * (n - 12.3); };
    for (const bool every_change : {true, false}) {
        CrossingSearch search(
            {.from = 5, .to = 45, .seeds = 1, .step = 10, .every_change = every_change});
        const auto made = complete(search, twice);
        EXPECT_EQ(made.contains(12) && made.contains(13), every_change);
        EXPECT_TRUE(made.contains(38) && made.contains(39));
    }
}

TEST(CrossingSearch, ALargerRangeContinuesTheSearch) {
    CrossingRules rules{.from = 5, .to = 30};
    CrossingSearch search(rules);
    const auto made = complete(search, falling);
    EXPECT_EQ(search.crossing().verdict, Crossing::Verdict::always_rotates);
    search.extend(5, 48, rules.max_runs);
    for (const auto& [n, runs] : complete(search, falling)) EXPECT_FALSE(made.contains(n)) << n;
    EXPECT_NEAR(search.crossing().discs, 38.4, 1e-9);
}

TEST(CrossingSearch, NeverExceedsTheMaximumOfRuns) {
    CrossingSearch search({.tolerance = 1e-9, .max_runs = 7, .longer_runs = false});
    for (const auto& [n, runs] : complete(search, falling)) EXPECT_LE(runs, 7) << n;
    EXPECT_FALSE(search.is_within_tolerance());
}

// Runs that fail are neither repeated nor counted.
TEST(CrossingSearch, EndsIfEveryRunFails) {
    CrossingSearch search({});
    int made = 0;
    for (auto runs = search.next(); !runs.empty(); runs = search.next())
        for (const ProposedRun& run : runs) {
            search.take(run, nullptr);
            ++made;
        }
    EXPECT_EQ(made, 3 * 8);
    EXPECT_EQ(search.crossing().verdict, Crossing::Verdict::undecided);
}

}  // namespace
}  // namespace swirl
