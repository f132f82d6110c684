// Without disc friction the cluster begins as a gas and condenses: after a waiting time the discs
// stand still in the M-frame, so that the cluster turns with ϖ = Ω. How long this takes for each
// number of discs, and what the cluster is like before and after.
//
// A cluster counts as condensed from the first period on in which the mean speed of the discs in
// the M-frame is below a tenth of the wall's, ΩR, if it stays there for ten periods (of a gas that
// speed is about ΩR). The paper's run of 10^6 events begins at the start, so it averages over both
// states.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "swirl/paper/figures.hpp"
#include "swirl/paper/points.hpp"
#include "swirl/paper/several_seeds.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/measurements.hpp"
#include "swirl/run/report.hpp"
#include "swirl/statistics/replicates.hpp"

namespace swirl {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

constexpr double little_motion = 0.1;        // of ΩR
constexpr std::int64_t residences_for = 10;  // periods
constexpr std::int64_t periods_after = 50;   // that are averaged, once it has condensed

/// Mean speed of the discs in the M-frame, in ΩR.
double speed_in_the_m_frame(const MFrameView& view) {
    double sum = 0.0;
    for (std::size_t i = 0; i < view.size(); ++i)
        sum += square_root(dot(view.velocity(i), view.velocity(i)));
    return sum / static_cast<double>(view.size()) / (view.frame.omega * view.container_radius);
}

/// Of a run from the start: the period in which it condenses, and the events until then. `found` is
/// false if it has not within the run.
struct Condensed {
    bool found = false;
    std::int64_t period = 0, events = 0;
};

Condensed condensation_of(const RunConfig& config, const RunControl& control) {
    Run run(config, control);
    SampleTimes times = run.sample_times(64);
    Condensed still;
    std::int64_t events = 0, events_before = 0, periods = 0, quiet = 0;
    double speed = 0.0, samples = 0.0;
    while (quiet < residences_for && run.next_event()) {
        while (run.next_sample(times)) {
            speed += speed_in_the_m_frame(run.snapshot());
            samples += 1.0;
        }
        run.pass_event();
        ++events;
        if (run.snapshot().periods == run.event().periods) continue;
        quiet = speed < little_motion * samples ? quiet + 1 : 0;
        if (quiet == 1) still = {false, periods, events_before};
        events_before = events;
        ++periods;
        speed = samples = 0.0;
    }
    if (quiet < residences_for) {
        if (!run.complete()) throw Interrupted("Stopped.");
        return {false, periods, events};
    }
    still.found = true;
    return still;
}

/// Averages over a part of the run, {} if it is too short for them.
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
    const Condensed found = condensation_of(config, control);
    return {
        {"condensed", found.found},
        {"periods", found.period},
        {"events", found.events},
        {"before", averages_of(config, 0, found.period, control)},
        {"after", found.found ? averages_of(config, found.period + residences_for,
                                            found.period + residences_for + periods_after, control)
                              : Json::object()}};
}

struct Quantity {
    const char *column, *group, *name;
};
constexpr Quantity quantities[] = {{"granular", "temperature", "granular"},
                                   {"coordination", "frustration", "coordination"},
                                   {"wall_spin", "frustration", "wall_spin"},
                                   {"spin_correlation", "frustration", "spin_correlation"},
                                   {"by_time", "rotation", "by_time"}};

Estimate over_seeds(const std::vector<Json>& runs, const char* phase, const Quantity& quantity) {
    // A transient has no error of its own: its blocks are not alike. Between seeds it has one.
    std::vector<Estimate> found;
    for (const Json& run : runs)
        found.push_back({.mean = number(at(run, {phase, quantity.group, quantity.name, "mean"}))});
    return ensemble(found).estimate;
}

/// The row of one number of discs, and the sentence on it.
std::vector<Table::Cell> row_of(std::int64_t discs, const std::vector<Json>& runs,
                                std::string& sentence) {
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
        for (const Quantity& quantity : quantities) {
            const Estimate e = over_seeds(runs, phase, quantity);
            row.emplace_back(e.mean);
            row.emplace_back(e.error);
        }
    sentence = condensed == 0
                   ? fmt::format("μ_d = 0, N = {}: none of {} runs condenses within {} periods.",
                                 discs, runs.size(), longest)
                   : fmt::format(
                         "μ_d = 0, N = {}: {} of {} runs condense, after {} periods ({} to "
                         "{}).",
                         discs, condensed, runs.size(), with_error(mean.mean, mean.error), shortest,
                         longest);
    return row;
}

}  // namespace

static FigurePlan plan_figure_condensation(const PaperSettings& settings) {
    FigurePlan plan;
    plan.script = "figure_condensation.py";
    const std::vector<std::int64_t> numbers =
        settings.quick ? std::vector<std::int64_t>{rotating, counterrotating}
                       : std::vector<std::int64_t>{16, 20, 24, 28, 32, 36, 40, 44, 48};
    const std::int64_t periods = settings.periods(settings.quick ? 200 : 400, 20);
    const int seeds = settings.seeds();
    for (const std::int64_t n : numbers)
        for (int s = 0; s < seeds; ++s) {
            RunConfig config = paper_config(settings, no_disc_friction, n);
            config.periods = periods;
            config.warmup = 0;
            config.seed += static_cast<std::uint64_t>(s);
            plan.points.push_back(PaperTask{
                fmt::format("condensation_N{}_{}periods_seed{}", n, periods, config.seed),
                expected_events_per_swirl(config) * 200.0,
                [config](const RunControl& control) { return condensation(config, control); }});
        }
    plan.finish = [numbers, seeds](const std::vector<Json>& results, const fs::path& out) {
        std::vector<std::string> columns{"discs",         "seeds",    "condensed", "waiting",
                                         "waiting_error", "shortest", "longest",   "events"};
        for (const char* phase : {"before", "after"})
            for (const Quantity& quantity : quantities)
                for (const char* ending : {"", "_error"})
                    columns.push_back(fmt::format("{}_{}{}", phase, quantity.column, ending));
        Table table(columns);
        FigureOutcome outcome;
        for (std::size_t k = 0; k < numbers.size(); ++k) {
            std::vector<Json> runs;
            for (int s = 0; s < seeds; ++s)
                if (const Json& run = results[k * std::size_t(seeds) + std::size_t(s)];
                    !failed(run))
                    runs.push_back(run);
            if (runs.empty()) continue;
            outcome.findings.emplace_back();
            table.add(row_of(numbers[k], runs, outcome.findings.back()));
        }
        outcome.files.push_back(out / "figure_condensation.csv");
        table.write(outcome.files.back());
        return outcome;
    };
    return plan;
}

std::vector<PaperFigure> figures_of_condensation() {
    return {{"condensation", "beyond the paper: without disc friction a gas condenses, μ_d = 0",
             plan_figure_condensation}};
}

}  // namespace swirl
