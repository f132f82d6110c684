// Which neighbour search is fastest for a scene, and the properties of the scene that decide this.
#pragma once

#include <cstdint>

#include "swirl/engine/simulation.hpp"
#include "swirl/math/vec2.hpp"
#include "swirl/physics/initial_state.hpp"

namespace swirl {

/// Spheres or coins: bodies that a floor can accelerate.
inline bool are_spheres(const InitialState& scene) { return scene.shape != Shape::disc; }
/// True if the container never moves.
bool container_rests(const InitialState& scene);

struct RadiusRange {
    double smallest, largest;
};
RadiusRange radii_of(const InitialState& scene);

/// The square over which the container's centre moves: its middle, and half its diagonal.
struct PathExtent {
    Vec2 middle;
    double radius;

    /// How far the container moves in half a period on a round path: π/√2 times the radius.
    double max_drift() const { return 2.25 * radius; }
    double reach() const { return radius + max_drift(); }
};
PathExtent extent_of(const ContainerPath& path);

struct EventLoops;

/// Widths of linked cells (linked_cells.hpp): limits, and the best for evenly spread discs.
struct CellWidths {
    double minimum, target, maximum;
};
CellWidths cell_widths(const InitialState& scene, const RadiusRange& radii);
/// Mean number of discs in a cell, if they are spread evenly.
double discs_per_cell(const InitialState& scene, double width);

/// The search for a scene. `tuning.search` decides, where the scene allows that search. All pairs
/// are tested if there is a loop for so many discs.
SearchMethod choose_search(const InitialState& scene, const RadiusRange& radii,
                           const Tuning& tuning, const EventLoops& loops);

}  // namespace swirl
