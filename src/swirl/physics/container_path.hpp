// The path of the container's centre C. It moves counter-clockwise round the swirl centre S, which
// is the origin. The container never rotates (paper, SI "Overview").
//
// A path is a closed sequence of segments of constant speed and constant turn rate. A side of the
// paper's polygon is a segment with turn rate 0; the exact circle is one arc with turn rate Ω. The
// end of a segment is the paper's third kind of event, a path vertex.
#pragma once

#include <vector>

#include "swirl/math/real.hpp"
#include "swirl/math/unit_circle.hpp"
#include "swirl/math/vec2.hpp"
#include "swirl/physics/disc.hpp"

namespace swirl {

/// One segment of the path. Times count from the start of the period.
struct Segment {
    double begin, end;
    Vec2 start, velocity;  // values at `begin`
    double turn_rate;      // rad per unit time; 0 for a straight segment

    SWIRL_INLINE Vec2 position_at(double t) const {
        if (turn_rate == 0.0) return start + (t - begin) * velocity;
        return flight_at(t).position;
    }
    SWIRL_INLINE Vec2 velocity_at(double t) const {
        if (turn_rate == 0.0) return velocity;
        return flight_at(t).velocity;
    }
    /// Position and velocity at time t. On an arc the position is the integral of the turning
    /// velocity, (sin φ v + (1 − cos φ) v^⊥) / turn_rate with φ = turn_rate (t − begin).
    SWIRL_INLINE Flight<double> flight_at(double t) const {
        const double elapsed = t - begin;
        if (turn_rate == 0.0) return {start + elapsed * velocity, velocity, t};
        const Vec2 u = quick_unit_circle(elapsed * turn_rate * (0.5 / pi));
        const Vec2 across = perpendicular(velocity);
        return {start + (1.0 / turn_rate) * (u.y * velocity + (1.0 - u.x) * across),
                u.x * velocity + u.y * across, t};
    }
};

struct ContainerPath {
    double period;  // T; the angular velocity of the motion is Ω = 2π/T
    std::vector<Segment> segments;

    double omega() const { return 2.0 * pi / period; }
    const Segment& segment_at(double t) const {
        for (const Segment& segment : segments)
            if (t < segment.end) return segment;
        return segments.back();
    }
};

/// The paper's parameters (SI "Simulation parameters"). With these the container moves at speed 1,
/// and A/R = 0.22 as in the experiment. (The main text's A = 0.96 is in disc diameters.)
inline constexpr double paper_period = 11.866071;
inline constexpr double paper_amplitude = 1.892;
inline constexpr double paper_container_radius = 8.6;
inline constexpr int paper_sides = 30;

/// A container at rest. Its clock still has a period.
inline ContainerPath still_path(double period) {
    return {period, {{0.0, period, {0.0, 0.0}, {0.0, 0.0}, 0.0}}};
}

/// A closed path of `sides` straight segments of equal duration between the points point(0), …,
/// point(sides − 1), and back to the first.
template <class Point>
ContainerPath sampled_path(double period, int sides, Point point) {
    ContainerPath path{period, {}};
    for (int k = 0; k < sides; ++k) {
        const double begin = period * k / sides, end = period * (k + 1) / sides;
        const Vec2 from = point(k), to = point((k + 1) % sides);
        path.segments.push_back({begin, end, from, (sides / period) * (to - from), 0.0});
    }
    return path;
}

/// Regular polygon with vertices A (cos 2πk/M, sin 2πk/M), traversed at constant speed
/// 2AM sin(π/M)/T, with M = `sides` ≥ 3.
inline ContainerPath polygon_path(double amplitude, double period, int sides) {
    if (amplitude == 0.0) return still_path(period);
    return sampled_path(period, sides,
                        [&](int k) { return amplitude * unit_circle(double(k) / sides); });
}

/// The exact circle of radius A, which the paper's polygon approximates. It starts at the angle
/// 2π `turns`.
inline ContainerPath circular_path(double amplitude, double period, double turns = 0.0) {
    if (amplitude == 0.0) return still_path(period);
    const double omega = 2.0 * pi / period;
    if (turns == 0.0)
        return {period, {{0.0, period, {amplitude, 0.0}, {0.0, amplitude * omega}, omega}}};
    const Vec2 start = amplitude * unit_circle(turns);
    return {period, {{0.0, period, start, omega * perpendicular(start), omega}}};
}

/// A point of a path, and the time of the period at which the container's centre is there.
struct PathPoint {
    double time;
    Vec2 at;
};

/// Straight segments between the points, each at constant velocity. Times increase from 0 to the
/// period, and the last point is the first one. Points at the times kT/n give the velocities of
/// sampled_path() bitwise.
inline ContainerPath polyline_path(const std::vector<PathPoint>& points) {
    const double period = points.back().time;
    const auto n = static_cast<double>(points.size() - 1);
    bool equal_durations = true;
    for (std::size_t k = 0; k < points.size(); ++k)
        equal_durations &= points[k].time == period * static_cast<double>(k) / n;
    ContainerPath path{period, {}};
    for (std::size_t k = 0; k + 1 < points.size(); ++k) {
        const PathPoint &from = points[k], &to = points[k + 1];
        const double rate = equal_durations ? n / period : 1.0 / (to.time - from.time);
        path.segments.push_back({from.time, to.time, from.at, rate * (to.at - from.at), 0.0});
    }
    return path;
}

/// The same path, starting at time `clock` of its period.
inline ContainerPath path_from(const ContainerPath& path, double clock) {
    ContainerPath later{path.period, {}};
    const auto add = [&](const Segment& segment, double begin, double end, double shift) {
        if (begin < end)
            later.segments.push_back({begin + shift, end + shift, segment.position_at(begin),
                                      segment.velocity_at(begin), segment.turn_rate});
    };
    for (const Segment& segment : path.segments)
        add(segment, segment.begin > clock ? segment.begin : clock, segment.end, -clock);
    for (const Segment& segment : path.segments)
        add(segment, segment.begin, segment.end < clock ? segment.end : clock, path.period - clock);
    later.segments.back().end = path.period;
    return later;
}

/// The same segments, with the container at rest in the middle.
inline ContainerPath at_rest(ContainerPath path) {
    for (Segment& segment : path.segments)
        segment = {segment.begin, segment.end, {0.0, 0.0}, {0.0, 0.0}, 0.0};
    return path;
}

/// The mirror image at the x axis.
inline ContainerPath mirrored(ContainerPath path) {
    for (Segment& segment : path.segments) {
        segment.start.y = -segment.start.y;
        segment.velocity.y = -segment.velocity.y;
        segment.turn_rate = -segment.turn_rate;
    }
    return path;
}

}  // namespace swirl
