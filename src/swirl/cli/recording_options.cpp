#include "swirl/cli/recording_options.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

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
    {"trajectory", "FILE.h5", "record frames (HDF5, H5MD)"},
    {"frames", "N", "frames per swirl, at equal phases; 1 is stroboscopic [30]"},
    {"frame_interval", "TIME", "a frame every TIME, instead of --frames"},
    {"frame_events", "N", "a frame after every N events, instead of --frames"},
    {"compression", "quick|0..9",
     "of the recordings: quick leaves out what repeats from frame to frame; 0: none; 1…9: "
     "deflate, smaller and slower [quick]"},
    {"log_events", "FILE.h5", "record every event with its impulses"},
    {"checkpoint", "FILE", "where to keep the state of the run [named after its other files]"},
    {"checkpoint_every", "SECONDS", "how often to keep it; 0: never [60]"},
};

/// Each says when a frame is taken.
constexpr const char* frame_times_options[] = {"frames", "frame_interval", "frame_events"};

std::string text_of(const RecordingCall& call, std::string_view name) {
    const auto found = call.texts.find(name);
    return found == call.texts.end() ? "" : found->second;
}

double number(const RecordingCall& call, const char* name, double otherwise, double from,
              const char* right) {
    const std::string text = text_of(call, name);
    if (text.empty()) return otherwise;
    const auto value = read_number(text);
    if (!value || *value < from)
        throw UsageError(
            fmt::format("{} is '{}', but it must be {}.", option_name(name), text, right));
    return *value;
}

std::int64_t whole(const RecordingCall& call, const char* name, std::int64_t otherwise,
                   std::int64_t from, std::int64_t to) {
    const std::string text = text_of(call, name);
    if (text.empty()) return otherwise;
    const auto value = read_whole_number(text);
    if (!value || *value < from || *value > to)
        throw UsageError(fmt::format("{} is '{}', but it must be a whole number from {} to {}.",
                                     option_name(name), text, from, to));
    return *value;
}

int compression(const RecordingCall& call) {
    const std::string text = text_of(call, "compression");
    if (text.empty() || text == "quick") return quick_compression;
    const auto value = read_whole_number(text);
    if (!value || *value < 0 || *value > 9)
        throw UsageError(fmt::format(
            "--compression is '{}', but it must be quick or a whole number from 0 to 9.", text));
    return static_cast<int>(*value);
}

FrameTimes frame_times(const RecordingCall& call) {
    constexpr std::int64_t maximum = 1'000'000'000;
    FrameTimes times;
    int given = 0;
    for (const char* name : frame_times_options) given += text_of(call, name).empty() ? 0 : 1;
    if (given > 1)
        throw UsageError(
            "--frames, --frame-interval and --frame-events each say when a frame is taken; give "
            "one of them.");
    if (given > 0 && text_of(call, "trajectory").empty())
        throw UsageError("Frames are asked for without a file for them; add --trajectory FILE.h5.");
    times.per_swirl = static_cast<int>(whole(call, "frames", times.per_swirl, 1, 1'000'000));
    if (!text_of(call, "frame_interval").empty())
        times.interval =
            number(call, "frame_interval", 0.0, 1e-9, "a time of at least 1e-9, for example 0.1");
    if (!text_of(call, "frame_events").empty())
        times.events = whole(call, "frame_events", 1, 1, maximum);
    return times;
}

std::string default_checkpoint(const RunFiles& files, const RunConfig& config,
                               const std::vector<std::string>& measured, const std::string& json) {
    for (const std::string& name :
         {json == "-" ? std::string() : json, files.trajectory.string(), files.event_log.string()})
        if (!name.empty()) return name + ".checkpoint";
    return fmt::format("swirl-{:08x}.checkpoint",
                       static_cast<std::uint32_t>(checksum(
                           config_text(config) + fmt::format("{}", fmt::join(measured, ",")))));
}

/// A number that is read back as it is written: TOML takes no 007, and the file 1e5 is not 100000.
bool is_bare_number(const std::string& text) {
    if (const auto whole = read_whole_number(text)) return fmt::format("{}", *whole) == text;
    const auto number = read_number(text);
    return number && std::isfinite(*number) && fmt::format("{}", *number) == text;
}

/// A bare number as it is, anything else in quotes.
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
    subcommand
        .add_option("config", call->config_file,
                    "a TOML file with the names of the options; options given here override it")
        ->type_name("FILE.toml");
    for (const RecordingOption& option : options) {
        const std::string name = option.name;
        subcommand
            .add_option_function(
                option_name(name),
                [call, name](const std::string& text) {
                    if (text.empty())
                        throw UsageError(
                            fmt::format("{} is empty, but it needs a value.", option_name(name)));
                    call->texts[name] = text;
                },
                option.description)
            ->type_name(option.value)
            ->group(group);
    }
    subcommand
        .add_flag("--resume", call->resume,
                  "go on from the checkpoint, if there is one, to the same result bit for bit")
        ->group(group);
    subcommand
        .add_flag("--overwrite", call->overwrite,
                  "begin anew over files that are there; a checkpoint is kept as NAME.backup")
        ->group(group);
    subcommand
        .add_flag("--keep-checkpoint", call->keep_checkpoint,
                  "keep the state at the end of the run: --resume with more --events or --periods "
                  "goes on from there")
        ->group(group);
    return call;
}

std::vector<std::string> recording_option_names() {
    std::vector<std::string> names;
    for (const RecordingOption& option : options) names.emplace_back(option.name);
    return names;
}

void take_recording_options(RecordingCall& call, ParameterTexts from_file) {
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
    files.compression = compression(call);
    files.resume = call.resume;
    if (call.resume && call.overwrite)
        throw UsageError("--resume goes on, --overwrite begins anew; give one of them.");
    files.checkpoint_every = number(call, "checkpoint_every", files.checkpoint_every, 0.0,
                                    "a number of seconds, or 0 for no checkpoints");
    files.checkpoint = text_of(call, "checkpoint");
    files.keep_checkpoint = call.keep_checkpoint;
    files.checkpoint_needed = call.resume || call.keep_checkpoint || !files.checkpoint.empty() ||
                              !text_of(call, "checkpoint_every").empty();
    const bool nothing_named = files.checkpoint.empty() && (json.empty() || json == "-") &&
                               files.trajectory.empty() && files.event_log.empty();
    // The checkpoint of a run that was to leave nothing behind is set aside without a question.
    files.overwrite = call.overwrite || (nothing_named && !call.resume);
    if (files.checkpoint.empty())
        files.checkpoint = default_checkpoint(files, config, measured, json);
    reject_same_files({files.trajectory, files.event_log, files.checkpoint, json});
    if (files.checkpoint_every == 0.0) {
        if (call.resume)
            throw UsageError(
                "--resume needs a checkpoint, but --checkpoint-every 0 asks for none.");
        if (call.keep_checkpoint)
            throw UsageError(
                "--keep-checkpoint keeps a checkpoint, but --checkpoint-every 0 asks for none.");
        files.checkpoint.clear();
    }
    for (const auto& file : {files.trajectory, files.event_log})
        if (!file.empty()) {
            reject_unwritable(file);
            reject_to_replace(file);
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
        if (const auto found = texts.find(p.name); found != texts.end()) add(p.name, found->second);
    for (const auto& [name, value] : recording.texts) add(name, value);
    for (const auto& [name, value] : others)
        if (!value->empty()) add(name, *value);
    return text;
}

}  // namespace swirl
