#include "swirl/measure/square_grid.hpp"

#include "swirl/math/wide.hpp"

namespace swirl {
namespace {

SWIRL_WIDE void locate_all(std::size_t points, double side, double half_width,
                           const double* __restrict x, const double* __restrict y,
                           std::int32_t* __restrict cell) {
    const double scale = side / (2.0 * half_width);
    const std::int32_t n = static_cast<std::int32_t>(side);
    for (std::size_t i = 0; i < points; ++i) {
        const double column = (x[i] + half_width) * scale, row = (y[i] + half_width) * scale;
        // A point outside, or NaN, gets row n, column 0: the number after the last cell.
        const bool inside = (column >= 0.0) & (column < side) & (row >= 0.0) & (row < side);
        const double safe_column = inside ? column : 0.0, safe_row = inside ? row : side;
        cell[i] = static_cast<std::int32_t>(safe_row) * n + static_cast<std::int32_t>(safe_column);
    }
}

}  // namespace

void SquareGrid::locate(std::size_t points, const double* x, const double* y,
                        std::int32_t* cell) const {
    locate_all(points, static_cast<double>(side), half_width, x, y, cell);
}

}  // namespace swirl
