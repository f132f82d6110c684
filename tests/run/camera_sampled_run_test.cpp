#include "swirl/run/camera_sampled_run.hpp"

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

TEST(SeenRun, ManyExactPicturesSayWhatTheRunSays) {
    const auto exact = result_json(run(small_container()));
    const auto seen = seen_run(small_container(), {511, 0.0}, {"temperature"});
    EXPECT_EQ(seen["state_hash"], exact["state_hash"]);  // looking changes no bit
    // Velocities between collisions are exact but for the frames with a collision in them.
    EXPECT_NEAR(mean(seen, "rigid_by_time"), mean(exact, "rigid_by_time"), 0.003);
}

TEST(SeenRun, PoorPlacesHeatTheDiscsByWhatTheyAdd) {
    RunConfig config = small_container();
    config.path = PathShape::polygon;
    const auto temperature = [&config](double error) {
        return seen_run(config, {64, error},
                        {"temperature"})["measured"]["temperature"]["granular"]["mean"]
            .get<double>();
    };
    // A velocity over two steps of T/64 has the variance 2σ²/(2T/64)² a coordinate.
    const double step = config.period / 64.0, error = 0.02;
    const double added = 2.0 * error * error / (4.0 * step * step);
    // One run tells it to a sixth or so: its discs are seen in other cells than with exact places.
    std::vector<double> shares;
    for (config.seed = 1; config.seed <= 16; ++config.seed)
        shares.push_back((temperature(error) - temperature(0.0)) / added);
    const Estimate share = estimate_of(shares);
    // Of some 4000 places seen, each of up to 314 cells of the dish takes one for its mean flow.
    EXPECT_NEAR(share.mean, 0.96, 0.04 + 3.0 * share.error);
    EXPECT_LT(share.error, 0.06);
}

}  // namespace
}  // namespace swirl
