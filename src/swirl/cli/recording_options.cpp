#include "swirl/cli/recording_options.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <tuple>

#include "swirl/cli/output.hpp"
#include "swirl/io/atomic_file.hpp"
#include "swirl/io/checksum.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/json.hpp"

namespace swirl {
namespace {

struct RecordingOption {
    const char* name;
    const char* value;
    const char* description;
};

constexpr const char* group = "Files";

constexpr RecordingOption options[] = {
    {"trajectory", "FILE.h5", "Trajectory file to record (HDF5, H5MD)"},
    {"frames_per_period", "N", "Frames per period, at equal phases; 1 is stroboscopic [30]"},
    {"frame_interval", "TIME", "Time between frames, instead of --frames-per-period"},
    {"frame_events", "N", "Events between frames, instead of --frames-per-period"},
    {"compression", "0..9", "Deflate level of recordings; 0: none, 9: smallest [0]"},
    {"log_events", "FILE.h5", "Event log to record, with all impulses"},
    {"series", "FILE.csv", "Table of the averages of every period (CSV)"},
    {"checkpoint", "FILE", "Checkpoint file [named after the other files of the run]"},
    {"checkpoint_every", "SECONDS", "Time between checkpoints, seconds; 0: none [60]"},
};

/// Alternative ways to set the times of frames.
constexpr const char* frame_times_options[] = {"frames_per_period", "frame_interval",
                                               "frame_events"};

std::string text_of(const RecordingCall& call, std::string_view name) {
    const auto found = call.texts.find(name);
    return found == call.texts.end() ? "" : found->second;
}

double number(const RecordingCall& call, const char* name, double default_value, double minimum,
              const char* constraint) {
    const std::string text = text_of(call, name);
    if (text.empty()) return default_value;
    const auto value = read_number(text);
    if (!value || *value < minimum)
        throw UsageError(
            fmt::format("{} is '{}', but it must be {}.", option_name(name), text, constraint));
    return *value;
}

FrameTimes frame_times(const RecordingCall& call) {
    constexpr std::int64_t maximum = 1'000'000'000;
    FrameTimes times;
    int given = 0;
    for (const char* name : frame_times_options) given += text_of(call, name).empty() ? 0 : 1;
    if (given > 1)
        throw UsageError(
            "--frames-per-period, --frame-interval and --frame-events exclude each other.\n"
            "hint: give one of them.");
    if (given > 0 && text_of(call, "trajectory").empty())
        throw UsageError(
            "the options for frames need a trajectory.\nhint: add --trajectory FILE.h5.");
    times.per_period = static_cast<int>(whole_number(
        "frames_per_period", text_of(call, "frames_per_period"), times.per_period, 1'000'000));
    if (!text_of(call, "frame_interval").empty())
        times.interval =
            number(call, "frame_interval", 0.0, 1e-9, "a time of at least 1e-9, for example 0.1");
    if (!text_of(call, "frame_events").empty())
        times.events = whole_number("frame_events", text_of(call, "frame_events"), 1, maximum);
    return times;
}

std::string default_checkpoint(const RunFiles& files, const RunConfig& config,
                               const std::vector<std::string>& measured, const std::string& json) {
    for (const std::string& name : {json == "-" ? std::string() : json, files.trajectory.string(),
                                    files.event_log.string(), files.series.string()})
        if (!name.empty()) return name + ".checkpoint";
    return fmt::format("swirl-{:08x}.checkpoint",
                       static_cast<std::uint32_t>(checksum(
                           config_text(config) + fmt::format("{}", fmt::join(measured, ",")))));
}

/// True if TOML reads the text as a number that is written the same way. 007 is not valid TOML, and
/// a file named 1e5 must not become 100000.
bool is_bare_number(const std::string& text) {
    if (const auto whole = read_whole_number(text)) return fmt::format("{}", *whole) == text;
    const auto number = read_number(text);
    return number && std::isfinite(*number) && fmt::format("{}", *number) == text;
}

/// Quotes everything but bare numbers.
std::string toml_value(const std::string& text) {
    if (is_bare_number(text)) return text;
    std::string quoted = "\"";
    for (const char c : text) {
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
            quoted += fmt::format("\\u{:04X}", static_cast<unsigned>(c));
            continue;
        }
        if (c == '"' || c == '\\') quoted += '\\';
        quoted += c;
    }
    return quoted + '"';
}

}  // namespace

