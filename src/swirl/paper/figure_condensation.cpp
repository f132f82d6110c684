// Without disc friction the cluster starts as a gas and condenses: after a waiting time the discs
// are at rest in the M-frame, so that the cluster rotates with ϖ = Ω. Measured are the waiting time
// against the number of discs, and the cluster before and after.
//
// The cluster counts as condensed from the first period in which the mean speed of the discs in the
// M-frame is below a tenth of the wall's, ΩR, if it stays there for ten periods (in a gas that
// speed is about ΩR). The paper's run of 10^6 events begins at the start, so it averages over both
// states.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "swirl/paper/figures.hpp"
#include "swirl/paper/points.hpp"
#include "swirl/paper/results.hpp"
#include "swirl/paper/seed_ensemble.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/measurements.hpp"
#include "swirl/run/report.hpp"
#include "swirl/statistics/replicates.hpp"

namespace swirl {
namespace {

constexpr double little_motion = 0.1;       // of ΩR
constexpr std::int64_t quiet_periods = 10;  // with little motion, until it counts as condensed
constexpr std::int64_t periods_after = 50;  // averaged after the condensation
constexpr double expected_periods = 200.0;  // until the condensation, for the cost of a task

/// Mean speed of the discs in the M-frame, in ΩR.
double speed_in_the_m_frame(const MFrameView& view) {
    double sum = 0.0;
    for (std::size_t i = 0; i < view.size(); ++i)
        sum += square_root(dot(view.velocity(i), view.velocity(i)));
    return sum / static_cast<double>(view.size()) / (view.frame.omega * view.container_radius);
}

/// The period in which the cluster condenses, and the events until then. If it does not condense,
/// the length of the run.
struct Condensed {
    bool found = false;
    std::int64_t period = 0, events = 0;
};

Condensed find_condensation(const RunConfig& config, const RunControl& control) {
    Run run(config, control);
    SampleTimes times = run.sample_times(64);
    Condensed condensed;
    std::int64_t events = 0, events_before = 0, periods = 0, quiet = 0;
    double speed = 0.0, samples = 0.0;
    while (quiet < quiet_periods && run.next_event()) {
        while (run.next_sample(times)) {
            speed += speed_in_the_m_frame(run.snapshot());
            samples += 1.0;
        }
        run.pass_event();
        ++events;
        if (run.snapshot().periods == run.event().periods) continue;
        quiet = speed < little_motion * samples ? quiet + 1 : 0;
        if (quiet == 1) condensed = {false, periods, events_before};
        events_before = events;
        ++periods;
        speed = samples = 0.0;
    }
    if (quiet < quiet_periods) {
        if (!run.complete()) throw Interrupted("Stopped.");
        return {false, periods, events};
    }
    condensed.found = true;
    return condensed;
}

/// Averages over a part of the run, or {} if it is too short.
Json averages_of(RunConfig config, std::int64_t from, std::int64_t to, const RunControl& control) {
    if (to - from < min_periods_of_an_average) return Json::object();
    config.warmup = from;
    config.periods = to;
    const MeasuredRun done = measured_run(config, {"temperature", "frustration"}, control);
    if (!done.run.complete) throw Interrupted("Stopped.");
    Json json = done.measured;
    json["rotation"] = result_json(done.run)["rotation"];
    return json;
}

Json condensation(const RunConfig& config, const RunControl& control) {
    const Condensed condensed = find_condensation(config, control);
    const std::int64_t after = condensed.period + quiet_periods;
    return {{"condensed", condensed.found},
            {"periods", condensed.period},
            {"events", condensed.events},
            {"before", averages_of(config, 0, condensed.period, control)},
            {"after", condensed.found ? averages_of(config, after, after + periods_after, control)
                                      : Json::object()}};
}

struct PhaseAverage {
    const char *column, *group, *name;
};
constexpr PhaseAverage phase_averages[] = {{"granular", "temperature", "granular"},
                                           {"coordination", "frustration", "coordination"},
                                           {"wall_spin", "frustration", "wall_spin"},
                                           {"spin_correlation", "frustration", "spin_correlation"},
                                           {"by_time", "rotation", "by_time"}};

/// A transient has no error within a run, since its blocks differ systematically. The error is that
/// between seeds.
Estimate over_seeds(const std::vector<Json>& runs, const char* phase,
                    const PhaseAverage& quantity) {
    std::vector<Estimate> found;
    for (const Json& run : runs)
        found.push_back({.mean = number(at(run, {phase, quantity.group, quantity.name, "mean"}))});
    return ensemble(found).estimate;
}

/// Adds the row of one number of discs, and the finding about it.
void add_row(Table& table, std::vector<std::string>& findings, std::int64_t discs,
             const std::vector<Json>& runs) {
    std::vector<Estimate> waiting;
    std::int64_t condensed = 0, shortest = 0, longest = 0;
    double events = 0.0;
    for (const Json& run : runs) {
        const auto periods = run["periods"].get<std::int64_t>();
        longest = std::max(longest, periods);
        if (run["condensed"] != true) continue;
        shortest = condensed++ == 0 ? periods : std::min(shortest, periods);
        waiting.push_back({.mean = static_cast<double>(periods)});
        events += number(run["events"]);
    }
    const Estimate mean = ensemble(waiting).estimate;
    std::vector<Table::Cell> row{
        discs,      static_cast<std::int64_t>(runs.size()),
        condensed,  mean.mean,
        mean.error, shortest,
        longest,    condensed > 0 ? events / static_cast<double>(condensed) : not_available};
    for (const char* phase : {"before", "after"})
        for (const PhaseAverage& quantity : phase_averages)
            add_estimate(row, over_seeds(runs, phase, quantity));
    table.add(std::move(row));
    findings.push_back(
        condensed == 0
            ? fmt::format("μ_d = 0, N = {}: none of {} runs condenses within {} periods.", discs,
                          runs.size(), longest)
            : fmt::format("μ_d = 0, N = {}: {} of {} runs condense, after {} periods ({} to {}).",
                          discs, condensed, runs.size(), with_error(mean.mean, mean.error),
                          shortest, longest));
}

}  // namespace

static FigurePlan plan_figure_condensation(const PaperSettings& settings) {
    FigurePlan plan;
    std::vector<std::int64_t> numbers{rotating_n, counterrotating_n};
    if (!settings.quick) numbers = {16, 20, 24, 28, 32, 36, 40, 44, 48};
    const std::int64_t periods = settings.periods(400, 20);
    const int seeds = settings.seeds();
    for (const std::int64_t n : numbers) {
        RunConfig config = paper_config(settings, no_disc_friction, n);
        config.periods = periods;
        config.warmup = 0;
        add_seeds(plan, config, seeds, fmt::format("condensation_N{}_{}periods", n, periods),
                  expected_events_per_period(config) * expected_periods, condensation);
    }
    plan.finish = [numbers, seeds](const std::vector<Json>& results, const fs::path& out) {
        std::vector<std::string> columns{"discs",         "seeds",    "condensed", "waiting",
                                         "waiting_error", "shortest", "longest",   "events"};
        for (const char* phase : {"before", "after"})
            for (const PhaseAverage& quantity : phase_averages)
                for (const char* ending : {"", "_error"})
                    columns.push_back(fmt::format("{}_{}{}", phase, quantity.column, ending));
        Table table(columns);
        FigureOutcome outcome;
        for (std::size_t k = 0; k < numbers.size(); ++k)
            if (const std::vector<Json> runs = results_of_seeds(results, k, seeds); !runs.empty())
                add_row(table, outcome.findings, numbers[k], runs);
        outcome.write(table, "condensation", out);
        return outcome;
    };
    return plan;
}

std::vector<PaperFigure> figures_of_condensation() {
    return {{"condensation", "beyond the paper: without disc friction a gas condenses, μ_d = 0",
             plan_figure_condensation}};
}

}  // namespace swirl
