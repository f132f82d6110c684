// The paper's plots against the number of discs or against the angle, N = 24 … 48: the pancake
// line (1b), angular profiles (3a, 3b), slip (4a), frustration (4b) and two friction coefficients
// (4c).
//
// Figures 1 to 4 of the paper are about the experiment. Each figure has its spheres (smooth_spheres,
// …, points.hpp), and for comparison discs. Discs of two friction coefficients, 0.1 and 1, correspond to
// smooth and roughened particles.
#include <fmt/format.h>

#include <optional>

#include "swirl/paper/curves.hpp"
#include "swirl/paper/figures.hpp"
#include "swirl/paper/points.hpp"

namespace swirl {
namespace {

constexpr Friction rough = high_friction, smooth = low_friction;
const std::vector<Friction> discs_and_spheres{high_friction, smooth_spheres, rough_spheres,
                                              half_amplitude};
const std::vector<Friction> smooth_and_rough{smooth, rough, smooth_spheres, rough_spheres,
                                             half_amplitude};

/// A measured quantity, and how findings call it; without words it is in the table only.
struct Quantity {
    std::string name;  // as in number_columns()
    std::string words = {};
};

CurveFigure curves_with(const std::string& name, const std::vector<Friction>& frictions,
                        const std::vector<Quantity>& quantities,
                        const std::vector<SettingPoint>& points) {
    CurveFigure figure{name, columns_of_friction, {}};
    for (const Friction& friction : frictions) figure.curves.push_back(curve_of(friction));
    for (const Quantity& quantity : quantities) figure.measured.push_back(quantity.name);
    for (const SettingPoint& p : points) figure.points.push_back({p.setting, p.discs});
    return figure;
}

/// All settings at all these N.
std::vector<SettingPoint> points_at(std::size_t settings,
                                    const std::vector<std::int64_t>& numbers) {
    std::vector<SettingPoint> points;
    for (std::size_t s = 0; s < settings; ++s)
        for (const std::int64_t n : numbers) points.push_back({s, n});
    return points;
}

/// Sentences about the quantities that have words, for each curve.
std::vector<std::string> findings_of(const CurveFigure& figure,
                                     const std::vector<Quantity>& quantities,
                                     const std::vector<Json>& results) {
    std::vector<std::string> findings;
    for (std::size_t c = 0; c < figure.curves.size(); ++c)
        for (const Quantity& q : quantities)
            if (!q.words.empty())
                findings.push_back(
                    figure.at_both_ends(c, q.words, q.name.substr(0, q.name.find('=')), results));
    return findings;
}

/// A figure against N = 24 … 48, whose findings begin with the crossings if `with_crossings`.
FigurePlan plan_against_n(const PaperSettings& settings, const std::string& name,
                          const std::vector<Friction>& frictions,
                          const std::vector<Quantity>& quantities, bool with_crossings = false) {
    FigurePlan plan;
    const CurveFigure figure =
        curves_with(name, frictions, quantities, points_of(settings, frictions));
    for (const CurveFigure::Point& p : figure.points)
        plan.points.push_back(measured_point(settings, frictions[p.curve], p.discs));
    plan.finish = [=](const std::vector<Json>& results, const fs::path& out) {
        FigureOutcome outcome;
        figure.write_points(results, out, outcome);
        if (with_crossings)
            for (const NamedCurve& curve : figure.named_curves(results))
                outcome.findings.push_back(fmt::format("{} friction, ϖ by time: {}", curve.name,
                                                       crossing_sentence(curve)));
        for (std::string& finding : findings_of(figure, quantities, results))
            outcome.findings.push_back(std::move(finding));
        figure.write_crossings(results, out, outcome);
        return outcome;
    };
    return plan;
}

}  // namespace

static FigurePlan plan_figure_1b(const PaperSettings& settings) {
    return plan_against_n(
        settings, "1b", discs_and_spheres,
        {{"slip.pinned_region"},
         {"slip.cluster_perimeter"},
         {"slip.pancake", "pancake line"},
         {"centre.x=centre_x"},
         {"centre.y=centre_y"},
         {"centre.distance=centre_distance"},
         {"centre.theta=centre_theta", "direction of the centre of mass in degrees (M is at 270)"},
         {"centre.left=left"},
         {"centre.elongation"},
         {"centre.centrifugal"},
         {"centre.coriolis"},
         {"centre.max_centrifugal"},
         {"centre.max_coriolis"}},
        true);
}

static FigurePlan plan_figure_4a(const PaperSettings& settings) {
    return plan_against_n(
        settings, "4a", smooth_and_rough,
        {{"slip.cluster"},
         {"slip.pinned_region", "slip parameter of all discs pinned by the SI's criterion"},
         {"slip.resident=slip_resident", "slip parameter of discs resident at the wall"}});
}

static FigurePlan plan_figure_4b(const PaperSettings& settings) {
    return plan_against_n(
        settings, "4b", discs_and_spheres,
        {{"frustration.wall_spin"},
         {"frustration.pinned_wall_spin",
          "spin of discs at the wall that are pinned by the SI's criterion, in Ω"},
         {"frustration.resident_spin", "spin of discs resident at the wall, in Ω"},
         {"frustration.spin_correlation", "spin correlation of neighbours"},
         {"frustration.pinned_correlation"},
         {"frustration.resident_correlation"},
         {"frustration.along_wall"},
         {"frustration.triangle_correlation"},
         {"frustration.chain_correlation"},
         {"frustration.correlation_by_impulse",
          "spin correlation of colliding discs, weighted by impulse"},
         {"frustration.triangles", "share of contacts in triangles"},
         {"frustration.coordination"},
         {"frustration.disc_sticking"},
         {"frustration.wall_sticking"},
         {"order.all=psi6"},
         {"order.pinned=psi6_pinned"},
         {"order.resident=psi6_resident"},
         {"order.six"},
         {"order.six_pinned"},
         {"collisions.disc_disc_rate"},
         {"collisions.disc_wall_rate"},
         {"rolling.rolling_share"},
         {"rolling.wall_rolling_share"},
         {"rolling.floor_slip"},
         {"rolling.contact_correlation"},
         {"rolling.vertical_share"},
         {"rolling.vertical_power"}});
}

static FigurePlan plan_figure_4c(const PaperSettings& settings) {
    return plan_against_n(settings, "4c", smooth_and_rough, {}, true);
}

/// Motion in the M-frame with friction at wall and discs, or at one of them, at a low and a high N.
/// The runs without disc friction are in the steady state; the paper's 10^6 events cover the
/// transient. Two numbers of discs do not determine a crossing.
static FigurePlan plan_figure_states(const PaperSettings& settings) {
    FigurePlan plan;
    const std::vector<Friction> frictions{high_friction, no_wall_friction, no_disc_friction};
    const std::vector<Quantity> quantities{
        {"temperature.granular", "granular temperature, in m v²"},
        {"temperature.of_the_spin"},
        {"centre.coriolis"},
        {"order.all=psi6"},
        {"residence.share=residence_share"},
        {"frustration.coordination"},
        {"frustration.triangles"}};
    const CurveFigure figure =
        curves_with("states", frictions, quantities,
                    points_at(frictions.size(), {rotating_n, counterrotating_n}));
    for (const CurveFigure::Point& p : figure.points) {
        const Friction& friction = frictions[p.curve];
        plan.points.push_back(friction.mu_disc == 0.0
                                  ? settled_point(settings, friction, p.discs)
                                  : measured_point(settings, friction, p.discs));
    }
    plan.finish = [=](const std::vector<Json>& results, const fs::path& out) {
        FigureOutcome outcome;
        figure.write_points(results, out, outcome);
        outcome.findings = findings_of(figure, quantities, results);
        return outcome;
    };
    return plan;
}

// --- Angular profiles -----------------------------------------------------------------------

namespace {

/// Figures 3a, 3b and pinning: the experiment's smooth spheres at both amplitudes, and discs.
const std::vector<Friction> settings_of_profiles{high_friction, smooth_spheres, half_amplitude};

/// The cells by which every row of a profile begins.
const std::vector<std::string> first_columns{"setting", "discs", "point", "averaged_runs",
                                             "steady_state"};
std::vector<Table::Cell> first_cells(const SettingPoint& p, const Json& result) {
    return {std::string(settings_of_profiles[p.setting].name), p.discs, name_of_point(result),
            averaged_runs(result), steadiness(result)};
}

/// figure_3a_sensitivity.csv: results of the residences in the wall layer for other thresholds.
void write_sensitivity(const std::vector<SettingPoint>& points, const std::vector<Json>& results,
                       const fs::path& out, FigureOutcome& outcome) {
    std::optional<Table> table;
    for (std::size_t k = 0; k < points.size(); ++k) {
        const Json& rows = at(results[k], {"measured", "residence", "sensitivity"});
        if (!rows.is_object()) continue;
        std::vector<std::string> columns;
        for (const auto& [name, values] : rows.items()) columns.push_back(name);
        if (!table) table.emplace(joined({"setting", "discs"}, columns));
        for (std::size_t r = 0; r < rows.begin()->size(); ++r) {
            std::vector<Table::Cell> row{std::string(settings_of_profiles[points[k].setting].name),
                                         points[k].discs};
            for (const std::string& name : columns) row.emplace_back(number(rows[name][r]));
            table->add(std::move(row));
        }
    }
    if (!table) table.emplace(std::vector<std::string>{"setting", "discs"});
    outcome.write(*table, "3a_sensitivity", out);
}

/// The positions at which discs pin and depin at one N, by residences and by the SI's criterion.
void add_pinning_findings(std::vector<std::string>& findings, const SettingPoint& point,
                          const Json& measured) {
    const std::string where =
        fmt::format("{}, N = {}", settings_of_profiles[point.setting].words, point.discs);
    const auto mean = [&](const char* criterion, const char* name) {
        return mean_in_words(measured[criterion][name]);
    };
    const auto resultant = [&](const char* criterion) {
        return number(measured[criterion]["depinning"]["concentration"]);
    };
    findings.push_back(fmt::format(
        "{}, residences in the wall layer: they begin at θ = {}° and end at {}° (resultant "
        "{:.2f}); {} of the discs reside there.",
        where, mean("residence", "pinning"), mean("residence", "depinning"), resultant("residence"),
        mean("residence", "share")));
    findings.push_back(fmt::format(
        "{}, the SI's criterion: they pin at θ = {}° and depin at {}° (resultant {:.2f}: the "
        "mean of directions that nearly cancel has little meaning); {} of the discs are pinned.",
        where, mean("pinned", "pinning"), mean("pinned", "depinning"), resultant("pinned"),
        mean("pinned", "share")));
}

const std::vector<std::string> profile_columns{
    "theta",          "visits",     "varpi_m",          "varpi_m_error",
    "wall",           "normalised", "normalised_error", "distance",
    "distance_error", "speed",      "speed_error"};
/// Angles by the SI's criterion, by collisions, and by residences in the wall layer.
const std::vector<std::string> pinning_angles{"pinned.pinning",
                                              "pinned.depinning",
                                              "pinned.pinning_by_collisions",
                                              "pinned.depinning_by_collisions",
                                              "pinned.share",
                                              "residence.pinning=residence_begin",
                                              "residence.depinning=residence_end",
                                              "residence.share=residence_share",
                                              "residence.length=residence_length"};

FigurePlan plan_measured(const PaperSettings& settings, const std::vector<SettingPoint>& points) {
    FigurePlan plan;
    for (const SettingPoint& p : points)
        plan.points.push_back(measured_point(settings, settings_of_profiles[p.setting], p.discs));
    return plan;
}

FigurePlan plan_profiles(const PaperSettings& settings, const std::string& name) {
    const std::vector<SettingPoint> points = points_of(settings, settings_of_profiles);
    FigurePlan plan = plan_measured(settings, points);
    plan.finish = [=](const std::vector<Json>& results, const fs::path& out) {
        Table table(
            joined(joined(joined(first_columns, profile_columns), number_columns(pinning_angles)),
                   {"depinning_resultant", "residence_end_resultant"}));
        FigureOutcome outcome;
        for (std::size_t k = 0; k < points.size(); ++k) {
            if (failed(results[k])) continue;
            const Json& measured = results[k]["measured"];
            for (std::size_t r = 0; r < measured["profile"]["theta"].size(); ++r) {
                std::vector<Table::Cell> row = first_cells(points[k], results[k]);
                for (const std::string& column : profile_columns)
                    row.emplace_back(number(measured["profile"][column][r]));
                add_numbers(row, pinning_angles, results[k]);
                for (const char* criterion : {"pinned", "residence"})
                    row.emplace_back(
                        number(at(measured, {criterion, "depinning", "concentration"})));
                table.add(std::move(row));
            }
            if (k == 0 || k + 1 == points.size() || points[k].setting != points[k - 1].setting ||
                points[k].setting != points[k + 1].setting)
                add_pinning_findings(outcome.findings, points[k], measured);
        }
        outcome.write(table, name, out);
        if (name == "3a") write_sensitivity(points, results, out, outcome);
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

/// Distributions of the angles where discs pin and depin, by the SI's criterion and by residences
/// in the wall layer. Mean directions alone do not show them.
static FigurePlan plan_figure_pinning(const PaperSettings& settings) {
    const std::vector<SettingPoint> points = points_of(settings, settings_of_profiles);
    FigurePlan plan = plan_measured(settings, points);
    plan.finish = [=](const std::vector<Json>& results, const fs::path& out) {
        std::vector<std::string> columns = joined(first_columns, {"theta"});
        for (const char* name : {"si_pinning", "si_depinning", "residence_begin", "residence_end"})
            for (const char* ending : {"", "_mean", "_mean_error", "_resultant"})
                columns.push_back(fmt::format("{}{}", name, ending));
        Table table(columns);
        for (std::size_t k = 0; k < points.size(); ++k) {
            if (failed(results[k])) continue;
            const Json& measured = results[k]["measured"];
            const Json& theta = measured["residence"]["positions"]["theta"];
            for (std::size_t r = 0; r < theta.size(); ++r) {
                std::vector<Table::Cell> row = first_cells(points[k], results[k]);
                row.emplace_back(number(theta[r]));
                for (const std::string criterion : {"pinned", "residence"})
                    for (const std::string event : {"pinning", "depinning"}) {
                        const Json& mean = measured[criterion][event];
                        row.emplace_back(number(measured[criterion]["positions"][event][r]));
                        add_mean(row, mean);
                        row.emplace_back(number(at(mean, {"concentration"})));
                    }
                table.add(std::move(row));
            }
        }
        FigureOutcome outcome;
        outcome.write(table, "pinning", out);
        return outcome;
    };
    return plan;
}

std::vector<PaperFigure> figures_of_the_cluster() {
    return {{"1b", "rotation against N, and the pancake line", plan_figure_1b},
            {"3a", "angular velocity against the angular position", plan_figure_3a},
            {"3b", "angular velocity relative to that of the wall", plan_figure_3b},
            {"pinning", "where particles pin and depin, by two criteria", plan_figure_pinning},
            {"4a", "slip parameter of pinned particles, smooth and rough", plan_figure_4a},
            {"4b", "spin of pinned particles at the wall, and frustration", plan_figure_4b},
            {"4c", "rotation against N, smooth and rough", plan_figure_4c},
            {"states", "motion in the M-frame, without disc or wall friction", plan_figure_states}};
}

}  // namespace swirl
