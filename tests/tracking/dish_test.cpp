#include "swirl/tracking/dish.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "math/deviate.hpp"
#include "swirl/math/random.hpp"
#include "swirl/math/unit_circle.hpp"

namespace swirl {
namespace {

TEST(DishPath, IsFoundWithItsErrors) {
    Random random(5);
    int within = 0, tried = 0;
    for (const bool clockwise : {false, true})
        for (int trial = 0; trial < 20; ++trial) {
            TrackedPath truth{{310.0, 250.0}, 40.0, 0.05, 0.7, clockwise};
            std::vector<Vec2> centres;
            std::vector<double> times;
            for (int k = 0; k < 300; ++k) {
                times.push_back(k);
                centres.push_back(truth.at(k) + Vec2{0.2 * deviate(random), 0.2 * deviate(random)});
                if (k % 23 == 0) centres.back() = {100.0 * random.uniform(), 5.0};  // strays
            }
            const auto found = fit_path(centres, times);
            ASSERT_TRUE(found);
            EXPECT_EQ(found->clockwise, clockwise);
            EXPECT_NEAR(found->residual, 0.2, 0.03);
            EXPECT_NEAR(found->amplitude, 40.0, 0.1);
            ++tried;
            within += std::abs(found->omega - truth.omega) < 2.0 * found->omega_error;
            EXPECT_NEAR(std::remainder(found->phase - truth.phase, 2.0 * pi), 0.0, 0.01);
        }
    // Two standard errors hold 95 of 100.
    EXPECT_GE(within, tried * 8 / 10);
}

TEST(DishPath, AStillDishHasNone) {
    Random random(6);
    std::vector<Vec2> centres;
    std::vector<double> times;
    for (int k = 0; k < 200; ++k) {
        times.push_back(k);
        centres.push_back({300.0 + 0.3 * deviate(random), 200.0 + 0.3 * deviate(random)});
    }
    EXPECT_FALSE(fit_path(centres, times));
}

/// A bright ball on a dark floor: shaded towards its limb, textured, blurred, with noise.
cv::Mat picture_of(const Vec2& centre, double radius, Polarity polarity, double noise_level,
                   Random& random) {
    cv::Mat picture(128, 128, CV_32F);
    const Vec2 tilt = random.in_disc(5.0);
    for (int row = 0; row < picture.rows; ++row)
        for (int column = 0; column < picture.cols; ++column) {
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
            picture.ptr<float>(row)[column] =
                static_cast<float>(level + noise_level * deviate(random));
        }
    return picture;
}

TEST(CircleFit, FindsACentreToATenthOfAPixel) {
    Random random(7);
    const EdgeProfile edge_profile(0.8, 10, 7, 2.0);
    for (const Polarity polarity : {1, -1}) {
        double square = 0.0;
        constexpr int trials = 40;
        for (int trial = 0; trial < trials; ++trial) {
            const Vec2 centre = Vec2{63.5, 63.5} + random.in_disc(2.0);
            const cv::Mat picture = picture_of(centre, 24.0, polarity, 2.0, random);
            RaySettings rays;
            rays.rays = 72;
            rays.minimum = 1.0;
            rays.edge_profile = &edge_profile;
            rays.free_radius = true;
            const CircleFit fit = fit_circle(picture, {63.0, 64.0}, 23.0, polarity, rays);
            ASSERT_TRUE(fit.good);
            EXPECT_GT(fit.support, 0.9);
            EXPECT_NEAR(fit.radius, 24.0, 0.3);
            square += dot(fit.centre - centre, fit.centre - centre);
        }
        EXPECT_LT(std::sqrt(square / (2.0 * trials)), 0.1);
        // Of the other polarity there is no circle.
        const cv::Mat picture = picture_of({64.0, 64.0}, 24.0, -polarity, 2.0, random);
        RaySettings rays;
        rays.minimum = 3.0;
        EXPECT_LT(fit_circle(picture, {64.0, 64.0}, 24.0, polarity, rays).support, 0.3);
    }
}

/// Places on a polygon with its first corner at angle 0, so many to a round; 0 sides: a circle.
std::vector<Vec2> on_polygon(double amplitude, int sides, double per_round, int number) {
    std::vector<Vec2> places;
    for (int k = 0; k < number; ++k) {
        const double turn = k / per_round - std::floor(k / per_round);
        Vec2 p = amplitude * unit_circle(turn);
        if (sides > 0) {
            const double segment = sides * turn, u = segment - std::floor(segment);
            p = (amplitude * (1.0 - u)) * unit_circle(std::floor(segment) / sides) +
                (amplitude * u) * unit_circle(std::fmod(std::floor(segment) + 1.0, sides) / sides);
        }
        places.push_back({200.0 + p.x, 180.0 - p.y});
    }
    return places;
}

TEST(PathPolygon, TellsAPolygonByItsSidesAndACircleFromIt) {
    Random random(11);
    constexpr double amplitude = 40.0, noise_of_a_rim = 0.06;
    for (const int sides : {0, 4, 12, 30}) {
        // 149.3 pictures for a swirl.
        std::vector<Vec2> centres = on_polygon(amplitude, sides, 149.3, 600);
        std::vector<double> times;
        for (std::size_t k = 0; k < centres.size(); ++k) {
            centres[k] = centres[k] + noise_of_a_rim * Vec2{deviate(random), deviate(random)};
            times.push_back(double(k));
        }
        const auto path = fit_path(centres, times);
        ASSERT_TRUE(path) << sides;
        const PathPolygon shape = polygon_of(centres, times, *path);
        EXPECT_EQ(shape.sides, sides);
        EXPECT_GE(shape.max_sides, sides == 0 ? 30 : sides);
        if (sides == 0) continue;
        // A square's corners are left out by the fit's weights as strays.
        EXPECT_NEAR(shape.corners, amplitude, sides > 6 ? 0.1 : 0.5);
    }
}

TEST(PathPolygon, TellsNoWrongNumberOfSidesWherePicturesAreFew) {
    Random random(13);
    constexpr double per_swirl = 64.0;
    std::vector<double> times;
    for (int k = 0; k < 74; ++k) times.push_back(k);
    const auto sides_of = [&](double amplitude, int sides, double every_other) {
        std::vector<Vec2> centres = on_polygon(amplitude, sides, per_swirl, 74);
        for (std::size_t k = 0; k < centres.size(); ++k) {
            const Vec2 out = (1.0 / amplitude) * (centres[k] - Vec2{200.0, 180.0});
            centres[k] = centres[k] + (k % 2 ? every_other : -every_other) * out +
                         0.004 * Vec2{deviate(random), deviate(random)};
        }
        const auto path = fit_path(centres, times);
        EXPECT_TRUE(path);
        const PathPolygon shape = polygon_of(centres, times, *path);
        // Nor is the true one said not to be there.
        if (shape.sides == 0) {
            EXPECT_LT(shape.max_sides, sides);
        }
        return shape.sides;
    };
    for (int trial = 0; trial < 20; ++trial) {
        // What a codec does to every other picture is no polygon of two pictures a side.
        EXPECT_NE(sides_of(8.0, 30, 0.01), 32);
        // One of 34 sides is seen at the places of one of 30, but for its size.
        const int sides = sides_of(30.0, 34, 0.0);
        EXPECT_TRUE(sides == 0 || sides == 34) << sides;
        EXPECT_EQ(sides_of(30.0, 20, 0.0), 20);
    }
}

/// Centres of the pictures that are left, and the number that each has in the film then.
std::vector<Leap> leaps_with(const std::vector<int>& shown, double omega, Random& random) {
    const TrackedPath truth{{310.0, 250.0}, 40.0, omega, 0.7, false};
    std::vector<Vec2> centres;
    std::vector<std::size_t> numbers;
    for (const int k : shown) {
        numbers.push_back(centres.size());
        centres.push_back(truth.at(k) + Vec2{0.1 * deviate(random), 0.1 * deviate(random)});
    }
    return leaps_of(centres, numbers, truth);
}

TEST(Leaps, AShakingCameraIsNoPictureThatIsThereTwice) {
    // 64 pictures a period, 2.6 pixels each, shaken by 1.7 pixels.
    const TrackedPath truth{{310.0, 250.0}, 26.0, 2.0 * pi / 64.0, 0.7, false};
    Random random(4);
    for (int trial = 0; trial < 20; ++trial) {
        std::vector<Vec2> centres;
        std::vector<std::size_t> numbers;
        for (int k = 0; k < 200; ++k) {
            numbers.push_back(centres.size());
            centres.push_back(truth.at(k) + Vec2{1.7 * deviate(random), 1.7 * deviate(random)});
        }
        EXPECT_TRUE(leaps_of(centres, numbers, truth).empty()) << trial;
        // A median of 198 values, which share pictures: within a quarter of what it estimates.
        EXPECT_NEAR(shake_of(centres, numbers, truth), 1.7, 0.25 * 1.7);
    }
}

TEST(Leaps, NoPathShakesTheCamera) {
    // A square's corners are 12 pixels farther out than its sides.
    const std::size_t a_side = 16;
    std::vector<Vec2> centres;
    std::vector<std::size_t> numbers;
    for (std::size_t k = 0; k < 128; ++k) {
        const double u = double(k % a_side) / double(a_side);
        const Vec2 from = unit_circle(0.25 * double(k / a_side % 4)),
                   to = unit_circle(0.25 * double(k / a_side % 4 + 1));
        numbers.push_back(k);
        centres.push_back(Vec2{310.0, 250.0} + 40.0 * ((1.0 - u) * from + u * to));
    }
    const TrackedPath path{{310.0, 250.0}, 33.0, 2.0 * pi / 64.0, 0.0, true};
    // A step of 3.5 pixels at 28.3 from the middle bends by 0.44: 0.27 by the factors of noise.
    EXPECT_LT(shake_of(centres, numbers, path), 0.27);
}

TEST(Leaps, TellPicturesThatAreLostOrThereTwice) {
    Random random(8);
    std::vector<int> all, lost, twice, each_twice;
    for (int k = 0; k < 200; ++k) {
        all.push_back(k);
        if (k != 50 && k != 120 && k != 121) lost.push_back(k);
        twice.push_back(k);
        if (k == 70) twice.push_back(k);
        each_twice.push_back(k / 2 * 2);
    }
    EXPECT_TRUE(leaps_with(all, 0.05, random).empty());
    const auto missing = leaps_with(lost, 0.05, random);
    ASSERT_EQ(missing.size(), 2u);
    EXPECT_EQ(missing[0].before, 49u);
    EXPECT_NEAR(missing[0].steps, 2.0, 0.4);
    EXPECT_NEAR(missing[1].steps, 3.0, 0.4);
    const auto doubled = leaps_with(twice, 0.05, random);
    ASSERT_EQ(doubled.size(), 1u);
    EXPECT_EQ(doubled[0].before, 70u);
    EXPECT_NEAR(doubled[0].steps, 0.0, 0.4);
    EXPECT_EQ(leaps_with(each_twice, 0.05, random).size(), 100u);
}

TEST(Leaps, AreNotMadeOfNoiseOrOfAHandThatSwirls) {
    Random random(12);
    std::vector<int> all;
    for (int k = 0; k < 300; ++k) all.push_back(k);
    EXPECT_TRUE(leaps_with(all, 0.002, random).empty());  // a step is less than the noise
    const TrackedPath truth{{310.0, 250.0}, 40.0, 0.05, 0.7, false};
    std::vector<Vec2> centres;
    std::vector<std::size_t> numbers;
    for (int k = 0; k < 300; ++k) {
        numbers.push_back(centres.size());
        centres.push_back(truth.at(k + 8.0 * std::sin(0.05 * k)));  // 40 % faster, and slower
        if (k % 40 == 7) centres.back() = centres.back() + Vec2{4.0, -3.0};  // a stray
    }
    EXPECT_TRUE(leaps_of(centres, numbers, truth).empty());
}

}  // namespace
}  // namespace swirl
