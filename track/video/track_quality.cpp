#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "track/video/contact_distance.hpp"
#include "track/video/robust_statistics.hpp"
#include "track/video/tracking_steps.hpp"

namespace swirl::tracking {

namespace {

constexpr double same_reach = 0.005;    // relative: touches of one wall
constexpr double touches_needed = 3.0;  // touches per period

/// Positions of one disc that was seen in successive frames.
struct SeenDisc {
    std::vector<std::size_t> frames;
    std::vector<Vec2> positions;
    double radius = 0.0;
};

std::vector<SeenDisc> seen_discs(const TrackedVideo& tracked) {
    std::map<std::int64_t, SeenDisc> discs;
    for (std::size_t k = 0; k < tracked.tracks.frames.size(); ++k) {
        const TrackFrame& f = tracked.tracks.frames[k];
        for (std::size_t i = 0; i < f.id.size(); ++i) {
            if (!tracked.seen[k][i]) continue;
            SeenDisc& disc = discs[f.id[i]];
            disc.frames.push_back(k);
            disc.positions.push_back(f.position[i]);
            disc.radius = f.radius[i];
        }
    }
    std::vector<SeenDisc> result;
    for (auto& [id, disc] : discs) result.push_back(std::move(disc));
    return result;
}

/// A disc bounces off the wall between frames j and j + 1. Its straight flights before and after
/// meet at the wall: returns their distance from the container's centre there.
std::optional<double> bounce(const SeenDisc& disc, std::size_t j, const TrackedVideo& tracked) {
    constexpr std::size_t rising = 2;  // frames before and after, in which the distance changes
    constexpr int steps = 40;          // steps of the time between the two frames
    if (j < rising || j + 1 + rising >= disc.frames.size() ||
        disc.frames[j + 1 + rising] - disc.frames[j - rising] != 2 * rising + 1)
        return std::nullopt;
    const auto distance = [&](std::size_t at) {
        return length(disc.positions[at] - tracked.container(disc.frames[at]));
    };
    for (std::size_t n = 0; n < rising; ++n)
        if (distance(j - n) <= distance(j - n - 1) || distance(j + 1 + n) <= distance(j + 2 + n))
            return std::nullopt;
    const Vec2 before = disc.positions[j] - disc.positions[j - 1],
               after = disc.positions[j + 1] - disc.positions[j + 2];
    const double start = tracked.times[disc.frames[j]], end = tracked.times[disc.frames[j + 1]];
    double previous = 0.0;
    for (int n = 0; n <= steps; ++n) {
        const double u = double(n) / steps;
        const Vec2 centre = tracked.path.at(start + u * (end - start));
        const double incoming = length(disc.positions[j] + u * before - centre),
                     outgoing = length(disc.positions[j + 1] + (1.0 - u) * after - centre);
        if (n > 0 && previous * (incoming - outgoing) <= 0.0)
            return 0.5 * (incoming + outgoing) + disc.radius;
        previous = incoming - outgoing;
    }
    return std::nullopt;
}

struct BouncedWall {
    double reach = 0.0;    // distance of the wall from the container's centre
    double scatter = 0.0;  // scatter of single bounces: about the error of a coordinate
};

/// The wall from discs that bounce off it: the distance at which most bounces agree. None if these
/// are less than three per period. Bounces off other discs are at many smaller distances.
std::optional<BouncedWall> wall_from_bounces(const TrackedVideo& tracked, double periods) {
    std::vector<double> bounces;
    for (const SeenDisc& disc : seen_discs(tracked))
        for (std::size_t j = 0; j < disc.frames.size(); ++j)
            if (const auto at = bounce(disc, j, tracked)) bounces.push_back(*at);
    std::sort(bounces.begin(), bounces.end());
    std::vector<double> most;
    for (auto first = bounces.begin(); first != bounces.end(); ++first) {
        const auto end = std::upper_bound(first, bounces.end(), (1.0 + same_reach) * *first);
        if (end - first >= std::ptrdiff_t(most.size())) most.assign(first, end);
    }
    if (double(most.size()) < std::max(touches_needed, touches_needed * periods))
        return std::nullopt;
    BouncedWall wall{quantile(most, 0.5), 0.0};
    for (double& b : most) b = std::abs(b - wall.reach);
    wall.scatter = mad_to_sigma * quantile(most, 0.5);
    return wall;
}

/// How far out the wall lets discs come, given the outermost disc of each frame. With many discs
/// one is at the wall in most frames. Few discs only bounce off it, and mostly between two frames.
void set_reach(const std::vector<double>& reaches, TrackedVideo& tracked) {
    constexpr double most_frames = 0.8, nearly_all_frames = 0.98;
    tracked.reach = quantile(reaches, most_frames);
    const double farthest = quantile(reaches, nearly_all_frames);
    // If circles are only parts of discs, the farthest ones may be noise.
    const bool few = farthest > (1.0 + same_reach) * tracked.reach && tracked.spacing == 1.0;
    if (few) tracked.reach = farthest;
    double touches = 0.0;
    for (std::size_t k = 1; k + 1 < reaches.size(); ++k)
        if (reaches[k] > reaches[k - 1] && reaches[k] >= reaches[k + 1] &&
            reaches[k] > (1.0 - same_reach) * tracked.reach)
            touches += 1.0;
    const double periods = tracked.periods();
    tracked.wall_reached = touches >= touches_needed * periods;
    if (!few) return;
    if (const auto wall = wall_from_bounces(tracked, periods)) {
        tracked.reach = wall->reach;
        tracked.wall_reached = true;
        if (!tracked.contact_fitted) tracked.overlap_error = wall->scatter;
    }
}

}  // namespace

void find_contacts(TrackedVideo& tracked) {
    std::vector<double> distances;
    for (std::size_t k = 0; k < tracked.seen.size(); ++k) {
        if (tracked.rests_in(k)) continue;  // the same distances again and again
        const TrackFrame& f = tracked.tracks.frames[k];
        for (std::size_t a = 0; a < f.id.size(); ++a)
            for (std::size_t b = a + 1; b < f.id.size() && tracked.seen[k][a]; ++b) {
                const double ratio = length(f.position[a] - f.position[b]) /
                                     (tracked.spacing * (f.radius[a] + f.radius[b]));
                if (tracked.seen[k][b] && std::abs(ratio - 1.0) < contact_range)
                    distances.push_back(ratio);
            }
    }
    // Without outliers, a few distances far below the contact decide the error of all others.
    const auto found = contact_of_discs(distances, tracked.contact_at_wall / tracked.spacing, 3e-4);
    if (!found) return;
    tracked.contact_ratio = found->at * tracked.spacing;
    tracked.contact_fitted = true;
    // In pixels, a distance errs by 2 radii times this; a coordinate by that divided by √2.
    tracked.overlap_error = found->error * tracked.spacing * tracked.radius * std::sqrt(2.0);
}

void measure_quality(const Detections& all, TrackedVideo& tracked) {
    std::size_t count = 0, used = 0;
    double complete = 0.0;
    double square = 0.0;
    std::vector<double> reaches;
    for (std::size_t k = 0; k < all.size(); ++k) {
        const TrackFrame& f = tracked.tracks.frames[k];
        const std::vector<std::uint8_t>& seen = tracked.seen[k];
        const double all_seen = tracked.number_seen(k) == tracked.number ? 1.0 : 0.0;
        complete += all_seen;
        if (all[k].used) ++used;
        if (all[k].used && is_whole(tracked, tracked.radius, k))
            tracked.whole += 1.0, tracked.complete_whole += all_seen;
        double reach = 0.0;
        const Vec2 c = tracked.container(k);
        for (std::size_t i = 0; i < f.id.size(); ++i) {
            if (!seen[i]) continue;
            square += tracked.errors[k][i] * tracked.errors[k][i];
            ++count;
            reach = std::max(reach, length(f.position[i] - c) + f.radius[i]);
        }
        // At rest, discs lie where they stopped.
        if (reach > 0.0 && !tracked.rests_in(k)) reaches.push_back(reach);
    }
    tracked.complete_share = complete / double(std::max<std::size_t>(used, 1));
    tracked.position_error = count ? std::sqrt(square / double(count)) : 0.0;
    set_reach(reaches, tracked);
    // An edge determines how far its rays scatter, but not what shade, texture and compression do
    // to all of them at once. If overlaps imply larger errors, these replace those of the edges.
    // The rays of a soft edge scatter by more than the circle errs, so a fit to all distances
    // replaces larger ones, too.
    if (!(tracked.position_error > 0.0)) return;
    // That of an interpolation against a rolling shutter is largest for discs that are not in
    // contact.
    double error = tracked.contact_fitted && !(tracked.readout > 0.0)
                       ? tracked.overlap_error
                       : std::max(tracked.overlap_error, tracked.position_error);
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
    // What shifts an edge by light, texture and compression changes the radius, too: on average by
    // a quarter, in eleven videos with known radii. A rim that no disc confirms may be any edge
    // between the reach of the discs and the rim.
    constexpr double fit_error = 0.002, share_of_position = 0.25, share_at_wall = 0.5;
    tracked.radius_error =
        std::hypot(fit_error * tracked.radius, share_of_position * tracked.position_error);
    tracked.container_radius_error = std::hypot(share_at_wall * tracked.position_error,
                                                too_few ? tracked.rim_radius - tracked.reach : 0.0);
}

}  // namespace swirl::tracking
