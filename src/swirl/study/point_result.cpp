#include "swirl/study/point_result.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>

#include "swirl/io/file_error.hpp"
#include "swirl/io/optional_file.hpp"
#include "swirl/measure/cluster_rotation.hpp"
#include "swirl/run/config.hpp"
#include "swirl/run/json.hpp"
#include "swirl/run/parallel_for.hpp"
#include "swirl/run/parse_json.hpp"
#include "swirl/run/shell_word.hpp"
#include "swirl/statistics/few_blocks.hpp"
#include "swirl/study/sweep_folder.hpp"

namespace swirl {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

std::string remove_and_repeat(const SweepPlan& plan) {
    return fmt::format("remove it and run `swirl {}` again.", plan.command());
}

[[noreturn]] void throw_incomplete(const fs::path& file, const SweepPlan& plan) {
    throw FileError(
        fmt::format("'{}' lacks a part of a result, or has a text instead of a number.\nhint: {}",
                    file.string(), remove_and_repeat(plan)));
}

/// Skips the parts of a result that the table does not use, because building them would take most
/// of the time.
bool is_needed(int depth, std::string_view key) {
    if (depth != 1) return true;
    static constexpr std::string_view parts[] = {
        "format", "version",  "point",    "replicate",    "config", "state_hash", "periods",
        "energy", "rotation", "measured", "steady_state", "units",  "warmup"};
    return std::find(std::begin(parts), std::end(parts), key) != std::end(parts);
}

bool identifies(int depth, std::string_view key) {
    static constexpr std::string_view parts[] = {"format", "version", "point",          "replicate",
                                                 "config", "units",   "series_checksum"};
    return depth != 1 || std::find(std::begin(parts), std::end(parts), key) != std::end(parts);
}

/// A search chooses the length of its runs.
Json without_chosen_length(Json config, const SweepPlan& plan) {
    if (plan.search && config.is_object())
        for (const char* name : {"events", "periods"}) config.erase(name);
    return config;
}

void require_format(const fs::path& file, const Json& json, const SweepPlan& plan) {
    if (json.value("format", Json()) == result_format) return;
    throw FileError(fmt::format(
        "'{}' is in format {} of swirl {}, but this program reads format {}.\nhint: collect with "
        "the "
        "program that wrote it, or {}",
        file.string(), json.value("format", Json(0)).dump(),
        json.value("version", std::string("?")), result_format, remove_and_repeat(plan)));
}

/// Detects a result that was copied to another point or into another sweep.
void reject_result_of_another_point(const fs::path& file, const Json& json, const SweepPlan& plan,
                                    std::size_t point) {
    const bool belongs = json.at("point") == point && json.at("replicate") == plan.replica(point) &&
                         without_chosen_length(json.at("config"), plan) ==
                             without_chosen_length(config_json(plan.config(point)), plan);
    if (!belongs)
        throw FileError(fmt::format("'{}' is not the result of point {} of this {}.\nhint: {}",
                                    file.string(), point, plan.kind(), remove_and_repeat(plan)));
}

/// Before results held their units, rotations were counter-clockwise and values in the units of the
/// configuration. In most runs this is the same.
void reject_result_in_other_units(const fs::path& file, const Json& json, const SweepPlan& plan,
                                  std::size_t point) {
    const RunConfig config = plan.config(point);
    const MeasuredUnits units = units_of(config);
    if (json.contains("units") ||
        (!config.turns_clockwise() && units.r == 1.0 && units.v == 1.0 && units.m == 1.0))
        return;
    throw FileError(
        fmt::format("'{}' counts rotations or measures in other units than this program.\nhint: {}",
                    file.string(), remove_and_repeat(plan)));
}

/// Reads the parts of a result; nothing if there is none, or if its file is not whole.
std::optional<Json> find_parts(const fs::path& folder, const SweepPlan& plan, std::size_t point,
                               bool (*is_part)(int depth, std::string_view key)) {
    const fs::path file = result_file(folder, plan, point);
    const std::optional<std::string> text = read_optional_file(file);
    if (!text) return {};
    Json json = parse_json(*text, is_part);
    if (!json.is_object()) return {};
    try {
        require_format(file, json, plan);
        reject_result_of_another_point(file, json, plan, point);
        reject_result_in_other_units(file, json, plan, point);
    } catch (const nlohmann::json::exception&) {
        throw_incomplete(file, plan);
    }
    return json;
}

}  // namespace

