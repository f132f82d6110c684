#include "swirl/paper/points.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "swirl/paper/curves.hpp"
#include "swirl/paper/results.hpp"
#include "swirl/run/config.hpp"

namespace swirl {
namespace {

/// All measurements that the figures, or readers of the tables, need. Maps are large.
std::vector<std::string> measurements_of_the_paper(const Friction& friction, std::int64_t discs) {
    std::vector<std::string> names{"profile",     "pinned", "residence",  "centre",     "slip",
                                   "frustration", "order",  "collisions", "temperature"};
    if (discs == rotating_n || discs == counterrotating_n)
        names.insert(names.end(), {"density", "flow"});
    if (friction.spheres()) names.emplace_back("rolling");
    return names;
}

std::string name_of(const Friction& friction, std::int64_t discs) {
    return fmt::format("{}_N{}", friction.name, discs);
}

}  // namespace

PaperPoint::PaperPoint(const PaperSettings& settings, std::string point, int seeds,
                       const std::function<PaperTask(std::uint64_t seed)>& run)
    : name(std::move(point)) {
    if (const auto more = settings.seeds_of_point.find(name); more != settings.seeds_of_point.end())
        seeds = std::max(seeds, more->second);
    for (int s = 0; s < seeds; ++s) runs.push_back(run(settings.seed + std::uint64_t(s)));
}

std::vector<std::int64_t> numbers_of_discs(const PaperSettings& settings) {
    // The curves with equal friction coefficients cross where this list has no gaps, so that their
    // N_c is known and not only bracketed.
    if (settings.quick)
        return {5, 8, 12, 16, 20, 24, 28, 32, 34, 36, 37, 38, 39, 40, 42, 43, 44, 45, 46, 48};
    std::vector<std::int64_t> all;
    for (std::int64_t n = first_n; n <= last_n; ++n) all.push_back(n);
    return all;
}

std::vector<std::int64_t> sparse_numbers(const PaperSettings& settings) {
    if (settings.quick) return {8, 20, 28, 36, 42, 48};
    return {5, 8, 12, 16, 20, 24, 26, 28, 30, 32, 34, 36, 38, 40, 42, 44, 46, 48};
}

std::vector<std::int64_t> numbers_beyond(const PaperSettings& settings) {
    if (settings.quick) return {52, 55};
    std::vector<std::int64_t> all;
    for (std::int64_t n = last_n + 1; n <= densest_n; ++n) all.push_back(n);
    return all;
}

std::vector<std::int64_t> numbers_of_spheres(const PaperSettings& settings) {
    if (settings.quick) return {24, 28, 32, 36, 40, 44, 48, 52, 55};
    return {24, 25, 26, 28, 30, 32, 34, 35, 36, 37, 38, 40, 42, 44, 46, 48, 50, 52, 54, 55};
}

std::vector<SettingPoint> points_of(const PaperSettings& settings,
                                    const std::vector<Friction>& frictions) {
    std::vector<SettingPoint> points;
    for (std::size_t s = 0; s < frictions.size(); ++s)
        for (const std::int64_t n : frictions[s].spheres() ? numbers_of_spheres(settings)
                                                           : numbers_of_the_experiment(settings))
            points.push_back({s, n});
    return points;
}

std::vector<std::int64_t> numbers_of_the_experiment(const PaperSettings& settings) {
    std::vector<std::int64_t> numbers = numbers_of_discs(settings);
    std::erase_if(numbers, [](std::int64_t n) { return n < first_n_of_experiment; });
    return numbers;
}

RunConfig paper_config(const PaperSettings& settings, const Friction& friction,
                       std::int64_t discs) {
    RunConfig config;
    if (friction.spheres()) {
        config = resolve({{"preset", std::string(friction.preset)}});
        const bool dense = discs >= 50;
        config.warmup = settings.periods(dense ? 25 : 50, 1);
        config.periods = *config.warmup + settings.periods(dense ? 50 : 150, 3);
    } else {
        config.mu_disc = friction.mu_disc;
        config.mu_wall = friction.mu_wall;
        config.events = settings.events_of_a_run();
    }
    config.discs = discs;
    config.seed = settings.seed;
    return config;
}

CrossingSettings search_for_crossing() {
    CrossingSettings search;
    search.min_periods = 100;
    search.from = 20;
    search.tolerance = 0.2;
    return search;
}

PaperTask crossing_task(const std::string& key, const CrossingSettings& search) {
    constexpr double expected_runs = 40.0;
    return {key, expected_runs * static_cast<double>(search.config.events),
            [search](const RunControl& control) {
                CrossingControl inner;
                inner.stop = control.stop;
                inner.threads = 1;
                const CrossingResult found = search_crossing(search, inner);
                Json numbers = Json::array();
                for (const Crossing& c : found.crossings)
                    for (const double value : {c.discs, c.error, c.lower, c.upper})
                        numbers.push_back(value);
                const Crossing& c = found.crossing();
                return Json{{"crosses", c.verdict == Crossing::Verdict::crosses},
                            {"not_steady", found.not_steady},
                            {"too_short", found.too_short},
                            {"discs", c.discs},
                            {"error", c.error},
                            {"lower", c.lower},
                            {"upper", c.upper},
                            {"by_rate", numbers},
                            {"events", found.events},
                            {"runs", found.runs},
                            {"report", crossing_report(search, found)}};
            }};
}

std::vector<std::string> search_columns() {
    return joined({"crosses", "crossing", "crossing_error", "lower", "upper", "runs", "events",
                   "runs_not_steady", "steady_state"},
                  rates_columns());
}

void add_search(std::vector<Table::Cell>& row, const Json& found) {
    row.emplace_back(std::int64_t{found["crosses"].get<bool>()});
    for (const char* name : {"discs", "error", "lower", "upper"})
        row.emplace_back(number(found[name]));
    for (const char* name : {"runs", "events", "not_steady"}) row.push_back(whole(found[name]));
    row.emplace_back(std::string(found["not_steady"] > 0        ? "not steady"
                                 : at(found, {"too_short"}) > 0 ? "too short to tell"
                                                                : "steady"));
    for (const Json& value : found["by_rate"]) row.emplace_back(number(value));
}

void set_sides(RunConfig& config, int sides) {
    if (sides > 0)
        config.sides = sides;
    else
        config.path = PathShape::circle;
}

std::string length_of(const RunConfig& config) {
    return config.periods ? fmt::format("{}of{}periods", *config.warmup, *config.periods)
                          : fmt::format("{}events", config.events);
}

/// The runs of `config` with all seeds, with keys PREFIX_LENGTH_seedS.
static PaperPoint seeded_point(const PaperSettings& settings, const std::string& name,
                               const std::string& prefix, RunConfig config,
                               const std::vector<std::string>& measurements = {}) {
    return {settings, name, settings.seeds(), [&](std::uint64_t seed) {
                config.seed = seed;
                return run_task(fmt::format("{}_{}_seed{}", prefix, length_of(config), seed),
                                config, measurements);
            }};
}

PaperPoint point(const PaperSettings& settings, const Friction& friction, std::int64_t discs) {
    const std::string name = name_of(friction, discs);
    PaperPoint point =
        seeded_point(settings, name, "run_" + name, paper_config(settings, friction, discs));
    for (PaperTask& task : point.runs)
        task.served_by = "measured_" + task.key.substr(std::string_view("run_").size());
    return point;
}

PaperPoint measured_point(const PaperSettings& settings, const Friction& friction,
                          std::int64_t discs) {
    const std::string name = name_of(friction, discs);
    return seeded_point(settings, name, "measured_" + name, paper_config(settings, friction, discs),
                        measurements_of_the_paper(friction, discs));
}

void set_dense_length(RunConfig& config, const PaperSettings& settings) {
    config.warmup = settings.periods(40, 1);
    config.periods = *config.warmup + settings.periods(200, 3);
}

PaperPoint dense_point(const PaperSettings& settings, const Friction& friction,
                       std::int64_t discs) {
    RunConfig config = paper_config(settings, friction, discs);
    set_dense_length(config, settings);
    const std::string name = name_of(friction, discs);
    return seeded_point(settings, name, "dense_" + name, config);
}

RunConfig settled_config(const PaperSettings& settings, const Friction& friction,
                         std::int64_t discs) {
    RunConfig config = paper_config(settings, friction, discs);
    const std::int64_t warmup = friction.mu_disc == 0.0 ? 300 : 100;
    config.warmup = settings.periods(warmup, 2);
    const auto measured = static_cast<std::int64_t>(1e6 / expected_events_per_period(config));
    config.periods = *config.warmup + settings.periods(std::max<std::int64_t>(200, measured), 3);
    return config;
}

PaperPoint settled_point(const PaperSettings& settings, const Friction& friction,
                         std::int64_t discs) {
    const std::string name = "settled_" + name_of(friction, discs);
    return seeded_point(settings, name, "measured_" + name,
                        settled_config(settings, friction, discs),
                        measurements_of_the_paper(friction, discs));
}

PaperPoint varied_point(const PaperSettings& settings, const std::string& name,
                        const RunConfig& config, int seeds,
                        const std::vector<std::string>& measurements) {
    RunConfig varied = config;
    return {settings, name, seeds, [&](std::uint64_t seed) {
                varied.seed = seed;
                return run_task(fmt::format("varied_{}_seed{}", name, seed), varied, measurements);
            }};
}

void add_seeds(FigurePlan& plan, const RunConfig& config, int seeds, const std::string& name,
               double cost, Json (*work)(const RunConfig&, const RunControl&)) {
    for (int s = 0; s < seeds; ++s) {
        RunConfig seeded = config;
        seeded.seed += static_cast<std::uint64_t>(s);
        plan.points.push_back(
            PaperTask{fmt::format("{}_seed{}", name, seeded.seed), cost,
                      [seeded, work](const RunControl& control) { return work(seeded, control); }});
    }
}

std::vector<Json> results_of_seeds(const std::vector<Json>& results, std::size_t k, int seeds) {
    const auto first = results.begin() + std::ptrdiff_t(k) * seeds;
    std::vector<Json> found;
    std::remove_copy_if(first, first + seeds, std::back_inserter(found), failed);
    return found;
}

}  // namespace swirl
