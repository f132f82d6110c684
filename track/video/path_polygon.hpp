// The shape of the container's path: a circle or a regular polygon.
//
// A regular polygon of n sides, run through at constant speed, deviates from the circle of the same
// mean radius by (2A/n²) cos n(φ − φ_vertex), and by less at multiples of n. The number of sides is
// the one harmonic of the centres' distances from the path's centre that has this size and stands
// out from the noise.
//
// No number is reported if two numbers fit, or if the number may be an alias: with less than two
// frames per side, a polygon looks like one of fewer sides.
#pragma once

#include <vector>

#include "swirl/math/vec2.hpp"
#include "track/video/tracked_path.hpp"

namespace swirl::tracking {

struct PathPolygon {
    int sides = 0;  // 0: not a polygon of up to max_sides
    /// Most sides that would have been detected: 5 standard errors, two frames per side.
    int max_sides = 0;
    double vertex_distance = 0.0;  // from the path's centre, pixels
};

/// One time for each centre, ascending.
PathPolygon find_path_polygon(const std::vector<Vec2>& centres, const std::vector<double>& times,
                              const TrackedPath& path);

}  // namespace swirl::tracking
