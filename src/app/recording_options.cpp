#include "swirl/app/recording_options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>

#include "swirl/app/output.hpp"
#include "swirl/files/checksum.hpp"
#include "swirl/files/config.hpp"
#include "swirl/files/file_error.hpp"
#include "swirl/files/whole_file.hpp"
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
    {"frame-interval", "TIME", "a frame every TIME, instead of --frames"},
    {"frame-events", "N", "a frame after every N events, instead of --frames"},
    {"compression", "quick|0..9",
     "of the recordings: quick leaves out what repeats from frame to frame; 0: none; 1…9: "
     "deflate, smaller and slower [quick]"},
    {"log-events", "FILE.h5", "record every event with its impulses"},
    {"checkpoint", "FILE", "where to keep the state of the run [named after its other files]"},
    {"checkpoint-every", "SECONDS", "how often to keep it; 0: never [60]"},
};

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
        throw WrongCall(fmt::format("--{} is '{}', but it must be {}.", name, text, right));
    return *value;
}

std::int64_t whole(const RecordingCall& call, const char* name, std::int64_t otherwise,
                   std::int64_t from, std::int64_t to) {
    const std::string text = text_of(call, name);
    if (text.empty()) return otherwise;
    const auto value = read_whole_number(text);
    if (!value || *value < from || *value > to)
        throw WrongCall(fmt::format("--{} is '{}', but it must be a whole number from {} to {}.",
                                    name, text, from, to));
    return *value;
}

int compression(const RecordingCall& call) {
    const std::string text = text_of(call, "compression");
    if (text.empty() || text == "quick") return quick_compression;
    const auto value = read_whole_number(text);
    if (!value || *value < 0 || *value > 9)
        throw WrongCall(fmt::format(
            "--compression is '{}', but it must be quick or a whole number from 0 to 9.", text));
    return static_cast<int>(*value);
}

FrameTimes frame_times(const RecordingCall& call) {
    constexpr std::int64_t most = 1'000'000'000;
    FrameTimes times;
    int given = 0;
    for (const char* name : {"frames", "frame-interval", "frame-events"})
        given += text_of(call, name).empty() ? 0 : 1;
    if (given > 1)
        throw WrongCall(
            "--frames, --frame-interval and --frame-events each say when a frame is taken; give "
            "one of them.");
    if (given > 0 && text_of(call, "trajectory").empty())
        throw WrongCall("Frames are asked for without a file for them; add --trajectory FILE.h5.");
    times.per_swirl = static_cast<int>(whole(call, "frames", times.per_swirl, 1, 1'000'000));
    if (!text_of(call, "frame-interval").empty())
        times.interval =
            number(call, "frame-interval", 0.0, 1e-9, "a time of at least 1e-9, for example 0.1");
    if (!text_of(call, "frame-events").empty())
        times.events = whole(call, "frame-events", 1, 1, most);
    return times;
}

std::string default_checkpoint(const RunFiles& files, const RunConfig& config,
                               const std::string& json) {
    for (const std::string& name :
         {json == "-" ? std::string() : json, files.trajectory.string(), files.event_log.string()})
        if (!name.empty()) return name + ".checkpoint";
    return fmt::format("swirl-{:08x}.checkpoint",
                       static_cast<std::uint32_t>(checksum(config_json(config).dump())));
}

void refuse_same_names(const RunFiles& files, const std::string& json) {
    std::vector<std::string> names{files.trajectory.string(), files.event_log.string(),
                                   files.checkpoint.string(), json};
    std::erase(names, "");
    std::sort(names.begin(), names.end());
    const auto twice = std::adjacent_find(names.begin(), names.end());
    if (twice != names.end())
        throw WrongCall(
            fmt::format("'{}' is the name of two files; each needs a name of its own.", *twice));
}

/// What is wrong in a configuration is wrong in the call.
Config parsed(const std::string& file) {
    std::error_code ignored;
    if (!std::filesystem::exists(file, ignored))
        throw WrongCall(fmt::format(
            "There is no configuration file '{}'; options begin with --, as in --discs 48.", file));
    std::string text = read_whole_file(file);
    try {
        return parse_config(std::move(text), file);
    } catch (const FileError& wrong) {
        throw WrongCall(wrong.what());
    }
}

/// A bare number as it is, anything else in quotes.
std::string toml_value(const std::string& text) {
    if (read_whole_number(text) || read_number(text)) return text;
    std::string quoted = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') quoted += '\\';
        quoted += c;
    }
    return quoted + '"';
}

}  // namespace

