// Everything that determines a trajectory: the discs as they start, where the container goes, and
// what happens at contacts.
#pragma once

#include <vector>

#include "swirl/physics/contact.hpp"
#include "swirl/physics/container_path.hpp"
#include "swirl/physics/disc.hpp"
#include "swirl/physics/floor.hpp"

namespace swirl {

/// Disc times count from the start of the first swirl.
struct InitialState {
    std::vector<Disc> discs;
    ContainerPath path;
    double container_radius;
    Surface disc_surface, wall_surface;
    Shape shape = Shape::disc;
    Floor floor{};  // of spheres
};

}  // namespace swirl
