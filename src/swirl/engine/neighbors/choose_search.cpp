#include "swirl/engine/neighbors/choose_search.hpp"

#include <algorithm>

#include "swirl/engine/neighbors/engine_state.hpp"
#include "swirl/math/real.hpp"

namespace swirl {

bool container_rests(const InitialState& scene) {
    return std::all_of(scene.path.segments.begin(), scene.path.segments.end(),
                       [](const Segment& segment) {
                           return segment.velocity.x == 0.0 && segment.velocity.y == 0.0;
                       });
}

RadiusRange radii_of(const InitialState& scene) {
    RadiusRange radii{never, 0.0};
    for (const Disc& d : scene.discs) {
        radii.smallest = smaller(radii.smallest, d.radius);
        radii.largest = larger(radii.largest, d.radius);
    }
    return radii;
}

PathExtent extent_of(const ContainerPath& path) {
    Vec2 low{never, never}, high{-never, -never};
    const auto include = [&](const Vec2& at) {
        low = {smaller(low.x, at.x), smaller(low.y, at.y)};
        high = {larger(high.x, at.x), larger(high.y, at.y)};
    };
    for (const Segment& segment : path.segments) {
        include(segment.position_at(segment.begin));
        include(segment.position_at(segment.end));
        if (segment.turn_rate == 0.0) continue;
        const Vec2 from_centre = (-1.0 / segment.turn_rate) * perpendicular(segment.velocity);
        const double radius = square_root(dot(from_centre, from_centre));
        include(segment.start - from_centre + Vec2{radius, radius});
        include(segment.start - from_centre - Vec2{radius, radius});
    }
    const Vec2 half = 0.5 * (high - low);
    return {low + half, square_root(dot(half, half))};
}

/// The minimum is a disc's diameter with a margin for rounding, so that discs in cells that do not
/// touch cannot collide. It also limits the number of cells per disc, for the sake of memory. The
/// target fills cells so that the discs of nine cells just fit into one vector; in a dilute system
/// one cell in four million then overflows.
CellWidths cell_widths(const InitialState& scene, const RadiusRange& radii) {
    constexpr double target_per_cell = 0.6, cells_per_disc = 16.0, cells_at_least = 64.0;
    const double R = scene.container_radius, discs = static_cast<double>(scene.discs.size());
    const double side = 2.0 * (R + extent_of(scene.path).reach());
    const double minimum =
        larger(2.05 * radii.largest, side / square_root(cells_at_least + cells_per_disc * discs));
    const double target = larger(square_root(target_per_cell * pi * R * R / discs), minimum);
    return {minimum, target, 1.2 * target};
}
double discs_per_cell(const InitialState& scene, double width) {
    const double R = scene.container_radius;
    return static_cast<double>(scene.discs.size()) * width * width / (pi * R * R);
}

namespace {

/// Linked cells handle path vertices only between straight segments (linked_cells.hpp). A circle
/// has no vertices.
bool cells_are_possible(const InitialState& scene) {
    return scene.path.segments.size() == 1 ||
           std::all_of(scene.path.segments.begin(), scene.path.segments.end(),
                       [](const Segment& segment) { return segment.turn_rate == 0.0; });
}

/// True if the system is so dilute that neighbour lists would not last. The criterion is a packing
/// fraction, for unequal discs its geometric mean with that of equal discs of the mean radius. A
/// factor accounts for the candidates that each prediction tests in a cell search, which are 9n
/// with n discs in a cell. In a moving container discs gather, and then lists last; so the limit is
/// lower there. The numbers were measured (bench/NOTES.md).
bool is_dilute(const InitialState& scene, const RadiusRange& radii) {
    double sum = 0.0, squares = 0.0;
    for (const Disc& d : scene.discs) {
        sum += d.radius;
        squares += d.radius * d.radius;
    }
    const double R = scene.container_radius, discs = static_cast<double>(scene.discs.size());
    const double packing = sum * square_root(squares / discs) / (R * R);
    const double in_cell = discs_per_cell(scene, cell_widths(scene, radii).target);
    return packing * (0.92 + 0.1 * in_cell) < (container_rests(scene) ? 0.6 : 0.4);
}

double packing_of(const InitialState& scene) {
    double squares = 0.0;
    for (const Disc& d : scene.discs) squares += d.radius * d.radius;
    return squares / (scene.container_radius * scene.container_radius);
}

/// 0 for too many discs.
double all_pairs_up_to_packing(const InitialState& scene, const EventLoops& loops) {
    const std::size_t discs = scene.discs.size();
    return discs <= max_discs_in_columns ? loops.all_pairs_up_to_packing[(discs - 1) / 8] : 0.0;
}

}  // namespace

SearchMethod choose_search(const InitialState& scene, const RadiusRange& radii,
                           const Tuning& tuning, const EventLoops& loops) {
    if (are_spheres(scene)) {
        const bool allowed =
            tuning.search == SearchMethod::best || tuning.search == SearchMethod::all_pairs;
        return allowed && scene.discs.size() <= max_spheres_in_columns ? SearchMethod::all_pairs
                                                                       : SearchMethod::cells;
    }
    const double up_to_packing = all_pairs_up_to_packing(scene, loops);
    switch (tuning.search) {
        case SearchMethod::all_pairs:
            return up_to_packing > 0.0 ? SearchMethod::all_pairs : SearchMethod::lists;
        case SearchMethod::cells:
            return cells_are_possible(scene) ? SearchMethod::cells : SearchMethod::lists;
        case SearchMethod::lists:
            return SearchMethod::lists;
        case SearchMethod::best:
            break;
    }
    if (tuning.cells_per_side != 0) return SearchMethod::lists;
    if (up_to_packing > 0.0)
        return packing_of(scene) <= up_to_packing ? SearchMethod::all_pairs : SearchMethod::lists;
    return is_dilute(scene, radii) && cells_are_possible(scene) ? SearchMethod::cells
                                                                : SearchMethod::lists;
}

}  // namespace swirl
