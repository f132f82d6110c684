// A container whose path is a circle about a centre that wanders, as a hand moves it.
//
// Over about one turn the centre hardly moves, so a circle through the centres of the rim within
// that time gives it, and the phase: the angle of the rim about it. Discs move relative to the
// container, so everything is moved to a path about a fixed centre, which has this phase.
//
// If the motion is even, and a camera drifts that sees nothing at rest, the centre moves on a line.

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "swirl/math/unit_circle.hpp"
#include "track/video/container_path_fit.hpp"
#include "track/video/robust_statistics.hpp"
#include "track/video/tracking_steps.hpp"

namespace swirl::tracking {

namespace {

/// Frames per turn, from the direction of the motion: a slow drift hardly changes it.
double frames_per_turn(const RimCentres& rims) {
    std::vector<double> turns;
    for (std::size_t n = 2; n + 1 < rims.centres.size(); ++n) {
        if (rims.frames[n + 1] != rims.frames[n - 2] + 3) continue;
        const Vec2 before = rims.centres[n] - rims.centres[n - 2],
                   after = rims.centres[n + 1] - rims.centres[n - 1];
        turns.push_back(std::atan2(cross(before, after), dot(before, after)));
    }
    const double turn = turns.empty() ? 0.0 : std::abs(median(turns));
    return turn > 0.0 ? 2.0 * pi / turn : 0.0;
}

/// The centre of a circle through the rims of about one turn around each frame, smoothed.
std::vector<Vec2> local_centres(const RimCentres& rims, std::size_t half) {
    const auto apart = [&](std::size_t n, std::size_t m) {
        return std::max(rims.frames[n], rims.frames[m]) - std::min(rims.frames[n], rims.frames[m]);
    };
    std::vector<Vec2> centres;
    for (std::size_t n = 0; n < rims.centres.size(); ++n) {
        std::vector<Vec2> near;
        for (std::size_t m = 0; m < rims.centres.size(); ++m)
            if (apart(n, m) <= half) near.push_back(rims.centres[m]);
        centres.push_back(circle_through(near).centre);
    }
    std::vector<Vec2> smoothed;
    const double width = 0.5 * double(half);
    for (std::size_t n = 0; n < centres.size(); ++n) {
        Vec2 sum{0.0, 0.0};
        double weights = 0.0;
        for (std::size_t m = 0; m < centres.size(); ++m) {
            const double off = double(apart(n, m)) / width, weight = std::exp(-0.5 * off * off);
            sum = sum + weight * centres[m];
            weights += weight;
        }
        smoothed.push_back((1.0 / weights) * sum);
    }
    return smoothed;
}

}  // namespace

bool remove_wandering(Detections& all, TrackedVideo& tracked) {
    constexpr double one_circle = 0.1;    // scatter about it, of its radius: a motor or a shake
    constexpr double turn_share = 0.55;   // of a turn to each side: more than a whole one
    constexpr std::size_t min_half = 4;   // frames
    constexpr double max_scatter = 0.15;  // about the local circles, of their radius
    constexpr double least_gain = 0.7;    // of the scatter about one circle
    if (!tracked.camera.poses.empty()) return false;
    const RimCentres rims = rim_centres(all, tracked);
    if (rims.centres.size() < 2 * min_half) return false;
    const PathCircle one = circle_through(rims.centres);
    if (one.scatter < std::max(1.0, one_circle * one.radius)) return false;
    const auto half = std::size_t(turn_share * frames_per_turn(rims) + 0.5);
    if (half < min_half || 2 * half > rims.centres.size()) return false;
    const std::vector<Vec2> local = local_centres(rims, half);
    std::vector<double> radii, off;
    for (std::size_t n = 0; n < local.size(); ++n)
        radii.push_back(length(rims.centres[n] - local[n]));
    const double amplitude = median(radii);
    for (const double radius : radii) off.push_back(std::abs(radius - amplitude));
    const double scatter = median(off);
    if (amplitude < min_path_amplitude || scatter > max_scatter * amplitude ||
        scatter > least_gain * one.scatter)
        return false;
    const Vec2 middle = median_point(local);
    std::vector<std::optional<Vec2>> shifts(all.size());
    double square = 0.0;
    for (std::size_t n = 0; n < local.size(); ++n) {
        const Vec2 arm = rims.centres[n] - local[n];
        shifts[rims.frames[n]] =
            rims.centres[n] - middle - (amplitude / std::max(length(arm), 1e-9)) * arm;
        square += dot(local[n] - middle, local[n] - middle) / double(local.size());
    }
    tracked.wandering = std::sqrt(0.5 * square);
    remove_shifts(all, tracked, [&](std::size_t k) { return shifts[k]; });
    return true;
}

bool remove_drift(Detections& all, TrackedVideo& tracked) {
    constexpr int passes = 8;            // the drift and the circle are nearly independent
    constexpr double least_drift = 1.0;  // pixels in the whole video
    constexpr double least_gain = 0.7;   // of the scatter about the path
    if (!tracked.camera.poses.empty()) return false;
    const RimCentres rims = rim_centres(all, tracked);
    if (rims.centres.empty()) return false;
    double middle = 0.0, square = 0.0;
    for (const double time : rims.times) middle += time / double(rims.times.size());
    for (const double time : rims.times) square += (time - middle) * (time - middle);
    if (!(square > 0.0)) return false;
    Vec2 rate{0.0, 0.0};
    double before = 0.0, after = 0.0;
    for (int pass = 0; pass < passes; ++pass) {
        std::vector<Vec2> centres;
        for (std::size_t n = 0; n < rims.centres.size(); ++n)
            centres.push_back(rims.centres[n] - (rims.times[n] - middle) * rate);
        const auto path = fit_container_path(centres, rims.times);
        if (!path) return false;
        Vec2 slope{0.0, 0.0};
        std::vector<double> off;
        for (std::size_t n = 0; n < centres.size(); ++n) {
            const Vec2 residual = centres[n] - path->at(rims.times[n]);
            slope = slope + ((rims.times[n] - middle) / square) * residual;
            off.push_back(length(residual));
        }
        after = median(off);
        if (pass == 0) before = after;
        rate = rate + slope;
    }
    const Vec2 drift = (rims.times.back() - rims.times.front()) * rate;
    if (length(drift) < least_drift || after > least_gain * before) return false;
    remove_shifts(all, tracked, [&](std::size_t k) -> std::optional<Vec2> {
        return (tracked.times[k] - middle) * rate;
    });
    return true;
}

}  // namespace swirl::tracking
