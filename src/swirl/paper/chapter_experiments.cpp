// Against published experiments with spheres in a swirled dish.
//
// Figure "scherer". Scherer, Kötter, Markus, Goles and Rehberg (Phys. Rev. E 61, 4069, 2000) report
// that the sign of dE/dN, with E the mean kinetic energy of a particle, distinguishes rotation
// (zero), reptation, which is counterrotation (positive), and the appearance of concentric rings
// (negative), and that particles of a large cluster follow hypocycloids.
//
// Figure "instability". Zhao and Pöschel (arXiv 2008.12902 and 2107.14440) report that a uniform
// layer becomes unstable beyond a threshold of the amplitude: a dense region forms and travels
// around the dish. In denser layers a solid core rotates against the swirl, with a fluid layer at
// the wall.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "swirl/paper/chapter_runs.hpp"
#include "swirl/paper/chapters.hpp"
#include "swirl/paper/coarse_zero.hpp"
#include "swirl/paper/points.hpp"
#include "swirl/paper/results.hpp"
#include "swirl/paper/swirled_state.hpp"
#include "swirl/run/config.hpp"
#include "swirl/run/parameters.hpp"
#include "swirl/run/report.hpp"

namespace swirl {
namespace {

void add_over_runs(std::vector<Table::Cell>& row, const std::vector<std::string>& names,
                   const std::vector<Json>& runs) {
    for (const std::string& name : names)
        add_estimate(row, over_runs(runs, [&](const Json& run) { return number(run[name]); }));
}

// --- Energy, rings and paths ---------------------------------------------------------------

/// A dish with its particles; amplitude and period relative to those of the experiment.
struct SchererSetting {
    const char *name, *words;
    bool spheres;
    double amplitude, period;
};
constexpr SchererSetting scherer_settings[] = {
    {"experiment", "spheres, A/R = 0.225", true, 1.0, 1.0},
    {"wide", "spheres, 1.4 A", true, 1.4, 1.0},
    {"fast", "spheres, 0.7 T", true, 1.0, 0.7},
    {"discs", "discs, A/R = 0.22", false, 1.0, 1.0}};

RunConfig scherer_config(const PaperSettings& settings, const SchererSetting& s, std::int64_t n) {
    RunConfig config = s.spheres ? spheres_of_chapters() : RunConfig{};
    config.discs = n;
    config.amplitude *= s.amplitude;
    config.period *= s.period;
    config.seed = settings.seed;
    config.warmup = settings.periods(20, 2);
    config.periods = *config.warmup + settings.periods(60, 8);
    return config;
}

std::vector<std::int64_t> scherer_numbers(const PaperSettings& settings) {
    if (settings.quick) return {8, 20, 32, 44, 52};
    return {5, 8, 11, 14, 20, 26, 32, 38, 44, 48, 52, 54};
}

const std::vector<std::string> scherer_quantities{"rotation", "path_rotation", "path_distance"};

/// E = ⟨v²⟩/v_C², with the speed v_C of the container, and the rotation at one N.
struct EnergyPoint {
    std::int64_t discs;
    Estimate energy, spin_energy, rotation;
};
/// dE/dN from the two neighbours of a point; n/a at the ends.
Estimate energy_slope(const std::vector<EnergyPoint>& curve, std::size_t k) {
    if (k == 0 || k + 1 == curve.size()) return {};
    const EnergyPoint &a = curve[k - 1], &b = curve[k + 1];
    const auto step = static_cast<double>(b.discs - a.discs);
    return {.mean = (b.energy.mean - a.energy.mean) / step,
            .error = std::hypot(a.energy.error, b.energy.error) / step};
}
int sign_of(const Estimate& e) { return certain_sign_of(e.mean, e.error); }
/// "4 of 6" points with a slope of this sign, among those with this sign of the rotation.
std::string count_of_slopes(const std::vector<EnergyPoint>& curve, int rotation, int slope) {
    int all = 0, found = 0;
    for (std::size_t k = 1; k + 1 < curve.size(); ++k) {
        if (sign_of(curve[k].rotation) != rotation) continue;
        ++all;
        if (sign_of(energy_slope(curve, k)) == slope) ++found;
    }
    return fmt::format("{} of {}", found, all);
}
std::string energy_sentence(const SchererSetting& s, const std::vector<EnergyPoint>& curve) {
    std::vector<std::string> falls;
    for (std::size_t k = 1; k + 1 < curve.size(); ++k)
        if (sign_of(energy_slope(curve, k)) < 0) falls.push_back(fmt::format("{}", curve[k].discs));
    return fmt::format(
        "{}: dE/dN is certainly positive at {} N with rotation and at {} with counterrotation; "
        "it is certainly negative at N = {}.",
        s.words, count_of_slopes(curve, 1, 1), count_of_slopes(curve, -1, 1),
        falls.empty() ? "none" : fmt::format("{}", fmt::join(falls, ", ")));
}

/// The radial densities of one point.
void add_rings(Table& rings, const char* setting, std::int64_t discs,
               const std::vector<Json>& runs) {
    if (runs.empty()) return;
    for (std::size_t b = 0; b < runs.front()["about_container"].size(); ++b) {
        const auto mean = [&](const char* name) {
            return over_runs(runs, [&](const Json& r) { return number(r[name][b]); });
        };
        const Estimate own = mean("about_centre_of_mass"), dish = mean("about_container");
        rings.add({std::string(setting), discs,
                   (static_cast<double>(b) + 0.5) / SwirledState::rings_per_radius, own.mean,
                   own.error, dish.mean, dish.error});
    }
}

FigureOutcome finish_scherer(const std::vector<RunConfig>& configs,
                             const std::vector<std::int64_t>& numbers, int seeds,
                             const std::vector<Json>& results, const fs::path& out) {
    FigureOutcome outcome;
    Table table(
        joined(joined({"setting", "words", "amplitude", "period", "discs"},
                      number_columns(joined({"energy", "spin_energy"}, scherer_quantities))),
               {"slope", "slope_error", "seeds"}));
    Table rings({"setting", "discs", "distance", "about_centre_of_mass",
                 "about_centre_of_mass_error", "about_container", "about_container_error"});
    for (std::size_t s = 0; s < std::size(scherer_settings); ++s) {
        const SchererSetting& setting = scherer_settings[s];
        std::vector<EnergyPoint> curve;
        std::vector<std::vector<Json>> runs;
        for (std::size_t k = 0; k < numbers.size(); ++k) {
            runs.push_back(results_of_seeds(results, s * numbers.size() + k, seeds));
            const double speed = container_speed(configs[s * numbers.size() + k]);
            const auto mean = [&](const char* name, double unit) {
                return over_runs(runs.back(),
                                 [&](const Json& r) { return number(r[name]) / unit; });
            };
            curve.push_back({numbers[k], mean("square", speed * speed),
                             mean("spin_square", speed * speed), mean("rotation", 1.0)});
        }
        for (std::size_t k = 0; k < numbers.size(); ++k) {
            const RunConfig& config = configs[s * numbers.size() + k];
            std::vector<Table::Cell> row{std::string(setting.name), std::string(setting.words),
                                         config.amplitude, config.period, numbers[k]};
            add_estimate(row, curve[k].energy);
            add_estimate(row, curve[k].spin_energy);
            add_over_runs(row, scherer_quantities, runs[k]);
            add_estimate(row, energy_slope(curve, k));
            row.emplace_back(std::int64_t(runs[k].size()));
            table.add(std::move(row));
            add_rings(rings, setting.name, numbers[k], runs[k]);
        }
        outcome.findings.push_back(energy_sentence(setting, curve));
    }
    outcome.write(table, "scherer", out);
    outcome.write(rings, "scherer_rings", out);
    return outcome;
}

FigurePlan plan_figure_scherer(const PaperSettings& settings) {
    FigurePlan plan;
    const int seeds = chapter_seeds(settings);
    const std::vector<std::int64_t> numbers = scherer_numbers(settings);
    std::vector<RunConfig> configs;
    for (const SchererSetting& s : scherer_settings)
        for (const std::int64_t n : numbers) {
            configs.push_back(scherer_config(settings, s, n));
            add_seeds(plan, configs.back(), seeds,
                      fmt::format("scherer_{}_N{}_{}", s.name, n, length_of(configs.back())),
                      expected_events_per_period(configs.back()) * double(*configs.back().periods),
                      swirled_run);
        }
    plan.finish = [=](const std::vector<Json>& results, const fs::path& out) {
        return finish_scherer(configs, numbers, seeds, results, out);
    };
    return plan;
}

// --- Instability of a uniform layer ---------------------------------------------------------

constexpr double layers_of_spheres[] = {0.3, 0.45, 0.65};  // φ
constexpr double layer_radius = 17.0;
const std::vector<std::string> layer_quantities{"distance", "steady", "advance",
                                                "core",     "layer",  "rotation"};

std::vector<double> layer_amplitudes(const PaperSettings& settings) {
    if (settings.quick) return {0.25, 1.0, 2.0};
    return {0.25, 0.5, 1.0, 1.5, 2.0, 3.0, 4.0};
}

/// The mean distance of the centre of mass from the middle of the dish, in R, of N independent
/// points in the circle that centres can reach. Each coordinate has the variance (R − r)²/4N.
double distance_of_random_points(std::int64_t discs) {
    return (1.0 - 1.0 / layer_radius) * std::sqrt(pi / (8.0 * static_cast<double>(discs)));
}
/// A layer is unstable if its distance exceeds that of random points by this factor.
constexpr double unstable_distance = 2.0;

/// The amplitude above which the layer is unstable, with its error; NaN if none is certain.
CoarseZero threshold_of(const std::vector<RotationPoint>& excess) {
    const Crossing found = find_crossing(excess);
    for (auto change = found.changes.rbegin(); change != found.changes.rend(); ++change) {
        if (change->to_counterrotation) continue;  // falls below
        const CurveZero zero = zero_of_curve(excess, middle_zero(excess, *change));
        return {zero.discs, zero.error()};
    }
    return {};
}

FigureOutcome finish_instability(const std::vector<RunConfig>& configs, int seeds,
                                 const std::vector<Json>& results, const fs::path& out) {
    FigureOutcome outcome;
    Table table(
        joined(joined({"packing_fraction", "discs", "amplitude"}, number_columns(layer_quantities)),
               {"seeds"}));
    Table thresholds(
        {"packing_fraction", "discs", "random_distance", "threshold", "threshold_error"});
    const std::size_t amplitudes = configs.size() / std::size(layers_of_spheres);
    for (std::size_t l = 0; l < std::size(layers_of_spheres); ++l) {
        const std::int64_t discs = configs[l * amplitudes].discs;
        const double random = distance_of_random_points(discs);
        std::vector<RotationPoint> excess;
        for (std::size_t k = l * amplitudes; k < (l + 1) * amplitudes; ++k) {
            const std::vector<Json> runs = results_of_seeds(results, k, seeds);
            std::vector<Table::Cell> row{layers_of_spheres[l], discs, configs[k].amplitude};
            add_over_runs(row, layer_quantities, runs);
            row.emplace_back(std::int64_t(runs.size()));
            table.add(std::move(row));
            const Estimate distance =
                over_runs(runs, [](const Json& r) { return number(r["distance"]); });
            excess.push_back({configs[k].amplitude, distance.mean / random - unstable_distance,
                              distance.error / random});
        }
        const CoarseZero threshold = threshold_of(excess);
        thresholds.add({layers_of_spheres[l], discs, random, threshold.discs, threshold.error});
        outcome.findings.push_back(fmt::format(
            "φ = {}: the centre of mass is farther from the middle than {} times the distance of "
            "random points {}.",
            layers_of_spheres[l], unstable_distance,
            threshold.exists()
                ? "from A/r = " + with_error(threshold.discs, threshold.error) + " on"
                : "at no certain amplitude"));
    }
    outcome.write(table, "instability", out);
    outcome.write(thresholds, "instability_thresholds", out);
    return outcome;
}

FigurePlan plan_figure_instability(const PaperSettings& settings) {
    FigurePlan plan;
    const int seeds = chapter_seeds(settings);
    std::vector<RunConfig> configs;
    for (const double fraction : layers_of_spheres)
        for (const double amplitude : layer_amplitudes(settings)) {
            RunConfig config = spheres_of_chapters();
            config.container_radius = layer_radius;
            config.discs = std::llround(fraction * layer_radius * layer_radius);
            config.amplitude = amplitude;
            config.seed = settings.seed;
            config.warmup = settings.periods(20, 2);
            config.periods = *config.warmup + settings.periods(24, 8);
            configs.push_back(config);
            add_seeds(
                plan, config, seeds,
                fmt::format("instability_N{}_A{}_{}", config.discs, amplitude, length_of(config)),
                expected_events_per_period(config) * double(*config.periods), swirled_run);
        }
    plan.finish = [=](const std::vector<Json>& results, const fs::path& out) {
        return finish_instability(configs, seeds, results, out);
    };
    return plan;
}

}  // namespace

std::vector<PaperFigure> chapter_experiments() {
    return {{"scherer", "chapter: energy, rings and paths of swirled spheres", plan_figure_scherer},
            {"instability", "chapter: from which amplitude on is a layer of spheres unstable?",
             plan_figure_instability}};
}

}  // namespace swirl
