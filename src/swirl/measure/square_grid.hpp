// The container's bounding square in the M-frame, −R ≤ x, y ≤ R, cut into n × n equal cells: the
// grid of the density map (paper, SI: 100 × 100) and the flow map (20 × 20).
//
// Cells are numbered row by row from the lower left: cell = row·n + column, rows with y. The square
// is that of the paper's Fig. 5c: its corners lie outside the container and stay empty. A centre
// outside the square (a camera's error) belongs to no cell.
#pragma once

#include <cstddef>
#include <cstdint>

#include "swirl/math/vec2.hpp"

namespace swirl {

struct SquareGrid {
    std::size_t side = 0;   // n
    double half_width = 0;  // R

    static constexpr std::size_t outside = static_cast<std::size_t>(-1);

    std::size_t cells() const { return side * side; }
    double cell_width() const { return 2.0 * half_width / static_cast<double>(side); }
    double cell_area() const { return cell_width() * cell_width(); }

    std::size_t cell_at(double x, double y) const {
        const double scale = static_cast<double>(side) / (2.0 * half_width);
        const double column = (x + half_width) * scale, row = (y + half_width) * scale;
        const double n = static_cast<double>(side);
        if (!(column >= 0.0 && column < n && row >= 0.0 && row < n)) return outside;
        return static_cast<std::size_t>(row) * side + static_cast<std::size_t>(column);
    }
    /// cell_at for many points at once; a point outside the square gets the number cells().
    void locate(std::size_t points, const double* x, const double* y, std::int32_t* cell) const;

    Vec2 centre_of(std::size_t cell) const {
        const std::size_t column = cell % side, row = cell / side;
        return {(static_cast<double>(column) + 0.5) * cell_width() - half_width,
                (static_cast<double>(row) + 0.5) * cell_width() - half_width};
    }
};

}  // namespace swirl
