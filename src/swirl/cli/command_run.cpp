// swirl run: one simulation, from its seed to its averages.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "swirl/cli/command_line.hpp"
#include "swirl/cli/commands.hpp"
#include "swirl/cli/config_file.hpp"
#include "swirl/cli/output.hpp"
#include "swirl/cli/overwriting.hpp"
#include "swirl/cli/progress_line.hpp"
#include "swirl/cli/recording_options.hpp"
#include "swirl/cli/run_options.hpp"
#include "swirl/cli/stop_signal.hpp"
#include "swirl/io/optional_file.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/json.hpp"
#include "swirl/run/measurements.hpp"
#include "swirl/run/period_series.hpp"
#include "swirl/run/report.hpp"
#include "swirl/run/run.hpp"
#include "swirl/statistics/few_blocks.hpp"

namespace swirl {
namespace {

namespace fs = std::filesystem;
using OptionTexts = std::map<std::string, std::string*>;

struct RunCall {
    std::shared_ptr<ParameterTexts> parameters;
    std::shared_ptr<RecordingCall> recording;
    std::string json, measure, tables;
    bool quiet = false, verbose = false, dry_run = false;

    /// The options that may also be in the configuration file and in a checkpoint.
    OptionTexts output_options() {
        return {{"json", &json}, {"measure", &measure}, {"tables", &tables}};
    }
};

/// A call with all its options resolved.
struct PreparedRun {
    std::string config_text;  // text of the configuration file
    RunConfig config;
    Observation observation;
    RunFiles files;
    std::vector<fs::path> tables;
    std::optional<PeriodSeries> series = {};
};

/// Returns the text of the file.
std::string apply_config_file(RunCall& call) {
    const std::string& file = call.recording->config_file;
    if (file.empty()) return "";
    const OptionTexts outputs = call.output_options();
    std::vector<std::string> names = parameter_names();
    for (const std::string& name : recording_option_names()) names.push_back(name);
    for (const auto& [name, text] : outputs) names.push_back(name);
    const ConfigFile from_file = read_config_file(file, names, Lists::rejected, "run");
    *call.parameters = overridden(from_file.parameters, *call.parameters);
    fill_empty(from_file.others, outputs);
    ParameterTexts recording = from_file.others;
    for (const auto& [name, text] : outputs) recording.erase(name);
    add_options_from_file(*call.recording, std::move(recording));
    return from_file.text;
}

bool gives_only_the_length(const ParameterTexts& given) {
    return std::all_of(given.begin(), given.end(), [](const auto& parameter) {
        return parameter.first == "events" || parameter.first == "periods";
    });
}

/// `--checkpoint FILE --resume`, with at most a new length, repeats the call that is stored in the
/// checkpoint.
void apply_call_in_checkpoint(RunCall& call) {
    const auto checkpoint = call.recording->texts.find("checkpoint");
    if (!call.recording->resume || checkpoint == call.recording->texts.end() ||
        !gives_only_the_length(*call.parameters))
        return;
    const OptionTexts outputs = call.output_options();
    const std::vector<std::string> recording = recording_option_names();
    const CheckpointedCall stored = call_in_checkpoint(checkpoint->second);
    *call.parameters = overridden(parameters_in(stored.configuration), *call.parameters);
    for (const auto& [name, text] : stored.options) {
        const auto output = outputs.find(name);
        if (output == outputs.end())
            call.recording->texts.try_emplace(present_name(name, recording).value_or(name), text);
        else if (output->second->empty())
            *output->second = text;
    }
}

std::vector<std::string> measurements_of(const RunCall& call) {
    if (call.measure.empty() && !call.tables.empty())
        throw UsageError("--tables also needs --measure LIST.");
    if (call.measure.empty()) return {};
    return read_measurement_list(call.measure);
}

void reject_output_conflicts(const RunCall& call, const PreparedRun& prepared) {
    if (!call.json.empty() && call.json != "-") reject_unwritable(call.json);
    const RunFiles& files = prepared.files;
    std::vector<fs::path> all = prepared.tables;
    all.insert(all.end(), {call.recording->config_file, call.json, files.trajectory,
                           files.event_log, files.series, files.checkpoint, call.tables});
    reject_same_files(all);
}

PreparedRun prepare(RunCall& call) {
    const std::string config_text = apply_config_file(call);
    apply_call_in_checkpoint(call);
    const RunConfig config = resolve(*call.parameters);
    PreparedRun prepared{
        config_text, config, observation_of(config, measurements_of(call)), {}, {}};
    const std::vector<std::string>& names = prepared.observation.names();
    prepared.files = run_files(*call.recording, config, names, call.json);
    prepared.files.warn = print_warning;
    prepared.files.call = call.recording->texts;
    for (const auto& [name, text] : call.output_options())
        if (!text->empty()) prepared.files.call[name] = *text;
    if (!call.tables.empty()) prepared.tables = measured_table_files(names, call.tables);
    reject_output_conflicts(call, prepared);
    if (!prepared.files.series.empty()) prepared.series.emplace(config, names);
    return prepared;
}

void print_checkpoint_notes(const RunFiles& files) {
    const bool exists = file_exists(files.checkpoint);
    if (files.resume && !exists)
        print_note(fmt::format("there is no checkpoint '{}'; the run starts from the beginning.",
                               files.checkpoint.string()));
    if (files.overwrite && exists)
        print_note(fmt::format("the checkpoint of an interrupted run is saved as '{}'.",
                               backup_name(files.checkpoint).string()));
}

RunResult run_with_progress(PreparedRun& prepared, bool quiet) {
    const RunConfig& config = prepared.config;
    ProgressLine line(counted(config.discs, body_word(config)), quiet);
    RunControl control;
    control.stop = &stop_signal();
    control.progress = [&](const RunProgress& progress) {
        line.show_events(progress.fraction, progress.events);
    };
    if (!prepared.observation.empty()) control.observation = &prepared.observation;
    if (prepared.series) control.series = &*prepared.series;
    return run_recorded(config, prepared.files, control,
                        provenance_of(config, command_line(), stored_config(prepared.config_text)));
}

nlohmann::ordered_json json_of(const RunResult& result, const PreparedRun& prepared,
                               const MeasurementReports& measured) {
    nlohmann::ordered_json json = result_json(result);
    json["command"] = command_line();
    json["config_text"] = stored_config(prepared.config_text);
    if (!measured.empty()) json["measured"] = measured_json(measured);
    if (prepared.series) {
        json["series"] = series_json(*prepared.series);
        json["series"]["file"] = stored_path(prepared.files.series.string());
    }
    return json;
}

/// Writes the tables, the result and the report; the warnings come last.
void write_outputs(const RunCall& call, const PreparedRun& prepared, const RunResult& result) {
    const MeasurementReports measured = prepared.observation.report();
    std::string text = call.quiet
                           ? headline(result) + "\n"
                           : report(result, call.verbose) + measured_text(measured, &result.config);
    if (prepared.series && !call.quiet)
        text += (prepared.config.ramps.empty() ? series_text(*prepared.series) : "") +
                fmt::format("wrote {}\n", prepared.files.series.string());
    if (!call.tables.empty())
        for (const auto& file : write_measured_tables(measured, call.tables))
            if (!call.quiet) text += fmt::format("wrote {}\n", file.string());
    const nlohmann::ordered_json json = json_of(result, prepared, measured);
    fs::path file = call.json;
    if (call.json == "-") {
        print_all(json.dump(2) + "\n");
        if (!call.quiet) fmt::print(stderr, "{}", text);
    } else {
        if (!call.json.empty()) file = write_result(prepared.files, call.json, json);
        if (!call.quiet || call.json.empty()) print_all(text);
    }
    for (const std::string& warning : warnings(result)) print_warning(warning);
    if (file == call.json) return;
    remove_checkpoint(prepared.files);
    throw Failure(fmt::format(
        "'{}' now holds the result of another run, or more results of this run, written while this "
        "run was in progress.\nhint: the result of this run is in '{}'.",
        call.json, file.string()));
}

void print_note_on_saved_state(const RunFiles& files) {
    const bool recorded = !files.trajectory.empty() || !files.event_log.empty();
    print_note(fmt::format(
        "the state is saved in '{0}'. To continue, use {1}--checkpoint {0} --resume with more "
        "--events or --periods.",
        files.checkpoint.string(),
        recorded ? "the same command without --trajectory and --log-events (a recording has a "
                   "fixed length) and with "
                 : ""));
}

void finish_checkpoint(const RunCall& call, const RunFiles& files, bool complete) {
    if (complete && !files.keep_checkpoint) return remove_checkpoint(files);
    if (complete) {
        if (!call.quiet) print_note_on_saved_state(files);
        return;
    }
    if (!file_exists(files.checkpoint)) throw Interrupted("stopped before the end of the run.");
    throw Interrupted(
        fmt::format("stopped before the end of the run.\nhint: repeat the command with --resume to "
                    "continue from '{}'.",
                    files.checkpoint.string()));
}

void run_and_report(RunCall& call) {
    if (call.measure == "help") return print_all(measurement_help_text());
    PreparedRun prepared = prepare(call);
    if (call.dry_run)
        return print_all(config_file_text(prepared.config, *call.recording, call.output_options()));
    if (!call.tables.empty()) make_folder(call.tables);
    if (is_done_already(prepared.files, call.json, prepared.config, prepared.observation.names(),
                        prepared.tables)) {
        if (!call.quiet) print_all(fmt::format("'{}' is already complete.\n", call.json));
        return;
    }
    reject_overwriting(prepared.files, call.json, prepared.config);
    if (!call.quiet) print_checkpoint_notes(prepared.files);
    const RunResult result = run_with_progress(prepared, call.quiet);
    write_outputs(call, prepared, result);
    finish_checkpoint(call, prepared.files, result.complete);
}

void add_run_command(Subcommand& subcommand) {
    const auto call = std::make_shared<RunCall>();
    subcommand.divide_help();
    call->parameters = add_run_options(subcommand);
    call->recording = add_recording_options(subcommand);
    const char* const output = "Output";
    subcommand.in(output).add({
        {"--json", &call->json, "File for all results, or - for stdout", "FILE|-"},
        measure_option(call->measure, "Measurements, separated by commas, or all (or help)"),
        {"--tables", &call->tables, "Folder for the measurements as CSV tables", "DIR"},
        omit_paths_option(),
        {"--quiet", &call->quiet, "One line of report and no progress"},
        {"--verbose", &call->verbose, "Also report errors, energy, overlap and time"},
        {"--dry-run", &call->dry_run, "Print the configuration file and do not run"},
    });
    subcommand.set_main_options({"--discs", "--mu", "--body", "--container-radius", "--events",
                                 "--periods", "--warmup", "--seed", "--measure", "--json"});
    subcommand.set_examples({"swirl run --discs 48",
                             "swirl run --discs 48 --measure density,flow --tables maps",
                             "swirl run --discs 28 --mu 0.5 --json -",
                             "swirl run --discs 40 --mu-wall 0 --periods 500 --warmup 100",
                             "swirl run study.toml --discs 40 --trajectory frames.h5",
                             "swirl run --discs 48 --events 1e9 --json out.json --resume"});
    subcommand.explain(
        "Details of the parameters: docs/reference/parameters.md\n\nMeasurements (details: "
        "--measure help):\n" +
        measurement_list_text());
    subcommand.callback([call] { run_and_report(*call); });
}

const Command run_command("run", add_run_command);

}  // namespace
}  // namespace swirl
