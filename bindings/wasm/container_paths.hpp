// Paths that a page makes of others: by hand, from a moment on, and back.
#pragma once

#include <algorithm>

#include "swirl/physics/container_path.hpp"

namespace swirl {

/// Of a container that is swirled by hand, which has none: long enough.
inline constexpr double no_period = 1e6;

/// Straight to a point, and there it waits to be told where next. At rest at once: that is a
/// corner, as all others.
inline ContainerPath path_by_hand(const Vec2& from, const Vec2& to, double duration) {
    return {no_period,
            {{0.0, duration, from, (1.0 / duration) * (to - from), 0.0},
             {duration, no_period, to, {0.0, 0.0}, 0.0}}};
}

inline bool is_by_hand(const ContainerPath& path) { return path.period == no_period; }

/// The same path, counted from a moment of its swirl.
inline ContainerPath path_from(const ContainerPath& path, double clock) {
    ContainerPath later{path.period, {}};
    const auto add = [&](const Segment& segment, double begin, double end, double shift) {
        if (begin < end)
            later.segments.push_back({begin + shift, end + shift, segment.position_at(begin),
                                      segment.velocity_at(begin), segment.turn_rate});
    };
    for (const Segment& segment : path.segments)
        add(segment, std::max(segment.begin, clock), segment.end, -clock);
    for (const Segment& segment : path.segments)
        add(segment, segment.begin, std::min(segment.end, clock), path.period - clock);
    later.segments.back().end = path.period;
    return later;
}

/// From its end to its beginning.
inline ContainerPath backwards(const ContainerPath& path) {
    ContainerPath back{path.period, {}};
    for (auto segment = path.segments.rbegin(); segment != path.segments.rend(); ++segment)
        back.segments.push_back({path.period - segment->end, path.period - segment->begin,
                                 segment->position_at(segment->end),
                                 -1.0 * segment->velocity_at(segment->end), -segment->turn_rate});
    return back;
}

}  // namespace swirl
