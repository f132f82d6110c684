#include "swirl/paper/paper.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>

#include "io/scratch.hpp"
#include "swirl/paper/results.hpp"
#include "swirl/run/failure.hpp"

namespace swirl {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class Paper : public ::testing::Test {
  protected:
    Scratch scratch;
    PaperSettings settings = [this] {
        PaperSettings s;
        s.out = scratch / "out";
        return s;
    }();
};

std::atomic<int> calls = 0;

PaperTask succeeding(const std::string& key) {
    return {key, 1.0, [](const RunControl&) {
                ++calls;
                return Json{{"steady_state", {{"verdict", "steady"}}}};
            }};
}
PaperTask failing(const std::string& key) {
    return {key, 1.0, [](const RunControl&) -> Json {
                ++calls;
                throw Failure("collapse");
            }};
}

/// The second of its runs fails. Findings: the verdict of each run.
FigurePlan three_runs(const PaperSettings&) {
    FigurePlan plan;
    plan.points = {succeeding("a"), failing("b"), succeeding("c")};
    plan.finish = [](const std::vector<Json>& results, const fs::path&) {
        FigureOutcome outcome;
        for (const Json& r : results) outcome.findings.push_back(steadiness(r));
        return outcome;
    };
    return plan;
}
FigurePlan impossible(const PaperSettings&) {
    FigurePlan plan;
    plan.points = {succeeding("c")};
    plan.finish = [](const std::vector<Json>&, const fs::path&) -> FigureOutcome {
        throw Failure("no plan");
    };
    return plan;
}

// Results of all figures are stored by the key of their task: different runs with the same key
// would be confused.
TEST_F(Paper, TasksWithTheSameKeyAreTheSameRun) {
    for (const bool quick : {false, true}) {
        settings.quick = quick;
        std::map<std::string, std::string> runs;
        for (const PaperFigure& figure : paper_figures())
            for (const PaperPoint& point : figure.plan(settings).points)
                for (const PaperTask& task : point.runs) {
                    const auto [known, inserted] = runs.emplace(task.key, task.description);
                    EXPECT_EQ(known->second, task.description)
                        << task.key << " of figure " << figure.name;
                }
        EXPECT_GT(runs.size(), 100u);
    }
}

// "--quick" means fewer points and seeds. A shorter run would average more of the transient. The key
// of a task has the length of its runs, so the full study also reuses the results of a quick one.
TEST_F(Paper, QuickRunsAreRunsOfTheFullStudy) {
    std::set<std::string> full;
    for (const bool quick : {false, true}) {
        settings.quick = quick;
        for (const PaperFigure& figure : paper_figures())
            for (const PaperPoint& point : figure.plan(settings).points)
                for (const PaperTask& task : point.runs)
                    if (figure.name == "ball")
                        continue;  // a task with all seeds
                    else if (quick)
                        EXPECT_TRUE(full.contains(task.key)) << figure.name << ": " << task.key;
                    else
                        full.insert(task.key);
    }
    EXPECT_GT(full.size(), 1000u);
}

// With three seeds the threshold of a verdict is 19 standard errors; with eight it is 4.5.
TEST_F(Paper, FiguresWithClaimsHaveEightSeeds) {
    for (const char* name : {"1b", "3a", "4a", "4b", "5b", "states", "spheres", "spheres_few",
                             "spheres_ingredients", "spheres_ingredients_rough"})
        for (const PaperPoint& point : paper_figure(name).plan(settings).points)
            EXPECT_EQ(point.runs.size(), 8u) << name << ": " << point.name;
}

std::vector<std::string> names_of(const std::vector<PaperFigure>& figures) {
    std::vector<std::string> names;
    for (const PaperFigure& figure : figures) names.emplace_back(figure.name);
    return names;
}

// A name that a figure shares with a group means the group, so the figure could not be made alone.
TEST(Figures, NamesAreNotThoseOfGroups) {
    for (const PaperFigure& figure : paper_figures())
        EXPECT_EQ(names_of(figures_named({std::string(figure.name)})).size(), 1u) << figure.name;
}

TEST(Figures, EachBelongsToOneGroup) {
    std::size_t members = 0;
    for (const FigureGroup& group : figure_groups)
        members += figures_named({std::string(group.name)}).size();
    EXPECT_EQ(members, paper_figures().size());
    EXPECT_EQ(names_of(figures_named({"all"})), names_of(paper_figures()));
}

TEST(Figures, AreListedOnceWhenACallNamesThemAndTheirGroup) {
    const std::vector<std::string> names = names_of(figures_named({"size", "chapters", "5b"}));
    EXPECT_EQ(names.front(), "size");
    EXPECT_EQ(names.back(), "5b");
    EXPECT_EQ(std::count(names.begin(), names.end(), "size"), 1);
    EXPECT_EQ(names.size(), figures_named({"chapters"}).size() + 1);
}

TEST(Figures, UnknownNameIsRejectedWithTheNearestOne) {
    try {
        figures_named({"chapter"});
        ADD_FAILURE();
    } catch (const UsageError& error) {
        EXPECT_THAT(error.what(), HasSubstr("chapters"));
    }
}

// Each run of a figure belongs to exactly one share. Shares do not depend on the results that
// exist.
TEST_F(Paper, SharesDoEachRunOnce) {
    const std::vector<PaperFigure> figures{{"x", "of three runs", three_runs}};
    calls = 0;
    std::size_t tasks = 0;
    for (std::size_t part = 1; part <= 2; ++part)
        tasks += run_share(figures, settings, {}, {part, 2}).tasks;
    EXPECT_EQ(tasks, 3u);
    EXPECT_EQ(calls, 3);
    const PaperResult made = make_figures(figures, settings, {});
    EXPECT_EQ(made.reused, 2u);  // the third fails and is repeated
}

TEST_F(Paper, FailedRunLeavesAGapAndIsReported) {
    const PaperResult made = make_figures({{"x", "of three runs", three_runs}}, settings, {});
    EXPECT_EQ(made.failed, 1u);
    EXPECT_THAT(made.figures.front().outcome.findings,
                ElementsAre("steady", "failed", "steady",
                            HasSubstr("1 run failed and is omitted: 1 of 1 at b (no result). "
                                      "Reason: collapse")));
    EXPECT_EQ(made.figures.front().problem, "");
}

TEST_F(Paper, FailedRunsAreReportedInOneSentence) {
    const auto two_fail = [](const PaperSettings&) {
        FigurePlan plan;
        plan.points = {failing("b"), succeeding("c"), failing("d")};
        plan.finish = [](const std::vector<Json>&, const fs::path&) { return FigureOutcome{}; };
        return plan;
    };
    const PaperResult made = make_figures({{"x", "of three runs", two_fail}}, settings, {});
    EXPECT_THAT(
        made.figures.front().outcome.findings,
        ElementsAre(HasSubstr("2 runs failed and are omitted: 1 of 1 at b (no result), 1 of 1 at d "
                              "(no result). Reason of the first: collapse")));
}

TEST_F(Paper, OnlyFailedRunsAreRepeatedByTheNextCall) {
    make_figures({{"x", "of three runs", three_runs}}, settings, {});
    calls = 0;
    const PaperResult again = make_figures({{"x", "of three runs", three_runs}}, settings, {});
    EXPECT_EQ(calls, 1);
    EXPECT_EQ(again.reused, 2u);
}

TEST_F(Paper, ImpossibleFigureDoesNotPreventTheOthers) {
    const PaperResult made = make_figures(
        {{"y", "impossible", impossible}, {"x", "of three runs", three_runs}}, settings, {});
    EXPECT_EQ(made.figures[0].problem, "no plan");
    EXPECT_THAT(made.figures[0].outcome.findings, ElementsAre(HasSubstr("could not be made")));
    EXPECT_EQ(made.figures[1].outcome.findings.size(), 4u);
}

TEST_F(Paper, EventsScaleLengthsInPeriods) {
    EXPECT_EQ(settings.periods(600, 20), 600);
    settings.events = 100'000;
    EXPECT_EQ(settings.periods(600, 20), 60);
    settings.events = 1000;
    EXPECT_EQ(settings.periods(600, 20), 20);
    settings.quick = true;  // the same lengths
    EXPECT_EQ(settings.periods(600, 20), 20);
}

PaperTask short_run(std::uint64_t seed) {
    RunConfig config;
    config.discs = 5;
    config.events = 2000;
    config.seed = seed;
    PaperTask task = run_task(fmt::format("seed{}", seed), config);
    task.work = [work = task.work](const RunControl& control) {
        ++calls;
        return work(control);
    };
    return task;
}

/// The table of Figure 5b with a value at N = 40, and certain rotation at all other N that a claim on
/// this curve needs.
void write_no_wall_curve(const fs::path& out, double mean, double error) {
    std::ofstream table(out / "figure_5b.csv");
    table << "setting,discs,by_event,by_event_error,point\n";
    for (const int n : {8, 16, 24, 28, 32, 36, 44, 48, 52, 55})
        table << "no-wall," << n << ",1,0.001,\n";
    table << "no-wall,40," << mean << ',' << error << ",no-wall_N40\n";
}

/// One point, ϖ = 0.1 with an error that falls as seeds are added.
FigurePlan one_undecided_point(const PaperSettings& settings) {
    FigurePlan plan;
    plan.points = {PaperPoint(settings, "no-wall_N40", settings.seeds(), short_run)};
    const std::size_t seeds = plan.points.front().runs.size();
    plan.finish = [seeds](const std::vector<Json>&, const fs::path& out) {
        write_no_wall_curve(out, 0.1, 0.3 / double(seeds));
        return FigureOutcome{{fmt::format("{} seeds", seeds)}, {}};
    };
    return plan;
}

TEST_F(Paper, UndecidedClaimGetsMoreSeedsUntilDecided) {
    settings.quick = true;  // 3 seeds: 0.1 ± 0.1 is undecided
    calls = 0;
    const PaperResult made =
        make_figures({{"x", "one point", one_undecided_point}}, settings, {}, true);
    // 6: 0.1 ± 0.05; 12: 0.1 ± 0.025.
    EXPECT_THAT(made.figures.front().outcome.findings, Contains("12 seeds"));
    EXPECT_EQ(made.undecided_points, 0u);
    EXPECT_EQ(calls, 12);  // each seed runs once
    EXPECT_THAT(make_figures({{"x", "one point", one_undecided_point}}, settings, {})
                    .figures.front()
                    .outcome.findings,
                Contains("3 seeds"));
}

// The number of first seeds changes neither the budget nor the runs that are made in the end.
TEST_F(Paper, FewerFirstSeedsAreDoubledWithinTheSameBudget) {
    settings.quick = true;
    settings.first_seeds = 2;
    calls = 0;
    EXPECT_EQ(settings.max_seeds(), 12);
    const PaperResult made =
        make_figures({{"x", "one point", one_undecided_point}}, settings, {}, true);
    // 2: 0.1 ± 0.15; 4: 0.1 ± 0.075; 8: 0.1 ± 0.0375, 2.7 errors. 16 exceed the budget of 12.
    EXPECT_THAT(made.figures.front().outcome.findings, Contains("8 seeds"));
    EXPECT_EQ(calls, 8);
    EXPECT_EQ(made.undecided_points, 1u);
}

TEST_F(Paper, FailedRunIsNotRepeatedWhenSeedsAreAdded) {
    settings.quick = true;
    calls = 0;
    const auto plan = [](const PaperSettings& s) {
        FigurePlan undecided = one_undecided_point(s);
        undecided.points.push_back(failing("b"));
        return undecided;
    };
    const PaperResult made = make_figures({{"x", "one point", plan}}, settings, {}, true);
    EXPECT_THAT(made.figures.front().outcome.findings, Contains("12 seeds"));
    EXPECT_EQ(calls, 12 + 1);
    EXPECT_EQ(made.failed, 1u);
}

TEST_F(Paper, SeedsStopAtTheBudget) {
    settings.seeds_of_point["no-wall_N40"] = 5;
    settings.quick = true;
    const FigurePlan plan = one_undecided_point(settings);
    EXPECT_EQ(plan.points.front().runs.size(), 5u);
    const PaperResult made = make_figures(
        {{"x", "one point",
          [](const PaperSettings& s) {
              FigurePlan undecidable = one_undecided_point(s);
              const std::size_t seeds = undecidable.points.front().runs.size();
              undecidable.finish = [seeds](const std::vector<Json>&, const fs::path& out) {
                  write_no_wall_curve(out, 0.0, 1.0);
                  return FigureOutcome{{fmt::format("{} seeds", seeds)}, {}};
              };
              return undecidable;
          }}},
        settings, {}, true);
    EXPECT_THAT(made.figures.front().outcome.findings,
                Contains("10 seeds"));  // 20 exceed the budget of 12
    EXPECT_EQ(made.undecided_points, 1u);
}

TEST_F(Paper, EveryFigureHandlesThatAllItsRunsFail) {
    for (const PaperFigure& figure : paper_figures()) {
        settings.quick = true;
        const FigurePlan plan = figure.plan(settings);
        if (plan.points.empty()) continue;
        fs::create_directories(settings.out);
        const std::vector<Json> results(plan.points.size(), Json{{"failed", "reason"}});
        try {
            for (const fs::path& file : plan.finish(results, settings.out).files)
                EXPECT_TRUE(fs::exists(file)) << figure.name;
        } catch (const Failure&) {
        }  // a figure may be impossible; no other exception is allowed
    }
}

}  // namespace
}  // namespace swirl
