#include <algorithm>
#include <cmath>

#include "swirl/math/unit_circle.hpp"
#include "track/video/tracking_steps.hpp"

namespace swirl::tracking {

namespace {

/// A position of a track, as seen and at the time of its frame.
struct Point {
    std::size_t frame;
    double time, error;   // of the position as seen
    Vec2 seen, relative;  // to the container
    Vec2 position = seen;
};

/// How well the middle between two positions follows from them, relative to the same for every
/// second frame: taken from every second and every fourth. Discs that are often hit in between move
/// less smoothly than discs with rare kinks.
double smoothness(const std::vector<std::vector<Point>>& tracks) {
    double square[2] = {0.0, 0.0}, number[2] = {1e-300, 1e-300};
    for (const std::vector<Point>& points : tracks)
        for (const std::size_t half : {1, 2})
            for (std::size_t j = half; j + half < points.size(); ++j) {
                const Vec2 bend = points[j - half].relative - 2.0 * points[j].relative +
                                  points[j + half].relative;
                square[half - 1] += dot(bend, bend);
                number[half - 1] += 1.0;
            }
    return std::sqrt(square[0] * number[1] / std::max(square[1] * number[0], 1e-300));
}

/// Interpolates between positions at other times than those of their frames, by a parabola in the
/// frame of reference of the container.
void interpolate_to_frames(const TrackedVideo& tracked, double smooth, std::vector<Point>& points) {
    std::vector<double> errors;
    for (std::size_t j = 0; j < points.size(); ++j) {
        Point& now = points[j];
        const double delay = now.time - tracked.times[now.frame];
        errors.push_back(now.error);
        if (delay == 0.0 || points.size() == 1) continue;
        const Point& other =
            points[j + 1 == points.size() || (delay > 0.0 && j > 0) ? j - 1 : j + 1];
        const double share = std::clamp(delay / (now.time - other.time), -1.0, 1.0),
                     between = std::abs(share) * (1.0 - std::abs(share));
        Vec2 bend{0.0, 0.0};
        if (j > 0 && j + 1 < points.size())
            bend = points[j - 1].relative - 2.0 * now.relative + points[j + 1].relative;
        now.position = now.seen + share * (other.relative - now.relative) - 0.5 * between * bend;
        errors.back() = std::hypot((1.0 - share) * now.error, share * other.error,
                                   std::sqrt(2.0) * smooth * between * length(bend));
    }
    for (std::size_t j = 0; j < points.size(); ++j) points[j].error = errors[j];
}

}  // namespace

void assemble_tracks(const Detections& all, const Links& links, std::int64_t first_frame,
                     TrackedVideo& tracked) {
    constexpr std::size_t min_frames = 4;   // a shorter track is no disc
    constexpr double max_gap_share = 12.0;  // share of a period: gaps of 30 degrees are filled
    constexpr double min_gap = 2.0;         // frames, filled whatever the frame rate
    constexpr double filled_error = 0.1;    // radii
    std::vector<std::vector<Point>> points(links.species.size());
    for_each_linked(links, [&](std::size_t k, std::size_t track, std::size_t d) {
        const DetectedParticle& p = all[k].particles[d];
        points[track].push_back(
            {k, tracked.times[k] + p.delay, p.error, p.centre, p.centre - tracked.container(k)});
    });
    const std::size_t frames = all.size(), min_length = std::min(min_frames, frames);
    tracked.tracks.y_down = true;
    tracked.tracks.frames.resize(frames);
    tracked.errors.resize(frames);
    tracked.seen.resize(frames);
    tracked.rolled.resize(frames);
    for (std::size_t k = 0; k < frames; ++k)
        tracked.tracks.frames[k].number = first_frame + static_cast<std::int64_t>(k);
    const double per_period = 2.0 * pi / tracked.path.omega / tracked.step();
    const auto max_gap = static_cast<std::size_t>(std::max(min_gap, per_period / max_gap_share));
    const double smooth = tracked.readout > 0.0 ? smoothness(points) : 0.0;
    std::int64_t id = 0;
    std::vector<std::int64_t> ids(points.size(), -1);
    for (TrackedSpecies& species : tracked.species) species.number = 0;
    for (std::size_t t = 0; t < points.size(); ++t) {
        if (points[t].size() < min_length) continue;
        TrackedSpecies& species = tracked.species[links.species[t]];
        interpolate_to_frames(tracked, smooth, points[t]);
        const auto add = [&](std::size_t k, const Vec2& position, const Vec2& seen_at, double error,
                             bool seen) {
            TrackFrame& f = tracked.tracks.frames[k];
            f.id.push_back(id);
            f.position.push_back(position);
            f.radius.push_back(species.radius);
            tracked.errors[k].push_back(error);
            tracked.seen[k].push_back(seen ? 1 : 0);
            tracked.rolled[k].push_back(put_back(tracked, k, seen_at) - position);
        };
        for (std::size_t j = 0; j < points[t].size(); ++j) {
            const auto& [now, time, error, at_its_time, relative, position] = points[t][j];
            if (j > 0) {
                // Interpolated in the frame of reference of the container.
                const std::size_t before = points[t][j - 1].frame, gap = now - before;
                const Vec2 from = points[t][j - 1].position - tracked.container(before),
                           to = position - tracked.container(now);
                for (std::size_t k = before + 1; gap <= max_gap && k < now; ++k) {
                    const double u = double(k - before) / double(gap);
                    const Vec2 between = tracked.container(k) + (1.0 - u) * from + u * to;
                    add(k, between, between, filled_error * species.radius, false);
                    ++tracked.filled;
                }
            }
            add(now, position, at_its_time, error, true);
        }
        ++species.number;
        ids[t] = id++;
    }
    // Of two sizes that the survey saw, one may be that of a few wrong circles.
    std::erase_if(tracked.species, [](const TrackedSpecies& s) { return s.number == 0; });
    tracked.number = static_cast<std::size_t>(id);
    for (PossibleSwap swap : links.swaps) {
        if (ids[swap.first] < 0 || ids[swap.second] < 0) continue;
        swap.first = std::size_t(ids[swap.first]);
        swap.second = std::size_t(ids[swap.second]);
        tracked.swaps.push_back(swap);
    }
}

}  // namespace swirl::tracking
