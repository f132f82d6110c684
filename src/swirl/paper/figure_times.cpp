// The smallest times between collisions, with friction and without. The paper: "The minimal time
// between collisions is around 10^-11 and 10^-9 with and without friction, respectively" (SI,
// "Finding the next event").
#include <fmt/format.h>

#include <algorithm>

#include "swirl/io/table.hpp"
#include "swirl/paper/figures.hpp"
#include "swirl/paper/points.hpp"
#include "swirl/run/failure.hpp"

namespace swirl {
namespace {

using Json = nlohmann::ordered_json;

/// Between one collision and the next, anywhere in the dish.
Json smallest_time(const RunConfig& config, const RunControl& control) {
    Run run(config, control);
    double last = 0.0, smallest = never;
    std::int64_t periods = -1;  // of the last collision; none yet
    while (run.next_event()) {
        const Event& event = run.event();
        if (event.kind == EventKind::disc_disc || event.kind == EventKind::disc_wall) {
            // Across the beginning of a swirl clocks are not compared: it is one in thousands.
            if (event.periods == periods && event.clock > last)
                smallest = std::min(smallest, event.clock - last);
            last = event.clock;
            periods = event.periods;
        }
        run.pass_event();
    }
    if (!run.complete()) throw Interrupted("Stopped.");
    return {{"events", config.events}, {"smallest", smallest}};
}

}  // namespace

static FigurePlan plan_figure_times(const PaperSettings& settings) {
    FigurePlan plan;
    const std::vector<double> friction_coefficients{1.0, 0.0};
    for (const double mu : friction_coefficients)
        for (int s = 0; s < settings.seeds(); ++s) {
            RunConfig config = paper_config(settings, {"", "", mu, mu}, counterrotating);
            config.seed += static_cast<std::uint64_t>(s);
            plan.points.push_back(PaperTask{
                fmt::format("times_mu{}_{}events_seed{}", mu, config.events, config.seed),
                static_cast<double>(config.events),
                [config](const RunControl& control) { return smallest_time(config, control); }});
        }
    plan.finish = [friction_coefficients, seeds = settings.seeds()](
                      const std::vector<Json>& results, const std::filesystem::path& out) {
        Table table({"mu", "discs", "seed", "events", "smallest"});
        FigureOutcome outcome;
        for (std::size_t m = 0; m < friction_coefficients.size(); ++m) {
            std::vector<double> found;
            for (int s = 0; s < seeds; ++s) {
                const Json& r = results[m * std::size_t(seeds) + std::size_t(s)];
                if (failed(r)) continue;
                found.push_back(number(r["smallest"]));
                table.add({friction_coefficients[m], counterrotating, std::int64_t{s + 1},
                           whole(r["events"]), found.back()});
            }
            std::sort(found.begin(), found.end());
            if (!found.empty())
                outcome.findings.push_back(fmt::format(
                    "μ = {}, N = {}: the smallest time between two collisions of a run lies "
                    "between {:.1g} and {:.1g}.",
                    friction_coefficients[m], counterrotating, found.front(), found.back()));
        }
        outcome.files.push_back(out / "figure_times.csv");
        table.write(outcome.files.back());
        return outcome;
    };
    return plan;
}

std::vector<PaperFigure> figures_of_times() {
    return {{"times", "the smallest times between collisions", plan_figure_times}};
}

}  // namespace swirl
