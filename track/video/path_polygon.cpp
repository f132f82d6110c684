#include "track/video/path_polygon.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "swirl/math/unit_circle.hpp"
#include "track/video/circles.hpp"

namespace swirl::tracking {

namespace {

/// Distances of the centres from the fitted circle, positive outwards, without outliers.
struct RadialDeviations {
    std::vector<double> outward, angles;
    double square = 0.0;  // sum of all squares

    /// Standard error of a harmonic, if `explained` of the sum of squares is explained. The ellipse
    /// of a tilted camera makes it larger, which is on the safe side.
    double error(double explained = 0.0) const {
        return std::sqrt(2.0 * std::max(0.0, square - explained)) / double(outward.size());
    }
};

RadialDeviations radial_deviations(const std::vector<Vec2>& centres, const TrackedPath& path) {
    constexpr double outlier = 5.0, min_outlier = 0.5;  // standard deviations; pixels
    RadialDeviations all;
    const double cut = std::max(outlier * path.residual, min_outlier);
    for (const Vec2& c : centres) {
        const Vec2 d = c - path.centre;
        const double outward = length(d) - path.amplitude;
        if (std::abs(outward) > cut) continue;
        all.outward.push_back(outward);
        all.angles.push_back(std::atan2(-d.y, d.x));
        all.square += outward * outward;
    }
    return all;
}

/// The best fit with n waves per turn.
struct PathHarmonic {
    double size = 0.0;
    double explained = 0.0;   // of the sum of squares
    bool determined = false;  // false at two frames a wave: sine and cosine are then proportional
};

PathHarmonic harmonic_of(const RadialDeviations& all, int n) {
    constexpr double min_independence = 0.1;  // determinant, relative to two independent parts
    double cc = 0.0, cs = 0.0, ss = 0.0, c = 0.0, s = 0.0;
    for (std::size_t k = 0; k < all.outward.size(); ++k) {
        const double x = std::cos(n * all.angles[k]), y = std::sin(n * all.angles[k]);
        cc += x * x, cs += x * y, ss += y * y;
        c += all.outward[k] * x, s += all.outward[k] * y;
    }
    const double determinant = cc * ss - cs * cs, half = 0.5 * double(all.outward.size());
    if (!(determinant > min_independence * half * half)) return {};
    const double a = (ss * c - cs * s) / determinant, b = (cc * s - cs * c) / determinant;
    return {std::hypot(a, b), a * c + b * s, true};
}

/// The distance of the vertices from the centre, calculated from the mean distance along the path.
double vertex_distance(double amplitude, int sides) {
    const double half = pi / sides;
    const double mean = std::cos(half) / half * std::log(1.0 / std::cos(half) + std::tan(half));
    return amplitude / mean;
}

}  // namespace

PathPolygon find_path_polygon(const std::vector<Vec2>& centres, const std::vector<double>& times,
                              const TrackedPath& path) {
    constexpr int min_sides = 3, min_per_side = 2;  // frames
    constexpr std::size_t min_frames = 16;          // fewer have no harmonics above the noise
    constexpr double size_tolerance = 0.35;         // relative: hand-made paths are not regular
    constexpr double competitor = 0.5;              // of the square that the best one explains
    constexpr double stands_out = 5.0, absent = 3.0, distinct = 2.0;  // standard errors
    PathPolygon polygon;
    if (centres.size() < min_frames) return polygon;
    const RadialDeviations all = radial_deviations(centres, path);
    if (all.outward.size() < min_frames) return polygon;
    const double step = (times.back() - times.front()) / double(times.size() - 1);
    const double per_period = 2.0 * pi / (path.omega * step), error = all.error();
    const auto expected = [&](double n) { return 2.0 * path.amplitude / (n * n); };
    const int limit = static_cast<int>(per_period / min_per_side);
    int in_doubt = limit + 1;  // the fewest sides that are neither detected nor excluded
    std::vector<std::pair<int, PathHarmonic>> fitting;
    for (int n = min_sides; n <= limit && expected(n) >= stands_out * error; ++n) {
        const PathHarmonic found = harmonic_of(all, n);
        if (!found.determined) break;
        polygon.max_sides = n;
        if (found.size > stands_out * error &&
            std::abs(found.size / expected(n) - 1.0) < size_tolerance)
            fitting.emplace_back(n, found);
        else if (found.size > expected(n) - absent * error)
            in_doubt = std::min(in_doubt, n);
    }
    const auto best = std::max_element(
        fitting.begin(), fitting.end(),
        [](const auto& a, const auto& b) { return a.second.explained < b.second.explained; });
    if (best == fitting.end()) {
        polygon.max_sides = std::min(polygon.max_sides, in_doubt - 1);
        return polygon;
    }
    // A polygon that has less than two frames per side is distinguished by its size alone.
    const auto& [sides, seen] = *best;
    const double alias = expected(per_period - sides), off = std::abs(seen.size - expected(sides));
    bool unique = off < std::abs(seen.size - alias) &&
                  std::abs(seen.size - alias) > distinct * all.error(seen.explained);
    for (const auto& [n, other] : fitting) {
        if (n == sides || other.explained < competitor * seen.explained) continue;
        unique = false;
        in_doubt = std::min(in_doubt, n);
    }
    if (unique) {
        polygon.sides = sides;
        polygon.vertex_distance = vertex_distance(path.amplitude, sides);
    } else {
        polygon.max_sides = std::min(in_doubt, sides) - 1;
    }
    return polygon;
}

}  // namespace swirl::tracking
