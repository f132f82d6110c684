#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <sstream>

#include "io/scratch.hpp"
#include "measure/snapshots.hpp"
#include "run/measured_run.hpp"
#include "swirl/io/trajectory.hpp"
#include "swirl/measure/energy_budget.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/json.hpp"
#include "swirl/run/measured_series.hpp"
#include "swirl/run/measurements.hpp"
#include "swirl/run/recorded_run.hpp"

namespace swirl {
namespace {

RunConfig experiment(const char* discs, const char* periods = "12") {
    return resolve({{"preset", "experiment"}, {"discs", discs}, {"periods", periods}});
}

/// Discs that slide on a floor with little friction.
RunConfig coins(const char* discs, const char* periods = "12") {
    return resolve({{"preset", "experiment"},
                    {"body", "disc"},
                    {"inertia", "solid"},
                    {"floor_friction", "0.03"},
                    {"discs", discs},
                    {"periods", periods}});
}

TEST(RunOfSpheres, CoinsHeldByTheFloorNeverCollide) {
    // The floor holds coins if μ_f g exceeds the largest acceleration of the container, A Ω². On 30
    // sides a little slip remains at each vertex.
    const RunConfig config = resolve({{"preset", "experiment"},
                                      {"body", "disc"},
                                      {"inertia", "solid"},
                                      {"discs", "30"},
                                      {"periods", "20"}});
    ASSERT_GT(config.floor_friction * config.gravity,
              config.amplitude * config.omega() * config.omega());
    EXPECT_EQ(run(config).events.disc_disc, 0u);
    EXPECT_GT(run(coins("30")).events.disc_disc, 0u);
}

TEST(RunOfSpheres, AResumedRunEndsWithTheSameResult) {
    const RunConfig config = experiment("20");
    const RunResult whole = run(config);
    swirl::Run first(config);
    for (int k = 0; k < 3000 && first.next_event(); ++k) first.pass_event();
    RunControl control;
    control.resume = first.state();
    const RunResult resumed = run(config, control);
    EXPECT_EQ(whole.state_hash, resumed.state_hash);
    EXPECT_EQ(whole.rotation.mean_by_event.mean, resumed.rotation.mean_by_event.mean);
    EXPECT_EQ(whole.rotation.mean_by_time.mean, resumed.rotation.mean_by_time.mean);
    EXPECT_GT(whole.events.begins_to_roll, 0u);
    EXPECT_LT(whole.max_overlap, 1e-12);
}

TEST(RunOfSpheres, Slow_InTenMillionEventsNoTwoOverlapByMoreThanRounding) {
    const RunResult done = run(
        resolve({{"preset", "experiment"}, {"discs", "48"}, {"events", "1e7"}, {"warmup", "0"}}));
    EXPECT_EQ(done.events.total(), 10'000'000u);
    EXPECT_LT(done.max_overlap, 1e-12);
}

// Without a contact duration, a sphere that the floor drives along the wall bounces ever lower
// until its distance from the wall is a rounding error. From then on each bounce sinks by at most
// one unit of rounding: 2⁻⁵² σ² in the difference of σ² and the squared distance from C
// (quartic.hpp), or
// 2⁻⁵³ σ in the distance, with σ = R − r. The factor 2 allows for the rounding of positions.
TEST(RunOfSpheres, WithoutContactDurationSinkingPerBounceIsARoundingError) {
    for (const char* restitution : {"0.9", "0.5", "0"}) {
        const RunConfig config = resolve({{"preset", "experiment-half"},
                                          {"mu", "0.2"},
                                          {"floor_friction", "0.3"},
                                          {"discs", "8"},
                                          {"contact_duration", "0"},
                                          {"restitution", restitution}});
        Simulation simulation(make_initial_state(config));
        const double rounding = 0x1p-53 * (config.container_radius - config.radius);
        std::vector<double> bounces(8, 0.0);
        double largest = 0.0;
        for (int k = 0; k < 300'000; ++k) {
            const Event event = simulation.step();
            if (event.kind != EventKind::disc_wall) continue;
            bounces[event.i] += 1.0;
            largest = std::fmax(largest, event.overlap);
            // 10⁻¹⁴: overlap of a first contact
            ASSERT_LT(event.overlap, 2.0 * rounding * bounces[event.i] + 1e-14) << restitution;
        }
        EXPECT_GT(largest, 1e-12) << restitution;  // the effect occurs
    }
}

// Computes the average by time independently, from the states of the engine.
TEST(RunOfSpheres, RotationIsThatOfTheExactStatesAtTheExactTimes) {
    const RunConfig config =
        resolve({{"preset", "experiment"}, {"discs", "12"}, {"periods", "6"}, {"warmup", "2"}});
    Simulation simulation(make_initial_state(config));
    double sum = 0.0;
    for (int p = 2; p < 6; ++p)
        for (int k = 0; k < 64; ++k) {
            simulation.advance_to(p, config.period * k / 64.0);
            const Snapshot s = simulation.snapshot();
            Vec2 r{0, 0}, v{0, 0};
            const double each = 1.0 / static_cast<double>(s.size());
            for (std::size_t i = 0; i < s.size(); ++i) {
                r = r + each * s.position(i);
                v = v + each * s.velocity(i);
            }
            for (std::size_t i = 0; i < s.size(); ++i) {
                const Vec2 from = s.position(i) - r;
                sum += each * cross(from, s.velocity(i) - v) / dot(from, from);
            }
        }
    EXPECT_NEAR(run(config).rotation.mean_by_time.mean, sum / (4 * 64) / config.omega(), 1e-9);
}

/// The budget computes the loss on the floor from energies and momenta. It must equal the friction
/// of the floor times the sliding distance; on a parabola |c| decreases linearly.
void expect_floor_loss_equals_sliding_work(const RunConfig& config) {
    Simulation simulation(make_initial_state(config));
    Snapshot s = simulation.snapshot();
    EnergyBudget budget;
    double heat = 0.0;
    for (int k = 0; k < 20'000; ++k) {
        const Snapshot from = s.up_to_date();
        const Event event = simulation.step();
        s.clock = event.clock;
        const Snapshot to = s.up_to_date();
        if (k > 0)
            for (std::size_t i = 0; i < s.size(); ++i) {
                if (s.ax[i] == 0.0 && s.ay[i] == 0.0) continue;
                if (s.rolls(i)) {
                    const Vec2 distance = to.position(i) - from.position(i) -
                                          (to.clock - from.clock) * from.container_velocity;
                    heat += config.rolling_resistance * config.gravity * config.mass *
                            std::sqrt(dot(distance, distance));
                    continue;
                }
                const Vec2 a = slip_on_floor(from.disc(i), from.container_velocity),
                           b = slip_on_floor(to.disc(i), from.container_velocity);
                heat += config.floor_friction * config.gravity * config.mass *
                        (to.clock - from.clock) * 0.5 *
                        (std::sqrt(dot(a, a)) + std::sqrt(dot(b, b)));
            }
        simulation.refresh(s, event);
        budget.sample_event(event, s.up_to_date());
    }
    budget.close_event_block(1.0);
    // The tolerance allows 20,000 events with one rounding each of energies of order 10.
    EXPECT_NEAR(row_of(budget, "floor_friction_power").mean, heat, 1e-9 * heat);
    EXPECT_GT(heat, 1.0);
}
TEST(RunOfSpheres, TheFloorDissipatesTheWorkOfSliding) {
    expect_floor_loss_equals_sliding_work(experiment("20"));
    expect_floor_loss_equals_sliding_work(coins("20"));
    RunConfig resisting = experiment("20");
    resisting.rolling_resistance = 0.05;
    expect_floor_loss_equals_sliding_work(resisting);
}

TEST(RunOfSpheres, EnergyInputEqualsDissipation) {
    const RunConfig config =
        resolve({{"preset", "experiment"}, {"discs", "20"}, {"periods", "60"}, {"warmup", "20"}});
    const MeasuredRun measured = measured_run(config, {"energy"});
    const auto power = [&](const char* name) {
        for (const MeasuredNumber& number : measured_numbers(measured.measured))
            if (number.name == std::string("energy.") + name) return number.estimate.mean;
        return not_available;
    };
    const double input = power("wall_power") + power("floor_power");
    const double output = power("disc_friction_power") + power("wall_friction_power") +
                          power("inelastic_power") + power("floor_friction_power");
    // Over 40 periods, the energy changes by at most its value, about 20.
    EXPECT_NEAR(input, output, 20.0 / (40.0 * config.period));
    EXPECT_GT(power("floor_friction_power"), 0.0);
}

/// Recorded frames are bitwise identical to the states of the run, including spins and
/// orientations.
void expect_bitwise_identical_recording(const RunConfig& config) {
    const Scratch scratch;
    RunFiles files;
    files.trajectory = scratch / "spheres.h5";
    files.frames.per_period = 20;
    EXPECT_EQ(run_recorded(config, files, {}, {}).state_hash, run(config).state_hash);
    TrajectoryReader reader(files.trajectory);
    RunControl control;
    control.orientations = true;
    swirl::Run repeated(config, control);
    SampleTimes times = repeated.sample_times(20);
    std::uint64_t k = 0;
    while (repeated.next_event()) {
        while (repeated.next_sample(times)) {
            const Snapshot &expected = repeated.snapshot(), read = reader.frame(k++);
            EXPECT_TRUE(read.on_floor);
            EXPECT_EQ(read.lie_flat, config.body == Shape::disc);
            EXPECT_EQ(read.x, expected.x);
            EXPECT_EQ(read.vy, expected.vy);
            EXPECT_EQ(read.spin, expected.spin);
            EXPECT_EQ(read.spin_x, expected.spin_x);
            EXPECT_EQ(read.spin_y, expected.spin_y);
            ASSERT_EQ(read.turned.size(), expected.turned.size());
            for (std::size_t i = 0; i < expected.size(); ++i) {
                EXPECT_EQ(read.turned[i].w, expected.turned[i].w);
                EXPECT_EQ(read.turned[i].z, expected.turned[i].z);
            }
        }
        repeated.pass_event();
    }
    EXPECT_EQ(reader.frames(), k);
    EXPECT_GT(k, 55u);
}
TEST(RunOfSpheres, TrajectoriesStoreSpinsAndOrientations) {
    expect_bitwise_identical_recording(experiment("9", "3"));
}
TEST(RunOfSpheres, TrajectoriesOfCoinsMarkThemAsFlat) {
    expect_bitwise_identical_recording(coins("9", "3"));
}

// Frames store spins and the floor velocity exactly, so they determine which spheres roll.
TEST(RunOfSpheres, RollingFromFramesAgreesWithTheRun) {
    const Scratch scratch;
    RunConfig config = experiment("36", "5");
    config.warmup = 0;
    RunFiles files;
    files.trajectory = scratch / "spheres.h5";
    files.frames.per_period = samples_per_period;
    run_recorded(config, files, {}, {});
    const SnapshotSeries series = series_of(std::make_shared<TrajectoryReader>(files.trajectory));
    ASSERT_THAT(measurable({"rolling"}, true), testing::ElementsAre("rolling"));
    const auto rows = [](const nlohmann::ordered_json& measured) {
        std::map<std::string, Estimate> found;
        for (const MeasuredNumber& number : measured_numbers(measured))
            found[number.name] = number.estimate;
        return found;
    };
    auto in_run = rows(measured_run(config, {"rolling"}).measured),
         in_frames = rows(measured_json(measure_series(series, {"rolling"}).reports));
    for (const char* name : {"rolling_share", "wall_rolling_share", "floor_slip",
                             "axis_correlation", "contact_correlation"}) {
        const std::string row = std::string("rolling.") + name;
        EXPECT_EQ(in_run.at(row).mean, in_frames.at(row).mean) << row;
        EXPECT_EQ(in_run.at(row).error, in_frames.at(row).error) << row;
        EXPECT_NE(in_run.at(row).mean, 0.0) << row;
    }
    for (const char* name : {"rolling.vertical_share", "rolling.vertical_power_at_wall"}) {
        EXPECT_TRUE(std::isnan(in_frames.at(name).mean)) << name;
        EXPECT_GT(in_run.at(name).mean, 0.0) << name;
    }
}

TEST(RunOfSpheres, AResumedRunHasTheSameOrientations) {
    const RunConfig config = experiment("20", "4");
    RunControl control;
    control.orientations = true;
    swirl::Run whole(config, control), first(config, control);
    while (whole.next_event()) whole.pass_event();
    for (int k = 0; k < 2000 && first.next_event(); ++k) first.pass_event();
    control.resume = first.state();
    swirl::Run resumed(config, control);
    while (resumed.next_event()) resumed.pass_event();
    const Snapshot a = whole.snapshot(), b = resumed.snapshot();
    double moved = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        EXPECT_EQ(a.turned[i].w, b.turned[i].w);
        EXPECT_EQ(a.turned[i].x, b.turned[i].x);
        moved += std::abs(a.turned[i].x);
    }
    EXPECT_GT(moved, 1.0);
}

// As in the experiment. Few spheres use the rigid rate, because one of eight is often near their
// centre of mass (cluster_rotation.hpp).
TEST(RunOfSpheres, FewRotateAndManyCounterrotate) {
    const Estimate few = run(experiment("8", "120")).rotation.rigid_by_time;
    const Estimate many = run(experiment("48", "30")).rotation.mean_by_time;
    EXPECT_GT(few.mean, 6.0 * few.error);
    EXPECT_LT(many.mean, -6.0 * many.error);
}

/// Both ends of the range of every number, and each of the words of a parameter. Excludes the
/// length of the run and the number of discs.
std::vector<ParameterTexts> extremes_of_every_parameter() {
    std::vector<ParameterTexts> all;
    for (const Parameter& p : run_parameters) {
        const std::string name = p.name, form = p.form;
        if (p.group == parameter_group::run || name == "discs" || !p.is_settable()) continue;
        if (p.range.lowest < p.range.highest && name != "mixture")
            for (const double end : {p.range.lowest, p.range.highest})
                all.push_back({{name, fmt::format("{}", end)}});
        std::istringstream words(form);
        for (std::string word; std::getline(words, word, '|');)
            if (word.find_first_not_of("abcdefghijklmnopqrstuvwxyz") == word.npos)
                all.push_back({{name, word}});
    }
    return all;
}

enum class Outcome { ran, rejected, collapsed };

Outcome outcome_of(ParameterTexts texts, std::int64_t events) {
    texts["events"] = std::to_string(events);
    texts["warmup"] = "0";
    try {
        swirl::Run run(resolve(texts));
        while (run.next_event()) run.pass_event();
        EXPECT_TRUE(run.complete());
        // Positions are of the order of the amplitude, 10⁶ at most, and have its rounding errors.
        EXPECT_LT(run.result().max_overlap, 1e-9);
        return Outcome::ran;
    } catch (const UsageError&) {
        return Outcome::rejected;
    } catch (const Failure& failure) {
        EXPECT_THAT(failure.what(), testing::HasSubstr("collapse after"));
        return Outcome::collapsed;
    }
}

/// Every extreme value alone, then combinations of the smallest and largest friction of contacts
/// and floor, with restitution 0 and 1, for spheres and coins, few and many, and for mixtures. A
/// floor friction of 150 is just below the limit of the contact duration. A hang exceeds the time
/// limit of ctest.
void expect_extremes_end(std::int64_t events) {
    std::map<Outcome, int> outcomes;
    const auto expect_end = [&](ParameterTexts texts, const ParameterTexts& changes) {
        for (const auto& [name, text] : changes) texts.insert_or_assign(name, text);
        std::string call;
        for (const auto& [name, text] : texts) call += fmt::format("{} {} ", name, text);
        SCOPED_TRACE(call);
        ++outcomes[outcome_of(texts, events)];
    };
    const ParameterTexts spheres{{"preset", "experiment"}, {"discs", "36"}};
    ParameterTexts coins = spheres;
    coins["body"] = "disc";
    coins["inertia"] = "solid";
    for (const ParameterTexts& texts : extremes_of_every_parameter()) {
        expect_end(spheres, texts);
        expect_end(coins, texts);
    }
    for (const char* floor : {"1e-6", "150"})
        for (const char* mu : {"0", "1e6"})
            for (const char* restitution : {"0", "1"})
                for (const char* contact_duration : {"0", "1e-3"})
                    for (const ParameterTexts& body : {spheres, coins})
                        for (const char* discs : {"2", "50"})
                            expect_end(body, {{"floor_friction", floor},
                                              {"mu", mu},
                                              {"restitution", restitution},
                                              {"contact_duration", contact_duration},
                                              {"discs", discs}});
    for (const char* mixture : {"18:0.01", "18:0.5:1e6", "18:0.5:1e-6"})
        expect_end(spheres, {{"mixture", mixture}});
    // Rejected are ends of ranges that contradict the other parameters.
    EXPECT_GT(outcomes[Outcome::ran], 100);
}
TEST(RunOfSpheres, RunsWithExtremeParametersEnd) { expect_extremes_end(5000); }
// Fifty times as long as by default. A million events took 190 s and found nothing more.
TEST(RunOfSpheres, Slow_LongRunsWithExtremeParametersEnd) { expect_extremes_end(250'000); }

}  // namespace
}  // namespace swirl
