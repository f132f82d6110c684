// Is the change of direction a critical phenomenon? The paper leaves it open.
//
// Figure "critical". At each change of direction of a dish: the slope dϖ/dφ, the fluctuations,
// their correlation time and the Binder cumulant, against the size R/r of the dish. In a critical
// transition slope, fluctuations and correlation time grow with powers of the size. In a transition
// of first order two states coexist, so that the cumulant tends to 2/3. In a crossover none of this
// happens. The figure has two amplitudes: the paper's A/R = 0.22, and A/R = 0.4, where the same
// change exists in dishes of all sizes.
//
// Figure "hysteresis". Ramps of a parameter through a change of direction and back.
//
// Figure "lifetimes". How long the two states last at points where runs end in different states.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "swirl/paper/chapter_runs.hpp"
#include "swirl/paper/chapters.hpp"
#include "swirl/paper/points.hpp"
#include "swirl/paper/results.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/parameters.hpp"
#include "swirl/run/period_series.hpp"
#include "swirl/run/ramp.hpp"
#include "swirl/run/report.hpp"
#include "swirl/statistics/power_law.hpp"

namespace swirl {
namespace {

// --- Scaling with the size ------------------------------------------------------------------

constexpr double large_amplitude = 0.4;  // A/R

/// A quantity at a change, and what a critical transition does with it.
struct ScaledQuantity {
    const char *name, *words;
    /// Used for the verdict. Fluctuations are not: they grow with the size at every φ.
    bool decides;
    Estimate (*of)(const DirectionChange&);
};
constexpr ScaledQuantity scaled_quantities[] = {
    {"slope", "slope", true,
     [](const DirectionChange& c) {
         return Estimate{.mean = std::fabs(c.slope), .error = c.slope_error};
     }},
    {"susceptibility", "N var τ", false, [](const DirectionChange& c) { return c.susceptibility; }},
    {"correlation", "correlation time", true,
     [](const DirectionChange& c) { return c.correlation; }}};

/// Changes of one kind at one relative amplitude, in dishes of different sizes.
struct Transition {
    std::string kind;
    double amplitude;
    std::vector<DirectionChange> changes = {};

