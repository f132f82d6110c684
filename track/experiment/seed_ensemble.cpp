#include "track/experiment/seed_ensemble.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>
#include <string_view>

#include "swirl/io/checksum.hpp"
#include "swirl/run/measurements.hpp"
#include "swirl/statistics/replicates.hpp"
#include "track/experiment/results.hpp"

namespace swirl {
namespace {

/// The same node in the results of all runs.
using Nodes = std::vector<const Json*>;

Nodes inside(const Nodes& nodes, const std::string& name) {
    Nodes found;
    for (const Json* node : nodes) found.push_back(&at(*node, {name}));
    return found;
}

bool is_run(const Json& result) { return at(result, {"rotation"}).is_object(); }

/// True if a run ended before its warm-up, or soon after it.
bool too_short_to_average(const Json& run) {
    const Json& warmup = at(run, {"config", "warmup"});
    const Json& periods = at(run, {"rotation", "mean_by_event", "blocks"});
    return (number(at(run, {"warmup", "periods"})) == 0.0 && warmup != 0) ||
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

/// `name` is that of the registry, measure/quantities.hpp.
Ensemble ensemble_of(const Nodes& averages, std::span<const double> weights,
                     const std::string& name) {
    std::vector<Estimate> estimates;
    for (const Json* average : averages) estimates.push_back(estimate_in(*average));
    return is_direction(name) ? several_directions(estimates, weights)
                              : ensemble(estimates, weights);
}

Json average_json(const Nodes& averages, std::span<const double> weights,
                  const std::string& full_name) {
    const Ensemble all = ensemble_of(averages, weights, full_name);
    Json json{{"mean", all.estimate.mean},
              {"error", all.estimate.error},
              {"effective_samples", all.estimate.effective_samples},
              {"blocks", all.estimate.blocks},
              {"scatter", all.scatter},
              {"disagree", all.disagree}};
    // Further numbers have no errors: counts add up, others are averaged.
    for (const auto& [name, first] : averages.front()->items()) {
        if (json.contains(name)) continue;
        double sum = 0.0;
        for (const Json* average : averages) sum += number(at(*average, {name}));
        json[name] = name == "count" ? sum : sum / static_cast<double>(averages.size());
    }
    return json;
}

/// The common value of all runs, bitwise, or their mean.
double mean_cell(std::vector<double> cells) {
    std::erase_if(cells, [](double cell) { return std::isnan(cell); });
    if (cells.empty()) return not_available;
    if (std::equal(cells.begin() + 1, cells.end(), cells.begin())) return cells.front();
    return std::accumulate(cells.begin(), cells.end(), 0.0) / static_cast<double>(cells.size());
}

std::vector<double> cells_of(const Nodes& tables, const std::string& column, std::size_t row) {
    std::vector<double> cells;
    for (const Json* table : tables) cells.push_back(number(at(*table, {column})[row]));
    return cells;
}

/// Adds the combined rows of a column; errors are in the column NAME_error.
void add_column_with_errors(Json& json, const std::string& name, const Nodes& tables,
                            std::span<const double> weights, bool angle) {
    for (std::size_t row = 0; row < tables.front()->at(name).size(); ++row) {
        const std::vector<double> means = cells_of(tables, name, row),
                                  errors = cells_of(tables, name + "_error", row);
        std::vector<Estimate> estimates;
        for (std::size_t r = 0; r < means.size(); ++r)
            estimates.push_back({.mean = means[r], .error = errors[r]});
        const Ensemble all =
            angle ? several_directions(estimates, weights) : ensemble(estimates, weights);
        json[name].push_back(all.estimate.mean);
        json[name + "_error"].push_back(all.estimate.error);
    }
}

Json table_json(const Nodes& tables, std::span<const double> weights, const std::string& table) {
    Json json = Json::object();
    for (const auto& [name, first] : tables.front()->items()) {
        if (json.contains(name)) continue;  // an error, added with its mean
        if (tables.front()->contains(name + "_error")) {
            add_column_with_errors(json, name, tables, weights, is_direction(table + "." + name));
            continue;
        }
        for (std::size_t row = 0; row < first.size(); ++row) {
            const std::vector<double> cells = cells_of(tables, name, row);
            json[name].push_back(name == "visits" ? std::accumulate(cells.begin(), cells.end(), 0.0)
                                                  : mean_cell(cells));
        }
    }
    return json;
}

/// Combines averages, tables and numbers, at any depth. `path` is their common name.
Json measured_ensemble(const Nodes& nodes, std::span<const double> weights,
                       const std::string& path = "") {
    const Json& first = *nodes.front();
    if (is_average(first)) return average_json(nodes, weights, path);
    if (first.is_object() && !first.empty() && first.begin()->is_array() &&
        !first.begin()->empty() && !first.begin()->front().is_structured())
        return table_json(nodes, weights, path);
    if (!first.is_object()) {
        std::vector<double> cells;
        for (const Json* node : nodes) cells.push_back(number(*node));
        return mean_cell(std::move(cells));
    }
    Json json = Json::object();
    for (const auto& [name, value] : first.items())
        json[name] = measured_ensemble(inside(nodes, name), weights,
                                       path.empty() ? name : path + "." + name);
    return json;
}

/// "steady" if all runs are, otherwise the worst verdict.
std::string verdict_of(const Json& seeds) {
    for (const char* verdict : {"drifting", "jumping", "switching"})
        if (seeds[verdict] > 0) return verdict;
    return seeds["too_short"] > 0 || seeds["steady"] == 0 ? "too short to tell" : "steady";
}

Json count_seeds(const std::vector<Json>& results) {
    Json count;
    for (const char* name : {"runs", "averaged", "steady", "drifting", "jumping", "switching",
                             "too_short", "too_short_to_average", "failed"})
        count[name] = 0;
    const auto add = [&](const std::string& name) { count[name] = count[name].get<int>() + 1; };
    for (const Json& r : results) {
        add("runs");
        if (failed(r)) {
            add("failed");
        } else if (too_short_to_average(r)) {
            add("too_short_to_average");
            add("too_short");
        } else {
            add("averaged");
            const std::string verdict = steadiness(r);
            add(verdict == "too short to tell" ? "too_short" : verdict);
        }
    }
    return count;
}

double mean_of(const Nodes& runs, std::initializer_list<std::string_view> path) {
    double sum = 0.0;
    for (const Json* run : runs) sum += number(at(*run, path));
    return sum / static_cast<double>(runs.size());
}

/// The mean over the runs, rounded.
std::int64_t whole_mean(const Nodes& runs, std::initializer_list<std::string_view> path) {
    return static_cast<std::int64_t>(std::llround(mean_of(runs, path)));
}

}  // namespace

Json seed_ensemble(const std::vector<Json>& results) {
    if (results.size() == 1 && !is_run(results.front())) return results.front();
    const Json seeds = count_seeds(results);
    Nodes runs;
    for (const Json& r : results)
        if (!failed(r) && !too_short_to_average(r)) runs.push_back(&r);
    if (runs.empty()) {
        const auto failure = std::find_if(results.begin(), results.end(), failed);
        if (failure != results.end()) return *failure;
        return {{"failed",
                 fmt::format("no run has {} periods after its warm-up, so nothing is averaged.",
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
    for (const char* which : {"mean_by_event", "mean_by_time", "rigid_by_event", "rigid_by_time"}) {
        const bool samples_events = std::string_view(which).ends_with("by_event");
        all["rotation"][which] = average_json(
            inside(inside(runs, "rotation"), which),
            samples_events ? std::span<const double>() : std::span<const double>(periods),
            std::string("rotation.") + which);
    }
    if (at(*runs.front(), {"measured"}).is_object())
        all["measured"] = measured_ensemble(inside(runs, "measured"), periods);
    all["seeds"] = seeds;
    all["seeds"]["scatter"] = all["rotation"]["mean_by_event"]["scatter"];
    all["seeds"]["disagree"] = all["rotation"]["mean_by_event"]["disagree"];
    all["steady_state"] = {{"verdict", verdict_of(seeds)}};
    std::string hashes;
    for (const Json* run : runs) hashes += at(*run, {"state_hash"}).get<std::string>();
    all["state_hash"] = runs.size() == 1 ? hashes : fmt::format("{:016x}", checksum(hashes));
    return all;
}

}  // namespace swirl
