#include "swirl/run/parameters.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "swirl/run/config.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/json.hpp"

namespace swirl {
namespace {

std::string refusal(const ParameterTexts& given) {
    try {
        resolve(given);
    } catch (const UsageError& wrong) {
        return wrong.what();
    }
    return "";
}

TEST(RunParameters, NothingGivenIsThePaper) {
    const RunConfig config = resolve({});
    EXPECT_EQ(config.discs, 48);
    EXPECT_EQ(config.mu_disc, 1.0);
    EXPECT_EQ(config.mu_wall, 1.0);
    EXPECT_EQ(config.inertia, 10.0);
    EXPECT_EQ(config.container_radius, 8.6);
    EXPECT_EQ(config.amplitude, 1.892);
    EXPECT_EQ(config.sides, 30);
    EXPECT_EQ(config.period, 11.866071);
    EXPECT_EQ(config.events, 1'000'000);
    EXPECT_FALSE(config.periods);
}

TEST(RunParameters, TheParticularFrictionWinsOverTheGeneral) {
    const RunConfig config = resolve({{"mu", "0.5"}, {"mu-wall", "0"}});
    EXPECT_EQ(config.mu_disc, 0.5);
    EXPECT_EQ(config.mu_wall, 0.0);
}

TEST(RunParameters, AnUnknownNameIsRefusedWithTheNearest) {
    EXPECT_THAT(refusal({{"mu_wal", "1"}}), testing::EndsWith("did you mean 'mu_wall'?"));
    EXPECT_THAT(refusal({{"colour-of-the-sky", "blue"}}), testing::HasSubstr("--help"));
}

TEST(RunParameters, TwoOfAmplitudePeriodAndSpeedMakeTheThird) {
    EXPECT_NEAR(resolve({{"amplitude", "2"}, {"speed", "3"}}).period, 2.0 / 1.892 * 11.866071 / 3.0,
                1e-6);
    EXPECT_NEAR(resolve({{"period", "5"}, {"speed", "3"}}).amplitude, 1.892 * 5.0 / 11.866071 * 3.0,
                1e-6);
    EXPECT_EQ(resolve({{"amplitude", "0"}, {"speed", "0"}}).amplitude, 0.0);
    EXPECT_NE(refusal({{"speed", "0"}}), "");
    EXPECT_NE(refusal({{"speed", "1"}, {"amplitude", "1"}, {"period", "1"}}), "");
}

TEST(RunParameters, EveryNameIsOnceInTheListAndResolves) {
    std::set<std::string> seen;
    for (const Parameter& p : run_parameters) {
        if (!p.can_be_given()) continue;
        EXPECT_TRUE(seen.insert(p.name).second) << p.name;
        EXPECT_EQ(refusal({{p.name, ""}}).find("There is no parameter"), std::string::npos);
        EXPECT_NE(refusal({{p.name, ""}}), "") << p.name << " accepts an empty text";
        EXPECT_NE(refusal({{p.name, "x"}}), "") << p.name << " accepts 'x'";
        EXPECT_NE(refusal({{p.name, "nan"}}), "") << p.name << " accepts nan";
        EXPECT_NE(refusal({{p.name, "-1e300"}}), "") << p.name << " accepts -1e300";
    }
}

/// A text that makes another run than the paper's, for any parameter that can be given.
std::string another(const Parameter& p) {
    static const std::map<std::string, std::string> words = {{"mu", "0.5"},
                                                             {"inertia", "ring"},
                                                             {"mixture", "2:1.2"},
                                                             {"speed", "2"},
                                                             {"path", "circle"},
                                                             {"periods", "50"},
                                                             {"warmup", "7"},
                                                             {"preset", "experiment"},
                                                             {"body", "sphere"},
                                                             {"floor", "sliding"},
                                                             {"rolling_resistance", "0.01"}};
    if (const auto found = words.find(p.name); found != words.end()) return found->second;
    const ParameterValue value =
        p.said_only_if_set ? ParameterValue(std::stod(p.by_default)) : value_of(p, {});
    if (const auto* number = std::get_if<double>(&value))
        return fmt::format("{}", *number == p.lowest ? 0.5 * p.highest : 0.9 * *number);
    if (const auto* whole = std::get_if<std::int64_t>(&value)) return fmt::format("{}", *whole - 1);
    return "7";
}

// Whatever goes by the JSON, such as the identity of a resumed run and the seeds of a sweep, tells
// two runs apart by every parameter that there is.
TEST(RunParameters, EveryOneIsInTheJsonAndComesBackFromIt) {
    const std::string paper = config_json({}).dump();
    for (const Parameter& p : run_parameters) {
        EXPECT_EQ(config_json({}).contains(p.name), p.is_written() && !p.said_only_if_set)
            << p.name;
        if (!p.can_be_given()) continue;
        ParameterTexts texts{{p.name, another(p)}};
        for (const char* of_spheres :
             {"floor", "rolling_resistance", "vertical_disc", "vertical_wall"})
            if (p.name == std::string(of_spheres)) texts["body"] = "sphere";  // discs have none
        for (const char* of_the_floor : {"floor_friction", "gravity", "rolling_resistance"})
            if (p.name == std::string(of_the_floor)) texts["floor"] = "sliding";
        const RunConfig config = resolve(texts);
        const nlohmann::ordered_json json = config_json(config);
        EXPECT_NE(json.dump(), paper) << p.name;
        EXPECT_EQ(config_json(resolve(parameters_in(json))), json) << p.name;
        EXPECT_EQ(config_json(resolve(texts_of(config))), json) << p.name;
    }
}

// Seeds of sweeps come from these bytes.
TEST(RunParameters, TheJsonIsWhatItAlwaysWas) {
    EXPECT_EQ(config_json({}).dump(),
              R"({"discs":48,"mu_disc":1.0,"mu_wall":1.0,"inertia":10.0,"mass":1.0,"radius":1.0,)"
              R"("mixture":null,"restitution":1.0,"tangential_restitution":0.0,)"
              R"("contact_duration":0.001,"container_radius":8.6,"amplitude":1.892,)"
              R"("period":11.866071,"speed":1.0000000126532211,"omega":0.529508487449602,)"
              R"("path":"polygon","sides":30,"events":1000000,"periods":null,"warmup":null,)"
              R"("seed":1})");
    EXPECT_EQ(config_json(resolve({{"discs", "5"},
                                   {"path", "circle"},
                                   {"speed", "2"},
                                   {"warmup", "auto"},
                                   {"mixture", "3:0.7:1.5"},
                                   {"periods", "5"}}))
                  .dump(),
              R"({"discs":5,"mu_disc":1.0,"mu_wall":1.0,"inertia":10.0,"mass":1.0,"radius":1.0,)"
              R"("mixture":{"count":3,"radius":0.7,"mass":1.5},"restitution":1.0,)"
              R"("tangential_restitution":0.0,"contact_duration":0.001,"container_radius":8.6,)"
              R"("amplitude":1.892,"period":5.9438933005918875,"speed":2.0000000000000004,)"
              R"("omega":1.0570824524312898,"path":"circle","sides":null,"events":null,)"
              R"("periods":5,"warmup":"auto","seed":1})");
}

TEST(RunParameters, TheDefaultOfARowIsTheDefaultOfTheRun) {
    for (const Parameter& p : run_parameters) {
        const std::string text = default_of(p);
        if (!p.can_be_given() || text.empty() || text.find(' ') != text.npos) continue;
        EXPECT_EQ(config_json(resolve({{p.name, text}})), config_json({})) << p.name;
    }
    EXPECT_EQ(default_of(*find_parameter("events")), "1e6");
    EXPECT_EQ(default_of(*find_parameter("container-radius")), "8.6");
}

TEST(RunParameters, RangesAreRefusedAtBothEndsWithTheirNumbers) {
    for (const Parameter& p : run_parameters) {
        if (!p.can_be_given() || p.highest <= 0.0 || p.name == std::string("mixture")) continue;
        EXPECT_THAT(refusal({{p.name, fmt::format("{}", p.lowest - 1.0)}}),
                    testing::HasSubstr(option_name(p.name)));
        EXPECT_THAT(refusal({{p.name, fmt::format("{}", 2.0 * p.highest)}}),
                    testing::HasSubstr("to "))
            << p.name;
    }
}

TEST(RunParameters, SpheresAreSolidUnlessTheirInertiaIsGiven) {
    EXPECT_EQ(resolve({{"body", "sphere"}, {"mass", "2"}}).inertia, 0.8);
    EXPECT_DOUBLE_EQ(resolve({{"body", "sphere"}, {"inertia", "shell"}}).inertia, 2.0 / 3.0);
    EXPECT_EQ(resolve({{"body", "sphere"}, {"inertia", "paper"}}).inertia, 10.0);
}
TEST(RunParameters, ThePresetIsTheExperimentAndWhatIsGivenBesidesWins) {
    const RunConfig experiment = resolve({{"preset", "experiment"}});
    EXPECT_EQ(experiment.body, Shape::sphere);
    EXPECT_TRUE(experiment.floor);
    EXPECT_DOUBLE_EQ(experiment.container_radius, 8.5);
    EXPECT_NEAR(experiment.amplitude / experiment.container_radius, 0.2255, 1e-4);
    // 9.81 m/s² for a length of 3 mm and a speed of 67.9 mm/s.
    EXPECT_NEAR(experiment.gravity, 9.81 * 3e-3 / (67.9075e-3 * 67.9075e-3), 1e-3);
    EXPECT_EQ(experiment.inertia, 0.4);
    const RunConfig other = resolve({{"preset", "experiment"}, {"mu", "0.15"}, {"floor", "none"}});
    EXPECT_EQ(other.mu_wall, 0.15);
    EXPECT_FALSE(other.floor);
    EXPECT_EQ(resolve(texts_of(experiment)).gravity, experiment.gravity);
    EXPECT_EQ(config_json(resolve(overridden(texts_of({}), {{"preset", "experiment"}}))),
              config_json(resolve({{"preset", "experiment"}, {"events", "1e6"}})));
}
TEST(RunParameters, WhatSpheresCannotDoIsRefused) {
    EXPECT_THAT(refusal({{"floor", "sliding"}, {"path", "circle"}}),
                testing::HasSubstr("parabola"));
    EXPECT_THAT(refusal({{"floor", "sliding"}, {"vertical_disc", "0"}}),
                testing::HasSubstr("do not slip vertically"));
    EXPECT_THAT(refusal({{"body", "sphere"}, {"path", "circle"}}), testing::HasSubstr("parabola"));
    EXPECT_THAT(refusal({{"body", "sphere"}, {"floor", "rough"}}),
                testing::AllOf(testing::HasSubstr("collide without end"),
                               testing::HasSubstr("a large --floor-friction, 100")));
}
TEST(RunParameters, RollingResistanceIsOfSpheresOnAFloorAndNotAboveItsFriction) {
    EXPECT_THAT(refusal({{"body", "sphere"}, {"rolling_resistance", "0.01"}}),
                testing::HasSubstr("there is no floor"));
    EXPECT_THAT(refusal({{"floor", "sliding"}, {"rolling_resistance", "0.01"}}),
                testing::HasSubstr("discs do not roll"));
    EXPECT_THAT(refusal({{"preset", "experiment"}, {"rolling_resistance", "0.31"}}),
                testing::HasSubstr("--floor-friction, 0.3"));
    EXPECT_THAT(refusal({{"preset", "experiment"}, {"rolling_resistance", "-0.1"}}),
                testing::HasSubstr("from 0 to"));
    EXPECT_EQ(refusal({{"preset", "experiment"}, {"rolling_resistance", "0.3"}}), "");
}
TEST(RunParameters, WhatOnlyAFloorDoesIsRefusedWithoutOne) {
    EXPECT_THAT(refusal({{"floor_friction", "0.5"}}), testing::HasSubstr("there is no floor"));
    EXPECT_THAT(refusal({{"body", "sphere"}, {"gravity", "2"}}),
                testing::HasSubstr("there is no floor"));
    EXPECT_EQ(refusal({{"preset", "experiment"}, {"floor", "none"}}), "");
}
// Measured at N = 36: with 100 times the experiment's 0.3 ϖ is what it was, with 3000 times not.
TEST(RunParameters, AFloorThatPartsBodiesFasterThanTheDishSwirlsIsRefused) {
    EXPECT_EQ(refusal({{"preset", "experiment"}, {"floor_friction", "100"}}), "");
    EXPECT_THAT(refusal({{"preset", "experiment"}, {"floor_friction", "1000"}}),
                testing::HasSubstr("--contact-duration 0.001"));
    EXPECT_EQ(
        refusal(
            {{"preset", "experiment"}, {"floor_friction", "1000"}, {"contact_duration", "1e-5"}}),
        "");
}

TEST(RunParameters, BothSpellingsOfANameAreRead) {
    EXPECT_EQ(resolve({{"mu-wall", "0.5"}}).mu_wall, 0.5);
    EXPECT_EQ(resolve({{"mu_wall", "0.5"}}).mu_wall, 0.5);
    EXPECT_THAT(refusal({{"mu-wall", "0.5"}, {"mu_wall", "1"}}), testing::HasSubstr("given twice"));
}

/// What holds when `by_hand` is given on top of a file that says everything about a run.
RunConfig on_top_of(const ParameterTexts& file, const ParameterTexts& by_hand) {
    return resolve(overridden(texts_of(resolve(file)), by_hand));
}

TEST(Overridden, WhatIsGivenByHandWinsOverItsRelativesInAFile) {
    EXPECT_EQ(on_top_of({}, {{"mu", "0.7"}}).mu_disc, 0.7);
    EXPECT_EQ(on_top_of({}, {{"mu", "0.7"}}).mu_wall, 0.7);
    EXPECT_EQ(on_top_of({{"mu", "0.7"}}, {{"mu_disc", "0.2"}}).mu_wall, 0.7);
    EXPECT_EQ(on_top_of({}, {{"periods", "50"}}).periods, 50);
    EXPECT_EQ(on_top_of({{"periods", "50"}}, {{"events", "1e4"}}).events, 10'000);
    EXPECT_FALSE(on_top_of({{"periods", "50"}}, {{"events", "1e4"}}).periods);
    EXPECT_EQ(on_top_of({{"path", "circle"}}, {{"sides", "12"}}).sides, 12);
    EXPECT_EQ(on_top_of({{"sides", "12"}}, {{"path", "circle"}}).path, PathShape::circle);
    EXPECT_EQ(on_top_of({{"sides", "12"}}, {{"path", "polygon"}}).sides, 12);
}

TEST(Overridden, OfAmplitudePeriodAndSpeedTheOneGoesThatNobodyAskedForByHand) {
    EXPECT_NEAR(container_speed(on_top_of({}, {{"speed", "2"}})), 2.0, 1e-12);
    EXPECT_EQ(on_top_of({}, {{"speed", "2"}}).amplitude, paper_amplitude);
    const RunConfig both = on_top_of({}, {{"speed", "2"}, {"period", "5"}});
    EXPECT_NEAR(container_speed(both), 2.0, 1e-12);
    EXPECT_EQ(both.period, 5.0);
    const ParameterTexts file{{"speed", "2"}, {"amplitude", "1"}};
    const RunConfig slower = resolve(overridden(file, {{"period", "9"}}));
    EXPECT_EQ(slower.period, 9.0);
    EXPECT_EQ(slower.amplitude, 1.0);
    EXPECT_THROW(resolve(overridden({}, {{"speed", "1"}, {"period", "1"}, {"amplitude", "1"}})),
                 UsageError);
}

TEST(Overridden, NamesOfInertiaAndTheMaterialOfAMixtureFollowAnotherMass) {
    EXPECT_EQ(on_top_of({}, {{"mass", "2"}}).inertia, 20.0);
    EXPECT_EQ(on_top_of({{"inertia", "ring"}}, {{"mass", "2"}}).inertia, 2.0);
    EXPECT_EQ(on_top_of({{"inertia", "3"}}, {{"mass", "2"}}).inertia, 3.0);
    EXPECT_EQ(on_top_of({{"mixture", "2:0.5"}}, {{"mass", "2"}}).mixture->mass, 0.5);
    EXPECT_EQ(on_top_of({{"mixture", "2:0.5:3"}}, {{"mass", "2"}}).mixture->mass, 3.0);
    // Spheres have a volume, and their material is that of the others in whatever order it is said.
    EXPECT_EQ(on_top_of({{"mixture", "2:0.5"}, {"body", "sphere"}}, {{"mass", "2"}}).mixture->mass,
              0.25);
    EXPECT_EQ(on_top_of({{"mixture", "2:0.5"}}, {{"preset", "experiment"}}).mixture->mass, 0.125);
}

TEST(ReadNumber, TakesNumbersAndNothingElse) {
    EXPECT_EQ(read_number("0.5"), 0.5);
    EXPECT_EQ(read_number("1e3"), 1000.0);
    for (const char* text : {"", " 1", "1 ", "1,5", "nan", "inf", "-inf", "0x10", "1e999", "--1"})
        EXPECT_FALSE(read_number(text)) << text;
}

TEST(ReadWholeNumber, TakesWholeNumbersHoweverWritten) {
    EXPECT_EQ(read_whole_number("48"), 48);
    EXPECT_EQ(read_whole_number("1e6"), 1'000'000);
    EXPECT_EQ(read_whole_number("-3"), -3);
    EXPECT_EQ(read_whole_number("9007199254740993"), 9007199254740993);  // 2⁵³ + 1: no double
    for (const char* text : {"", "1.5", "1e30", "x", "1e", "9223372036854775808"})
        EXPECT_FALSE(read_whole_number(text)) << text;
}

}  // namespace
}  // namespace swirl
