// The chapter "Spheres that roll": the paper's experiment, which its simulation is not
// (docs/spheres.md). Its dish with solid spheres on a floor: ϖ(N) for frictions between those of
// smooth and rough plastic, where its sign changes, what each ingredient of the model does, and
// what is seen of the pinned spheres and of the rolling.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "swirl/paper/figures.hpp"
#include "swirl/paper/points.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/report.hpp"
#include "swirl/study/crossing_search.hpp"

namespace swirl {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

/// Up to 57 fit. Of 56 and 57 the packing that a run began with decides, not friction, some runs
/// collapse, and each takes as long as a hundred others: they are left out.
std::vector<std::int64_t> numbers_of_spheres(const PaperSettings& settings) {
    if (settings.quick) return {8, 16, 24, 28, 30, 32, 34, 36, 40, 44, 48, 52};
    return {8,  12, 16, 20, 22, 24, 26, 28, 30, 32, 34, 35, 36,
            37, 38, 40, 42, 44, 46, 48, 50, 52, 53, 54, 55};
}

/// In steps that decide where ingredients differ.
std::vector<std::int64_t> fewer_numbers(const PaperSettings& settings) {
    if (settings.quick) return {16, 30, 36, 44, 48, 52};
    return {16, 24, 28, 30, 32, 34, 36, 40, 44, 48, 52, 54};
}

/// What few spheres need to forget their beginning, some 50 swirls, and as many as make the error
/// of ϖ/Ω a few thousandths. A dense dish forgets sooner, and has many more events in a swirl.
RunConfig experiment(const PaperSettings& settings, std::int64_t spheres) {
    RunConfig config = resolve({{"preset", "experiment"}});
    config.discs = spheres;
    config.seed = settings.seed;
    const bool dense = spheres >= 48;
    config.warmup = settings.periods(settings.quick || dense ? 25 : 50, 1);
    config.periods = *config.warmup + settings.periods(settings.quick || dense ? 50 : 150, 3);
    return config;
}

PaperPoint point_of_spheres(const PaperSettings& settings, const std::string& name,
                            const RunConfig& config, int seeds,
                            const std::vector<std::string>& measurements = {}) {
    RunConfig varied = config;
    return {settings, name, seeds, [&](std::uint64_t seed) {
                varied.seed = seed;
                return run_task(fmt::format("varied_{}_seed{}", name, seed), varied, measurements);
            }};
}

std::string length_of(const RunConfig& c) {
    return fmt::format("{}of{}periods", *c.warmup, *c.periods);
}

/// A curve, and how it differs from the experiment.
struct Variant {
    std::string name, words;
    double mu;
    std::function<void(RunConfig&)> change;
    std::string point = name;  // in the names of its points; no other variant has it
};

Variant friction(double mu) {
    return {fmt::format("{}", mu), fmt::format("μ = {}", mu), mu,
            [mu](RunConfig& c) { c.mu_disc = c.mu_wall = mu; }};
}

std::vector<double> friction_coefficients_of_spheres(const PaperSettings& settings) {
    if (settings.quick) return {0.15, 0.2, 0.5};
    // Close to each other about those at which as many change as in the experiment, 36 and 28.
    return {0.1, 0.15, 0.17, 0.2, 0.23, 0.25, 0.3, 0.5};
}

struct VariantPoint {
    std::size_t variant;
    std::int64_t spheres;
};

std::string sign_changes_sentence(const NamedCurve& curve) {
    const Crossings crossings = find_crossings(curve.curves);
    const Crossing& found = crossings[curve.rate];
    if (found.changes.empty()) return crossing_sentence(curve);
    std::string text = found.changes.size() == 1
                           ? "its sign changes once"
                           : fmt::format("its sign changes {} times", found.changes.size());
    for (const SignChange& change : found.changes)
        text += fmt::format("{} to {} {}", &change == found.changes.data() ? ":" : ",",
                            change.to_counterrotation ? "counterrotation" : "rotation",
                            change_location(change));
    if (!found.undetermined.empty())
        text += fmt::format("; it is undetermined at N = {}", listed(found.undetermined));
    const RotationPoint* const lowest = lowest_of(curve.points());
    return fmt::format("{}; lowest is ϖ/Ω = {} at N = {:.0f} ({}).{}", text,
                       with_error(lowest->mean, lowest->error), lowest->discs,
                       rotation_rates[curve.rate].description,
                       other_rates_report(crossings, curve.rate));
}

/// Every change of sign of a curve, and every number at which its sign is undetermined, in the
/// order of N.
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
                   std::string(c.to_counterrotation ? "counterrotation" : "rotation")});
    }
    add_undetermined(std::numeric_limits<double>::infinity());
}

