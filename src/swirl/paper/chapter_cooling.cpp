// Against published theory: does a gas of rough discs cool as the mean-field theory of Huthmann and
// Zippelius says (rough_gas.hpp)? The container is at rest, and its wall is smooth and elastic, so
// that only collisions of two discs change the energy. The gas first reaches equilibrium without
// friction and losses. Then the collision law is switched on, with all spins zero.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "swirl/engine/simulation.hpp"
#include "swirl/paper/chapters.hpp"
#include "swirl/paper/points.hpp"
#include "swirl/paper/results.hpp"
#include "swirl/paper/rough_gas.hpp"
#include "swirl/run/config.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/report.hpp"

namespace swirl {
namespace {

constexpr double gas_fraction = 0.2;  // φ = N r²/R²
/// Collisions per disc without losses: to reach equilibrium, then to measure the collision rate.
constexpr double collisions_to_mix = 40.0, collisions_to_count = 20.0;

constexpr double always_sticks = 1e6;  // μ
/// One collision law. `beta` is that of the theory: −1 without friction.
struct CoolingCase {
    const char *name, *words;
    double restitution, beta, mu, inertia;

    RoughGas theory() const { return RoughGas::of(restitution, beta, inertia); }
};
constexpr CoolingCase cooling_cases[] = {
    {"haff", "smooth, e = 0.9", 0.9, -1.0, 0.0, 0.5},
    {"elastic", "e = 1, β = 1, I = ½", 1.0, 1.0, always_sticks, 0.5},
    {"partly", "e = 0.95, β = 0.5, I = ½", 0.95, 0.5, always_sticks, 0.5},
    {"solid", "e = 0.9, β = 0, I = ½", 0.9, 0.0, always_sticks, 0.5},
    {"sticking", "e = 1, β = 0, I = 10", 1.0, 0.0, always_sticks, 10.0},
    {"paper", "e = 1, β = 0, I = 10, μ = 1", 1.0, 0.0, 1.0, 10.0},
    {"slippery", "e = 1, β = 0, I = 10, μ = 0.1", 1.0, 0.0, 0.1, 10.0}};
constexpr double cooling_moments[] = {0.5, 1.0, 2.0, 3.0, 4.0, 5.0, 7.0, 10.0, 15.0, 20.0, 30.0};
/// "The first collisions" of the findings.
constexpr double first_collisions = 2.0;

/// Second and fourth moments of all discs.
struct GasState {
    Temperatures temperature;
    double excess;  // a₂ = ⟨v⁴⟩/2⟨v²⟩² − 1, 0 for a normal distribution
    double correlation;  // ⟨v²ω²⟩/⟨v²⟩⟨ω²⟩ − 1, 0 for independent ones; NaN without spins
};
GasState state_of_gas(const Simulation& gas) {
    double v2 = 0.0, v4 = 0.0, w2 = 0.0, v2w2 = 0.0, inertia = 0.0;
    const auto n = static_cast<double>(gas.size());
    for (std::size_t i = 0; i < gas.size(); ++i) {
        const Disc disc = gas.disc(i);
        const double square = dot(disc.velocity, disc.velocity), spin = disc.spin * disc.spin;
        v2 += square / n;
        v4 += square * square / n;
        w2 += spin / n;
        v2w2 += square * spin / n;
        inertia = disc.inertia;
    }
    return {{0.5 * v2, inertia * w2}, 0.5 * v4 / (v2 * v2) - 1.0, v2w2 / (v2 * w2) - 1.0};
}

/// Advances to the exact number of collisions of two discs per disc.
void advance_collisions(Simulation& gas, std::uint64_t from, double per_disc,
                        const RunControl& control) {
    const auto target =
        from + static_cast<std::uint64_t>(0.5 * per_disc * static_cast<double>(gas.size()));
    while (gas.events().disc_disc < target) {
        if (control.stop && control.stop->load(std::memory_order_relaxed))
            throw Interrupted("Stopped.");
        gas.run(std::max<std::uint64_t>(1, (target - gas.events().disc_disc) / 2));
    }
}
double time_of_gas(const Simulation& gas, double period) {
    return static_cast<double>(gas.periods()) * period + gas.clock();
}

RunConfig gas_config(const PaperSettings& settings, std::int64_t discs) {
    RunConfig config;
    config.discs = discs;
    config.container_radius = std::sqrt(static_cast<double>(discs) / gas_fraction);
    config.amplitude = 0.0;
    config.mu_disc = config.mu_wall = 0.0;
    config.seed = settings.seed;
    return config;
}

/// The states of one case at all moments. `scene` is the gas in equilibrium.
Json cool(InitialState scene, const Progress& progress, const CoolingCase& law, double period,
          const RunControl& control) {
    scene.disc_surface = {law.mu, law.restitution, std::max(law.beta, 0.0)};
    for (Disc& disc : scene.discs) disc.inertia = law.inertia;
    Simulation gas(scene, progress);
    const double begin = time_of_gas(gas, period);
    const std::uint64_t before = gas.events().disc_disc;
    Json rows = Json::array();
    const double T0 = state_of_gas(gas).temperature.translation;
    for (const double tau : cooling_moments) {
        advance_collisions(gas, before, tau, control);
        const GasState now = state_of_gas(gas);
        rows.push_back({now.temperature.translation / T0, now.temperature.spins / T0,
                        (time_of_gas(gas, period) - begin) * std::sqrt(T0), now.excess,
                        now.correlation});
    }
    return rows;
}

/// The collision rate in equilibrium, in units of Enskog's, and the states of all cases.
Json cooling_run(const RunConfig& config, const RunControl& control) {
    InitialState scene = make_initial_state(config, control.stop);
    Simulation gas(scene);
    advance_collisions(gas, 0, collisions_to_mix, control);
    const double from = time_of_gas(gas, config.period);
    const std::uint64_t before = gas.events().disc_disc;
    advance_collisions(gas, before, collisions_to_count, control);
    const double rate =
        2.0 * static_cast<double>(gas.events().disc_disc - before) /
        (static_cast<double>(gas.size()) * (time_of_gas(gas, config.period) - from));
    const double T = state_of_gas(gas).temperature.translation;
    Json result{{"rate", rate / (std::sqrt(T) * enskog_collision_rate(gas_fraction))}};
    for (std::size_t i = 0; i < gas.size(); ++i) scene.discs[i] = gas.disc(i);
    for (const CoolingCase& law : cooling_cases)
        result[law.name] = cool(scene, gas.progress(), law, config.period, control);
    return result;
}

std::vector<std::int64_t> gas_sizes(const PaperSettings& settings) {
    if (settings.quick) return {500, 1000};
    return {500, 1000, 2000, 4000, 8000};
}

/// The rows of a case in the largest gas, with the theory. Returns the largest relative deviations
/// of T and T_s during the first collisions.
struct Deviations {
    Estimate translation{.mean = 0.0}, spins{.mean = 0.0};
};
Deviations add_case(Table& table, const CoolingCase& law, const std::vector<Json>& runs) {
    Deviations largest;
    for (std::size_t k = 0; k < std::size(cooling_moments); ++k) {
        const double tau = cooling_moments[k];
        const auto mean = [&](std::size_t column) {
            return over_runs(runs,
                             [&](const Json& run) { return number(run[law.name][k][column]); });
        };
        const Temperatures expected = law.theory().after(tau, {1.0, 0.0});
        const Estimate T = mean(0), spins = mean(1), time = mean(2), excess = mean(3),
                       correlation = mean(4);
        table.add({std::string(law.name),
                   std::string(law.words),
                   law.restitution,
                   law.beta,
                   law.mu,
                   law.inertia,
                   tau,
                   T.mean,
                   T.error,
                   expected.translation,
                   spins.mean,
                   spins.error,
                   expected.spins,
                   time.mean * enskog_collision_rate(gas_fraction),
                   time.error * enskog_collision_rate(gas_fraction),
                   law.theory().time_of(tau, {1.0, 0.0}),
                   excess.mean,
                   excess.error,
                   correlation.mean,
                   correlation.error,
                   std::int64_t(runs.size())});
        if (tau > first_collisions) continue;
        const auto keep = [](Estimate& most, const Estimate& found, double theory) {
            const double deviation = found.mean / theory - 1.0;
            if (theory > 0.0 && std::fabs(deviation) >= std::fabs(most.mean))
                most = {.mean = deviation, .error = found.error / theory};
        };
        keep(largest.translation, T, expected.translation);
        keep(largest.spins, spins, expected.spins);
    }
    return largest;
}

std::string in_percent(const Estimate& e) {
    return with_error(100.0 * e.mean, 100.0 * e.error) + " %";
}

FigureOutcome finish_cooling(const std::vector<std::int64_t>& sizes, int seeds,
                             const std::vector<Json>& results, const fs::path& out) {
    FigureOutcome outcome;
    Table table({"case",
                 "words",
                 "restitution",
                 "beta",
                 "mu",
                 "inertia",
                 "collisions",
                 "translation",
                 "translation_error",
                 "theory_translation",
                 "spins",
                 "spins_error",
                 "theory_spins",
                 "time",
                 "time_error",
                 "theory_time",
                 "excess",
                 "excess_error",
                 "correlation",
                 "correlation_error",
                 "seeds"});
    const std::vector<Json> runs = results_of_seeds(results, sizes.size() - 1, seeds);
    for (const CoolingCase& law : cooling_cases) {
        const Deviations found = add_case(table, law, runs);
        outcome.findings.push_back(fmt::format(
            "{}: the largest deviation from the mean-field theory up to {} collisions of a disc "
            "is {} for the translation{}.",
            law.words, first_collisions, in_percent(found.translation),
            law.mu > 0.0 ? " and " + in_percent(found.spins) + " for the spins" : ""));
    }
    outcome.write(table, "cooling", out);
    Table rates({"discs", "container_radius", "packing_fraction", "rate", "rate_error", "seeds"});
    std::vector<std::string> words;
    for (std::size_t k = 0; k < sizes.size(); ++k) {
        const std::vector<Json> of_size = results_of_seeds(results, k, seeds);
        const Estimate rate = over_runs(of_size, [](const Json& r) { return number(r["rate"]); });
        const double radius = std::sqrt(static_cast<double>(sizes[k]) / gas_fraction);
        rates.add(
            {sizes[k], radius, gas_fraction, rate.mean, rate.error, std::int64_t(of_size.size())});
        words.push_back(
            fmt::format("{} at R/r = {:.0f}", with_error(rate.mean, rate.error), radius));
    }
    outcome.write(rates, "cooling_rates", out);
    outcome.findings.push_back(
        fmt::format("Collision rate in units of Enskog's: {}.", fmt::join(words, ", ")));
    return outcome;
}

FigurePlan plan_figure_cooling(const PaperSettings& settings) {
    FigurePlan plan;
    const int seeds = chapter_seeds(settings);
    const std::vector<std::int64_t> sizes = gas_sizes(settings);
    for (const std::int64_t discs : sizes) {
        double collisions = collisions_to_mix + collisions_to_count;
        collisions += std::size(cooling_cases) * cooling_moments[std::size(cooling_moments) - 1];
        add_seeds(plan, gas_config(settings, discs), seeds, fmt::format("cooling_N{}", discs),
                  0.5 * collisions * static_cast<double>(discs), cooling_run);
    }
    plan.finish = [=](const std::vector<Json>& results, const fs::path& out) {
        return finish_cooling(sizes, seeds, results, out);
    };
    return plan;
}

}  // namespace

std::vector<PaperFigure> chapter_cooling() {
    return {{"cooling", "chapter: does a gas of rough discs cool as mean-field theory says?",
             plan_figure_cooling}};
}

}  // namespace swirl
