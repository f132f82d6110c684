// The paper's container with N discs of radius 1 (paper_container_radius, polygon of paper_sides).
#pragma once

#include <cstddef>
#include <cstdint>

#include "swirl/physics/initial_state.hpp"

namespace swirl {

/// Discs are placed without overlap. They move with the container, and have small random
/// velocities. If they do not fit, there are none, and validate() says so.
InitialState paper_scene(std::size_t discs, double mu, std::uint64_t seed);

}  // namespace swirl
