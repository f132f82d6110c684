#include "track/video/circles.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "math/deviate.hpp"
#include "swirl/math/random.hpp"

namespace swirl::tracking {
namespace {

/// A ball, shaded towards its edge, textured, antialiased, with noise: bright on a dark floor, or
/// the reverse.
cv::Mat ball_image(const Vec2& centre, double radius, Polarity polarity, double noise_level,
                   Random& random) {
    cv::Mat image(128, 128, CV_32F);
    const Vec2 tilt = random.in_disc(5.0);
    for (int row = 0; row < image.rows; ++row)
        for (int column = 0; column < image.cols; ++column) {
            double level = 0.0;
            constexpr int fine = 3;
            for (int a = 0; a < fine; ++a)
                for (int b = 0; b < fine; ++b) {
                    const double x = column + (a - 1) / 3.0 - centre.x;
                    const double y = row + (b - 1) / 3.0 - centre.y;
                    const double q = (x * x + y * y) / (radius * radius);
                    const double up = std::sqrt(std::max(0.0, 1.0 - q));
                    const double pattern =
                        1.0 + 0.15 * std::sin(tilt.x * x / radius + tilt.y * y / radius);
                    level += q < 1.0 ? (90.0 + 60.0 * up) * pattern : 40.0;
                }
            level /= fine * fine;
            if (polarity < 0) level = 255.0 - level;
            image.ptr<float>(row)[column] =
                static_cast<float>(level + noise_level * deviate(random));
        }
    return image;
}

TEST(CircleFit, FindsCentreToATenthOfAPixel) {
    Random random(7);
    const EdgeProfile edge_profile(0.8, 10, 7, 2.0);
    for (const Polarity polarity : {1, -1}) {
        double square = 0.0;
        constexpr int trials = 40;
        for (int trial = 0; trial < trials; ++trial) {
            const Vec2 centre = Vec2{63.5, 63.5} + random.in_disc(2.0);
            const cv::Mat image = ball_image(centre, 24.0, polarity, 2.0, random);
            RaySettings rays;
            rays.rays = 72;
            rays.minimum = 1.0;
            rays.edge_profile = &edge_profile;
            rays.free_radius = true;
            const CircleFit fit = fit_circle(image, {63.0, 64.0}, 23.0, polarity, rays);
            ASSERT_TRUE(fit.good);
            EXPECT_GT(fit.support, 0.9);
            EXPECT_NEAR(fit.radius, 24.0, 0.3);
            square += dot(fit.centre - centre, fit.centre - centre);
        }
        EXPECT_LT(std::sqrt(square / (2.0 * trials)), 0.1);
        // A disc of the other polarity (dark instead of bright, or the reverse) gives no circle.
        const cv::Mat image = ball_image({64.0, 64.0}, 24.0, -polarity, 2.0, random);
        RaySettings rays;
        rays.minimum = 3.0;
        EXPECT_LT(fit_circle(image, {64.0, 64.0}, 24.0, polarity, rays).support, 0.3);
    }
}

}  // namespace
}  // namespace swirl::tracking
