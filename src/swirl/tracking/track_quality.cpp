#include <algorithm>
#include <cmath>

#include "swirl/math/unit_circle.hpp"
#include "swirl/tracking/robust_statistics.hpp"
#include "swirl/tracking/tracking_steps.hpp"

namespace swirl {

namespace {

/// Discs in contact: the mean gap is 0, and half of the gaps are negative by errors of positions.
void measure_contacts(const std::vector<double>& gaps, TrackedVideo& tracked) {
    constexpr std::size_t min_gaps = 100, min_overlaps = 50;  // for an onset; for a median
    constexpr double window = 0.02;                           // radii
    if (gaps.size() > min_gaps && !tracked.contact_fitted)
        tracked.contact_ratio = 1.0 + onset(gaps, window * tracked.radius) / (2.0 * tracked.radius);
    if (tracked.overlap_error > 0.0) return;  // known from the distances of contact, and better
    std::vector<double> overlaps;
    for (const double g : gaps)
        if (g < 0.0) overlaps.push_back(-g);
    if (overlaps.size() > min_overlaps)
        tracked.overlap_error = mad_to_sigma * quantile(overlaps, 0.5) / std::sqrt(2.0);
}

/// How far out the wall lets discs come, given the outermost disc of each frame. With many discs
/// one is at the wall in most frames. With few, only the largest reaches are touches of the wall.
void set_reach(const std::vector<double>& reaches, TrackedVideo& tracked) {
    constexpr double most_frames = 0.8, nearly_all_frames = 0.98;
    constexpr double same_reach = 0.005;    // relative
    constexpr double touches_needed = 3.0;  // per period
    tracked.reach = quantile(reaches, most_frames);
    const double farthest = quantile(reaches, nearly_all_frames);
    // If circles are only parts of discs, the farthest ones may be noise.
    if (farthest > (1.0 + same_reach) * tracked.reach && tracked.spacing == 1.0)
        tracked.reach = farthest;
    double touches = 0.0;
    for (std::size_t k = 1; k + 1 < reaches.size(); ++k)
        if (reaches[k] > reaches[k - 1] && reaches[k] >= reaches[k + 1] &&
            reaches[k] > (1.0 - same_reach) * tracked.reach)
            touches += 1.0;
    const double periods =
        double(reaches.size()) * tracked.step() * tracked.path.omega / (2.0 * pi);
    tracked.wall_reached = touches >= touches_needed * periods;
}

}  // namespace

void measure_quality(const Detections& all, TrackedVideo& tracked) {
    constexpr double near = 0.25;  // radii between neighbours, for statistics of contacts
    constexpr double no_neighbour = 1e300;
    std::size_t complete = 0, count = 0, used = 0;
    double square = 0.0;
    std::vector<double> reaches, gaps;  // gaps: to the nearest disc
    for (std::size_t k = 0; k < all.size(); ++k) {
        const TrackFrame& f = tracked.tracks.frames[k];
        const std::vector<std::uint8_t>& seen = tracked.seen[k];
        if (all[k].used) ++used;
        if (std::size_t(std::count(seen.begin(), seen.end(), 1)) == tracked.number) ++complete;
        double reach = 0.0;
        const Vec2 c = tracked.container(k);
        for (std::size_t i = 0; i < f.id.size(); ++i) {
            if (!seen[i]) continue;
            square += tracked.errors[k][i] * tracked.errors[k][i];
            ++count;
            reach = std::max(reach, length(f.position[i] - c) + f.radius[i]);
            double nearest = no_neighbour;
            for (std::size_t j = 0; j < f.id.size(); ++j)
                if (j != i && seen[j])
                    nearest = std::min(
                        nearest, length(f.position[i] - f.position[j]) - f.radius[i] - f.radius[j]);
            if (std::abs(nearest) < near * f.radius[i]) gaps.push_back(nearest);
        }
        if (reach > 0.0) reaches.push_back(reach);
    }
    tracked.complete_share = double(complete) / double(std::max<std::size_t>(used, 1));
    tracked.position_error = count ? std::sqrt(square / double(count)) : 0.0;
    set_reach(reaches, tracked);
    measure_contacts(gaps, tracked);
    // An edge determines how far its rays scatter, but not what shade, texture and compression do
    // to all of them at once. If overlaps imply larger errors, these replace those of the edges.
    // The rays of a soft edge scatter by more than the circle errs, so a fit to all distances
    // replaces larger ones, too.
    if (!(tracked.position_error > 0.0)) return;
    double error = tracked.overlap_error > tracked.position_error || tracked.contact_fitted
                       ? tracked.overlap_error
                       : tracked.position_error;
    // All discs share the error of a shift that was removed, so overlaps do not contain it.
    error = std::hypot(error, tracked.shading_shift_error);
    if (error == tracked.position_error) return;
    for (auto& errors : tracked.errors)
        for (double& one : errors) one *= error / tracked.position_error;
    tracked.position_error = error;
}

void set_radii(TrackedVideo& tracked) {
    // Contact ratios within max_off of 1 are correct, and ratios below min_ratio are implausible. A
    // fit to all distances has an error of about 0.2 %.
    const double max_off = tracked.contact_fitted ? 0.004 : 0.02, min_ratio = 0.5;
    constexpr double same_radius = 0.06;  // disc radii
    // If edges are soft, the shaded side of a ball looks like the floor, and the ball too small.
    if (std::abs(tracked.contact_ratio - 1.0) > max_off && tracked.contact_ratio > min_ratio) {
        tracked.reach += (tracked.contact_ratio - 1.0) * tracked.radius;
        tracked.radius *= tracked.contact_ratio;
        for (TrackedSpecies& species : tracked.species) species.radius *= tracked.contact_ratio;
        for (TrackFrame& f : tracked.tracks.frames)
            for (double& radius : f.radius) radius *= tracked.contact_ratio;
    }
    // The wall is where discs are stopped; the visible rim may be the wall's outer edge or its top.
    // In most frames some disc is at the wall, unless the discs are few: then their reach does not
    // determine the wall.
    const bool agree = std::abs(tracked.rim_radius - tracked.reach) < same_radius * tracked.radius;
    const bool too_few = !tracked.wall_reached && tracked.rim_radius > tracked.reach;
    tracked.container_radius = agree || too_few ? tracked.rim_radius : tracked.reach;
}

}  // namespace swirl
