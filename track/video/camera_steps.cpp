#include <algorithm>
#include <cmath>

#include "track/video/camera_motion.hpp"
#include "track/video/frame_jumps.hpp"
#include "track/video/robust_statistics.hpp"
#include "track/video/tracking_steps.hpp"

namespace swirl::tracking {

void collect_camera_motion(Detections& all, TrackedVideo& tracked) {
    std::optional<CameraPose> last;
    for (const FrameDetections& found : all)
        if (!last && found.pose) last = found.pose;
    if (!last) return;
    for (FrameDetections& found : all) {
        if (!found.pose && found.used) {
            found.discard();
            ++tracked.frames_without_pose;
        }
        if (found.pose) last = found.pose;
        tracked.camera.poses.push_back(*last);
    }
    measure_camera_motion(tracked.camera);
}

namespace {

/// Second difference of the centres of frames k − 1, k and k + 1, and the mean one of the discs. A
/// disc is the nearest one, after a motion with the container.
struct Bend {
    Vec2 rim, discs;
};

std::optional<Bend> bend_at(const Detections& all, std::size_t k) {
    constexpr double max_distance =
        0.4;  // share of the distance to the nearest other disc of the frame
    const FrameDetections &before = all[k - 1], &now = all[k], &after = all[k + 1];
    if (!before.rim.good || !now.rim.good || !after.rim.good) return std::nullopt;
    const auto nearest = [](const FrameDetections& found, const Vec2& to, double closest) {
        const DetectedParticle* best = nullptr;
        for (const DetectedParticle& p : found.particles)
            if (p.sure && length(p.centre - to) < closest) {
                best = &p;
                closest = length(p.centre - to);
            }
        return best;
    };
    std::vector<double> x, y;
    for (const DetectedParticle& p : now.particles) {
        if (!p.sure) continue;
        double spacing = 1e300;
        for (const DetectedParticle& other : now.particles)
            if (&other != &p && other.sure)
                spacing = std::min(spacing, length(other.centre - p.centre));
        if (spacing == 1e300) continue;
        const Vec2 relative = p.centre - now.rim.centre;
        const DetectedParticle* one =
            nearest(before, before.rim.centre + relative, max_distance * spacing);
        const DetectedParticle* other =
            nearest(after, after.rim.centre + relative, max_distance * spacing);
        if (!one || !other) continue;
        const Vec2 bend = one->centre - 2.0 * p.centre + other->centre;
        x.push_back(bend.x);
        y.push_back(bend.y);
    }
    constexpr std::size_t min_discs = 3;
    if (x.size() < min_discs) return std::nullopt;
    return Bend{before.rim.centre - 2.0 * now.rim.centre + after.rim.centre,
                {median(x), median(y)}};
}

}  // namespace

bool remove_shake_of_rim(Detections& all, TrackedVideo& tracked) {
    constexpr double min_shake = 0.5;  // pixels: below, the rim itself errs
    constexpr double min_slope = 0.6;  // 1 if the camera shakes, 0 if the rim errs
    if (tracked.shake < min_shake || !tracked.camera.poses.empty()) return false;
    double product = 0.0, square = 0.0;
    for (std::size_t k = 1; k + 1 < all.size(); ++k)
        if (const auto bend = bend_at(all, k)) {
            product += dot(bend->rim, bend->discs);
            square += dot(bend->rim, bend->rim);
        }
    if (product < min_slope * square || !(square > 0.0)) return false;
    Vec2 last{0.0, 0.0};
    for (std::size_t k = 0; k < all.size(); ++k) {
        FrameDetections& found = all[k];
        if (found.rim.good) last = found.rim.centre - tracked.container(k);
        CameraPose pose;
        pose.shift = last;
        tracked.camera.poses.push_back(pose);
        found.rim.centre = found.rim.centre - last;
        for (DetectedParticle& p : found.particles) p.centre = p.centre - last;
    }
    tracked.camera.from_rim = true;
    measure_camera_motion(tracked.camera);
    return true;
}

}  // namespace swirl::tracking
