#include "track/video/floor_pattern.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "math/deviate.hpp"
#include "swirl/math/random.hpp"
#include "swirl/math/unit_circle.hpp"

namespace swirl::tracking {
namespace floor_pattern_tests {

constexpr int side = 260;           // pixels
constexpr double radius = 90.0;     // of the container
constexpr double amplitude = 20.0;  // of its path
constexpr double wall = 6.0;        // width
constexpr double disc_radius = 11.0;
constexpr double disc_level = 190.0;
constexpr std::size_t frames = 40;
constexpr double cell = 15.0;
const Vec2 middle{129.3, 130.4};

struct Frame {
    cv::Mat image, discs;  // 8 bits; 255 where a disc is
    Vec2 centre;
};

/// A container on its path. Floor levels `dark` and `bright` alternate; discs lie at random.
std::vector<Frame> video(double dark, double bright, double noise) {
    Random random(5);
    std::vector<Frame> all;
    for (std::size_t k = 0; k < frames; ++k) {
        Frame frame;
        frame.centre = middle + amplitude * unit_circle(double(k) / 20.0);
        std::vector<Vec2> discs;
        while (discs.size() < 14) {
            const Vec2 p{radius * (2.0 * random.uniform() - 1.0),
                         radius * (2.0 * random.uniform() - 1.0)};
            bool free = length(p) < radius - disc_radius;
            for (const Vec2& q : discs) free = free && length(p - q) > 2.0 * disc_radius;
            if (free) discs.push_back(p);
        }
        frame.image = cv::Mat(side, side, CV_8U);
        frame.discs = cv::Mat::zeros(side, side, CV_8U);
        for (int row = 0; row < side; ++row)
            for (int column = 0; column < side; ++column) {
                const Vec2 p = Vec2{double(column), double(row)} - frame.centre;
                double level = 120.0;
                if (length(p) < radius + wall) level = 230.0;
                if (length(p) < radius)
                    level =
                        (int(std::floor(p.x / cell) + std::floor(p.y / cell)) & 1) ? bright : dark;
                for (const Vec2& q : discs)
                    if (length(p - q) < disc_radius) {
                        level = disc_level;
                        frame.discs.at<std::uint8_t>(row, column) = 255;
                    }
                frame.image.at<std::uint8_t>(row, column) =
                    cv::saturate_cast<std::uint8_t>(level + noise * deviate(random));
            }
        all.push_back(std::move(frame));
    }
    return all;
}

/// The wall's outer edge, which is brighter than the table, as the survey finds it.
ContainerRim outer_edge() {
    ContainerRim rim;
    rim.radius = radius + wall;
    rim.polarity = 1;
    rim.support = 1.0;
    rim.path_centre = middle;
    rim.amplitude = amplitude;
    return rim;
}

std::vector<cv::Mat> images_of(const std::vector<Frame>& all) {
    std::vector<cv::Mat> images;
    for (const Frame& frame : all) images.push_back(frame.image.clone());
    return images;
}

TEST(FloorPattern, FloorGetsOneLevelAndDiscsAndWallStay) {
    const std::vector<Frame> all = video(40.0, 90.0, 2.0);
    const auto floor = FloorPattern::learned(images_of(all), outer_edge(), 1.0, 1);
    ASSERT_TRUE(floor);
    double floor_pixels = 0.0, left = 0.0;
    for (const Frame& frame : all) {
        cv::Mat image = frame.image.clone();
        floor->remove(image);
        for (int row = 0; row < side; ++row)
            for (int column = 0; column < side; ++column) {
                const auto before = frame.image.at<std::uint8_t>(row, column),
                           after = image.at<std::uint8_t>(row, column);
                const double far = length(Vec2{double(column), double(row)} - frame.centre);
                // Pixels within 2 of the floor's edge contain a part of it, by interpolation.
                if (frame.discs.at<std::uint8_t>(row, column) || far > radius + 2.0) {
                    ASSERT_EQ(before, after) << "at " << column << ", " << row;
                } else if (far < radius - 3.0) {
                    floor_pixels += 1.0;
                    left += double(after) > 40.0 + 10.0;
                }
            }
    }
    // Between discs, gaps narrower than 2 × 4 pixels keep the pattern; half of it is bright.
    EXPECT_LT(left / floor_pixels, 0.05);
}

TEST(FloorPattern, PlainFloorHasNone) {
    // Levels that differ by five standard deviations of the noise are no pattern yet.
    EXPECT_FALSE(FloorPattern::learned(images_of(video(60.0, 60.0, 2.0)), outer_edge(), 1.0, 1));
    EXPECT_FALSE(FloorPattern::learned(images_of(video(60.0, 70.0, 2.0)), outer_edge(), 1.0, 1));
}

TEST(FloorPattern, FoldingMakesDarkAndBrightDiscsBright) {
    std::vector<Frame> all = video(120.0, 120.0, 2.0);
    for (Frame& frame : all)  // discs on the left are dark
        for (int row = 0; row < side; ++row)
            for (int column = 0; column < side / 2; ++column)
                if (frame.discs.at<std::uint8_t>(row, column))
                    frame.image.at<std::uint8_t>(row, column) = 40;
    const FloorPattern floor = FloorPattern::folded(images_of(all), outer_edge());
    for (const Frame& frame : all) {
        cv::Mat image = frame.image.clone();
        floor.remove(image);
        for (int row = 0; row < side; ++row)
            for (int column = 0; column < side; ++column) {
                if (length(Vec2{double(column), double(row)} - frame.centre) > radius - 1.0)
                    continue;
                // Discs are 70 or 80 levels from the floor, and the noise stays below 5 deviations.
                const int level = image.at<std::uint8_t>(row, column);
                ASSERT_EQ(level > 85, frame.discs.at<std::uint8_t>(row, column) != 0) << level;
            }
    }
}

TEST(FloorPattern, FewFramesGiveNone) {
    std::vector<cv::Mat> images = images_of(video(40.0, 90.0, 2.0));
    images.resize(11);
    EXPECT_FALSE(FloorPattern::learned(images, outer_edge(), 1.0, 1));
}

TEST(FloorPattern, FrameWithoutARimStaysAsItIs) {
    const auto floor =
        FloorPattern::learned(images_of(video(40.0, 90.0, 2.0)), outer_edge(), 1.0, 1);
    ASSERT_TRUE(floor);
    cv::Mat blank(side, side, CV_8U, cv::Scalar(40));
    floor->remove(blank);
    EXPECT_EQ(cv::countNonZero(blank != 40), 0);
}

}  // namespace floor_pattern_tests
}  // namespace swirl::tracking
