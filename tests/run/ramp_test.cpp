// Ramps: one value per period, the state is kept, and results are bitwise identical however the run
// is made.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <cmath>
#include <string>
#include <vector>

#include "engine/same_trajectory.hpp"
#include "swirl/engine/reference.hpp"
#include "swirl/run/config.hpp"
#include "swirl/run/core_run.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/json.hpp"
#include "swirl/run/measurements.hpp"
#include "swirl/run/period_series.hpp"
#include "swirl/run/ramp.hpp"
#include "swirl/run/report.hpp"
#include "swirl/run/run.hpp"

namespace swirl {
namespace {

using ::testing::HasSubstr;

RunConfig with_ramp(const std::string& ramp, ParameterTexts texts = {}) {
    texts.try_emplace("discs", "22");
    texts.try_emplace("periods", "14");
    texts.try_emplace("warmup", "2");
    texts["ramp"] = ramp;
    return resolve(texts);
}

const char* const all_of_discs =
    "mu_disc=0.2:1.5:0.1@2..11; mu_wall=1:0@0..9; amplitude=1.892:2.4:0.9@3..10; "
    "period=11.866071:9@1..12; restitution=1:0.9@4..8; tangential_restitution=0:0.4@4..6";

ParameterTexts spheres() {
    return {{"preset", "experiment"}, {"discs", "24"}, {"periods", "8"}, {"warmup", "2"}};
}
const char* const all_of_spheres =
    "mu=0.2:0.6@2..6; floor_friction=0.3:0.5:0.2@1..7; amplitude=1.9:1.2@2..6";

std::string error_of(const std::string& ramp, ParameterTexts texts = {}) {
    try {
        with_ramp(ramp, std::move(texts));
    } catch (const UsageError& error) {
        return error.what();
    }
    return "";
}

TEST(Ramp, ItHasOneValueInEachPeriodAndItsValuesAtTheEnds) {
    const Ramp ramp = read_ramps("mu=0.1:1:0.3@20..220").front();
    EXPECT_EQ(ramp.value_in(0), 0.1);
    EXPECT_EQ(ramp.value_in(20), 0.1);
    EXPECT_EQ(ramp.value_in(120), 1.0);
    EXPECT_EQ(ramp.value_in(220), 0.3);
    EXPECT_EQ(ramp.value_in(1'000'000), 0.3);
    EXPECT_DOUBLE_EQ(ramp.value_in(70), 0.55);
    EXPECT_DOUBLE_EQ(ramp.value_in(170), 0.65);
}

TEST(Ramp, AConstantRampIsBitwiseThePlainRun) {
    for (const char* ramp : {"mu=1:1@2..9", "amplitude=1.892:1.892@0..14",
                             "period=11.866071:11.866071@1..3", "amplitude=0:0@1..3"}) {
        RunConfig config = with_ramp(ramp);
        const RunResult ramped = run(config);
        config.ramps.clear();
        const RunResult plain = run(config);
        EXPECT_EQ(ramped.state_hash, plain.state_hash) << ramp;
        EXPECT_TRUE(
            same_bits(ramped.rotation.mean_by_event.mean, plain.rotation.mean_by_event.mean) ||
            config.amplitude == 0.0);
    }
}

TEST(Ramp, TheValuesChangeTheTrajectoryFromTheirPeriodOn) {
    // The same until period 5, where the values differ for the first time.
    const RunConfig ramped = with_ramp("mu=1:0.5@4..5", {{"periods", "5"}, {"warmup", "0"}});
    RunConfig plain = ramped;
    plain.ramps.clear();
    EXPECT_EQ(run(ramped).state_hash, run(plain).state_hash);
    RunConfig longer = ramped;
    longer.periods = plain.periods = 6;
    EXPECT_NE(run(longer).state_hash, run(plain).state_hash);
}

/// Executes a run event by event next to the reference implementation.
void expect_reference_agrees(const RunConfig& config, const Tuning& tuning) {
    const InitialState begin = make_initial_state(config);
    CoreRun engine(config, begin, nullptr, {}, tuning);
    Reference reference(begin);
    std::int64_t period = 0;
    for (int k = 0; !engine.complete(); ++k) {
        engine.execute_event();
        engine.pass_event();
        const Event expected = reference.step(), &found = engine.event();
        ASSERT_TRUE(same_bits(expected.clock, found.clock)) << "event " << k;
        ASSERT_EQ(expected.i, found.i) << "event " << k;
        ASSERT_EQ(expected.j, found.j) << "event " << k;
        ASSERT_TRUE(same_bits(expected.impulse.normal, found.impulse.normal)) << "event " << k;
        if (engine.simulation().periods() == period) continue;
        ++period;
        if (changes_in_period(config, period))
            reference.change_surroundings(surroundings_in(config, period));
    }
    for (std::size_t i = 0; i < begin.discs.size(); ++i) {
        expect_same_state(reference.disc(i), engine.simulation().disc(i));
        expect_same_sphere(reference.disc(i), engine.simulation().disc(i));
    }
}

TEST(Ramp, TheReferenceImplementationAgreesForEveryVectorWidth) {
    const RunConfig discs = with_ramp(all_of_discs), balls = with_ramp(all_of_spheres, spheres());
    const RunConfig circle = with_ramp("amplitude=1:2@2..9;mu=0.5:1@1..9", {{"path", "circle"}});
    for (const Width width : {Width::baseline, Width::avx2, Width::avx512}) {
        if (!has_width(width)) continue;
        Tuning tuning;
        tuning.width = width;
        expect_reference_agrees(discs, tuning);
        expect_reference_agrees(circle, tuning);
        expect_reference_agrees(balls, tuning);
    }
    for (const SearchMethod search : {SearchMethod::lists, SearchMethod::cells}) {
        Tuning tuning;
        tuning.search = search;
        expect_reference_agrees(discs, tuning);
    }
}

struct RampedRun {
    std::string result, measured;
    std::vector<double> series;
};

RampedRun observed(const RunConfig& config, int parts) {
    const std::vector<std::string> names{"slip", "centre", "energy", "diffusion"};
    RampedRun observed;
    std::optional<std::string> state;
    for (int part = 1; part <= parts; ++part) {
        Observation observation = observation_of(config, names);
        PeriodSeries series(config, names);
        RunControl control;
        control.observation = &observation;
        control.series = &series;
        control.resume = state;
        swirl::Run run(config, control);
        for (int k = 0; (k < 2'501 || part == parts) && run.next_event(); ++k) run.pass_event();
        state = run.state();
        if (part < parts) continue;
        EXPECT_TRUE(run.complete());
        RunResult result = run.result();
        result.seconds = 1.0;
        observed.result = result_json(result).dump();
        observed.measured = measured_json(observation.report()).dump();
        observed.series = series.values();
    }
    return observed;
}

TEST(Ramp, AResumedRunAndItsSeriesAreBitwiseIdentical) {
    for (const RunConfig& config :
         {with_ramp(all_of_discs), with_ramp(all_of_spheres, spheres())}) {
        const RampedRun whole = observed(config, 1), resumed = observed(config, 6);
        EXPECT_EQ(whole.result, resumed.result);
        EXPECT_EQ(whole.measured, resumed.measured);
        ASSERT_EQ(whole.series.size(), resumed.series.size());
        for (std::size_t k = 0; k < whole.series.size(); ++k)
            EXPECT_TRUE(same_bits(whole.series[k], resumed.series[k]) ||
                        (std::isnan(whole.series[k]) && std::isnan(resumed.series[k])))
                << k;
        // Observing does not alter the trajectory.
        RunResult plain = run(config);
        plain.seconds = 1.0;
        EXPECT_EQ(whole.result, result_json(plain).dump());
    }
}

TEST(Ramp, NoDiscMovesRelativeToTheContainerWhenTheAmplitudeChanges) {
    const RunConfig config = with_ramp("amplitude=0:3:0.2@1..7;period=11:7@1..6", {{"mu", "0.5"}});
    CoreRun run(config, make_initial_state(config));
    while (!run.complete()) {
        run.execute_event();
        const std::int64_t period = run.simulation().periods();
        run.pass_event();
        const Snapshot& s = run.snapshot();
        if (run.event().kind != EventKind::path_vertex || s.clock != 0.0) continue;
        // Without the shift, positions count from the swirl centre of the period before.
        const Vec2 centre = s.container_centre;
        EXPECT_EQ(centre.y, 0.0);
        EXPECT_TRUE(same_bits(centre.x, in_period(config, period).amplitude));
        for (std::size_t i = 0; i < s.size(); ++i) {
            const Vec2 d = s.position(i) - centre;
            EXPECT_LT(std::hypot(d.x, d.y), config.container_radius - 1.0 + 1e-12);
        }
    }
    // Overlaps are of the order of rounding errors, as without a ramp
    // (docs/explanation/physics.md).
    EXPECT_LT(run.result().max_overlap, 1e-12);
}

/// In an elastic gas without friction in a container at rest, the period is only that of the clock.
TEST(Ramp, ARampOfThePeriodConservesTheEnergyInAContainerAtRest) {
    const RunConfig config =
        with_ramp("period=11:5@1..9", {{"amplitude", "0"}, {"mu", "0"}, {"periods", "12"}});
    const RunResult result = run(config);
    // Each collision rounds the velocities of two discs; thousands of collisions.
    EXPECT_NEAR(result.energy, result.energy_at_start, 1e-12 * result.energy_at_start);
}

TEST(Ramp, TimeIsTheSumOfThePeriods) {
    const RunConfig config = with_ramp("period=10:6@1..9", {{"periods", "12"}});
    CoreRun run(config, make_initial_state(config));
    while (!run.complete()) {
        run.execute_event();
        run.pass_event();
    }
    double sum = 0.0;
    for (int period = 0; period < 12; ++period) sum += config.ramps.front().value_in(period);
    EXPECT_DOUBLE_EQ(run.snapshot().time(), sum);
}

TEST(Ramp, ItSetsTheLengthOfARunWithoutOne) {
    EXPECT_EQ(resolve({{"ramp", "mu=0.1:1@20..220"}}).periods, 221);
    EXPECT_FALSE(resolve({{"ramp", "mu=0.1:1@20..220"}, {"events", "1000"}}).periods.has_value());
}

TEST(Ramp, ItSurvivesTheJsonAndReplacesTheValuesOfAFile) {
    const RunConfig config = with_ramp(all_of_discs);
    EXPECT_EQ(resolve(parameters_in(config_text(config))).ramps, config.ramps);
    EXPECT_EQ(config_text(resolve(parameters_in(config_text(config)))), config_text(config));
    EXPECT_EQ(resolve(texts_of(config)).ramps, config.ramps);
    const ParameterTexts merged = overridden({{"mu", "0.5"}, {"discs", "20"}, {"speed", "2"}},
                                             {{"ramp", "mu=0.1:1@2..9; amplitude=1:2@2..9"}});
    const RunConfig from_file = resolve(merged);
    EXPECT_EQ(from_file.discs, 20);
    EXPECT_EQ(from_file.mu_wall, 0.1);
    EXPECT_EQ(from_file.amplitude, 1.0);
}

TEST(Ramp, WrongRampsAreRejectedWithAHint) {
    for (const auto& [ramp, part] : std::vector<std::pair<std::string, std::string>>{
             {"mu", "it has no '='"},
             {"mu=0.1:1", "it has no '@'"},
             {"mu=1@2..9", "it has only one value"},
             {"mu=nan:1@2..9", "'nan' is not a finite number"},
             {"mu=inf:1@2..9", "'inf' is not a finite number"},
             {"mu=0.1:@2..9", "'' is not a finite number"},
             {"mu=0.1:1@9..2", "period 2 is not after period 9"},
             {"mu=0.1:1@9..9", "period 9 is not after period 9"},
             {"mu=0.1:1@-1..9", "is not a pair of periods"},
             {"mu=0.1:1@2.5..9", "is not a pair of periods"},
             {"mu=0.1:1@2-9", "its periods lack '..'"},
             {"mu=0:1:0:1@2..4", "2 periods are too few for 4 values"},
             {"inertia=1:2@2..9", "it is a property of the particles"},
             {"container_radius=9:10@2..9", "cannot change during a run"},
             {"amplitud=1:2@2..9", "did you mean 'amplitude'?"},
             {"mu=0.1:1@2..9;mu_wall=0:1@2..9", "two ramps change the same parameter"},
             {"mu=0.1:-1@2..9", "in period 9"},
             {"restitution=1:1.5@2..9", "in period 9"},
             {"floor_friction=0.3:0.5@2..9", "there is no floor"},
             {"", "a part of it is empty"}}) {
        EXPECT_THAT(error_of(ramp), HasSubstr(part)) << ramp;
        EXPECT_THAT(error_of(ramp), HasSubstr("--ramp")) << ramp;
    }
    EXPECT_THAT(error_of("mu=0.1:1@2..9", {{"mu", "1"}}), HasSubstr("its ramp starts at 0.1"));
    EXPECT_THAT(error_of("mu=0.1:1@2..9", {{"mu_wall", "1"}}), HasSubstr("omit --mu-wall"));
    EXPECT_THAT(error_of("amplitude=1:2@2..9", {{"speed", "1"}}), HasSubstr("hint: give"));
    EXPECT_EQ(error_of("mu=0.1:1@2..9", {{"mu", "0.1"}}), "");
}

TEST(Ramp, TheReportSaysThatTheAveragesMixItsValues) {
    const RunResult result = run(with_ramp("mu=0.1:1@2..9", {{"periods", "6"}}));
    EXPECT_THAT(headline(result), HasSubstr("in a ramp, mu=0.1:1@2..9"));
    ASSERT_FALSE(warnings(result).empty());
    EXPECT_THAT(warnings(result).front(), HasSubstr("which begins after"));
}

}  // namespace
}  // namespace swirl
