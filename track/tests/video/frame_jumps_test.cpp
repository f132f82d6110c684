#include "track/video/frame_jumps.hpp"

#include <gtest/gtest.h>

#include <gmock/gmock.h>
#include <cmath>
#include <functional>
#include <string>

#include "math/deviate.hpp"
#include "swirl/math/random.hpp"
#include "swirl/math/unit_circle.hpp"
#include "swirl/run/failure.hpp"
#include "track/video/circles.hpp"
#include "track/video/container_path_fit.hpp"
#include "track/video/recorded_motion.hpp"

namespace swirl::tracking {
namespace frame_jumps_tests {

/// Jumps in a video that consists of the frames `shown` of another one.
std::vector<FrameJump> jumps_with(const std::vector<int>& shown, double omega, Random& random) {
    const TrackedPath truth{{310.0, 250.0}, 40.0, omega, 0.7, false};
    std::vector<Vec2> centres;
    std::vector<std::size_t> frames;
    std::vector<double> changes;  // of the pixels: less than noise if a frame is there twice
    for (const int k : shown) {
        changes.push_back(frames.empty() ? -1.0 : k == shown[frames.size() - 1] ? 3.0 : 60.0);
        frames.push_back(centres.size());
        centres.push_back(truth.at(k) + Vec2{0.1 * deviate(random), 0.1 * deviate(random)});
    }
    return find_frame_jumps(centres, frames, truth, changes);
}

TEST(FrameJumps, ShakingCameraIsNoDuplicatedFrame) {
    // 64 frames per period, 2.6 pixels apart, shaken by 1.7 pixels.
    const TrackedPath truth{{310.0, 250.0}, 26.0, 2.0 * pi / 64.0, 0.7, false};
    Random random(4);
    for (int trial = 0; trial < 20; ++trial) {
        std::vector<Vec2> centres;
        std::vector<std::size_t> frames;
        for (int k = 0; k < 200; ++k) {
            frames.push_back(centres.size());
            centres.push_back(truth.at(k) + Vec2{1.7 * deviate(random), 1.7 * deviate(random)});
        }
        EXPECT_TRUE(find_frame_jumps(centres, frames, truth, {}).empty()) << trial;
        // A median of 198 values, which share frames: within a quarter of the true value.
        EXPECT_NEAR(camera_shake(centres, frames, truth), 1.7, 0.25 * 1.7);
    }
}

TEST(FrameJumps, RimThatStandsStillInChangedPixelsIsNoDuplicate) {
    // By chance a shake cancels the motion of the container between two frames.
    const TrackedPath truth{{310.0, 250.0}, 26.0, 2.0 * pi / 64.0, 0.7, false};
    std::vector<Vec2> centres;
    std::vector<std::size_t> frames;
    for (int k = 0; k < 100; ++k) {
        frames.push_back(centres.size());
        centres.push_back(truth.at(k == 50 ? 49 : k));
    }
    std::vector<double> changes(100, 60.0);
    EXPECT_TRUE(find_frame_jumps(centres, frames, truth, changes).empty());
    changes[50] = 2.0;
    EXPECT_EQ(find_frame_jumps(centres, frames, truth, changes).size(), 1u);
}

TEST(FrameJumps, PolygonIsNoShake) {
    // The vertices of a square are 12 pixels farther out than its sides.
    const std::size_t per_side = 16;
    std::vector<Vec2> centres;
    std::vector<std::size_t> frames;
    for (std::size_t k = 0; k < 128; ++k) {
        const double u = double(k % per_side) / double(per_side);
        const Vec2 from = unit_circle(0.25 * double(k / per_side % 4)),
                   to = unit_circle(0.25 * double(k / per_side % 4 + 1));
        frames.push_back(k);
        centres.push_back(Vec2{310.0, 250.0} + 40.0 * ((1.0 - u) * from + u * to));
    }
    const TrackedPath path{{310.0, 250.0}, 33.0, 2.0 * pi / 64.0, 0.0, true};
    // A straight step of 3.5 pixels at 28.3 pixels from the centre has a second difference of 0.44,
    // which looks like a shake of 0.27 pixels.
    EXPECT_LT(camera_shake(centres, frames, path), 0.27);
}

TEST(FrameJumps, FindsDroppedAndDuplicatedFrames) {
    Random random(8);
    std::vector<int> all, dropped, duplicated, all_duplicated;
    for (int k = 0; k < 200; ++k) {
        all.push_back(k);
        if (k != 50 && k != 120 && k != 121) dropped.push_back(k);
        duplicated.push_back(k);
        if (k == 70) duplicated.push_back(k);
        all_duplicated.push_back(k / 2 * 2);
    }
    EXPECT_TRUE(jumps_with(all, 0.05, random).empty());
    const auto missing = jumps_with(dropped, 0.05, random);
    ASSERT_EQ(missing.size(), 2u);
    EXPECT_EQ(missing[0].before, 49u);
    EXPECT_NEAR(missing[0].steps, 2.0, 0.4);
    EXPECT_NEAR(missing[1].steps, 3.0, 0.4);
    const auto repeated = jumps_with(duplicated, 0.05, random);
    ASSERT_EQ(repeated.size(), 1u);
    EXPECT_EQ(repeated[0].before, 70u);
    EXPECT_NEAR(repeated[0].steps, 0.0, 0.4);
    EXPECT_TRUE(repeated[0].duplicate && repeated[0].inserted);
    // A duplicate that replaces the frame after it does not delay the later ones.
    std::vector<int> replaced = all;
    replaced[91] = 90;
    const auto one = jumps_with(replaced, 0.05, random);
    ASSERT_EQ(one.size(), 1u);
    EXPECT_EQ(one[0].after, 91u);
    EXPECT_TRUE(one[0].duplicate && !one[0].inserted);
    EXPECT_EQ(jumps_with(all_duplicated, 0.05, random).size(), 100u);
}

TEST(FrameJumps, NoiseAndUnevenSwirlingAreNoJumps) {
    Random random(12);
    std::vector<int> all;
    for (int k = 0; k < 300; ++k) all.push_back(k);
    EXPECT_TRUE(jumps_with(all, 0.002, random).empty());  // a step is less than the noise
    const TrackedPath truth{{310.0, 250.0}, 40.0, 0.05, 0.7, false};
    std::vector<Vec2> centres;
    std::vector<std::size_t> frames;
    for (int k = 0; k < 300; ++k) {
        frames.push_back(centres.size());
        centres.push_back(truth.at(k + 8.0 * std::sin(0.05 * k)));  // speed varies by ± 40 %
        if (k % 40 == 7) centres.back() = centres.back() + Vec2{4.0, -3.0};  // an outlier
    }
    EXPECT_TRUE(find_frame_jumps(centres, frames, truth, {}).empty());
}

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

/// The position at a share of the period, in pixels from the mean.
using Shape = std::function<Vec2(double share)>;

Vec2 wave(double x_cycles, double y_cycles, double share) {
    return {40.0 * std::cos(2.0 * pi * x_cycles * share),
            30.0 * std::sin(2.0 * pi * y_cycles * share)};
}

struct Video {
    std::vector<Vec2> centres;
    std::vector<double> times;

