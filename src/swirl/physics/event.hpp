// An event: the return value of Simulation::step(), and the input of the measurements of
// collisions.
#pragma once

#include <cstdint>

#include "swirl/math/vec2.hpp"
#include "swirl/physics/contact.hpp"

namespace swirl {

/// The paper's three kinds of event (SI "Overview"), and a fourth one on a floor: a sphere stops
/// sliding and rolls, rolling resistance stops a sphere, or a coin stops.
enum class EventKind : std::uint8_t { disc_disc, disc_wall, path_vertex, begins_to_roll };

struct Event {
    std::int64_t periods;  // whole periods before the event
    double clock;          // time since the start of the current period
    EventKind kind;
    std::uint32_t i, j;  // the discs, i < j; j = i for wall and floor; both 0 at a path vertex
    Vec2 normal;         // unit vector from i to j, or from i to the wall
    Impulse impulse;     // impulse on j or the wall along the normal and (n_y, −n_x)
    double overlap;      // contact distance σ minus the actual one: a rounding error
};

/// The two discs of an event; equal numbers for one disc, both 0 at a path vertex.
struct EventDiscs {
    std::uint32_t i, j;
};

/// The events since a snapshot was brought up to date. Observers need only what these changed.
struct EventSpan {
    static constexpr std::uint64_t capacity = 64;
    std::uint64_t events = 0;
    double max_overlap = 0.0;
    EventDiscs discs[capacity];  // event k is at k modulo `capacity`
};

}  // namespace swirl
