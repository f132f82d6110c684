#include "swirl/paper/paper.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <map>

#include "io/scratch.hpp"
#include "swirl/paper/points.hpp"
#include "swirl/run/failure.hpp"

namespace swirl {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

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

PaperTask sound(const std::string& key) {
    return {key, 1.0, [](const RunControl&) {
                ++calls;
                return Json{{"steady_state", {{"verdict", "steady"}}}};
            }};
}
PaperTask failing(const std::string& key) {
    return {key, 1.0, [](const RunControl&) -> Json {
                ++calls;
                throw Failure("Time stands still.");
            }};
}

/// Counts its holes.
FigurePlan three_runs(const PaperSettings&) {
    FigurePlan plan;
    plan.points = {sound("a"), failing("b"), sound("c")};
    plan.finish = [](const std::vector<Json>& results, const fs::path&) {
        FigureOutcome outcome;
        for (const Json& r : results) outcome.findings.push_back(steadiness(r));
        return outcome;
    };
    return plan;
}
FigurePlan impossible(const PaperSettings&) {
    FigurePlan plan;
    plan.points = {sound("c")};
    plan.finish = [](const std::vector<Json>&, const fs::path&) -> FigureOutcome {
        throw Failure("Nothing can be drawn.");
    };
    return plan;
}

// A result is kept under the key of its task, for all figures: two different runs of one key would
// be taken for each other.
TEST_F(Paper, TasksOfOneKeyAreTheSameRun) {
    for (const bool quick : {false, true}) {
        settings.quick = quick;
        std::map<std::string, std::string> runs;
        for (const PaperFigure& figure : paper_figures())
            for (const PaperPoint& point : figure.plan(settings).points)
                for (const PaperTask& task : point.runs) {
                    const auto [known, isnew] = runs.emplace(task.key, task.what);
                    EXPECT_EQ(known->second, task.what) << task.key << " of figure " << figure.name;
                }
        EXPECT_GT(runs.size(), 100u);
    }
}

// A verdict on three seeds would be one on chance: the figures that claims rest on have eight.
TEST_F(Paper, PointsThatVerdictsRestOnHaveAllTheSeeds) {
    for (const char* name :
         {"1b", "3a", "4a", "4b", "5b", "states", "spheres", "spheres_sense", "spheres_few",
          "spheres_pinned", "spheres_ingredients", "spheres_ingredients_rough"})
        for (const PaperPoint& point : paper_figure(name).plan(settings).points)
            EXPECT_EQ(point.runs.size(), 8u) << name << ": " << point.name;
}

TEST_F(Paper, ARunThatFailsLeavesAHoleAndIsNamed) {
    const PaperResult made = make_figures({{"x", "of three runs", three_runs}}, settings, {});
    EXPECT_EQ(made.failed, 1u);
    EXPECT_THAT(made.figures.front().outcome.findings,
                ElementsAre("steady", "failed", "steady",
                            HasSubstr("1 run failed and is left out: 1 of 1 at b (an empty place). "
                                      "Why: Time stands still.")));
    EXPECT_EQ(made.figures.front().problem, "");
}

TEST_F(Paper, RunsThatFailAreNamedInOneSentence) {
    const auto two_fail = [](const PaperSettings&) {
        FigurePlan plan;
        plan.points = {failing("b"), sound("c"), failing("d")};
        plan.finish = [](const std::vector<Json>&, const fs::path&) { return FigureOutcome{}; };
        return plan;
    };
    const PaperResult made = make_figures({{"x", "of three runs", two_fail}}, settings, {});
    EXPECT_THAT(
        made.figures.front().outcome.findings,
        ElementsAre(HasSubstr("2 runs failed and are left out: 1 of 1 at b (an empty place), 1 of "
                              "1 at d (an empty place). Of the first: Time stands still.")));
}

TEST_F(Paper, ARunThatFailedIsTriedAgainAndTheOthersAreNot) {
    make_figures({{"x", "of three runs", three_runs}}, settings, {});
    calls = 0;
    const PaperResult again = make_figures({{"x", "of three runs", three_runs}}, settings, {});
    EXPECT_EQ(calls, 1);
    EXPECT_EQ(again.remembered, 2u);
}

TEST_F(Paper, AFigureThatCannotBeMadeDoesNotKeepTheOthersFromBeingMade) {
    const PaperResult made = make_figures(
        {{"y", "impossible", impossible}, {"x", "of three runs", three_runs}}, settings, {});
    EXPECT_EQ(made.figures[0].problem, "Nothing can be drawn.");
    EXPECT_THAT(made.figures[0].outcome.findings, ElementsAre(HasSubstr("could not be made")));
    EXPECT_EQ(made.figures[1].outcome.findings.size(), 4u);
}

TEST_F(Paper, EventsShortenWhatIsCountedInSwirlsLikewise) {
    EXPECT_EQ(settings.periods(600, 20), 600);
    settings.events = 100'000;
    EXPECT_EQ(settings.periods(600, 20), 60);
    settings.events = 1000;
    EXPECT_EQ(settings.periods(600, 20), 20);
    settings.quick = true;
    settings.events = 400'000;
    EXPECT_EQ(settings.periods(100, 1), 200);
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

/// ϖ of one point, 0.1 with an error that falls as seeds are added.
FigurePlan one_doubtful_point(const PaperSettings& settings) {
    FigurePlan plan;
    plan.points = {PaperPoint(settings, "no-wall_N40", settings.seeds(), short_run)};
    const std::size_t seeds = plan.points.front().runs.size();
    plan.finish = [seeds](const std::vector<Json>&, const fs::path& out) {
        std::ofstream(out / "figure_5b.csv")
            << "setting,discs,by_event,by_event_error,point\n"
            << "no-wall,40,0.1," << 0.3 / double(seeds) << ",no-wall_N40\n";
        return FigureOutcome{{fmt::format("{} seeds", seeds)}, {}};
    };
    return plan;
}

TEST_F(Paper, AnUndecidedClaimGetsMoreSeedsUntilItIsDecided) {
    settings.quick = true;  // 3 seeds, and 0.1 is no three errors of 0.1
    calls = 0;
    const PaperResult made =
        make_figures({{"x", "one point", one_doubtful_point}}, settings, {}, true);
    // 6: 0.1 ± 0.05; 12: 0.1 ± 0.025.
    EXPECT_THAT(made.figures.front().outcome.findings, Contains("12 seeds"));
    EXPECT_EQ(made.undecided_points, 0u);
    EXPECT_EQ(calls, 12);  // none twice
    EXPECT_THAT(make_figures({{"x", "one point", one_doubtful_point}}, settings, {})
                    .figures.front()
                    .outcome.findings,
                Contains("3 seeds"));
}

TEST_F(Paper, ARunThatFailedIsNotTriedAgainForMoreSeeds) {
    settings.quick = true;
    calls = 0;
    const auto plan = [](const PaperSettings& s) {
        FigurePlan doubtful = one_doubtful_point(s);
        doubtful.points.push_back(failing("b"));
        return doubtful;
    };
    const PaperResult made = make_figures({{"x", "one point", plan}}, settings, {}, true);
    EXPECT_THAT(made.figures.front().outcome.findings, Contains("12 seeds"));
    EXPECT_EQ(calls, 12 + 1);
    EXPECT_EQ(made.failed, 1u);
}

TEST_F(Paper, TheBudgetOfSeedsEnds) {
    settings.seeds_of_point["no-wall_N40"] = 5;
    settings.quick = true;
    const FigurePlan plan = one_doubtful_point(settings);
    EXPECT_EQ(plan.points.front().runs.size(), 5u);
    const PaperResult made = make_figures(
        {{"x", "one point",
          [](const PaperSettings& s) {
              FigurePlan hopeless = one_doubtful_point(s);
              const std::size_t seeds = hopeless.points.front().runs.size();
              hopeless.finish = [seeds](const std::vector<Json>&, const fs::path& out) {
                  std::ofstream(out / "figure_5b.csv")
                      << "setting,discs,by_event,by_event_error,point\n"
                      << "no-wall,40,0.0,1.0,no-wall_N40\n";
                  return FigureOutcome{{fmt::format("{} seeds", seeds)}, {}};
              };
              return hopeless;
          }}},
        settings, {}, true);
    EXPECT_THAT(made.figures.front().outcome.findings, Contains("10 seeds"));  // 20 are too many
    EXPECT_EQ(made.undecided_points, 1u);
}

TEST_F(Paper, EveryFigureSurvivesThatAllItsRunsFail) {
    for (const PaperFigure& figure : paper_figures()) {
        settings.quick = true;
        const FigurePlan plan = figure.plan(settings);
        if (plan.points.empty()) continue;
        fs::create_directories(settings.out);
        const std::vector<Json> results(plan.points.size(), Json{{"failed", "why"}});
        try {
            for (const fs::path& file : plan.finish(results, settings.out).files)
                EXPECT_TRUE(fs::exists(file)) << figure.name;
        } catch (const Failure&) {
        }  // a figure may be impossible, but nothing else may happen
    }
}

}  // namespace
}  // namespace swirl