std::vector<bool> whole_results(const fs::path& folder, const SweepPlan& plan,
                                const std::function<bool(std::size_t)>& matters) {
    const std::vector<bool> exists =
        numbered_files(part_of_sweep(folder, "results", plan), ".json", plan.points());
    std::vector<char> whole(exists.size(), 0);  // not bool: threads write neighbours
    constexpr std::size_t batch = 256;
    parallel_for((whole.size() + batch - 1) / batch, [&](std::size_t b) {
        for (std::size_t p = b * batch; p < std::min(whole.size(), (b + 1) * batch); ++p)
            whole[p] = exists[p] && matters(p) && has_whole_result(folder, plan, p);
    });
    return {whole.begin(), whole.end()};
}

bool has_whole_result(const fs::path& folder, const SweepPlan& plan, std::size_t point) {
    return find_parts(folder, plan, point, identifies).has_value();
}

std::string series_checksum(const fs::path& folder, const SweepPlan& plan, std::size_t point) {
    const std::optional<Json> found = find_parts(folder, plan, point, identifies);
    const Json checksum = found ? found->value("series_checksum", Json()) : Json();
    return checksum.is_string() ? checksum.get<std::string>() : "";
}

PointResult read_result(const fs::path& folder, const SweepPlan& plan, std::size_t point) {
    const std::optional<Json> found = find_parts(folder, plan, point, is_needed);
    PointResult result;
    if (!found) return result;
    const Json& json = *found;
    result.exists = true;
    result.quantities.reserve(rotation_rates.size());
    const auto number = [](const Json& value) {
        return value.is_null() ? not_available : value.get<double>();  // throws for a text
    };
    try {
        for (const auto& [name, words] : rotation_rates) {
            const Json& rate = json.at("rotation").at(name);
            result.quantities.push_back(
                {name, Estimate{.mean = number(rate.at("mean")),
                                .error = number(rate.at("error")),
                                .effective_samples = number(rate.at("effective_samples")),
                                .blocks = rate.at("blocks").get<std::size_t>()}});
        }
        if (const auto measured = json.find("measured"); measured != json.end())
            for (auto& quantity : measured_numbers(*measured))
                result.quantities.push_back(std::move(quantity));
        // Before results held their units, they had no factor for few blocks in their errors.
        if (!json.contains("units"))
            for (MeasuredNumber& quantity : result.quantities)
                quantity.estimate = corrected(quantity.estimate);
        // A single disc has no rotation.
        result.has_whole_period = json.at("config").at("discs") == 1 ||
                                  !std::isnan(result.quantities.front().estimate.mean);
        result.energy = number(json.at("energy"));
        result.periods = number(json.at("periods"));
        const double warmup = number(json.at("warmup").at("periods"));
        const bool ended_before = warmup == 0.0 && json.at("config").at("warmup") != 0;
        result.averaged_periods = ended_before ? 0.0 : result.periods - warmup;
        result.state_hash = json.at("state_hash").get<std::string>();
        result.version = json.at("version").get<std::string>();
        result.verdict = json.at("steady_state").at("verdict").get<std::string>();
    } catch (const nlohmann::json::exception&) {
        throw_incomplete(result_file(folder, plan, point), plan);
    }
    return result;
}

std::string command_of_run(const ParameterTexts& parameters, const std::string& more,
                           std::uint64_t seed) {
    std::string command = "swirl run";
    for (const auto& [name, value] : parameters)
        if (name != "seed") command += fmt::format(" {} {}", option_name(name), shell_word(value));
    return command + fmt::format("{} --seed {}", more, seed);
}

Json point_json(const SweepPlan& plan, std::size_t point, const RunResult& result,
                const std::string& command) {
    Json results = result_json(result);
    Json::object_t all;
    all.reserve(results.size() + 6);
    Json json = std::move(all);
    json["format"] = result_format;
    json["point"] = point;
    json["replicate"] = plan.replica(point);
    if (!plan.chain.empty()) {
        json["direction"] = plan.direction(point);
        json["started_from"] = nullptr;
    }
    for (auto& [name, value] : results.items()) json[name] = std::move(value);
    json["command"] = command;
    return json;
}

}  // namespace swirl
