#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <cmath>
#include <ctime>
#include <map>
#include <sstream>

#include "io/scratch.hpp"
#include "measure/snapshots.hpp"
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

/// Discs that lie flat on a floor that lets them slide.
RunConfig coins(const char* discs, const char* periods = "12") {
    return resolve({{"preset", "experiment"},
                    {"body", "disc"},
                    {"inertia", "solid"},
                    {"floor_friction", "0.03"},
                    {"discs", discs},
                    {"periods", periods}});
}

TEST(RunOfSpheres, CoinsThatTheFloorHoldsNeverMeet) {
    // From μ_f g = A Ω² on, the greatest acceleration of the dish; with 30 corners a little slip
    // is left at each.
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

TEST(RunOfSpheres, ResumedItEndsWithTheSameResult) {
    const RunConfig config = experiment("20");
    const RunResult whole = run(config);
    swirl::Run first(config);
    for (int k = 0; k < 3000 && first.next_event(); ++k) first.pass_event();
    RunControl control;
    control.resume = first.state();
    const RunResult resumed = run(config, control);
    EXPECT_EQ(whole.state_hash, resumed.state_hash);
    EXPECT_EQ(whole.rotation.by_event.mean, resumed.rotation.by_event.mean);
    EXPECT_EQ(whole.rotation.by_time.mean, resumed.rotation.by_time.mean);
    EXPECT_GT(whole.events.begins_to_roll, 0u);
    EXPECT_LT(whole.max_overlap, 1e-12);
}

TEST(RunOfSpheres, SlowInTenMillionEventsNoTwoOverlapByMoreThanRounding) {
    const RunResult done = run(
        resolve({{"preset", "experiment"}, {"discs", "48"}, {"events", "1e7"}, {"warmup", "0"}}));
    EXPECT_EQ(done.events.total(), 10'000'000u);
    EXPECT_LT(done.max_overlap, 1e-12);
}

// Without a contact duration a sphere that the floor drives along the wall hops on it ever lower,
// until it is never apart from it by more than a rounding error. From then on each hop falls by a
// grain, 2⁻⁵² σ² in what the square of its distance from C leaves of σ² (quartic.hpp), which is
// 2⁻⁵³ σ in the distance, σ = R − r. Twice that leaves room for the rounding of places.
TEST(RunOfSpheres, WithoutAContactDurationOneSinksIntoTheWallByAGrainPerHopAtMost) {
    for (const char* restitution : {"0.9", "0.5", "0"}) {
        const RunConfig config = resolve({{"preset", "experiment"},
                                          {"discs", "8"},
                                          {"contact_duration", "0"},
                                          {"restitution", restitution}});
        Simulation simulation(make_initial_state(config));
        const double grain = 0x1p-53 * (config.container_radius - config.radius);
        std::vector<double> hops(8, 0.0);
        double deepest = 0.0;
        for (int k = 0; k < 300'000; ++k) {
            const Event event = simulation.step();
            if (event.kind != EventKind::disc_wall) continue;
            hops[event.i] += 1.0;
            deepest = std::fmax(deepest, event.overlap);
            // 10⁻¹⁴: of a first contact.
            ASSERT_LT(event.overlap, 2.0 * grain * hops[event.i] + 1e-14) << restitution;
        }
        EXPECT_GT(deepest, 1e-12) << restitution;  // it was met
    }
}

// The average by time, once more: from the engine, one sphere after the other.
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
    EXPECT_NEAR(run(config).rotation.by_time.mean, sum / (4 * 64) / config.omega(), 1e-9);
}

/// What the budget takes for the loss on the floor, from energies and momenta, is the friction of
/// the floor times the way slid: on a parabola |c| falls linearly.
void expect_the_floor_takes_what_sliding_costs(const RunConfig& config) {
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
                    const Vec2 way = to.position(i) - from.position(i) -
                                     (to.clock - from.clock) * from.container_velocity;
                    heat += config.rolling_resistance * config.gravity * config.mass *
                            std::sqrt(dot(way, way));
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
    // 20,000 events, each to the rounding of energies of order 10.
    EXPECT_NEAR(row_of(budget, "floor_friction_power").mean, heat, 1e-9 * heat);
    EXPECT_GT(heat, 1.0);
}
TEST(RunOfSpheres, TheFloorTakesWhatSlidingOnItCosts) {
    expect_the_floor_takes_what_sliding_costs(experiment("20"));
    expect_the_floor_takes_what_sliding_costs(coins("20"));
    RunConfig resisting = experiment("20");
    resisting.rolling_resistance = 0.05;
    expect_the_floor_takes_what_sliding_costs(resisting);
}

