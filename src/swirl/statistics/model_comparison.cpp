#include "swirl/statistics/model_comparison.hpp"

#include <algorithm>
#include <cmath>

namespace swirl {
namespace {

/// `f` of the way from a to b.
RotationPoint between(const RotationPoint& a, const RotationPoint& b, double f) {
    return {a.discs + f * (b.discs - a.discs), (1.0 - f) * a.mean + f * b.mean,
            std::hypot((1.0 - f) * a.error, f * b.error)};
}

double square_of_deviation(const RotationPoint& measured, const RotationPoint& model) {
    const double variance = measured.error * measured.error + model.error * model.error;
    return (measured.mean - model.mean) * (measured.mean - model.mean) / variance;
}

/// χ² for a parameter between those of two curves.
double chi_square_between(const ModelCurve& a, const ModelCurve& b, double f,
                          std::span<const RotationPoint> measured) {
    double sum = 0.0;
    for (const RotationPoint& point : measured)
        sum += square_of_deviation(
            point, between(*model_at(a, point.discs), *model_at(b, point.discs), f));
    return sum;
}

}  // namespace

std::optional<RotationPoint> model_at(const ModelCurve& curve, double discs) {
    const auto after =
        std::find_if(curve.points.begin(), curve.points.end(),
                     [&](const RotationPoint& point) { return point.discs >= discs; });
    if (after == curve.points.end()) return {};
    if (after->discs == discs) return *after;
    if (after == curve.points.begin()) return {};
    const RotationPoint& before = *(after - 1);
    return between(before, *after, (discs - before.discs) / (after->discs - before.discs));
}

std::vector<RotationPoint> comparable_points(std::span<const ModelCurve> curves,
                                             std::span<const RotationPoint> measured) {
    std::vector<RotationPoint> common;
    for (const RotationPoint& point : measured)
        if (std::all_of(curves.begin(), curves.end(), [&](const ModelCurve& curve) {
                return model_at(curve, point.discs).has_value();
            }))
            common.push_back(point);
    return common;
}

double chi_square_of(const ModelCurve& curve, std::span<const RotationPoint> measured) {
    double sum = 0.0;
    for (const RotationPoint& point : measured)
        sum += square_of_deviation(point, *model_at(curve, point.discs));
    return sum;
}

std::optional<BestParameter> best_parameter(std::span<const ModelCurve> curves,
                                            std::span<const RotationPoint> measured) {
    constexpr int steps = 1000;  // number between two curves
    const std::vector<RotationPoint> points = comparable_points(curves, measured);
    if (curves.size() < 2 || points.size() < 2) return {};
    struct Tried {
        double parameter, chi_square;
    };
    std::vector<Tried> tried;
    for (std::size_t k = 0; k + 1 < curves.size(); ++k)
        for (int step = 0; step <= steps; ++step) {
            const double f = double(step) / steps;
            tried.push_back({(1.0 - f) * curves[k].parameter + f * curves[k + 1].parameter,
                             chi_square_between(curves[k], curves[k + 1], f, points)});
        }
    const auto best = std::min_element(
        tried.begin(), tried.end(),
        [](const Tried& a, const Tried& b) { return a.chi_square < b.chi_square; });
    BestParameter found{
        .value = best->parameter, .chi_square = best->chi_square, .freedom = points.size() - 1};
    const double limit = found.chi_square + std::max(1.0, found.chi_square / double(found.freedom));
    for (const Tried& each : tried) {
        if (each.chi_square > limit) continue;
        if (std::isnan(found.lower)) found.lower = each.parameter;
        found.upper = each.parameter;
    }
    found.open_below = found.lower == tried.front().parameter;
    found.open_above = found.upper == tried.back().parameter;
    return found;
}

}  // namespace swirl