/// `seeds` of a point: settings.seeds() where a claim rests on it.
FigurePlan plan_variants(const PaperSettings& settings, const std::string& name,
                         const std::vector<Variant>& variants,
                         const std::vector<std::int64_t>& numbers, int seeds) {
    FigurePlan plan;
    plan.script = "figure_" + name + ".py";
    std::vector<VariantPoint> points;
    for (std::size_t v = 0; v < variants.size(); ++v)
        for (const std::int64_t n : numbers) {
            RunConfig config = experiment(settings, n);
            variants[v].change(config);
            points.push_back({v, n});
            plan.points.push_back(point_of_spheres(
                settings, fmt::format("spheres_{}_N{}_{}", variants[v].point, n, length_of(config)),
                config, seeds));
        }
    plan.finish = [=](const std::vector<Json>& results, const fs::path& out) {
        Table table(joined({"curve", "mu", "discs"}, rotation_columns()));
        Table changes({"curve", "mu", "crossing", "crossing_error", "lower", "upper", "before",
                       "after", "sense"});
        FigureOutcome outcome;
        std::vector<NamedCurve> named;
        for (std::size_t v = 0; v < variants.size(); ++v) {
            NamedCurve curve{variants[v].name};
            for (std::size_t k = 0; k < points.size(); ++k) {
                if (points[k].variant != v) continue;
                std::vector<Table::Cell> row{variants[v].name, variants[v].mu, points[k].spheres};
                add_rotation(row, results[k]);
                table.add(std::move(row));
                curve.add(static_cast<double>(points[k].spheres), results[k]);
            }
            add_sign_changes(changes, variants[v], find_crossing(curve.points()));
            outcome.findings.push_back(
                fmt::format("{}: {}", variants[v].words, sign_changes_sentence(curve)));
            named.push_back(std::move(curve));
        }
        outcome.files.push_back(out / ("figure_" + name + ".csv"));
        table.write(outcome.files.back());
        outcome.files.push_back(out / ("figure_" + name + "_crossings.csv"));
        write_crossings(named, outcome.files.back());
        outcome.files.push_back(out / ("figure_" + name + "_sign_changes.csv"));
        changes.write(outcome.files.back());
        return outcome;
    };
    return plan;
}

/// Between which frictions as many spheres as those of the experiment that changed their sense
/// change theirs: the other way round, as the N of the last change jumps with the friction. The
/// frictions are too far apart for a straight line to say where. In the order of plan_variants().
FigureOutcome friction_coefficients_of_the_experiment(const PaperSettings& settings,
                                                      const std::vector<Json>& results,
                                                      const fs::path& file) {
    const std::vector<std::int64_t> numbers = numbers_of_spheres(settings);
    const std::vector<double> friction_coefficients = friction_coefficients_of_spheres(settings);
    Table table({"discs", "before", "after", "sense"});
    FigureOutcome outcome{{}, {file}};
    for (const std::int64_t n : {36, 28}) {
        const auto k = static_cast<std::size_t>(std::find(numbers.begin(), numbers.end(), n) -
                                                numbers.begin());
        std::vector<RotationPoint> curve;
        for (std::size_t v = 0; v < friction_coefficients.size(); ++v)
            curve.push_back(rotation_point(friction_coefficients[v],
                                           results[v * numbers.size() + k], "by_time"));
        for (const SignChange& c : find_crossing(curve).changes) {
            const char* const sense = c.to_counterrotation ? "counterrotation" : "rotation";
            table.add({n, c.before, c.after, std::string(sense)});
            outcome.findings.push_back(fmt::format("{} spheres change to {} between μ = {} and {}.",
                                                   n, sense, c.before, c.after));
        }
    }
    table.write(file);
    return outcome;
}

