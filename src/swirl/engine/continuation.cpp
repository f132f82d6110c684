#include "swirl/engine/continuation.hpp"

#include <algorithm>
#include <cmath>

#include "swirl/physics/limits.hpp"

namespace swirl {
namespace {

/// Larger counts would not be exact in a double.
constexpr std::uint64_t largest_number = std::uint64_t{1} << 53;

/// How far a disc may extend beyond the container, in its radii. Rounding moves it by less than
/// 10⁻⁶; with more, a run would end with an error anyway.
constexpr double largest_excess = 1e-3;

bool is_countable(const Progress& progress) {
    const EventCounts& e = progress.events;
    return progress.periods >= 0 && std::uint64_t(progress.periods) <= largest_number &&
           std::max({e.disc_disc, e.disc_wall, e.path_vertex, e.elastic_by_tc, e.begins_to_roll}) <=
               largest_number;
}

bool is_sound(const Disc& d) {
    const double numbers[] = {d.position.x, d.position.y, d.velocity.x,     d.velocity.y,
                              d.angle,      d.spin,       d.rolling_spin.x, d.rolling_spin.y};
    const bool are_bounded = std::all_of(std::begin(numbers), std::end(numbers),
                                         [](double x) { return std::abs(x) <= largest_magnitude; });
    if (d.can_spin != 1.0 && !(d.can_spin == 0.0 && d.spin == 0.0)) return false;
    const double sizes[] = {d.radius, d.mass, d.inertia};
    return are_bounded && std::all_of(std::begin(sizes), std::end(sizes),
                                      [](double x) { return x > 0.0 && x < never; });
}

bool lies_within(const InitialState& scene, const Segment& segment, const Disc& d, double clock) {
    const FloorMotion motion =
        scene.shape == Shape::disc ? FloorMotion{} : floor_motion(d, scene.floor, segment.velocity);
    const Vec2 apart = moved_to(d, motion, clock).position - segment.position_at(clock);
    return std::hypot(apart.x, apart.y) + d.radius <=
           scene.container_radius + largest_excess * d.radius;
}

}  // namespace

const char* impossible_to_continue(const InitialState& scene, const Progress& progress) {
    const auto& segments = scene.path.segments;
    if (scene.discs.empty()) return "there are no discs";
    if (progress.segment >= segments.size()) return "the path has no segment with this number";
    if (!is_countable(progress)) return "a number of events or periods is out of range";
    const Segment& segment = segments[progress.segment];
    const double clock = progress.clock;
    if (!(clock >= segment.begin && clock <= segment.end))
        return "the clock is not within the segment of the path";
    const auto ended = std::uint64_t(progress.periods) * segments.size() + progress.segment;
    if (progress.events.path_vertex != ended)
        return "the number of path vertices does not match the time";
    for (const Disc& d : scene.discs) {
        if (!is_sound(d)) return "a disc has a number that is out of range";
        if (!(d.time >= 0.0 && d.time <= clock && d.last_collision >= 0.0 &&
              d.last_collision <= clock))
            return "a disc is ahead of the clock";
        if (!lies_within(scene, segment, d, clock)) return "a disc is outside the container";
    }
    return nullptr;
}

}  // namespace swirl