    std::string words() const { return fmt::format("A/R = {}, {}", amplitude, kind); }
};

std::vector<Transition> transitions_of(const std::vector<DirectionChange>& changes) {
    std::vector<Transition> found;
    for (const DirectionChange& change : changes) {
        const auto same = [&](const Transition& t) {
            return t.kind == kind_of(change) && t.amplitude == change.dish.amplitude;
        };
        auto known = std::find_if(found.begin(), found.end(), same);
        if (known == found.end())
            known = found.insert(found.end(), {kind_of(change), change.dish.amplitude});
        known->changes.push_back(change);
    }
    return found;
}

PowerLaw scaling_of(const Transition& transition, const ScaledQuantity& quantity) {
    std::vector<PowerLawPoint> points;
    for (const DirectionChange& change : transition.changes) {
        const Estimate value = quantity.of(change);
        points.push_back({change.dish.radius, value.mean, value.error});
    }
    return fit_power_law(points);
}

/// The largest Binder cumulant at the changes.
Estimate largest_binder(const Transition& transition) {
    Estimate largest;
    for (const DirectionChange& change : transition.changes)
        if (!(change.binder.mean <= largest.mean)) largest = change.binder;
    return largest;
}

/// The verdict by the cumulant and by the exponents of slope and correlation time.
std::string verdict_on(const Transition& transition) {
    constexpr double two_states = 1.0 / 3.0;  // half of the cumulant of two equal states
    const Estimate binder = largest_binder(transition);
    if (binder.mean - certain_sign * binder.error > two_states) return "first order";
    bool known = false, grows = true, none_grows = true;
    for (const ScaledQuantity& quantity : scaled_quantities) {
        const PowerLaw law = scaling_of(transition, quantity);
        if (!quantity.decides) continue;
        if (!std::isfinite(law.exponent) || !std::isfinite(law.error)) continue;
        known = true;
        const bool certainly = law.exponent > certain_sign * law.error;
        grows = grows && certainly;
        none_grows = none_grows && !certainly;
    }
    if (!known) return "too few sizes to tell";
    return grows ? "critical" : none_grows ? "crossover" : "undecided";
}

std::string sentence_on(const Transition& transition) {
    std::vector<std::string> laws;
    for (const ScaledQuantity& quantity : scaled_quantities) {
        const PowerLaw law = scaling_of(transition, quantity);
        laws.push_back(fmt::format("{} {}", quantity.words, with_error(law.exponent, law.error)));
    }
    const Estimate binder = largest_binder(transition);
    return fmt::format("{} ({} sizes): {}; exponents of R/r: {}; largest Binder cumulant {}.",
                       transition.words(), transition.changes.size(), verdict_on(transition),
                       fmt::join(laws, ", "), with_error(binder.mean, binder.error));
}

Table scaling_table(const std::vector<Transition>& transitions) {
    Table table({"amplitude_ratio", "kind", "quantity", "exponent", "exponent_error", "factor",
                 "chi_square", "sizes", "verdict"});
    for (const Transition& transition : transitions)
        for (const ScaledQuantity& quantity : scaled_quantities) {
            const PowerLaw law = scaling_of(transition, quantity);
            table.add({transition.amplitude, transition.kind, std::string(quantity.name),
                       law.exponent, law.error, law.factor, law.chi_square,
                       std::int64_t(law.points), verdict_on(transition)});
        }
    return table;
}

}  // namespace

static FigurePlan plan_figure_critical(const PaperSettings& settings) {
    FigurePlan plan;
    DishPoints points = dishes_of_sizes(settings);
    std::vector<double> radii{8.6, 12.0};
    if (!settings.quick) radii = {6.0, 8.6, 12.0, 17.2, 24.0};
    for (const double radius : radii)
        for (const double fraction : {0.46, 0.49}) points.add({radius, large_amplitude}, fraction);
    points.plan(plan, settings);
    plan.finish = [points](const std::vector<Json>& results, const fs::path& out) {
        FigureOutcome outcome;
        outcome.write(points.table(results), "critical", out);
        const std::vector<DirectionChange> changes = direction_changes(points, results);
        outcome.write(change_table(changes), "critical_changes", out);
        const std::vector<Transition> transitions = transitions_of(changes);
        outcome.write(scaling_table(transitions), "critical_scaling", out);
        for (const Transition& transition : transitions)
            outcome.findings.push_back(sentence_on(transition));
        return outcome;
    };
    return plan;
}

// --- Hysteresis -----------------------------------------------------------------------------

namespace {

constexpr int bins = 8;  // of the parameter, on each branch
/// A difference is certain beyond this many errors. Three are not enough, because the largest of
/// several bins is tested.
constexpr double certain_difference = 4.0;

/// A loop of a parameter in a dish.
struct Loop {
    const char *name, *words;
    Dish dish;
    double packing_fraction;
    const char* parameter;  // of a ramp
    double from, to;        // of the parameter; the amplitude in units of R
};
constexpr Loop loops[] = {
    {"cluster", "cluster, R/r = 8.6", {8.6, 0.22}, 0.568, "mu", 0.3, 1.5},
    {"gas", "gas, R/r = 17.2", {17.2, 0.22}, 0.25, "amplitude", 0.12, 0.4},
    {"elongated", "elongated cluster, R/r = 34.4", {34.4, 0.22}, 0.32, "amplitude", 0.17, 0.27}};

RunConfig loop_config(const PaperSettings& settings, const Loop& loop, std::int64_t branch) {
    const double unit = std::string_view(loop.parameter) == "amplitude" ? loop.dish.radius : 1.0;
    constexpr std::int64_t warmup = 30;
    RunConfig config = dish_config(settings, loop.dish, loop.dish.discs(loop.packing_fraction));
    config.ramps =
        read_ramps(fmt::format("{}={}:{}:{}@{}..{}", loop.parameter, unit * loop.from,
                               unit * loop.to, unit * loop.from, warmup, warmup + 2 * branch));
    config.periods = warmup + 2 * branch;
    config.warmup = warmup;
    return config;
}

/// Means of the rotation in bins of the parameter, upwards and downwards in its order.
Json loop_run(const RunConfig& config, const RunControl& control) {
    PeriodSeries series(config, {});
    run_with_series(config, control, series);
    const std::vector<double> rates = series.counted("rigid_by_time");
    std::vector<double> sums(2 * bins), counts(2 * bins);
    for (std::size_t p = 0; p < rates.size(); ++p) {
        const std::size_t bin = p * 2 * bins / rates.size();
        sums[bin] += rates[p];
        counts[bin] += 1.0;
    }
    for (std::size_t k = 0; k < sums.size(); ++k) sums[k] /= counts[k];
    return {{"up", std::vector<double>(sums.begin(), sums.begin() + bins)},
            {"down", std::vector<double>(sums.rbegin(), sums.rbegin() + bins)}};
}

std::vector<std::int64_t> branches(const PaperSettings& settings) {
    if (settings.quick) return {settings.periods(80, bins)};
    return {settings.periods(80, bins), settings.periods(160, bins)};
}

}  // namespace

static FigurePlan plan_figure_hysteresis(const PaperSettings& settings) {
    FigurePlan plan;
    const int seeds = chapter_seeds(settings);
    for (const Loop& loop : loops)
        for (const std::int64_t branch : branches(settings)) {
            const RunConfig config = loop_config(settings, loop, branch);
            add_seeds(plan, config, seeds, fmt::format("loop_{}_{}periods", loop.name, branch),
                      expected_events_per_period(config) * double(*config.periods), loop_run);
        }
    plan.finish = [=, lengths = branches(settings)](const std::vector<Json>& results,
                                                    const fs::path& out) {
        Table table({"loop", "parameter", "value", "periods", "seeds", "up", "up_error", "down",
                     "down_error", "difference", "difference_error"});
        FigureOutcome outcome;
        std::size_t k = 0;
        for (const Loop& loop : loops) {
            std::vector<std::string> words;
            bool remains = false;
            for (const std::int64_t branch : lengths) {
                const std::vector<Json> runs = results_of_seeds(results, k++, seeds);
                if (runs.empty()) continue;
                Estimate largest;
                for (int bin = 0; bin < bins; ++bin) {
                    const double value =
                        loop.from + (loop.to - loop.from) * (bin + 0.5) / double(bins);
                    const auto of = [bin](const Json& run, const char* which) {
                        return run[which][std::size_t(bin)].get<double>();
                    };
                    const Estimate up = over_runs(runs, [&](auto&r) { return of(r, "up"); }),
                                   down = over_runs(runs, [&](auto&r) { return of(r, "down"); });
                    // The difference within each run is more precise than that of the two means, if
                    // both branches vary with the seed.
                    const Estimate difference =
                        over_runs(runs, [&](auto& r) { return of(r, "down") - of(r, "up"); });
                    table.add({std::string(loop.words), std::string(loop.parameter), value, branch,
                               std::int64_t(runs.size()), up.mean, up.error, down.mean, down.error,
                               difference.mean, difference.error});
                    if (!(std::fabs(difference.mean / difference.error) <=
                          std::fabs(largest.mean / largest.error)))
                        largest = difference;
                }
                words.push_back(fmt::format("{} with {} periods for each branch",
                                            with_error(largest.mean, largest.error), branch));
                // Ramps become slower, so the last value is that of the slowest ramp.
                remains = std::fabs(largest.mean) > certain_difference * largest.error;
            }
            outcome.findings.push_back(
                fmt::format("{}, ramp of {}: most certain difference of the branches, down minus "
                            "up, in ϖ/Ω: {}; {} at the slowest ramp.",
                            loop.words, loop.parameter, fmt::join(words, "; "),
                            remains ? "hysteresis" : "no certain hysteresis"));
        }
        outcome.write(table, "hysteresis", out);
        return outcome;
    };
    return plan;
}

// --- Lifetimes ------------------------------------------------------------------------------

namespace {

/// A point where runs end in different states, which differ in the mean spin. The state counts as
/// the second one if the mean spin over a window is below the threshold, in Ω.
struct TwoStatePoint {
    const char *name, *words, *first, *second;
    std::int64_t discs;
    double mu, threshold;
    std::int64_t periods;
};
constexpr std::int64_t window = 20;  // periods
constexpr TwoStatePoint two_state_points[] = {
    {"few", "N = 5, μ = 0.1", "gas", "row that rolls along the wall", 5, 0.1, -5.0, 10'000},
    {"dense", "N = 52, μ = 1", "crystal", "rings", 52, 1.0, -0.065, 600}};

/// Periods and exits of both states, and ϖ in each.
Json visits_of(const RunConfig& config, const RunControl& control, double threshold) {
    PeriodSeries series(config, {});
    run_with_series(config, control, series);
    const std::vector<double> spins = series.counted("spin"),
                              rates = series.counted("rigid_by_time");
    double periods[2] = {}, exits[2] = {}, sums[2] = {};
    int last = -1;
    for (std::size_t begin = 0; begin + window <= spins.size(); begin += window) {
        double spin = 0.0, rate = 0.0;
        for (std::size_t p = begin; p < begin + window; ++p) {
            spin += spins[p] / double(window);
            rate += rates[p];
        }
        const int state = spin < threshold ? 1 : 0;
        if (last >= 0 && state != last) exits[last] += 1.0;
        last = state;
        periods[state] += double(window);
        sums[state] += rate;
    }
    return {{"periods", periods}, {"exits", exits}, {"sums", sums}};
}
Json visits_of_few(const RunConfig& config, const RunControl& control) {
    return visits_of(config, control, two_state_points[0].threshold);
}
Json visits_of_dense(const RunConfig& config, const RunControl& control) {
    return visits_of(config, control, two_state_points[1].threshold);
}

/// The mean lifetime of a state with an exponential distribution: the time in the state over the
/// number of exits, because the end of a run may cut a visit short. Without an exit, `periods` is
/// the lower bound of 95 %, time / 3, and there is no error.
struct Lifetime {
    double periods, error;
    std::int64_t exits;

    std::string words() const {
        return exits > 0 ? with_error(periods, error) + " periods"
                         : fmt::format("more than {:.0f} periods", periods);
    }
};
Lifetime lifetime_of(double periods, double exits) {
    if (exits == 0.0) return {periods / 3.0, not_available, 0};
    return {periods / exits, periods / exits / std::sqrt(exits), std::int64_t(exits)};
}

}  // namespace

static FigurePlan plan_figure_lifetimes(const PaperSettings& settings) {
    FigurePlan plan;
    const int seeds = chapter_seeds(settings);
    for (const TwoStatePoint& p : two_state_points) {
        RunConfig config = paper_config(settings, {"", "", p.mu, p.mu}, p.discs);
        config.periods = settings.periods(p.periods, 2 * window);
        config.warmup = 0;
        add_seeds(plan, config, seeds,
                  fmt::format("lifetimes_{}_{}periods", p.name, *config.periods),
                  expected_events_per_period(config) * double(*config.periods),
                  p.discs == two_state_points[0].discs ? visits_of_few : visits_of_dense);
    }
    plan.finish = [=](const std::vector<Json>& results, const fs::path& out) {
        Table table({"point", "discs", "mu", "state", "periods", "exits", "lifetime",
                     "lifetime_error", "rotation", "seeds"});
        FigureOutcome outcome;
        std::size_t k = 0;
        for (const TwoStatePoint& p : two_state_points) {
            const std::vector<Json> runs = results_of_seeds(results, k++, seeds);
            std::vector<std::string> words;
            for (const std::size_t state : {0u, 1u}) {
                double periods = 0.0, exits = 0.0, sum = 0.0;
                for (const Json& run : runs) {
                    periods += run["periods"][state].get<double>();
                    exits += run["exits"][state].get<double>();
                    sum += run["sums"][state].get<double>();
                }
                const Lifetime lifetime = lifetime_of(periods, exits);
                const std::string name = state == 0 ? p.first : p.second;
                table.add({std::string(p.words), p.discs, p.mu, name, periods, lifetime.exits,
                           lifetime.periods, lifetime.error, sum / periods,
                           std::int64_t(runs.size())});
                words.push_back(periods > 0.0 ? fmt::format("{}: {}, ϖ/Ω = {:.3f}", name,
                                                            lifetime.words(), sum / periods)
                                              : fmt::format("{}: not visited", name));
            }
            outcome.findings.push_back(
                fmt::format("{}: lifetime of the state {}.", p.words, fmt::join(words, "; ")));
        }
        outcome.write(table, "lifetimes", out);
        return outcome;
    };
    return plan;
}

std::vector<PaperFigure> chapter_critical() {
    return {{"critical", "chapter: is the change of direction a critical phenomenon?",
             plan_figure_critical},
            {"hysteresis", "chapter: ramps through a change of direction and back",
             plan_figure_hysteresis},
            {"lifetimes", "chapter: how long coexisting states last", plan_figure_lifetimes}};
}

}  // namespace swirl
