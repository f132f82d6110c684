#include "lab/zero_crossing.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace swirl {
namespace {

constexpr double beyond_doubt = 3.0;

ZeroCrossing zero_of_line(std::span<const CurvePoint> points) {
    // About the weighted mean of x, where a and b are uncorrelated.
    double W = 0.0, Wx = 0.0;
    for (const CurvePoint& p : points) {
        const double w = 1.0 / (p.error * p.error);
        W += w;
        Wx += w * p.x;
    }
    const double centre = Wx / W;
    double Wy = 0.0, Wxx = 0.0, Wxy = 0.0;
    for (const CurvePoint& p : points) {
        const double w = 1.0 / (p.error * p.error), x = p.x - centre;
        Wy += w * p.y;
        Wxx += w * x * x;
        Wxy += w * x * p.y;
    }
    const double a = Wy / W, b = Wxy / Wxx;
    double chi_square = 0.0;
    for (const CurvePoint& p : points) {
        const double residual = (p.y - a - b * (p.x - centre)) / p.error;
        chi_square += residual * residual;
    }
    const double degrees = static_cast<double>(points.size()) - 2.0;
    const double scatter = degrees > 0.0 ? std::max(1.0, chi_square / degrees) : 1.0;
    const double x = -a / b;
    const double error = std::sqrt(scatter * (1.0 / W + x * x / Wxx)) / std::fabs(b);
    return {centre + x, error, b < 0.0};
}

}  // namespace

std::optional<ZeroCrossing> zero_crossing(std::span<const CurvePoint> curve) {
    std::vector<CurvePoint> points;
    for (const CurvePoint& p : curve)
        if (std::isfinite(p.y) && p.error > 0.0) points.push_back(p);

    const auto certain_sign = [&](std::size_t k) {
        if (std::fabs(points[k].y) < beyond_doubt * points[k].error) return 0;
        return points[k].y > 0.0 ? 1 : -1;
    };
    std::size_t last = points.size();  // the last point whose sign is certain
    for (std::size_t k = 0; k < points.size(); ++k) {
        const int sign = certain_sign(k);
        if (sign == 0) continue;
        if (last < points.size() && sign != certain_sign(last)) {
            const std::size_t from = last > 0 ? last - 1 : last;
            const std::size_t to = std::min(k + 2, points.size());
            return zero_of_line(std::span(points).subspan(from, to - from));
        }
        last = k;
    }
    return {};
}

}  // namespace swirl
