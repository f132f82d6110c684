#include "track/video/video.hpp"

#include <gtest/gtest.h>

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "math/deviate.hpp"
#include "swirl/math/random.hpp"
#include "swirl/run/failure.hpp"
#include "track/video/camera_motion.hpp"
#include "track/video/circles.hpp"

namespace swirl::tracking {
namespace video_tests {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

using Numbers = std::vector<std::size_t>;

TEST(AscendingTimes, ValidTimesAreUnchanged) {
    const std::vector<double> uneven{0.5, 1.0, 1.25, 4.0, 4.1};
    const AscendingTimes found = ascending_times(uneven);
    EXPECT_EQ(found.seconds, uneven);
    EXPECT_TRUE(found.untimed.empty());
}

TEST(AscendingTimes, FramesThatShareATimeAreSpreadBetweenTheirNeighbours) {
    // Either of the two frames may have the wrong time.
    for (const double shared : {3.0, 4.0}) {
        const AscendingTimes found = ascending_times({0.0, 1.0, 2.0, shared, shared, 5.0, 6.0});
        EXPECT_EQ(found.seconds, (std::vector<double>{0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0}));
        EXPECT_EQ(found.untimed, (Numbers{3, 4}));
    }
    // A step below the minimum, and three equal times at either end.
    EXPECT_EQ(ascending_times({0.0, 1.0, 1.0 + 1e-9, 3.0, 4.0}).untimed, (Numbers{1, 2}));
    EXPECT_EQ(ascending_times({2.0, 2.0, 2.0, 3.0, 4.0}).seconds,
              (std::vector<double>{0.0, 1.0, 2.0, 3.0, 4.0}));
    EXPECT_EQ(ascending_times({0.0, 1.0, 2.0, 2.0, 2.0}).seconds,
              (std::vector<double>{0.0, 1.0, 2.0, 3.0, 4.0}));
}

TEST(AscendingTimes, NonFiniteAndDescendingTimesAreReplaced) {
    const AscendingTimes found = ascending_times({0.0, 1.0, nan, 3.0, -infinite, 5.0, 6.0});
    EXPECT_EQ(found.seconds, (std::vector<double>{0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0}));
    const AscendingTimes back = ascending_times({0.0, 1.0, 2.0, 3.0, 2.5, 5.0, 6.0});
    EXPECT_EQ(back.untimed, (Numbers{3, 4}));
    EXPECT_TRUE(std::is_sorted(back.seconds.begin(), back.seconds.end(), std::less_equal<>()));
}

TEST(AscendingTimes, ResultsAscendOrAreRejected) {
    const double odd[] = {nan, infinite, -infinite, 0.0, -1e300, 1e300, 1.0, 2.0};
    Random random(7);
    int rejected = 0;
    for (int trial = 0; trial < 2000; ++trial) {
        std::vector<double> seconds(1 + random.below(12));
        for (std::size_t k = 0; k < seconds.size(); ++k)
            seconds[k] = random.below(3) == 0 ? odd[random.below(8)] : double(k);
        try {
            const std::vector<double> times = ascending_times(seconds).seconds;
            ASSERT_EQ(times.size(), seconds.size());
            for (std::size_t k = 0; k < times.size(); ++k) {
                ASSERT_TRUE(std::isfinite(times[k]));
                if (k > 0) {
                    ASSERT_LT(times[k - 1], times[k]);
                }
            }
        } catch (const Failure&) {
            ++rejected;
        }
    }
    EXPECT_GT(rejected, 0);
    EXPECT_LT(rejected, 2000);
}

TEST(AscendingTimes, EqualTimesAreRejected) {
    EXPECT_THROW(ascending_times({1.0, 1.0, 1.0}), Failure);
    EXPECT_THROW(ascending_times({nan, nan}), Failure);
    EXPECT_THROW(ascending_times({}), Failure);
}

/// Numbered images of a bright disc that moves to the right by four pixels per frame.
class Fields : public ::testing::Test {
  protected:
    static constexpr int frames = 16, width = 160, height = 120;
    static constexpr double begin = 40.0, speed = 4.0, radius = 20.0;

    void TearDown() override { std::filesystem::remove_all(folder_); }
    /// The rows are taken at these times, in frames from that of the image on. Returns the pattern.
    std::string write(double even, double odd) {
        std::filesystem::create_directories(folder_);
        for (int k = 0; k < frames; ++k) {
            std::ofstream file(folder_ / fmt::format("{:02}.pgm", k), std::ios::binary);
            file << "P5\n" << width << " " << height << "\n255\n";
            for (int y = 0; y < height; ++y)
                for (int x = 0; x < width; ++x) {
                    const double centre = begin + speed * (k + (y % 2 == 0 ? even : odd));
                    const double inside = radius - std::hypot(x - centre, y - 0.5 * height);
                    file.put(static_cast<char>(
                        std::lround(40.0 + 160.0 * std::clamp(inside + 0.5, 0.0, 1.0))));
                }
        }
        return (folder_ / "%02d.pgm").string();
    }

  private:
    const std::filesystem::path folder_ =
        std::filesystem::path(::testing::TempDir()) /
        fmt::format("swirl_fields_{}",
                    ::testing::UnitTest::GetInstance()->current_test_info()->name());
};

TEST_F(Fields, OrderIsFoundFromTheMotion) {
    EXPECT_EQ(field_order(write(0.0, 0.0), 0), FieldOrder::progressive);
    EXPECT_EQ(field_order(write(0.0, 0.5), 0), FieldOrder::top_first);
    EXPECT_EQ(field_order(write(0.5, 0.0), 2), FieldOrder::bottom_first);
}

TEST_F(Fields, FramesShowTheTimeOfTheFirstField) {
    for (const FieldOrder order : {FieldOrder::top_first, FieldOrder::bottom_first}) {
        const bool top = order == FieldOrder::top_first;
        Video video(write(top ? 0.0 : 0.5, top ? 0.5 : 0.0), 1, 0, {.fields = order});
        cv::Mat grey;
        for (int k = 0; k < frames; ++k) {
            ASSERT_TRUE(video.next(grey));
            double sum = 0.0, weight = 0.0;
            for (int y = 0; y < height; ++y)
                for (int x = 0; x < width; ++x) {
                    const double level = grey.ptr(y)[x] - 40.0;
                    sum += x * level, weight += level;
                }
            // The fields are two pixels apart, so their mean would be one pixel off.
            EXPECT_NEAR(sum / weight, begin + speed * k, 0.1) << k;
        }
        EXPECT_FALSE(video.next(grey));
    }
}

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

}  // namespace video_tests
}  // namespace swirl::tracking
