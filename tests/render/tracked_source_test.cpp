#include "swirl/render/tracked_source.hpp"

#include <gtest/gtest.h>

#include "swirl/render/still.hpp"
#include "swirl/run/failure.hpp"

namespace swirl {
namespace {

Tracks some_tracks(bool same_discs) {
    Tracks tracks;
    tracks.y_down = true;
    for (int k = 0; k < 5; ++k) {
        TrackFrame frame;
        frame.number = 10 + k;
        frame.id = {3, 8};
        frame.position = {{100.0 + 10.0 * k, 50.0}, {120.0, 60.0}};
        if (!same_discs && k >= 3) {
            frame.id = {8};
            frame.position.erase(frame.position.begin());
        }
        tracks.frames.push_back(frame);
    }
    return tracks;
}

TrackScale some_scale() {
    TrackScale scale;
    scale.frames_per_time = 2.0;
    scale.pixels_per_radius = 10.0;
    scale.swirl_centre = {100.0, 50.0};
    scale.period = 4.0;  // eight frames per period
    scale.amplitude = 1.0;
    scale.container_radius = 8.0;
    return scale;
}

TEST(TrackedSource, CoversAllFrames) {
    const FrameSource source = tracked(some_tracks(true), some_scale(), "tracks");
    EXPECT_NEAR(*source.from, 10.0 / 8.0, 1e-12);
    EXPECT_NEAR(*source.to, 14.0 / 8.0, 1e-12);
    EXPECT_NEAR(source.frames_per_period, 8.0, 1e-12);
    EXPECT_FALSE(source.has_spin);
    EXPECT_FALSE(source.has_orientation);
    EXPECT_FALSE(source.ids);
    // Every frame has the same discs, so they move on straight lines between frames.
    EXPECT_NEAR(source.open()(11.5 / 8.0).position(0).x, 1.5, 1e-12);
}

TEST(TrackedSource, ReturnsTheNearestFrameIfDiscsComeAndGo) {
    const FrameSource source = tracked(some_tracks(false), some_scale(), "tracks");
    const Playback playback = source.open();
    EXPECT_NEAR(playback(11.4 / 8.0).position(0).x, 1.0, 1e-12);
    EXPECT_NEAR(playback(11.6 / 8.0).position(0).x, 2.0, 1e-12);
    EXPECT_EQ(source.ids(11.6 / 8.0), (std::vector<std::int64_t>{3, 8}));
    EXPECT_EQ(playback(13.0 / 8.0).size(), 1u);
    EXPECT_EQ(source.ids(13.0 / 8.0), (std::vector<std::int64_t>{8}));
    Appearance appearance;
    EXPECT_FALSE(problem({source}, appearance));
    appearance.coloring = Coloring::pinned;
    EXPECT_TRUE(problem({source}, appearance));
    appearance.coloring = Coloring::spin;
    EXPECT_TRUE(problem({source}, appearance));
}

TEST(TrackedSource, MissingImagesAreErrors) {
    try {
        tracked(some_tracks(true), some_scale(), "tracks", "/no/such/%03d.png", 5);
        FAIL() << "no exception";
    } catch (const Failure& failure) {
        EXPECT_NE(std::string(failure.what()).find("/no/such/015.png"), std::string::npos)
            << failure.what();
    }
}

TEST(TrackedSource, MotionOfTheCameraMovesTheImageUnderThePositions) {
    Backdrop steady;  // the scale and origin of an image with y down
    steady.origin = {-3.0, 2.0};
    steady.along_x = {0.1, 0.0};
    steady.along_y = {0.0, -0.1};
    ImageMotion motion{5};
    motion.poses = {{{7.0, -4.0}, 1.0, 0.0}, {{2.0, 3.0}, 0.8, 0.6}, {{-1.0, 0.0}, 1.5, 0.5}};
    for (std::int64_t k = 0; k < 3; ++k) {
        const auto& [origin, a, b] = motion.poses[std::size_t(k)];
        const Backdrop moved = motion.applied(steady, 5 + k);
        for (const Vec2& p : {Vec2{0.0, 0.0}, Vec2{12.0, 5.0}}) {
            const Vec2 seen = origin + Vec2{a * p.x - b * p.y, b * p.x + a * p.y};
            const Vec2 expected = steady.origin + p.x * steady.along_x + p.y * steady.along_y;
            const Vec2 found = moved.origin + seen.x * moved.along_x + seen.y * moved.along_y;
            EXPECT_NEAR(found.x, expected.x, 1e-12);  // a few roundings of numbers of order 10
            EXPECT_NEAR(found.y, expected.y, 1e-12);
        }
    }
    for (const std::int64_t frame : {4, 8}) {  // both are outside the tracks
        EXPECT_EQ(motion.applied(steady, frame).origin.x, steady.origin.x);
        EXPECT_EQ(motion.applied(steady, frame).along_x.x, steady.along_x.x);
    }
}

}  // namespace
}  // namespace swirl
