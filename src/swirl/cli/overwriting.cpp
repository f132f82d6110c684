#include "swirl/cli/overwriting.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "swirl/cli/output.hpp"
#include "swirl/io/atomic_file.hpp"
#include "swirl/io/file_error.hpp"
#include "swirl/io/optional_file.hpp"
#include "swirl/io/recording.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/json.hpp"
#include "swirl/run/parse_json.hpp"

namespace swirl {
namespace {

namespace fs = std::filesystem;

using Json = nlohmann::ordered_json;

/// False for an output that the call does not write.
bool is_there(const fs::path& file) { return !file.empty() && file_exists(file); }

/// A regular file that is not empty: mktemp makes an empty one in advance.
bool has_content(const fs::path& file) {
    return !file.empty() && file != "-" && regular_file_exists(file) && fs::file_size(file) > 0;
}

/// True if the recording is whole, belongs to this run and has these frame times. An event log has
/// none, so `frames` is empty.
bool is_recording_of(const fs::path& file, const RunConfig& config, const std::string& frames) try {
    return is_there(file) && recorded_entry(file, "parameters") == config_json(config).dump() &&
           (frames.empty() || recorded_entry(file, "frames") == frames);
} catch (const DamagedFile&) {
    return false;
}

/// The entry of a recording that identifies its run; nothing if the file is damaged.
std::optional<std::string> run_recorded_in(const fs::path& file) try {
    return recorded_entry(file, run_entry);
} catch (const DamagedFile&) {
    return std::nullopt;
}

Json result_in(const fs::path& file) { return parse_json(read_regular_file(file)); }

Json config_in(const Json& result) {
    return result.is_object() ? result.value("config", Json()) : Json();
}

/// The configuration without the length of the run, which an extension changes.
Json without_length(Json config) {
    if (config.is_object())
        for (const char* name : {"events", "periods"}) config.erase(name);
    return config;
}

bool has_all(const Json& result, const std::vector<std::string>& names) {
    const Json measured = result.value("measured", Json::object());
    return std::all_of(names.begin(), names.end(),
                       [&](const std::string& name) { return measured.contains(name); });
}

/// True for a file that a killed run of this configuration left before its first checkpoint. A
/// series is compared line by line while the run repeats it (recorded_run.cpp).
bool is_left_by_this_run(const fs::path& file, const RunFiles& files, const RunConfig& config) {
    if (!files.resume) return false;
    if (file == files.trajectory) return is_recording_of(file, config, frames_entry(files));
    if (file == files.event_log) return is_recording_of(file, config, "");
    return file == files.series;
}

/// A resumed run may replace its own files, and those that it was started to overwrite.
void reject_files_of_another_run(const RunFiles& files, const std::string& json) {
    const bool result = has_content(json);
    if (!result && !is_there(files.trajectory) && !is_there(files.event_log) &&
        !has_content(files.series))
        return;
    const CheckpointedCall saved = call_in_checkpoint(files.checkpoint);
    const auto may_replace = [&](const char* option, const fs::path& file) {
        const auto named = saved.options.find(option);
        return saved.overwrites && named != saved.options.end() && fs::path(named->second) == file;
    };
    for (const auto& [option, file] :
         {std::pair{"trajectory", files.trajectory}, std::pair{"log_events", files.event_log}})
        if (is_there(file) && !may_replace(option, file) && run_recorded_in(file) != saved.run)
            throw Failure(fmt::format(
                "'{}' is damaged, or was recorded by another run than the checkpoint; it was left "
                "unchanged.\nhint: "
                "put back the recording of this run, or start the run again with --overwrite.",
                file.string()));
    const auto series = saved.options.find("series");
    if (has_content(files.series) &&
        (series == saved.options.end() || fs::path(series->second) != files.series))
        throw Failure(fmt::format(
            "'{}' is not the series of the run in the checkpoint; it was left unchanged.\nhint: "
            "rename it or remove it.",
            files.series.string()));
    if (!result || may_replace("json", json)) return;
    const Json of_checkpoint = parse_json(saved.configuration);
    if (without_length(config_in(result_in(json))) != without_length(of_checkpoint))
        throw Failure(
            fmt::format("'{}' is not a result of the run in the checkpoint; it was left "
                        "unchanged.\nhint: rename it or remove it.",
                        json));
}

/// True if no information would be lost, or overwriting was requested.
bool may_replace(const RunFiles& files, const std::string& json, const Json& result) {
    if (files.overwrite || files.resume || !has_content(json)) return true;
    const Json there = result_in(json);
    if (config_in(there) != config_in(result)) return false;
    const auto is_complete = [](const Json& r) {
        return r.value("complete", Json()) == Json(true);
    };
    std::vector<std::string> measured;
    const Json all = there.value("measured", Json::object());
    for (const auto& [name, found] : all.items()) measured.push_back(name);
    return is_complete(result) >= is_complete(there) && has_all(result, measured);
}

}  // namespace

bool is_done_already(const RunFiles& files, const std::string& json, const RunConfig& config,
                     const std::vector<std::string>& measured,
                     const std::vector<fs::path>& tables) {
    if (!files.resume || is_there(files.checkpoint) || !has_content(json)) return false;
    const Json there = result_in(json);
    if (!there.is_object() || !there.value("complete", false) ||
        config_in(there) != config_json(config) || !has_all(there, measured))
        return false;
    return std::all_of(tables.begin(), tables.end(), is_there) &&
           (files.trajectory.empty() ||
            is_recording_of(files.trajectory, config, frames_entry(files))) &&
           (files.event_log.empty() || is_recording_of(files.event_log, config, "")) &&
           (files.series.empty() || has_content(files.series));
}

void reject_overwriting(const RunFiles& files, const std::string& json, const RunConfig& config) {
    if (files.overwrite) return;
    if (files.resume && is_there(files.checkpoint)) return reject_files_of_another_run(files, json);
    if (is_there(files.checkpoint))
        throw Failure(
            fmt::format("'{}' is the checkpoint of an interrupted run.\nhint: continue it with "
                        "--resume, or start "
                        "again with --overwrite, which renames it to '{}'.",
                        files.checkpoint.string(), backup_name(files.checkpoint).string()));
    for (const fs::path& file : {fs::path(json), files.trajectory, files.event_log, files.series})
        if (has_content(file) && !is_left_by_this_run(file, files, config))
            throw Failure(
                fmt::format("'{}' already exists.\nhint: choose another name, or use "
                            "--overwrite to replace it.",
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
        if (const fs::path second = unused_name(json + ".second"); write_new_file(second, text))
            return second;
}

}  // namespace swirl
