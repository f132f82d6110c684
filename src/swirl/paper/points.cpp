#include "swirl/paper/points.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "swirl/run/json.hpp"
#include "swirl/run/report.hpp"
#include "swirl/study/crossing_search.hpp"

namespace swirl {

using Json = nlohmann::ordered_json;

namespace {

/// What the figures of the paper, or a reader of its tables, may ask of one run. Maps are large.
std::vector<std::string> measurements_of_the_paper(std::int64_t discs) {
    std::vector<std::string> names{"profile",     "pinned", "residence",  "centre",     "slip",
                                   "frustration", "order",  "collisions", "temperature"};
    if (discs == rotating || discs == counterrotating)
        names.insert(names.end(), {"density", "flow"});
    return names;
}

std::string name_of(const Friction& friction, std::int64_t discs) {
    return fmt::format("{}_N{}", friction.name, discs);
}

/// Without friction at the wall collisions are so many that the events of a quick run are over
/// after some swirls: there it goes by swirls, so that there is something to average.
RunConfig config_of_a_point(const PaperSettings& settings, const Friction& friction,
                            std::int64_t discs) {
    constexpr std::int64_t warmup = 10, periods = 25;
    RunConfig config = paper_config(settings, friction, discs);
    if (!settings.quick || settings.events || friction.mu_wall > 0.0) return config;
    if (expected_events_per_swirl(config) * double(periods) < static_cast<double>(config.events))
        return config;
    config.warmup = warmup;
    config.periods = periods;
    return config;
}

std::string key_of(const RunConfig& config, const Friction& friction, std::uint64_t seed) {
    const std::string length = config.periods
                                   ? fmt::format("{}of{}periods", *config.warmup, *config.periods)
                                   : fmt::format("{}events", config.events);
    return fmt::format("{}_{}_seed{}", name_of(friction, config.discs), length, seed);
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
    // Without gaps where the paper's three frictions cross: between other numbers N_c is a bracket.
    if (settings.quick)
        return {5, 8, 12, 16, 20, 24, 28, 31, 34, 36, 37, 38, 39, 40, 42, 43, 44, 45, 46, 48};
    std::vector<std::int64_t> all;
    for (std::int64_t n = 5; n <= 48; ++n) all.push_back(n);
    return all;
}

std::vector<std::int64_t> sparse_numbers(const PaperSettings& settings) {
    if (settings.quick) return {8, 20, 28, 36, 42, 48};
    return {5, 8, 12, 16, 20, 24, 26, 28, 30, 32, 34, 36, 38, 40, 42, 44, 46, 48};
}

std::vector<std::int64_t> numbers_beyond(const PaperSettings& settings) {
    if (settings.quick) return {51, 54};
    return {49, 50, 51, 52, 53, 54, 55};
}

std::vector<std::int64_t> numbers_of_the_experiment(const PaperSettings& settings) {
    std::vector<std::int64_t> some;
    for (const std::int64_t n : numbers_of_discs(settings))
        if (n >= 24) some.push_back(n);
    return some;
}

RunConfig paper_config(const PaperSettings& settings, const Friction& friction,
                       std::int64_t discs) {
    RunConfig config;
    config.discs = discs;
    config.mu_disc = friction.mu_disc;
    config.mu_wall = friction.mu_wall;
    config.events = settings.events_of_a_run();
    config.seed = settings.seed;
    return config;
}

PaperPoint point(const PaperSettings& settings, const Friction& friction, std::int64_t discs) {
    RunConfig config = config_of_a_point(settings, friction, discs);
    return {settings, name_of(friction, discs), settings.seeds(), [&](std::uint64_t seed) {
                config.seed = seed;
                const std::string key = key_of(config, friction, seed);
                PaperTask task = run_task("run_" + key, config);
                task.served_by = "measured_" + key;
                return task;
            }};
}

PaperPoint measured_point(const PaperSettings& settings, const Friction& friction,
                          std::int64_t discs) {
    RunConfig config = config_of_a_point(settings, friction, discs);
    return {settings, name_of(friction, discs), settings.seeds(), [&](std::uint64_t seed) {
                config.seed = seed;
                return run_task("measured_" + key_of(config, friction, seed), config,
                                measurements_of_the_paper(discs));
            }};
}

PaperPoint dense_point(const PaperSettings& settings, const Friction& friction,
                       std::int64_t discs) {
    RunConfig config = paper_config(settings, friction, discs);
    config.warmup = settings.periods(settings.quick ? 20 : 40, 1);
    config.periods = *config.warmup + settings.periods(settings.quick ? 60 : 200, 3);
    return {settings, name_of(friction, discs), settings.seeds(), [&](std::uint64_t seed) {
                config.seed = seed;
                return run_task(
                    fmt::format("dense_{}_{}of{}periods_seed{}", name_of(friction, discs),
                                *config.warmup, *config.periods, seed),
                    config);
            }};
}

RunConfig settled_config(const PaperSettings& settings, const Friction& friction,
                         std::int64_t discs) {
    RunConfig config = paper_config(settings, friction, discs);
    const std::int64_t left_out = friction.mu_disc == 0.0 ? 300 : 100;
    config.warmup = settings.periods(settings.quick ? left_out / 2 : left_out, 2);
    const auto measured =
        static_cast<std::int64_t>((settings.quick ? 1e5 : 1e6) / expected_events_per_swirl(config));
    const std::int64_t minimum = settings.quick ? 50 : 200;
    config.periods = *config.warmup + settings.periods(std::max(minimum, measured), 3);
    return config;
}

PaperPoint settled_point(const PaperSettings& settings, const Friction& friction,
                         std::int64_t discs) {
    RunConfig config = settled_config(settings, friction, discs);
    const std::string name = "settled_" + name_of(friction, discs);
    return {settings, name, settings.seeds(), [&](std::uint64_t seed) {
                config.seed = seed;
                return run_task(fmt::format("measured_{}_{}of{}periods_seed{}", name,
                                            *config.warmup, *config.periods, seed),
                                config, measurements_of_the_paper(discs));
            }};
}

PaperPoint varied_point(const PaperSettings& settings, const std::string& name,
                        const RunConfig& config) {
    RunConfig varied = config;
    return {settings, name, settings.seeds_beyond(), [&](std::uint64_t seed) {
                varied.seed = seed;
                return run_task(fmt::format("varied_{}_seed{}", name, seed), varied);
            }};
}

bool failed(const Json& result) { return result.is_object() && result.contains("failed"); }

const Json& at(const Json& result, std::initializer_list<std::string_view> path) {
    static const Json nothing;
    const Json* here = &result;
    for (const std::string_view name : path) {
        if (!here->is_object() || !here->contains(name)) return nothing;
        here = &here->at(std::string(name));
    }
    return *here;
}

double number(const Json& value) { return value.is_number() ? value.get<double>() : not_available; }

std::string steadiness(const Json& result) {
    const Json& verdict = at(result, {"steady_state", "verdict"});
    return verdict.is_string() ? verdict.get<std::string>() : "failed";
}

std::string name_of_point(const Json& result) {
    const Json& name = at(result, {"point"});
    return name.is_string() ? name.get<std::string>() : "";
}

std::vector<std::string> rotation_columns() {
    return {"by_event",
            "by_event_error",
            "by_time",
            "by_time_error",
            "rigid_by_event",
            "rigid_by_event_error",
            "rigid_by_time",
            "rigid_by_time_error",
            "effective_samples",
            "events",
            "periods",
            "warmup_periods",
            "steady_state",
            "point",
            "seeds",
            "averaged_runs",
            "steady_runs",
            "drifting_runs",
            "jumping_runs",
            "switching_runs",
            "too_short_to_average",
            "scatter",
            "seeds_disagree",
            "seed",
            "state_hash"};
}

Table::Cell whole(const Json& value) {
    if (value.is_number_integer()) return value.get<std::int64_t>();
    return not_available;
}

Table::Cell averaged_runs(const Json& r) { return whole(at(r, {"seeds", "averaged"})); }

void add_rotation(std::vector<Table::Cell>& row, const Json& r) {
    for (const char* which : {"by_event", "by_time", "rigid_by_event", "rigid_by_time"}) {
        row.emplace_back(number(at(r, {"rotation", which, "mean"})));
        row.emplace_back(number(at(r, {"rotation", which, "error"})));
    }
    row.emplace_back(number(at(r, {"rotation", "by_event", "effective_samples"})));
    row.push_back(whole(at(r, {"events", "total"})));
    row.emplace_back(number(at(r, {"periods"})));
    row.push_back(whole(at(r, {"warmup", "periods"})));
    row.emplace_back(steadiness(r));
    row.emplace_back(name_of_point(r));
    row.push_back(whole(at(r, {"seeds", "runs"})));
    row.push_back(averaged_runs(r));
    for (const char* count : {"steady", "drifting", "jumping", "switching", "too_short_to_average"})
        row.push_back(whole(at(r, {"seeds", count})));
    row.emplace_back(number(at(r, {"seeds", "scatter"})));
    row.emplace_back(std::int64_t{at(r, {"seeds", "disagree"}) == true});
    row.push_back(whole(at(r, {"config", "seed"})));
    const Json& hash = at(r, {"state_hash"});
    row.emplace_back(hash.is_string() ? hash.get<std::string>() : "");
}

RotationPoint rotation_point(double x, const Json& r, const char* average) {
    return {x, number(at(r, {"rotation", average, "mean"})),
            number(at(r, {"rotation", average, "error"}))};
}

std::vector<std::string> number_columns(const std::vector<std::string>& names) {
    std::vector<std::string> columns;
    for (const std::string& name : names) {
        const std::size_t renamed = name.find('=');
        const std::string column =
            name.substr((renamed == name.npos ? name.find('.') : renamed) + 1);
        columns.push_back(column);
        columns.push_back(column + "_error");
    }
    return columns;
}
void add_numbers(std::vector<Table::Cell>& row, const std::vector<std::string>& names,
                 const Json& result) {
    for (const std::string& name : names) {
        const std::size_t dot = name.find('.');
        const std::string measurement = name.substr(0, dot);
        const std::string quantity = name.substr(dot + 1, name.find('=') - dot - 1);
        const Json& value = at(result, {"measured", measurement, quantity});
        if (value.is_number()) {  // no average
            row.emplace_back(number(value));
            row.emplace_back(0.0);
            continue;
        }
        for (const char* what : {"mean", "error"}) row.emplace_back(number(at(value, {what})));
    }
}

const RotationPoint* lowest_of(std::span<const RotationPoint> curve) {
    const RotationPoint* lowest = nullptr;
    for (const RotationPoint& p : curve)
        if (std::isfinite(p.mean) && (!lowest || p.mean < lowest->mean)) lowest = &p;
    return lowest;
}

static const RotationPoint* highest_of(std::span<const RotationPoint> curve) {
    const RotationPoint* highest = nullptr;
    for (const RotationPoint& p : curve)
        if (std::isfinite(p.mean) && (!highest || p.mean > highest->mean)) highest = &p;
    return highest;
}

void NamedCurve::add(double discs, const Json& result) {
    for (std::size_t r = 0; r < curves.size(); ++r)
        curves[r].push_back(rotation_point(discs, result, rotation_rates[r].name));
}

static std::string driving_sentence(const NamedCurve& curve, const Crossing& crossing) {
    const char* const words = rotation_rates[curve.rate].description;
    if (const SignChange* const change = crossing.last()) {
        const std::string interval = change->resolved() ? fmt::format("95 %: {:.1f} to {:.1f}; ",
                                                                      change->lower, change->upper)
                                                        : "";
        const std::vector<double> beyond = crossing.undetermined_after();
        return fmt::format(
            "crosses zero {} ({}{}){}", change_location(*change), interval, words,
            beyond.empty() ? ""
                           : fmt::format("; its sign is undetermined at N = {}", listed(beyond)));
    }
    // The point that is nearest to the other direction.
    const bool counterrotates = crossing.verdict == Crossing::Verdict::always_counterrotates;
    const RotationPoint* const next =
        counterrotates ? highest_of(curve.points()) : lowest_of(curve.points());
    if (!next) return "has no points";
    const std::string undetermined =
        crossing.undetermined.empty()
            ? "no sign is certain"
            : fmt::format("its sign is undetermined at N = {}", listed(crossing.undetermined));
    return fmt::format("{}; {} is ϖ/Ω = {} at N = {:.0f} ({})",
                       crossing.verdict == Crossing::Verdict::undecided
                           ? "whether it crosses zero is undecided, " + undetermined
                           : verdict_word(crossing.verdict),
                       counterrotates ? "highest" : "lowest", with_error(next->mean, next->error),
                       next->discs, words);
}

std::string crossing_sentence(const NamedCurve& curve) {
    const Crossings crossings = find_crossings(curve.curves);
    return driving_sentence(curve, crossings[curve.rate]) + "." +
           other_rates_report(crossings, curve.rate);
}

std::vector<std::string> rates_columns() {
    std::vector<std::string> columns;
    for (const RotationRate& rate : rotation_rates)
        for (const char* what : {"", "_error", "_lower", "_upper"})
            columns.push_back(fmt::format("crossing_{}{}", rate.name, what));
    return columns;
}

void write_crossings(const std::vector<NamedCurve>& curves, const std::filesystem::path& file) {
    Table table(joined({"curve", "rate", "verdict", "crossing", "crossing_error", "lower", "upper",
                        "sign_changes", "undetermined", "lowest", "lowest_error", "lowest_discs"},
                       rates_columns()));
    for (const NamedCurve& curve : curves) {
        const Crossings all = find_crossings(curve.curves);
        const Crossing& c = all[curve.rate];
        const RotationPoint* const known = lowest_of(curve.points());
        const RotationPoint lowest =
            known ? *known : RotationPoint{not_available, not_available, not_available};
        std::vector<Table::Cell> row{curve.name,
                                     std::string(rotation_rates[curve.rate].name),
                                     std::string(verdict_word(c.verdict)),
                                     c.discs,
                                     c.error,
                                     c.lower,
                                     c.upper,
                                     std::int64_t(c.changes.size()),
                                     spaced(c.undetermined),
                                     lowest.mean,
                                     lowest.error,
                                     lowest.discs};
        for (const Crossing& by_rate : all)
            for (const double value : {by_rate.discs, by_rate.error, by_rate.lower, by_rate.upper})
                row.emplace_back(value);
        table.add(std::move(row));
    }
    table.write(file);
}

std::vector<std::string> joined(std::vector<std::string> front,
                                const std::vector<std::string>& back) {
    front.insert(front.end(), back.begin(), back.end());
    return front;
}

}  // namespace swirl
