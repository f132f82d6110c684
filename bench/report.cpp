#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "scene_rates.hpp"
#include "swirl/io/table.hpp"
#include "swirl/run/version.hpp"

namespace swirl {
namespace {

std::string millions(const std::optional<double>& rate) {
    return rate ? fmt::format("{:.3g}", *rate / 1e6) : "-";
}
std::string times(const std::optional<double>& ratio) {
    if (!ratio) return "-";
    return *ratio < 100.0 ? fmt::format("{:.3g}", *ratio) : fmt::format("{:.0f}", *ratio);
}
std::string verdict(const std::optional<double>& found, const std::optional<double>& target) {
    return !found || !target ? "" : *found >= *target ? "met" : "missed";
}
const char* words(BenchTarget::Bound bound) {
    return bound == BenchTarget::Bound::at_least  ? "at least"
           : bound == BenchTarget::Bound::at_most ? "at most"
                                                  : "below";
}

std::string row_line(const BenchRow& row) {
    return fmt::format(
        "{:<34}{:>8}  {:<9}{:>7}{:>10}  {:<15}{:>6}{:>5} {:<7}{:>6.0f}{:>7.3f}{:>8.3f}\n",
        row.scene, row.discs, row.width, millions(row.rate), millions(row.baseline_rate),
        row.baseline, times(row.ratio()), times(row.ratio_target),
        verdict(row.ratio(), row.ratio_target), row.bytes_per_disc, row.invalidated,
        row.list_rebuilds);
}

std::string target_line(const BenchTarget& target) {
    std::string line = fmt::format("{:<92}{:>8}", target.name, fmt::format("{:.3g}", target.value));
    if (target.target)
        line += fmt::format(" {:<6}{:<9}{:<6}{}", target.unit, words(target.bound),
                            fmt::format("{:.3g}", *target.target), target.met() ? "met" : "missed");
    return line + "\n";
}

nlohmann::ordered_json or_null(const std::optional<double>& x) {
    return x ? nlohmann::ordered_json(*x) : nlohmann::ordered_json(nullptr);
}

nlohmann::ordered_json target_json(const BenchTarget& target) {
    nlohmann::ordered_json r{{"name", target.name},
                             {"value", target.value},
                             {"unit", target.unit},
                             {"must_be", words(target.bound)},
                             {"target", or_null(target.target)}};
    r["met"] =
        target.target ? nlohmann::ordered_json(target.met()) : nlohmann::ordered_json(nullptr);
    return r;
}

nlohmann::ordered_json row_json(const BenchRow& row) {
    nlohmann::ordered_json r;
    r["scene"] = row.scene;
    r["discs"] = row.discs;
    r["width"] = row.width;
    r["counts"] = row.counts;
    r["rate"] = row.rate;
    r["baseline"] =
        row.baseline_rate ? nlohmann::ordered_json(row.baseline) : nlohmann::ordered_json(nullptr);
    r["baseline_rate"] = or_null(row.baseline_rate);
    r["ratio"] = or_null(row.ratio());
    r["ratio_target"] = or_null(row.ratio_target);
    r["comparison"] =
        row.comparison ? target_json(*row.comparison) : nlohmann::ordered_json(nullptr);
    r["bytes_per_disc"] = row.bytes_per_disc;
    r["invalidated_per_event"] = row.invalidated;
    r["list_rebuilds_per_event"] = row.list_rebuilds;
    r["path_vertices_per_event"] = row.path_vertices;
    r["vertex_share"] = or_null(row.vertex_share);
    return r;
}

}  // namespace

std::string bench_report(const BenchResult& result) {
    std::string text = fmt::format(
        "swirl {} on {}\nOne thread, processor time. Each scene runs next to the faster of two "
        "baselines:\n\"loop\" searches all pairs for every event, as the paper does; \"lists\" "
        "uses "
        "neighbour lists\nand a calendar of events, as other hard-sphere codes do.\n\n",
        version(), result.machine);
    text += fmt::format("{:<34}{:>8}  {:<9}{:>7}{:>10}  {:<15}{:>6}{:>5} {:<7}{:>6}{:>7}{:>8}\n",
                        "scene", "N", "width", "M/s", "baseline", "", "ratio", "goal", "", "B/disc",
                        "inval.", "rebuilt");
    for (const BenchRow& row : result.rows) text += row_line(row);
    text += fmt::format("\n{:<92}{:>8} {:<6}{}\n", "other comparisons", "value", "", "goal");
    for (const BenchTarget& target : targets_beyond_baselines(result)) text += target_line(target);
    text +=
        "\nM/s: million events per second (collisions in a gas). baseline: its rate with its best "
        "vector width.\nratio: engine / baseline. B/disc: memory of the event loop per disc. "
        "inval.: "
        "invalidated events per event.\nrebuilt: neighbour lists rebuilt or cells entered, per "
        "event.\n";
    return text;
}

std::string bench_json(const BenchResult& result, const std::string& command) {
    nlohmann::ordered_json json;
    json["machine"] = result.machine;
    json["version"] = version();
    json["build"] = build_description();
    json["command"] = command;
    json["targets"] = nlohmann::ordered_json::array();
    for (const auto& targets : {targets_of_ratios(result), targets_beyond_baselines(result)})
        for (const BenchTarget& target : targets) json["targets"].push_back(target_json(target));
    json["rows"] = nlohmann::ordered_json::array();
    for (const BenchRow& row : result.rows) json["rows"].push_back(row_json(row));
    return json.dump(2) + "\n";
}

// The columns are explained in bench/results/README.md.
std::string bench_csv(const BenchResult& result, const std::string& command) {
    Table table({"machine", "version", "command", "scene", "discs", "width", "counts", "rate",
                 "baseline", "baseline_rate", "comparison", "compared", "bytes_per_disc",
                 "invalidated_per_event", "list_rebuilds_per_event", "vertex_share"});
    for (const BenchRow& row : result.rows)
        table.add({result.machine, version(), command, row.scene, row.discs, row.width, row.counts,
                   row.rate, row.baseline, row.baseline_rate.value_or(std::nan("")),
                   row.comparison ? row.comparison->name : "",
                   row.comparison ? row.comparison->value : std::nan(""), row.bytes_per_disc,
                   row.invalidated, row.list_rebuilds, row.vertex_share.value_or(std::nan(""))});
    return table.csv();
}

}  // namespace swirl
