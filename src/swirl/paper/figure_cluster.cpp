// What the paper plots against the number of discs or the angle, N = 24 … 48: the pancake line
// (1b), the angular profiles (3a, 3b), slip (4a), frustration (4b) and two frictions (4c).
//
// The experiment's smooth and roughened particles are two frictions here: 0.1 and 1.
#include <fmt/format.h>

#include <optional>

#include "swirl/paper/figures.hpp"
#include "swirl/paper/points.hpp"
#include "swirl/run/report.hpp"

namespace swirl {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

constexpr Friction rough = high_friction, smooth = low_friction;

struct Point {
    Friction friction;
    std::int64_t discs;
};

std::vector<Point> points_of(const std::vector<Friction>& friction_coefficients,
                             const std::vector<std::int64_t>& numbers) {
    std::vector<Point> points;
    for (const Friction& friction : friction_coefficients)
        for (const std::int64_t n : numbers) points.push_back({friction, n});
    return points;
}

using PointOf = std::function<PaperPoint(const PaperSettings&, const Friction&, std::int64_t)>;
using Sentences =
    std::function<std::vector<std::string>(const std::vector<Point>&, const std::vector<Json>&)>;

FigurePlan plan_against_n(const PaperSettings& settings, const std::string& name,
                          const std::vector<Friction>& friction_coefficients,
                          const std::vector<std::string>& names, const Sentences& sentences,
                          const std::vector<std::int64_t>& numbers = {},
                          const PointOf& of_point = measured_point) {
    FigurePlan plan;
    plan.script = "figure_" + name + ".py";
    const std::vector<Point> points = points_of(
        friction_coefficients, numbers.empty() ? numbers_of_the_experiment(settings) : numbers);
    for (const Point& p : points) plan.points.push_back(of_point(settings, p.friction, p.discs));
    plan.finish = [=](const std::vector<Json>& results, const fs::path& out) {
        Table table(
            joined(joined({"setting", "mu_disc", "mu_wall", "discs"}, number_columns(names)),
                   rotation_columns()));
        for (std::size_t k = 0; k < points.size(); ++k) {
            const Friction& f = points[k].friction;
            std::vector<Table::Cell> row{std::string(f.name), f.mu_disc, f.mu_wall,
                                         points[k].discs};
            add_numbers(row, names, results[k]);
            add_rotation(row, results[k]);
            table.add(std::move(row));
        }
        FigureOutcome outcome;
        outcome.files.push_back(out / ("figure_" + name + ".csv"));
        table.write(outcome.files.back());
        outcome.findings = sentences(points, results);
        // Two numbers of discs tell no crossing: a line through them is none of the curve.
        if (!numbers.empty()) return outcome;
        std::vector<NamedCurve> curves;
        for (std::size_t k = 0; k < points.size(); ++k) {
            if (k == 0 || points[k].friction.name != points[k - 1].friction.name)
                curves.push_back({points[k].friction.name});
            curves.back().add(static_cast<double>(points[k].discs), results[k]);
        }
        outcome.files.push_back(out / ("figure_" + name + "_crossings.csv"));
        write_crossings(curves, outcome.files.back());
        return outcome;
    };
    return plan;
}

std::string first_and_last(const std::string& what, const Friction& friction,
                           const std::string& measurement, const std::string& quantity,
                           const std::vector<Point>& points, const std::vector<Json>& results) {
    std::string text;
    std::size_t first = points.size(), last = 0;
    for (std::size_t k = 0; k < points.size(); ++k) {
        if (points[k].friction.name != friction.name || failed(results[k])) continue;
        first = std::min(first, k);
        last = k;
    }
    const auto value = [&](std::size_t k) {
        const Json& v = results[k]["measured"][measurement][quantity];
        return with_error(number(v["mean"]), number(v["error"]));
    };
    if (first == points.size()) return fmt::format("{} ({}): no runs.", what, friction.words);
    return fmt::format("{} ({}): {} at N = {}, {} at N = {}.", what, friction.words, value(first),
                       points[first].discs, value(last), points[last].discs);
}

}  // namespace

