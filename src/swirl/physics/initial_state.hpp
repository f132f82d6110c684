// Everything that determines a trajectory: the discs at the beginning, the path of the container,
// and the surfaces.
#pragma once

#include <vector>

#include "swirl/physics/contact.hpp"
#include "swirl/physics/container_path.hpp"
#include "swirl/physics/disc.hpp"
#include "swirl/physics/floor.hpp"

namespace swirl {

/// Disc times count from the start of the first period.
struct InitialState {
    std::vector<Disc> discs;
    ContainerPath path;
    double container_radius;
    Surface disc_surface, wall_surface;
    Shape shape = Shape::disc;
    Floor floor{};                                   // used by spheres and coins
    Frictionless frictionless = Frictionless::none;  // used by discs
};

/// Moves all discs by the same vector. Without a shift, no bit changes.
inline void shift_discs(std::vector<Disc>& discs, const Vec2& shift) {
    if (shift.x == 0.0 && shift.y == 0.0) return;
    for (Disc& disc : discs) disc.position = disc.position + shift;
}

}  // namespace swirl
