// A run that is interrupted, saved and resumed ends with the result of an uninterrupted run.
#include <gtest/gtest.h>

#include <atomic>
#include <cstring>

#include "io/scratch.hpp"
#include "run/measured_run.hpp"
#include "swirl/io/file_error.hpp"
#include "swirl/io/state_archive.hpp"
#include "swirl/run/core_run.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/json.hpp"
#include "swirl/run/measurements.hpp"
#include "swirl/run/period_series.hpp"
#include "swirl/run/recorded_run.hpp"
#include "swirl/run/run.hpp"

namespace swirl {
namespace {

RunConfig short_run() {
    RunConfig config;
    config.discs = 24;
    config.events = 30'000;
    config.warmup = 3;
    config.seed = 5;
    return config;
}

std::string result_without_time(RunResult result) {
    result.seconds = 1.0;
    return result_json(result).dump();
}

void expect_same_bits(const std::vector<double>& a, const std::vector<double>& b) {
    ASSERT_EQ(a.size(), b.size());
    EXPECT_EQ(std::memcmp(a.data(), b.data(), a.size() * sizeof(double)), 0);
}

struct Sample {
    double time, x;
    bool operator==(const Sample&) const = default;
};

/// Executes at most `count` events, and samples seven times per period.
void advance(swirl::Run& run, std::uint64_t count, SampleTimes& times,
             std::vector<Sample>& samples) {
    for (; count > 0 && run.next_event(); --count) {
        while (run.next_sample(times))
            samples.push_back({run.snapshot().time(), run.snapshot().position(3).x});
        run.pass_event();
    }
}

void expect_interruptions_do_not_change(const RunConfig& config) {
    std::vector<Sample> whole_samples;
    swirl::Run whole(config);
    SampleTimes whole_times = whole.sample_times(7);
    advance(whole, 1'000'000, whole_times, whole_samples);
    ASSERT_TRUE(whole.complete());

    // Interrupted repeatedly, and resumed from the saved state each time.
    std::vector<Sample> samples;
    RunControl control;
    SampleTimes times = whole.sample_times(7);
    for (int part = 0; part < 17; ++part) {
        swirl::Run run(config, control);
        advance(run, 1'700, times, samples);
        ASSERT_FALSE(run.complete());
        control.resume = run.state();
        // The owner of sample times saves them.
        StateWriter saved;
        times.fields(saved);
        times = whole.sample_times(7);
        StateReader read(saved.bytes());
        times.fields(read);
    }
    swirl::Run last(config, control);
    advance(last, 1'000'000, times, samples);
    ASSERT_TRUE(last.complete());
    EXPECT_EQ(result_without_time(last.result()), result_without_time(whole.result()));
    EXPECT_EQ(samples, whole_samples);
}

TEST(Resume, AnInterruptedRunEndsWithTheSameResult) {
    expect_interruptions_do_not_change(short_run());
}

// The interruption is between two samples of the average by event, because 1700 is not a multiple
// of 38.
TEST(Resume, AnInterruptedRunOfALargeContainerEndsWithTheSameResult) {
    RunConfig config = short_run();
    config.discs = 150;
    config.container_radius = 15.5;
    config.warmup = 1;
    ASSERT_EQ(events_per_rotation_sample(150), 38u);
    expect_interruptions_do_not_change(config);
}

/// Scenes with many and with few events per sample, with each search and each kind of particle.
std::vector<RunConfig> scenes_for_spans() {
    std::vector<RunConfig> scenes(8, short_run());
    for (RunConfig& config : scenes) {
        config.discs = 48;
        config.warmup = 1;
    }
    scenes[0].discs = 24;
    scenes[1].warmup_found = true;
    scenes[1].warmup.reset();
    scenes[2] =
        resolve({{"mixture", "20:0.7"}, {"path", "circle"}, {"events", "30000"}, {"warmup", "1"}});
    scenes[3] = resolve(
        {{"preset", "experiment"}, {"body", "sphere"}, {"events", "30000"}, {"warmup", "1"}});
    scenes[4].discs = 200;
    scenes[4].container_radius = 18.0;
    scenes[4].warmup = 1;
    scenes[5].events_per_sample = 7;
    scenes[5].periods = 9;
    // A parameter changes at the start of a period. With a shorter period, sample times change.
    scenes[6] =
        resolve({{"discs", "48"},
                 {"periods", "9"},
                 {"warmup", "2"},
                 {"ramp", "mu=1:0.5@1..6; amplitude=1.892:2.4@2..7; period=11.866071:9@1..8"}});
    scenes[7] = resolve({{"preset", "experiment"},
                         {"discs", "48"},
                         {"periods", "9"},
                         {"warmup", "2"},
                         {"events_per_sample", "11"},
                         {"ramp", "floor_friction=0.3:0.5@1..6; amplitude=1.9:1.2@2..6"}});
    return scenes;
}

struct ObservedRun {
    std::string result, measured;
    std::vector<double> series;
};

/// In spans, or event by event; interrupted after each `part` events.
ObservedRun observed(const RunConfig& config, const std::vector<std::string>& measured,
                     bool in_spans, std::uint64_t part) {
    std::optional<std::string> state;
    for (;;) {
        Observation observation = observation_of(config, measured);
        PeriodSeries series(config, measured);
        RunControl control;
        control.observation = &observation;
        control.series = &series;
        control.resume = state;
        swirl::Run run(config, control);
        std::uint64_t last = 1;
        for (std::uint64_t done = 0; done < part && last > 0; done += last) {
            if (in_spans) {
                last = run.execute_events();
                continue;
            }
            last = run.next_event() ? 1 : 0;
            if (last > 0) run.pass_event();
        }
        if (last == 0)
            return {result_without_time(run.result()), measured_json(observation.report()).dump(),
                    series.values()};
        state = run.state();
    }
}

// Events in spans, with an interruption after each 1000, have the results of single events.
TEST(Spans, HaveTheResultsOfSingleEventsAlsoIfResumed) {
    for (const RunConfig& config : scenes_for_spans()) {
        RunResult plain = run(config);
        for (const char* names : {"", "density", "order", "collisions"}) {
            const auto measured =
                *names == 0 ? std::vector<std::string>() : read_measurement_list(names);
            const ObservedRun single = observed(config, measured, false, 1'000'000);
            const ObservedRun spans = observed(config, measured, true, 1'000);
            EXPECT_EQ(spans.result, single.result);
            EXPECT_EQ(spans.measured, single.measured);
            expect_same_bits(spans.series, single.series);
            // Neither the series nor the measurements change the averages.
            EXPECT_EQ(result_without_time(plain), single.result);
        }
    }
}

// The snapshot is not updated after every span, and the angles only where they are needed.
TEST(Spans, TheSnapshotIsThatOfSingleEvents) {
    for (const RunConfig& config : scenes_for_spans()) {
        CoreRun spans(config, make_initial_state(config)),
            single(config, make_initial_state(config));
        for (std::uint64_t done = 0, passed = 0; done < 10'000;) {
            // Inspected after every third span.
            for (int k = 0; k < 3; ++k) {
                spans.is_check_due();
                done += spans.execute_events();
            }
            for (; passed < done; ++passed) {
                single.is_check_due();
                single.execute_event();
                single.pass_event();
            }
            // The clocks may differ, because a sample in time may have followed the last span.
            const Snapshot &a = spans.snapshot(), &b = single.snapshot();
            ASSERT_EQ(a.periods, b.periods);
            if (a.are_spheres()) continue;  // their snapshots are at the clock
            for (const auto column : {&Snapshot::x, &Snapshot::y, &Snapshot::vx, &Snapshot::vy,
                                      &Snapshot::angle, &Snapshot::spin, &Snapshot::held_at})
                ASSERT_EQ(a.*column, b.*column);
        }
    }
}

// At the end of a period a ramp changes the scene.
TEST(Spans, ASpanEndsWithItsPeriod) {
    for (const RunConfig& config : scenes_for_spans()) {
        CoreRun run(config, make_initial_state(config));
        for (std::int64_t period = 0; !run.complete();) {
            run.is_check_due();
            run.execute_events();
            const std::int64_t now = run.simulation().periods();
            if (now == period) continue;
            EXPECT_EQ(now, period + 1);
            EXPECT_EQ(run.simulation().clock(), 0.0);
            period = now;
        }
    }
}

// For all measurements: fields() must include all accumulated data.
TEST(Resume, EveryMeasurementContinues) {
    const RunConfig config = short_run();
    const std::vector<std::string> names = read_measurement_list("all");
    const MeasuredRun whole = measured_run(config, names);

    std::optional<std::string> state;
    for (int part = 0; part < 15; ++part) {
        Observation observation = observation_of(config, names);
        RunControl control;
        control.observation = &observation;
        control.resume = state;
        swirl::Run run(config, control);
        for (int k = 0; k < 1'900 && run.next_event(); ++k) run.pass_event();
        ASSERT_FALSE(run.complete());
        state = run.state();
    }
    Observation observation = observation_of(config, names);
    RunControl control;
    control.observation = &observation;
    control.resume = state;
    const RunResult result = run(config, control);
    EXPECT_TRUE(result.complete);
    EXPECT_EQ(measured_json(observation.report()).dump(), whole.measured.dump());
    EXPECT_EQ(result_without_time(result), result_without_time(whole.run));
}

TEST(Resume, ARunWithOtherMeasurementsIsRejected) {
    RunConfig config = short_run();
    config.events = 1'000'000'000;
    const Scratch scratch;
    RunFiles files;
    files.checkpoint = scratch / "c";
    files.resume = true;
    // Stopped at the first progress report.
    const auto stopped_run = [&](const char* list) {
        std::atomic<bool> stop = false;
        Observation observation = observation_of(config, read_measurement_list(list));
        RunControl control;
        control.stop = &stop;
        control.progress = [&](const RunProgress&) { stop = true; };
        control.observation = &observation;
        run_recorded(config, files, control, {});
    };
    stopped_run("density,flow");
    EXPECT_NO_THROW(stopped_run("density,flow"));
    try {
        stopped_run("density");
        FAIL();
    } catch (const UsageError& error) {
        EXPECT_NE(std::string(error.what()).find("measures [\"density,flow\"] there"),
                  std::string::npos)
            << error.what();
    }
}

TEST(Resume, SavingTheStateDoesNotChangeTheRun) {
    const RunConfig config = short_run();
    swirl::Run saved(config);
    for (int k = 0; saved.next_event(); ++k) {
        saved.pass_event();
        if (k % 500 == 0) {
            EXPECT_FALSE(saved.state().empty());
        }
    }
    EXPECT_EQ(result_without_time(saved.result()), result_without_time(run(config)));
}

RunResult recorded(const RunConfig& config, const RunFiles& files) {
    Observation observation = observation_of(config, {"slip"});
    RunControl control;
    control.observation = &observation;
    return run_recorded(config, files, control, {});
}

std::string problem_with(const RunConfig& config, const RunFiles& files) {
    try {
        recorded(config, files);
    } catch (const UsageError& error) {
        return error.what();
    }
    return "";
}

// A finished run accepts more events and then equals a run of that length.
TEST(Resume, AFinishedRunContinuesToMoreEventsBitwiseIdentical) {
    const Scratch scratch;
    RunFiles files;
    files.checkpoint = scratch / "c";
    files.resume = files.keep_checkpoint = true;
    RunConfig config;
    config.discs = 10;
    for (const auto& [first, more] : {std::pair(100'000, 130'000), std::pair(130'000, 130'001)}) {
        config.events = first;
        const RunResult before = recorded(config, files);
        ASSERT_EQ(before.warmup, default_warmup);
        config.events = more;
        const RunResult grown = recorded(config, files);
        EXPECT_EQ(grown.events.total(), std::uint64_t(more));
        EXPECT_EQ(result_without_time(grown), result_without_time(run(config)));
    }
    // The length may also be given in periods.
    config.periods = std::int64_t(run(config).periods) + 30;
    EXPECT_EQ(result_without_time(recorded(config, files)), result_without_time(run(config)));
    config.periods = 30;
    EXPECT_NE(problem_with(config, files).find("more than requested"), std::string::npos);
    config.discs = 11;
    EXPECT_NE(problem_with(config, files).find("discs is 10 there and 11 here"), std::string::npos);
}

TEST(Resume, AShortDefaultWarmupIsRejectedForALongerRun) {
    const Scratch scratch;
    RunFiles files;
    files.checkpoint = scratch / "c";
    files.resume = files.keep_checkpoint = true;
    RunConfig config;
    config.discs = 10;
    config.periods = 20;
    ASSERT_EQ(recorded(config, files).warmup, 4);
    config.periods = 40;
    EXPECT_NE(problem_with(config, files).find("shortened to 4 periods"), std::string::npos);
    std::filesystem::remove(files.checkpoint);
    config.warmup = 4;
    config.periods = 20;
    recorded(config, files);
    config.periods = 40;
    EXPECT_EQ(result_without_time(recorded(config, files)), result_without_time(run(config)));
    files.trajectory = scratch / "t.h5";
    config.periods = 41;
    EXPECT_NE(problem_with(config, files), "");
}

TEST(Resume, TheStateOfAnotherRunIsRejected) {
    const RunConfig config = short_run();
    swirl::Run begun(config);
    for (int k = 0; k < 10'000 && begun.next_event(); ++k) begun.pass_event();
    const std::string state = begun.state();

    RunConfig other = config;
    other.discs = 23;
    RunControl resumed;
    resumed.resume = state;
    EXPECT_THROW(run(other, resumed), FileError);
    resumed.resume = state.substr(0, state.size() - 1);
    EXPECT_THROW(run(config, resumed), FileError);
    resumed.resume = state + "x";
    EXPECT_THROW(run(config, resumed), FileError);
    resumed.resume = "";
    EXPECT_THROW(run(config, resumed), FileError);
}

}  // namespace
}  // namespace swirl