// In a steady state what comes in goes out.
TEST(RunOfSpheres, TheEnergyThatWallAndFloorPutInIsLostInContactsAndOnTheFloor) {
    const RunConfig config =
        resolve({{"preset", "experiment"}, {"discs", "20"}, {"periods", "60"}, {"warmup", "20"}});
    const MeasuredRun measured = measured_run(config, {"energy"}, {});
    const auto of = [&](const char* name) {
        for (const MeasuredNumber& number : measured_numbers(measured.measured))
            if (number.name == std::string("energy.") + name) return number.estimate.mean;
        return not_available;
    };
    const double in = of("wall_power") + of("floor_power");
    const double out = of("disc_friction_power") + of("wall_friction_power") +
                       of("inelastic_power") + of("floor_friction_power");
    // The energy at the end of 40 swirls is that at their beginning up to what there is of it.
    EXPECT_NEAR(in, out, 20.0 / (40.0 * config.period));
    EXPECT_GT(of("floor_friction_power"), 0.0);
}

/// What is recorded is what was there, to the last bit: three spins and how they are turned.
void expect_recorded_bit_for_bit(const RunConfig& config) {
    const Scratch scratch;
    RunFiles files;
    files.trajectory = scratch / "spheres.h5";
    files.frames.per_swirl = 20;
    EXPECT_EQ(run_recorded(config, files, {}, {}).state_hash, run(config).state_hash);
    TrajectoryReader reader(files.trajectory);
    RunControl control;
    control.orientations = true;
    swirl::Run again(config, control);
    SampleTimes times = again.sample_times(20);
    std::uint64_t k = 0;
    while (again.next_event()) {
        while (again.next_sample(times)) {
            const Snapshot &seen = again.snapshot(), read = reader.frame(k++);
            EXPECT_TRUE(read.on_floor);
            EXPECT_EQ(read.lie_flat, config.body == Shape::disc);
            EXPECT_EQ(read.x, seen.x);
            EXPECT_EQ(read.vy, seen.vy);
            EXPECT_EQ(read.spin, seen.spin);
            EXPECT_EQ(read.spin_x, seen.spin_x);
            EXPECT_EQ(read.spin_y, seen.spin_y);
            ASSERT_EQ(read.turned.size(), seen.turned.size());
            for (std::size_t i = 0; i < seen.size(); ++i) {
                EXPECT_EQ(read.turned[i].w, seen.turned[i].w);
                EXPECT_EQ(read.turned[i].z, seen.turned[i].z);
            }
        }
        again.pass_event();
    }
    EXPECT_EQ(reader.frames(), k);
    EXPECT_GT(k, 55u);
}
TEST(RunOfSpheres, ATrajectoryHoldsTheirSpinsAndOrientations) {
    expect_recorded_bit_for_bit(experiment("9", "3"));
}
TEST(RunOfSpheres, ATrajectoryOfCoinsSaysThatTheyLieFlat) {
    expect_recorded_bit_for_bit(coins("9", "3"));
}

