// swirl run: one simulation, from its seed to its averages.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "swirl/cli/command_line.hpp"
#include "swirl/cli/commands.hpp"
#include "swirl/cli/config_file.hpp"
#include "swirl/cli/output.hpp"
#include "swirl/cli/overwriting.hpp"
#include "swirl/cli/progress_line.hpp"
#include "swirl/cli/recording_options.hpp"
#include "swirl/cli/run_options.hpp"
#include "swirl/cli/stop_signal.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/json.hpp"
#include "swirl/run/measurements.hpp"
#include "swirl/run/report.hpp"
#include "swirl/run/run.hpp"

namespace swirl {
namespace {

struct RunCall {
    std::shared_ptr<ParameterTexts> parameters;
    std::shared_ptr<RecordingCall> recording;
    std::string json, measure, tables;
    bool quiet = false, dry_run = false;
};

RunResult run_with_progress(const RunConfig& config, const RunFiles& files,
                            const Provenance& provenance, Observation& observation, bool quiet) {
    ProgressLine line(fmt::format("{} {}s", config.discs, body_word(config)), quiet);
    const auto begin = std::chrono::steady_clock::now();
    RunControl control;
    control.stop = &stop_signal();
    control.progress = [&](const RunProgress& progress) {
        const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - begin;
        const double rate = static_cast<double>(progress.events) / elapsed.count();
        line.show(progress.fraction, short_number(rate) + " events/s");
    };
    if (!observation.empty()) control.observation = &observation;
    return run_recorded(config, files, control, provenance);
}

std::vector<std::string> measurements_of(const RunCall& call) {
    if (call.measure.empty() && !call.tables.empty())
        throw UsageError("--tables needs --measure LIST, which says what to write there.");
    if (call.measure.empty()) return {};
    return read_measurement_list(call.measure);
}

/// Returns the text of the file.
std::string take_config_file(const RunCall& call,
                             const std::map<std::string, std::string*>& others) {
    const std::string& file = call.recording->config_file;
    if (file.empty()) return "";
    std::vector<std::string> names = parameter_names();
    for (const std::string& name : recording_option_names()) names.push_back(name);
    for (const auto& [name, text] : others) names.push_back(name);
    const ConfigFile from_file = read_config_file(file, names, Lists::rejected, "run");
    *call.parameters = overridden(from_file.parameters, *call.parameters);
    take_others(from_file.others, others);
    ParameterTexts recording = from_file.others;
    for (const auto& [name, text] : others) recording.erase(name);
    take_recording_options(*call.recording, std::move(recording));
    return from_file.text;
}

/// Nothing else of the run: more of it may be wanted.
bool says_at_most_how_long(const ParameterTexts& given) {
    return std::all_of(given.begin(), given.end(), [](const auto& parameter) {
        return parameter.first == "events" || parameter.first == "periods";
    });
}

/// With nothing but a checkpoint to go on, it says what run it is, and what its call asked for.
void take_call_from_checkpoint(const RunCall& call,
                               const std::map<std::string, std::string*>& others) {
    const auto checkpoint = call.recording->texts.find("checkpoint");
    if (!call.recording->resume || checkpoint == call.recording->texts.end() ||
        !says_at_most_how_long(*call.parameters))
        return;
    const KeptCall kept = call_in_checkpoint(checkpoint->second);
    *call.parameters = overridden(parameters_in(kept.configuration), *call.parameters);
    for (const auto& [name, text] : kept.options) {
        const auto other = others.find(name);
        if (other == others.end())
            call.recording->texts.try_emplace(plain_name(name), text);
        else if (other->second->empty())
            *other->second = text;
    }
}

void run_and_report(RunCall& call) {
    if (call.measure == "help") return print_all(measurement_help_text());
    if (call.measure == "markdown") return print_all(measurement_markdown());
    const std::map<std::string, std::string*> others{
        {"json", &call.json}, {"measure", &call.measure}, {"tables", &call.tables}};
    const std::string config_text = take_config_file(call, others);
    take_call_from_checkpoint(call, others);
    const bool json_to_stdout = call.json == "-";
    const RunConfig config = resolve(*call.parameters);
    Observation observation = observation_of(config, measurements_of(call));
    RunFiles files = run_files(*call.recording, config, observation.names(), call.json);
    files.call = call.recording->texts;
    for (const auto& [name, text] : others)
        if (!text->empty()) files.call[name] = *text;
    if (!call.json.empty() && !json_to_stdout) reject_unwritable(call.json);
    std::vector<std::filesystem::path> tables;
    if (!call.tables.empty()) tables = measured_table_files(observation.names(), call.tables);
    std::vector<std::filesystem::path> all = tables;
    all.insert(all.end(), {call.recording->config_file, call.json, files.trajectory,
                           files.event_log, files.checkpoint, call.tables});
    reject_same_files(all);
    if (!call.tables.empty() && !call.dry_run) make_folder(call.tables);
    if (call.dry_run) return print_all(config_file_text(config, *call.recording, others));
    if (is_done_already(files, call.json, config, observation.names(), tables)) {
        if (!call.quiet) print_all(fmt::format("'{}' is complete already.\n", call.json));
        return;
    }
    reject_to_overwrite(files, call.json);
    files.complain = [](const std::string& what) { fmt::print(stderr, "swirl: {}\n", what); };
    if (files.resume && !std::filesystem::exists(files.checkpoint) && !call.quiet)
        fmt::print(stderr, "swirl: There is no checkpoint '{}'; the run starts at its beginning.\n",
                   files.checkpoint.string());

    if (files.overwrite && std::filesystem::exists(files.checkpoint) && !call.quiet)
        fmt::print(stderr, "swirl: The checkpoint of an interrupted run is kept as '{}'.\n",
                   backup_name(files.checkpoint).string());

    const Provenance provenance = provenance_of(config, command_line(), config_text);
    const RunResult result = run_with_progress(config, files, provenance, observation, call.quiet);

    nlohmann::ordered_json json = result_json(result);
    json["command"] = command_line();
    json["config_text"] = config_text;
    const MeasurementReports measured = observation.report();
    if (!measured.empty()) json["measured"] = measured_json(measured);
    std::string text =
        call.quiet ? headline(result) + "\n" : report(result) + measured_text(measured);
    if (call.quiet)
        for (const std::string& warning : warnings(result))
            fmt::print(stderr, "warning: {}\n", warning);
    if (!call.tables.empty())
        for (const auto& file : write_measured_tables(measured, call.tables))
            if (!call.quiet) text += fmt::format("wrote {}\n", file.string());
    if (json_to_stdout) {
        print_all(json.dump(2) + "\n");
        if (!call.quiet) fmt::print(stderr, "{}", text);
    } else {
        const std::filesystem::path file =
            call.json.empty() ? std::filesystem::path() : write_result(files, call.json, json);
        if (!call.quiet || call.json.empty()) print_all(text);
        if (file != call.json) {
            forget_checkpoint(files);
            throw Failure(fmt::format(
                "'{}' holds the result of another run, or more of this one, which came there while "
                "this one went on; what this one found is in '{}'.",
                call.json, file.string()));
        }
    }
    if (result.complete && files.keep_checkpoint) {
        const bool recorded = !files.trajectory.empty() || !files.event_log.empty();
        if (!call.quiet)
            fmt::print(stderr,
                       "swirl: The state is kept in '{0}'; {1}--checkpoint {0} --resume with more "
                       "--events or --periods goes on.\n",
                       files.checkpoint.string(),
                       recorded
                           ? "a recording knows how long its run is, but the same call without "
                             "--trajectory and --log-events and with "
                           : "");
        return;
    }
    if (result.complete) return forget_checkpoint(files);
    if (!std::filesystem::exists(files.checkpoint))
        throw Interrupted("Stopped before the end of the run.");
    throw Interrupted(fmt::format(
        "Stopped before the end of the run; the same command with --resume goes on from '{}'.",
        files.checkpoint.string()));
}

void add_run_command(Subcommand& subcommand) {
    const auto call = std::make_shared<RunCall>();
    call->parameters = add_run_options(subcommand);
    call->recording = add_recording_options(subcommand);
    subcommand.add_option("--json", call->json, "write everything found to FILE, or - for stdout")
        ->type_name("FILE|-")
        ->group("Output");
    subcommand
        .add_option("--measure", call->measure,
                    "what to measure besides the rotation: names with commas between, or all; help "
                    "lists them")
        ->type_name("LIST")
        ->group("Output");
    subcommand
        .add_option("--tables", call->tables, "write what was measured as CSV tables into DIR")
        ->type_name("DIR")
        ->group("Output");
    subcommand.add_flag("--quiet", call->quiet, "no progress, no report beyond one line")
        ->group("Output");
    subcommand
        .add_flag("--dry-run", call->dry_run,
                  "only print what would be run, as a configuration file")
        ->group("Output");
    subcommand.set_examples({"swirl run --discs 48", "swirl run --discs 28 --mu 0.5 --json -",
                             "swirl run --discs 40 --mu-wall 0 --periods 500 --warmup 100",
                             "swirl run --discs 48 --measure density,flow --tables maps",
                             "swirl run study.toml --discs 40 --trajectory frames.h5",
                             "swirl run --discs 48 --events 1e9 --json out.json --resume"});
    subcommand.explain("To measure:\n" + measurement_list_text());
    subcommand.callback([call] { run_and_report(*call); });
}

const Command run_command(10, "run", "One simulation, from its seed to its averages.",
                          add_run_command);

}  // namespace
}  // namespace swirl