std::shared_ptr<RecordingCall> add_recording_options(Subcommand& subcommand) {
    auto call = std::make_shared<RecordingCall>();
    subcommand.add({{"config", &call->config_file,
                     "TOML file with option names and values; options override it", "FILE.toml"}});
    for (const RecordingOption& option : options) {
        const std::string name = option.name;
        const auto take = [call, name](const std::string& text) {
            if (text.empty())
                throw UsageError(
                    fmt::format("{} is empty, but it needs a value.", option_name(name)));
            call->texts[name] = text;
        };
        subcommand.in(group).add({{option_name(name), take, option.description, option.value}});
    }
    subcommand.in(group).add({
        {"--resume", &call->resume, "Continue from the checkpoint, if it exists"},
        {"--overwrite", &call->overwrite,
         "Replace existing files; a checkpoint becomes NAME.backup"},
        {"--keep-checkpoint", &call->keep_checkpoint,
         "Keep the final checkpoint; --resume can then extend the run"},
    });
    return call;
}

std::vector<std::string> recording_option_names() {
    std::vector<std::string> names;
    for (const RecordingOption& option : options) names.emplace_back(option.name);
    return names;
}

void add_options_from_file(RecordingCall& call, ParameterTexts from_file) {
    const auto given = [&](const char* name) { return call.texts.contains(name); };
    if (std::any_of(std::begin(frame_times_options), std::end(frame_times_options), given))
        for (const char* name : frame_times_options) from_file.erase(name);
    call.texts.merge(from_file);
}

RunFiles run_files(const RecordingCall& call, const RunConfig& config,
                   const std::vector<std::string>& measured, const std::string& json) {
    RunFiles files;
    files.trajectory = text_of(call, "trajectory");
    files.frames = frame_times(call);
    files.event_log = text_of(call, "log_events");
    files.series = text_of(call, "series");
    for (const auto& [name, file, ending, kind] :
         {std::tuple("trajectory", &files.trajectory, ".h5", "recording is written as HDF5"),
          std::tuple("log-events", &files.event_log, ".h5", "event log is written as HDF5"),
          std::tuple("series", &files.series, ".csv", "table is written as CSV")})
        if (!file->empty() && file->extension() != ending)
            throw UsageError(
                fmt::format("--{} is '{}', but its name must end in {}.\nhint: the {}.", name,
                            file->string(), ending, kind));
    files.compression = static_cast<int>(
        whole_number("compression", text_of(call, "compression"), files.compression, 9, 0));
    files.resume = call.resume;
    if (call.resume && call.overwrite)
        throw UsageError(
            "--resume and --overwrite exclude each other.\nhint: --resume continues a run, "
            "--overwrite starts it again; give one of them.");
    files.checkpoint_every = number(call, "checkpoint_every", files.checkpoint_every, 0.0,
                                    "a number of seconds, or 0 for no checkpoints");
    files.checkpoint = text_of(call, "checkpoint");
    files.keep_checkpoint = call.keep_checkpoint;
    files.checkpoint_needed = call.resume || call.keep_checkpoint || !files.checkpoint.empty() ||
                              !text_of(call, "checkpoint_every").empty();
    const bool has_no_named_file = files.checkpoint.empty() && (json.empty() || json == "-") &&
                                   files.trajectory.empty() && files.event_log.empty() &&
                                   files.series.empty();
    // Without a named file, an old checkpoint is the only file of a run: it is backed up, not an
    // error.
    files.overwrite = call.overwrite || (has_no_named_file && !call.resume);
    if (files.checkpoint.empty())
        files.checkpoint = default_checkpoint(files, config, measured, json);
    reject_same_files({files.trajectory, files.event_log, files.series, files.checkpoint, json});
    if (files.checkpoint_every == 0.0) {
        if (call.resume)
            throw UsageError("--resume needs a checkpoint, but --checkpoint-every is 0.");
        if (call.keep_checkpoint)
            throw UsageError("--keep-checkpoint needs a checkpoint, but --checkpoint-every is 0.");
        files.checkpoint.clear();
    }
    for (const auto& file : {files.trajectory, files.event_log, files.series})
        if (!file.empty()) {
            reject_unwritable(file);
            require_replaceable(file);
        }
    if (files.checkpoint_needed && !files.checkpoint.empty()) reject_unwritable(files.checkpoint);
    return files;
}

std::string config_file_text(const RunConfig& config, const RecordingCall& recording,
                             const std::map<std::string, std::string*>& others) {
    std::string text;
    const auto add = [&](const std::string& name, const std::string& value) {
        text += fmt::format("{} = {}\n", name, toml_value(value));
    };
    const ParameterTexts texts = texts_of(config);
    for (const Parameter& p : run_parameters)
        if (const auto found = texts.find(p.name); found != texts.end())
            add(user_name(p.name), found->second);
    for (const auto& [name, value] : recording.texts) add(name, value);
    for (const auto& [name, value] : others)
        if (!value->empty()) add(name, *value);
    return text;
}

}  // namespace swirl
