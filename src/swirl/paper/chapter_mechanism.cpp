// Mechanism: which contacts turn the cluster? The torque budget against N; whether opposite spins
// of touching discs ("gears") or the slip at the wall predict the rotation; and does the direction
// still change if one kind of contact has no friction?
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "swirl/paper/chapters.hpp"
#include "swirl/paper/coarse_zero.hpp"
#include "swirl/paper/curves.hpp"
#include "swirl/paper/points.hpp"
#include "swirl/paper/rank_correlation.hpp"
#include "swirl/run/report.hpp"

namespace swirl {
namespace {

/// One point of these figures: discs with the paper's parameters except for μ.
RunConfig mechanism_config(const PaperSettings& settings, std::int64_t discs, double mu) {
    RunConfig config = paper_config(settings, {"", "", mu, mu}, discs);
    config.warmup = settings.periods(20, 2);
    config.periods = *config.warmup + settings.periods(80, 4);
    return config;
}

/// A measured quantity, such as "torque.transfer", against N.
std::vector<RotationPoint> measured_curve(const CurveFigure& figure, std::size_t curve,
                                          const std::vector<Json>& results,
                                          const std::string& quantity) {
    const std::size_t dot = quantity.find('.');
    std::vector<RotationPoint> points;
    for (std::size_t k = 0; k < results.size(); ++k) {
        if (figure.points[k].curve != curve) continue;
        const Json& row = at(results[k], {"measured", quantity.substr(0, dot).c_str(),
                                          quantity.substr(dot + 1).c_str()});
        points.push_back({static_cast<double>(figure.points[k].discs), number(at(row, {"mean"})),
                          number(at(row, {"error"}))});
    }
    return points;
}

std::string zero_in_words(const CoarseZero& zero) {
    return zero.exists() ? "N = " + with_error(zero.discs, zero.error) : "no certain N";
}

// --- Torques --------------------------------------------------------------------------------

const std::vector<std::string> torques{
    "torque.wall_normal",       "torque.wall_tangential",        "torque.transfer",
    "torque.wall_on_spins",     "torque.discs_on_spins",         "torque.wall_about_centre",
    "torque.container_torque",  "torque.wall_sticking",          "torque.wall_sliding",
    "torque.transfer_sticking", "torque.transfer_sliding",       "torque.wall_normal_pinned",
    "torque.wall_normal_loose", "torque.wall_tangential_pinned", "torque.wall_tangential_loose",
    "torque.transfer_pinned",   "torque.transfer_mixed",         "torque.transfer_loose"};

FigurePlan plan_figure_torque(const PaperSettings& settings) {
    FigurePlan plan;
    CurveFigure figure{"torque", {"mu"}, {{"", {1.0}, "μ = 1"}}};
    figure.measured = torques;
    figure.measured.insert(figure.measured.end(),
                           {"torque.orbital", "torque.spins", "torque.unaccounted_share"});
    figure.add_points(settings.quick ? std::vector<std::int64_t>{20, 32, 40, 48}
                                     : std::vector<std::int64_t>{8, 12, 16, 20, 24, 28, 32, 34, 36,
                                                                 38, 40, 42, 45, 48, 52});
    for (const CurveFigure::Point& p : figure.points) {
        const RunConfig config = mechanism_config(settings, p.discs, 1.0);
        plan.points.push_back(varied_point(settings,
                                           fmt::format("torque_N{}_{}", p.discs, length_of(config)),
                                           config, chapter_seeds(settings), {"torque"}));
    }
    plan.finish = [=](const std::vector<Json>& results, const fs::path& out) {
        FigureOutcome outcome;
        figure.write_points(results, out, outcome);
        std::vector<std::string> words;
        for (const std::string& torque : torques) {
            const CoarseZero zero = last_zero(measured_curve(figure, 0, results, torque));
            if (zero.exists())
                words.push_back(fmt::format("{} at {} ({})", torque.substr(7), zero_in_words(zero),
                                            zero.falls ? "to negative" : "to positive"));
        }
        const CoarseZero rotation = last_zero(figure.named_curves(results)[0].points());
        outcome.findings.push_back(
            fmt::format("The rotation changes sign at {}. {} of {} torques change sign with N: {}.",
                        zero_in_words(rotation), words.size(), torques.size(),
                        words.empty() ? "none" : fmt::format("{}", fmt::join(words, "; "))));
        return outcome;
    };
    return plan;
}

// --- Gears or slip --------------------------------------------------------------------------

struct Predictor {
    const char *quantity, *words;
};
constexpr Predictor predictors[] = {
    {"frustration.correlation_by_impulse", "spins of strong contacts"},
    {"frustration.spin_correlation", "spins of touching discs"},
    {"slip.resident", "slip parameter of the resident discs"},
    {"frustration.wall_sticking", "share of sticking contacts at the wall"},
    {"frustration.resident_spin", "spin of the resident discs"}};

/// The values of all predictors and of the rotation, at the points that have all of them.
struct Predictions {
    std::vector<Values> predictor{std::size(predictors)};
    Values rotation;

