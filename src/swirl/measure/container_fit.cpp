#include "swirl/measure/container_fit.hpp"

#include <algorithm>
#include <numeric>

#include "swirl/math/real.hpp"
#include "swirl/math/unit_circle.hpp"

namespace swirl {
namespace {

constexpr int directions = 360;  // steps of one degree

double length(const Vec2& v) { return square_root(dot(v, v)); }

}  // namespace

double wall_gap(const Snapshot& s) {
    double furthest = 0.0;
    for (std::size_t i = 0; i < s.size(); ++i)
        furthest = std::max(furthest, length(s.position(i) - s.container_centre) + s.radius[i]);
    return s.container_radius - furthest;
}

double closest_pair(const Snapshot& s) {
    std::vector<std::size_t> order(s.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return s.position(a).x < s.position(b).x || (s.position(a).x == s.position(b).x && a < b);
    });
    double largest = 0.0, closest = never;
    for (const double radius : s.radius) largest = std::max(largest, radius);
    for (std::size_t a = 0; a < order.size(); ++a)
        for (std::size_t b = a + 1; b < order.size(); ++b) {
            const std::size_t i = order[a], j = order[b];
            const Vec2 d = s.position(j) - s.position(i);
            if (d.x >= closest * (s.radius[i] + largest)) break;
            closest = std::min(closest, length(d) / (s.radius[i] + s.radius[j]));
        }
    return closest;
}

void FittingPhase::sample(const Snapshot& s) {
    amplitude_ = length(s.container_centre);
    samples_.push_back({s.time() / s.period, s.container_radius, s.container_centre, {}, s.radius});
    for (std::size_t i = 0; i < s.size(); ++i) samples_.back().positions.push_back(s.position(i));
}

double FittingPhase::protrusion(const Sample& sample, const Vec2& centre) {
    double sum = 0.0;
    for (std::size_t i = 0; i < sample.positions.size(); ++i) {
        const double out =
            length(sample.positions[i] - centre) + sample.radii[i] - sample.container_radius;
        if (out > 0.0) sum += out * out;
    }
    return sum;
}

double FittingPhase::protrusion() const {
    double sum = 0.0;
    for (const Sample& sample : samples_) sum += protrusion(sample, sample.centre);
    return sum;
}

FittingPhase::Fit FittingPhase::best(bool clockwise) const {
    std::vector<double> sums;
    double minimum = never;
    for (int k = 0; k < directions; ++k) {
        const double begin = double(k) / directions;
        double sum = 0.0;
        for (const Sample& sample : samples_) {
            const double turns = clockwise ? begin - sample.turns : begin + sample.turns;
            const double whole = static_cast<double>(static_cast<std::int64_t>(turns));
            sum += protrusion(sample, amplitude_ * unit_circle(turns - whole));
        }
        sums.push_back(sum);
        minimum = std::min(minimum, sum);
    }
    // If several fit equally well, the middle of them.
    Vec2 middle{0.0, 0.0};
    for (int k = 0; k < directions; ++k)
        if (sums[std::size_t(k)] <= minimum) middle = middle + unit_circle(double(k) / directions);
    return {2.0 * pi * turns_of(middle), minimum};
}

}  // namespace swirl
