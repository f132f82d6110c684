#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "swirl/math/unit_circle.hpp"
#include "swirl/run/failure.hpp"
#include "track/video/container_path_fit.hpp"
#include "track/video/frame_jumps.hpp"
#include "track/video/robust_statistics.hpp"
#include "track/video/tracking_steps.hpp"

namespace swirl::tracking {

namespace {

/// The centres through a lens that differs by the standard error of its distortion.
///
/// All rims are seen through the same lens. The error of its distortion thus causes no scatter of
/// their centres, and a fit does not include it. The change of the fit is added to the errors.
std::vector<Vec2> through_other_lens(const RimCentres& rims, const TrackedVideo& tracked) {
    Lens other = tracked.lens;
    other.k += tracked.lens.k_error;
    std::vector<Vec2> moved;
    moved.reserve(rims.centres.size());
    for (const Vec2& centre : rims.centres)
        moved.push_back(other.ideal(tracked.lens.image({centre, tracked.rim_radius})).centre);
    return moved;
}

void add_lens_error(const RimCentres& rims, TrackedVideo& tracked) {
    const auto path = fit_container_path(through_other_lens(rims, tracked), rims.times);
    if (!path) return;
    TrackedPath& found = tracked.path;
    const double turned = std::remainder(path->phase - found.phase, 2.0 * pi);
    found.centre_error = std::hypot(found.centre_error, length(path->centre - found.centre));
    found.amplitude_error = std::hypot(found.amplitude_error, path->amplitude - found.amplitude);
    found.omega_error = std::hypot(found.omega_error, path->omega - found.omega);
    found.phase_error = std::hypot(found.phase_error, turned);
}

}  // namespace

RimCentres rim_centres(const Detections& all, const TrackedVideo& tracked) {
    RimCentres rims;
    for (std::size_t k = 0; k < all.size(); ++k) {
        if (!all[k].rim.good) continue;
        rims.centres.push_back(all[k].rim.centre);
        rims.times.push_back(tracked.times[k]);
        rims.frames.push_back(k);
    }
    return rims;
}

namespace {

void fit_path(const RimCentres& rims, TrackedVideo& tracked) {
    const auto path = fit_container_path(rims.centres, rims.times);
    if (!path)
        throw Failure(
            fmt::format("the container was found, but its centre does not move along a circle\n{}",
                        no_circle_hint));
    tracked.path = *path;
    add_lens_error(rims, tracked);
}

}  // namespace

void fit_container_motion(const TrackingSettings& settings, bool uneven_times, Detections& all,
                          TrackedVideo& tracked) {
    RimCentres rims = rim_centres(all, tracked);
    if (set_times_by_phase(settings, rims, tracked)) {
        uneven_times = true;
        rims = rim_centres(all, tracked);
    } else if (uneven_times) {
        reject_time_gaps(settings, rims, tracked);
    }
    fit_path(rims, tracked);
    if (!uneven_times && check_frame_jumps(settings, rims, all, tracked)) {
        rims = rim_centres(all, tracked);
        fit_path(rims, tracked);
    }
    const auto used = static_cast<std::size_t>(
        std::count_if(all.begin(), all.end(), [](const FrameDetections& f) { return f.used; }));
    tracked.rims_missed = used - rims.centres.size();
    tracked.shake = camera_shake(rims.centres, rims.frames, tracked.path);
    if (remove_shake_of_rim(all, tracked)) {
        tracked.shake = 0.0;
        rims = rim_centres(all, tracked);
    }
    std::vector<double> supports;
    for (std::size_t k = 0; k < all.size(); ++k) {
        tracked.rim_offsets.push_back(
            all[k].rim.good ? length(all[k].rim.centre - tracked.container(k)) : -1.0);
        if (all[k].rim.good) supports.push_back(all[k].rim.support);
    }
    tracked.rim_support = quantile(supports, 0.5);
    tracked.rims = std::move(rims);
}

RecordedMotion record_motion(const TrackedVideo& tracked) {
    constexpr int points = 64;
    const RimCentres& rims = tracked.rims;
    const auto frames = static_cast<std::size_t>(tracked.frame_count);
    RecordedMotion motion = average_motion(rims.centres, rims.times, frames);
    if (tracked.lens.k_error > 0.0) {
        const RecordedMotion other =
            average_motion(through_other_lens(rims, tracked), rims.times, frames);
        double square = 0.0;
        for (int k = 0; k < points; ++k) {
            const double share = double(k) / points;
            const Vec2 off = other.offset(share) - motion.offset(share);
            square += 0.5 * dot(off, off) / points;
        }
        motion.point_error = std::hypot(motion.point_error, std::sqrt(square));
        motion.omega_error = std::hypot(motion.omega_error, other.omega - motion.omega);
    }
    // Nearer to a tilted camera, the rim moves farther than the discs' plane (wall_fit.cpp).
    if (tracked.lens.tilted() && tracked.path.amplitude > 0.0)
        if (const auto rim = fit_container_path(rims.centres, rims.times)) {
            const double ratio = tracked.path.amplitude / rim->amplitude;
            for (auto* part : {&motion.cosine, &motion.sine})
                for (Vec2& v : *part) v = ratio * v;
            motion.point_error =
                std::hypot(ratio * motion.point_error, tracked.path.amplitude_error);
        }
    return motion;
}

}  // namespace swirl::tracking
