#include <gtest/gtest.h>

#include <cmath>

#include "math/deviate.hpp"
#include "swirl/math/random.hpp"
#include "swirl/math/unit_circle.hpp"
#include "track/video/tracking_steps.hpp"

namespace swirl::tracking {
namespace wandering_tests {

/// The rim and one disc of a container that goes round twice, seen by a camera that drifts.
Detections drifting_rims(const Vec2& per_frame, double noise, TrackedVideo& tracked) {
    constexpr int frames = 30;
    Random random(3);
    Detections all;
    for (int k = 0; k < frames; ++k) {
        tracked.times.push_back(k);
        const Vec2 centre = Vec2{320.0, 240.0} + 38.0 * unit_circle(k / 15.0) +
                            (k - 0.5 * (frames - 1)) * per_frame;
        FrameDetections found;
        found.rim.good = true;
        found.rim.centre = centre + noise * Vec2{deviate(random), deviate(random)};
        DetectedParticle disc;
        disc.centre = centre + Vec2{20.0, 0.0};
        found.particles.push_back(disc);
        all.push_back(found);
    }
    return all;
}

TEST(Drift, AtAConstantRateIsRemovedFromAllPositions) {
    TrackedVideo tracked;
    Detections all = drifting_rims({0.4, 0.3}, 0.05, tracked);
    ASSERT_TRUE(remove_drift(all, tracked));
    EXPECT_EQ(tracked.camera.poses.size(), all.size());
    for (std::size_t k = 0; k < all.size(); ++k) {
        const Vec2 still = Vec2{340.0, 240.0} + 38.0 * unit_circle(double(k) / 15.0);
        // The rate errs by 0.05 / √Σt² = 0.001 pixels per frame; at the ends that is 0.016 pixels.
        EXPECT_LT(length(all[k].particles[0].centre - still), 0.06) << k;
    }
}

TEST(Drift, IsNotFoundInNoise) {
    for (const double noise : {0.05, 1.0}) {
        TrackedVideo tracked;
        Detections all = drifting_rims({0.0, 0.0}, noise, tracked);
        EXPECT_FALSE(remove_drift(all, tracked)) << noise;
        EXPECT_TRUE(tracked.camera.poses.empty()) << noise;
    }
}

}  // namespace wandering_tests
}  // namespace swirl::tracking
