#include "swirl/statistics/zero_crossing.hpp"

#include <algorithm>
#include <cmath>

#include "swirl/statistics/student.hpp"

namespace swirl {
namespace {

constexpr double z = normal_95;

std::vector<RotationPoint> usable_points(std::span<const RotationPoint> points) {
    std::vector<RotationPoint> usable;
    for (const RotationPoint& p : points)
        if (std::isfinite(p.discs) && std::isfinite(p.mean) && std::isfinite(p.error) &&
            p.error >= 0.0)
            usable.push_back(p);
    std::stable_sort(usable.begin(), usable.end(),
                     [](const auto& a, const auto& b) { return a.discs < b.discs; });
    return usable;
}

int sign_of(const RotationPoint& p) { return certain_sign_of(p.mean, p.error); }

/// The part of the straight line from a to b that is compatible with zero, as fractions of its
/// length: the part of 0 … 1 in which A f² + 2 B f + C ≤ 0. Empty (first > last) if there is none.
struct Compatible {
    double first = 1.0, last = 0.0;
};

Compatible compatible_with_zero(const RotationPoint& a, const RotationPoint& b) {
    const double va = z * z * a.error * a.error, vb = z * z * b.error * b.error;
    const double A = (b.mean - a.mean) * (b.mean - a.mean) - va - vb;
    const double B = a.mean * (b.mean - a.mean) + va, C = a.mean * a.mean - va;
    const bool at_a = C <= 0.0, at_b = b.mean * b.mean <= vb;
    Compatible found;
    if (at_a) found.first = 0.0;
    if (at_b) found.last = 1.0;
    const double discriminant = B * B - A * C;
    if (at_a == at_b && (at_a || discriminant < 0.0)) return found;
    // The roots without cancellation: their product is C/A.
    const double q = -(B + std::copysign(std::sqrt(std::max(discriminant, 0.0)), B));
    double high = q != 0.0 ? C / q : 0.0, low = A != 0.0 ? q / A : high;
    if (low > high) std::swap(low, high);
    const auto inside = [](double f) { return std::clamp(f, 0.0, 1.0); };
    if (at_a)
        found.last = inside(A > 0.0 ? high : low);
    else if (at_b)
        found.first = inside(A > 0.0 ? low : high);
    else if (A > 0.0 && low <= 1.0 && high >= 0.0)
        found = {inside(low), inside(high)};
    return found;
}

/// The middle zero of the polyline through these points.
double middle_zero(std::span<const RotationPoint> points) {
    std::vector<double> zeros;
    for (std::size_t k = 0; k + 1 < points.size(); ++k) {
        const RotationPoint &a = points[k], &b = points[k + 1];
        if (a.mean == 0.0) zeros.push_back(a.discs);
        if (a.mean * b.mean < 0.0)
            zeros.push_back(a.discs + (b.discs - a.discs) * a.mean / (a.mean - b.mean));
    }
    return zeros[zeros.size() / 2];
}

/// From the points of a bracket: the first and the last sign are certain and opposite, the others
/// undetermined.
SignChange sign_change(std::span<const RotationPoint> points) {
    SignChange change{points.front().discs, points.back().discs, points.front().mean > 0.0};
    change.lower = change.before;
    change.upper = change.after;
    for (const RotationPoint& p : points.subspan(1, points.size() - 2))
        change.between.push_back(p.discs);
    double lower = not_available, upper = not_available;
    for (std::size_t k = 0; k + 1 < points.size(); ++k) {
        const double from = points[k].discs, width = points[k + 1].discs - from;
        if (width > 1.0) return change;
        const Compatible here = compatible_with_zero(points[k], points[k + 1]);
        if (here.first > here.last) continue;
        if (std::isnan(lower)) lower = from + width * here.first;
        upper = from + width * here.last;
    }
    change.discs = middle_zero(points);
    // The interval of exact points has no width; rounding could move its zero out of it.
    change.lower = std::fmin(lower, change.discs);
    change.upper = std::fmax(upper, change.discs);
    change.error = 0.5 * (change.upper - change.lower) / z;
    return change;
}

std::vector<SignChange> sign_changes(const std::vector<RotationPoint>& points) {
    std::vector<SignChange> changes;
    std::size_t last = points.size();  // index of the last point with a certain sign
    for (std::size_t k = 0; k < points.size(); ++k) {
        const int sign = sign_of(points[k]);
        if (sign == 0) continue;
        if (last < k && sign_of(points[last]) != sign)
            changes.push_back(sign_change(std::span(points).subspan(last, k - last + 1)));
        last = k;
    }
    return changes;
}

/// The verdict for points without a change to counterrotation.
Crossing::Verdict one_sign(const std::vector<RotationPoint>& points) {
    const auto all = [&](int sign) {
        return points.size() > 1 &&
               std::all_of(points.begin(), points.end(),
                           [&](const RotationPoint& p) { return sign_of(p) == sign; });
    };
    return all(1)    ? Crossing::Verdict::always_rotates
           : all(-1) ? Crossing::Verdict::always_counterrotates
                     : Crossing::Verdict::undecided;
}

}  // namespace

const SignChange* Crossing::last() const {
    const auto found = std::find_if(changes.rbegin(), changes.rend(),
                                    [](const SignChange& c) { return c.to_counterrotation; });
    return found == changes.rend() ? nullptr : &*found;
}

std::vector<double> Crossing::undetermined_after() const {
    std::vector<double> beyond;
    const SignChange* const change = last();
    for (const double number : undetermined)
        if (change && number > change->after) beyond.push_back(number);
    return beyond;
}

Crossing find_crossing(std::span<const RotationPoint> given) {
    Crossing crossing;
    const std::vector<RotationPoint> points = usable_points(given);
    crossing.points = points.size();
    crossing.changes = sign_changes(points);
    for (const RotationPoint& p : points)
        if (sign_of(p) == 0) crossing.undetermined.push_back(p.discs);
    const SignChange* const change = crossing.last();
    if (!change) {
        crossing.verdict = one_sign(points);
        return crossing;
    }
    crossing.verdict = Crossing::Verdict::crosses;
    crossing.discs = change->discs;
    crossing.error = change->error;
    crossing.lower = change->lower;
    crossing.upper = change->upper;
    return crossing;
}

}  // namespace swirl
