#include "track/video/colour_plane.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "math/deviate.hpp"
#include "swirl/math/random.hpp"

namespace swirl::tracking {
namespace colour_plane_tests {

const cv::Vec3d floor_colour{50.0, 58.0, 65.0}, red{190.0, 40.0, 35.0}, yellow{215.0, 180.0, 50.0};

/// Pixels of a floor and of balls, a third for each colour, which are darker on one side.
std::vector<cv::Vec3b> pixels_of(const std::vector<cv::Vec3d>& balls) {
    constexpr double noise = 4.0, dark_side = 0.6;
    constexpr std::size_t number = 1500;
    Random random(5);
    std::vector<cv::Vec3b> pixels;
    const auto add = [&](const cv::Vec3d& colour) {
        cv::Vec3b pixel;
        for (int channel = 0; channel < 3; ++channel)
            pixel[channel] =
                cv::saturate_cast<std::uint8_t>(colour[channel] + noise * deviate(random));
        pixels.push_back(pixel);
    };
    for (std::size_t k = 0; k < number; ++k) {
        add(floor_colour);
        for (const cv::Vec3d& ball : balls)
            add((dark_side + (1.0 - dark_side) * random.uniform()) * ball);
    }
    return pixels;
}

int level_of(const ColourPlane& plane, const cv::Vec3d& colour) {
    const cv::Mat rgb(1, 1, CV_8UC3, cv::Scalar(colour[0], colour[1], colour[2]));
    cv::Mat grey;
    plane.project(rgb, grey);
    return grey.at<std::uint8_t>(0, 0);
}

TEST(ColourPlane, BallsOfTwoColoursAreEquallyBright) {
    const auto plane = ColourPlane::proposed(pixels_of({red, yellow}));
    ASSERT_TRUE(plane);
    EXPECT_EQ(plane->number_of_colours(), 2U);
    EXPECT_NEAR(level_of(*plane, floor_colour), 50, 5);
    // The colour in the plane is that of the mean pixel: 0.8 of the bright side.
    EXPECT_NEAR(level_of(*plane, 0.8 * red), 170, 10);
    EXPECT_NEAR(level_of(*plane, 0.8 * yellow), 170, 10);
}

TEST(ColourPlane, AnEdgeStaysInItsPlace) {
    const auto plane = ColourPlane::proposed(pixels_of({red, yellow}));
    ASSERT_TRUE(plane);
    // Half of the pixel is floor. In between, the level is linear.
    for (const cv::Vec3d& ball : {red, yellow})
        EXPECT_NEAR(level_of(*plane, 0.5 * (floor_colour + 0.8 * ball)), 110, 6);
}

TEST(ColourPlane, GreyIsKeptWhereItShowsAllBalls) {
    EXPECT_FALSE(ColourPlane::proposed(pixels_of({yellow})));
    EXPECT_FALSE(ColourPlane::proposed(pixels_of({{150.0, 215.0, 90.0}, yellow})));
    const std::vector<cv::Vec3b> shades = pixels_of({{200.0, 200.0, 200.0}, {90.0, 90.0, 90.0}});
    EXPECT_FALSE(ColourPlane::proposed(shades));
}

TEST(ColourPlane, BallsThatAreAsBrightAsTheFloorAreSeenByTheirColour) {
    const auto plane = ColourPlane::proposed(pixels_of({{120.0, 45.0, 40.0}}));
    ASSERT_TRUE(plane);
    EXPECT_GT(level_of(*plane, {110.0, 42.0, 37.0}) - level_of(*plane, floor_colour), 80);
}

TEST(ColourPlane, NoiseIsNoColour) {
    EXPECT_TRUE(is_grey({{100, 104, 98}, {20, 20, 20}}));
    EXPECT_FALSE(is_grey(pixels_of({red})));
}

}  // namespace colour_plane_tests
}  // namespace swirl::tracking
