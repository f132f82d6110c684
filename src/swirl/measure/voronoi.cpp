#include "swirl/measure/voronoi.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace swirl {
namespace {

/// Marks the sides of the octagon around the container, behind which there is no disc.
constexpr std::uint32_t no_neighbour = static_cast<std::uint32_t>(-1);

/// The angle from a to b, −π … π.
double angle_between(const Vec2& a, const Vec2& b) {
    const double u = turns_of({dot(a, b), cross(a, b)});
    return 2.0 * pi * (u > 0.5 ? u - 1.0 : u);
}

struct InCircle {
    double area, length;
};

/// The part inside the circle |x| < R of the triangle (0, a, b), with sign, and of the side from a
/// to b.
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

/// Corners of a regular octagon around the circle.
std::vector<Vec2> octagon_around(double R) {
    constexpr double cos_22_5_degrees = 0.9238795325112867;
    std::vector<Vec2> corners;
    for (int k = 0; k < 8; ++k)
        corners.push_back((R / cos_22_5_degrees) * unit_circle((k + 0.5) / 8.0));
    return corners;
}

double distance_square(const MFrameView& view, std::uint32_t i, std::uint32_t j) {
    const Vec2 d = view.position(j) - view.position(i);
    return dot(d, d);
}

}  // namespace

/// How far a neighbour of a disc can be and still cut something off its cell.
struct Voronoi::Reach {
    double max_radius;  // largest radius of all discs
    double far;         // distance of the farthest corner: a border beyond it cuts nothing off
    double neighbour;   // distance of a neighbour whose border is that far

    Reach(double farthest, double radius, double largest) : max_radius(largest), far(farthest) {
        const double excess = largest * largest - radius * radius;
        neighbour = excess > 0.0 ? far + square_root(far * far + excess) : 2.0 * far;
    }
};

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
        // Where the outline leaves the half-plane the new side begins; where it returns, the old
        // one continues.
        next_.push_back({cut, da <= 0.0 ? neighbour : a.beyond});
    }
    cell_.swap(next_);
    return true;
}

void Voronoi::clip_by(const MFrameView& view, std::uint32_t disc, std::uint32_t neighbour,
                      Reach& reach) {
    const Vec2 centre = view.position(disc), d = view.position(neighbour) - centre;
    const double r = view.radius[disc], square = dot(d, d);
    if (!(square > 0.0) || square >= reach.neighbour * reach.neighbour) return;
    const double distance = square_root(square);
    const double border =
        (square + r * r - view.radius[neighbour] * view.radius[neighbour]) / (2.0 * distance);
    if (border >= reach.far) return;
    if (clip(centre, (1.0 / distance) * d, border, neighbour))
        reach = Reach(farthest(centre), r, reach.max_radius);
}

void Voronoi::clip_by_neighbours(const MFrameView& view, std::size_t rank, double max_radius) {
    const std::uint32_t i = order_[rank];
    const Vec2 centre = view.position(i);
    const double r = view.radius[i];
    Reach reach(farthest(centre), r, max_radius);

    // First the near discs, the nearest first: they cut off nearly everything.
    const double near = 2.5 * (r + max_radius), near_square = near * near;
    near_.clear();
    const auto add_if_near = [&](std::uint32_t j) {
        const double square = distance_square(view, i, j);
        if (square < near_square) near_.push_back({square, j});
    };
    for (std::size_t k = rank; k > 0 && centre.x - view.x[order_[k - 1]] < near; --k)
        add_if_near(order_[k - 1]);
    for (std::size_t k = rank + 1; k < order_.size() && view.x[order_[k]] - centre.x < near; ++k)
        add_if_near(order_[k]);
    std::sort(near_.begin(), near_.end());
    for (const auto& [square, j] : near_) clip_by(view, i, j, reach);

    // Then the others within reach, outwards in the order of x, alternately to both sides.
    const auto clip_if_far = [&](std::uint32_t j) {
        if (distance_square(view, i, j) >= near_square) clip_by(view, i, j, reach);
    };
    std::size_t left = rank, right = rank + 1;
    bool more_left = true, more_right = true;
    while (more_left || more_right) {
        if (more_left) {
            more_left = left > 0 && centre.x - view.x[order_[left - 1]] < reach.neighbour;
            if (more_left) clip_if_far(order_[--left]);
        }
        if (more_right) {
            more_right =
                right < order_.size() && view.x[order_[right]] - centre.x < reach.neighbour;
            if (more_right) clip_if_far(order_[right++]);
        }
    }
}

void Voronoi::find(const MFrameView& view) {
    const std::size_t n = view.size();
    const double R = view.container_radius;
    areas_.assign(n, 0.0);
    first_.assign(n + 1, 0);
    borders_.clear();
    view.order_by_x(order_);
    std::vector<std::size_t> rank(n, n);
    double max_radius = 0.0;
    for (std::size_t k = 0; k < order_.size(); ++k) {
        rank[order_[k]] = k;
        max_radius = larger(view.radius[order_[k]], max_radius);
    }
    const std::vector<Vec2> octagon = octagon_around(R);

    for (std::size_t i = 0; i < n; ++i) {
        first_[i] = borders_.size();
        if (rank[i] == n) continue;
        cell_.clear();
        for (const Vec2& corner : octagon) cell_.push_back({corner, no_neighbour});
        clip_by_neighbours(view, rank[i], max_radius);
        for (std::size_t k = 0; k < cell_.size(); ++k) {
            const InCircle part = in_circle(cell_[k].at, cell_[(k + 1) % cell_.size()].at, R);
            areas_[i] += part.area;
            if (cell_[k].beyond != no_neighbour && part.length > 0.0)
                borders_.push_back({cell_[k].beyond, part.length});
        }
    }
    first_[n] = borders_.size();
}

}  // namespace swirl
