// Compares a trajectory of the engine with that of a reference, event by event and bitwise, for
// every vector width.
#pragma once

#include <gtest/gtest.h>

#include <cstring>
#include <string>

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

/// Runs both and compares every event's time, partners and impulse, and all discs at the end.
template <class Slow = Reference>
void expect_same_trajectory(const InitialState& scene, int events, const Tuning& tuning) {
    const bool spheres = scene.shape != Shape::disc;
    Slow reference(scene);
    Simulation engine(scene, {}, tuning);
    for (int k = 0; k < events; ++k) {
        const Event expected = reference.step(), found = engine.step();
        ASSERT_TRUE(same_bits(expected.clock, found.clock)) << "event " << k;
        ASSERT_EQ(expected.periods, found.periods);
        ASSERT_EQ(expected.kind, found.kind) << "event " << k;
        ASSERT_EQ(expected.i, found.i) << "event " << k;
        ASSERT_EQ(expected.j, found.j) << "event " << k;
        ASSERT_TRUE(same_bits(expected.impulse.normal, found.impulse.normal));
        ASSERT_TRUE(same_bits(expected.impulse.tangential, found.impulse.tangential));
        if (!spheres) continue;
        ASSERT_TRUE(same_bits(expected.impulse.vertical, found.impulse.vertical));
        ASSERT_LT(found.overlap, 1e-12) << "event " << k;
    }
    for (std::size_t i = 0; i < scene.discs.size(); ++i) {
        expect_same_state(reference.disc(i), engine.disc(i));
        if (spheres) expect_same_sphere(reference.disc(i), engine.disc(i));
    }
}

/// A test for each vector width that this processor supports.
class OfEveryWidth : public ::testing::TestWithParam<Width> {
  protected:
    void SetUp() override {
        if (!has_width(GetParam())) GTEST_SKIP() << "this processor does not support this width";
    }
};

inline auto every_width() { return ::testing::Values(Width::baseline, Width::avx2, Width::avx512); }
inline std::string width_name(const ::testing::TestParamInfo<Width>& width) {
    switch (width.param) {
        case Width::avx512:
            return "avx512";
        case Width::avx2:
            return "avx2";
        default:
            return "baseline";
    }
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