/// What is measured of them, and the columns of the table.
struct Seen {
    const char *measurement, *quantity, *column = quantity;
};
constexpr std::array<Seen, 17> seen{{
    {"slip", "pinned_region"},
    {"slip", "resident", "slip_resident"},
    {"slip", "cluster"},
    {"frustration", "wall_spin"},
    {"frustration", "pinned_wall_spin"},
    {"frustration", "resident_spin"},
    {"frustration", "spin_correlation"},
    {"frustration", "triangles"},
    {"residence", "becoming_pinned", "residence_begin"},
    {"residence", "becoming_free", "residence_end"},
    {"residence", "share", "residence_share"},
    {"rolling", "rolling_share"},
    {"rolling", "wall_rolling_share"},
    {"rolling", "floor_slip"},
    {"rolling", "contact_correlation"},
    {"rolling", "vertical_share"},
    {"rolling", "vertical_power"},
}};

std::string at_both_ends(const std::vector<VariantPoint>& points, const std::vector<Json>& results,
                         std::size_t variant, const char* measurement, const char* quantity,
                         const char* words) {
    std::string text = words;
    std::vector<std::size_t> known;
    for (std::size_t k = 0; k < points.size(); ++k)
        if (points[k].variant == variant &&
            !std::isnan(number(at(results[k], {"measured", measurement, quantity, "mean"}))))
            known.push_back(k);
    if (known.empty()) return text + " is not known";
    for (const std::size_t k : {known.front(), known.back()}) {
        const Json& found = at(results[k], {"measured", measurement, quantity});
        text += fmt::format("{} {} at N = {}", k == known.front() ? "" : ",",
                            with_error(number(at(found, {"mean"})), number(at(found, {"error"}))),
                            points[k].spheres);
    }
    return text;
}

}  // namespace

static FigurePlan plan_figure_spheres(const PaperSettings& settings) {
    std::vector<Variant> variants;
    for (const double mu : friction_coefficients_of_spheres(settings))
        variants.push_back(friction(mu));
    return plan_variants(settings, "spheres", variants, numbers_of_spheres(settings),
                         settings.seeds());
}

/// The same runs; the table is that of the changes of sign.
static FigurePlan plan_figure_spheres_sense(const PaperSettings& settings) {
    FigurePlan plan = plan_figure_spheres(settings);
    const auto curves = plan.finish;
    plan.script = "figure_spheres_sense.py";
    plan.finish = [=](const std::vector<Json>& results, const fs::path& out) {
        FigureOutcome outcome = curves(results, out);
        const fs::path table = out / "figure_spheres_sense.csv";
        std::error_code error;
        fs::rename(outcome.files.back(), table, error);
        if (error)
            throw Failure(
                fmt::format("'{}' cannot be written: {}.", table.string(), error.message()));
        FigureOutcome at_numbers = friction_coefficients_of_the_experiment(
            settings, results, out / "figure_spheres_sense_frictions.csv");
        at_numbers.files.insert(at_numbers.files.begin(), table);
        return at_numbers;
    };
    return plan;
}

namespace {

/// All ingredients of the model, and each switched off alone.
std::vector<Variant> ingredients(double mu, const std::string& ending) {
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
    variants.insert(variants.begin(), friction(mu));
    return variants;
}

}  // namespace

static FigurePlan plan_figure_spheres_ingredients(const PaperSettings& settings) {
    return plan_variants(settings, "spheres_ingredients", ingredients(experiment_friction, ""),
                         fewer_numbers(settings), settings.seeds());
}

/// At a friction that is half as high again, where it decides: does the answer depend on it?
static FigurePlan plan_figure_spheres_ingredients_rough(const PaperSettings& settings) {
    const std::vector<std::int64_t> numbers = settings.quick
                                                  ? std::vector<std::int64_t>{44, 48}
                                                  : std::vector<std::int64_t>{30, 36, 44, 48};
    return plan_variants(settings, "spheres_ingredients_rough", ingredients(0.3, "-rough"), numbers,
                         settings.seeds());
}

