// Spheres that roll on a floor, at the friction of plastic (μ = 0.2). Their curve ϖ(N) has minima
// and maxima, which the curve of the discs does not have (docs/explanation/spheres.md).
//
// Figure "spheres_packing": the maximum of ϖ near N = 28 to 30, and the packing of the cluster.
// Figure "spheres_size": spheres in dishes of different sizes.
// Both have the experiment at half the amplitude, μ = 0.2 and floor friction 0.3.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "swirl/paper/chapter_runs.hpp"
#include "swirl/paper/chapters.hpp"
#include "swirl/paper/curves.hpp"
#include "swirl/paper/points.hpp"
#include "swirl/paper/rank_correlation.hpp"
#include "swirl/paper/results.hpp"
#include "swirl/run/parameters.hpp"
#include "swirl/run/report.hpp"

namespace swirl {
namespace {

RunConfig experiment_of(const PaperSettings& settings, std::int64_t spheres) {
    RunConfig config = spheres_of_chapters();
    config.discs = spheres;
    config.seed = settings.seed;
    config.warmup = settings.periods(50, 2);
    config.periods = *config.warmup + settings.periods(200, 5);
    return config;
}

// --- Packing --------------------------------------------------------------------------------

/// A quantity of the cluster that may explain the maximum of ϖ.
struct PackingQuantity {
    const char *measurement, *name, *words;
};
constexpr PackingQuantity packing_quantities[] = {
    {"order", "all", "hexatic order"},
    {"contact_network", "coordination", "contacts of a sphere"},
    {"contact_network", "wall", "share at the wall"},
    {"centre", "elongation", "elongation"},
    {"slip", "cluster", "slip parameter"}};

/// What remains of the values after a parabola in N is subtracted. A smooth dependence on N says
/// nothing about a maximum.
std::vector<double> without_trend(const std::vector<double>& values) {
    // Orthogonal polynomials of degree 0, 1 and 2 on equally spaced points.
    const auto n = static_cast<double>(values.size());
    std::vector<double> rest = values;
    for (int degree = 0; degree <= 2; ++degree) {
        const auto polynomial = [&](std::size_t k) {
            const double x = static_cast<double>(k) - 0.5 * (n - 1.0);
            return degree == 0 ? 1.0 : degree == 1 ? x : x * x - (n * n - 1.0) / 12.0;
        };
        double product = 0.0, square = 0.0;
        for (std::size_t k = 0; k < rest.size(); ++k) {
            product += rest[k] * polynomial(k);
            square += polynomial(k) * polynomial(k);
        }
        for (std::size_t k = 0; k < rest.size(); ++k) rest[k] -= product / square * polynomial(k);
    }
    return rest;
}

/// The error of the coefficient; the parabola uses three points.
double error_of_correlation(double coefficient, std::size_t points) {
    return (1.0 - coefficient * coefficient) / std::sqrt(static_cast<double>(points) - 4.0);
}

std::vector<std::int64_t> numbers_of_packing(const PaperSettings& settings) {
    std::vector<std::int64_t> numbers;
    for (std::int64_t n = 20; n <= 44; n += settings.quick ? 3 : 1) numbers.push_back(n);
    return numbers;
}

/// The coefficients, the strongest first.
FigureOutcome packing_outcome(const CurveFigure& figure, const std::vector<Json>& results,
                              const fs::path& out) {
    FigureOutcome outcome;
    figure.write_points(results, out, outcome);
    std::vector<double> rotation;
    for (const Json& r : results)
        rotation.push_back(number(at(r, {"rotation", "by_time", "mean"})));
    rotation = without_trend(rotation);
    struct Found {
        const PackingQuantity* quantity;
        double coefficient, error;
    };
    std::vector<Found> found;
    for (const PackingQuantity& q : packing_quantities) {
        std::vector<double> values;
        for (const Json& r : results)
            values.push_back(number(at(r, {"measured", q.measurement, q.name, "mean"})));
        const double coefficient = correlation_of(without_trend(values), rotation);
        found.push_back({&q, coefficient, error_of_correlation(coefficient, results.size())});
    }
    std::stable_sort(found.begin(), found.end(), [](const Found& a, const Found& b) {
        return std::fabs(a.coefficient) > std::fabs(b.coefficient);
    });
    Table table({"quantity", "correlation", "correlation_error"});
    std::vector<std::string> words;
    for (const Found& f : found) {
        table.add({std::string(f.quantity->words), f.coefficient, f.error});
        words.push_back(
            fmt::format("{} {}", f.quantity->words, with_error(f.coefficient, f.error)));
    }
    outcome.write(table, figure.name + "_correlations", out);
    outcome.findings.push_back(fmt::format(
        "Correlation with ϖ over N = {} to {}, without a parabola in N: {}.",
        figure.points.front().discs, figure.points.back().discs, fmt::join(words, ", ")));
    return outcome;
}

}  // namespace

static FigurePlan plan_figure_spheres_packing(const PaperSettings& settings) {
    FigurePlan plan;
    CurveFigure figure{"spheres_packing", {"curve"}, {{"0.2", {std::string("0.2")}, "μ = 0.2"}}};
    for (const PackingQuantity& q : packing_quantities)
        figure.measured.push_back(
            fmt::format("{}.{}={}", q.measurement, q.name,
                        q.name == std::string_view("all") ? "order" : q.name));
    figure.add_points(numbers_of_packing(settings));
    for (const CurveFigure::Point& p : figure.points) {
        const RunConfig config = experiment_of(settings, p.discs);
        plan.points.push_back(varied_point(
            settings, fmt::format("spheres-packing_N{}_{}", p.discs, length_of(config)), config,
            chapter_seeds(settings), {"order", "contact_network", "centre", "slip"}));
    }
    plan.finish = [figure](const std::vector<Json>& results, const fs::path& out) {
        return packing_outcome(figure, results, out);
    };
    return plan;
}

// --- Size -----------------------------------------------------------------------------------

static FigurePlan plan_figure_spheres_size(const PaperSettings& settings) {
    std::vector<double> radii{8.5}, fractions{0.28, 0.46, 0.58};
    if (!settings.quick) {
        radii = {6.0, 8.5, 12.0, 17.0};
        fractions = {0.1, 0.2, 0.28, 0.34, 0.4, 0.46, 0.52, 0.58};
    }
    DishPoints points;
    for (const double radius : radii)
        for (const double fraction : fractions)
            points.add({.radius = radius, .amplitude = 0.22, .spheres = true}, fraction);
    return plan_dishes(settings, "spheres_size", points);
}

std::vector<PaperFigure> chapter_spheres() {
    return {{"spheres_packing", "chapter: rotation and packing of spheres",
             plan_figure_spheres_packing},
            {"spheres_size", "chapter: spheres in containers of different sizes",
             plan_figure_spheres_size}};
}

}  // namespace swirl
