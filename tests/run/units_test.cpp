// Values with units are the same run as their ratios, or an error.
#include "swirl/run/units.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <cmath>

#include <nlohmann/json.hpp>

#include "run/rejected_parameters.hpp"
#include "swirl/measure/quantities.hpp"
#include "swirl/run/config.hpp"
#include "swirl/run/json.hpp"

namespace swirl {
namespace {

const ParameterTexts dish{{"body", "sphere"},
                          {"radius", "3mm"},
                          {"container_radius", "25.5mm"},
                          {"amplitude", "11.5mm"},
                          {"period", "0.532s"}};

ParameterTexts with_more(ParameterTexts texts, const ParameterTexts& more) {
    for (const auto& [name, text] : more) texts[name] = text;
    return texts;
}

/// The configuration as text without what only reports use.
std::string trajectory_text(RunConfig config) {
    config.length_unit.clear();
    config.time_unit.clear();
    return config_text(config);
}

TEST(Units, ADishInMillimetresIsInUnitsOfItsParticles) {
    const RunConfig config = resolve(dish);
    EXPECT_EQ(config.radius, 1.0);
    EXPECT_EQ(config.container_radius, 8.5);
    EXPECT_EQ(config.amplitude, 11.5 / 3.0);
    EXPECT_EQ(config.period, 2.0 * pi * config.amplitude);
    // 9.81 m/s² in r/(r/v)²; v = 2π 11.5 mm/0.532 s.
    const double v = 2.0 * pi * 11.5 / 0.532;
    EXPECT_DOUBLE_EQ(config.gravity, 9810.0 * 3.0 / (v * v));
    EXPECT_EQ(config.contact_duration, RunConfig{}.contact_duration);
    EXPECT_EQ(resolve(with_more(dish, {{"floor", "none"}})).gravity, RunConfig{}.gravity);
}

// Preset with sizes in millimetres, the same in other units, and ratios.
TEST(Units, EveryWayToGiveADishIsTheSameRun) {
    const ParameterTexts preset{{"preset", "experiment"}};
    const ParameterTexts sizes = with_more(preset, {{"radius", "3mm"},
                                                    {"container_radius", "25.5mm"},
                                                    {"amplitude", "11.5mm"},
                                                    {"period", "0.5s"}});
    const std::string text = trajectory_text(resolve(sizes));
    for (const ParameterTexts& other :
         {with_more(preset, {{"period", "0.5s"}}), with_more(preset, {{"period", "120rpm"}}),
          with_more(preset, {{"period", "2Hz"}}), with_more(sizes, {{"period", "500ms"}}),
          with_more(sizes, {{"radius", "3000um"}}), with_more(sizes, {{"gravity", "9.81m/s2"}}),
          with_more(sizes, {{"gravity", "9.81 m/s²"}})})
        EXPECT_EQ(trajectory_text(resolve(other)), text);
    ParameterTexts ratios = texts_of(resolve(sizes));
    ratios.erase("length_unit");
    ratios.erase("time_unit");
    EXPECT_EQ(trajectory_text(resolve(ratios)), text);
    // What results store is the same configuration again.
    EXPECT_EQ(config_text(resolve(texts_of(resolve(sizes)))), config_text(resolve(sizes)));
}

TEST(Units, SpeedsAndMixturesHaveUnits) {
    const ParameterTexts discs{{"radius", "5mm"}, {"container_radius", "45mm"}};
    const RunConfig by_speed = resolve(
        with_more(discs, {{"amplitude", "10mm"}, {"speed", "0.2m/s"}, {"mixture", "12:7mm"}}));
    EXPECT_EQ(by_speed.mixture->radius, 1.4);
    EXPECT_DOUBLE_EQ(container_speed(by_speed), 1.0);
    EXPECT_EQ(by_speed.amplitude, 2.0);
    // 5 mm in 0.2 m/s are 25 ms.
    EXPECT_DOUBLE_EQ(user_units(by_speed)->time, 0.025);
    const RunConfig by_period = resolve(with_more(discs, {{"speed", "0.2m/s"}, {"period", "1s"}}));
    EXPECT_DOUBLE_EQ(by_period.period, 40.0);
    EXPECT_DOUBLE_EQ(container_speed(by_period), 1.0);
    EXPECT_EQ(resolve(with_more(discs, {{"amplitude", "0"}, {"period", "1s"}})).amplitude, 0.0);
    EXPECT_EQ(resolve(with_more(dish, {{"sizes", "uniform:2mm:4.5mm"}})).sizes->numbers[1], 1.5);
}

TEST(Units, NumbersAloneAndWrongUnitsAreRejected) {
    const auto says = [](const ParameterTexts& more, const char* words) {
        EXPECT_THAT(swirl::error_of(with_more(dish, more)), testing::HasSubstr(words));
    };
    says({{"container_radius", "8.5"}}, "--container-radius is 8.5, but other values have units");
    says({{"gravity", "9810"}}, "--gravity is 9810, but other values have units");
    says({{"contact_duration", "2e-5"}}, "give it a unit, such as 0.02ms");
    says({{"mixture", "12:1.4"}}, "such as 12:4mm");
    says({{"inertia", "0.4"}}, "--inertia is 0.4, but other values have units");
    says({{"ramp", "amplitude=1:2@2..9"}}, "--ramp is amplitude");
    says({{"radius", "3s"}}, "--radius is '3s', but it must be a value such as 3mm");
    says({{"period", "3mm"}}, "such as 0.77s or 78rpm");
    says({{"period", "-3s"}}, "above 0");
    says({{"radius", "0mm"}}, "such as 3mm");
    says({{"mu", "0.3mm"}}, "--mu is '0.3mm', but it must be a number without a unit");
    says({{"radius", "3km"}}, "--radius is 3km, but other values have units");
    EXPECT_THAT(swirl::error_of(ParameterTexts{{"radius", "3km"}}),
                testing::HasSubstr("units are um, mm"));
    EXPECT_THAT(swirl::error_of(ParameterTexts{{"radius", "3mm"}}),
                testing::HasSubstr("add --container-radius 3mm"));
    ParameterTexts still = dish;
    still.erase("period");
    EXPECT_THAT(swirl::error_of(still), testing::HasSubstr("--period has no value"));
    EXPECT_THAT(swirl::error_of(ParameterTexts{{"length_unit", "3mm"}}),
                testing::HasSubstr("belong together"));
    EXPECT_THAT(swirl::error_of(
                    ParameterTexts{{"length_unit", "3mm"}, {"time_unit", "1s"}, {"radius", "0.9"}}),
                testing::HasSubstr("--radius is 0.9 instead of 1"));
}

// A stored configuration has ratios; an option with a unit changes one of them.
TEST(Units, AStoredDishTakesValuesWithUnits) {
    const ParameterTexts stored = texts_of(resolve(dish));
    const RunConfig other = resolve(overridden(stored, {{"container_radius", "30mm"}}));
    EXPECT_EQ(other.container_radius, 10.0);
    EXPECT_EQ(other.amplitude, 11.5 / 3.0);
    // Twice as fast at the same gravity.
    const RunConfig faster = resolve(overridden(stored, {{"period", "0.266s"}}));
    EXPECT_DOUBLE_EQ(faster.period, 0.5 * resolve(dish).period);
    EXPECT_EQ(faster.gravity, resolve(dish).gravity);
}

TEST(Units, ReportsShowTheDish) {
    const RunConfig config = resolve(dish);
    EXPECT_EQ(dish_in_units(config, *user_units(config)),
              "r = 3 mm, R = 25.5 mm, A = 11.5 mm, 112.8 rpm, v = 135.8 mm/s");
    EXPECT_FALSE(user_units(resolve({})));
}

// r = 3 mm, and the mean speed on the polygon with 30 sides is 60 · 11.5 mm sin(6°)/0.532 s.
TEST(Units, EveryUnitOfAReportHasOneOfTheUser) {
    const RunConfig config = resolve(dish);
    const auto user = user_units(config);
    ASSERT_TRUE(user);
    const double r = 3.0, v = 60.0 * 11.5 * std::sin(pi / 30.0) / 0.532, T = 0.532;
    struct Expected {
        Unit unit;
        double factor;
        const char* text;
    };
    for (const auto& [unit, factor, text] : {Expected{"r", r, "mm"},
                                             {"v²/r", v * v / r, "mm/s²"},
                                             {"v/r", v / r, "1/s"},
                                             {"r/v", r / v, "s"},
                                             {"1/r²", 1.0 / (r * r), "1/mm²"},
                                             {"m v²", v * v, "particle mass mm²/s²"},
                                             {"m v²/r²", v * v / (r * r), "particle mass/s²"},
                                             {"m v³/r", v * v * v / r, "particle mass mm²/s³"},
                                             {"Ω", 2.0 * pi / T, "rad/s"},
                                             {"T", T, "s"}}) {
        const auto found = in_user_units(unit, config, *user);
        ASSERT_TRUE(found) << unit.text;
        EXPECT_NEAR(found->factor, factor, 1e-6 * factor) << unit.text;  // v has 24 bits
        EXPECT_EQ(found->text, text);
    }
    EXPECT_FALSE(in_user_units(quantity("slip.cluster").unit, config, *user));
    EXPECT_FALSE(in_user_units(quantity("centre.theta").unit, config, *user));
    // Every row of the registry has one, or is a number or an angle.
    for (const Quantity& row : all_quantities::rows)
        EXPECT_EQ(in_user_units(row.unit, config, *user).has_value(),
                  row.unit.length() != 0 || row.unit.time() != 0)
            << row.name;
}

}  // namespace
}  // namespace swirl