static FigurePlan plan_figure_spheres_pinned(const PaperSettings& settings) {
    FigurePlan plan;
    plan.script = "figure_spheres_pinned.py";
    // From where the experiment's slip begins.
    std::vector<std::int64_t> numbers{24, 30, 36, 44, 48, 54};
    if (!settings.quick) {
        numbers.clear();
        for (const std::int64_t n : fewer_numbers(settings))
            if (n >= 24) numbers.push_back(n);
    }
    const std::vector<Variant> variants{friction(0.15), friction(0.5)};
    std::vector<VariantPoint> points;
    for (std::size_t v = 0; v < variants.size(); ++v)
        for (const std::int64_t n : numbers) {
            RunConfig config = experiment(settings, n);
            variants[v].change(config);
            points.push_back({v, n});
            const std::string name =
                fmt::format("spheres_measured_{}_N{}_{}", variants[v].name, n, length_of(config));
            plan.points.push_back(
                point_of_spheres(settings, name, config, settings.seeds(),
                                 {"slip", "frustration", "residence", "rolling"}));
        }
    plan.finish = [=](const std::vector<Json>& results, const fs::path& out) {
        std::vector<std::string> columns{"curve", "mu", "discs"};
        for (const Seen& what : seen)
            columns.insert(columns.end(), {what.column, fmt::format("{}_error", what.column)});
        Table table(joined(columns, rotation_columns()));
        FigureOutcome outcome;
        for (std::size_t k = 0; k < points.size(); ++k) {
            const Variant& variant = variants[points[k].variant];
            std::vector<Table::Cell> row{variant.name, variant.mu, points[k].spheres};
            for (const Seen& what : seen)
                for (const char* part : {"mean", "error"})
                    row.emplace_back(number(
                        at(results[k], {"measured", what.measurement, what.quantity, part})));
            add_rotation(row, results[k]);
            table.add(std::move(row));
        }
        for (std::size_t v = 0; v < variants.size(); ++v)
            outcome.findings.push_back(
                fmt::format("spheres, {}: {}.", variants[v].words,
                            at_both_ends(points, results, v, "slip", "resident",
                                         "slip parameter of those resident at the wall")));
        outcome.files.push_back(out / "figure_spheres_pinned.csv");
        table.write(outcome.files.back());
        return outcome;
    };
    return plan;
}

static FigurePlan plan_figure_spheres_restitution(const PaperSettings& settings) {
    std::vector<Variant> variants;
    for (const double e : settings.quick ? std::vector<double>{1.0, 0.9, 0.7}
                                         : std::vector<double>{1.0, 0.95, 0.9, 0.8, 0.7, 0.5})
        variants.push_back({fmt::format("{}", e), fmt::format("e = {}", e), experiment_friction,
                            [e](RunConfig& c) { c.restitution = e; }, fmt::format("e{}", e)});
    std::vector<std::int64_t> numbers{30, 36, 48};
    if (!settings.quick) numbers = fewer_numbers(settings);
    return plan_variants(settings, "spheres_restitution", variants, numbers,
                         settings.seeds_beyond());
}

/// Discs with the inertia that discs have lie flat on the same floor. One that rubs more than the
/// strongest of these brings few of them to rest (docs/spheres.md).
static FigurePlan plan_figure_spheres_coins(const PaperSettings& settings) {
    std::vector<Variant> variants;
    for (const double floor_friction : {0.0, 0.01, 0.02, 0.03})
        variants.push_back({fmt::format("coins_f{}", floor_friction),
                            floor_friction == 0.0
                                ? std::string("solid discs (I = 1/2) without a floor")
                                : fmt::format("solid discs (I = 1/2), μ_f = {}", floor_friction),
                            experiment_friction, [floor_friction](RunConfig& c) {
                                c.body = Shape::disc;
                                c.inertia = solid_inertia(c.mass, c.radius);
                                c.floor = floor_friction > 0.0;
                                if (c.floor) c.floor_friction = floor_friction;
                            }});
    return plan_variants(settings, "spheres_coins", variants, fewer_numbers(settings),
                         settings.seeds_beyond());
}

