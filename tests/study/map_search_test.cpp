#include "swirl/study/map_search.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <random>
#include <set>

#include "swirl/run/failure.hpp"
#include "swirl/run/reading.hpp"
#include "swirl/study/map_plan.hpp"

namespace swirl {
namespace {

/// The quantity as a function of the axes and the number of discs.
using Known = std::function<double(double x, double y, double discs)>;

/// A map whose runs return a known function with a known error.
class KnownMap {
  public:
    KnownMap(const MapSettings& settings, Known known, double error)
        : plan_(make_map_plan(settings)), known_(std::move(known)), error_(error) {}

    const SweepPlan& plan() const { return plan_; }
    /// The runs so far keep their numbers.
    void grow(const MapGrowth& growth) { plan_ = grown_map(plan_, growth); }
    void fail_if(std::function<bool(double x, double y)> fails) { fails_ = std::move(fails); }

    /// Makes all missing runs of each step, or, with `random`, a random part of them.
    MapState complete(std::mt19937* random = nullptr) {
        for (;;) {
            MapState state = explore();
            if (state.missing.empty()) return state;
            bool any = false;
            for (const std::size_t point : state.missing) {
                if (random && any && (*random)() % 3 != 0) continue;
                EXPECT_FALSE(runs_.contains(point));
                runs_[point] = run_at(point);
                any = true;
            }
        }
    }
    MapState explore() const {
        return explore_map(plan_, [&](std::size_t point) -> const MapRun* {
            const auto found = runs_.find(point);
            return found == runs_.end() ? nullptr : &found->second;
        });
    }
    std::set<std::size_t> points() const {
        std::set<std::size_t> done;
        for (const auto& [point, run] : runs_) done.insert(point);
        return done;
    }
    double value(const std::string& axis, std::size_t rank) const {
        for (const SweepAxis& a : plan_.axes)
            if (a.name == axis) return *read_number(a.values[ascending_order(a)[rank]]);
        return 0.0;
    }

  private:
    MapRun run_at(std::size_t point) const {
        const ParameterTexts texts = plan_.parameters(point);
        const auto number = [&](const std::string& name) {
            const auto found = texts.find(name);
            return found == texts.end() ? 0.0 : *read_number(found->second);
        };
        const double x = number(plan_.map->x), y = number(plan_.map->y);
        MapRun run;
        run.periods = 100.0;
        run.failed = fails_ && fails_(x, y);
        run.value = {.mean = known_(x, y, number("discs")), .error = error_};
        run.value.effective_samples = 1000.0;
        return run;
    }

