#include "swirl/run/parameters.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "swirl/run/failure.hpp"

namespace swirl {
namespace {

std::string refusal(const ParameterTexts& given) {
    try {
        resolve(given);
    } catch (const WrongCall& wrong) {
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
    EXPECT_THAT(refusal({{"mu_wal", "1"}}), testing::HasSubstr("did you mean 'mu-wall'"));
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
    for (const RunParameter& p : run_parameters()) {
        EXPECT_TRUE(seen.insert(p.name).second) << p.name;
        EXPECT_EQ(refusal({{p.name, ""}}).find("There is no parameter"), std::string::npos);
        EXPECT_NE(refusal({{p.name, ""}}), "") << p.name << " accepts an empty text";
        EXPECT_NE(refusal({{p.name, "x"}}), "") << p.name << " accepts 'x'";
        EXPECT_NE(refusal({{p.name, "nan"}}), "") << p.name << " accepts nan";
        EXPECT_NE(refusal({{p.name, "-1e300"}}), "") << p.name << " accepts -1e300";
    }
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
