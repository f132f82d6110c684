#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "swirl/math/unit_circle.hpp"
#include "swirl/run/failure.hpp"
#include "track/video/camera_motion.hpp"
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

/// Moves all positions to the times of their frames if the shutter rolls. True if it did.
bool remove_rolling_shutter(Detections& all, TrackedVideo& tracked) {
    constexpr double longest = 1.0, stands_out = 4.0;  // frame intervals; standard errors
    const Lens& lens = tracked.lens;
    if (!lens.rolls()) return false;
    const double pixels = lens.shutter.x != 0.0 ? tracked.width : tracked.height,
                 turn = tracked.path.omega * tracked.step();
    tracked.readout = pixels * length(lens.shutter) / turn;
    tracked.readout_error = pixels * lens.shutter_error / turn;
    if (tracked.readout > longest + stands_out * tracked.readout_error)
        return tracked.readout = 0.0, false;
    tracked.shutter =
        (1.0 / (tracked.path.clockwise ? tracked.path.omega : -tracked.path.omega)) * lens.shutter;
    for (std::size_t k = 0; k < all.size(); ++k) {
        remove_delay(tracked, k, all[k].rim.centre);
        for (DetectedParticle& p : all[k].particles) p.delay = remove_delay(tracked, k, p.centre);
    }
    return true;
}

[[noreturn]] void reject_path(const RimCentres& rims) {
    const PathCircle circle = circle_through(rims.centres);
    throw Failure(fmt::format(
        "no dish was found: the centre of the clearest circle does not move along a circle: it is "
        "{:.1f} pixels off the one that fits best, whose radius is {:.1f} pixels\n{}",
        circle.scatter, circle.radius, no_circle_hint));
}

void fit_path(const RimCentres& rims, TrackedVideo& tracked) {
    const auto path = fit_container_path(rims.centres, rims.times);
    if (!path) reject_path(rims);
    tracked.path = *path;
    add_lens_error(rims, tracked);
}

/// Second difference of the centres of frames k − 1, k and k + 1, and the mean one of the discs. A
/// disc is the nearest one, after a motion with the container.
struct Bend {
    Vec2 rim, discs;
};

std::optional<Bend> bend_at(const Detections& all, std::size_t k) {
    constexpr double max_distance = 0.4;  // share of the distance to the nearest other disc
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

double remove_delay(const TrackedVideo& tracked, std::size_t frame, Vec2& position) {
    if (!(tracked.readout > 0.0)) return 0.0;
    double delay = dot(tracked.shutter, tracked.lens.seen(position) - tracked.lens.image_centre);
    // A time by the phase stands still while the container rests.
    if (tracked.by_phase) {
        const std::size_t before = frame > 0 ? frame - 1 : 0,
                          after = std::min(frame + 1, tracked.times.size() - 1);
        delay *= (tracked.times[after] - tracked.times[before]) /
                 (double(after - before) * tracked.step());
    }
    position = position + tracked.container(frame) - tracked.path.at(tracked.times[frame] + delay);
    return delay;
}

Vec2 put_back(const TrackedVideo& tracked, std::size_t frame, const Vec2& position) {
    constexpr int passes = 3;  // of a fixed-point iteration; the row changes by a few pixels
    Vec2 seen = position;
    for (int pass = 0; pass < passes && tracked.readout > 0.0; ++pass) {
        Vec2 back = seen;
        remove_delay(tracked, frame, back);
        seen = seen + position - back;
    }
    return seen;
}

void fit_container_motion(const TrackingSettings& settings, const ContainerRim& survey,
                          bool uneven_times, Detections& all, TrackedVideo& tracked) {
    const bool wanders = remove_wandering(all, tracked) || remove_drift(all, tracked);
    RimCentres rims = rim_centres(all, tracked);
    if (survey.rough && !wanders) reject_path(rims);
    if (set_times_by_phase(settings, rims, tracked)) {
        uneven_times = true;
        rims = rim_centres(all, tracked);
    } else if (uneven_times) {
        reject_time_gaps(settings, rims, tracked);
    }
    tracked.rims = rims;
    fit_path(rims, tracked);
    if (!uneven_times && check_frame_jumps(settings, rims, all, tracked)) {
        rims = rim_centres(all, tracked);
        fit_path(rims, tracked);
    }
    if (remove_rolling_shutter(all, tracked)) {
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

bool remove_shake_of_rim(Detections& all, TrackedVideo& tracked) {
    constexpr double min_shake = 0.5;  // pixels: below, the rim itself errs
    constexpr double min_slope = 0.6;  // 1 if the camera shakes, 0 if the rim errs
    const bool known = !tracked.camera.poses.empty() && !tracked.camera.from_rim;
    if (tracked.shake < min_shake || known || tracked.wandering > 0.0) return false;
    double product = 0.0, square = 0.0;
    for (std::size_t k = 1; k + 1 < all.size(); ++k)
        if (const auto bend = bend_at(all, k)) {
            product += dot(bend->rim, bend->discs);
            square += dot(bend->rim, bend->rim);
        }
    if (product < min_slope * square || !(square > 0.0)) return false;
    remove_shifts(all, tracked, [&](std::size_t k) -> std::optional<Vec2> {
        if (!all[k].rim.good) return std::nullopt;
        return all[k].rim.centre - tracked.container(k);
    });
    return true;
}

}  // namespace swirl::tracking
