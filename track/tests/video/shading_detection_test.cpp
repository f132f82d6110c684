#include "track/video/shading_detection.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "math/deviate.hpp"
#include "swirl/math/random.hpp"
#include "swirl/math/unit_circle.hpp"
#include "track/video/circles.hpp"

namespace swirl::tracking {
namespace shading_detection_tests {

constexpr double ball_radius = 15.0;
constexpr std::size_t balls = 28;
constexpr double noise = 3.0;  // grey levels; the floor has 100, a ball at most 130

struct Scene {
    std::vector<PreparedFrame> frames;
    std::vector<CircleFit> rims;
    std::vector<std::vector<Vec2>> positions;
};

/// Balls at random positions in a dish, lit from 45 degrees above the direction `light` (turns).
Scene lit_balls(std::uint64_t seed, double light, std::size_t number) {
    constexpr int side = 280, frames = 8;
    constexpr double dish = 125.0, elevation = std::numbers::sqrt2 / 2.0;
    const Vec2 l = elevation * unit_circle(light), middle{0.5 * (side - 1), 0.5 * (side - 1)};
    Random random(seed);
    Scene scene;
    for (int k = 0; k < frames; ++k) {
        std::vector<Vec2> at;
        while (at.size() < number) {
            const Vec2 p = (dish - ball_radius) *
                           Vec2{2.0 * random.uniform() - 1.0, 2.0 * random.uniform() - 1.0};
            if (length(p) < dish - ball_radius &&
                std::none_of(at.begin(), at.end(), [&](const Vec2& q) {
                    return length(middle + p - q) < 2.0 * ball_radius;
                }))
                at.push_back(middle + p);
        }
        cv::Mat image(side, side, CV_32F, cv::Scalar(60.0));
        for (int row = 0; row < side; ++row)
            for (int column = 0; column < side; ++column) {
                const Vec2 x{double(column), double(row)};
                double level = length(x - middle) < dish ? 100.0 : 60.0;
                for (const Vec2& p : at) {
                    const Vec2 n = (1.0 / ball_radius) * (x - p);
                    if (dot(n, n) > 1.0) continue;
                    const double up = std::sqrt(1.0 - dot(n, n));
                    level = 130.0 * (0.55 + 0.45 * std::max(0.0, dot(n, l) + elevation * up));
                }
                image.at<float>(row, column) = static_cast<float>(level + noise * deviate(random));
            }
        cv::Mat grey;
        image.convertTo(grey, CV_8U);
        scene.frames.emplace_back(grey, 1.0, survey_blur);
        CircleFit rim;
        rim.centre = middle;
        rim.radius = dish;
        rim.good = true;
        scene.rims.push_back(rim);
        scene.positions.push_back(at);
    }
    return scene;
}

TEST(ShadingDetection, FindsNumberRadiusAndPositionsOfBallsOfLowContrast) {
    for (const std::uint64_t seed : {1, 2, 3}) {
        const double light = 0.1 + 0.3 * double(seed);
        const Scene scene = lit_balls(seed, light, balls);
        const auto found = survey_shading(scene.frames, scene.rims, {}, 1);
        ASSERT_TRUE(found) << seed;
        EXPECT_EQ(found->number, balls) << seed;
        // Radii of trials differ by a tenth.
        EXPECT_NEAR(found->radius(), ball_radius, 0.1 * ball_radius) << seed;
        EXPECT_GT(dot(found->shading->towards, unit_circle(light)),
                  std::cos(2.0 * pi * 15.0 / 360.0));
        Vec2 sum{0.0, 0.0};
        double square = 0.0, count = 0.0;
        for (std::size_t k = 0; k < scene.frames.size(); ++k) {
            const auto discs = find_by_shading(scene.frames[k].sharp, scene.rims[k],
                                               *found->shading, found->number);
            ASSERT_EQ(discs.size(), balls) << seed;
            for (const Vec2& p : scene.positions[k]) {
                Vec2 nearest{1e9, 0.0};
                for (const DetectedParticle& d : discs)
                    if (length(d.centre - p) < length(nearest)) nearest = d.centre - p;
                EXPECT_LT(length(nearest), 0.5 * ball_radius) << seed;
                sum = sum + nearest;
                square += dot(nearest, nearest);
                count += 1.0;
            }
        }
        // All share a shift. Neighbours shift single balls by about a tenth of a radius.
        const Vec2 shift = (1.0 / count) * sum;
        EXPECT_LT(std::sqrt(0.5 * (square / count - dot(shift, shift))), 0.15 * ball_radius)
            << seed;
    }
}

TEST(ShadingDetection, FindsNoBallsInNoise) {
    const Scene scene = lit_balls(4, 0.2, 0);
    EXPECT_FALSE(survey_shading(scene.frames, scene.rims, {}, 1));
}

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

}  // namespace shading_detection_tests
}  // namespace swirl::tracking
