// Robust statistics that the fits to video frames share.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "swirl/math/median.hpp"
#include "swirl/math/vec2.hpp"

namespace swirl::tracking {

/// Standard deviation of normal deviates, relative to their median absolute deviation.
inline constexpr double mad_to_sigma = 1.4826;
/// √(2 ln 2), the median length of a vector of two standard normal deviates.
inline constexpr double length_median = 1.1774;

/// Tukey's biweight of a residual `q` in units of the cutoff; 0 from the cutoff on.
inline double tukey_weight(double q) {
    const double p = 1.0 - q * q;
    return p > 0.0 ? p * p : 0.0;
}

/// Vertex of the parabola through three equally spaced samples, in steps from the middle one; 0 if
/// the parabola has no maximum.
template <typename Real>
double vertex_offset(Real before, Real here, Real after) {
    const Real bend = before - Real(2) * here + after;
    return bend < Real(0) ? 0.5 * double((before - after) / bend) : 0.0;
}

/// The value below which this share of `values` lies; 0 if there are none.
inline double quantile(std::vector<double> values, double share) {
    if (values.empty()) return 0.0;
    const auto at = values.begin() + std::ptrdiff_t(share * double(values.size() - 1));
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

/// Maximises value() over `numbers` by coordinate search; steps shrink if none improves it, until
/// the first one is below `settled`.
template <std::size_t count, typename Value>
void maximise(const std::array<double*, count>& numbers, std::array<double, count> steps,
              double settled, const Value& value) {
    double best = value();
    for (int round = 0; round < 300 && steps[0] > settled; ++round) {
        bool better = false;
        for (std::size_t n = 0; n < count; ++n)
            for (const double step : {steps[n], -steps[n]}) {
                const double before = *numbers[n];
                *numbers[n] += step;
                if (const double now = step != 0.0 ? value() : -1e300; now > best) {
                    best = now;
                    better = true;
                    break;
                }
                *numbers[n] = before;
            }
        if (!better)
            for (double& step : steps) step *= 0.6;
    }
}

/// The medians of both coordinates.
inline Vec2 median_point(const std::vector<Vec2>& points) {
    std::vector<double> xs, ys;
    for (const Vec2& p : points) xs.push_back(p.x), ys.push_back(p.y);
    return {median(xs), median(ys)};
}

}  // namespace swirl::tracking
