// Spheres that roll: the paper's experiment, which its simulation does not describe
// (docs/explanation/spheres.md). Solid spheres on a floor in the experiment's dish: ϖ(N) for
// friction coefficients between those of smooth and rough plastic, where its sign changes, the
// effect of each ingredient of the model, and measurements of the pinned spheres and of the
// rolling.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "swirl/paper/curves.hpp"
#include "swirl/paper/figures.hpp"
#include "swirl/paper/points.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/report.hpp"
#include "swirl/study/crossing_search.hpp"

namespace swirl {
namespace {

/// Up to 57 spheres fit. With 56 and 57 the initial packing decides, not friction; some runs
/// collapse, and each takes as long as a hundred others. They are left out.
std::vector<std::int64_t> numbers_of_spheres(const PaperSettings& settings) {
    if (settings.quick) return {8, 16, 24, 28, 30, 32, 34, 36, 40, 44, 48, 52};
    return {8,  12, 16, 20, 22, 24, 26, 28, 30, 32, 34, 35, 36,
            37, 38, 40, 42, 44, 46, 48, 50, 52, 53, 54, 55};
}

/// Enough steps to distinguish the ingredients.
std::vector<std::int64_t> fewer_numbers(const PaperSettings& settings) {
    if (settings.quick) return {16, 30, 36, 44, 48, 52};
    return {16, 24, 28, 30, 32, 34, 36, 40, 44, 48, 52, 54};
}

/// Few spheres lose the memory of their initial state in about 50 periods. The length gives ϖ/Ω an
/// error of a few thousandths. Many spheres lose it sooner, and have many more events in a period.
RunConfig experiment(const PaperSettings& settings, std::int64_t spheres) {
    RunConfig config = resolve({{"preset", "experiment"}});
    config.discs = spheres;
    config.seed = settings.seed;
    const bool dense = spheres >= 48;
    config.warmup = settings.periods(settings.quick || dense ? 25 : 50, 1);
    config.periods = *config.warmup + settings.periods(settings.quick || dense ? 50 : 150, 3);
    return config;
}

/// A curve, and how it differs from the experiment.
struct Variant {
    std::string name, words;
    double mu;
    std::function<void(RunConfig&)> change;
    std::string point = name;  // unique, in the names of its points
};

Variant with_friction(double mu) {
    return {fmt::format("{}", mu), fmt::format("μ = {}", mu), mu,
            [mu](RunConfig& c) { c.mu_disc = c.mu_wall = mu; }};
}

/// Close to each other near those at which the direction changes as in the experiment, at N = 36
/// and 28.
std::vector<double> friction_of_spheres(const PaperSettings& settings) {
    if (settings.quick) return {0.15, 0.2, 0.5};
    return {0.1, 0.15, 0.17, 0.2, 0.23, 0.25, 0.3, 0.5};
}

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
    plan.script = "figure_" + name + ".py";
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

static FigurePlan plan_figure_spheres(const PaperSettings& settings) {
    std::vector<Variant> variants;
    for (const double mu : friction_of_spheres(settings)) variants.push_back(with_friction(mu));
    return plan_variants(settings, "spheres", variants, numbers_of_spheres(settings),
                         settings.seeds());
}

// --- The change of direction ----------------------------------------------------------------

/// figure_spheres_direction_friction.csv: between which friction coefficients the direction changes
/// at the experiment's N. The reverse, N against the coefficient, has jumps. The coefficients are
/// too far apart for an interpolation. `results` are in the order of plan_variants().
static void write_friction_of_changes(const PaperSettings& settings,
                                      const std::vector<Json>& results, const fs::path& out,
                                      FigureOutcome& outcome) {
    const std::vector<std::int64_t> numbers = numbers_of_spheres(settings);
    const std::vector<double> coefficients = friction_of_spheres(settings);
    Table table({"discs", "before", "after", "direction"});
    for (const std::int64_t n : {smooth_change_n, rough_change_n}) {
        const auto k = static_cast<std::size_t>(std::find(numbers.begin(), numbers.end(), n) -
                                                numbers.begin());
        std::vector<RotationPoint> curve;
        for (std::size_t v = 0; v < coefficients.size(); ++v)
            curve.push_back(
                rotation_point(coefficients[v], results[v * numbers.size() + k], "by_time"));
        for (const SignChange& c : find_crossing(curve).changes) {
            table.add({n, c.before, c.after, std::string(direction_of(c))});
            outcome.findings.push_back(fmt::format("{} spheres change to {} between μ = {} and {}.",
                                                   n, direction_of(c), c.before, c.after));
        }
    }
    outcome.write(table, "spheres_direction_friction", out);
}

/// The runs of figure `spheres`; its table is that of the sign changes.
static FigurePlan plan_figure_spheres_direction(const PaperSettings& settings) {
    FigurePlan plan = plan_figure_spheres(settings);
    plan.script = "figure_spheres_direction.py";
    plan.finish = [settings, finish_spheres = plan.finish](const std::vector<Json>& results,
                                                           const fs::path& out) {
        const fs::path sign_changes = finish_spheres(results, out).files.back();
        FigureOutcome outcome{{}, {out / "figure_spheres_direction.csv"}};
        std::error_code error;
        fs::rename(sign_changes, outcome.files.back(), error);
        if (error)
            throw Failure(fmt::format("'{}' cannot be written: {}.", outcome.files.back().string(),
                                      error.message()));
        write_friction_of_changes(settings, results, out, outcome);
        return outcome;
    };
    return plan;
}

// --- The ingredients of the model -----------------------------------------------------------

/// All ingredients, and each one switched off alone; `ending` ends the names of the latter.
static std::vector<Variant> ingredients(double mu, const std::string& ending) {
    std::vector<Variant> variants{
        {"no-vertical", "no vertical friction", mu,
         [](RunConfig& c) { c.vertical_disc = c.vertical_wall = 0.0; }},
        {"no-vertical-disc", "no vertical friction between spheres", mu,
         [](RunConfig& c) { c.vertical_disc = 0.0; }},
        {"no-vertical-wall", "no vertical friction at the wall", mu,
         [](RunConfig& c) { c.vertical_wall = 0.0; }},
        {"no-floor", "no floor", mu, [](RunConfig& c) { c.floor = false; }},
        {"no-damping", "no damping (e = 1)", mu, [](RunConfig& c) { c.restitution = 1.0; }},
        {"shell", "hollow spheres (I = 2/3)", mu,
         [](RunConfig& c) { c.inertia = shell_inertia(c.mass, c.radius); }},
    };
    for (Variant& variant : variants) {
        variant.point = variant.name += ending;
        variant.words += fmt::format(", μ = {}", mu);
        variant.change = [mu, change = variant.change](RunConfig& c) {
            c.mu_disc = c.mu_wall = mu;
            change(c);
        };
    }
    variants.insert(variants.begin(), with_friction(mu));
    return variants;
}

static FigurePlan plan_figure_spheres_ingredients(const PaperSettings& settings) {
    return plan_variants(settings, "spheres_ingredients", ingredients(experiment_friction, ""),
                         fewer_numbers(settings), settings.seeds());
}

/// At a higher friction coefficient, at the N where the direction is decided.
static FigurePlan plan_figure_spheres_ingredients_rough(const PaperSettings& settings) {
    constexpr double mu = 0.3;
    std::vector<std::int64_t> numbers{44, 48};
    if (!settings.quick) numbers = {30, 36, 44, 48};
    return plan_variants(settings, "spheres_ingredients_rough", ingredients(mu, "-rough"), numbers,
                         settings.seeds());
}

static FigurePlan plan_figure_spheres_restitution(const PaperSettings& settings) {
    std::vector<double> restitutions{1.0, 0.9, 0.7};
    if (!settings.quick) restitutions = {1.0, 0.95, 0.9, 0.8, 0.7, 0.5};
    std::vector<Variant> variants;
    for (const double e : restitutions)
        variants.push_back({fmt::format("{}", e), fmt::format("e = {}", e), experiment_friction,
                            [e](RunConfig& c) { c.restitution = e; }, fmt::format("e{}", e)});
    std::vector<std::int64_t> numbers{30, 36, 48};
    if (!settings.quick) numbers = fewer_numbers(settings);
    return plan_variants(settings, "spheres_restitution", variants, numbers,
                         settings.seeds_beyond());
}

/// Discs with the inertia of solid discs that lie flat on the same floor. A higher floor friction
/// than the largest of these brings few discs to rest (docs/explanation/spheres.md).
static FigurePlan plan_figure_spheres_flat_discs(const PaperSettings& settings) {
    std::vector<Variant> variants;
    for (const double floor_friction : {0.0, 0.01, 0.02, 0.03})
        variants.push_back({fmt::format("flat-discs_f{}", floor_friction),
                            floor_friction == 0.0
                                ? std::string("solid discs (I = 1/2) without a floor")
                                : fmt::format("solid discs (I = 1/2), μ_f = {}", floor_friction),
                            experiment_friction, [floor_friction](RunConfig& c) {
                                c.body = Shape::disc;
                                c.inertia = solid_inertia(c.mass, c.radius);
                                c.floor = floor_friction > 0.0;
                                if (c.floor) c.floor_friction = floor_friction;
                            }});
    return plan_variants(settings, "spheres_flat_discs", variants, fewer_numbers(settings),
                         settings.seeds_beyond());
}

// --- Pinned spheres, few spheres, floor friction --------------------------------------------

static FigurePlan plan_figure_spheres_pinned(const PaperSettings& settings) {
    FigurePlan plan;
    plan.script = "figure_spheres_pinned.py";
    std::vector<std::int64_t> numbers{24, 30, 36, 44, 48, 54};
    if (!settings.quick) {
        numbers = fewer_numbers(settings);
        std::erase_if(numbers, [](std::int64_t n) { return n < first_n_of_experiment; });
    }
    const std::vector<Variant> variants{with_friction(0.15), with_friction(0.5)};
    CurveFigure figure = curves_of("spheres_pinned", variants, numbers);
    figure.measured = {"slip.pinned_region",
                       "slip.resident=slip_resident",
                       "slip.cluster",
                       "frustration.wall_spin",
                       "frustration.pinned_wall_spin",
                       "frustration.resident_spin",
                       "frustration.spin_correlation",
                       "frustration.triangles",
                       "residence.pinning=residence_begin",
                       "residence.depinning=residence_end",
                       "residence.share=residence_share",
                       "rolling.rolling_share",
                       "rolling.wall_rolling_share",
                       "rolling.floor_slip",
                       "rolling.contact_correlation",
                       "rolling.vertical_share",
                       "rolling.vertical_power"};
    for (const CurveFigure::Point& p : figure.points) {
        const Variant& variant = variants[p.curve];
        const RunConfig config = varied_experiment(settings, variant, p.discs);
        plan.points.push_back(varied_point(
            settings,
            fmt::format("spheres_measured_{}_N{}_{}", variant.name, p.discs, length_of(config)),
            config, settings.seeds(), {"slip", "frustration", "residence", "rolling"}));
    }
    plan.finish = [=](const std::vector<Json>& results, const fs::path& out) {
        FigureOutcome outcome;
        figure.write_points(results, out, outcome);
        for (std::size_t v = 0; v < variants.size(); ++v)
            outcome.findings.push_back(figure.at_both_ends(
                v, "slip parameter of spheres resident at the wall", "slip.resident", results));
        return outcome;
    };
    return plan;
}

/// At the N where the direction of the experiment's smooth spheres changes.
static FigurePlan plan_figure_spheres_map(const PaperSettings& settings) {
    FigurePlan plan;
    plan.script = "figure_spheres_map.py";
    std::vector<double> coefficients{0.1, 0.2, 0.5}, floors{0.03, 0.3, 1.0};
    if (!settings.quick) {
        coefficients = {0.05, 0.1, 0.15, 0.2, 0.3, 0.5, 1.0};
        floors = {0.01, 0.03, 0.1, 0.3, 1.0};
    }
    CurveFigure figure{"spheres_map", {"mu", "floor_friction", "mu_f_g"}, {}};
    for (const double mu : coefficients)
        for (const double floor_friction : floors) {
            RunConfig config = experiment(settings, smooth_change_n);
            config.mu_disc = config.mu_wall = mu;
            config.floor_friction = floor_friction;
            figure.curves.push_back({"", {mu, floor_friction, floor_friction * config.gravity}});
            plan.points.push_back(
                varied_point(settings,
                             fmt::format("spheres_map_{}_f{}_N{}_{}", mu, floor_friction,
                                         smooth_change_n, length_of(config)),
                             config, settings.seeds_beyond()));
        }
    figure.add_points({smooth_change_n});
    plan.finish = [=](const std::vector<Json>& results, const fs::path& out) {
        FigureOutcome outcome;
        figure.write_points(results, out, outcome);
        std::vector<RotationPoint> rotations;
        for (const Json& r : results) rotations.push_back(rotation_point(0.0, r, "by_time"));
        outcome.findings.push_back(fmt::format(
            "{} spheres certainly counterrotate at {} of {} pairs of friction coefficients of the "
            "contacts and of the floor.",
            smooth_change_n, count_counterrotating(rotations), results.size()));
        return outcome;
    };
    return plan;
}

/// "When there are only a few marbles in the container, they form a line that rolls along the
/// container wall at the frequency of the circular translations" (main text). More than five need
/// hundreds of periods to form it (docs/explanation/spheres.md), and such a line collides with the
/// wall tens of thousands of times in a period.
static FigurePlan plan_figure_spheres_few(const PaperSettings& settings) {
    FigurePlan plan;
    CurveFigure figure{"spheres_few", {}, {{"", {}}}};
    figure.measured = {"residence.share=residence_share"};
    std::vector<std::int64_t> numbers{3, 5};
    if (!settings.quick) numbers = {3, 4, 5};
    figure.add_points(numbers);
    for (const std::int64_t n : numbers) {
        RunConfig config = experiment(settings, n);
        config.warmup = settings.periods(settings.quick ? 50 : 100, 2);
        config.periods = *config.warmup + settings.periods(settings.quick ? 25 : 50, 3);
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
        {"spheres", "spheres that roll: rotation against N, for several friction coefficients",
         plan_figure_spheres},
        {"spheres_direction", "spheres that roll: where the direction of rotation changes",
         plan_figure_spheres_direction},
        {"spheres_few", "spheres that roll: a few of them, after a long warm-up (a table)",
         plan_figure_spheres_few},
        {"spheres_ingredients", "spheres that roll: each ingredient switched off alone",
         plan_figure_spheres_ingredients},
        {"spheres_ingredients_rough",
         "spheres that roll: each ingredient switched off, with more friction, μ = 0.3",
         plan_figure_spheres_ingredients_rough},
        {"spheres_pinned", "spheres that roll: pinned spheres, and frustration of the rolling",
         plan_figure_spheres_pinned},
        {"spheres_restitution", "spheres that roll: rotation against N, for several restitutions",
         plan_figure_spheres_restitution},
        {"spheres_flat_discs",
         "spheres that roll: for comparison, solid discs that slide on the floor",
         plan_figure_spheres_flat_discs},
        {"spheres_map", "36 spheres that roll: rotation against the friction of contacts and floor",
         plan_figure_spheres_map}};
}

}  // namespace swirl
