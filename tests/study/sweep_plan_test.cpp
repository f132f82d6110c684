// The plan of a sweep: axes, points and their seeds.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/scratch.hpp"
#include "run/other_values.hpp"
#include "swirl/io/file_error.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/study/crossing.hpp"
#include "swirl/study/sweep_plan.hpp"

namespace swirl {
namespace {

std::string error_of(const ParameterTexts& texts) {
    try {
        make_plan(texts, 1);
    } catch (const UsageError& error) {
        return error.what();
    }
    return "";
}

// Other programs take FROM:TO:STEP.
TEST(SweepPlan, StepAtTheEndOfARangeIsExplained) {
    using testing::HasSubstr;
    EXPECT_THAT(error_of({{"mu", "0.1:1:0.1"}}), HasSubstr("hint: write 0.1:0.1:1."));
    EXPECT_THAT(error_of({{"discs", "5:48:2"}}), HasSubstr("hint: write 5:2:48."));
    for (const char* range : {"5:10:48", "5:10:12", "1:1:1", "0:0.5:0.7"})
        EXPECT_EQ(error_of({{range[0] == '0' ? "mu" : "discs", range}}), "") << range;
}

// Results of different versions are comparable only if the seeds are unchanged.
TEST(SweepPlan, SeedsOfPointsAreUnchanged) {
    const SweepPlan plan = make_plan({{"discs", "5,6"},
                                      {"mu-disc", "0.5"},
                                      {"mixture", "2:1.2"},
                                      {"path", "circle"},
                                      {"speed", "2"},
                                      {"seed", "3"},
                                      {"events", "1000"}},
                                     2);
    ASSERT_EQ(plan.points(), 4u);
    const std::uint64_t seeds[] = {1700515903352763, 6180745996988959, 952870390363854,
                                   4737086376560742};
    for (std::size_t point = 0; point < 4; ++point)
        EXPECT_EQ(plan.config(point).seed, seeds[point]);
}

TEST(SweepPlan, EveryParameterCanBeAnAxis) {
    for (const std::string& name : parameter_names()) {
        const Parameter& row = *find_parameter(name);
        ParameterTexts given = needed_by(row);
        given[name] = another(row);
        const SweepPlan plan = make_plan(given, 1);
        ASSERT_EQ(plan.axes.size(), given.size());
        EXPECT_NE(plan.axis(row.name), nullptr);
    }
}

TEST(SweepPlan, EqualRunsFromGivenStatesAreRejected) {
    const ParameterTexts states{{"initial", "states 2:0:0:0:0"}, {"mu", "0.1,0.5"}};
    EXPECT_EQ(make_plan(states, 1).points(), 2u);
    EXPECT_THROW(make_plan(states, 2), UsageError);
    EXPECT_THROW(reject_listed_particles(states), UsageError);
    EXPECT_THAT(error_of({{"initial", "states 2:0:0:0:0"}, {"seed", "1,2"}}),
                testing::HasSubstr("seed"));
}

TEST(SweepPlan, AnAxisWithoutEffectIsRejected) {
    EXPECT_THAT(error_of({{"mu", "0.1,0.5"}, {"mu_disc", "1"}, {"mu_wall", "1"}}),
                testing::HasSubstr("--mu 0.1 and --mu 0.5 are the same run"));
    EXPECT_THAT(error_of({{"discs", "5,6,5"}}), testing::HasSubstr("--replicates"));
    EXPECT_EQ(error_of({{"mu", "0.1,0.5"}, {"mu_disc", "1"}}), "");
    // A contact duration has no effect without dissipation and floor.
    EXPECT_THAT(error_of({{"contact_duration", "0.001,0.01"}}), testing::HasSubstr("the same run"));
    EXPECT_EQ(error_of({{"contact_duration", "0.001,0.01"}, {"restitution", "1,0.9"}}), "");
    EXPECT_EQ(error_of({{"contact_duration", "0.001,0.01"}, {"floor", "sliding"}}), "");
}

class PlanFile : public testing::Test {
  protected:
    std::string error_of(const std::string& text) {
        write_quickly(scratch_ / "plan.json", text);
        try {
            read_plan(scratch_.folder());
        } catch (const FileError& error) {
            return error.what();
        }
        return "";
    }
    Scratch scratch_;
};

TEST_F(PlanFile, InvalidPlansAreRejected) {
    EXPECT_THAT(error_of(R"({"format":2,"axes":{"discs":[]},"replicates":1})"),
                testing::HasSubstr("discs has no values"));
    EXPECT_THAT(error_of(R"({"format":2,"axes":{"discs":["5"]},"replicates":1152921504606846976})"),
                testing::HasSubstr("1.15e+18 runs"));
    EXPECT_THAT(error_of(R"({"format":2,"axes":{"discs":["5"]},"replicates":0})"),
                testing::HasSubstr("from 1 to"));
    EXPECT_THAT(error_of(R"({"format":1)"), testing::HasSubstr("is not the plan of a sweep"));
}

// A stored map is validated as a map of the command line is.
TEST_F(PlanFile, ForgedMapsAreRejected) {
    const auto map = [](const std::string& changes, const std::string& axes = R"("mu":["0","1"])") {
        return R"({"format":2,"axes":{"discs":["6"],)" + axes +
               R"(,"periods":["4"],"warmup":["1"]},"replicates":4,"map":{"x":"mu","y":"","quantity":)"
               R"("mean_by_time","rate":"mean_by_time","level":0.0,"change":0.0,"tolerance":0.5)" +
               changes + "}}";
    };
    EXPECT_EQ(error_of(map("")), "");
    // A later key replaces an earlier one.
    for (const char* change :
         {R"(,"x":"mu_wall")", R"(,"x":"")", R"(,"x":"seed")", R"(,"y":"mu")",
          R"(,"y":"amplitude")", R"(,"quantity":"N_c")", R"(,"quantity":"slip.nothing")",
          R"(,"quantity":"")", R"(,"quantity":"slip.cluster")", R"(,"rate":"rigid")",
          R"(,"tolerance":0)", R"(,"tolerance":-1)", R"(,"change":-1)"})
        EXPECT_THAT(error_of(map(change)), testing::HasSubstr("is damaged: ")) << change;
    for (const char* axes : {R"("mu":["0","x"])", R"("mu":["0","0"])", R"("mu":["0","-1"])",
                             R"("mu":["0","1"],"amplitude":["1","2"])", R"("path":["circle"])"})
        EXPECT_THAT(error_of(map("", axes)), testing::HasSubstr("is damaged: ")) << axes;
}

TEST_F(PlanFile, HyphensInNamesAreAccepted) {
    EXPECT_EQ(error_of(R"({"format":2,"axes":{"mu-disc":["0.5","1"]},"replicates":1})"), "");
    EXPECT_EQ(read_plan(scratch_.folder()).axes.at(0).name, "mu_disc");
}

}  // namespace
}  // namespace swirl