/// At the number where smooth spheres of the experiment changed their sense.
static FigurePlan plan_figure_spheres_map(const PaperSettings& settings) {
    constexpr std::int64_t spheres = 36;
    FigurePlan plan;
    plan.script = "figure_spheres_map.py";
    std::vector<double> friction_coefficients{0.1, 0.2, 0.5}, floors{0.03, 0.3, 1.0};
    if (!settings.quick) {
        friction_coefficients = {0.05, 0.1, 0.15, 0.2, 0.3, 0.5, 1.0};
        floors = {0.01, 0.03, 0.1, 0.3, 1.0};
    }
    std::vector<RunConfig> points;
    for (const double mu : friction_coefficients)
        for (const double floor_friction : floors) {
            RunConfig config = experiment(settings, spheres);
            config.mu_disc = config.mu_wall = mu;
            config.floor_friction = floor_friction;
            points.push_back(config);
            plan.points.push_back(
                varied_point(settings,
                             fmt::format("spheres_map_{}_f{}_N{}_{}", mu, floor_friction, spheres,
                                         length_of(config)),
                             config));
        }
    plan.finish = [=](const std::vector<Json>& results, const fs::path& out) {
        Table table(joined({"mu", "floor_friction", "mu_f_g", "discs"}, rotation_columns()));
        FigureOutcome outcome;
        std::size_t against = 0;
        for (std::size_t k = 0; k < points.size(); ++k) {
            const RunConfig& c = points[k];
            std::vector<Table::Cell> row{c.mu_disc, c.floor_friction, c.floor_friction * c.gravity,
                                         spheres};
            add_rotation(row, results[k]);
            table.add(std::move(row));
            const RotationPoint p = rotation_point(0.0, results[k], "by_time");
            if (p.mean < -3.0 * p.error) ++against;
        }
        outcome.findings.push_back(
            fmt::format("spheres, frictions of the contacts and of the floor: {} spheres certainly "
                        "counterrotate "
                        "at {} of {} pairs.",
                        spheres, against, points.size()));
        outcome.files.push_back(out / "figure_spheres_map.csv");
        table.write(outcome.files.back());
        return outcome;
    };
    return plan;
}

/// "When there are only a few marbles in the container, they form a line that rolls along the
/// container wall at the frequency of the circular translations" (main text). More than five take
/// hundreds of periods until they do (docs/spheres.md), and such a line collides with the wall tens
/// of thousands of times in a period.
static FigurePlan plan_figure_spheres_few(const PaperSettings& settings) {
    FigurePlan plan;
    const std::vector<std::int64_t> numbers =
        settings.quick ? std::vector<std::int64_t>{3, 5} : std::vector<std::int64_t>{3, 4, 5};
    for (const std::int64_t n : numbers) {
        RunConfig config = experiment(settings, n);
        config.warmup = settings.periods(settings.quick ? 50 : 100, 2);
        config.periods = *config.warmup + settings.periods(settings.quick ? 25 : 50, 3);
        plan.points.push_back(
            point_of_spheres(settings, fmt::format("spheres_few_N{}_{}", n, length_of(config)),
                             config, settings.seeds(), {"residence"}));
    }
    plan.finish = [=](const std::vector<Json>& results, const fs::path& out) {
        Table table(
            joined({"discs", "residence_share", "residence_share_error"}, rotation_columns()));
        FigureOutcome outcome;
        for (std::size_t k = 0; k < numbers.size(); ++k) {
            const Json& share = at(results[k], {"measured", "residence", "share"});
            std::vector<Table::Cell> row{numbers[k]};
            for (const char* part : {"mean", "error"}) row.emplace_back(number(at(share, {part})));
            add_rotation(row, results[k]);
            table.add(std::move(row));
            const RotationPoint p = rotation_point(0.0, results[k], "by_time");
            outcome.findings.push_back(
                fmt::format("{} spheres: ϖ/Ω = {}, share resident at the wall {}.", numbers[k],
                            with_error(p.mean, p.error),
                            with_error(number(at(share, {"mean"})), number(at(share, {"error"})))));
        }
        outcome.files.push_back(out / "figure_spheres_few.csv");
        table.write(outcome.files.back());
        return outcome;
    };
    return plan;
}

std::vector<PaperFigure> figures_of_spheres() {
    return {
        {"spheres", "spheres that roll: rotation against N, for several frictions",
         plan_figure_spheres},
        {"spheres_sense", "spheres that roll: where the sense of rotation changes",
         plan_figure_spheres_sense},
        {"spheres_few", "spheres that roll: a few of them, after a long warm-up (a table)",
         plan_figure_spheres_few},
        {"spheres_ingredients", "spheres that roll: each ingredient switched off alone",
         plan_figure_spheres_ingredients},
        {"spheres_ingredients_rough",
         "spheres that roll: each ingredient switched off, with more friction, μ = 0.3",
         plan_figure_spheres_ingredients_rough},
        {"spheres_pinned", "spheres that roll: the pinned, and the frustration of rolling",
         plan_figure_spheres_pinned},
        {"spheres_restitution", "spheres that roll: rotation against N, for several restitutions",
         plan_figure_spheres_restitution},
        {"spheres_coins", "spheres that roll, beside them: solid discs that slide on the floor",
         plan_figure_spheres_coins},
        {"spheres_map",
         "spheres that roll: rotation of 36 against the frictions of contacts and floor",
         plan_figure_spheres_map}};
}

}  // namespace swirl
