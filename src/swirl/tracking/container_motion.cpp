#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "swirl/math/unit_circle.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/tracking/container_path_fit.hpp"
#include "swirl/tracking/frame_jumps.hpp"
#include "swirl/tracking/robust_statistics.hpp"
#include "swirl/tracking/tracking_steps.hpp"

namespace swirl {

namespace {

/// All rims are seen through the same lens. The error of its distortion thus causes no scatter of
/// their centres, and the fit of the path does not include it. The change of the path through a
/// lens that differs by the standard error is added to the errors.
void add_lens_error(const RimCentres& rims, TrackedVideo& tracked) {
    Lens other = tracked.lens;
    other.k += tracked.lens.k_error;
    std::vector<Vec2> moved;
    moved.reserve(rims.centres.size());
    for (const Vec2& centre : rims.centres)
        moved.push_back(other.ideal(tracked.lens.image({centre, tracked.rim_radius})).centre);
    const auto path = fit_container_path(moved, rims.times);
    if (!path) return;
    TrackedPath& found = tracked.path;
    const double turned = std::remainder(path->phase - found.phase, 2.0 * pi);
    found.centre_error = std::hypot(found.centre_error, length(path->centre - found.centre));
    found.amplitude_error = std::hypot(found.amplitude_error, path->amplitude - found.amplitude);
    found.omega_error = std::hypot(found.omega_error, path->omega - found.omega);
    found.phase_error = std::hypot(found.phase_error, turned);
}

}  // namespace

namespace {

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
    if (uneven_times) reject_time_gaps(settings, rims, tracked);
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
    tracked.polygon = find_path_polygon(rims.centres, rims.times, tracked.path);
    std::vector<double> supports;
    for (std::size_t k = 0; k < all.size(); ++k) {
        tracked.rim_offsets.push_back(
            all[k].rim.good ? length(all[k].rim.centre - tracked.container(k)) : -1.0);
        if (all[k].rim.good) supports.push_back(all[k].rim.support);
    }
    tracked.rim_support = quantile(supports, 0.5);
}

}  // namespace swirl
