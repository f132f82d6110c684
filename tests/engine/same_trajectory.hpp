// Compares a trajectory of the engine with that of a reference, event by event and bitwise, for
// every vector width.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <deque>
#include <string>
#include <vector>

#include "engine/scenes.hpp"
#include "swirl/engine/reference.hpp"
#include "swirl/engine/simulation.hpp"
#include "swirl/math/cpu_width.hpp"

namespace swirl {

inline ::testing::AssertionResult same_bits(double a, double b) {
    if (std::memcmp(&a, &b, sizeof a) == 0) return ::testing::AssertionSuccess();
    return ::testing::AssertionFailure() << a << " differs from " << b << " by " << a - b;
}

inline void expect_same_state(const Disc& a, const Disc& b) {
    ASSERT_TRUE(same_bits(a.position.x, b.position.x));
    ASSERT_TRUE(same_bits(a.position.y, b.position.y));
    ASSERT_TRUE(same_bits(a.velocity.x, b.velocity.x));
    ASSERT_TRUE(same_bits(a.velocity.y, b.velocity.y));
    ASSERT_TRUE(same_bits(a.angle, b.angle));
    ASSERT_TRUE(same_bits(a.spin, b.spin));
    ASSERT_TRUE(same_bits(a.time, b.time));
}
/// The additional state of spheres.
inline void expect_same_sphere(const Disc& a, const Disc& b) {
    ASSERT_TRUE(same_bits(a.rolling_spin.x, b.rolling_spin.x));
    ASSERT_TRUE(same_bits(a.rolling_spin.y, b.rolling_spin.y));
    ASSERT_TRUE(same_bits(a.last_collision, b.last_collision));
}

/// Compares every event's time, partners and impulse of a reference with those of other
/// simulations, and all discs at the end. Under the sanitizers it compares a sixteenth of the
/// events, but at least 500 of them: the plain build compares all, and Overlap.Slow_Search runs
/// millions under the sanitizers.
template <class Slow, class Engines>
void expect_same_events(const InitialState& scene, Slow&& reference, Engines&& engines,
                        int events) {
    const bool spheres = scene.shape != Shape::disc;
    if (sanitized) events = std::max(std::min(events, 500), events / 16);
    for (int k = 0; k < events; ++k) {
        const Event expected = reference.step();
        int of = 0;
        for (auto& engine : engines) {
            const std::string where = "event " + std::to_string(k) + " of " + std::to_string(of++);
            const Event found = engine.step();
            ASSERT_TRUE(same_bits(expected.clock, found.clock)) << where;
            ASSERT_EQ(expected.periods, found.periods) << where;
            ASSERT_EQ(expected.kind, found.kind) << where;
            ASSERT_EQ(expected.i, found.i) << where;
            ASSERT_EQ(expected.j, found.j) << where;
            ASSERT_TRUE(same_bits(expected.impulse.normal, found.impulse.normal)) << where;
            ASSERT_TRUE(same_bits(expected.impulse.tangential, found.impulse.tangential)) << where;
            if (!spheres) continue;
            ASSERT_TRUE(same_bits(expected.impulse.vertical, found.impulse.vertical)) << where;
            ASSERT_LT(found.overlap, 1e-12) << where;
        }
    }
    for (auto& engine : engines)
        for (std::size_t i = 0; i < scene.discs.size(); ++i) {
            expect_same_state(reference.disc(i), engine.disc(i));
            if (spheres) expect_same_sphere(reference.disc(i), engine.disc(i));
        }
}
template <class Slow = Reference>
void expect_same_trajectory(const InitialState& scene, int events, const Tuning& tuning) {
    std::deque<Simulation> engine;
    engine.emplace_back(scene, Progress{}, tuning);
    expect_same_events(scene, Slow(scene), engine, events);
}

/// The vector widths that this processor supports.
inline std::vector<Width> every_width() {
    std::vector<Width> widths = {Width::baseline, Width::avx2, Width::avx512};
    std::erase_if(widths, [](Width width) { return !has_width(width); });
    return widths;
}
inline Tuning tuning(int cells = 0) { return {cells}; }
inline Tuning tuning(SearchMethod search) { return {0, Width::best, search}; }

/// One run of the reference for all widths, because it is much slower than they are.
template <class Slow = Reference>
void expect_same_for_every_width(const InitialState& scene, int events, Tuning tuning) {
    std::deque<Simulation> engines;
    for (const Width width : every_width()) {
        tuning.width = width;
        engines.emplace_back(scene, Progress{}, tuning);
    }
    expect_same_events(scene, Slow(scene), engines, events);
}

/// A run that is saved after some events and resumed must end like one without interruption.
inline void expect_bitwise_identical_after_resuming(const InitialState& scene, std::uint64_t events,
                                                    std::uint64_t saved_after) {
    Simulation whole(scene), first(scene);
    whole.run(events);
    first.run(saved_after);
    InitialState saved = scene;
    for (std::size_t i = 0; i < saved.discs.size(); ++i) saved.discs[i] = first.disc(i);
    Simulation resumed(saved, first.progress());
    resumed.run(events - saved_after);
    EXPECT_EQ(whole.state_hash(), resumed.state_hash());
    EXPECT_EQ(whole.events().begins_to_roll, resumed.events().begins_to_roll);
}

}  // namespace swirl
