#include "swirl/paper/several_seeds.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>
#include <string_view>

#include "swirl/io/checksum.hpp"
#include "swirl/paper/points.hpp"
#include "swirl/run/measurements.hpp"
#include "swirl/statistics/replicates.hpp"

namespace swirl {
namespace {

using Json = nlohmann::ordered_json;

/// One place in the results of all runs.
using Places = std::vector<const Json*>;

Places inside(const Places& places, const std::string& name) {
    Places found;
    for (const Json* place : places) found.push_back(&at(*place, {name}));
    return found;
}

bool is_run(const Json& result) { return at(result, {"rotation"}).is_object(); }

/// Over before its warm-up was, or soon after: what was seen of it is the beginning, and it has no
/// average.
bool too_short_to_average(const Json& run) {
    const Json& asked = at(run, {"config", "warmup"});
    const Json& periods = at(run, {"rotation", "by_event", "blocks"});
    return (number(at(run, {"warmup", "periods"})) == 0.0 && asked != 0) ||
           number(periods) < min_periods_of_an_average;
}

bool is_average(const Json& json) {
    return json.is_object() && json.contains("mean") && json.contains("error");
}

Estimate estimate_in(const Json& json) {
    Estimate e;
    e.mean = number(at(json, {"mean"}));
    e.error = number(at(json, {"error"}));
    e.effective_samples = number(at(json, {"effective_samples"}));
    if (const Json& blocks = at(json, {"blocks"}); blocks.is_number_integer())
        e.blocks = blocks.get<std::size_t>();
    return e;
}

Ensemble together(const Places& averages, std::span<const double> weights) {
    std::vector<Estimate> estimates;
    for (const Json* average : averages) estimates.push_back(estimate_in(*average));
    return is_direction(*averages.front()) ? several_directions(estimates, weights)
                                           : ensemble(estimates, weights);
}

Json average_json(const Places& averages, std::span<const double> weights) {
    const Ensemble all = together(averages, weights);
    Json json{{"mean", all.estimate.mean},
              {"error", all.estimate.error},
              {"effective_samples", all.estimate.effective_samples},
              {"blocks", all.estimate.blocks},
              {"scatter", all.scatter},
              {"disagree", all.disagree}};
    // Details have no errors: counts add up, the rest is averaged.
    for (const auto& [name, first] : averages.front()->items()) {
        if (json.contains(name)) continue;
        double sum = 0.0;
        for (const Json* average : averages) sum += number(at(*average, {name}));
        json[name] = name == "count" ? sum : sum / static_cast<double>(averages.size());
    }
    return json;
}

/// A cell of a column without errors: what all runs have, to the bit, or their mean.
double mean_cell(std::vector<double> cells) {
    std::erase_if(cells, [](double cell) { return std::isnan(cell); });
    if (cells.empty()) return not_available;
    if (std::equal(cells.begin() + 1, cells.end(), cells.begin())) return cells.front();
    return std::accumulate(cells.begin(), cells.end(), 0.0) / static_cast<double>(cells.size());
}

Json table_json(const Places& tables, std::span<const double> weights) {
    Json json = Json::object();
    for (const auto& [name, first] : tables.front()->items()) {
        if (json.contains(name)) continue;  // an error that came with its mean
        const bool has_error = tables.front()->contains(name + "_error");
        for (std::size_t row = 0; row < first.size(); ++row) {
            std::vector<Estimate> estimates;
            std::vector<double> cells;
            for (const Json* table : tables) {
                cells.push_back(number(at(*table, {name})[row]));
                if (has_error)
                    estimates.push_back({.mean = cells.back(),
                                         .error = number(at(*table, {name + "_error"})[row])});
            }
            if (has_error) {
                // Angles in tables are known by their names.
                const Estimate e =
                    (name.starts_with("becoming_") ? several_directions(estimates, weights)
                                                   : ensemble(estimates, weights))
                        .estimate;
                json[name].push_back(e.mean);
                json[name + "_error"].push_back(e.error);
            } else if (name == "visits") {
                double sum = 0.0;
                for (const double cell : cells) sum += cell;
                json[name].push_back(sum);
            } else {
                json[name].push_back(mean_cell(std::move(cells)));
            }
        }
    }
    return json;
}

/// Rows, tables, and what holds them.
Json measured_together(const Places& places, std::span<const double> weights) {
    const Json& first = *places.front();
    if (is_average(first)) return average_json(places, weights);
    if (first.is_object() && !first.empty() && first.begin()->is_array() &&
        !first.begin()->empty() && !first.begin()->front().is_structured())
        return table_json(places, weights);
    if (!first.is_object()) {
        std::vector<double> cells;
        for (const Json* place : places) cells.push_back(number(*place));
        return mean_cell(std::move(cells));
    }
    Json json = Json::object();
    for (const auto& [name, value] : first.items())
        json[name] = measured_together(inside(places, name), weights);
    return json;
}

/// Steady if all runs are, otherwise the worst of them.
std::string verdict_of(const Json& seeds) {
    for (const char* verdict : {"drifting", "jumping", "switching"})
        if (seeds[verdict] > 0) return verdict;
    return seeds["too_short"] > 0 || seeds["steady"] == 0 ? "too short to tell" : "steady";
}

Json counted(const std::vector<Json>& results) {
    std::int64_t failures = 0, unaveraged = 0, steady = 0, drifting = 0, jumping = 0, switching = 0,
                 too_short = 0;
    for (const Json& r : results) {
        const std::string verdict = steadiness(r);
        if (failed(r)) {
            ++failures;
        } else if (too_short_to_average(r)) {
            ++unaveraged;
            ++too_short;
        } else {
            steady += verdict == "steady" ? 1 : 0;
            drifting += verdict == "drifting" ? 1 : 0;
            jumping += verdict == "jumping" ? 1 : 0;
            switching += verdict == "switching" ? 1 : 0;
            too_short += verdict == "too short to tell" ? 1 : 0;
        }
    }
    const auto runs = static_cast<std::int64_t>(results.size());
    return {{"runs", runs},           {"averaged", runs - failures - unaveraged},
            {"steady", steady},       {"drifting", drifting},
            {"jumping", jumping},     {"switching", switching},
            {"too_short", too_short}, {"too_short_to_average", unaveraged},
            {"failed", failures}};
}

double mean_of(const Places& runs, std::initializer_list<std::string_view> path) {
    double sum = 0.0;
    for (const Json* run : runs) sum += number(at(*run, path));
    return sum / static_cast<double>(runs.size());
}

/// Of one run, on average, in whole ones.
std::int64_t whole_mean(const Places& runs, std::initializer_list<std::string_view> path) {
    return static_cast<std::int64_t>(std::llround(mean_of(runs, path)));
}

}  // namespace

Json replicates(const std::vector<Json>& results) {
    if (results.size() == 1 && !is_run(results.front())) return results.front();
    const Json seeds = counted(results);
    Places runs;
    for (const Json& r : results)
        if (!failed(r) && !too_short_to_average(r)) runs.push_back(&r);
    if (runs.empty()) {
        // Nothing to average: the first that says why.
        const auto why = std::find_if(results.begin(), results.end(), failed);
        if (why != results.end()) return *why;
        return {{"failed",
                 fmt::format("no run had {} swirls after its warm-up, so nothing is averaged.",
                             min_periods_of_an_average)},
                {"seeds", seeds}};
    }
    std::vector<double> periods;
    for (const Json* run : runs)
        periods.push_back(number(at(*run, {"periods"})) - number(at(*run, {"warmup", "periods"})));

    Json all = {{"config", runs.front()->at("config")},
                {"events", {{"total", whole_mean(runs, {"events", "total"})}}},
                {"periods", mean_of(runs, {"periods"})},
                {"warmup", {{"periods", whole_mean(runs, {"warmup", "periods"})}}}};
    for (const char* which : {"by_event", "by_time", "rigid_by_event", "rigid_by_time"}) {
        const bool by_event = std::string_view(which).ends_with("by_event");
        all["rotation"][which] =
            average_json(inside(inside(runs, "rotation"), which),
                         by_event ? std::span<const double>() : std::span<const double>(periods));
    }
    if (at(*runs.front(), {"measured"}).is_object())
        all["measured"] = measured_together(inside(runs, "measured"), periods);
    all["seeds"] = seeds;
    all["seeds"]["scatter"] = all["rotation"]["by_event"]["scatter"];
    all["seeds"]["disagree"] = all["rotation"]["by_event"]["disagree"];
    all["steady_state"] = {{"verdict", verdict_of(seeds)}};
    std::string hashes;
    for (const Json* run : runs) hashes += at(*run, {"state_hash"}).get<std::string>();
    all["state_hash"] = runs.size() == 1 ? hashes : fmt::format("{:016x}", checksum(hashes));
    return all;
}

}  // namespace swirl