    SweepPlan plan_;
    Known known_;
    double error_;
    std::function<bool(double, double)> fails_;
    std::map<std::size_t, MapRun> runs_;
};

MapSettings square_map(std::int64_t steps = 16) {
    MapSettings settings;
    settings.x = {"mu", "0:1"};
    settings.y = {"restitution", "0:1"};
    settings.steps = steps;
    return settings;
}

double circle(double x, double y, double) { return std::hypot(x - 0.45, y - 0.55) - 0.3; }

const MapSite* site_at(const MapState& state, std::size_t x, std::size_t y) {
    for (const MapSite& s : state.sites)
        if (s.x == x && s.y == y) return &s;
    return nullptr;
}

TEST(MapSearch, IsFineAtTheZeroLineAndCoarseElsewhere) {
    constexpr std::size_t n = 33;
    KnownMap map(square_map(n), circle, 1e-6);
    const MapState state = map.complete();
    // 6 × 6 coarse cells at first. Every cell of the grid that the circle enters and whose corners
    // differ has all its corners.
    const auto sign = [&](std::size_t i, std::size_t j) {
        return circle(double(i) / (n - 1), double(j) / (n - 1), 0.0) > 0.0;
    };
    for (std::size_t j = 0; j + 1 < n; ++j)
        for (std::size_t i = 0; i + 1 < n; ++i) {
            const int above = sign(i, j) + sign(i + 1, j) + sign(i, j + 1) + sign(i + 1, j + 1);
            if (above == 0 || above == 4) continue;
            for (const std::size_t b : {j, j + 1})
                for (const std::size_t a : {i, i + 1})
                    EXPECT_NE(site_at(state, a, b), nullptr) << a << " " << b;
        }
    EXPECT_LT(state.sites.size(), n * n / 2);
    for (const MapSite& s : state.sites) {
        EXPECT_TRUE(s.decided);
        EXPECT_EQ(s.verdict, sign(s.x, s.y) ? "above" : "below");
        EXPECT_EQ(s.runs, 2);
    }
}

TEST(MapSearch, DoesNotDependOnTheOrderOfTheRuns) {
    KnownMap in_order(square_map(), circle, 0.01);
    const MapState expected = in_order.complete();
    for (const unsigned seed : {1u, 2u, 3u}) {
        std::mt19937 random(seed);
        KnownMap map(square_map(), circle, 0.01);
        const MapState found = map.complete(&random);
        EXPECT_EQ(map.points(), in_order.points());
        ASSERT_EQ(found.sites.size(), expected.sites.size());
        for (std::size_t k = 0; k < found.sites.size(); ++k) {
            EXPECT_EQ(found.sites[k].verdict, expected.sites[k].verdict);
            EXPECT_EQ(found.sites[k].value.mean, expected.sites[k].value.mean);
        }
    }
}

// Equal runs have the error e/√n; it may exceed that of the blocks for few seeds only. Within three
// errors of the level a site has all its runs.
TEST(MapSearch, RunsLongerNearTheLevel) {
    MapSettings settings;
    settings.x = {"mu", "0:1"};
    settings.level = 0.5;
    settings.steps = 21;
    const auto line = [](double x, double, double) { return x; };
    KnownMap map(settings, line, 0.02);
    for (const MapSite& s : map.complete().sites) {
        const double distance = std::abs(map.value("mu", s.x) - 0.5);
        if (distance > 3.5 * 0.02 / std::sqrt(2.0)) {
            EXPECT_EQ(s.runs, 2) << distance;
        }
        if (distance < 1e-9) {
            EXPECT_EQ(s.runs, 16);
            EXPECT_EQ(s.verdict, "undetermined");
        } else {
            EXPECT_EQ(s.verdict, map.value("mu", s.x) > 0.5 ? "above" : "below");
        }
        EXPECT_EQ(s.periods, 100.0 * double(s.runs));
    }
}

TEST(MapSearch, RefinesWhereNeighboursDifferByMoreThanTheChange) {
    const auto step = [](double x, double, double) { return x < 0.7 ? 1.0 : 2.0; };
    MapSettings settings;
    settings.x = {"mu", "0:1"};
    settings.steps = 31;
    KnownMap coarse(settings, step, 1e-6);
    EXPECT_EQ(coarse.complete().sites.size(), 7u);
    settings.change = 0.5;
    KnownMap fine(settings, step, 1e-6);
    const MapState state = fine.complete();
    EXPECT_NE(site_at(state, 20, 0), nullptr);
    EXPECT_NE(site_at(state, 21, 0), nullptr);
    EXPECT_LT(state.sites.size(), 12u);
}

TEST(MapSearch, ExcludesFailedRunsAndMarksTheirBorder) {
    KnownMap map(
        square_map(), [](double, double, double) { return 1.0; }, 0.01);
    map.fail_if([](double x, double) { return x > 0.5; });
    const MapState state = map.complete();
    for (const MapSite& s : state.sites) {
        const bool fails = map.value("mu", s.x) > 0.5;
        EXPECT_EQ(s.verdict, fails ? "failed" : "above");
        EXPECT_EQ(s.runs, fails ? 0 : 2);
        EXPECT_EQ(s.failed > 0, fails);
        EXPECT_EQ(std::isnan(s.value.mean), fails);
    }
    // The border between the columns 7 and 8 is known in every row.
    for (std::size_t j = 0; j < 16; ++j) {
        EXPECT_NE(site_at(state, 7, j), nullptr);
        EXPECT_NE(site_at(state, 8, j), nullptr);
    }
}

TEST(MapSearch, FindsTheCrossingAtEverySite) {
    MapSettings settings = square_map(11);
    settings.of = "N_c";
    const auto zero = [](double x, double y) { return 20.3 + 15.0 * x + 5.0 * y * y; };
    KnownMap map(
        settings, [&](double x, double y, double n) { return 0.01 * (zero(x, y) - n); }, 1e-4);
    const MapState state = map.complete();
    EXPECT_GT(state.sites.size(), 30u);
    for (const MapSite& s : state.sites) {
        EXPECT_EQ(s.verdict, "crosses");
        // A straight line between two neighbours is exact for this curve.
        EXPECT_NEAR(s.value.mean, zero(map.value("mu", s.x), map.value("restitution", s.y)), 1e-9);
        EXPECT_LE(s.lower, s.value.mean);
        EXPECT_GE(s.upper, s.value.mean);
        EXPECT_LE(s.value.error, 0.5);
    }
    // Five numbers and a bisection of 11 numbers: at most nine numbers of discs with two runs each.
    for (const MapSite& s : state.sites) EXPECT_LE(s.runs, 18);
}

TEST(MapSearch, ASiteWhoseNeighboursMisleadFindsItsCrossingToo) {
    MapSettings settings;
    settings.x = {"mu", "0:1"};
    settings.of = "N_c";
    settings.change = 0.5;
    // A jump of N_c within a cell, and no crossing at the end.
    const auto zero = [](double x) { return x < 0.55 ? 15.4 + 5.0 * x : x < 0.9 ? 40.4 : 90.0; };
    KnownMap map(
        settings, [&](double x, double, double n) { return 0.01 * (zero(x) - n); }, 1e-4);
    for (const MapSite& s : map.complete().sites) {
        const double x = map.value("mu", s.x);
        EXPECT_EQ(s.verdict, x < 0.9 ? "crosses" : "always rotates") << x;
        if (x < 0.9) {
            EXPECT_NEAR(s.value.mean, zero(x), 1e-9) << x;
        }
    }
}

TEST(MapSearch, MoreRunsReachTheToleranceOfTheCrossing) {
    MapSettings settings;
    settings.x = {"mu", "0.5,1"};
    settings.of = "N_c";
    settings.tolerance = 0.4;
    // The slope is 0.01 per disc: an error of 0.008 in ϖ is about 0.8 in N_c with two runs.
    KnownMap map(
        settings, [](double, double, double n) { return 0.01 * (30.4 - n); }, 0.008);
    for (const MapSite& s : map.complete().sites) {
        EXPECT_EQ(s.verdict, "crosses");
        EXPECT_LE(s.value.error, 0.4);
        EXPECT_GT(s.runs, 20);
    }
}

std::size_t runs_in(const MapState& state) {
    std::size_t runs = 0;
    for (const MapSite& s : state.sites) runs += static_cast<std::size_t>(s.runs + s.failed);
    return runs;
}

// complete() checks that no run is made twice; a site that the larger map omitted would be missing
// from the sum of the runs.
TEST(MapGrowth, UsesEveryRunOfTheSmallerMap) {
    KnownMap map(square_map(), circle, 0.01);
    MapState state = map.complete();
    const std::set<std::size_t> before = map.points();
    const std::size_t sites = state.sites.size();
    map.grow({.axes = {{"mu", "0:1"}, {"restitution", "0:1"}}, .steps = 31, .max_runs = 32});
    state = map.complete();
    EXPECT_EQ(runs_in(state), map.points().size());
    EXPECT_TRUE(
        std::includes(map.points().begin(), map.points().end(), before.begin(), before.end()));
    EXPECT_GT(state.sites.size(), sites);
    for (const MapSite& s : state.sites) {
        const double x = map.value("mu", s.x), y = map.value("restitution", s.y);
        // Certain at three errors of 32 runs, at least.
        if (std::abs(circle(x, y, 0.0)) > 3.5 * 0.01 / std::sqrt(32.0)) {
            EXPECT_EQ(s.verdict, circle(x, y, 0.0) > 0.0 ? "above" : "below") << x << " " << y;
        }
    }
    // Twice as fine at the line: every cell of the new grid that it enters has all its corners.
    constexpr std::size_t n = 31;
    const auto above = [&](std::size_t i, std::size_t j) {
        return circle(map.value("mu", i), map.value("restitution", j), 0.0) > 0.0;
    };
    for (std::size_t j = 0; j + 1 < n; ++j)
        for (std::size_t i = 0; i + 1 < n; ++i) {
            const int corners =
                above(i, j) + above(i + 1, j) + above(i, j + 1) + above(i + 1, j + 1);
            if (corners == 0 || corners == 4) continue;
            EXPECT_TRUE(site_at(state, i, j) && site_at(state, i + 1, j + 1)) << i << " " << j;
        }
}

TEST(MapGrowth, AddsCellsBeyondTheOldRange) {
    // The circle leaves the old range to the right and downwards.
    const auto large = [](double x, double y, double) {
        return std::hypot(x - 1.0, y - 0.2) - 0.5;
    };
    MapSettings settings = square_map(11);
    settings.x = {"amplitude", "0.2:1.2"};
    settings.y = {"restitution", "0.3:0.8"};
    KnownMap map(settings, large, 1e-6);
    map.complete();
    map.grow({.axes = {{"amplitude", "0:2"}}, .steps = 21});
    map.complete();
    map.grow({.axes = {{"restitution", "0:1"}}, .steps = 21});
    const MapState state = map.complete();
    EXPECT_EQ(runs_in(state), map.points().size());
    const std::size_t columns = map.plan().axis("amplitude")->values.size(),
                      rows = map.plan().axis("restitution")->values.size();
    EXPECT_EQ(columns, 21u);
    EXPECT_EQ(rows, 21u);
    for (const std::size_t i : {std::size_t{0}, columns - 1})
        for (const std::size_t j : {std::size_t{0}, rows - 1})
            EXPECT_NE(site_at(state, i, j), nullptr);
    const auto above = [&](std::size_t i, std::size_t j) {
        return large(map.value("amplitude", i), map.value("restitution", j), 0.0) > 0.0;
    };
    for (std::size_t j = 0; j + 1 < rows; ++j)
        for (std::size_t i = 0; i + 1 < columns; ++i) {
            const int corners =
                above(i, j) + above(i + 1, j) + above(i, j + 1) + above(i + 1, j + 1);
            if (corners == 0 || corners == 4) continue;
            EXPECT_TRUE(site_at(state, i, j) && site_at(state, i + 1, j + 1)) << i << " " << j;
        }
}

TEST(MapGrowth, FindsCrossingsAndDoesNotDependOnTheOrderOfTheRuns) {
    MapSettings settings;
    settings.x = {"mu", "0:1"};
    settings.steps = 6;
    settings.of = "N_c";
    settings.change = 1.0;
    const auto rotation = [](double x, double, double n) { return 0.01 * (20.3 + 15.0 * x - n); };
    KnownMap in_order(settings, rotation, 1e-4);
    in_order.complete();
    const MapGrowth growth{.axes = {{"mu", "0:1.6"}}, .steps = 21, .max_runs = 32};
    in_order.grow(growth);
    const MapState expected = in_order.complete();
    EXPECT_EQ(runs_in(expected), in_order.points().size());
    for (const MapSite& s : expected.sites)
        EXPECT_NEAR(s.value.mean, 20.3 + 15.0 * in_order.value("mu", s.x), 1e-9);
    std::mt19937 random(4);
    KnownMap map(settings, rotation, 1e-4);
    map.complete(&random);
    map.grow(growth);
    EXPECT_EQ(map.complete(&random).sites.size(), expected.sites.size());
    EXPECT_EQ(map.points(), in_order.points());
}

// N_c rises along x from below the first range to above it. The range then grows at both ends, in
// two steps.
TEST(MapGrowth, SearchesInALargerRangeWhereThereIsNoCrossing) {
    MapSettings settings;
    settings.x = {"mu", "0:1"};
    settings.steps = 11;
    settings.of = "N_c";
    settings.from = 20;
    settings.to = 30;
    const auto zero = [](double x) { return 12.3 + 35.0 * x; };
    const auto rotation = [&](double x, double, double n) { return 0.01 * (zero(x) - n); };
    KnownMap map(settings, rotation, 1e-4);
    // Of a complete map: every site has its verdict, and every run belongs to a site.
    const auto check = [&](KnownMap& searched, double from, double to) {
        const MapState state = searched.complete();
        for (const MapSite& s : state.sites) {
            const double x = searched.value("mu", s.x);
            if (zero(x) < from || zero(x) > to) {
                EXPECT_EQ(s.verdict, zero(x) > to ? "always rotates" : "always counterrotates");
            } else {
                EXPECT_EQ(s.verdict, "crosses") << x;
                EXPECT_NEAR(s.value.mean, zero(x), 1e-9) << x;
            }
        }
        EXPECT_EQ(runs_in(state), searched.points().size());
    };
    check(map, 20.0, 30.0);
    const std::set<std::size_t> before = map.points();
    map.grow({.to = 40});
    check(map, 20.0, 40.0);
    map.grow({.from = 5, .to = 55});
    check(map, 5.0, 55.0);
    EXPECT_TRUE(
        std::includes(map.points().begin(), map.points().end(), before.begin(), before.end()));
    EXPECT_EQ(map.plan().axis("discs")->values.size(), 51u);
    // The runs do not depend on their order, nor the values on the way the range was reached.
    std::mt19937 random(5);
    KnownMap again(settings, rotation, 1e-4);
    again.complete(&random);
    again.grow({.to = 40});
    again.complete(&random);
    again.grow({.from = 5, .to = 55});
    EXPECT_EQ(again.complete(&random).sites.size(), map.explore().sites.size());
    EXPECT_EQ(again.points(), map.points());
    settings.from = 5;
    settings.to = 55;
    KnownMap large(settings, rotation, 1e-4);
    check(large, 5.0, 55.0);
}

TEST(MapGrowth, ASmallerRangeIsSearchedAsBeforeIfAxesAndRangeGrowTogether) {
    MapSettings settings;
    settings.x = {"mu", "0:1"};
    settings.steps = 6;
    settings.of = "N_c";
    settings.to = 30;
    settings.change = 1.0;
    const auto zero = [](double x) { return 20.3 + 15.0 * x; };
    KnownMap map(
        settings, [&](double x, double, double n) { return 0.01 * (zero(x) - n); }, 1e-4);
    map.complete();
    map.grow({.axes = {{"mu", "0:1.6"}}, .steps = 21, .max_runs = 32, .from = 2, .to = 50});
    const MapState state = map.complete();
    EXPECT_EQ(runs_in(state), map.points().size());
    for (const MapSite& s : state.sites)
        EXPECT_NEAR(s.value.mean, zero(map.value("mu", s.x)), 1e-9);
}

TEST(MapGrowth, RejectsOtherMaps) {
    const SweepPlan plan = make_map_plan(square_map());
    EXPECT_THROW(grown_map(plan, {.axes = {{"period", "1:2"}}}), UsageError);
    EXPECT_THROW(grown_map(plan, {.max_runs = 8}), UsageError);  // has 16 runs
    for (const std::int64_t runs : {-5, 0, 10'001})
        EXPECT_THROW(grown_map(plan, {.max_runs = runs}), UsageError) << runs;
    EXPECT_THROW(grown_map(plan, {.axes = {{"mu", "0:1"}}, .steps = 1}), UsageError);
    EXPECT_THROW(grown_map(plan, {.to = 60}), UsageError);  // not of N_c
    EXPECT_THROW(grown_map(make_plan({{"mu", "0,1"}}, 2), {.axes = {{"mu", "0:2"}}}), UsageError);
    EXPECT_THROW(grown(plan, {{"mu", "2"}}, 0, {}), UsageError);
    EXPECT_EQ(grown_map(plan, {.axes = {{"mu", "0:1"}}}), plan);
    MapSettings settings = square_map();
    settings.of = "N_c";
    const SweepPlan crossings = make_map_plan(settings);
    EXPECT_THROW(grown_map(crossings, {.from = 6}), UsageError);  // has 5 to 48
    EXPECT_THROW(grown_map(crossings, {.to = 47}), UsageError);
    EXPECT_THROW(grown_map(crossings, {.from = 1}), UsageError);
    EXPECT_EQ(grown_map(crossings, {.from = 5, .to = 48}), crossings);
}

TEST(MapPlan, HasTheValuesOfItsAxes) {
    MapSettings settings;
    settings.x = {"discs", "5:8"};  // whole numbers, each once
    settings.y = {"mu", "0:0.25:1"};
    const SweepPlan plan = make_map_plan(settings);
    ASSERT_EQ(plan.axes.size(), 3u);
    EXPECT_EQ(plan.axes[0].values, (std::vector<std::string>{"5", "6", "7", "8"}));
    EXPECT_EQ(plan.axes[1].values.size(), 5u);
    EXPECT_EQ(plan.axes[2].name, "periods");
    EXPECT_EQ(plan.replicas, 16);
}

TEST(MapPlan, RejectsWhatCannotBeMapped) {
    const auto rejects = [](const std::function<void(MapSettings&)>& change) {
        MapSettings settings = square_map();
        change(settings);
        EXPECT_THROW(make_map_plan(settings), UsageError);
    };
    rejects([](auto& s) { s.y = s.x; });
    rejects([](auto& s) { s.x.name = "seed"; });
    rejects([](auto& s) { s.x.name = "colour"; });
    rejects([](auto& s) { s.x.values = "1:0"; });
    rejects([](auto& s) { s.x.values = "1,0.5"; });
    rejects([](auto& s) { s.of = "slip"; });
    rejects([](auto& s) { s.of = "slip.nothing"; });
    rejects([](auto& s) { s.rate = "fast"; });
    rejects([](auto& s) { s.level = not_available; });
    rejects([](auto& s) { s.change = -1.0; });
    rejects([](auto& s) { s.steps = 1; });
    rejects([](auto& s) { s.max_runs = 0; });
    rejects([](auto& s) { s.parameters = {{"mu", "1"}}; });
    rejects([](auto& s) { s.parameters = {{"discs", "30,40"}}; });
    rejects([](auto& s) {
        s.of = "N_c";
        s.parameters = {{"discs", "30"}};
    });
    rejects([](auto& s) {
        s.of = "N_c";
        s.level = 1.0;
    });
    rejects([](auto& s) {
        s.of = "N_c";
        s.tolerance = 0.0;
    });
    EXPECT_NO_THROW(make_map_plan(square_map()));
}

}  // namespace
}  // namespace swirl