static FigurePlan plan_figure_1b(const PaperSettings& settings) {
    return plan_against_n(
        settings, "1b", {high_friction},
        {"slip.cluster_perimeter", "slip.pancake", "centre.x=centre_x", "centre.y=centre_y",
         "centre.distance=centre_distance", "centre.theta=centre_theta", "centre.left=left",
         "centre.elongation", "centre.centrifugal", "centre.coriolis", "centre.max_centrifugal",
         "centre.max_coriolis"},
        [](const std::vector<Point>& points, const std::vector<Json>& results) {
            NamedCurve curve;
            for (std::size_t k = 0; k < points.size(); ++k)
                curve.add(static_cast<double>(points[k].discs), results[k]);
            return std::vector<std::string>{
                fmt::format("ϖ by time: {}", crossing_sentence(curve)),
                first_and_last("pancake line", high_friction, "slip", "pancake", points, results),
                first_and_last("direction of the centre of mass in degrees (M is at 270)",
                               high_friction, "centre", "theta", points, results)};
        });
}

static FigurePlan plan_figure_4a(const PaperSettings& settings) {
    return plan_against_n(
        settings, "4a", {smooth, rough},
        {"slip.cluster", "slip.pinned_region", "slip.resident=slip_resident"},
        [](const std::vector<Point>& points, const std::vector<Json>& results) {
            std::vector<std::string> sentences;
            for (const Friction& friction : {smooth, rough}) {
                sentences.push_back(first_and_last("slip of discs resident at the wall", friction,
                                                   "slip", "resident", points, results));
                sentences.push_back(first_and_last("slip of all pinned, by the SI's criterion",
                                                   friction, "slip", "pinned_region", points,
                                                   results));
            }
            return sentences;
        });
}

static FigurePlan plan_figure_4b(const PaperSettings& settings) {
    return plan_against_n(
        settings, "4b", {high_friction},
        {"frustration.wall_spin", "frustration.pinned_wall_spin", "frustration.resident_spin",
         "frustration.spin_correlation", "frustration.pinned_correlation",
         "frustration.resident_correlation", "frustration.along_wall",
         "frustration.correlation_by_impulse", "frustration.triangles", "frustration.coordination",
         "frustration.disc_sticking", "frustration.wall_sticking", "order.all=psi6",
         "order.pinned=psi6_pinned", "order.resident=psi6_resident", "order.six",
         "order.six_pinned", "collisions.disc_disc_rate", "collisions.disc_wall_rate"},
        [](const std::vector<Point>& points, const std::vector<Json>& results) {
            return std::vector<std::string>{
                first_and_last("spin of the discs resident at the wall, in Ω", high_friction,
                               "frustration", "resident_spin", points, results),
                first_and_last(
                    "the same of discs at the wall that are pinned by the SI's criterion",
                    high_friction, "frustration", "pinned_wall_spin", points, results),
                first_and_last("spin correlation of neighbours", high_friction, "frustration",
                               "spin_correlation", points, results),
                first_and_last("the same, each collision counted with its impulse", high_friction,
                               "frustration", "correlation_by_impulse", points, results),
                first_and_last("contacts in triangles", high_friction, "frustration", "triangles",
                               points, results)};
        });
}

/// With both frictions, and with one of them absent: how much the discs move in the M-frame, at a
/// low and at a high N. Without disc friction in the steady state: what the paper's 10^6 events see
/// of that is the way there.
static FigurePlan plan_figure_states(const PaperSettings& settings) {
    return plan_against_n(
        settings, "states", {high_friction, no_wall_friction, no_disc_friction},
        {"temperature.granular", "temperature.of_the_spin", "centre.coriolis", "order.all=psi6",
         "residence.share=residence_share", "frustration.coordination", "frustration.triangles"},
        [](const std::vector<Point>& points, const std::vector<Json>& results) {
            std::vector<std::string> sentences;
            for (const Friction& friction : {high_friction, no_wall_friction, no_disc_friction})
                sentences.push_back(first_and_last("granular temperature, in m v²", friction,
                                                   "temperature", "granular", points, results));
            return sentences;
        },
        {rotating, counterrotating},
        [](const PaperSettings& study, const Friction& friction, std::int64_t discs) {
            return friction.mu_disc == 0.0 ? settled_point(study, friction, discs)
                                           : measured_point(study, friction, discs);
        });
}

