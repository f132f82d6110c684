// Pairs of discs with their distance, for measurements that are functions of it.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "swirl/measure/m_frame.hpp"

namespace swirl {

/// Bins of the distance between two centres, from 0 to the container's diameter, but not beyond 20.
/// They are 0.1 wide, less in a small container.
struct DistanceBins {
    /// `r` is the radius of a disc.
    DistanceBins(double container_radius, double r)
        : width(std::min(0.1 * r, container_radius / 80.0)),
          reach(std::min(2.0 * container_radius, 20.0 * r)),
          count(static_cast<std::size_t>(std::ceil(reach / width - 1e-9))) {}

    double width;
    double reach;  // longer distances are in no bin
    std::size_t count;

    double lower(std::size_t bin) const { return width * static_cast<double>(bin); }
    double upper(std::size_t bin) const { return std::min(lower(bin + 1), reach); }
    double middle(std::size_t bin) const { return 0.5 * (lower(bin) + upper(bin)); }
    std::size_t bin_of(double distance) const {
        return std::min(static_cast<std::size_t>(distance / width), count - 1);
    }
};

/// Calls visit(i, j, distance) for each pair of discs closer than `reach`, in an order that depends
/// on the positions alone. No pair has a disc without a finite position. `order` is scratch memory.
template <class Visit>
void for_each_close_pair(const MFrameView& view, double reach, std::vector<std::uint32_t>& order,
                         const Visit& visit) {
    view.order_by_x(order);
    for (std::size_t a = 0; a < order.size(); ++a)
        for (std::size_t b = a + 1; b < order.size(); ++b) {
            const std::uint32_t i = order[a], j = order[b];
            const Vec2 d = view.position(j) - view.position(i);
            if (d.x >= reach) break;
            const double square = dot(d, d);
            if (square < reach * reach) visit(i, j, square_root(square));
        }
}

}  // namespace swirl
