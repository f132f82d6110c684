// Figures beyond the paper against time: rotation and spin from rest without disc friction, and the
// energy without any friction.
#include <fmt/format.h>

#include <cmath>

#include "swirl/measure/cluster_rotation.hpp"
#include "swirl/paper/figures.hpp"
#include "swirl/paper/points.hpp"
#include "swirl/paper/results.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/report.hpp"

namespace swirl {

// --- The transient without disc friction ----------------------------------------------------

namespace {

constexpr int seeds_of_the_transient = 4;
constexpr double events_of_the_paper = 1e6;

/// For each period of a run that starts from rest: ϖ/Ω, mean spin/Ω, and the number of events up to
/// the end of the period.
Json transient(const RunConfig& config, const RunControl& control) {
    Json json{{"varpi", Json::array()}, {"spin", Json::array()}, {"events", Json::array()}};
    Run run(config, control);
    SampleTimes times = run.sample_times(64);
    double rotation = 0.0, spin = 0.0, samples = 0.0, events = 0.0;
    while (run.next_event()) {
        while (run.next_sample(times)) {
            const Snapshot& s = run.snapshot();
            rotation += cluster_rotation(s).individual / config.omega();
            double sum = 0.0;
            for (const double one : s.spin) sum += one;
            spin += sum / static_cast<double>(s.size()) / config.omega();
            samples += 1.0;
        }
        run.pass_event();
        events += 1.0;
        if (run.snapshot().periods == run.event().periods) continue;
        json["varpi"].push_back(rotation / samples);
        json["spin"].push_back(spin / samples);
        json["events"].push_back(events);
        rotation = spin = samples = 0.0;
    }
    if (!run.complete()) throw Interrupted("Stopped.");
    return json;
}

/// Adds a row for each period, with means over the seeds. Returns the finding.
std::string add_transient(Table& table, std::int64_t discs, std::int64_t periods,
                          const std::vector<Json>& runs) {
    double early = 0.0, late = 0.0, spin = 0.0, reached = not_available;
    for (std::int64_t t = 0; t < periods; ++t) {
        std::vector<double> varpi, spins;
        double events = 0.0;
        for (const Json& run : runs) {
            varpi.push_back(number(run["varpi"][std::size_t(t)]));
            spins.push_back(number(run["spin"][std::size_t(t)]));
            events += number(run["events"][std::size_t(t)]);
        }
        events /= static_cast<double>(runs.size());
        const Estimate v = estimate_of(varpi), w = estimate_of(spins);
        table.add({discs, t + 1, v.mean, v.error, w.mean, w.error, events});
        if (t < periods / 10) early += v.mean / static_cast<double>(periods / 10);
        if (t >= periods / 2) late += v.mean / static_cast<double>(periods - periods / 2);
        if (t + 1 == periods) spin = w.mean;
        if (std::isnan(reached) && events >= events_of_the_paper)
            reached = static_cast<double>(t + 1);
    }
    return fmt::format(
        "μ_d = 0, N = {}: ϖ/Ω = {:.3f} in the first {} periods, {:.4f} in the last {}, with a mean "
        "spin of {} Ω at the end; 10^6 events last {} periods.",
        discs, early, periods / 10, late, periods - periods / 2, with_error(spin, not_available),
        std::isnan(reached) ? fmt::format("more than {}", periods)
                            : fmt::format("{:.0f}", reached));
}

}  // namespace

static FigurePlan plan_figure_transient(const PaperSettings& settings) {
    FigurePlan plan;
    std::vector<std::int64_t> numbers{48};
    if (!settings.quick) numbers = {40, 44, 46, 48};
    const std::int64_t periods = settings.periods(600, 20);
    for (const std::int64_t n : numbers) {
        RunConfig config = paper_config(settings, no_disc_friction, n);
        config.periods = periods;
        config.warmup = 0;
        add_seeds(plan, config, seeds_of_the_transient,
                  fmt::format("transient_N{}_{}periods", n, periods),
                  expected_events_per_period(config) * static_cast<double>(periods), transient);
    }
    plan.finish = [=](const std::vector<Json>& results, const fs::path& out) {
        Table table({"discs", "period", "varpi", "varpi_error", "spin", "spin_error", "events"});
        FigureOutcome outcome;
        for (std::size_t k = 0; k < numbers.size(); ++k)
            outcome.findings.push_back(add_transient(
                table, numbers[k], periods, results_of_seeds(results, k, seeds_of_the_transient)));
        outcome.write(table, "transient", out);
        return outcome;
    };
    return plan;
}

// --- Energy without any friction ------------------------------------------------------------

namespace {

/// The kinetic energy K, and K − ΩL with the angular momentum L, at the start of every period. On a
/// circle K − ΩL is conserved.
Json energy_series(const RunConfig& config, const RunControl& control) {
    Json json{{"energy", Json::array()}, {"invariant", Json::array()}};
    Run run(config, control);
    SampleTimes times = run.sample_times(1);
    while (run.next_event()) {
        while (run.next_sample(times)) {
            const Snapshot& s = run.snapshot();
            double K = 0.0, L = 0.0;
            for (std::size_t i = 0; i < s.size(); ++i) {
                const Disc d = s.disc(i);
                K += kinetic_energy(d);
                L += d.mass * cross(s.position(i), d.velocity) + d.inertia * d.spin;
            }
            json["energy"].push_back(K);
            json["invariant"].push_back(K - config.omega() * L);
        }
        run.pass_event();
    }
    if (!run.complete()) throw Interrupted("Stopped.");
    return json;
}

}  // namespace

static FigurePlan plan_figure_energy(const PaperSettings& settings) {
    constexpr double cost_factor = 3.0;  // frictionless discs become faster and collide more often
    FigurePlan plan;
    const std::int64_t discs = rotating_n, periods = settings.periods(400, 10);
    const std::vector<int> sides{6, 30, 300, 0};  // 0: the circle
    const int seeds = settings.seeds();
    for (const int m : sides) {
        RunConfig config = paper_config(settings, {"", "", 0.0, 0.0}, discs);
        config.periods = periods;
        config.warmup = 0;
        set_sides(config, m);
        add_seeds(plan, config, seeds, fmt::format("energy_M{}_N{}_{}periods", m, discs, periods),
                  cost_factor * expected_events_per_period(config) * static_cast<double>(periods),
                  energy_series);
    }
    plan.finish = [=](const std::vector<Json>& results, const fs::path& out) {
        Table table({"sides", "discs", "seed", "period", "energy", "invariant"});
        FigureOutcome outcome;
        for (std::size_t k = 0; k < results.size(); ++k) {
            if (failed(results[k])) continue;
            const int m = sides[k / std::size_t(seeds)];
            const auto seed = static_cast<std::int64_t>(k % std::size_t(seeds)) + 1;
            const Json &energy = results[k]["energy"], &invariant = results[k]["invariant"];
            for (std::size_t t = 0; t < energy.size(); ++t)
                table.add({std::int64_t{m}, discs, seed, static_cast<std::int64_t>(t),
                           number(energy[t]), number(invariant[t])});
            if (seed > 1) continue;
            outcome.findings.push_back(fmt::format(
                "No friction, {}: in {} periods the energy changes from {:.0f} to {:.0f}, and K − "
                "ΩL by {} (first seed).",
                m > 0 ? fmt::format("{} sides", m) : "the circle", periods, number(energy.front()),
                number(energy.back()),
                with_error(number(invariant.back()) - number(invariant.front()), not_available)));
        }
        outcome.write(table, "energy", out);
        return outcome;
    };
    return plan;
}

std::vector<PaperFigure> figures_against_time() {
    return {{"transient", "beyond the paper: spin and rotation from rest, μ_d = 0",
             plan_figure_transient},
            {"energy", "beyond the paper: energy without any friction", plan_figure_energy}};
}

}  // namespace swirl
