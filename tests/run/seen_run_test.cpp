#include "swirl/run/seen_run.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "swirl/run/json.hpp"

namespace swirl {
namespace {

RunConfig small_dish() {
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
    const auto exact = result_json(run(small_dish()));
    const auto seen = seen_run(small_dish(), {511, 0.0}, {"temperature"});
    EXPECT_EQ(seen["state_hash"], exact["state_hash"]);  // looking changes no bit
    // Velocities between collisions are exact but for the frames with a collision in them.
    EXPECT_NEAR(mean(seen, "rigid_by_time"), mean(exact, "rigid_by_time"), 0.003);
}

TEST(SeenRun, PoorPlacesHeatTheDiscsByWhatTheyAdd) {
    const auto temperature = [](double error) {
        return seen_run(small_dish(), {64, error},
                        {"temperature"})["measured"]["temperature"]["granular"]["mean"]
            .get<double>();
    };
    // A velocity over two steps of T/64 has the variance 2σ²/(2T/64)² a coordinate.
    const double step = small_dish().period / 64.0, error = 0.02;
    const double added = 2.0 * error * error / (4.0 * step * step);
    EXPECT_NEAR(temperature(error) - temperature(0.0), added, 0.15 * added);
}

}  // namespace
}  // namespace swirl
