#include "swirl/cli/overwriting.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <utility>

#include "swirl/cli/output.hpp"
#include "swirl/io/atomic_file.hpp"
#include "swirl/io/recording.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/json.hpp"

namespace swirl {
namespace {

namespace fs = std::filesystem;

using Json = nlohmann::ordered_json;

bool is_there(const fs::path& file) {
    std::error_code ignored;
    return !file.empty() && fs::exists(file, ignored);
}

/// Something that is not a device, and not an empty file that somebody made with mktemp.
bool holds_something(const fs::path& file) {
    std::error_code ignored;
    return !file.empty() && file != "-" && fs::is_regular_file(file, ignored) &&
           fs::file_size(file, ignored) > 0;
}

/// Of this very run, and its frames are those that are asked for.
bool is_recording_of(const fs::path& file, const RunConfig& config, const std::string& frames) {
    return is_there(file) && recorded_entry(file, "parameters") == config_json(config).dump() &&
           (frames.empty() || recorded_entry(file, "frames") == frames);
}

Json result_in(const fs::path& file) {
    return Json::parse(read_regular_file(file), nullptr, false);
}

Json config_in(const Json& result) {
    return result.is_object() ? result.value("config", Json()) : Json();
}

/// A run may have become longer.
Json but_for_its_length(Json config) {
    if (config.is_object())
        for (const char* name : {"events", "periods"}) config.erase(name);
    return config;
}

bool holds_all(const Json& result, const std::vector<std::string>& names) {
    const Json measured = result.value("measured", Json::object());
    return std::all_of(names.begin(), names.end(),
                       [&](const std::string& name) { return measured.contains(name); });
}

/// What the run of the checkpoint has left there, it may replace, and what it was to overwrite from
/// the beginning.
void reject_what_another_run_left(const RunFiles& files, const std::string& json) {
    const bool result = holds_something(json);
    if (!result && !is_there(files.trajectory) && !is_there(files.event_log)) return;
    const KeptCall kept = call_in_checkpoint(files.checkpoint);
    const auto may_replace = [&](const char* option, const fs::path& file) {
        const auto named = kept.options.find(option);
        return kept.overwrites && named != kept.options.end() && fs::path(named->second) == file;
    };
    for (const auto& [option, file] :
         {std::pair{"trajectory", files.trajectory}, std::pair{"log_events", files.event_log}})
        if (is_there(file) && !may_replace(option, file))
            reject_recording_of_another(file, kept.run);
    if (!result || may_replace("json", json)) return;
    const Json of_checkpoint = Json::parse(kept.configuration, nullptr, false);
    if (but_for_its_length(config_in(result_in(json))) != but_for_its_length(of_checkpoint))
        throw Failure(fmt::format(
            "'{}' holds something else than the run of the checkpoint has left there, and is left "
            "as it is; choose another name.",
            json));
}

/// Nothing of what is there would be lost, or it is to be.
bool may_replace(const RunFiles& files, const std::string& json, const Json& result) {
    if (files.overwrite || files.resume || !holds_something(json)) return true;
    const Json there = result_in(json);
    if (config_in(there) != config_in(result)) return false;
    const auto is_complete = [](const Json& r) {
        return r.value("complete", Json()) == Json(true);
    };
    std::vector<std::string> measured;
    const Json all = there.value("measured", Json::object());
    for (const auto& [name, found] : all.items()) measured.push_back(name);
    return is_complete(result) >= is_complete(there) && holds_all(result, measured);
}

}  // namespace

bool is_done_already(const RunFiles& files, const std::string& json, const RunConfig& config,
                     const std::vector<std::string>& measured,
                     const std::vector<fs::path>& tables) {
    if (!files.resume || is_there(files.checkpoint) || !holds_something(json)) return false;
    const Json there = result_in(json);
    if (!there.is_object() || !there.value("complete", false) ||
        config_in(there) != config_json(config) || !holds_all(there, measured))
        return false;
    return std::all_of(tables.begin(), tables.end(), is_there) &&
           (files.trajectory.empty() ||
            is_recording_of(files.trajectory, config, frames_entry(files))) &&
           (files.event_log.empty() || is_recording_of(files.event_log, config, ""));
}

void reject_to_overwrite(const RunFiles& files, const std::string& json) {
    if (files.overwrite) return;
    if (files.resume && is_there(files.checkpoint))
        return reject_what_another_run_left(files, json);
    if (is_there(files.checkpoint))
        throw Failure(fmt::format(
            "'{}' is the checkpoint of an interrupted run: --resume goes on with it, --overwrite "
            "begins anew and keeps it as '{}'.",
            files.checkpoint.string(), backup_name(files.checkpoint).string()));
    for (const fs::path& file : {fs::path(json), files.trajectory, files.event_log})
        if (holds_something(file))
            throw Failure(fmt::format(
                "'{}' is there already; choose another name, or give --overwrite to lose it.",
                file.string()));
}

fs::path write_result(const RunFiles& files, const std::string& json, const Json& result) {
    const std::string text = result.dump(2) + "\n";
    std::error_code ignored;
    while (may_replace(files, json, result)) {
        if (fs::symlink_status(json, ignored).type() != fs::file_type::not_found) {
            write_output(json, text);
            return json;
        }
        if (write_new_file(json, text)) return json;
    }
    for (;;)
        if (const fs::path second = free_name(json + ".second"); write_new_file(second, text))
            return second;
}

}  // namespace swirl