    RecordedMotion motion() const { return average_motion(centres, times, centres.size()); }
};

constexpr double period = 63.7, noise = 0.2;  // frames; pixels
const Vec2 middle{310.0, 250.0};

Video video_of(const Shape& shape, std::size_t frames, Random& random, double sigma = noise) {
    Video video;
    for (std::size_t k = 0; k < frames; ++k) {
        const double share = double(k) / period;
        video.times.push_back(double(k));
        video.centres.push_back(middle + shape(share - std::floor(share)) +
                                Vec2{sigma * deviate(random), sigma * deviate(random)});
    }
    return video;
}

std::string failure_of(const Video& video, std::size_t frames) {
    try {
        average_motion(video.centres, video.times, frames);
    } catch (const Failure& failure) {
        return failure.what();
    }
    return "";
}

TEST(RecordedMotion, IsFoundWithItsErrorsOnAnyClosedPath) {
    const Shape shapes[] = {
        [](double u) { return wave(1, 1, u); },  // ellipse, clockwise in the image
        [](double u) {
            return Vec2{35.0 * std::cos(2.0 * pi * u), 0.0};
        },
        [](double u) { return wave(2, 3, u); },  // its largest common period is one
        [](double u) { return wave(1, 2, u); },
        [](double u) { return wave(-1, 1, u) + 0.1 * wave(5, 5, u); },
    };
    Random random(3);
    int within = 0, tried = 0;
    for (const Shape& shape : shapes)
        for (int trial = 0; trial < 3; ++trial) {
            Video video = video_of(shape, 260, random);
            for (std::size_t k = 11; k < 260; k += 29) video.centres[k] = {5.0, 7.0};  // outliers
            const RecordedMotion found = video.motion();
            ++tried;
            within += std::abs(found.period() - period) < 2.0 * found.period_error();
            EXPECT_NEAR(found.periods, 260.0 / period, 0.01);
            EXPECT_NEAR(found.used, 1.0 - 9.0 / 260.0, 0.01);
            // A coordinate of the path has the mean square of the error that is reported. With a
            // coordinate fitted by 3 to 13 numbers, its square varies by less than a factor of 6.
            double square = 0.0;
            for (int k = 0; k < 100; ++k) {
                const Vec2 off = found.at(period * k / 100.0) - middle - shape(k / 100.0);
                square += 0.5 * dot(off, off) / 100.0;
            }
            EXPECT_LT(std::sqrt(square), 2.5 * found.point_error);
            EXPECT_LT(found.point_error, 3.0 * noise * std::sqrt(13.0 / 260.0));
        }
    // The expected share within two standard errors is 95 %.
    EXPECT_GE(within, tried * 8 / 10);
}

/// Mean square of (period − true period)/error over videos of 4 periods whose noise has this
/// correlation between successive frames.
double mean_square_deviation(double correlation, int videos, std::uint64_t seed) {
    Random random(seed);
    double square = 0.0;
    for (int trial = 0; trial < videos; ++trial) {
        Video video = video_of([](double u) { return wave(1, 1, u); }, 260, random, 0.0);
        Vec2 off{noise * deviate(random), noise * deviate(random)};
        const double fresh = noise * std::sqrt(1.0 - correlation * correlation);
        for (Vec2& c : video.centres) {
            c = c + off;
            off = correlation * off + Vec2{fresh * deviate(random), fresh * deviate(random)};
        }
        const RecordedMotion found = video.motion();
        const double z = (found.period() - period) / found.period_error();
        square += z * z / videos;
    }
    return square;
}

// The mean of 20 squares of normal deviates is above 2 or below 0.37 in one of 200 cases each. The
// error of independent frames alone would give about 1.7 / 0.3 = 5.7.
TEST(RecordedMotion, ThePeriodErrorContainsTheCorrelationOfFrames) {
    const double square = mean_square_deviation(0.7, 20, 8);
    EXPECT_GT(square, 0.37);
    EXPECT_LT(square, 2.0);
}
// The mean of 40 squares has a standard error of 22 %.
TEST(RecordedMotion, Slow_ThePeriodErrorContainsAnyCorrelationOfFrames) {
    for (const double correlation : {0.0, 0.7}) {
        const double square = mean_square_deviation(correlation, 40, 8);
        EXPECT_GT(square, 0.5) << correlation;
        EXPECT_LT(square, 1.5) << correlation;
    }
}

TEST(RecordedMotion, FollowsFromTimesThatAreNotEquallySpaced) {
    Random random(4);
    const auto shape = [](double u) { return wave(1, 1, u); };
    Video video = video_of(shape, 400, random, 0.0);
    // A pause of the camera of 2.4 periods, and every fifth frame missing.
    Video rest;
    for (std::size_t k = 0; k < 400; ++k)
        if ((k < 120 || k > 273) && k % 5 != 0) {
            rest.centres.push_back(video.centres[k]);
            rest.times.push_back(video.times[k]);
        }
    EXPECT_NEAR(rest.motion().period(), period, 1e-6);  // exact centres
}

TEST(RecordedMotion, PeriodsThatDifferMakeTheErrorLarger) {
    // The amplitude of each period is another one, with a standard deviation of a tenth.
    Random random(5);
    std::vector<double> sizes;
    for (int k = 0; k < 40; ++k) sizes.push_back(1.0 + 0.1 * deviate(random));
    Video video;
    for (std::size_t k = 0; k < 2000; ++k) {
        const double turns = double(k) / period;
        video.times.push_back(double(k));
        video.centres.push_back(middle + sizes[std::size_t(turns)] * wave(1, 1, turns));
    }
    const RecordedMotion found = video.motion();
    // Rms of a coordinate: 0.1 √((40² + 30²)/4) = 2.5 pixels, from 31 periods; its relative
    // standard error is 1/√62 = 13 %.
    EXPECT_NEAR(found.scatter, 2.5, 1.0);
    EXPECT_NEAR(found.point_error, found.scatter / std::sqrt(31.0), 1e-9);
}

TEST(RecordedMotion, IsRejectedIfItCannotBeAveraged) {
    using testing::HasSubstr;
    Random random(6);
    const auto ellipse = [](double u) { return wave(1, 1, u); };
    EXPECT_THAT(failure_of(video_of(
                               [](double) {
                                   return Vec2{0.0, 0.0};
                               },
                               300, random),
                           300),
                HasSubstr("stands still"));
    EXPECT_THAT(failure_of(video_of(ellipse, 100, random), 100), HasSubstr("1.57 periods"));
    EXPECT_THAT(failure_of(video_of(ellipse, 300, random), 601), HasSubstr("300 of 601 frames"));
    Video jumping;
    for (std::size_t k = 0; k < 300; ++k) {
        jumping.centres.push_back({100.0 * random.uniform(), 100.0 * random.uniform()});
        jumping.times.push_back(double(k));
    }
    EXPECT_THAT(failure_of(jumping, 300), HasSubstr("does not repeat"));
    // The container is hidden in the same quarter of each period.
    Video hidden, whole = video_of(ellipse, 400, random);
    for (std::size_t k = 0; k < 400; ++k)
        if (const double u = double(k) / period; u - std::floor(u) < 0.75) {
            hidden.centres.push_back(whole.centres[k]);
            hidden.times.push_back(whole.times[k]);
        }
    EXPECT_THAT(failure_of(hidden, 400), HasSubstr("gap"));
}

}  // namespace frame_jumps_tests
}  // namespace swirl::tracking
