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

TEST(CameraSampledRun, PositionErrorsAddTheExpectedDisplacement) {
    RunConfig config = small_container();
    config.path = PathShape::polygon;
    const auto displacement = [&config](double error) {
        return camera_sampled_run(config, {64, error},
                                  {"diffusion"})["measured"]["diffusion"]["displacement"][0]
            .get<double>();
    };
    // Both ends have the variance σ² in each of two coordinates.
    const double error = 0.02, added = 4.0 * error * error;
    std::vector<double> shares;
    for (config.seed = 1; config.seed <= 16; ++config.seed)
        shares.push_back((displacement(error) - displacement(0.0)) / added);
    const Estimate share = estimate_of(shares);
    EXPECT_NEAR(share.mean, 1.0, 3.0 * share.error);
    EXPECT_LT(share.error, 0.06);
}

}  // namespace
}  // namespace swirl
