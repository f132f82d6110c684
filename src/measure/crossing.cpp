#include "swirl/measure/crossing.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "swirl/measure/several_runs.hpp"

namespace swirl {
namespace {

constexpr double z = 1.959963984540054;  // 95 %, two-sided

std::vector<RotationPoint> usable(std::span<const RotationPoint> points) {
    std::vector<RotationPoint> kept;
    double smallest = std::numeric_limits<double>::infinity();
    for (const RotationPoint& p : points) {
        if (!std::isfinite(p.discs) || !std::isfinite(p.mean) || !std::isfinite(p.error)) continue;
        if (p.error < 0.0) continue;
        kept.push_back(p);
        if (p.error > 0.0) smallest = std::min(smallest, p.error);
    }
    for (RotationPoint& p : kept)
        if (p.error == 0.0) p.error = std::isfinite(smallest) ? smallest : 1.0;
    std::stable_sort(kept.begin(), kept.end(),
                     [](const auto& a, const auto& b) { return a.discs < b.discs; });
    return kept;
}

/// How many points lie left of the change of sign.
std::size_t best_cut(const std::vector<RotationPoint>& points) {
    double score = 0.0;
    for (const RotationPoint& p : points) score -= p.mean / (p.error * p.error);
    double best = -std::numeric_limits<double>::infinity();
    std::size_t cut = 0;
    for (std::size_t k = 1; k < points.size(); ++k) {
        score += 2.0 * points[k - 1].mean / (points[k - 1].error * points[k - 1].error);
        if (score > best) {
            best = score;
            cut = k;
        }
    }
    return cut;
}

struct Line {
    double centre, height, slope;  // height + slope (N − centre)
    double height_variance, slope_variance;
};

Line fit(std::span<const RotationPoint> points) {
    double w = 0.0, wx = 0.0, wy = 0.0;
    for (const RotationPoint& p : points) {
        const double weight = 1.0 / (p.error * p.error);
        w += weight;
        wx += weight * p.discs;
        wy += weight * p.mean;
    }
    Line line{wx / w, wy / w, 0.0, 1.0 / w, 0.0};
    double xx = 0.0, xy = 0.0;
    for (const RotationPoint& p : points) {
        const double weight = 1.0 / (p.error * p.error), x = p.discs - line.centre;
        xx += weight * x * x;
        xy += weight * x * p.mean;
    }
    line.slope = xy / xx;
    line.slope_variance = 1.0 / xx;
    double chi_square = 0.0;
    for (const RotationPoint& p : points) {
        const double off = (p.mean - line.height - line.slope * (p.discs - line.centre)) / p.error;
        chi_square += off * off;
    }
    if (points.size() > 2) {
        const double freedom = static_cast<double>(points.size() - 2);
        const double student = student_95(freedom) / z;
        const double scattered = chi_square / freedom * student * student;
        const double scale = chi_square > freedom ? scattered : 1.0;
        line.height_variance *= scale;
        line.slope_variance *= scale;
    }
    return line;
}

struct Place {
    double discs, error, lower, upper;
};

/// The zero of the line, which lies between `before` and `after`: their signs are certain.
Place zero_between(const Line& line, double before, double after) {
    const double anywhere = (after - before) / std::sqrt(12.0);
    const double x = -line.height / line.slope, discs = line.centre + x;
    if (!(discs >= before && discs <= after))
        return {0.5 * (before + after), anywhere, before, after};
    const double error =
        std::sqrt(line.height_variance + line.slope_variance * x * x) / std::abs(line.slope);
    Place place{discs, std::min(error, anywhere), before, after};
    // Fieller: A x² + 2 B x + C ≤ 0.
    const double A = line.slope * line.slope - z * z * line.slope_variance;
    const double B = line.height * line.slope;
    const double C = line.height * line.height - z * z * line.height_variance;
    if (!(A > 0.0)) return place;
    const double root = std::sqrt(std::max(B * B - A * C, 0.0));
    place.lower = std::max(before, line.centre + (-B - root) / A);
    place.upper = std::min(after, line.centre + (-B + root) / A);
    return place;
}

/// +1, −1, or 0 for one that is not certain.
int sign_of(const RotationPoint& p) {
    return p.mean > certain_sign * p.error ? 1 : p.mean < -certain_sign * p.error ? -1 : 0;
}

SignChange sign_change(std::span<const RotationPoint> between) {
    SignChange change{between.front().discs, between.back().discs, between.front().mean > 0.0};
    const Place place = zero_between(fit(between), change.before, change.after);
    change.discs = place.discs;
    change.error = place.error;
    return change;
}

/// Of points without a change of sign.
Crossing::Verdict one_sign(const std::vector<RotationPoint>& points) {
    const auto all = [&](int sign) {
        return std::all_of(points.begin(), points.end(),
                           [&](const RotationPoint& p) { return sign_of(p) == sign; });
    };
    return all(1)    ? Crossing::Verdict::always_rotates
           : all(-1) ? Crossing::Verdict::always_counterrotates
                     : Crossing::Verdict::undecided;
}

}  // namespace

std::vector<SignChange> find_sign_changes(std::span<const RotationPoint> given) {
    const std::vector<RotationPoint> points = usable(given);
    std::vector<SignChange> changes;
    std::size_t last = points.size();  // whose sign is certain
    for (std::size_t k = 0; k < points.size(); ++k) {
        const int sign = sign_of(points[k]);
        if (sign == 0) continue;
        if (last < k && sign_of(points[last]) != sign)
            changes.push_back(sign_change(std::span(points).subspan(last, k - last + 1)));
        last = k;
    }
    return changes;
}

Crossing find_crossing(std::span<const RotationPoint> given, int window) {
    Crossing crossing;
    const std::vector<RotationPoint> points = usable(given);
    if (points.empty()) return crossing;

    double highest = -std::numeric_limits<double>::infinity(), lowest = -highest;
    for (const RotationPoint& p : points) {
        highest = std::max(highest, p.mean / p.error);
        lowest = std::min(lowest, p.mean / p.error);
    }
    crossing.most_positive = highest;
    crossing.most_negative = lowest;
    if (points.size() < 2) return crossing;

    const std::size_t cut = best_cut(points);
    double before = not_known, after = not_known;  // the nearest whose signs are certain
    for (std::size_t k = 0; k < cut; ++k)
        if (sign_of(points[k]) > 0) before = points[k].discs;
    for (std::size_t k = points.size(); k-- > cut;)
        if (sign_of(points[k]) < 0) after = points[k].discs;
    if (!(before < after)) {
        crossing.verdict = one_sign(points);
        return crossing;
    }
    const std::size_t reach = static_cast<std::size_t>(std::max(window, 1));
    const std::size_t first = cut > reach ? cut - reach : 0;
    const std::size_t last = std::min(points.size(), cut + reach);
    const Line line = fit(std::span(points).subspan(first, last - first));
    crossing.points_used = static_cast<int>(last - first);
    if (!(line.slope < 0.0)) return crossing;
    const Place place = zero_between(line, before, after);
    crossing.verdict = Crossing::Verdict::crosses;
    crossing.slope = line.slope;
    crossing.discs = place.discs;
    crossing.error = place.error;
    crossing.lower = place.lower;
    crossing.upper = place.upper;
    return crossing;
}

}  // namespace swirl
