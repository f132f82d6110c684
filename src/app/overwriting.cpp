#include "swirl/app/overwriting.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "swirl/files/whole_file.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/json.hpp"

namespace swirl {
namespace {

namespace fs = std::filesystem;

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

}  // namespace

bool is_done_already(const RunFiles& files, const std::string& json, const RunConfig& config) {
    if (!files.resume || is_there(files.checkpoint) || !holds_something(json)) return false;
    for (const fs::path& recording : {files.trajectory, files.event_log})
        if (!recording.empty() && !is_there(recording)) return false;
    const auto there = nlohmann::ordered_json::parse(read_regular_file(json), nullptr, false);
    return there.is_object() && there.value("complete", false) &&
           there.value("config", nlohmann::ordered_json()) == config_json(config);
}

void refuse_to_overwrite(const RunFiles& files, const std::string& json) {
    if (files.overwrite || (files.resume && is_there(files.checkpoint))) return;
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

}  // namespace swirl
