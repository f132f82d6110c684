#include <gtest/gtest.h>

#include "engine/golden_runs.hpp"

namespace swirl {
namespace {

void expect_golden(Width width) {
    if (!has_width(width)) GTEST_SKIP() << "this processor does not support this width";
    for (const GoldenRun& golden : golden_runs()) {
        Simulation simulation(golden.scene, {}, {0, width});
        // Under the sanitizers the long ones only begin. Other compilers and levels have these
        // hashes in ./check --slow.
        const bool complete = !sanitized || golden.events <= 5000;
        simulation.run(complete ? golden.events : 3000);
        if (!complete) continue;
        EXPECT_EQ(simulation.state_hash(), golden.hash) << golden.name;
    }
}

TEST(GoldenHash, Baseline) { expect_golden(Width::baseline); }
TEST(GoldenHash, Avx2) { expect_golden(Width::avx2); }
TEST(GoldenHash, Avx512) { expect_golden(Width::avx512); }

TEST(GoldenHash, DifferBetweenTrajectories) {
    const auto runs = golden_runs();
    for (std::size_t a = 0; a < runs.size(); ++a)
        for (std::size_t b = 0; b < a; ++b) EXPECT_NE(runs[a].hash, runs[b].hash);
}

}  // namespace
}  // namespace swirl
