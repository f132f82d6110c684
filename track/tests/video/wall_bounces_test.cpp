#include <gtest/gtest.h>

#include <cmath>

#include "math/deviate.hpp"
#include "swirl/math/random.hpp"
#include "swirl/math/unit_circle.hpp"
#include "track/video/tracking_steps.hpp"

namespace swirl::tracking {
namespace {

/// A disc of radius 15 pixels that flies freely in a swirled container and bounces off its wall,
/// about four times per period.
TrackedVideo bouncing_disc(std::uint64_t seed, double noise) {
    constexpr std::size_t frames = 480;
    constexpr int steps = 50;  // per frame
    constexpr double radius = 15.0, container = 130.0, speed = 8.0;
    TrackedVideo tracked;
    tracked.path.centre = {200.0, 200.0};
    tracked.path.amplitude = 5.0;
    tracked.path.omega = 2.0 * pi / 120.0;
    tracked.radius = radius;
    tracked.number = 1;
    tracked.rim_radius = 136.0;  // the outer edge of the wall
    tracked.errors.assign(frames, {0.05});
    tracked.seen.assign(frames, {1});
    Random random(seed);
    Vec2 p = tracked.path.centre, v = speed * unit_circle(random.uniform());
    for (std::size_t k = 0; k < frames; ++k) {
        tracked.times.push_back(double(k));
        TrackFrame f;
        f.id = {0};
        f.position = {p + noise * Vec2{deviate(random), deviate(random)}};
        f.radius = {radius};
        tracked.tracks.frames.push_back(f);
        for (int s = 0; s < steps; ++s) {
            const double now = double(k) + double(s) / steps;
            p = p + (1.0 / steps) * v;
            const Vec2 out = p - tracked.path.at(now);
            const Vec2 wall =
                0.5 * steps *
                (tracked.path.at(now + 1.0 / steps) - tracked.path.at(now - 1.0 / steps));
            const Vec2 n = (1.0 / length(out)) * out;
            const double approach = dot(v - wall, n);
            if (length(out) > container - radius && approach > 0.0) v = v - 2.0 * approach * n;
        }
    }
    return tracked;
}

TEST(WallBounces, GiveTheContainerRadiusOfFewDiscs) {
    for (const std::uint64_t seed : {1, 2, 3, 4, 5}) {
        TrackedVideo tracked = bouncing_disc(seed, 0.15);
        measure_quality(Detections(tracked.times.size()), tracked);
        EXPECT_TRUE(tracked.wall_reached) << seed;
        set_radii(tracked);
        // The target of the container radius: 0.5 %.
        EXPECT_NEAR(tracked.container_radius, 130.0, 0.005 * 130.0) << seed;
    }
}

TEST(WallBounces, ScatterByTheErrorOfAPosition) {
    // Bounces that agree lie within 0.65 pixels, so larger errors are claimed too small.
    for (const double noise : {0.08, 0.15}) {
        TrackedVideo tracked = bouncing_disc(1, noise);
        measure_quality(Detections(tracked.times.size()), tracked);
        // The claimed error of a coordinate; that of the edges, 0.05, is too small.
        EXPECT_GT(tracked.position_error, 0.7 * noise);
        EXPECT_LT(tracked.position_error, 2.0 * noise);  // flights are extrapolated to the wall
    }
}

}  // namespace
}  // namespace swirl::tracking