// A frame has the spins and the floor's velocity to the last bit, so who rolls is known of it.
TEST(RunOfSpheres, FramesTellOfRollingWhatTheRunDidButForItsCollisions) {
    const Scratch scratch;
    RunConfig config = experiment("36", "5");
    config.warmup = 0;
    RunFiles files;
    files.trajectory = scratch / "spheres.h5";
    files.frames.per_swirl = samples_per_period;
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

TEST(RunOfSpheres, ResumedTheyAreTurnedTheSameWay) {
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

// Few rotate with the swirl and many against it, as in the experiment. Of few by the rigid
// estimator: one of eight spheres is often near their centre of mass (cluster_rotation.hpp).
TEST(RunOfSpheres, FewRotateAndManyCounterrotate) {
    const Estimate few = run(experiment("8", "120")).rotation.rigid_by_time;
    const Estimate many = run(experiment("48", "30")).rotation.by_time;
    EXPECT_GT(few.mean, 6.0 * few.error);
    EXPECT_LT(many.mean, -6.0 * many.error);
}

/// A number of the table at both ends of its range, a word each of the words. What says how long a
/// run is, and of how many, is no matter.
std::vector<ParameterTexts> extremes_of_every_parameter() {
    std::vector<ParameterTexts> all;
    for (const Parameter& p : run_parameters) {
        const std::string name = p.name, form = p.form;
        if (p.group == parameter_group::run || name == "discs" || !p.can_be_given()) continue;
        if (p.lowest < p.highest && name != "mixture")
            for (const double end : {p.lowest, p.highest})
                all.push_back({{name, fmt::format("{}", end)}});
        std::istringstream words(form);
        for (std::string word; std::getline(words, word, '|');)
            if (word.find_first_not_of("abcdefghijklmnopqrstuvwxyz") == word.npos)
                all.push_back({{name, word}});
    }
    return all;
}

enum class Fate { ran, rejected, collapsed, hung };

/// Hung is what takes more than a minute of processor time for a million events; the slowest of
/// these, coins on a swirl of 10⁶ radii, took eight seconds.
Fate fate_of(ParameterTexts texts, std::int64_t events) {
    texts["events"] = std::to_string(events);
    texts["warmup"] = "0";
    const double enough = 5.0 + 60e-6 * double(events);
    const std::clock_t began = std::clock();
    try {
        swirl::Run run(resolve(texts));
        for (int k = 1; run.next_event(); ++k) {
            run.pass_event();
            if (k % 1000 == 0 && double(std::clock() - began) > enough * CLOCKS_PER_SEC)
                return Fate::hung;
        }
        EXPECT_TRUE(run.complete());
        // Positions are of the order of the amplitude, 10⁶ at most, and have its rounding errors.
        EXPECT_LT(run.result().max_overlap, 1e-9);
        return Fate::ran;
    } catch (const UsageError&) {
        return Fate::rejected;
    } catch (const Failure& failure) {
        EXPECT_THAT(failure.what(), testing::HasSubstr("time all but stands still"));
        return Fate::collapsed;
    }
}

/// Each alone, then together: as little and as much friction of contacts and floor as there may be,
/// no bounce and the whole, for spheres and for coins, few, many and of two sizes. 150 times g is
/// just below what the contact duration allows.
void expect_extremes_do_not_hang(std::int64_t events) {
    std::map<Fate, int> fates;
    const auto expect_no_hang = [&](ParameterTexts texts, const ParameterTexts& changes) {
        for (const auto& [name, text] : changes) texts.insert_or_assign(name, text);
        std::string told;
        for (const auto& [name, text] : texts) told += fmt::format("{} {} ", name, text);
        SCOPED_TRACE(told);
        ++fates[fate_of(texts, events)];
        EXPECT_EQ(fates[Fate::hung], 0);
    };
    const ParameterTexts spheres{{"preset", "experiment"}, {"discs", "36"}};
    ParameterTexts coins = spheres;
    coins["body"] = "disc";
    coins["inertia"] = "solid";
    for (const ParameterTexts& texts : extremes_of_every_parameter()) {
        expect_no_hang(spheres, texts);
        expect_no_hang(coins, texts);
    }
    for (const char* floor : {"1e-6", "150"})
        for (const char* mu : {"0", "1e6"})
            for (const char* restitution : {"0", "1"})
                for (const char* contact_duration : {"0", "1e-3"})
                    for (const ParameterTexts& body : {spheres, coins})
                        for (const char* discs : {"2", "50"})
                            expect_no_hang(body, {{"floor_friction", floor},
                                                  {"mu", mu},
                                                  {"restitution", restitution},
                                                  {"contact_duration", contact_duration},
                                                  {"discs", discs}});
    for (const char* mixture : {"18:0.01", "18:0.5:1e6", "18:0.5:1e-6"})
        expect_no_hang(spheres, {{"mixture", mixture}});
    // The refused are ends of ranges that nothing else was fitted to.
    EXPECT_GT(fates[Fate::ran], 100);
}
TEST(RunOfSpheres, ExtremesOfEveryParameterDoNotHang) { expect_extremes_do_not_hang(5000); }
TEST(RunOfSpheres, SlowExtremesOfEveryParameterDoNotHangInAMillionEvents) {
    expect_extremes_do_not_hang(1'000'000);
}

}  // namespace
}  // namespace swirl