    void add(const Json& result) {
        const double rate = number(at(result, {"rotation", "by_time", "mean"}));
        Values row;
        for (const auto& [quantity, words] : predictors) {
            const std::string name = quantity;
            const std::size_t dot = name.find('.');
            row.push_back(number(at(result, {"measured", name.substr(0, dot).c_str(),
                                             name.substr(dot + 1).c_str(), "mean"})));
        }
        for (const double value : row)
            if (!std::isfinite(value) || !std::isfinite(rate)) return;
        rotation.push_back(rate);
        for (std::size_t p = 0; p < row.size(); ++p) predictor[p].push_back(row[p]);
    }
    double rank(std::size_t p, const std::vector<std::size_t>& points) const {
        return rank_correlation_of(chosen(predictor[p], points), chosen(rotation, points));
    }
    double square(std::size_t p, const std::vector<std::size_t>& points) const {
        const double r = correlation_of(chosen(predictor[p], points), chosen(rotation, points));
        return r * r;
    }
};

FigureOutcome finish_gears(const CurveFigure& figure, const std::vector<Json>& results,
                           const fs::path& out) {
    FigureOutcome outcome;
    figure.write_points(results, out, outcome);
    Predictions all;
    for (const Json& result : results) all.add(result);
    const std::size_t n = all.rotation.size();
    Table table({"predictor", "points", "rank_correlation", "rank_correlation_error", "r_squared",
                 "r_squared_error"});
    std::vector<std::string> words;
    for (std::size_t p = 0; p < std::size(predictors); ++p) {
        const Estimate rank = jackknife(n, [&](const auto& k) { return all.rank(p, k); });
        const Estimate square = jackknife(n, [&](const auto& k) { return all.square(p, k); });
        table.add({std::string(predictors[p].quantity), static_cast<std::int64_t>(n), rank.mean,
                   rank.error, square.mean, square.error});
        words.push_back(
            fmt::format("{} {}", predictors[p].words, with_error(rank.mean, rank.error)));
    }
    outcome.write(table, figure.name + "_ranks", out);
    const Estimate better = jackknife(
        n, [&](const auto& k) { return std::fabs(all.rank(0, k)) - std::fabs(all.rank(2, k)); });
    outcome.findings.push_back(fmt::format("Rank correlation with ϖ over {} points (N, μ): {}.", n,
                                           fmt::join(words, "; ")));
    outcome.findings.push_back(
        fmt::format("Spins of strong contacts predict ϖ {} the slip parameter: |ρ| differs by {}.",
                    better.mean > 2.0 * better.error    ? "better than"
                    : better.mean < -2.0 * better.error ? "worse than"
                                                        : "about as well as",
                    with_error(better.mean, better.error)));
    return outcome;
}

FigurePlan plan_figure_gears(const PaperSettings& settings) {
    FigurePlan plan;
    CurveFigure figure{"gears", {"mu"}, {}};
    for (const auto& [quantity, words] : predictors) figure.measured.emplace_back(quantity);
    for (const double mu : settings.quick ? Values{0.1, 1.0} : Values{0.05, 0.1, 0.3, 1.0, 3.0})
        figure.curves.push_back({"", {mu}, fmt::format("μ = {}", mu)});
    figure.add_points(settings.quick ? std::vector<std::int64_t>{22, 34, 46}
                                     : std::vector<std::int64_t>{16, 22, 28, 34, 40, 46});
    for (const CurveFigure::Point& p : figure.points) {
        const double mu = std::get<double>(figure.curves[p.curve].cells[0]);
        const RunConfig config = mechanism_config(settings, p.discs, mu);
        plan.points.push_back(
            varied_point(settings, fmt::format("gears_mu{}_N{}_{}", mu, p.discs, length_of(config)),
                         config, chapter_seeds(settings), {"slip", "frustration"}));
    }
    plan.finish = [=](const std::vector<Json>& results, const fs::path& out) {
        return finish_gears(figure, results, out);
    };
    return plan;
}

// --- One kind of contact without friction ---------------------------------------------------

struct SmoothContacts {
    Frictionless kind;
    const char *name, *words;
};
constexpr SmoothContacts smooth_contacts[] = {
    {Frictionless::none, "none", "friction everywhere"},
    {Frictionless::wall, "wall", "no friction with the wall"},
    {Frictionless::boundary, "boundary", "no friction between discs at the wall"},
    {Frictionless::bulk, "bulk", "no friction between other discs"}};

FigurePlan plan_figure_contacts(const PaperSettings& settings) {
    FigurePlan plan;
    CurveFigure figure{"contacts", {"frictionless"}, {}};
    for (const auto& [kind, name, words] : smooth_contacts)
        figure.curves.push_back({name, {std::string(name)}, words});
    figure.add_points(settings.quick
                          ? std::vector<std::int64_t>{20, 36, 48}
                          : std::vector<std::int64_t>{12, 20, 28, 32, 36, 40, 44, 48, 52});
    for (const CurveFigure::Point& p : figure.points) {
        RunConfig config = mechanism_config(settings, p.discs, 1.0);
        config.frictionless = smooth_contacts[p.curve].kind;
        if (config.frictionless == Frictionless::wall) config.mu_wall = 0.0;
        plan.points.push_back(
            varied_point(settings,
                         fmt::format("contacts_{}_N{}_{}", smooth_contacts[p.curve].name, p.discs,
                                     length_of(config)),
                         config, chapter_seeds(settings)));
    }
    plan.finish = [=](const std::vector<Json>& results, const fs::path& out) {
        FigureOutcome outcome;
        figure.write_points(results, out, outcome);
        const std::vector<NamedCurve> curves = figure.named_curves(results);
        for (std::size_t c = 0; c < curves.size(); ++c) {
            const CoarseZero zero = last_zero(curves[c].points());
            const RotationPoint* const lowest = lowest_of(curves[c].points());
            outcome.findings.push_back(
                fmt::format("{}: {}; lowest ϖ/Ω = {} at N = {}.", figure.curves[c].words,
                            zero.exists() ? "the direction changes at " + zero_in_words(zero)
                                          : "no certain change of direction",
                            lowest ? with_error(lowest->mean, lowest->error) : "n/a",
                            lowest ? fmt::format("{}", lowest->discs) : "n/a"));
        }
        return outcome;
    };
    return plan;
}

}  // namespace

std::vector<PaperFigure> chapter_mechanism() {
    return {{"torque", "chapter: the torques on the cluster against N", plan_figure_torque},
            {"gears", "chapter: do gears or slip predict the rotation?", plan_figure_gears},
            {"contacts", "chapter: one kind of contact without friction", plan_figure_contacts}};
}

}  // namespace swirl
