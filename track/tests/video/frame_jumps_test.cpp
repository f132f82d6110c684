#include "track/video/frame_jumps.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "math/deviate.hpp"
#include "swirl/math/random.hpp"
#include "swirl/math/unit_circle.hpp"

namespace swirl::tracking {
namespace {

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

}  // namespace
}  // namespace swirl::tracking
