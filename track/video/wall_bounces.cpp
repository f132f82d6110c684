// Discs that bounce off the wall between two frames.
//
// If discs are few, hardly any frame shows one at the wall. Its straight flights before and after a
// bounce are extended to the point where they meet.
#include <cmath>
#include <map>
#include <optional>

#include "track/video/tracking_steps.hpp"

namespace swirl::tracking {

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
            disc.id = f.id[i];
        }
    }
    std::vector<SeenDisc> result;
    for (auto& [id, disc] : discs) result.push_back(std::move(disc));
    return result;
}

namespace {

/// A disc bounces off the wall between frames j and j + 1. Its straight flights before and after
/// meet at the wall: returns their mean position relative to the container's centre there.
std::optional<Vec2> bounce(const SeenDisc& disc, std::size_t j, const TrackedVideo& tracked) {
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
        const Vec2 incoming = disc.positions[j] + u * before - centre,
                   outgoing = disc.positions[j + 1] + (1.0 - u) * after - centre;
        const double apart = length(incoming) - length(outgoing);
        if (n > 0 && previous * apart <= 0.0) return 0.5 * (incoming + outgoing);
        previous = apart;
    }
    return std::nullopt;
}

}  // namespace

std::vector<Bounce> find_bounces(const TrackedVideo& tracked) {
    std::vector<Bounce> bounces;
    for (const SeenDisc& disc : seen_discs(tracked))
        for (std::size_t j = 0; j < disc.frames.size(); ++j)
            if (const auto at = bounce(disc, j, tracked))
                bounces.push_back({disc.frames[j], disc.id, disc.radius, *at});
    return bounces;
}

}  // namespace swirl::tracking
