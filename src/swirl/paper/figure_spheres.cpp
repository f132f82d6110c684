// Spheres that roll on a floor: the paper's experiment (docs/explanation/spheres.md). Rotation
// against N for smooth and roughened spheres and for both readings of the amplitude; N_c against the
// friction coefficient, which calibrates it; the effect of each ingredient of the model. Figures 1
// to 4 have their slip, spin and angles (figure_cluster.cpp).
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>

#include "swirl/paper/curves.hpp"
#include "swirl/paper/figures.hpp"
#include "swirl/paper/points.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/report.hpp"
#include "swirl/study/crossing.hpp"

namespace swirl {
namespace {

/// Enough steps to distinguish the ingredients.
std::vector<std::int64_t> fewer_numbers(const PaperSettings& settings) {
    if (settings.quick) return {36, 44, 48};
    return {24, 36, 44, 48, 52};
}

RunConfig experiment(const PaperSettings& settings, std::int64_t spheres) {
    return paper_config(settings, smooth_spheres, spheres);
}

/// A curve, and how it differs from the experiment.
struct Variant {
    std::string name, words;
    double mu;
    std::function<void(RunConfig&)> change;
    std::string point = name;  // unique, in the names of its points
};

CurveFigure curves_of(const std::string& name, const std::vector<Variant>& variants,
                      const std::vector<std::int64_t>& numbers) {
    CurveFigure figure{name, {"curve", "mu"}, {}};
    for (const Variant& v : variants) figure.curves.push_back({v.name, {v.name, v.mu}, v.words});
    figure.add_points(numbers);
    return figure;
}

RunConfig varied_experiment(const PaperSettings& settings, const Variant& variant,
                            std::int64_t spheres) {
    RunConfig config = experiment(settings, spheres);
    variant.change(config);
    return config;
}

const char* direction_of(const SignChange& change) {
    return change.to_counterrotation ? "counterrotation" : "rotation";
}

std::string sign_changes_sentence(const NamedCurve& curve) {
    const Crossings crossings = find_crossings(curve.curves);
    const Crossing& found = crossings[curve.rate];
    if (found.changes.empty()) return crossing_sentence(curve);
    std::string text = found.changes.size() == 1
                           ? "its sign changes once"
                           : fmt::format("its sign changes {} times", found.changes.size());
    for (const SignChange& change : found.changes)
        text += fmt::format("{} to {} {}", &change == found.changes.data() ? ":" : ",",
                            direction_of(change), change_location(change));
    if (!found.undetermined.empty())
        text += fmt::format("; it is undetermined at N = {}", listed(found.undetermined));
    const RotationPoint* const lowest = lowest_of(curve.points());
    return fmt::format("{}; lowest is ϖ/Ω = {} at N = {:.0f} ({}).{}", text,
                       with_error(lowest->mean, lowest->error), lowest->discs,
                       rotation_rates[curve.rate].description,
                       other_rates_report(crossings, curve.rate));
}

/// Every change of sign of a curve, and every N at which its sign is undetermined, in the order of
/// N.
void add_sign_changes(Table& table, const Variant& variant, const Crossing& found) {
    std::vector<double> undetermined = found.undetermined;
    const auto add_undetermined = [&](double up_to) {
        while (!undetermined.empty() && undetermined.front() <= up_to) {
            const double n = undetermined.front();
            undetermined.erase(undetermined.begin());
            table.add({variant.name, variant.mu, not_available, not_available, n, n, n, n,
                       std::string("undetermined")});
        }
    };
    for (const SignChange& c : found.changes) {
        add_undetermined(c.before);
        table.add({variant.name, variant.mu, c.discs, c.error, c.lower, c.upper, c.before, c.after,
                   std::string(direction_of(c))});
    }
    add_undetermined(std::numeric_limits<double>::infinity());
}

/// `seeds`: runs per point; settings.seeds() if a claim depends on the points.
FigurePlan plan_variants(const PaperSettings& settings, const std::string& name,
                         const std::vector<Variant>& variants,
                         const std::vector<std::int64_t>& numbers, int seeds) {
    FigurePlan plan;
    const CurveFigure figure = curves_of(name, variants, numbers);
    for (const CurveFigure::Point& p : figure.points) {
        const Variant& variant = variants[p.curve];
        const RunConfig config = varied_experiment(settings, variant, p.discs);
        plan.points.push_back(varied_point(
            settings, fmt::format("spheres_{}_N{}_{}", variant.point, p.discs, length_of(config)),
            config, seeds));
    }
    plan.finish = [=](const std::vector<Json>& results, const fs::path& out) {
        FigureOutcome outcome;
        figure.write_points(results, out, outcome);
        Table changes({"curve", "mu", "crossing", "crossing_error", "lower", "upper", "before",
                       "after", "direction"});
        const std::vector<NamedCurve> curves = figure.named_curves(results);
        for (std::size_t v = 0; v < variants.size(); ++v) {
            add_sign_changes(changes, variants[v], find_crossing(curves[v].points()));
            outcome.findings.push_back(
                fmt::format("{}: {}", variants[v].words, sign_changes_sentence(curves[v])));
        }
        figure.write_crossings(results, out, outcome);
        outcome.write(changes, name + "_sign_changes", out);
        return outcome;
    };
    return plan;
}

}  // namespace

/// Smooth and roughened spheres, and smooth ones at half the amplitude; from N = 24 on the runs are
/// those of Figures 1 to 4.
static FigurePlan plan_figure_spheres(const PaperSettings& settings) {
    const std::vector<Friction> frictions{smooth_spheres, rough_spheres, half_amplitude};
    std::vector<std::int64_t> numbers{8, 16};
    if (!settings.quick) numbers = {8, 12, 16, 20, 22};
    for (const std::int64_t n : numbers_of_spheres(settings)) numbers.push_back(n);
    FigurePlan plan;
    CurveFigure figure{"spheres", columns_of_friction, {}};
    for (const Friction& friction : frictions) figure.curves.push_back(curve_of(friction));
    figure.add_points(numbers);
    for (const CurveFigure::Point& p : figure.points)
        plan.points.push_back(point(settings, frictions[p.curve], p.discs));
    plan.finish = [=](const std::vector<Json>& results, const fs::path& out) {
        FigureOutcome outcome;
        figure.write_points(results, out, outcome);
        for (const NamedCurve& curve : figure.named_curves(results))
            outcome.findings.push_back(
                fmt::format("{}: {}", curve.name, sign_changes_sentence(curve)));
        figure.write_crossings(results, out, outcome);
        return outcome;
    };
    return plan;
}

// --- N_c against the friction coefficient --------------------------------------------------------

namespace {

/// One assumption that the paper does not settle, and its value. The friction coefficient is that
/// of all contacts, unless the floor has its own.
struct Assumption {
    const char *name, *words;
    double amplitude = 11.5;  // in mm
    double restitution = experiment_restitution;
    double floor_friction = 0.0;  // 0: as all contacts
    double rolling_resistance = 0.0;
};
constexpr Assumption assumptions[] = {
    {.name = "experiment", .words = "A = 11.5 mm, e = 0.9"},
    {.name = "A5.75", .words = "A = 5.75 mm", .amplitude = 5.75},
    {.name = "A7.5", .words = "A = 7.5 mm", .amplitude = 7.5},
    {.name = "A9.5", .words = "A = 9.5 mm", .amplitude = 9.5},
    {.name = "e0.8", .words = "e = 0.8", .restitution = 0.8},
    {.name = "e1", .words = "e = 1", .restitution = 1.0},
    {.name = "f0.15", .words = "floor 0.15", .floor_friction = 0.15},
    {.name = "f0.6", .words = "floor 0.6", .floor_friction = 0.6},
    {.name = "r0.01", .words = "rolling resistance 0.01", .rolling_resistance = 0.01}};

RunConfig assumed(const PaperSettings& settings, const Assumption& assumption, double mu) {
    RunConfig config = experiment(settings, smooth_change_n);
    config.mu_disc = config.mu_wall = mu;
    config.floor_friction = assumption.floor_friction > 0.0 ? assumption.floor_friction : mu;
    config.restitution = assumption.restitution;
    config.rolling_resistance = assumption.rolling_resistance;
    config.amplitude = assumption.amplitude / sphere_radius_mm;
    config.period = 2.0 * pi * config.amplitude;
    config.gravity = experiment_gravity(assumption.amplitude);
    return config;
}

struct FrictionCrossing {
    double mu, crossing, error;
};

/// The friction coefficient with this N_c, between two neighbouring coefficients: on the straight
/// line through both, as N_c falls smoothly. Its error follows from those of both N_c.
std::optional<Estimate> friction_with(std::int64_t discs, std::span<const FrictionCrossing> found) {
    for (std::size_t k = 0; k + 1 < found.size(); ++k) {
        const FrictionCrossing &a = found[k], &b = found[k + 1];
        const double f = (a.crossing - double(discs)) / (a.crossing - b.crossing);
        if (!(f >= 0.0 && f <= 1.0)) continue;
        return Estimate{.mean = a.mu + f * (b.mu - a.mu),
                        .error = std::hypot((1.0 - f) * a.error, f * b.error) * (b.mu - a.mu) /
                                 std::fabs(a.crossing - b.crossing)};
    }
    return {};
}

}  // namespace

/// N_c of the experiment's spheres against their friction coefficient, for the values of the paper
/// and with one assumption changed at a time; and the coefficients that have the experiment's N_c.
static FigurePlan plan_figure_spheres_friction(const PaperSettings& settings) {
    FigurePlan plan;
    std::vector<double> coefficients{0.3, 0.4, 0.6, 0.7};
    if (!settings.quick) coefficients = {0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8};
    std::vector<Assumption> shown(std::begin(assumptions), std::end(assumptions));
    if (settings.quick) shown.resize(2);
    for (const Assumption& assumption : shown)
        for (const double mu : coefficients) {
            CrossingSettings search = search_for_crossing();
            search.config = assumed(settings, assumption, mu);
            search.config.events = settings.events.value_or(50'000);
            search.config.warmup.reset();
            search.config.periods.reset();
            search.from = 24;
            search.to = 48;
            search.min_periods = 60;
            search.tolerance = 0.3;
            plan.points.push_back(
                crossing_task(fmt::format("N_c_spheres_{}_mu{}_{}events_seed{}", assumption.name,
                                          mu, search.config.events, settings.seed),
                              search));
        }
    plan.finish = [=](const std::vector<Json>& results, const fs::path& out) {
        Table table(joined(
            {"curve", "amplitude_mm", "restitution", "floor_friction", "rolling_resistance", "mu"},
            search_columns()));
        Table calibration({"curve", "discs", "mu", "mu_error"});
        FigureOutcome outcome;
        for (std::size_t c = 0; c < shown.size(); ++c) {
            const Assumption& a = shown[c];
            std::vector<FrictionCrossing> found;
            for (std::size_t k = 0; k < coefficients.size(); ++k) {
                const Json& r = results[c * coefficients.size() + k];
                if (failed(r)) continue;
                const double mu = coefficients[k];
                std::vector<Table::Cell> row{
                    std::string(a.name),  a.amplitude,
                    a.restitution,        a.floor_friction > 0.0 ? a.floor_friction : mu,
                    a.rolling_resistance, mu};
                add_search(row, r);
                table.add(std::move(row));
                if (r["crosses"].get<bool>())
                    found.push_back({mu, number(r["discs"]), number(r["error"])});
            }
            std::vector<std::string> words;
            for (const std::int64_t n : {smooth_change_n, rough_change_n})
                if (const auto mu = friction_with(n, found)) {
                    calibration.add({std::string(a.name), n, mu->mean, mu->error});
                    words.push_back(
                        fmt::format("N_c = {} for μ = {}", n, with_error(mu->mean, mu->error)));
                }
            outcome.findings.push_back(
                fmt::format("{}: {}.", a.words,
                            words.empty() ? "neither 36 nor 28 is reached"
                                          : fmt::format("{}", fmt::join(words, ", "))));
        }
        outcome.write(table, "spheres_friction", out);
        outcome.write(calibration, "spheres_friction_calibration", out);
        return outcome;
    };
    return plan;
}

// --- The ingredients of the model -----------------------------------------------------------

/// All ingredients, and each one switched off alone; `ending` ends the names of the latter.
static std::vector<Variant> ingredients(double mu, const std::string& ending) {
    std::vector<Variant> variants{
        {"all", "all ingredients", mu, [](RunConfig&) {}},
        {"no-vertical", "no vertical friction", mu,
         [](RunConfig& c) { c.vertical_disc = c.vertical_wall = 0.0; }},
        {"no-vertical-disc", "no vertical friction between spheres", mu,
         [](RunConfig& c) { c.vertical_disc = 0.0; }},
        {"no-vertical-wall", "no vertical friction at the wall", mu,
         [](RunConfig& c) { c.vertical_wall = 0.0; }},
        {"no-floor", "no floor", mu, [](RunConfig& c) { c.remove_floor(); }},
        {"no-damping", "no damping (e = 1)", mu, [](RunConfig& c) { c.restitution = 1.0; }},
        {"shell", "hollow spheres (I = 2/3)", mu,
         [](RunConfig& c) { c.inertia = shell_inertia(c.mass, c.radius); }},
    };
    for (Variant& variant : variants) {
        variant.point = variant.name += ending;
        variant.words += fmt::format(", μ = {}", mu);
        variant.change = [mu, change = variant.change](RunConfig& c) {
            c.mu_disc = c.mu_wall = c.floor_friction = mu;
            change(c);
        };
    }
    return variants;
}

static FigurePlan plan_figure_spheres_ingredients(const PaperSettings& settings) {
    return plan_variants(settings, "spheres_ingredients", ingredients(smooth_friction, ""),
                         fewer_numbers(settings), settings.seeds());
}

/// For roughened spheres, at the N where the direction is decided.
static FigurePlan plan_figure_spheres_ingredients_rough(const PaperSettings& settings) {
    constexpr double mu = rough_friction;
    std::vector<std::int64_t> numbers{44, 48};
    if (!settings.quick) numbers = {30, 36, 44, 48};
    return plan_variants(settings, "spheres_ingredients_rough", ingredients(mu, "-rough"), numbers,
                         settings.seeds());
}

/// "When there are only a few marbles in the container, they form a line that rolls along the
/// container wall at the frequency of the circular translations" (main text). More than five need
/// hundreds of periods to form it (docs/explanation/spheres.md), and such a line collides with the
/// wall tens of thousands of times in a period.
static FigurePlan plan_figure_spheres_few(const PaperSettings& settings) {
    FigurePlan plan;
    plan.is_drawn = false;  // a table only
    CurveFigure figure{"spheres_few", {}, {{"", {}}}};
    figure.measured = {"residence.share=residence_share"};
    std::vector<std::int64_t> numbers{3, 5};
    if (!settings.quick) numbers = {3, 4, 5};
    figure.add_points(numbers);
    for (const std::int64_t n : numbers) {
        RunConfig config = experiment(settings, n);
        config.warmup = settings.periods(100, 2);
        config.periods = *config.warmup + settings.periods(50, 3);
        plan.points.push_back(varied_point(settings,
                                           fmt::format("spheres_few_N{}_{}", n, length_of(config)),
                                           config, settings.seeds(), {"residence"}));
    }
    plan.finish = [=](const std::vector<Json>& results, const fs::path& out) {
        FigureOutcome outcome;
        figure.write_points(results, out, outcome);
        for (std::size_t k = 0; k < numbers.size(); ++k)
            outcome.findings.push_back(
                fmt::format("{} spheres: ϖ/Ω = {}, share resident at the wall {}.", numbers[k],
                            mean_in_words(at(results[k], {"rotation", "by_time"})),
                            mean_in_words(at(results[k], {"measured", "residence", "share"}))));
        return outcome;
    };
    return plan;
}

std::vector<PaperFigure> figures_of_spheres() {
    return {
        {"spheres", "spheres that roll: rotation against N, smooth, rough and half the amplitude",
         plan_figure_spheres},
        {"spheres_friction", "spheres that roll: N_c against the friction coefficient",
         plan_figure_spheres_friction},
        {"spheres_few", "spheres that roll: a few of them, after a long warm-up (a table)",
         plan_figure_spheres_few},
        {"spheres_ingredients", "spheres that roll: each ingredient switched off alone",
         plan_figure_spheres_ingredients},
        {"spheres_ingredients_rough",
         "spheres that roll: each ingredient switched off, roughened spheres",
         plan_figure_spheres_ingredients_rough}};
}

}  // namespace swirl
