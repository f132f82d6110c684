#include "swirl/paper/paper.hpp"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>

#include "files/scratch.hpp"
#include "swirl/paper/points.hpp"
#include "swirl/run/failure.hpp"

namespace swirl {
namespace {

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

int calls = 0;

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
    plan.tasks = {sound("a"), failing("b"), sound("c")};
    plan.finish = [](const std::vector<Json>& results, const fs::path&) {
        FigureOutcome outcome;
        for (const Json& r : results) outcome.findings.push_back(steadiness(r));
        return outcome;
    };
    return plan;
}
FigurePlan impossible(const PaperSettings&) {
    FigurePlan plan;
    plan.tasks = {sound("c")};
    plan.finish = [](const std::vector<Json>&, const fs::path&) -> FigureOutcome {
        throw Failure("Nothing can be drawn.");
    };
    return plan;
}

TEST_F(Paper, ARunThatFailsLeavesAHoleAndIsNamed) {
    const PaperResult made = make_figures({{"x", "of three runs", three_runs}}, settings, {});
    EXPECT_EQ(made.failed, 1u);
    EXPECT_THAT(made.figures.front().outcome.findings,
                ElementsAre("steady", "failed", "steady",
                            HasSubstr("'b' failed, and its place is empty: Time stands still.")));
    EXPECT_EQ(made.figures.front().problem, "");
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
    EXPECT_EQ(settings.swirls(600, 20), 600);
    settings.events = 100'000;
    EXPECT_EQ(settings.swirls(600, 20), 60);
    settings.events = 1000;
    EXPECT_EQ(settings.swirls(600, 20), 20);
    settings.quick = true;
    settings.events = 400'000;
    EXPECT_EQ(settings.swirls(100, 1), 200);
}

TEST_F(Paper, EveryFigureSurvivesThatAllItsRunsFail) {
    for (const PaperFigure& figure : paper_figures()) {
        settings.quick = true;
        const FigurePlan plan = figure.plan(settings);
        if (plan.tasks.empty()) continue;
        fs::create_directories(settings.out);
        const std::vector<Json> results(plan.tasks.size(), Json{{"failed", "why"}});
        try {
            for (const fs::path& file : plan.finish(results, settings.out).files)
                EXPECT_TRUE(fs::exists(file)) << figure.name;
        } catch (const Failure&) {
        }  // a figure may be impossible, but nothing else may happen
    }
}

}  // namespace
}  // namespace swirl
