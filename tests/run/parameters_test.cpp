#include "swirl/run/parameters.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "run/other_values.hpp"
#include "run/rejected_parameters.hpp"
#include "swirl/physics/contact.hpp"
#include "swirl/run/config.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/json.hpp"

namespace swirl {
namespace {

TEST(RunParameters, DefaultsAreTheValuesOfThePaper) {
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

TEST(RunParameters, SpecificFrictionOverridesMu) {
    const RunConfig config = resolve({{"mu", "0.5"}, {"mu-wall", "0"}});
    EXPECT_EQ(config.mu_disc, 0.5);
    EXPECT_EQ(config.mu_wall, 0.0);
}

TEST(RunParameters, AnUnknownNameIsRejectedWithTheNearest) {
    EXPECT_THAT(error_of({{"mu_wal", "1"}}), testing::EndsWith("did you mean 'mu_wall'?"));
    expect_rejected({{"colour-of-the-sky", "blue"}}, "swirl help run all");
}

TEST(RunParameters, TwoOfAmplitudePeriodAndSpeedDetermineTheThird) {
    EXPECT_NEAR(resolve({{"amplitude", "2"}, {"speed", "3"}}).period, 2.0 / 1.892 * 11.866071 / 3.0,
                1e-6);
    EXPECT_NEAR(resolve({{"period", "5"}, {"speed", "3"}}).amplitude, 1.892 * 5.0 / 11.866071 * 3.0,
                1e-6);
    EXPECT_EQ(resolve({{"amplitude", "0"}, {"speed", "0"}}).amplitude, 0.0);
    EXPECT_NE(error_of({{"speed", "0"}}), "");
    EXPECT_NE(error_of({{"speed", "1"}, {"amplitude", "1"}, {"period", "1"}}), "");
}

TEST(RunParameters, NamesAreUniqueAndRejectInvalidTexts) {
    std::set<std::string> seen;
    for (const Parameter& p : run_parameters) {
        if (!p.is_settable()) continue;
        EXPECT_TRUE(seen.insert(p.name).second) << p.name;
        EXPECT_EQ(error_of({{p.name, ""}}).find("there is no parameter"), std::string::npos);
        EXPECT_NE(error_of({{p.name, ""}}), "") << p.name << " accepts an empty text";
        EXPECT_NE(error_of({{p.name, "x"}}), "") << p.name << " accepts 'x'";
        EXPECT_NE(error_of({{p.name, "nan"}}), "") << p.name << " accepts nan";
        EXPECT_NE(error_of({{p.name, "-1e300"}}), "") << p.name << " accepts -1e300";
    }
}

// The identity of a resumed run and the seeds of a sweep use the JSON, so it must distinguish runs
// by every parameter.
TEST(RunParameters, EveryParameterSurvivesTheJson) {
    const std::string paper = config_json({}).dump();
    for (const Parameter& p : run_parameters) {
        EXPECT_EQ(config_json({}).contains(p.name),
                  p.is_written() && p.written == WrittenIf::always)
            << p.name;
        if (!p.is_settable()) continue;
        ParameterTexts texts = needed_by(p);
        texts[p.name] = another(p);
        const RunConfig config = resolve(texts);
        const nlohmann::ordered_json json = config_json(config);
        EXPECT_NE(json.dump(), paper) << p.name;
        EXPECT_EQ(config_json(resolve(parameters_in(json))), json) << p.name;
        EXPECT_EQ(config_json(resolve(texts_of(config))), json) << p.name;
    }
}

/// The state after some events, or nothing if there is no such run.
std::optional<std::uint64_t> state_after(const ParameterTexts& texts) try {
    Simulation simulation(make_initial_state(resolve(texts)));
    simulation.run(3000);
    return simulation.state_hash();
} catch (const UsageError&) {
    return {};
}

// A parameter that only the table knows would be in every result and change none.
TEST(RunParameters, EveryNumberChangesTheTrajectory) {
    for (const Parameter& p : run_parameters) {
        if (p.page.slider.step == 0.0 || p.group == parameter_group::run) continue;
        ParameterTexts texts = needed_by(p);
        texts.try_emplace("discs", "20");
        texts.try_emplace("restitution", "0.9");  // the contact duration has an effect
        const auto without = state_after(texts);
        bool has_effect = false;
        const auto& [from, to, step] = p.page.slider;
        for (const double value : {from, 0.5 * (from + to), to}) {
            texts[p.name] = fmt::format("{}", value);
            const auto with = state_after(texts);
            has_effect = has_effect || (with && with != without);
        }
        EXPECT_TRUE(has_effect) << option_name(p.name)
                                << " changes no trajectory: use its coefficient in "
                                   "physics/collision_law.hpp, or its member in run/config.cpp.";
    }
}

TEST(RunParameters, EveryCoefficientOfTheCollisionLawHasRows) {
    for (const Coefficient& c : coefficients)
        for (const Contacts contacts : {Contacts::of_particles, Contacts::with_wall}) {
            const auto is_row = [&](const Parameter& p) {
                return p.coefficient == c.member &&
                       (p.contacts == Contacts::all || p.contacts == contacts);
            };
            EXPECT_EQ(std::ranges::count_if(run_parameters, is_row), 1)
                << "Surface::" << c.name << " of "
                << (contacts == Contacts::with_wall ? "the wall" : "particles")
                << " needs one row with .coefficient in run/parameter_table.cpp.";
        }
}

TEST(RunParameters, ColumnsOfARowBelongTogether) {
    for (const Parameter& p : run_parameters) {
        const bool needs_number = p.coefficient || p.can_ramp() || needs_floor(p.applies_to) ||
                                  needs_spheres(p.applies_to) || p.in_preset > InPreset::set;
        if (needs_number && p.name != std::string_view("mu")) {
            EXPECT_NE(p.number(), nullptr) << p.name << " needs a member that is a double.";
        }
        EXPECT_EQ(p.coefficient != nullptr, p.contacts != Contacts::none) << p.name;
        if (p.can_ramp()) {
            EXPECT_THAT(find_parameter("ramp")->details, testing::HasSubstr(p.name))
                << "the details of --ramp list what can change.";
        }
    }
}

// Seeds of sweeps are computed from these bytes.
TEST(RunParameters, TheJsonIsUnchanged) {
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

TEST(RunParameters, DefaultTextsResolveToTheDefaults) {
    for (const Parameter& p : run_parameters) {
        const std::string text = default_of(p);
        if (!p.is_settable() || text.empty() || text.find(' ') != text.npos) continue;
        ParameterTexts given = needed_by(p);
        const RunConfig expected = resolve(given);
        given[p.name] = text;
        EXPECT_EQ(config_json(resolve(given)), config_json(expected)) << p.name;
    }
    EXPECT_EQ(default_of(*find_parameter("events")), "1e6");
    EXPECT_EQ(default_of(*find_parameter("container-radius")), "8.6");
}

TEST(RunParameters, ValuesOutsideTheRangeAreRejected) {
    for (const Parameter& p : run_parameters) {
        if (!p.is_settable() || p.range.highest <= 0.0 || p.name == std::string("mixture"))
            continue;
        EXPECT_THAT(error_of({{p.name, fmt::format("{}", p.range.lowest - 1.0)}}),
                    testing::HasSubstr(option_name(p.name)));
        EXPECT_THAT(error_of({{p.name, fmt::format("{}", 2.0 * p.range.highest)}}),
                    testing::HasSubstr("to "))
            << p.name;
    }
    EXPECT_EQ(error_of({{"mu", "1e6"}}), "");
    EXPECT_NE(error_of({{"mu", "1.1e6"}}), "");
}

TEST(RunParameters, SpheresAreSolidUnlessTheirInertiaIsGiven) {
    EXPECT_EQ(resolve({{"body", "sphere"}, {"mass", "2"}}).inertia, 0.8);
    EXPECT_DOUBLE_EQ(resolve({{"body", "sphere"}, {"inertia", "shell"}}).inertia, 2.0 / 3.0);
    EXPECT_EQ(resolve({{"body", "sphere"}, {"inertia", "paper"}}).inertia, 10.0);
}
TEST(RunParameters, ThePresetIsTheExperimentAndOtherParametersOverrideIt) {
    const RunConfig experiment = resolve({{"preset", "experiment"}});
    EXPECT_EQ(experiment.body, Shape::sphere);
    EXPECT_TRUE(experiment.floor);
    EXPECT_DOUBLE_EQ(experiment.container_radius, 8.5);
    // 11.5 mm and 25.5 mm, the numbers of the main text.
    EXPECT_NEAR(experiment.amplitude / experiment.container_radius, 0.45098, 1e-5);
    // 9.81 m/s² in units of 3 mm and 11.5 mm × 11.81 /s.
    EXPECT_NEAR(experiment.gravity, 9.81 * 3e-3 / (135.815e-3 * 135.815e-3), 3e-4);
    EXPECT_EQ(experiment.inertia, 0.4);
    EXPECT_EQ(experiment.mu_disc, experiment.floor_friction);
    const RunConfig other = resolve({{"preset", "experiment"}, {"mu", "0.15"}, {"floor", "none"}});
    EXPECT_EQ(other.mu_wall, 0.15);
    EXPECT_FALSE(other.floor);
    EXPECT_EQ(resolve(texts_of(experiment)).gravity, experiment.gravity);
    EXPECT_EQ(config_json(resolve(overridden(texts_of({}), {{"preset", "experiment"}}))),
              config_json(resolve({{"preset", "experiment"}, {"events", "1e6"}})));
}
// In every preset the container has the speed 1, so that A Ω = 1; half the amplitude has four times
// the gravity in units of (A Ω)²/r.
TEST(RunParameters, PresetsDifferInAmplitudeOrFrictionOnly) {
    const RunConfig smooth = resolve({{"preset", "experiment"}}),
                    rough = resolve({{"preset", "experiment-rough"}}),
                    half = resolve({{"preset", "experiment-half"}});
    for (const RunConfig* config : {&smooth, &rough, &half})
        EXPECT_DOUBLE_EQ(config->amplitude * config->omega(), 1.0);
    EXPECT_EQ(rough.amplitude, smooth.amplitude);
    EXPECT_GT(rough.mu_wall, smooth.mu_wall);
    EXPECT_EQ(half.mu_wall, smooth.mu_wall);
    EXPECT_DOUBLE_EQ(2.0 * half.amplitude, smooth.amplitude);
    EXPECT_DOUBLE_EQ(half.gravity, 4.0 * smooth.gravity);
    expect_rejected({{"preset", "experiment-ruogh"}}, "did you mean 'experiment-rough'");
}
// Lengths of a preset are multiples of r, and its contact duration is a share of the period.
// Gravity in another unit of length or time is unknown.
TEST(RunParameters, APresetFollowsTheUnitsOfACallOrIsRejected) {
    for (const char* name : {"experiment", "experiment-rough", "experiment-half"}) {
        const RunConfig preset = resolve({{"preset", name}});
        const ParameterTexts in_mm{{"preset", name},
                                   {"radius", "3"},
                                   {"container_radius", "25.5"},
                                   {"amplitude", fmt::format("{}", 3.0 * preset.amplitude)},
                                   {"period", "0.532"}};
        expect_rejected(in_mm, "needs --gravity with --radius 3");
        expect_rejected({{"preset", name}, {"period", "15"}}, "--period 15");
        expect_rejected({{"preset", name}, {"speed", "2"}}, "--speed 2");
        expect_rejected({{"preset", name}, {"radius", "2"}}, "--radius 2");
        ParameterTexts with_gravity = in_mm;
        with_gravity["gravity"] = "9810";
        const RunConfig own = resolve(with_gravity);
        EXPECT_DOUBLE_EQ(own.contact_duration / own.period,
                         preset.contact_duration / preset.period);
        const RunConfig larger = resolve({{"preset", name}, {"radius", "2"}, {"gravity", "3"}});
        EXPECT_EQ(larger.container_radius, 2.0 * preset.container_radius);
        EXPECT_EQ(larger.amplitude, 2.0 * preset.amplitude);
        // In r and AΩ nothing changes: another dish, another speed of 1, no floor.
        for (ParameterTexts more : {ParameterTexts{{"container_radius", "7.5"}, {"amplitude", "2"}},
                                    {{"amplitude", "1.5"}, {"speed", "1"}},
                                    {{"amplitude", "2"}, {"period", "12.566"}}}) {
            more["preset"] = name;
            more["discs"] = "20";  // fits into each of them
            EXPECT_EQ(resolve(more).gravity, preset.gravity);
            EXPECT_EQ(resolve(more).contact_duration, preset.contact_duration);
        }
        EXPECT_EQ(error_of({{"preset", name}, {"radius", "2"}, {"floor", "none"}}), "");
    }
}
TEST(RunParameters, SpheresRollOnAFloorUnlessThereIsNone) {
    const RunConfig sphere = resolve({{"body", "sphere"}});
    EXPECT_TRUE(sphere.floor);
    EXPECT_EQ(config_text(sphere),
              config_text(resolve({{"body", "sphere"}, {"floor", "sliding"}})));
    const RunConfig without = resolve({{"floor", "none"}, {"body", "sphere"}});
    EXPECT_FALSE(without.floor);
    EXPECT_FALSE(resolve(texts_of(without)).floor);
    EXPECT_FALSE(resolve({{"body", "disc"}}).floor);
    EXPECT_TRUE(resolve({{"preset", "experiment"}, {"body", "disc"}}).floor);
}
TEST(RunParameters, ImpossibleFloorsAndPathsAreRejected) {
    expect_rejected({{"floor", "sliding"}, {"path", "circle"}}, "parabola");
    expect_rejected({{"floor", "sliding"}, {"vertical_disc", "0"}}, "for spheres only");
    expect_rejected({{"body", "sphere"}, {"path", "circle"}}, "parabola");
    EXPECT_THAT(error_of({{"body", "sphere"}, {"floor", "rough"}}),
                testing::AllOf(testing::HasSubstr("collide without end"),
                               testing::HasSubstr("a large --floor-friction, 100")));
}
TEST(RunParameters, OnlyDiscsWithoutAFloorLackFrictionInOneKindOfContact) {
    EXPECT_EQ(resolve({{"frictionless", "boundary"}}).frictionless, Frictionless::boundary);
    EXPECT_EQ(config_json(resolve({{"frictionless", "none"}})), config_json({}));
    expect_rejected({{"frictionless", "walls"}}, "must be none, wall, boundary or bulk");
    for (const char* kind : {"wall", "boundary", "bulk"}) {
        expect_rejected({{"frictionless", kind}, {"body", "sphere"}},
                        "only for discs without a floor");
        expect_rejected({{"frictionless", kind}, {"floor", "sliding"}},
                        "only for discs without a floor");
    }
    // Then nothing dissipates energy.
    EXPECT_TRUE(resolve({{"frictionless", "wall"}, {"mu_disc", "0"}}).conserves_energy());
    expect_rejected({{"frictionless", "wall"}, {"mu_wall", "0.5"}},
                    "--frictionless is wall, but --mu-wall is 0.5");
    for (const ParameterTexts& texts : {ParameterTexts{{"mu", "0.5"}}, {{"mu_wall", "0"}}, {}}) {
        ParameterTexts smooth = texts;
        smooth["frictionless"] = "wall";
        const RunConfig config = resolve(smooth);
        EXPECT_EQ(config.mu_wall, 0.0);
        EXPECT_EQ(config_text(resolve(texts_of(config))), config_text(config));
    }
    const ParameterTexts file{{"mu_wall", "0.5"}};
    EXPECT_EQ(resolve(overridden(file, {{"frictionless", "wall"}})).mu_wall, 0.0);
    EXPECT_FALSE(resolve({{"frictionless", "bulk"}, {"mu_disc", "0"}}).conserves_energy());
}
TEST(RunParameters, RollingResistanceNeedsSpheresOnAFloorAndIsBounded) {
    EXPECT_EQ(error_of({{"body", "sphere"}, {"rolling_resistance", "0.01"}}), "");
    expect_rejected({{"floor", "sliding"}, {"rolling_resistance", "0.01"}}, "for spheres only");
    expect_rejected({{"preset", "experiment"}, {"rolling_resistance", "0.34"}},
                    "--floor-friction, 0.33");
    expect_rejected({{"preset", "experiment"}, {"rolling_resistance", "-0.1"}}, "from 0 to");
    EXPECT_EQ(error_of({{"preset", "experiment"}, {"rolling_resistance", "0.33"}}), "");
}
TEST(RunParameters, FloorParametersAreRejectedWithoutAFloor) {
    expect_rejected({{"floor_friction", "0.5"}}, "there is no floor");
    expect_rejected({{"gravity", "2"}}, "there is no floor");
    EXPECT_EQ(error_of({{"preset", "experiment"}, {"floor", "none"}}), "");
}
// Measured at N = 36: ϖ is the same up to 100 times the experiment's floor friction of 0.3. At 3000
// times this friction ϖ differs.
TEST(RunParameters, TooLargeFloorFrictionIsRejected) {
    EXPECT_EQ(error_of({{"preset", "experiment"}, {"floor_friction", "100"}}), "");
    expect_rejected({{"preset", "experiment"}, {"floor_friction", "1000"}},
                    "--contact-duration 0.001");
    EXPECT_EQ(
        error_of(
            {{"preset", "experiment"}, {"floor_friction", "1000"}, {"contact_duration", "1e-5"}}),
        "");
}

TEST(RunParameters, BothSpellingsOfANameAreAccepted) {
    EXPECT_EQ(resolve({{"mu-wall", "0.5"}}).mu_wall, 0.5);
    EXPECT_EQ(resolve({{"mu_wall", "0.5"}}).mu_wall, 0.5);
    expect_rejected({{"mu-wall", "0.5"}, {"mu_wall", "1"}}, "given twice");
}

/// The configuration of a complete file with these options of the command line.
RunConfig with_options(const ParameterTexts& file, const ParameterTexts& options) {
    return resolve(overridden(texts_of(resolve(file)), options));
}

TEST(Overridden, OptionsOverrideRelatedParametersOfAFile) {
    EXPECT_EQ(with_options({}, {{"mu", "0.7"}}).mu_disc, 0.7);
    EXPECT_EQ(with_options({}, {{"mu", "0.7"}}).mu_wall, 0.7);
    EXPECT_EQ(with_options({{"mu", "0.7"}}, {{"mu_disc", "0.2"}}).mu_wall, 0.7);
    EXPECT_EQ(with_options({}, {{"periods", "50"}}).periods, 50);
    EXPECT_EQ(with_options({{"periods", "50"}}, {{"events", "1e4"}}).events, 10'000);
    EXPECT_FALSE(with_options({{"periods", "50"}}, {{"events", "1e4"}}).periods);
    EXPECT_EQ(with_options({{"path", "circle"}}, {{"sides", "12"}}).sides, 12);
    EXPECT_EQ(with_options({{"sides", "12"}}, {{"path", "circle"}}).path, PathShape::circle);
    EXPECT_EQ(with_options({{"sides", "12"}}, {{"path", "polygon"}}).sides, 12);
}

TEST(Overridden, AmplitudePeriodOrSpeedOfTheFileIsRemoved) {
    EXPECT_NEAR(container_speed(with_options({}, {{"speed", "2"}})), 2.0, 1e-12);
    EXPECT_EQ(with_options({}, {{"speed", "2"}}).amplitude, paper_amplitude);
    const RunConfig both = with_options({}, {{"speed", "2"}, {"period", "5"}});
    EXPECT_NEAR(container_speed(both), 2.0, 1e-12);
    EXPECT_EQ(both.period, 5.0);
    const ParameterTexts file{{"speed", "2"}, {"amplitude", "1"}};
    const RunConfig slower = resolve(overridden(file, {{"period", "9"}}));
    EXPECT_EQ(slower.period, 9.0);
    EXPECT_EQ(slower.amplitude, 1.0);
    EXPECT_THROW(resolve(overridden({}, {{"speed", "1"}, {"period", "1"}, {"amplitude", "1"}})),
                 UsageError);
}

TEST(Overridden, NamedInertiaAndMixtureAdaptToAnotherMass) {
    EXPECT_EQ(with_options({}, {{"mass", "2"}}).inertia, 20.0);
    EXPECT_EQ(with_options({{"inertia", "ring"}}, {{"mass", "2"}}).inertia, 2.0);
    EXPECT_EQ(with_options({{"inertia", "ring"}}, {{"mass", "2"}, {"radius", "0.5"}}).inertia, 0.5);
    EXPECT_EQ(with_options({{"inertia", "solid"}}, {{"mass", "2"}}).inertia, 1.0);
    EXPECT_EQ(with_options({{"inertia", "3"}}, {{"mass", "2"}}).inertia, 3.0);
    EXPECT_EQ(with_options({{"mixture", "2:0.5"}}, {{"mass", "2"}}).mixture->mass, 0.5);
    EXPECT_EQ(with_options({{"mixture", "2:0.5:3"}}, {{"mass", "2"}}).mixture->mass, 3.0);
    // The mass of spheres scales with their volume, in any order of the parameters.
    EXPECT_EQ(
        with_options({{"mixture", "2:0.5"}, {"body", "sphere"}}, {{"mass", "2"}}).mixture->mass,
        0.25);
    EXPECT_EQ(with_options({{"mixture", "2:0.5"}}, {{"preset", "experiment"}}).mixture->mass,
              0.125);
}

TEST(ReadNumber, AcceptsOnlyNumbers) {
    EXPECT_EQ(read_number("0.5"), 0.5);
    EXPECT_EQ(read_number("1e3"), 1000.0);
    for (const char* text : {"", " 1", "1 ", "1,5", "nan", "inf", "-inf", "0x10", "1e999", "--1"})
        EXPECT_FALSE(read_number(text)) << text;
}

TEST(ReadWholeNumber, AcceptsWholeNumbersInAnyNotation) {
    EXPECT_EQ(read_whole_number("48"), 48);
    EXPECT_EQ(read_whole_number("1e6"), 1'000'000);
    EXPECT_EQ(read_whole_number("-3"), -3);
    EXPECT_EQ(read_whole_number("9007199254740993"),
              9007199254740993);  // 2⁵³ + 1, which is not a double
    for (const char* text : {"", "1.5", "1e30", "x", "1e", "9223372036854775808"})
        EXPECT_FALSE(read_whole_number(text)) << text;
}

}  // namespace
}  // namespace swirl
