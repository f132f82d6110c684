// Material: how the number N_c at which the direction changes depends on two properties of the
// discs. One figure each for inertia and restitution, both friction coefficients, and tangential
// restitution and inertia.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "swirl/paper/chapters.hpp"
#include "swirl/paper/coarse_zero.hpp"
#include "swirl/paper/curves.hpp"
#include "swirl/paper/points.hpp"
#include "swirl/run/report.hpp"

namespace swirl {
namespace {

struct MaterialMap {
    std::string name, x_name, y_name, x_symbol, y_symbol;
    std::vector<double> x, y;
    std::function<void(RunConfig&, double x, double y)> set;
    std::vector<std::int64_t> numbers;
};

FigureOutcome finish_material(const MaterialMap& map, const CurveFigure& figure,
                              const std::vector<Json>& results, const fs::path& out) {
    FigureOutcome outcome;
    Table table({map.x_name, map.y_name, "crossing", "crossing_error", "lowest", "lowest_error",
                 "lowest_discs", "highest", "highest_error"});
    const std::vector<NamedCurve> curves = figure.named_curves(results);
    std::string least_words = "none", most_words = "none";
    double least = INFINITY, most = -INFINITY;
    std::size_t without = 0;
    for (std::size_t c = 0; c < curves.size(); ++c) {
        CoarseZero zero = last_zero(curves[c].points());
        if (!zero.falls) zero = {};
        const RotationPoint* const lowest = lowest_of(curves[c].points());
        const RotationPoint* const highest = highest_of(curves[c].points());
        std::vector<Table::Cell> row = figure.curves[c].cells;
        for (const double value :
             {zero.discs, zero.error, lowest ? lowest->mean : not_available,
              lowest ? lowest->error : not_available, lowest ? lowest->discs : not_available,
              highest ? highest->mean : not_available, highest ? highest->error : not_available})
            row.emplace_back(value);
        table.add(std::move(row));
        const std::string words =
            fmt::format("{} at {}", with_error(zero.discs, zero.error), figure.curves[c].words);
        if (!zero.exists()) ++without;
        if (zero.discs < least) least = zero.discs, least_words = words;
        if (zero.discs > most) most = zero.discs, most_words = words;
    }
    outcome.write(table, map.name, out);
    figure.write_points(results, out, outcome);
    outcome.findings.push_back(
        fmt::format("N_c is lowest, {}, and highest, {}; at {} of {} settings the direction does "
                    "not certainly change up to N = {}.",
                    least_words, most_words, without, curves.size(), map.numbers.back()));
    return outcome;
}

FigurePlan plan_material(const PaperSettings& settings, const MaterialMap& map) {
    FigurePlan plan;
    CurveFigure figure{map.name + "_points", {map.x_name, map.y_name}, {}};
    for (const double x : map.x)
        for (const double y : map.y)
            figure.curves.push_back(
                {"", {x, y}, fmt::format("{} = {}, {} = {}", map.x_symbol, x, map.y_symbol, y)});
    figure.add_points(map.numbers);
    for (const CurveFigure::Point& p : figure.points) {
        const double x = map.x[p.curve / map.y.size()], y = map.y[p.curve % map.y.size()];
        RunConfig config = paper_config(settings, high_friction, p.discs);
        map.set(config, x, y);
        config.warmup = settings.periods(20, 2);
        config.periods = *config.warmup + settings.periods(80, 4);
        plan.points.push_back(varied_point(
            settings, fmt::format("{}_x{}_y{}_N{}_{}", map.name, x, y, p.discs, length_of(config)),
            config, chapter_seeds(settings)));
    }
    plan.finish = [=](const std::vector<Json>& results, const fs::path& out) {
        return finish_material(map, figure, results, out);
    };
    return plan;
}

std::vector<std::int64_t> material_numbers(const PaperSettings& settings) {
    if (settings.quick) return {28, 36, 44, 52};
    // Dense clusters have states of their own at each N, so that no curve through N = 48, 51 and 54
    // is smooth.
    return {28, 32, 36, 40, 44, 48, 50, 51, 52, 53, 54};
}

FigurePlan plan_material_inertia(const PaperSettings& settings) {
    MaterialMap map{"material_inertia",
                    "inertia",
                    "restitution",
                    "I",
                    "e",
                    {0.5, 1.0, 3.0, 10.0},
                    {1.0, 0.97, 0.9},
                    [](RunConfig& c, double inertia, double e) {
                        c.inertia = inertia;
                        c.restitution = e;
                    },
                    material_numbers(settings)};
    if (settings.quick) map.x = {0.5, 10.0}, map.y = {1.0, 0.9};
    return plan_material(settings, map);
}

FigurePlan plan_material_friction(const PaperSettings& settings) {
    MaterialMap map{"material_friction",
                    "mu_disc",
                    "mu_wall",
                    "μ_d",
                    "μ_w",
                    {0.1, 0.3, 1.0, 3.0},
                    {0.1, 0.3, 1.0, 3.0},
                    [](RunConfig& c, double mu_disc, double mu_wall) {
                        c.mu_disc = mu_disc;
                        c.mu_wall = mu_wall;
                    },
                    material_numbers(settings)};
    if (settings.quick) map.x = map.y = {0.3, 1.0};
    return plan_material(settings, map);
}

FigurePlan plan_material_tangential(const PaperSettings& settings) {
    MaterialMap map{"material_tangential",
                    "tangential_restitution",
                    "inertia",
                    "β",
                    "I",
                    {0.0, 0.25, 0.5, 1.0},
                    {0.5, 10.0},
                    [](RunConfig& c, double beta, double inertia) {
                        c.tangential_restitution = beta;
                        c.inertia = inertia;
                    },
                    material_numbers(settings)};
    if (settings.quick) map.x = {0.0, 0.5}, map.y = {0.5, 10.0};
    return plan_material(settings, map);
}

}  // namespace

std::vector<PaperFigure> chapter_material() {
    return {
        {"material_inertia", "chapter: N_c against inertia and restitution", plan_material_inertia},
        {"material_friction", "chapter: N_c against both friction coefficients",
         plan_material_friction},
        {"material_tangential", "chapter: N_c against tangential restitution and inertia",
         plan_material_tangential}};
}

}  // namespace swirl
