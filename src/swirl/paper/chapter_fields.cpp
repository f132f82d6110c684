// Is a cluster of discs a micropolar fluid? The paper's outlook asks for continuum equations that
// couple the spins to the vorticity of the flow.
//
// Figure "fields": maps of density, flow and spin in a large dish, and the torque of the stress
// against the relation of a micropolar fluid. Figure "closure": the coefficients of all relations
// and the share of the stresses that they explain, by packing fraction, in several dishes.
//
// The fit is that of fluid_relations.hpp, for one range of the packing fraction at a time. Fields:
// measure/field_grid.hpp, with the kernel of four radii in the M-frame.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "swirl/paper/chapter_runs.hpp"
#include "swirl/paper/chapters.hpp"
#include "swirl/paper/fluid_relations.hpp"
#include "swirl/paper/points.hpp"
#include "swirl/paper/results.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/measurements.hpp"
#include "swirl/run/report.hpp"

namespace swirl {
namespace {

constexpr double amplitude_ratio = 0.22;  // A/R, the paper's
constexpr double range_width = 0.1, first_range = 0.2;
constexpr int ranges = 7;  // of the packing fraction
constexpr std::size_t least_points = 10;

using DishPoint = DishPoints::Point;

/// The first one is drawn as maps.
std::vector<DishPoint> dishes_with_fields(const PaperSettings& settings) {
    DishPoints dishes;
    if (settings.quick) {
        dishes.add({17.2, amplitude_ratio}, 0.45);
        return dishes.points;
    }
    for (const double fraction : {0.42, 0.26, 0.55}) dishes.add({34.4, amplitude_ratio}, fraction);
    dishes.add({17.2, amplitude_ratio}, 0.45);
    return dishes.points;
}

/// The jackknife needs four.
int field_seeds(const PaperSettings& settings) { return settings.quick ? 4 : 8; }

/// The means of all columns, and the largest residual of the three balances.
Json fields_run(const RunConfig& config, const RunControl& control) {
    const MeasuredRun done = measured_run(config, {"fields"}, control);
    if (!done.run.complete) throw Interrupted("Stopped.");
    const Json& fields = at(done.measured, {"fields"});
    Json result{{"fields", Json::object()}, {"residual", 0.0}};
    for (const auto& [name, column] : at(fields, {"m_frame_4"}).items())
        if (!name.ends_with("_error")) result["fields"][name] = column;
    for (const char* name : {"mass_residual", "momentum_residual", "spin_residual"})
        result["residual"] = std::max(number(result["residual"]), number(at(fields, {name})));
    return result;
}

FigurePlan plan_of_dishes(const PaperSettings& settings, const std::vector<DishPoint>& dishes) {
    FigurePlan plan;
    for (const DishPoint& p : dishes) {
        RunConfig config = dish_config(settings, p.dish, p.discs);
        config.warmup = settings.periods(10, 2);
        config.periods = *config.warmup + settings.periods(30, 5);
        add_seeds(plan, config, field_seeds(settings),
                  fmt::format("fields_R{}_N{}_{}", p.dish.radius, p.discs, length_of(config)),
                  2.0 * expected_events_per_period(config) * double(*config.periods), fields_run);
    }
    return plan;
}

FieldSeeds fields_of_seeds(const std::vector<Json>& results, std::size_t k, int seeds) {
    FieldSeeds all;
    for (const Json& run : results_of_seeds(results, k, seeds)) {
        FieldColumns& columns = all.emplace_back();
        for (const auto& [name, column] : run["fields"].items())
            for (const Json& value : column) columns[name].push_back(number(value));
    }
    return all;
}

std::string words_of_range(const FieldRegion& region) {
    return fmt::format("{:.1f}–{:.1f}", region.low, region.high);
}

/// The ranges of the packing fraction in a dish of this radius. A kernel of four radii is out of
/// reach of the wall's contacts, which extend inwards to the centres of the discs.
std::vector<FieldRegion> field_regions(double radius) {
    constexpr double kernel = 4.0, disc = 1.0;
    std::vector<FieldRegion> all;
    for (int k = 0; k < ranges; ++k)
        all.push_back({first_range + range_width * k, first_range + range_width * (k + 1),
                       radius - disc - kernel});
    return all;
}

// --- Maps -----------------------------------------------------------------------------------

/// Mean and standard error over the seeds of a number of each seed.
template <class NumberOf>
Estimate mean_of_seeds(const FieldSeeds& seeds, const NumberOf& number_of) {
    const auto n = static_cast<double>(seeds.size());
    double sum = 0.0, squares = 0.0;
    for (const FieldColumns& seed : seeds) sum += number_of(seed);
    const double mean = sum / n;
    for (const FieldColumns& seed : seeds)
        squares += (number_of(seed) - mean) * (number_of(seed) - mean);
    return {.mean = mean, .error = std::sqrt(squares / (n * (n - 1.0)))};
}

const std::vector<std::string> mapped{"packing", "u_x", "u_y", "spin", "vorticity", "torque"};

/// A row for each point of the grid within the container.
Table table_of_maps(const FieldSeeds& seeds, double radius,
                    const std::vector<std::pair<FieldRegion, Estimate>>& viscosities) {
    Table table(joined(joined({"x", "y"}, number_columns(mapped)), number_columns({"relation"})));
    if (seeds.empty()) return table;
    const FieldColumns& first = seeds.front();
    for (std::size_t p = 0; p < first.at("x").size(); ++p) {
        const double x = first.at("x")[p], y = first.at("y")[p];
        if (!(x * x + y * y < radius * radius)) continue;
        std::vector<Table::Cell> row{x, y};
        for (const std::string& name : mapped)
            add_estimate(
                row, mean_of_seeds(seeds, [&](const FieldColumns& f) { return f.at(name)[p]; }));
        const double packing = std::get<double>(row[2]);
        double viscosity = not_available;
        for (const auto& [region, value] : viscosities)
            if (region.contains(packing, x, y)) viscosity = value.mean;
        add_estimate(row, mean_of_seeds(seeds, [&](const FieldColumns& f) {
                         return viscosity * fluid_relations[0].at(f, p).x[0];
                     }));
        table.add(std::move(row));
    }
    return table;
}

FigurePlan plan_figure_fields(const PaperSettings& settings) {
    std::vector<DishPoint> dishes = dishes_with_fields(settings);
    dishes.resize(1);
    FigurePlan plan = plan_of_dishes(settings, dishes);
    plan.finish = [p = dishes.front(), seeds = field_seeds(settings)](
                      const std::vector<Json>& results, const fs::path& out) {
        const FieldSeeds fields = fields_of_seeds(results, 0, seeds);
        double residual = 0.0;
        for (const Json& run : results_of_seeds(results, 0, seeds))
            residual = std::max(residual, number(run["residual"]));
        std::vector<std::pair<FieldRegion, Estimate>> viscosities;
        std::vector<std::string> words;
        for (const FieldRegion& region : field_regions(p.dish.radius)) {
            const RelationFit fit = fit_relation(fields, fluid_relations[0], region);
            if (fit.points < least_points) continue;
            viscosities.push_back({region, fit.coefficient});
            words.push_back(fmt::format("{} at {}",
                                        with_error(fit.explained.mean, fit.explained.error),
                                        words_of_range(region)));
        }
        FigureOutcome outcome;
        outcome.write(table_of_maps(fields, p.dish.radius, viscosities), "fields", out);
        outcome.findings.push_back(fmt::format(
            "R/r = {}, N = {}, {} seeds: Γ(curl u − 2ω) explains this share of the torque of the "
            "stress, by packing fraction: {}. Largest residual of the balances of mass, momentum "
            "and spin, relative to rounding errors: {:.1g}.",
            p.dish.radius, p.discs, fields.size(), fmt::join(words, "; "), residual));
        return outcome;
    };
    return plan;
}

// --- Coefficients ---------------------------------------------------------------------------

FigurePlan plan_figure_closure(const PaperSettings& settings) {
    const std::vector<DishPoint> dishes = dishes_with_fields(settings);
    FigurePlan plan = plan_of_dishes(settings, dishes);
    plan.finish = [dishes, seeds = field_seeds(settings)](const std::vector<Json>& results,
                                                          const fs::path& out) {
        Table table({"container_radius", "discs", "relation", "packing_low", "packing_high",
                     "coefficient", "coefficient_error", "explained", "explained_error", "points",
                     "seeds"});
        FigureOutcome outcome;
        for (const FluidRelation& relation : fluid_relations) {
            int fits = 0, certain = 0;
            double least = not_available, most = not_available;
            for (std::size_t k = 0; k < dishes.size(); ++k) {
                const FieldSeeds fields = fields_of_seeds(results, k, seeds);
                for (const FieldRegion& region : field_regions(dishes[k].dish.radius)) {
                    const RelationFit fit = fit_relation(fields, relation, region);
                    if (fit.points < least_points) continue;
                    table.add({dishes[k].dish.radius, dishes[k].discs, std::string(relation.name),
                               region.low, region.high, fit.coefficient.mean, fit.coefficient.error,
                               fit.explained.mean, fit.explained.error, std::int64_t(fit.points),
                               std::int64_t(fields.size())});
                    ++fits;
                    if (!(fit.coefficient.mean > certain_sign * fit.coefficient.error)) continue;
                    ++certain;
                    if (!(least <= fit.explained.mean)) least = fit.explained.mean;
                    if (!(most >= fit.explained.mean)) most = fit.explained.mean;
                }
            }
            outcome.findings.push_back(fmt::format(
                "The {} is certainly positive in {} of {} ranges of the packing fraction{}.",
                relation.words, certain, fits,
                certain > 0 ? fmt::format(", where it explains {:.2f} to {:.2f} of the {}", least,
                                          most, relation.explains)
                            : ""));
        }
        outcome.write(table, "closure", out);
        return outcome;
    };
    return plan;
}

}  // namespace

std::vector<PaperFigure> chapter_fields() {
    return {
        {"fields", "chapter: density, flow, spin and torque in a large dish", plan_figure_fields},
        {"closure", "chapter: the coefficients of a micropolar fluid", plan_figure_closure}};
}

}  // namespace swirl
