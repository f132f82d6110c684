#include "track/video/container_path_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "math/deviate.hpp"
#include "swirl/math/random.hpp"
#include "swirl/math/unit_circle.hpp"
#include "track/video/circles.hpp"

namespace swirl::tracking {
namespace {

TEST(ContainerPath, IsFoundWithItsErrors) {
    Random random(5);
    int within = 0, tried = 0;
    for (const bool clockwise : {false, true})
        for (int trial = 0; trial < 20; ++trial) {
            const TrackedPath truth{{310.0, 250.0}, 40.0, 0.05, 0.7, clockwise};
            std::vector<Vec2> centres;
            std::vector<double> times;
            for (int k = 0; k < 300; ++k) {
                times.push_back(k);
                centres.push_back(truth.at(k) + Vec2{0.2 * deviate(random), 0.2 * deviate(random)});
                if (k % 23 == 0) centres.back() = {100.0 * random.uniform(), 5.0};  // outliers
            }
            const auto found = fit_container_path(centres, times);
            ASSERT_TRUE(found);
            EXPECT_EQ(found->clockwise, clockwise);
            // Standard errors are about 0.01, 0.012 pixels and 0.0006 rad: the tolerances are at
            // least three of them.
            EXPECT_NEAR(found->residual, 0.2, 0.03);
            EXPECT_NEAR(found->amplitude, 40.0, 0.1);
            EXPECT_NEAR(std::remainder(found->phase - truth.phase, 2.0 * pi), 0.0, 0.01);
            ++tried;
            within += std::abs(found->omega - truth.omega) < 2.0 * found->omega_error;
        }
    // The expected fraction within two standard errors is 95 %.
    EXPECT_GE(within, tried * 8 / 10);
}

TEST(ContainerPath, ContainerAtRestHasNoPath) {
    Random random(6);
    std::vector<Vec2> centres;
    std::vector<double> times;
    for (int k = 0; k < 200; ++k) {
        times.push_back(k);
        centres.push_back({300.0 + 0.3 * deviate(random), 200.0 + 0.3 * deviate(random)});
    }
    EXPECT_FALSE(fit_container_path(centres, times));
}

TEST(ContainerPath, CircleIsFoundIfTheContainerRestsInMostFrames) {
    Random random(7);
    const TrackedPath truth{{310.0, 250.0}, 40.0, 0.1, 0.7};
    std::vector<Vec2> centres;
    for (int k = 0; k < 300; ++k)
        centres.push_back(truth.at(std::max(0, k - 220)) +
                          Vec2{0.1 * deviate(random), 0.1 * deviate(random)});
    // 80 points on the circle give its centre and radius to about 0.03 pixels.
    const PathCircle found = circle_through(centres);
    EXPECT_NEAR(found.radius, 40.0, 0.15);
    EXPECT_NEAR(length(found.centre - truth.centre), 0.0, 0.15);
}

}  // namespace
}  // namespace swirl::tracking
