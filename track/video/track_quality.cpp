#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "track/video/contact_distance.hpp"
#include "track/video/robust_statistics.hpp"
#include "track/video/tracking_steps.hpp"

namespace swirl::tracking {

namespace {

constexpr double same_reach = 0.005;      // relative: touches of one wall
constexpr double touches_needed = 3.0;    // touches per period
constexpr double fitted_contact = 0.002;  // error of a contact ratio from all distances

struct BouncedWall {
    double reach = 0.0;    // distance of the wall from the container's centre
    double scatter = 0.0;  // scatter of single bounces: about the error of a coordinate
};

/// The wall from discs that bounce off it: the distance at which most bounces agree. None if these
/// are less than three per period. Bounces off other discs are at many smaller distances.
std::optional<BouncedWall> wall_from_bounces(const TrackedVideo& tracked, double periods) {
    std::vector<double> bounces;
    for (const Bounce& bounce : find_bounces(tracked))
        bounces.push_back(length(bounce.from_centre) + bounce.radius);
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
    const double at_wall = std::max(same_reach * tracked.reach, 2.0 * tracked.overlap_error);
    double touches = 0.0;
    for (std::size_t k = 1; k + 1 < reaches.size(); ++k)
        if (reaches[k] > reaches[k - 1] && reaches[k] >= reaches[k + 1] &&
            reaches[k] > tracked.reach - at_wall)
            touches += 1.0;
    const double periods = tracked.periods();
    tracked.wall_reached = touches >= touches_needed * periods;
    if (!few) return;
    if (const auto wall = wall_from_bounces(tracked, periods)) {
        tracked.reach = wall->reach;
        tracked.wall_reached = true;
        if (!tracked.contact_fitted) tracked.bounce_error = wall->scatter;
    }
}

/// The error of a coordinate from free flights: the least difference of second and third order that
/// a fourth of the positions has, without the share of the container's motion that its floor gives.
/// 0 if there are too few positions.
double error_from_flights(const TrackedVideo& tracked) {
    constexpr std::size_t least = 40;           // differences
    constexpr double undisturbed = 0.25;        // share of the positions
    constexpr double length_at_share = 0.7585;  // of two normal deviates: √(−2 ln 0.75)
    constexpr int shares = 20;                  // of the container's motion, from 0 to 1
    constexpr double orders[2][4] = {{1.0, -2.0, 1.0, 0.0}, {1.0, -3.0, 3.0, -1.0}};
    const std::vector<SeenDisc> discs = seen_discs(tracked);
    double error = 1e300;
    for (const auto& weights : orders) {
        double norm = 0.0;
        for (const double weight : weights) norm += weight * weight;
        const std::size_t points = weights[3] == 0.0 ? 3 : 4;
        std::vector<Vec2> own, floor;
        for (const SeenDisc& disc : discs)
            for (std::size_t j = 0; j + points <= disc.frames.size(); ++j) {
                if (disc.frames[j + points - 1] - disc.frames[j] != points - 1) continue;
                Vec2 of_disc{0.0, 0.0}, of_floor{0.0, 0.0};
                for (std::size_t n = 0; n < points; ++n) {
                    of_disc = of_disc + weights[n] * disc.positions[j + n];
                    of_floor = of_floor + weights[n] * tracked.container(disc.frames[j + n]);
                }
                own.push_back(of_disc);
                floor.push_back(of_floor);
            }
        if (own.size() < least) continue;
        for (int n = 0; n <= shares; ++n) {
            std::vector<double> lengths;
            for (std::size_t k = 0; k < own.size(); ++k)
                lengths.push_back(length(own[k] - (double(n) / shares) * floor[k]));
            error = std::min(error,
                             quantile(lengths, undisturbed) / (length_at_share * std::sqrt(norm)));
        }
    }
    return error < 1e300 ? error : 0.0;
}

/// The error of a coordinate without its part that the edges show.
void set_overlap_error(TrackedVideo& tracked) {
    // Bounces all around the wall scatter by a shift by light, too.
    if (tracked.contact_fitted || tracked.bounce_error > 0.0) {
        if (!tracked.contact_fitted) tracked.overlap_error = tracked.bounce_error;
        return;
    }
    // An outline that no contact confirms may be wrong on one side: then its centre is, too.
    const double one_side = std::sqrt(0.5) * tracked.contact_error * tracked.radius;
    tracked.overlap_error = std::hypot(error_from_flights(tracked), one_side);
}

/// Two discs near each other.
struct Encounter {
    std::size_t last_frame = 0, index = 0;
    double nearest = 2.0;  // ratio of their distance to the sum of radii, of all encounters
};

/// Within which factor an error from the distances of this many pairs of discs is right, in nearly
/// all of 23 videos.
double factor_of_error(double overlapping_pairs) {
    return std::exp(1.5 / std::sqrt(std::max(overlapping_pairs, 1.0)));
}

}  // namespace

void find_contacts(TrackedVideo& tracked) {
    std::vector<double> distances;
    std::vector<std::vector<double>> encounters;
    std::map<std::pair<std::int64_t, std::int64_t>, Encounter> near;
    double square = 0.0, positions = 0.0;
    for (std::size_t k = 0; k < tracked.seen.size(); ++k) {
        if (tracked.rests_in(k)) continue;  // the same distances again and again
        const TrackFrame& f = tracked.tracks.frames[k];
        for (std::size_t a = 0; a < f.id.size(); ++a) {
            if (!tracked.seen[k][a]) continue;
            square += tracked.errors[k][a] * tracked.errors[k][a];
            positions += 1.0;
            for (std::size_t b = a + 1; b < f.id.size(); ++b) {
                const double ratio = length(f.position[a] - f.position[b]) /
                                     (tracked.spacing * (f.radius[a] + f.radius[b]));
                if (!tracked.seen[k][b] || std::abs(ratio - 1.0) >= contact_range) continue;
                distances.push_back(ratio);
                if (std::abs(ratio - 1.0) >= few_range) continue;
                const auto [at, first] = near.try_emplace({f.id[a], f.id[b]}, Encounter{});
                Encounter& encounter = at->second;
                if (first || k > encounter.last_frame + 1) {
                    encounter.index = encounters.size();
                    encounters.emplace_back();
                }
                encounter.last_frame = k;
                encounter.nearest = std::min(encounter.nearest, ratio);
                encounters[encounter.index].push_back(ratio);
            }
        }
    }
    // In pixels, a distance errs by 2 radii times this; a coordinate by that divided by √2.
    const double pixels = tracked.spacing * tracked.radius * std::sqrt(2.0);
    // Without outliers, a few distances far below the contact decide the error of all others.
    if (const auto found =
            contact_of_discs(distances, tracked.contact_at_wall / tracked.spacing, 3e-4)) {
        tracked.contact_ratio = found->at * tracked.spacing;
        tracked.contact_fitted = true;
        tracked.overlap_error = found->error * pixels;
        tracked.contact_error = fitted_contact;
        tracked.error_factor =
            factor_of_error(double(std::count_if(near.begin(), near.end(), [&](const auto& pair) {
                return pair.second.nearest < found->at;
            })));
        return;
    }
    if (positions == 0.0 || tracked.spacing != 1.0) return;
    if (const auto few = contact_of_few(encounters, std::sqrt(square / positions) / pixels)) {
        tracked.contact_ratio = few->at;
        tracked.contact_error = few->error;
    }
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
    set_overlap_error(tracked);
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
    // All discs share the error of a shift that was removed, so overlaps do not contain it. It is
    // possible, and no more: the true error is between both.
    if (tracked.contact_fitted || tracked.bounce_error == 0.0) {
        const double with_shift = std::hypot(error, tracked.shading_shift_error);
        tracked.error_factor = std::max(tracked.error_factor, with_shift / error);
        error = with_shift;
    }
    if (error == tracked.position_error) return;
    for (auto& errors : tracked.errors)
        for (double& one : errors) one *= error / tracked.position_error;
    tracked.position_error = error;
}

void set_radii(TrackedVideo& tracked) {
    // Contact ratios within max_off of 1 are correct, and ratios below min_ratio are implausible. A
    // fit to all distances has an error of about 0.2 %.
    const double max_off = 2.0 * tracked.contact_error;
    constexpr double min_ratio = 0.5;
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
    // determine the wall. No disc comes through the rim: if it seems to, its position is wrong.
    const bool agree = std::abs(tracked.rim_radius - tracked.reach) < same_radius * tracked.radius;
    const bool too_few = !tracked.wall_reached && tracked.rim_radius > tracked.reach;
    const bool beyond = tracked.reach > tracked.rim_radius;
    tracked.container_radius = agree || too_few || beyond ? tracked.rim_radius : tracked.reach;
    // What shifts an edge by light, texture and compression changes the radius, too: on average by
    // a quarter, in eleven videos with known radii. A rim that no disc confirms may be any edge
    // between the reach of the discs and the rim.
    constexpr double share_of_position = 0.25, share_at_wall = 0.5;
    tracked.radius_error = std::hypot(tracked.contact_error * tracked.radius,
                                      share_of_position * tracked.position_error);
    constexpr double share_of_shift = 0.5;  // a displaced rim is wrong on one side
    tracked.container_radius_error = std::hypot(share_at_wall * tracked.position_error,
                                                too_few ? tracked.rim_radius - tracked.reach : 0.0,
                                                share_of_shift * length(tracked.rim_shift));
}

}  // namespace swirl::tracking
