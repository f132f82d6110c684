// Fit of a power law y = a x^b, for scaling with the size of a system.
//
// A straight line ln y = ln a + b ln x by least squares, each point weighted with the inverse
// square of its relative error. If the points scatter about the line more than their errors
// explain, χ² > n − 2, the error of b grows by √(χ²/(n − 2)). The error also grows by Student's
// factor if the scatter determines it.
//
// Limits: points without a positive finite value or error are omitted. Fewer than three points have
// no law: all is NaN, because two points fit any law.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

#include "swirl/statistics/block_average.hpp"
#include "swirl/statistics/student.hpp"

namespace swirl {

struct PowerLawPoint {
    double x, y, error;  // the error is that of y
};

struct PowerLaw {
    double exponent = not_available, error = not_available;
    double factor = not_available;      // a
    double chi_square = not_available;  // fit to ln y
    std::size_t points = 0;
};

inline PowerLaw fit_power_law(std::span<const PowerLawPoint> given) {
    double weight = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0, yy = 0.0;
    PowerLaw law;
    for (const PowerLawPoint& p : given) {
        if (!(p.x > 0.0 && p.y > 0.0 && p.error > 0.0 && std::isfinite(p.y / p.error))) continue;
        const double w = (p.y / p.error) * (p.y / p.error), lx = std::log(p.x), ly = std::log(p.y);
        ++law.points;
        weight += w;
        x += w * lx;
        y += w * ly;
        xx += w * lx * lx;
        xy += w * lx * ly;
        yy += w * ly * ly;
    }
    const double spread = xx - x * x / weight;
    if (law.points < 3 || !(spread > 0.0)) return law;
    law.exponent = (xy - x * y / weight) / spread;
    law.factor = std::exp((y - law.exponent * x) / weight);
    law.chi_square = std::max(0.0, yy - y * y / weight - law.exponent * (xy - x * y / weight));
    const double freedom = static_cast<double>(law.points) - 2.0;
    law.error = std::sqrt(1.0 / spread);
    if (law.chi_square > freedom)
        law.error *= std::sqrt(law.chi_square / freedom) * student_95(freedom) / student_95(1e9);
    return law;
}

}  // namespace swirl