static FigurePlan plan_figure_4c(const PaperSettings& settings) {
    return plan_against_n(
        settings, "4c", {smooth, rough}, {},
        [](const std::vector<Point>& points, const std::vector<Json>& results) {
            std::vector<std::string> sentences;
            for (const Friction& friction : {smooth, rough}) {
                NamedCurve curve;
                for (std::size_t k = 0; k < points.size(); ++k)
                    if (points[k].friction.name == friction.name)
                        curve.add(static_cast<double>(points[k].discs), results[k]);
                sentences.push_back(
                    fmt::format("{}: {}", friction.words, crossing_sentence(curve)));
            }
            return sentences;
        });
}

namespace {

/// What becomes of the residences in the wall layer with other thresholds, for all N.
fs::path write_sensitivity(const std::vector<std::int64_t>& numbers,
                           const std::vector<Json>& results, const fs::path& out) {
    std::optional<Table> table;
    for (std::size_t k = 0; k < numbers.size(); ++k) {
        const Json& rows = at(results[k], {"measured", "residence", "sensitivity"});
        if (!rows.is_object()) continue;
        std::vector<std::string> columns;
        for (const auto& [name, values] : rows.items()) columns.push_back(name);
        if (!table) table.emplace(joined({"discs"}, columns));
        for (std::size_t r = 0; r < rows.begin()->size(); ++r) {
            std::vector<Table::Cell> row{numbers[k]};
            for (const std::string& name : columns) row.emplace_back(number(rows[name][r]));
            table->add(std::move(row));
        }
    }
    if (!table) table.emplace(std::vector<std::string>{"discs"});
    const fs::path file = out / "figure_3a_sensitivity.csv";
    table->write(file);
    return file;
}

FigurePlan plan_profiles(const PaperSettings& settings, const std::string& name) {
    FigurePlan plan;
    plan.script = "figure_" + name + ".py";
    const std::vector<std::int64_t> numbers = numbers_of_the_experiment(settings);
    for (const std::int64_t n : numbers)
        plan.points.push_back(measured_point(settings, high_friction, n));
    plan.finish = [=](const std::vector<Json>& results, const fs::path& out) {
        const std::vector<std::string> columns{
            "theta",          "visits",     "varpi_m",          "varpi_m_error",
            "wall",           "normalised", "normalised_error", "distance",
            "distance_error", "speed",      "speed_error"};
        // Of the SI's criterion, of the collisions, and of residences in the wall layer.
        const std::vector<std::string> angles{"pinned.becoming_pinned",
                                              "pinned.becoming_free",
                                              "pinned.becoming_pinned_by_collisions",
                                              "pinned.becoming_free_by_collisions",
                                              "pinned.share",
                                              "residence.becoming_pinned=residence_begin",
                                              "residence.becoming_free=residence_end",
                                              "residence.share=residence_share",
                                              "residence.length=residence_length"};
        std::vector<std::string> heads =
            joined({"discs", "point", "averaged_runs", "steady_state"}, columns);
        heads = joined(std::move(heads), number_columns(angles));
        heads = joined(std::move(heads), {"becoming_free_resultant", "residence_end_resultant"});
        Table table(heads);
        FigureOutcome outcome;
        for (std::size_t k = 0; k < numbers.size(); ++k) {
            if (failed(results[k])) continue;
            const Json& measured = results[k]["measured"];
            for (std::size_t r = 0; r < measured["profile"]["theta"].size(); ++r) {
                std::vector<Table::Cell> row{numbers[k], name_of_point(results[k]),
                                             averaged_runs(results[k]), steadiness(results[k])};
                for (const std::string& column : columns)
                    row.emplace_back(number(measured["profile"][column][r]));
                add_numbers(row, angles, results[k]);
                for (const char* criterion : {"pinned", "residence"})
                    row.emplace_back(
                        number(at(measured, {criterion, "becoming_free", "concentration"})));
                table.add(std::move(row));
            }
            if (k > 0 && k + 1 < numbers.size()) continue;
            const auto told = [&](const char* criterion, const char* which) {
                const Json& value = measured[criterion][which];
                return with_error(number(value["mean"]), number(value["error"]));
            };
            outcome.findings.push_back(
                fmt::format("N = {}, residences in the wall layer: pinned from θ = {}°, free from "
                            "{}° (resultant {:.2f}); {} of the discs are on one.",
                            numbers[k], told("residence", "becoming_pinned"),
                            told("residence", "becoming_free"),
                            number(measured["residence"]["becoming_free"]["concentration"]),
                            told("residence", "share")));
            outcome.findings.push_back(fmt::format(
                "N = {}, the SI's criterion: pinned from θ = {}°, free from {}° (resultant {:.2f}: "
                "directions that nearly cancel have a mean that says little); {} of the discs are "
                "pinned.",
                numbers[k], told("pinned", "becoming_pinned"), told("pinned", "becoming_free"),
                number(measured["pinned"]["becoming_free"]["concentration"]),
                told("pinned", "share")));
        }
        outcome.files.push_back(out / ("figure_" + name + ".csv"));
        table.write(outcome.files.back());
        if (name == "3a") outcome.files.push_back(write_sensitivity(numbers, results, out));
        return outcome;
    };
    return plan;
}

}  // namespace

