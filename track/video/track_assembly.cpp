#include <algorithm>

#include "swirl/math/unit_circle.hpp"
#include "track/video/tracking_steps.hpp"

namespace swirl::tracking {

void assemble_tracks(const Detections& all, const Links& links, std::int64_t first_frame,
                     TrackedVideo& tracked) {
    constexpr std::size_t min_frames = 4;   // a shorter track is no disc
    constexpr double max_gap_share = 12.0;  // share of a period: gaps of 30 degrees are filled
    constexpr double min_gap = 2.0;         // frames, filled whatever the frame rate
    constexpr double filled_error = 0.1;    // radii
    struct Point {
        std::size_t frame;
        const DetectedParticle* particle;
    };
    std::vector<std::vector<Point>> points(links.species.size());
    for_each_linked(links, [&](std::size_t k, std::size_t track, std::size_t d) {
        points[track].push_back({k, &all[k].particles[d]});
    });
    const std::size_t frames = all.size(), min_length = std::min(min_frames, frames);
    tracked.tracks.y_down = true;
    tracked.tracks.frames.resize(frames);
    tracked.errors.resize(frames);
    tracked.seen.resize(frames);
    for (std::size_t k = 0; k < frames; ++k)
        tracked.tracks.frames[k].number = first_frame + static_cast<std::int64_t>(k);
    const double per_period = 2.0 * pi / tracked.path.omega / tracked.step();
    const auto max_gap = static_cast<std::size_t>(std::max(min_gap, per_period / max_gap_share));
    std::int64_t id = 0;
    for (TrackedSpecies& species : tracked.species) species.number = 0;
    for (std::size_t t = 0; t < points.size(); ++t) {
        if (points[t].size() < min_length) continue;
        TrackedSpecies& species = tracked.species[links.species[t]];
        const auto add = [&](std::size_t k, const Vec2& position, double error, bool seen) {
            TrackFrame& f = tracked.tracks.frames[k];
            f.id.push_back(id);
            f.position.push_back(position);
            f.radius.push_back(species.radius);
            tracked.errors[k].push_back(error);
            tracked.seen[k].push_back(seen ? 1 : 0);
        };
        for (std::size_t j = 0; j < points[t].size(); ++j) {
            const auto [now, particle] = points[t][j];
            if (j > 0) {
                // Interpolated in the frame of reference of the container.
                const auto [before, previous] = points[t][j - 1];
                const std::size_t gap = now - before;
                const Vec2 from = previous->centre - tracked.container(before),
                           to = particle->centre - tracked.container(now);
                for (std::size_t k = before + 1; gap <= max_gap && k < now; ++k) {
                    const double u = double(k - before) / double(gap);
                    add(k, tracked.container(k) + (1.0 - u) * from + u * to,
                        filled_error * species.radius, false);
                    ++tracked.filled;
                }
            }
            add(now, particle->centre, particle->error, true);
        }
        ++species.number;
        ++id;
    }
    tracked.number = static_cast<std::size_t>(id);
}

}  // namespace swirl::tracking
