// The shortest times between collisions, with and without friction. The paper: "The minimal time
// between collisions is around 10^-11 and 10^-9 with and without friction, respectively" (SI,
// "Finding the next event").
#include <fmt/format.h>

#include <algorithm>

#include "swirl/paper/figures.hpp"
#include "swirl/paper/points.hpp"
#include "swirl/paper/results.hpp"
#include "swirl/run/failure.hpp"

namespace swirl {

/// Between two consecutive collisions, anywhere in the container.
static Json shortest_time(const RunConfig& config, const RunControl& control) {
    Run run(config, control);
    double last = 0.0, shortest = never;
    std::int64_t periods = -1;  // of the last collision; -1: none yet
    while (run.next_event()) {
        const Event& event = run.event();
        if (event.kind == EventKind::disc_disc || event.kind == EventKind::disc_wall) {
            // Clocks restart with each period. One pair in thousands spans two periods; it is
            // skipped.
            if (event.periods == periods && event.clock > last)
                shortest = std::min(shortest, event.clock - last);
            last = event.clock;
            periods = event.periods;
        }
        run.pass_event();
    }
    if (!run.complete()) throw Interrupted("Stopped.");
    return {{"events", config.events}, {"smallest", shortest}};
}

static FigurePlan plan_figure_times(const PaperSettings& settings) {
    FigurePlan plan;
    plan.is_drawn = false;  // a table only
    const std::vector<double> coefficients{1.0, 0.0};
    const int seeds = settings.seeds();
    for (const double mu : coefficients) {
        const RunConfig config = paper_config(settings, {"", "", mu, mu}, counterrotating_n);
        add_seeds(plan, config, seeds, fmt::format("times_mu{}_{}", mu, length_of(config)),
                  static_cast<double>(config.events), shortest_time);
    }
    plan.finish = [=](const std::vector<Json>& results, const fs::path& out) {
        Table table({"mu", "discs", "seed", "events", "smallest"});
        FigureOutcome outcome;
        for (std::size_t m = 0; m < coefficients.size(); ++m) {
            std::vector<double> found;
            for (int s = 0; s < seeds; ++s) {
                const Json& r = results[m * std::size_t(seeds) + std::size_t(s)];
                if (failed(r)) continue;
                found.push_back(number(r["smallest"]));
                table.add({coefficients[m], counterrotating_n, std::int64_t{s + 1},
                           whole(r["events"]), found.back()});
            }
            if (found.empty()) continue;
            const auto [lowest, highest] = std::minmax_element(found.begin(), found.end());
            outcome.findings.push_back(fmt::format(
                "μ = {}, N = {}: the shortest time between two collisions of a run lies between "
                "{:.1g} and {:.1g}.",
                coefficients[m], counterrotating_n, *lowest, *highest));
        }
        outcome.write(table, "times", out);
        return outcome;
    };
    return plan;
}

std::vector<PaperFigure> figures_of_times() {
    return {{"times", "the shortest times between collisions", plan_figure_times}};
}

}  // namespace swirl
