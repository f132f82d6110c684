#include "swirl/statistics/circular_mean.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "measure/snapshots.hpp"

namespace swirl {
namespace {

constexpr double degree = pi / 180.0;

TEST(CircularMean, AnglesAroundZeroAverageToZero) {
    CircularMean mean;
    mean.add(3.0 * unit_circle(350.0 / 360.0));
    mean.add(unit_circle(10.0 / 360.0));
    mean.add({0.0, 0.0});
    mean.close_block();
    EXPECT_NEAR(std::remainder(mean.angle().mean, 2.0 * pi), 0.0, 1e-15);
    EXPECT_NEAR(mean.concentration(), std::cos(10.0 * degree), 1e-15);
    EXPECT_EQ(mean.count(), 2.0);
    EXPECT_TRUE(std::isnan(mean.angle().error));
}

TEST(CircularMean, EqualsTheOrdinaryMeanForNarrowAngles) {
    CircularMean mean;
    BlockSeries plain;
    Noise noise(3);
    for (int block = 0; block < 200; ++block) {
        double sum = 0.0;
        for (int k = 0; k < 5; ++k) {
            const double off = 1e-3 * noise();
            mean.add(unit_circle(0.4 + off / (2.0 * pi)));
            sum += off;
        }
        mean.close_block();
        plain.add(sum, 5.0);
    }
    // Third order in 1e-3.
    EXPECT_NEAR(mean.angle().mean, 0.4 * 2.0 * pi + plain.mean(), 1e-9);
    const double error =
        plain.estimate().error / std::sqrt(plain.autocorrelation_time(plain.mean()));
    EXPECT_NEAR(mean.angle().error, error, 1e-4 * error);
}

TEST(CircularMean, IsNaNWithoutAnglesAndForOpposites) {
    CircularMean mean;
    EXPECT_TRUE(std::isnan(mean.angle().mean));
    EXPECT_TRUE(std::isnan(mean.concentration()));
    mean.add({1.0, 0.0});
    mean.add({-1.0, 0.0});
    mean.close_block();
    EXPECT_TRUE(std::isnan(mean.angle().mean));
    EXPECT_EQ(mean.concentration(), 0.0);
}

// The error of a mean of one block would be 0.
TEST(CircularMean, BlocksWithoutAnAngleDoNotCount) {
    CircularMean mean;
    for (int block = 0; block < 10; ++block) {
        if (block == 4) mean.add({1.0, 0.2});
        mean.close_block();
    }
    EXPECT_EQ(mean.angle().effective_samples, 1.0);
    EXPECT_TRUE(std::isnan(mean.angle().error));
    mean.add({1.0, -0.2});
    mean.close_block();
    EXPECT_EQ(mean.angle().effective_samples, 2.0);
    EXPECT_GT(mean.angle().error, 0.0);
}

TEST(CircularMean, MergedEqualsOneLongRun) {
    CircularMean whole, first, second;
    Noise noise(8);
    for (int block = 0; block < 20; ++block) {
        for (int k = 0; k < 4; ++k) {
            const Vec2 v{noise(), 2.0 + noise()};
            whole.add(v);
            (block < 9 ? first : second).add(v);
        }
        whole.close_block();
        (block < 9 ? first : second).close_block();
    }
    first.merge(second);
    EXPECT_NEAR(first.angle().mean, whole.angle().mean, 1e-14);
    EXPECT_NEAR(first.angle().error, whole.angle().error, 1e-14);
}

}  // namespace
}  // namespace swirl
