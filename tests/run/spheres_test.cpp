#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "swirl/run/failure.hpp"
#include "swirl/run/measurements.hpp"
#include "swirl/run/recorded_run.hpp"

namespace swirl {
namespace {

RunConfig experiment(const char* discs, const char* periods = "12") {
    return resolve({{"preset", "experiment"}, {"discs", discs}, {"periods", periods}});
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

TEST(RunOfSpheres, WhatDoesNotKnowThemIsRefused) {
    const RunConfig config = experiment("5");
    for (const char* name : {"energy", "temperature"})
        EXPECT_THROW(observation_of(config, {name}), WrongCall) << name;
    RunFiles files;
    files.trajectory = "spheres.h5";
    EXPECT_THROW(run_recorded(config, files, {}, {}), WrongCall);
    files.trajectory.clear();
    files.event_log = "spheres.h5";
    EXPECT_THROW(run_recorded(config, files, {}, {}), WrongCall);
}

// Few rotate with the swirl and many against it, as in the experiment. Of few by the rigid
// estimator: one of eight spheres is often near their centre of mass (cluster_rotation.hpp).
TEST(RunOfSpheres, FewRotateAndManyCounterrotate) {
    const Estimate few = run(experiment("8", "120")).rotation.rigid_by_time;
    const Estimate many = run(experiment("48", "30")).rotation.by_time;
    EXPECT_GT(few.mean, 6.0 * few.error);
    EXPECT_LT(many.mean, -6.0 * many.error);
}

}  // namespace
}  // namespace swirl
