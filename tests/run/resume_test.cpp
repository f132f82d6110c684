// A run that is interrupted, kept, and resumed ends with the same result as one that is not.
#include <gtest/gtest.h>

#include <atomic>

#include "files/scratch.hpp"
#include "swirl/files/file_error.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/json.hpp"
#include "swirl/run/measurements.hpp"
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

struct Look {
    double time, x;
    bool operator==(const Look&) const = default;
};

RunControl::Sampler looker(std::vector<Look>& looks, int per_period) {
    return {per_period, [&looks](const Snapshot& s) {
                looks.push_back({s.time(), s.position(3).x});
            }};
}

TEST(Resume, AnInterruptedRunEndsWithTheSameResult) {
    const RunConfig config = short_run();
    std::vector<Look> whole_looks;
    RunControl whole_control;
    whole_control.samplers = {looker(whole_looks, 7)};
    const RunResult whole = run(config, whole_control);
    ASSERT_TRUE(whole.complete);

    // Stopped again and again, at odd moments, each time resumed from what was kept.
    std::vector<Look> looks;
    std::optional<std::string> state;
    RunResult result;
    int pieces = 0;
    for (bool complete = false; !complete; ++pieces) {
        std::atomic<bool> stop = false;
        std::uint64_t left = 1'700;
        RunControl control;
        control.stop = &stop;
        control.samplers = {looker(looks, 7)};
        control.after_event = [&](const Snapshot&, const Event&) { stop = --left == 0 || stop; };
        control.wants_state = [](bool stopped) { return stopped; };
        control.keep_state = [&](const std::string& kept) { state = kept; };
        control.resume = state;
        result = run(config, control);
        complete = result.complete;
    }
    EXPECT_GT(pieces, 10);
    EXPECT_EQ(result_without_time(result), result_without_time(whole));
    EXPECT_EQ(looks, whole_looks);
}

// Whatever measurements there are: each must say in its fields() all that it has gathered.
TEST(Resume, EveryMeasurementGoesOnWhereItWas) {
    const RunConfig config = short_run();
    const std::vector<std::string> names = read_measurement_list("all");
    const MeasuredRun whole = measured_run(config, names);

    const Scratch scratch;
    RunFiles files;
    files.checkpoint = scratch / "c";
    files.resume = true;
    std::string measured;
    RunResult result;
    int pieces = 0;
    for (; !result.complete; ++pieces) {
        std::atomic<bool> stop = false;
        std::uint64_t left = 1'900;
        Observation observation = observation_of(config, names);
        RunControl control;
        control.stop = &stop;
        control.after_event = [&](const Snapshot&, const Event&) { stop = --left == 0 || stop; };
        control.observation = &observation;
        result = run_recorded(config, files, control, {});
        measured = measured_json(observation.report()).dump();
    }
    EXPECT_GT(pieces, 10);
    EXPECT_EQ(measured, whole.measured.dump());
    EXPECT_EQ(result_without_time(result), result_without_time(whole.run));
}

TEST(Resume, ARunThatMeasuredSomethingElseIsRefused) {
    const RunConfig config = short_run();
    const Scratch scratch;
    RunFiles files;
    files.checkpoint = scratch / "c";
    files.resume = true;
    const auto stopped_run = [&](const char* list) {
        const std::atomic<bool> stop = true;
        Observation observation = observation_of(config, read_measurement_list(list));
        RunControl control;
        control.stop = &stop;
        control.observation = &observation;
        run_recorded(config, files, control, {});
    };
    stopped_run("density,flow");
    EXPECT_NO_THROW(stopped_run("density,flow"));
    try {
        stopped_run("density");
        FAIL();
    } catch (const WrongCall& wrong) {
        EXPECT_NE(std::string(wrong.what()).find("measures [\"density,flow\"] there"),
                  std::string::npos)
            << wrong.what();
    }
}

TEST(Resume, KeepingTheStateChangesNothing) {
    const RunConfig config = short_run();
    RunControl control;
    int kept = 0;
    control.wants_state = [](bool) { return true; };
    control.keep_state = [&](const std::string&) { ++kept; };
    EXPECT_EQ(result_without_time(run(config, control)), result_without_time(run(config)));
    EXPECT_GT(kept, 50);
}

TEST(Resume, RefusesTheStateOfAnotherRun) {
    const RunConfig config = short_run();
    std::string state;
    RunControl control;
    control.wants_state = [](bool) { return true; };
    control.keep_state = [&](const std::string& kept) { state = kept; };
    run(config, control);

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
