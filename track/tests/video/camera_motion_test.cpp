#include "track/video/camera_motion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "math/deviate.hpp"
#include "swirl/math/random.hpp"
#include "track/video/circles.hpp"

namespace swirl::tracking {
namespace {

constexpr int width = 400, height = 320;
constexpr double swept = 130.0;
const Vec2 container{200.0, 160.0};

/// A table of smooth spots that is seen at `pose`, with a container that covers its middle.
cv::Mat frame_at(const CameraPose& pose, const Vec2& moved, double noise, Random& random) {
    struct Spot {
        Vec2 centre;
        double width, level;
    };
    static const std::vector<Spot> spots = [] {
        std::vector<Spot> all;
        Random positions(11);
        for (int k = 0; k < 300; ++k)
            all.push_back({{480.0 * positions.uniform() - 40.0, 400.0 * positions.uniform() - 40.0},
                           3.0 + 3.0 * positions.uniform(),
                           100.0 * positions.uniform() - 50.0});
        return all;
    }();
    cv::Mat image(height, width, CV_8U);
    for (int row = 0; row < height; ++row)
        for (int column = 0; column < width; ++column) {
            const Vec2 p = pose.fixed({double(column), double(row)});
            double level = 120.0;
            if (length(p - container - moved) < swept - 30.0)
                level = std::fmod(std::abs(p.x - moved.x), 24.0) < 12.0 ? 60.0 : 180.0;
            else
                for (const Spot& spot : spots) {
                    const Vec2 d = p - spot.centre;
                    const double q = dot(d, d) / (2.0 * spot.width * spot.width);
                    if (q < 9.0) level += spot.level * std::exp(-q);
                }
            image.at<std::uint8_t>(row, column) =
                cv::saturate_cast<std::uint8_t>(level + noise * deviate(random));
        }
    return image;
}

TEST(CameraMotion, PoseIsThatOfTheBackgroundAndNotOfTheContainer) {
    Random random(3);
    const Vec2 about{0.5 * (width - 1), 0.5 * (height - 1)};
    const CameraPose still{about, {0.0, 0.0}, 1.0, 0.0};
    const StaticBackground background(frame_at(still, {0.0, 0.0}, 2.0, random), container, swept);
    ASSERT_TRUE(background.usable());
    for (const CameraPose& true_pose :
         {still, CameraPose{about, {7.3, -4.6}, 1.0, 0.0},
          CameraPose{about, {-22.4, 15.8}, 1.0, 0.0}, CameraPose{about, {1.5, 2.5}, 1.02, 0.004}}) {
        const auto pose = background.pose(frame_at(true_pose, {15.0, -9.0}, 2.0, random));
        ASSERT_TRUE(pose);
        // A patch is found to about 0.05 pixels, and the corners of the image are 250 pixels away.
        for (const Vec2& p : {container, Vec2{0.0, 0.0}, Vec2{width, height}})
            EXPECT_LT(length(pose->seen(p) - true_pose.seen(p)), 0.15);
        EXPECT_LT(length(pose->fixed(pose->seen(container)) - container), 1e-9);
    }
}

TEST(CameraMotion, StabilisedFrameIsTheOneOfTheReferenceCamera) {
    Random random(5);
    const Vec2 about{0.5 * (width - 1), 0.5 * (height - 1)};
    const CameraPose still{about, {0.0, 0.0}, 1.0, 0.0}, moved{about, {4.4, -3.7}, 1.01, 0.003};
    const cv::Mat truth = frame_at(still, {0.0, 0.0}, 0.0, random);
    cv::Mat image = frame_at(moved, {0.0, 0.0}, 0.0, random);
    stabilise(image, moved);
    // The table has no sharp edges, so the images agree within rounding and the 1/32 pixels of the
    // interpolation.
    for (int row = 20; row < height - 20; ++row)
        for (int column = 20; column < width - 20; ++column) {
            if (length(Vec2{double(column), double(row)} - container) < swept) continue;
            EXPECT_NEAR(image.at<std::uint8_t>(row, column), truth.at<std::uint8_t>(row, column),
                        3);
        }
}

TEST(CameraMotion, UniformBackgroundIsNotUsable) {
    const cv::Mat uniform(height, width, CV_8U, cv::Scalar(120));
    EXPECT_FALSE(StaticBackground(uniform, container, swept).usable());
}

TEST(CameraMotion, ShakeIsTheScatterFromFrameToFrame) {
    Random random(7);
    CameraMotion motion;
    for (int k = 0; k < 400; ++k) {
        CameraPose pose;
        pose.shift = {0.02 * k + 2.5 * deviate(random), 2.5 * deviate(random)};
        motion.poses.push_back(pose);
    }
    measure_camera_motion(motion);
    EXPECT_NEAR(motion.shake, 2.5, 0.25);  // of 796 second differences, which share frames
    EXPECT_NEAR(motion.drift, 8.0, 2.5);   // the median of 11 frames still scatters
}

}  // namespace
}  // namespace swirl::tracking
