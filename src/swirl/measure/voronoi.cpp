#include "swirl/measure/voronoi.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace swirl {
namespace {

constexpr std::uint32_t nobody = static_cast<std::uint32_t>(-1);

/// The angle from a to b, −π … π.
double angle_between(const Vec2& a, const Vec2& b) {
    const double u = turns_of({dot(a, b), cross(a, b)});
    return 2.0 * pi * (u > 0.5 ? u - 1.0 : u);
}

struct InCircle {
    double area, length;
};

/// Of the triangle (0, a, b) with sign, and of the side from a to b: the part inside the circle |x|
/// < R.
InCircle in_circle(const Vec2& a, const Vec2& b, double R) {
    const Vec2 side = b - a;
    const double square = R * R;
    if (dot(a, a) <= square && dot(b, b) <= square)
        return {0.5 * cross(a, b), square_root(dot(side, side))};
    const double A = dot(side, side), B = dot(a, side), C = dot(a, a) - R * R;
    const double discriminant = B * B - A * C;
    const double sector = 0.5 * R * R;
    if (!(discriminant > 0.0)) return {sector * angle_between(a, b), 0.0};
    const double root = square_root(discriminant);
    const double enter = (-B - root) / A, leave = (-B + root) / A;
    if (leave <= 0.0 || enter >= 1.0) return {sector * angle_between(a, b), 0.0};
    const Vec2 p = enter > 0.0 ? a + enter * side : a;
    const Vec2 q = leave < 1.0 ? a + leave * side : b;
    double area = 0.5 * cross(p, q);
    if (enter > 0.0) area += sector * angle_between(a, p);
    if (leave < 1.0) area += sector * angle_between(q, b);
    const Vec2 inside = q - p;
    return {area, square_root(dot(inside, inside))};
}

}  // namespace

double Voronoi::farthest(const Vec2& centre) const {
    double square = 0.0;
    for (const Corner& corner : cell_) {
        const Vec2 d = corner.at - centre;
        square = larger(dot(d, d), square);
    }
    return square_root(square);
}

bool Voronoi::clip(const Vec2& centre, const Vec2& towards, double distance,
                   std::uint32_t neighbour) {
    const double offset = dot(centre, towards) + distance;
    depth_.resize(cell_.size());
    double deepest = -never;
    for (std::size_t k = 0; k < cell_.size(); ++k) {
        depth_[k] = dot(cell_[k].at, towards) - offset;
        deepest = larger(depth_[k], deepest);
    }
    if (deepest <= 0.0) return false;

    next_.clear();
    for (std::size_t k = 0; k < cell_.size(); ++k) {
        const std::size_t l = k + 1 < cell_.size() ? k + 1 : 0;
        const Corner &a = cell_[k], &b = cell_[l];
        const double da = depth_[k], db = depth_[l];
        if (da <= 0.0) next_.push_back(a);
        if ((da <= 0.0) == (db <= 0.0)) continue;
        const Vec2 cut = a.at + (da / (da - db)) * (b.at - a.at);
        // Leaving the half-plane, the new side begins; coming back, the old one goes on.
        next_.push_back({cut, da <= 0.0 ? neighbour : a.beyond});
    }
    cell_.swap(next_);
    return true;
}

void Voronoi::find(const MFrameView& view) {
    const std::size_t n = view.size();
    const double R = view.container_radius;
    areas_.assign(n, 0.0);
    first_.assign(n + 1, 0);
    borders_.clear();
    order_.resize(n);
    std::iota(order_.begin(), order_.end(), 0u);
    order_.erase(std::remove_if(order_.begin(), order_.end(),
                                [&](std::uint32_t i) {
                                    const Vec2 p = view.position(i);
                                    return !(dot(p, p) < never);
                                }),
                 order_.end());
    std::sort(order_.begin(), order_.end(), [&](std::uint32_t a, std::uint32_t b) {
        return view.x[a] < view.x[b] || (view.x[a] == view.x[b] && a < b);
    });
    std::vector<std::size_t> rank(n, n);
    double largest = 0.0;
    for (std::size_t k = 0; k < order_.size(); ++k) {
        rank[order_[k]] = k;
        largest = larger(view.radius[order_[k]], largest);
    }

    // Around the container: its corners are not far outside.
    std::vector<Corner> octagon;
    for (int k = 0; k < 8; ++k) {
        const Vec2 p = unit_circle((k + 0.5) / 8.0);
        octagon.push_back({(R / 0.9238795325112867) * p, nobody});  // cos 22.5°
    }

    for (std::size_t i = 0; i < n; ++i) {
        first_[i] = borders_.size();
        if (rank[i] == n) continue;
        const Vec2 centre = view.position(i);
        const double r = view.radius[i];
        cell_ = octagon;
        // Beyond this distance no border can cut anything off the cell.
        double far = 0.0;
        const auto horizon = [&] {
            far = farthest(centre);
            const double excess = largest * largest - r * r;
            return excess > 0.0 ? far + square_root(far * far + excess) : 2.0 * far;
        };
        double reach = horizon();
        const auto meet = [&](std::uint32_t j) {
            const Vec2 d = view.position(j) - centre;
            const double square = dot(d, d);
            if (!(square > 0.0) || square >= reach * reach) return;
            const double distance = square_root(square);
            const double border =
                (square + r * r - view.radius[j] * view.radius[j]) / (2.0 * distance);
            if (border >= far) return;
            if (clip(centre, (1.0 / distance) * d, border, j)) reach = horizon();
        };
        // Outwards from the disc in the order of x, to both sides: first those that are near, the
        // nearest first, which cut off nearly everything; then whoever is still within reach.
        const double near = 2.5 * (r + largest), near_square = near * near;
        const auto distance_square = [&](std::uint32_t j) {
            const Vec2 d = view.position(j) - centre;
            return dot(d, d);
        };
        near_.clear();
        const auto note = [&](std::uint32_t j) {
            const double square = distance_square(j);
            if (square < near_square) near_.push_back({square, j});
        };
        for (std::size_t k = rank[i]; k > 0 && centre.x - view.x[order_[k - 1]] < near; --k)
            note(order_[k - 1]);
        for (std::size_t k = rank[i] + 1; k < order_.size() && view.x[order_[k]] - centre.x < near;
             ++k)
            note(order_[k]);
        std::sort(near_.begin(), near_.end());
        for (const auto& [square, j] : near_) meet(j);
        std::size_t left = rank[i], right = rank[i] + 1;
        bool more_left = true, more_right = true;
        while (more_left || more_right) {
            if (more_left) {
                more_left = left > 0 && centre.x - view.x[order_[left - 1]] < reach;
                if (more_left && distance_square(order_[--left]) >= near_square) meet(order_[left]);
            }
            if (more_right) {
                more_right = right < order_.size() && view.x[order_[right]] - centre.x < reach;
                if (more_right && distance_square(order_[right++]) >= near_square)
                    meet(order_[right - 1]);
            }
        }
        for (std::size_t k = 0; k < cell_.size(); ++k) {
            const InCircle part = in_circle(cell_[k].at, cell_[(k + 1) % cell_.size()].at, R);
            areas_[i] += part.area;
            if (cell_[k].beyond != nobody && part.length > 0.0)
                borders_.push_back({cell_[k].beyond, part.length});
        }
    }
    first_[n] = borders_.size();
}

}  // namespace swirl
