// Figures beyond the paper about the kind of average, and about the parameters that the paper holds
// fixed: friction coefficients, inertia, restitution, the path.
#include <fmt/format.h>

#include <cmath>

#include "swirl/io/atomic_file.hpp"
#include "swirl/paper/curves.hpp"
#include "swirl/paper/figures.hpp"
#include "swirl/paper/points.hpp"
#include "swirl/run/report.hpp"

namespace swirl {
namespace {

/// A curve ϖ(N) at one value of a parameter.
struct VariedCurve {
    double value;
    std::function<void(RunConfig&)> change;
};

FigurePlan plan_curves(const PaperSettings& settings, const std::string& name,
                       const std::string& parameter, const std::vector<VariedCurve>& varied,
                       const std::vector<std::int64_t>& numbers) {
    FigurePlan plan;
    CurveFigure figure{name, {"curve", parameter}, {}};
    for (const VariedCurve& curve : varied) {
        const std::string value = fmt::format("{}", curve.value);
        figure.curves.push_back({value, {value, curve.value}});
    }
    figure.add_points(numbers);
    for (const CurveFigure::Point& p : figure.points) {
        RunConfig config = paper_config(settings, high_friction, p.discs);
        // Half of the paper's events: there are many curves, and the errors remain small.
        config.events = settings.events.value_or(settings.default_events / 2);
        if (p.discs > last_n) set_dense_length(config, settings);
        varied[p.curve].change(config);
        plan.points.push_back(
            varied_point(settings,
                         fmt::format("{}_{}_N{}_{}", name, figure.curves[p.curve].name, p.discs,
                                     length_of(config)),
                         config, settings.seeds_beyond()));
    }
    plan.finish = [=](const std::vector<Json>& results, const fs::path& out) {
        FigureOutcome outcome;
        figure.write_points(results, out, outcome);
        for (const NamedCurve& curve : figure.named_curves(results))
            outcome.findings.push_back(
                fmt::format("{} {}: {}", parameter, curve.name, crossing_sentence(curve)));
        figure.write_crossings(results, out, outcome);
        return outcome;
    };
    return plan;
}

}  // namespace

static FigurePlan plan_figure_inertia(const PaperSettings& settings) {
    std::vector<VariedCurve> curves;
    for (const double inertia : {0.5, 1.0, 3.0, 10.0, 100.0, 1e4})
        curves.push_back({inertia, [inertia](RunConfig& c) { c.inertia = inertia; }});
    // Discs with a physical inertia cross beyond the paper's last N, if at all.
    return plan_curves(settings, "inertia", "inertia", curves, [&] {
        std::vector<std::int64_t> numbers = sparse_numbers(settings);
        for (const std::int64_t n : numbers_beyond(settings)) numbers.push_back(n);
        return numbers;
    }());
}

static FigurePlan plan_figure_restitution(const PaperSettings& settings) {
    std::vector<VariedCurve> curves;
    for (const double e : {1.0, 0.99, 0.9})
        curves.push_back({e, [e](RunConfig& c) { c.restitution = e; }});
    return plan_curves(settings, "restitution", "restitution", curves, sparse_numbers(settings));
}

static FigurePlan plan_figure_tangential(const PaperSettings& settings) {
    std::vector<VariedCurve> curves;
    for (const double beta : {0.0, 0.5, 1.0})
        curves.push_back({beta, [beta](RunConfig& c) {
                              c.tangential_restitution = beta;
                              c.inertia = solid_inertia(c.mass, c.radius);
                          }});
    return plan_curves(settings, "tangential", "tangential_restitution", curves,
                       sparse_numbers(settings));
}

// --- Averages by event and by time ----------------------------------------------------------

/// Where the two averages differ most.
static std::string largest_difference(const Friction& friction, std::span<const Json> results) {
    double maximum = -1.0;
    std::string found = "no runs";
    for (const Json& r : results) {
        const RotationPoint event = rotation_point(0.0, r, "by_event"),
                            time = rotation_point(0.0, r, "by_time");
        if (!(std::fabs(event.mean - time.mean) > maximum)) continue;
        maximum = std::fabs(event.mean - time.mean);
        found = fmt::format("largest difference at N = {}, ϖ/Ω = {} by event and {} by time",
                            number(at(r, {"config", "discs"})), with_error(event.mean, event.error),
                            with_error(time.mean, time.error));
    }
    return fmt::format("{} (μ_d = {}, μ_w = {}): {}.", friction.words, friction.mu_disc,
                       friction.mu_wall, found);
}

/// The runs and the table of Figure 5b.
static FigurePlan plan_figure_averages(const PaperSettings& settings) {
    FigurePlan plan = plan_figure_5b(settings);
    const std::size_t numbers = numbers_of_discs(settings).size();
    plan.finish = [finish_5b = plan.finish, numbers](const std::vector<Json>& results,
                                                     const fs::path& out) {
        FigureOutcome outcome = finish_5b(results, out);
        const fs::path table = out / "figure_averages.csv";
        write_file_atomically(table, read_whole_file(outcome.files.front()));
        outcome = {{}, {table}};
        // The results are grouped by friction; the N beyond the paper's follow at the end.
        for (std::size_t f = 0; f < std::size(friction_of_5b); ++f)
            outcome.findings.push_back(largest_difference(
                friction_of_5b[f], std::span(results).subspan(f * numbers, numbers)));
        return outcome;
    };
    return plan;
}

// --- The crossing against the friction coefficient --------------------------------------------

static FigurePlan plan_figure_friction(const PaperSettings& settings) {
    FigurePlan plan;
    std::vector<double> coefficients{0.1, 0.5, 1.0};
    if (!settings.quick) coefficients = {0.05, 0.1, 0.2, 0.3, 0.5, 0.7, 1.0, 2.0};
    for (const double mu : coefficients) {
        CrossingSettings search = search_for_crossing();
        search.config = paper_config(settings, {"", "", mu, mu}, last_n);
        search.config.events = settings.events.value_or(300'000);
        search.to = numbers_beyond(settings).back();  // μ = 0.2 crosses beyond the paper's last N
        plan.points.push_back(crossing_task(
            fmt::format("N_c_mu{}_{}events_seed{}", mu, search.config.events, settings.seed),
            search));
    }
    plan.finish = [=](const std::vector<Json>& results, const fs::path& out) {
        Table table(joined({"mu"}, search_columns()));
        FigureOutcome outcome;
        for (std::size_t k = 0; k < coefficients.size(); ++k) {
            if (failed(results[k])) continue;
            std::vector<Table::Cell> row{coefficients[k]};
            add_search(row, results[k]);
            table.add(std::move(row));
            outcome.findings.push_back(fmt::format("μ = {}: {}", coefficients[k],
                                                   results[k]["report"].get<std::string>()));
        }
        outcome.write(table, "friction", out);
        return outcome;
    };
    return plan;
}

// --- The path -------------------------------------------------------------------------------

static FigurePlan plan_figure_polygon(const PaperSettings& settings) {
    FigurePlan plan;
    std::vector<int> sides{6, 30, 300, 0};  // 0: the circle
    if (!settings.quick) sides = {6, 10, 20, 30, 60, 100, 300, 0};
    CurveFigure figure{"polygon", {"sides"}, {}};
    for (const int m : sides)
        figure.curves.push_back(
            {"", {std::int64_t{m}}, m > 0 ? fmt::format("{} sides", m) : "the circle"});
    for (const std::int64_t n : {rotating_n, counterrotating_n})
        for (std::size_t c = 0; c < sides.size(); ++c) figure.points.push_back({c, n});
    for (const CurveFigure::Point& p : figure.points) {
        RunConfig config = paper_config(settings, high_friction, p.discs);
        // Vertices are events, too. A length in periods gives every path the same time.
        config.periods = settings.periods(p.discs == rotating_n ? 2000 : 300, 5);
        set_sides(config, sides[p.curve]);
        plan.points.push_back(varied_point(
            settings,
            fmt::format("polygon_M{}_N{}_{}periods", sides[p.curve], p.discs, *config.periods),
            config, settings.seeds_beyond()));
    }
    plan.finish = [=](const std::vector<Json>& results, const fs::path& out) {
        FigureOutcome outcome;
        figure.write_points(results, out, outcome);
        for (std::size_t k = 0; k < results.size(); ++k) {
            const auto& [curve, discs] = figure.points[k];
            if (curve == 0) outcome.findings.push_back(fmt::format("N = {}: ϖ/Ω by time =", discs));
            const RotationPoint p = rotation_point(0.0, results[k], "by_time");
            outcome.findings.back() +=
                fmt::format(" {} on {}{}", with_error(p.mean, p.error), figure.curves[curve].words,
                            curve + 1 < sides.size() ? "," : ".");
        }
        return outcome;
    };
    return plan;
}

// --- Both friction coefficients -------------------------------------------------------------

static FigurePlan plan_figure_map(const PaperSettings& settings) {
    FigurePlan plan;
    std::vector<double> coefficients{0.0, 0.1, 0.3, 1.0};
    if (!settings.quick) coefficients = {0.0, 0.02, 0.05, 0.1, 0.2, 0.3, 0.5, 0.7, 1.0};
    CurveFigure figure{"map", {"mu_disc", "mu_wall"}, {}};
    for (const double mu_disc : coefficients)
        for (const double mu_wall : coefficients) {
            if (mu_disc == 0.0 && mu_wall == 0.0) continue;  // there is no steady state
            RunConfig config = paper_config(settings, {"", "", mu_disc, mu_wall}, last_n);
            config.warmup = settings.periods(100, 2);
            config.periods = *config.warmup + settings.periods(200, 4);
            figure.curves.push_back(
                {"", {mu_disc, mu_wall}, fmt::format("μ_d = {}, μ_w = {}", mu_disc, mu_wall)});
            plan.points.push_back(varied_point(
                settings, fmt::format("map_d{}_w{}_{}", mu_disc, mu_wall, length_of(config)),
                config, settings.seeds_beyond()));
        }
    figure.add_points({last_n});
    plan.finish = [=](const std::vector<Json>& results, const fs::path& out) {
        FigureOutcome outcome;
        figure.write_points(results, out, outcome);
        std::vector<RotationPoint> rotations;
        for (const Json& r : results) rotations.push_back(rotation_point(0.0, r, "by_time"));
        const RotationPoint* const lowest = lowest_of(rotations);
        outcome.findings.push_back(
            lowest ? fmt::format("{} discs certainly counterrotate at {} of {} pairs of friction "
                                 "coefficients; lowest is ϖ/Ω = {} at {}.",
                                 last_n, count_counterrotating(rotations), results.size(),
                                 with_error(lowest->mean, lowest->error),
                                 figure.curves[std::size_t(lowest - rotations.data())].words)
                   : "No run was completed.");
        return outcome;
    };
    return plan;
}

std::vector<PaperFigure> figures_of_parameters() {
    return {
        {"averages", "beyond the paper: by event and by time", plan_figure_averages},
        {"friction", "beyond the paper: the crossing N_c against μ", plan_figure_friction},
        {"inertia", "beyond the paper: moment of inertia ½ to 10⁴", plan_figure_inertia},
        {"restitution", "beyond the paper: restitution e = 1, 0.99, 0.9", plan_figure_restitution},
        {"tangential", "beyond the paper: tangential restitution, solid discs",
         plan_figure_tangential},
        {"polygon", "beyond the paper: the polygon's sides, and the true circle",
         plan_figure_polygon},
        {"map", "beyond the paper: both friction coefficients at N = 48", plan_figure_map}};
}

}  // namespace swirl
