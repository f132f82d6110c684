// Tracks at uneven times, of a disc that goes round in a container that goes round.
#include "swirl/io/equal_steps.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "swirl/io/seen_container.hpp"

namespace swirl {
namespace {

constexpr double radius = 80.0;     // pixels, of the disc's path in the container
constexpr double rotations = 0.35;  // those of the disc, relative to the container's

TrackScale scale() {
    TrackScale scale;
    scale.frames_per_time = 30.0;
    scale.period = 0.5;
    scale.pixels_per_radius = 20.0;
    scale.amplitude = 1.5;
    scale.phase = 0.4;
    scale.swirl_centre = {320.0, 240.0};
    return scale;
}

Vec2 truth(double time, const TrackScale& scale) {
    const double angle = 2.0 * pi * rotations * time / scale.period;
    return SeenContainer(scale, true).position(time) +
           radius * Vec2{std::cos(angle), -std::sin(angle)};
}

/// Frames as of a swirl by hand: the step changes by a fourth, with a rest in the middle.
Tracks uneven(const TrackScale& scale) {
    Tracks tracks;
    tracks.y_down = true;
    double time = 0.0;
    for (int k = 0; k < 90; ++k) {
        TrackFrame frame;
        frame.number = k;
        frame.id = {4};
        frame.time = time;
        frame.position = {truth(time, scale)};
        tracks.frames.push_back(frame);
        const bool rests = k >= 40 && k < 60;
        time += rests ? 1e-6 : (1.0 + 0.25 * std::sin(0.3 * k)) / scale.frames_per_time;
    }
    return tracks;
}

TEST(EqualSteps, UnevenFramesAreInterpolated) {
    const TrackScale s = scale();
    const Tracks found = at_equal_steps(uneven(s), s);
    // 70 frames show the motion, and the first and the last step may be cut.
    EXPECT_NEAR(double(found.frames.size()), 70.0, 3.0);
    for (const TrackFrame& frame : found.frames) {
        EXPECT_FALSE(frame.time.has_value());
        ASSERT_EQ(frame.position.size(), 1u);
        const Vec2 off = frame.position[0] - truth(double(frame.number) / s.frames_per_time, s);
        // A cubic errs by h⁴ r ω⁴/384 = 0.001 pixels; its slopes, from differences over steps that
        // differ by up to a half at the rest, by a few times h² r ω² / 8 · 0.5 = 0.1 pixels.
        EXPECT_LT(std::sqrt(dot(off, off)), 0.4) << frame.number;
    }
}

TEST(EqualSteps, FramesWithoutTimesAreUnchanged) {
    const TrackScale s = scale();
    Tracks even = uneven(s);
    for (TrackFrame& frame : even.frames) frame.time.reset();
    const Tracks found = at_equal_steps(even, s);
    ASSERT_EQ(found.frames.size(), even.frames.size());
    EXPECT_EQ(found.frames[7].position[0].x, even.frames[7].position[0].x);
}

}  // namespace
}  // namespace swirl