std::shared_ptr<RecordingCall> add_recording_options(CLI::App& subcommand) {
    auto call = std::make_shared<RecordingCall>();
    subcommand
        .add_option("config", call->config_file,
                    "a TOML file with the names of the options; options given here override it")
        ->type_name("FILE.toml");
    for (const RecordingOption& option : options) {
        const std::string name = option.name;
        subcommand
            .add_option_function<std::string>(
                "--" + name,
                [call, name](const std::string& text) {
                    if (text.empty())
                        throw WrongCall(fmt::format("--{} is empty, but it needs a value.", name));
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
    return call;
}

std::string take_config_file(RecordingCall& recording, ParameterTexts& parameters,
                             std::map<std::string, std::string*> others) {
    if (recording.config_file.empty()) return "";
    const Config config = parsed(recording.config_file);
    std::vector<std::string> run_names, recording_names, names;
    for (const RunParameter& p : run_parameters()) run_names.push_back(p.name);
    for (const RecordingOption& option : options) recording_names.push_back(option.name);
    for (const auto* list : {&run_names, &recording_names})
        names.insert(names.end(), list->begin(), list->end());
    for (const auto& [name, target] : others) names.push_back(name);

    const auto in = [](const std::vector<std::string>& list, const std::string& name) {
        return std::find(list.begin(), list.end(), name) != list.end();
    };
    for (const auto& [name, entry] : config.entries) {
        const std::string at = fmt::format("'{}', line {}", recording.config_file, entry.line);
        if (!in(names, name)) {
            const auto meant = nearest_name(name, names);
            throw WrongCall(fmt::format("{}: there is no option '{}'{}", at, name,
                                        meant ? fmt::format("; did you mean '{}'?", *meant)
                                              : "; `swirl run --help` lists them."));
        }
        if (entry.is_list)
            throw WrongCall(fmt::format(
                "{}: {} is a list, but one run needs one value; `swirl sweep` takes lists.", at,
                name));
        // What a group of options means together is decided by the command line if it says any.
        if (in(run_names, name)) {
            const bool length = name == "events" || name == "periods";
            if (length && (parameters.contains("events") || parameters.contains("periods")) &&
                !parameters.contains(name))
                continue;
            parameters.try_emplace(name, entry.values.front());
        } else if (in(recording_names, name)) {
            recording.texts.try_emplace(name, entry.values.front());
        } else if (others[name]->empty()) {
            *others[name] = entry.values.front();
        }
    }
    return config.text;
}

RunFiles run_files(const RecordingCall& call, const RunConfig& config, const std::string& json) {
    RunFiles files;
    files.trajectory = text_of(call, "trajectory");
    files.frames = frame_times(call);
    files.event_log = text_of(call, "log-events");
    files.compression = compression(call);
    files.resume = call.resume;
    if (call.resume && call.overwrite)
        throw WrongCall("--resume goes on, --overwrite begins anew; give one of them.");
    files.checkpoint_every = number(call, "checkpoint-every", files.checkpoint_every, 0.0,
                                    "a number of seconds, or 0 for no checkpoints");
    files.checkpoint = text_of(call, "checkpoint");
    files.checkpoint_needed =
        call.resume || !files.checkpoint.empty() || !text_of(call, "checkpoint-every").empty();
    const bool nothing_named = files.checkpoint.empty() && (json.empty() || json == "-") &&
                               files.trajectory.empty() && files.event_log.empty();
    // The checkpoint of a run that was to leave nothing behind is set aside without a question.
    files.overwrite = call.overwrite || (nothing_named && !call.resume);
    if (files.checkpoint.empty()) files.checkpoint = default_checkpoint(files, config, json);
    refuse_same_names(files, json);
    if (files.checkpoint_every == 0.0) {
        if (call.resume)
            throw WrongCall("--resume needs a checkpoint, but --checkpoint-every 0 asks for none.");
        files.checkpoint.clear();
    }
    for (const auto& file : {files.trajectory, files.event_log})
        if (!file.empty()) refuse_unwritable(file);
    if (files.checkpoint_needed && !files.checkpoint.empty()) refuse_unwritable(files.checkpoint);
    return files;
}

std::string config_file_text(const RunConfig& config, const RecordingCall& recording,
                             const std::map<std::string, std::string*>& others) {
    std::string text;
    const auto add = [&](const std::string& name, const std::string& value) {
        text += fmt::format("{} = {}\n", name, toml_value(value));
    };
    const ParameterTexts resolved = parameters_in(config_json(config));
    for (const RunParameter& p : run_parameters())
        if (const auto found = resolved.find(p.name); found != resolved.end())
            add(p.name, found->second);
    for (const auto& [name, value] : recording.texts) add(name, value);
    for (const auto& [name, value] : others)
        if (!value->empty()) add(name, *value);
    return text;
}

}  // namespace swirl