static FigurePlan plan_figure_3a(const PaperSettings& settings) {
    return plan_profiles(settings, "3a");
}
static FigurePlan plan_figure_3b(const PaperSettings& settings) {
    return plan_profiles(settings, "3b");
}

/// Where discs become pinned and free, by the SI's criterion and by residences in the wall layer: how
/// these places are distributed, which their mean directions do not say.
static FigurePlan plan_figure_pinning(const PaperSettings& settings) {
    FigurePlan plan;
    plan.script = "figure_pinning.py";
    const std::vector<std::int64_t> numbers = numbers_of_the_experiment(settings);
    for (const std::int64_t n : numbers)
        plan.points.push_back(measured_point(settings, high_friction, n));
    plan.finish = [=](const std::vector<Json>& results, const fs::path& out) {
        const std::vector<std::string> criteria{"pinned", "residence"};
        std::vector<std::string> columns{"discs", "point", "averaged_runs", "steady_state",
                                         "theta"};
        for (const char* what : {"si_pinned", "si_free", "residence_begin", "residence_end"})
            columns = joined(std::move(columns), {what, fmt::format("{}_mean", what),
                                                  fmt::format("{}_mean_error", what),
                                                  fmt::format("{}_resultant", what)});
        Table table(columns);
        for (std::size_t k = 0; k < numbers.size(); ++k) {
            if (failed(results[k])) continue;
            const Json& measured = results[k]["measured"];
            const Json& theta = measured["residence"]["positions"]["theta"];
            for (std::size_t r = 0; r < theta.size(); ++r) {
                std::vector<Table::Cell> row{numbers[k], name_of_point(results[k]),
                                             averaged_runs(results[k]), steadiness(results[k]),
                                             number(theta[r])};
                for (const std::string& criterion : criteria)
                    for (const std::string which : {"pinned", "free"}) {
                        const Json& mean = measured[criterion]["becoming_" + which];
                        row.emplace_back(number(measured[criterion]["positions"][which][r]));
                        for (const char* part : {"mean", "error", "concentration"})
                            row.emplace_back(number(at(mean, {part})));
                    }
                table.add(std::move(row));
            }
        }
        FigureOutcome outcome;
        outcome.files.push_back(out / "figure_pinning.csv");
        table.write(outcome.files.back());
        return outcome;
    };
    return plan;
}

std::vector<PaperFigure> figures_of_the_cluster() {
    return {{"1b", "rotation against N, and the pancake line", plan_figure_1b},
            {"3a", "angular velocity against the angular position", plan_figure_3a},
            {"3b", "the same, divided by that of the wall", plan_figure_3b},
            {"pinning", "where discs become pinned and free, by two criteria", plan_figure_pinning},
            {"4a", "slip parameter of the pinned discs, smooth and rough", plan_figure_4a},
            {"4b", "spin of the pinned discs at the wall, and frustration", plan_figure_4b},
            {"4c", "rotation against N, smooth and rough", plan_figure_4c},
            {"states", "without one of the frictions: motion in the M-frame", plan_figure_states}};
}

}  // namespace swirl
