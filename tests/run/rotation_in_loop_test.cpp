// The event loop samples the rotation by itself (engine/rotation_observer.hpp). Its samples must be
// those that a snapshot gives which is brought up to date after each event, bit by bit.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

#include "swirl/engine/simulation.hpp"
#include "swirl/math/cpu_width.hpp"
#include "swirl/measure/cluster_rotation.hpp"
#include "swirl/measure/sample_times.hpp"
#include "swirl/run/config.hpp"
#include "swirl/run/core_run.hpp"

namespace swirl {
namespace {

constexpr std::int64_t periods = 6;

struct Scene {
    const char* name;
    std::int64_t discs;
    double container_radius;
    bool spheres = false, floor = false;
};

/// All pairs, lists and cells; few and many spheres, with and without a floor.
constexpr Scene scenes[] = {
    {.name = "one disc", .discs = 1, .container_radius = 8.6},
    {.name = "few discs", .discs = 5, .container_radius = 8.6},
    {.name = "all pairs", .discs = 13, .container_radius = 8.6},
    {.name = "lists", .discs = 45, .container_radius = 8.6},
    {.name = "cells", .discs = 60, .container_radius = 20.0},
    {.name = "few spheres", .discs = 12, .container_radius = 8.6, .spheres = true},
    {.name = "many spheres", .discs = 70, .container_radius = 12.0, .spheres = true},
    {.name = "few on a floor",
     .discs = 12,
     .container_radius = 8.6,
     .spheres = true,
     .floor = true},
    {.name = "many on a floor",
     .discs = 70,
     .container_radius = 12.0,
     .spheres = true,
     .floor = true}};

RunConfig config_of(const Scene& scene, std::int64_t events_per_sample) {
    RunConfig config;
    config.discs = scene.discs;
    config.container_radius = scene.container_radius;
    config.body = scene.spheres ? Shape::sphere : Shape::disc;
    config.floor = scene.floor;
    config.periods = periods + 2;
    config.warmup = periods + 1;  // all samples count in the rotation before it
    config.events_per_sample = events_per_sample;
    return config;
}

/// The samples of a run, from outside the loop.
ClusterRotation from_outside(const RunConfig& config, const Tuning& tuning) {
    const InitialState scene = make_initial_state(config);
    Simulation simulation(scene, {}, tuning);
    Snapshot snapshot = simulation.snapshot();
    ClusterRotation rotation(tuning.width);
    SampleTimes many(rotation_samples, config.period), few(rotation_samples_of_few, config.period);
    const auto interval = static_cast<std::uint64_t>(config.events_per_sample);
    std::uint64_t events = 0, events_before = 0;
    const auto begin_period = [&] {
        const bool is_exact = interval == 1 && events - events_before < events_of_exact_means &&
                              !snapshot.are_spheres();
        if (is_exact) rotation.begin_angles(snapshot);
        events_before = events;
    };
    begin_period();
    while (simulation.periods() < periods) {
        const bool is_exact = rotation.follows_angles(snapshot);
        const Event event = simulation.step();
        while ((is_exact ? few : many).next(snapshot, scene.path, event.clock))
            rotation.sample_by_time(snapshot);
        simulation.refresh(snapshot, event);
        const bool period_ended = simulation.periods() > event.periods;
        if (interval == 1 || period_ended) rotation.follow(snapshot, event);
        if (++events % interval == 0) {
            if (interval > 1) rotation.renew_centre(snapshot);
            rotation.sample(snapshot);
        }
        if (!period_ended) continue;
        if (is_exact) rotation.end_angles(snapshot);
        rotation.close_block(interval,
                             is_exact ? double(rotation_samples) / rotation_samples_of_few : 1.0);
        begin_period();
    }
    return rotation;
}

ClusterRotation within_the_loop(const RunConfig& config, const Tuning& tuning, bool single_events) {
    CoreRun run(config, make_initial_state(config), nullptr, {}, tuning);
    while (run.simulation().periods() < periods) {
        run.is_check_due();
        if (single_events) {
            run.execute_event();
            run.pass_event();
        } else {
            run.execute_events();
        }
    }
    return run.rotation_in_warmup();
}

/// Bits, because a mean may be NaN.
std::vector<std::uint64_t> bits_of(const ClusterRotation& rotation) {
    std::vector<std::uint64_t> bits;
    for (const BlockSeries* series : {&rotation.mean_by_event(), &rotation.mean_by_time(),
                                      &rotation.rigid_by_event(), &rotation.rigid_by_time()})
        for (const double mean : series->block_means())
            bits.push_back(std::isnan(mean) ? 1 : std::bit_cast<std::uint64_t>(mean));
    return bits;
}

TEST(RotationInLoop, EqualsSamplesFromOutside) {
    for (const Scene& scene : scenes) {
        for (const std::int64_t events_per_sample : {1, 7}) {
            for (const Width width : {Width::baseline, Width::avx2, Width::avx512}) {
                if (!has_width(width)) continue;
                const RunConfig config = config_of(scene, events_per_sample);
                Tuning tuning;
                tuning.width = width;
                const auto expected = bits_of(from_outside(config, tuning));
                EXPECT_EQ(expected.size(), 4u * periods);
                for (const bool single_events : {false, true})
                    EXPECT_EQ(bits_of(within_the_loop(config, tuning, single_events)), expected)
                        << scene.name << ", every " << events_per_sample << ", width "
                        << static_cast<int>(width) << (single_events ? ", single events" : "");
            }
        }
    }
}

}  // namespace
}  // namespace swirl
