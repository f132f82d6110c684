#include "swirl/paper/chapter_runs.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "swirl/paper/chapters.hpp"
#include "swirl/paper/coarse_zero.hpp"
#include "swirl/paper/curves.hpp"
#include "swirl/paper/points.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/json.hpp"
#include "swirl/run/measurements.hpp"
#include "swirl/run/parameters.hpp"
#include "swirl/run/report.hpp"
#include "swirl/statistics/fluctuations.hpp"

namespace swirl {
namespace {

/// A number of one run; its error is that between the seeds.
Json without_error(double value) { return {{"mean", value}, {"error", not_available}}; }

}  // namespace

std::int64_t Dish::discs(double packing_fraction) const {
    return std::max(std::int64_t{2},
                    std::int64_t(std::llround(packing_fraction * radius * radius)));
}

RunConfig spheres_of_chapters(ParameterTexts more) {
    more.merge(
        ParameterTexts{{"preset", "experiment-half"}, {"mu", "0.2"}, {"floor-friction", "0.3"}});
    return resolve(more);
}

RunConfig dish_config(const PaperSettings& settings, const Dish& dish, std::int64_t discs) {
    ParameterTexts texts{{"discs", fmt::format("{}", discs)},
                         {"container-radius", fmt::format("{}", dish.radius)},
                         {"amplitude", fmt::format("{}", dish.amplitude * dish.radius)},
                         {"speed", "1"}};
    RunConfig config = dish.spheres ? spheres_of_chapters(texts) : resolve(texts);
    config.seed = settings.seed;
    return config;
}

PeriodFluctuations period_fluctuations(const std::vector<double>& values, std::int64_t discs) {
    const SeriesEstimate series = estimate_of_series(values);
    PowerSums sums;
    for (const double value : values) sums.add(value, series.estimate.mean);
    const auto [second, skewness, excess_kurtosis, binder] = sums.moments();
    const double variance = second * sums.count / (sums.count - 1.0);
    return {variance, series.autocorrelation_time,
            static_cast<double>(discs) * variance * series.autocorrelation_time, binder};
}

RunResult run_with_series(const RunConfig& config, RunControl control, PeriodSeries& series) {
    control.series = &series;
    RunResult result = run(config, control);
    if (!result.complete) throw Interrupted("Stopped.");
    return result;
}

Json fluctuating_run(const RunConfig& config, const std::vector<std::string>& measurements,
                     const RunControl& control) {
    Observation observation = observation_of(config, measurements);
    PeriodSeries series(config, {});
    RunControl observed = control;
    observed.observation = &observation;
    Json json = result_json(run_with_series(config, observed, series));
    json["measured"] = measured_json(observation.report());
    Json& rows = json["measured"]["fluctuations"] = Json::object();
    const PeriodFluctuations found =
        period_fluctuations(series.counted("rigid_by_time"), config.discs);
    rows["variance"] = without_error(found.variance);
    rows["correlation"] = without_error(found.correlation);
    rows["susceptibility"] = without_error(found.susceptibility);
    rows["binder"] = without_error(found.binder);
    return json;
}

PaperPoint fluctuating_point(const PaperSettings& settings, const std::string& name,
                             const RunConfig& config, int seeds,
                             const std::vector<std::string>& measurements) {
    RunConfig varied = config;
    return {settings, name, seeds, [&](std::uint64_t seed) {
                varied.seed = seed;
                PaperTask task = run_task(fmt::format("fluctuating_{}_seed{}", name, seed), varied,
                                          measurements);
                task.work = [varied, measurements](const RunControl& control) {
                    return fluctuating_run(varied, measurements, control);
                };
                return task;
            }};
}

// --- Points over dishes and packing fractions ------------------------------------------------

namespace {

const std::vector<std::string> quantities{"slip.cluster_perimeter",
                                          "slip.cluster=slip",
                                          "contact_network.wall",
                                          "contact_network.coordination",
                                          "contact_network.largest",
                                          "centre.distance",
                                          "centre.theta",
                                          "centre.elongation",
                                          "temperature.granular",
                                          "fluctuations.variance",
                                          "fluctuations.correlation",
                                          "fluctuations.susceptibility",
                                          "fluctuations.binder"};

/// Warm-up and averaged periods. In a large dish a period has many events, and the rotation varies
/// less.
void set_length(RunConfig& config, const PaperSettings& settings) {
    const double radius = config.container_radius;
    const std::int64_t warmup = radius < 20.0 ? 50 : 20;
    const std::int64_t averaged = radius < 10.0   ? 300
                                  : radius < 20.0 ? 200
                                  : radius < 40.0 ? 80
                                                  : 60;
    config.warmup = settings.periods(warmup, 2);
    config.periods = *config.warmup + settings.periods(averaged, 5);
}

/// A quantity at the zero of a straight line between two results.
double between(const Json& left, const Json& right, double fraction, const char* measurement,
               const char* name) {
    const double a = number(at(left, {"measured", measurement, name, "mean"})),
                 b = number(at(right, {"measured", measurement, name, "mean"}));
    return (1.0 - fraction) * a + fraction * b;
}

/// The same with its error, for a quantity of the fluctuations.
Estimate fluctuation_between(const Json& left, const Json& right, double fraction,
                             const char* name) {
    const auto error = [&](const Json& r) {
        return number(at(r, {"measured", "fluctuations", name, "error"}));
    };
    return {.mean = between(left, right, fraction, "fluctuations", name),
            .error = std::hypot((1.0 - fraction) * error(left), fraction * error(right))};
}

/// The results of one dish.
struct DishCurve {
    std::vector<RotationPoint> points;  // N and ϖ
    std::vector<const Json*> results;
};

DishCurve curve_of_dish(const DishPoints& all, const std::vector<Json>& results, const Dish& dish) {
    DishCurve curve;
    for (std::size_t k = 0; k < results.size(); ++k) {
        if (!(all.points[k].dish == dish)) continue;
        curve.points.push_back(
            rotation_point(static_cast<double>(all.points[k].discs), results[k], "rigid_by_time"));
        curve.results.push_back(&results[k]);
    }
    return curve;
}

/// The zero between the points k and k + 1.
DirectionChange change_between(const DishCurve& curve, std::size_t k, const Dish& dish) {
    const RotationPoint &a = curve.points[k], &b = curve.points[k + 1];
    const Json &left = *curve.results[k], &right = *curve.results[k + 1];
    const double area = dish.radius * dish.radius, step = b.discs - a.discs;
    const CurveZero zero = zero_of_curve(curve.points, k);
    const double f = zero.fraction;
    DirectionChange change{dish};
    change.packing_fraction = zero.discs / area;
    change.error = zero.error() / area;
    change.interpolation_error = zero.interpolation / area;
    change.slope = (b.mean - a.mean) / step * area;
    change.slope_error = std::hypot(a.error, b.error) / step * area;
    change.largest = between(left, right, f, "contact_network", "largest");
    change.wall = between(left, right, f, "contact_network", "wall");
    // A full layer has π/arcsin(r/(R − r)) discs, or nearly π(R − r)/r.
    change.occupied = change.wall * change.packing_fraction * area / (pi * (dish.radius - 1.0));
    change.elongation = between(left, right, f, "centre", "elongation");
    change.reach = (between(left, right, f, "slip", "cluster_perimeter") / (2.0 * pi) +
                    between(left, right, f, "centre", "distance")) /
                   dish.radius;
    change.susceptibility = fluctuation_between(left, right, f, "susceptibility");
    change.correlation = fluctuation_between(left, right, f, "correlation");
    change.binder = fluctuation_between(left, right, f, "binder");
    return change;
}

/// The zeros of the curve between two N with certain and opposite signs; the middle one of several.
DirectionChange change_at(const DishCurve& curve, const SignChange& found, const Dish& dish) {
    DirectionChange change = change_between(curve, middle_zero(curve.points, found), dish);
    const double area = dish.radius * dish.radius;
    change.to_counterrotation = found.to_counterrotation;
    change.before = found.before / area;
    change.after = found.after / area;
    return change;
}

std::string words_of(const DirectionChange& change) {
    return fmt::format(
        "to {} at φ = {} ({:.1f} % of the wall occupied, largest group {:.0f} %, "
        "elongation {:.2f})",
        change.to_counterrotation ? "counterrotation" : "rotation",
        with_error(change.packing_fraction, change.error), 100.0 * change.occupied,
        100.0 * change.largest, change.elongation);
}

}  // namespace

void DishPoints::add(const Dish& dish, double packing_fraction) {
    const std::int64_t discs = dish.discs(packing_fraction);
    const auto is_same = [&](const Point& p) { return p.dish == dish && p.discs == discs; };
    if (std::none_of(points.begin(), points.end(), is_same)) points.push_back({dish, discs});
}

void DishPoints::plan(FigurePlan& plan, const PaperSettings& settings) const {
    for (const Point& p : points) {
        RunConfig config = dish_config(settings, p.dish, p.discs);
        set_length(config, settings);
        plan.points.push_back(fluctuating_point(
            settings,
            fmt::format("{}_R{}_A{}_N{}_{}", p.dish.spheres ? "spheres" : "dish", p.dish.radius,
                        p.dish.amplitude, p.discs, length_of(config)),
            config, chapter_seeds(settings), {"slip", "contact_network", "centre", "temperature"}));
    }
}

Table DishPoints::table(const std::vector<Json>& results) const {
    Table table(joined(joined({"container_radius", "amplitude_ratio", "packing_fraction", "discs"},
                              number_columns(quantities)),
                       rotation_columns()));
    for (std::size_t k = 0; k < results.size(); ++k) {
        const Point& p = points[k];
        std::vector<Table::Cell> row{p.dish.radius, p.dish.amplitude, p.packing_fraction(),
                                     p.discs};
        add_numbers(row, quantities, results[k]);
        add_rotation(row, results[k]);
        table.add(std::move(row));
    }
    return table;
}

static std::vector<Dish> dishes_of(const DishPoints& points) {
    std::vector<Dish> dishes;
    for (const DishPoints::Point& p : points.points)
        if (std::find(dishes.begin(), dishes.end(), p.dish) == dishes.end())
            dishes.push_back(p.dish);
    return dishes;
}

std::vector<DirectionChange> direction_changes(const DishPoints& points,
                                               const std::vector<Json>& results) {
    std::vector<DirectionChange> changes;
    for (const Dish& dish : dishes_of(points)) {
        const DishCurve curve = curve_of_dish(points, results, dish);
        for (const SignChange& found : find_crossing(curve.points).changes)
            changes.push_back(change_at(curve, found, dish));
    }
    return changes;
}

const char* kind_of(const DirectionChange& change) {
    constexpr double least_elongation = 1.2, least_occupied = 0.1;
    if (!change.to_counterrotation) return "back";
    if (change.elongation > least_elongation) return "elongated";
    return change.occupied >= least_occupied ? "wall" : "free";
}

Table change_table(const std::vector<DirectionChange>& changes) {
    Table table(
        joined({"container_radius", "amplitude_ratio", "direction", "kind", "packing_fraction",
                "packing_fraction_error", "interpolation_error", "slope", "slope_error", "before",
                "after", "largest", "wall", "occupied", "elongation", "reach"},
               number_columns({"susceptibility", "correlation", "binder"})));
    for (const DirectionChange& c : changes) {
        std::vector<Table::Cell> row{
            c.dish.radius,
            c.dish.amplitude,
            std::string(c.to_counterrotation ? "counterrotation" : "rotation"),
            std::string(kind_of(c)),
            c.packing_fraction,
            c.error,
            c.interpolation_error,
            c.slope,
            c.slope_error,
            c.before,
            c.after,
            c.largest,
            c.wall,
            c.occupied,
            c.elongation,
            c.reach};
        for (const Estimate& e : {c.susceptibility, c.correlation, c.binder}) add_estimate(row, e);
        table.add(std::move(row));
    }
    return table;
}

std::vector<std::string> change_sentences(const DishPoints& points,
                                          const std::vector<DirectionChange>& changes) {
    std::vector<std::string> sentences;
    for (const Dish& dish : dishes_of(points)) {
        std::vector<std::string> words;
        for (const DirectionChange& change : changes)
            if (change.dish == dish) words.push_back(words_of(change));
        sentences.push_back(fmt::format("R/r = {}, A/R = {}: {}.", dish.radius, dish.amplitude,
                                        words.empty() ? "no certain change of direction"
                                                      : fmt::format("{}", fmt::join(words, "; "))));
    }
    return sentences;
}

FigurePlan plan_dishes(const PaperSettings& settings, const std::string& name,
                       const DishPoints& points) {
    FigurePlan plan;
    points.plan(plan, settings);
    plan.finish = [points, name](const std::vector<Json>& results, const fs::path& out) {
        FigureOutcome outcome;
        outcome.write(points.table(results), name, out);
        const std::vector<DirectionChange> changes = direction_changes(points, results);
        outcome.write(change_table(changes), name + "_changes", out);
        outcome.findings = change_sentences(points, changes);
        return outcome;
    };
    return plan;
}

}  // namespace swirl
