// Discs that are moved, added and removed while a simulation runs.
#pragma once

#include <cstddef>
#include <optional>

#include "swirl/physics/initial_state.hpp"

namespace swirl {

/// True if a disc of this radius at `p` overlaps no disc (except disc `i`) and not the wall.
inline bool is_free(const InitialState& state, const Vec2& p, double radius, std::size_t i) {
    constexpr double gap = 1e-9;  // more than the rounding error of a contact
    const Vec2 centre = state.path.segments.front().start;
    const double reach_of_centre = (state.container_radius - radius) * (1.0 - gap);
    if (dot(p - centre, p - centre) > reach_of_centre * reach_of_centre) return false;
    for (std::size_t j = 0; j < state.discs.size(); ++j) {
        const Vec2 d = p - state.discs[j].position;
        const double reach = (radius + state.discs[j].radius) * (1.0 + gap);
        if (j != i && dot(d, d) < reach * reach) return false;
    }
    return true;
}

/// The free position nearest to `point` on the line from disc i to it. Other discs and the wall
/// block the way; if `point` itself is free, it is returned.
inline Vec2 nearest_free_position(const InitialState& state, std::size_t i, const Vec2& point) {
    const double radius = state.discs[i].radius;
    const Vec2 from = state.discs[i].position, way = point - from;
    if (is_free(state, point, radius, i)) return point;
    // Bisection finds one free position next to an obstacle; any of them is good enough.
    double free = 0.0, blocked = 1.0;
    for (int step = 0; step < 40; ++step) {
        const double middle = 0.5 * (free + blocked);
        (is_free(state, from + middle * way, radius, i) ? free : blocked) = middle;
    }
    return from + free * way;
}

/// The first free position on a square lattice over the container, in order of rows; nothing if
/// there is none.
inline std::optional<Vec2> free_position(const InitialState& state, double radius) {
    const Vec2 centre = state.path.segments.front().start;
    const double step = 0.25 * radius, reach = state.container_radius - radius;
    for (double y = -reach; y <= reach; y += step)
        for (double x = -reach; x <= reach; x += step)
            if (const Vec2 p = centre + Vec2{x, y}; is_free(state, p, radius, state.discs.size()))
                return p;
    return std::nullopt;
}

/// Removes the last discs, or adds discs like the first one that move with the container, until
/// there are `wanted` of them, or no space for another.
inline void fit_discs(InitialState& state, std::size_t wanted) {
    if (state.discs.size() > wanted) state.discs.resize(wanted);
    while (state.discs.size() < wanted) {
        const auto position = free_position(state, state.discs.front().radius);
        if (!position) return;
        Disc disc = state.discs.front();
        disc.position = *position;
        disc.velocity = state.path.segments.front().velocity;
        disc.angle = disc.spin = 0.0;
        disc.rolling_spin = {0.0, 0.0};
        state.discs.push_back(disc);
    }
}

}  // namespace swirl
