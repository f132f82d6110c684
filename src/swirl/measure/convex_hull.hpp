// The convex hull of points and its perimeter: Andrew's monotone chain (Andrew 1979,
// doi:10.1016/0020-0190(79)90072-3), O(N log N).
//
// Limits: no points or one: perimeter 0; points on a line: twice their length.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "swirl/math/real.hpp"
#include "swirl/math/vec2.hpp"

namespace swirl {

/// Corners of the hull, counter-clockwise from the leftmost. Sorts `points`; needs finite numbers.
inline std::vector<Vec2> convex_hull(std::vector<Vec2>& points) {
    std::sort(points.begin(), points.end(),
              [](const Vec2& a, const Vec2& b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
    std::vector<Vec2> hull;
    hull.reserve(points.size() + 1);
    const auto extend = [&hull](const Vec2& p, std::size_t keep) {
        while (hull.size() >= keep + 2 &&
               cross(hull.back() - hull[hull.size() - 2], p - hull.back()) <= 0.0)
            hull.pop_back();
        hull.push_back(p);
    };
    for (const Vec2& p : points) extend(p, 0);
    if (points.size() < 2) return hull;
    const std::size_t lower = hull.size() - 1;
    for (std::size_t k = points.size() - 1; k-- > 0;) extend(points[k], lower);
    hull.pop_back();
    return hull;
}

inline double perimeter(const std::vector<Vec2>& polygon) {
    double length = 0.0;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
        const Vec2 side = polygon[(k + 1) % polygon.size()] - polygon[k];
        length += square_root(dot(side, side));
    }
    return length;
}

}  // namespace swirl
