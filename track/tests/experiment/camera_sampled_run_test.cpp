#include "track/experiment/camera_sampled_run.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "swirl/run/json.hpp"
#include "swirl/statistics/block_average.hpp"

namespace swirl {
namespace {

RunConfig small_container() {
    RunConfig config;
    config.discs = 20;
    config.container_radius = 6.5;
    config.periods = 30;
    config.warmup = 5;
    config.path = PathShape::circle;
    return config;
}

double mean(const nlohmann::ordered_json& run, const char* which) {
    return run["rotation"][which]["mean"].get<double>();
}

TEST(CameraSampledRun, DenseExactSamplingMatchesTheRun) {
    const auto exact = result_json(run(small_container()));
    const auto seen = camera_sampled_run(small_container(), {511, 0.0}, {"temperature"});
    EXPECT_EQ(seen["state_hash"],
              exact["state_hash"]);  // sampling leaves the trajectory bitwise identical
    // Velocities are exact except in frames with a collision.
    EXPECT_NEAR(mean(seen, "rigid_by_time"), mean(exact, "rigid_by_time"), 0.003);
}

TEST(CameraSampledRun, PositionErrorsAddTheExpectedTemperature) {
    RunConfig config = small_container();
    config.path = PathShape::polygon;
    const auto temperature = [&config](double error) {
        return camera_sampled_run(config, {64, error},
                                  {"temperature"})["measured"]["temperature"]["granular"]["mean"]
            .get<double>();
    };
    // A velocity over two steps of T/64 has the variance 2σ²/(2T/64)² per coordinate.
    const double step = config.period / 64.0, error = 0.02;
    const double added = 2.0 * error * error / (4.0 * step * step);
    // One run determines it to about a sixth of its value: noise moves some discs to another cell.
    std::vector<double> shares;
    for (config.seed = 1; config.seed <= 16; ++config.seed)
        shares.push_back((temperature(error) - temperature(0.0)) / added);
    const Estimate share = estimate_of(shares);
    // The mean flow of up to 314 cells takes one degree of freedom each from about 4000 positions.
    EXPECT_NEAR(share.mean, 0.96, 0.04 + 3.0 * share.error);
    EXPECT_LT(share.error, 0.06);
}

}  // namespace
}  // namespace swirl
