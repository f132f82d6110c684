// What happened. The return value of Simulation::step(), and what the measurements of collisions
// take.
#pragma once

#include <cstdint>

#include "swirl/math/vec2.hpp"
#include "swirl/physics/contact.hpp"

namespace swirl {

/// The paper's three kinds of event (SI "Overview"), and a fourth: a sphere no longer slides on the
/// floor, or, against a rolling resistance, no longer rolls; or a coin comes to rest on it.
enum class EventKind : std::uint8_t { disc_disc, disc_wall, path_vertex, begins_to_roll };

struct Event {
    std::int64_t periods;  // whole periods before it
    double clock;          // time since the start of the current swirl
    EventKind kind;
    std::uint32_t i, j;  // the discs, i < j; j = i for wall and floor; both 0 at a path vertex
    Vec2 normal;         // unit vector from i to j, or from i to the wall
    Impulse impulse;     // on j (on the wall), along the normal and along (n_y, −n_x)
    double overlap;      // σ − distance at contact: a rounding error
};

}  // namespace swirl
