// swirl crossing: the number of discs at which rotation changes into counterrotation.
#include <fmt/format.h>

#include <filesystem>

#include "swirl/cli/command_line.hpp"
#include "swirl/cli/commands.hpp"
#include "swirl/cli/config_file.hpp"
#include "swirl/cli/output.hpp"
#include "swirl/cli/progress_line.hpp"
#include "swirl/cli/run_options.hpp"
#include "swirl/cli/stop_signal.hpp"
#include "swirl/cli/sweep_options.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/python_script.hpp"
#include "swirl/run/report.hpp"
#include "swirl/run/shell_word.hpp"
#include "swirl/run/units.hpp"
#include "swirl/study/crossing.hpp"
#include "swirl/study/own_points.hpp"
#include "swirl/study/search_folder.hpp"
#include "swirl/study/sweep_folder.hpp"
#include "swirl/study/sweep_plan.hpp"

namespace swirl {
namespace {

const ParameterTexts defaults{{"events", default_search_events}};

struct CrossingCall {
    std::shared_ptr<ParameterTexts> parameters;
    CrossingSettings settings;
    std::string config_file, json, table, rate, out, my_points;
    ShareOptions sharing;
    bool quiet = false, verbose = false, plot = false;

    bool uses_stdout() const { return json == "-" || table == "-"; }
};

const std::int64_t default_to = CrossingRules{}.to;

/// One of the searches of a call: one for each combination of the lists.
struct SearchTask {
    CrossingSettings settings;
    ParameterTexts parameters;
    std::string name;  // "mu_disc 0.5, mu_wall 1"; empty for a single search
};

/// What a call has found so far.
struct CallResults {
    std::vector<std::string> parameters;  // columns
    Table table;
    std::vector<std::string> objects;  // JSON of each search
    std::vector<CurveOfModel> curves;  // points of each search
    std::size_t empty = 0;             // searches without a successful run
};

/// The parameters with several values: "mu_disc 0.5, mu_wall 1".
std::string name_of(const SweepPlan& plan, const ParameterTexts& texts) {
    std::string name;
    for (const SweepAxis& axis : plan.axes)
        if (axis.values.size() > 1)
            name +=
                fmt::format("{}{} {}", name.empty() ? "" : ", ", axis.name, texts.at(axis.name));
    return name;
}

SweepPlan plan_of(const CrossingCall& call) {
    ParameterTexts given = overridden(defaults, *call.parameters);
    reject_listed_particles(given);
    given["discs"] = std::to_string(call.settings.from);  // each search finds the most that fit
    return make_plan(given, 1);
}

std::vector<SearchTask> tasks_of(const CrossingCall& call, const SweepPlan& plan) {
    std::vector<SearchTask> tasks;
    for (std::size_t point = 0; point < plan.points(); ++point) {
        const ParameterTexts texts = plan.parameters(point);
        tasks.push_back({call.settings, texts, name_of(plan, texts)});
        tasks.back().settings.config = resolve(texts);
        fit_range(tasks.back().settings);
        validate(tasks.back().settings);
    }
    return tasks;
}

void validate_call(const CrossingCall& call) {
    validate_range(call.settings.from, call.settings.to);
    (void)call.sharing.share();
}

void validate_outputs(const CrossingCall& call) {
    const bool has_part = call.sharing.slurm || !call.sharing.part.empty();
    if (has_part && !(call.json.empty() && call.table.empty() && call.my_points.empty()))
        throw UsageError(
            "--slurm and --part make the runs only.\nhint: omit --csv, --json and --my-points, and "
            "repeat the call with them, and without --slurm and --part, when all runs are done.");
    if (has_part && call.out.empty())
        throw UsageError("--slurm and --part need --out, the folder for the runs.");
    if (call.plot && (call.table.empty() || call.table == "-"))
        throw UsageError(
            "--plot draws a table in a file.\nhint: give its name, such as --csv N_c.csv.");
    for (const std::string* file : {&call.json, &call.table}) {
        if (file->empty() || *file == "-") continue;
        reject_unwritable(*file);
        if (!call.out.empty() && belongs_to_sweep(call.out, canonical_name(*file)))
            throw UsageError(
                fmt::format("'{}' belongs to the search itself.\nhint: use another name.", *file));
    }
    reject_same_files({call.config_file, call.json, call.table});
}

CrossingResult search_with_progress(const CrossingCall& call, const SearchTask& task,
                                    StoredRuns* stored) {
    ProgressLine line(task.name.empty() ? "crossing" : task.name, call.quiet);
    CrossingControl control;
    control.stop = &stop_signal();
    control.threads = call.sharing.share().threads;
    control.stored = stored;
    double done = 0.0;
    control.progress = [&](const std::string& stage, double rate) {
        // The number of runs is unknown in advance, so the fraction approaches 1 without reaching
        // it; it is one half after this many runs.
        constexpr double half = 20.0;
        done += 1.0;
        line.show(done / (half + done), fmt::format("{}, {} events/s", stage, short_number(rate)));
    };
    return search_crossing(task.settings, control);
}

std::string points_text(const RunConfig& config, const CrossingResult& search) {
    std::string text;
    for (std::size_t k = 0; k < search.points().size(); ++k) {
        const RotationPoint& p = search.points()[k];
        const std::string rounded = rounded_share_text(with_discs(config, std::int64_t(p.discs)));
        text += fmt::format("  N = {:<4.0f} ϖ/Ω = {:<20} {}{}{}\n", p.discs,
                            with_error(p.mean, p.error), counted(search.runs_made[k], "run"),
                            rounded.empty() ? "" : "; ", rounded);
    }
    return text;
}

std::string report_text(const CrossingCall& call, const SearchTask& task,
                        const CrossingResult& search) {
    const std::string prefix = task.name.empty() ? "" : task.name + ": ";
    std::string text = prefix + crossing_report(task.settings, search) + "\n";
    if (search.crossing().changes.size() > 1 || call.verbose)
        text += other_crossings_report(search);
    if (call.quiet) return text;
    if (const std::string range = range_words(task.settings); !range.empty())
        text += report_line("range", range);
    if (const std::string rigid = rigid_body_crossing(search); !rigid.empty())
        text += report_line("rigid body", rigid);
    if (const std::string nearest = nearest_points(search); !nearest.empty())
        text += report_line("nearest", nearest);
    text += report_line(
        "search", fmt::format("{} runs, {} events, {}", search.runs, with_commas(search.events),
                              short_duration(search.seconds)));
    if (!call.verbose && !search.stopped) return text;
    const std::string others = other_rates_report(search.crossings, search.rate);
    return text + points_text(task.settings.config, search) +
           (others.empty() ? "" : others.substr(1) + "\n");
}

void print_report(const CrossingCall& call, const SearchTask& task, const CrossingResult& search) {
    const std::string text = report_text(call, task, search);
    if (!call.uses_stdout())
        print_all(text);
    else if (!call.quiet)
        fmt::print(stderr, "{}", text);
    for (const std::string& warning : warnings(search)) print_warning(warning);
}

/// If stopped, prints what the search has found so far.
CrossingResult search_or_report(const CrossingCall& call, const SearchTask& task,
                                const std::optional<SweepPlan>& plan) {
    std::optional<SearchFolder> folder;
    if (plan) folder.emplace(call.out, *plan, task.parameters);
    try {
        return search_with_progress(call, task, folder ? &*folder : nullptr);
    } catch (const StoppedSearch& stopped) {
        print_report(call, task, stopped.search);
        throw Interrupted(fmt::format(
            "{}\nhint: {}.", stopped.what(),
            plan ? "repeat the call to continue" : "with --out DIR, a repeated call continues"));
    }
}

/// The plan in the folder of the call, which this writes if it is not there yet.
std::optional<SweepPlan> plan_in_folder(const CrossingCall& call) {
    if (call.out.empty()) return {};
    const CrossingSettings& s = call.settings;
    const SweepPlan plan = search_plan(overridden(defaults, *call.parameters), s.from, s.to);
    make_folder(call.out);
    write_plan(call.out, plan);
    return plan;
}

CallResults empty_results(const SweepPlan& plan) {
    CallResults results{{}, Table({}), {}, {}, 0};
    for (const SweepAxis& axis : plan.axes)
        if (axis.name != "discs") results.parameters.push_back(axis.name);
    std::vector<std::string> columns = results.parameters;
    for (const std::string& name : crossing_columns()) columns.push_back(name);
    columns.insert(columns.end(),
                   {"from", "to", "within_tolerance", "runs", "runs_failed", "events_in_all"});
    results.table = Table(columns);
    return results;
}

void add_result(CallResults& results, const SearchTask& task, const CrossingResult& search) {
    std::vector<Table::Cell> row;
    for (const std::string& name : results.parameters) row.emplace_back(task.parameters.at(name));
    add_crossings(row, search.crossings, search.rate);
    row.emplace_back(task.settings.from);
    row.emplace_back(task.settings.to);
    row.emplace_back(std::string(search.within_tolerance ? "yes" : "no"));
    row.emplace_back(std::int64_t(search.runs));
    row.emplace_back(search.failed());
    row.emplace_back(std::int64_t(search.events));
    results.table.add(std::move(row));
    results.curves.push_back({task.parameters, search.points()});
    results.objects.push_back(crossing_json(task.settings, search, command_line()));
    if (search.points().empty()) ++results.empty;
}

/// An object for a single search, an array for those of a list.
std::string json_of(const CallResults& results, bool is_single) {
    return is_single ? results.objects.front()
                     : fmt::format("[\n{}]\n", fmt::join(results.objects, ","));
}

/// The command of a task of a Slurm array, without folder and part.
std::string slurm_command(const CrossingCall& call) {
    const CrossingSettings& s = call.settings;
    std::string command = "crossing --quiet";
    for (const auto& [name, text] : *call.parameters)
        command += fmt::format(" {} {}", option_name(name), shell_word(text));
    command += fmt::format(" --tolerance {} --from {} --to {} --rate {}", s.tolerance, s.from, s.to,
                           rotation_rates[s.rate].name);
    return command + (s.step > 0 ? fmt::format(" --step {}", s.step) : "");
}

/// Each task makes the runs of some of the searches. The table follows from their runs.
void submit_searches(const CrossingCall& call) {
    const std::string script =
        slurm_script(call.sharing.slurm_job(), call.out, slurm_command(call).c_str());
    (void)plan_in_folder(call);
    print_all(fmt::format(
        "Submitted as job {}; for the table repeat the call without --slurm when it has ended.\n",
        submit(script, call.out)));
}

/// The names of the lists.
std::vector<std::string> varied_parameters(const SweepPlan& plan) {
    std::vector<std::string> names;
    for (const SweepAxis& axis : plan.axes)
        if (axis.values.size() > 1) names.push_back(axis.name);
    return names;
}

/// The duration of a circle in seconds, if values have units.
std::optional<double> period_of(const SearchTask& task) {
    const RunConfig& config = task.settings.config;
    if (const auto units = user_units(config)) return config.period * units->time;
    return {};
}

/// Draws N_c against the parameters; the figures lie next to the table.
void draw_table(const CrossingCall& call) {
    run_python_script("crossing_table", {call.table}, &stop_signal());
    const auto stem = std::filesystem::path(call.table).replace_extension();
    if (!call.quiet && !call.uses_stdout())
        print_all(fmt::format("drawn: {0}.png, {0}.pdf\n", stem.string()));
}

/// Runs a search for every combination of the lists. The files are written after each search, so an
/// interrupted call keeps the finished ones.
void run_searches(const Subcommand& subcommand, CrossingCall& call) {
    take_config_file(subcommand, call.config_file, *call.parameters, Lists::accepted, "crossing");
    call.settings.to_is_default = call.settings.to == default_to;
    if (!call.rate.empty()) call.settings.rate = rate_named(call.rate);
    validate_call(call);
    const SweepPlan plan = plan_of(call);
    const std::vector<SearchTask> tasks = tasks_of(call, plan);
    validate_outputs(call);
    const std::vector<RotationPoint> points =
        call.my_points.empty() ? std::vector<RotationPoint>()
                               : read_own_points(call.my_points, period_of(tasks.front()));
    if (call.sharing.slurm) return submit_searches(call);
    const std::optional<SweepPlan> stored = plan_in_folder(call);
    const SweepShare share = call.sharing.share();
    const bool is_single = tasks.size() == 1;
    CallResults results = empty_results(plan);
    for (std::size_t k = 0; k < tasks.size(); ++k) {
        const SearchTask& task = tasks[k];
        if (k % share.parts != share.part - 1) continue;
        const CrossingResult search = search_or_report(call, task, stored);
        add_result(results, task, search);
        if (!call.json.empty() && call.json != "-")
            write_output(call.json, json_of(results, is_single));
        if (!call.table.empty() && call.table != "-") write_output(call.table, results.table.csv());
        print_report(call, task, search);
    }
    if (call.plot) draw_table(call);
    if (!points.empty()) {
        const std::string text =
            comparison_text(compare_points(results.curves, varied_parameters(plan), points));
        fmt::print(call.uses_stdout() ? stderr : stdout, "{}", text);
    }
    if (call.table == "-") print_all(results.table.csv());
    if (call.json == "-") print_all(json_of(results, is_single));
    if (results.empty == 0) return;
    throw Failure(is_single ? "every run of the search failed; see the report."
                            : fmt::format("every run failed in {} of {} searches; see the report.",
                                          results.empty, tasks.size()));
}

void add_crossing_command(Subcommand& subcommand) {
    const auto call = std::make_shared<CrossingCall>();
    call->settings.tolerance = default_search_tolerance;
    const char *const search = "Search", *const output = "Output";
    subcommand.add({{"config", &call->config_file,
                     "TOML file with options; the command line overrides it", "FILE.toml"}});
    call->parameters = add_run_options(subcommand, {"discs", "periods", "ramp"}, defaults);
    subcommand.in(search).add({
        {"--tolerance", &call->settings.tolerance, "Target standard error of N_c [0.1]", "NUMBER"},
        {"--from", &call->settings.from, "Smallest number of discs [5]", "N"},
        {"--to", &call->settings.to, "Largest number of discs [48, at most what fits]", "N"},
        {"--step", &call->settings.step, "Step of the coarse scan in discs [about eight numbers]",
         "N"},
        {"--rate", &call->rate, "Rotation rate that controls the search [mean_by_time]",
         one_of(rate_names())},
        {"--out", &call->out, "Folder for the runs; a repeated call continues", "DIR"},
        threads_option(call->sharing),
    });
    subcommand.in(output).add({
        {"--json", &call->json, "File for all results, or - for stdout", "FILE|-"},
        {"--csv", &call->table, "File for a table of the searches, or - for stdout", "FILE|-"},
        {"--my-points", &call->my_points, "Your table of N, turns, circles, to compare with",
         "FILE.csv"},
        {"--plot", &call->plot, "Draw N_c of the table as PNG and PDF next to it"},
        omit_paths_option(),
        {"--verbose", &call->verbose, "Also print all points and all four rates"},
        {"--quiet", &call->quiet, "One line of report and no progress"},
    });
    add_cluster_options(subcommand, call->sharing, false);
    subcommand.explain(
        "Every parameter may be a list, as for swirl sweep: each combination is a search of its "
        "own. A run has at least --events events and fifty periods after the warm-up. Near "
        "the crossing, further runs are planned from the slope and the errors so far, until "
        "--tolerance is reached, in at most ten batches; if seeds differ by more than their "
        "errors, "
        "there are more runs instead of longer ones. Rates count in the direction of the swirl. "
        "A search that was stopped prints its points, and continues with --out DIR, the folder of "
        "a sweep. --verbose, JSON and CSV have N_c for all four rotation rates. Use a small --step "
        "if the direction of rotation may change several times.\n");
    subcommand.set_main_options({"--mu", "--events", "--seed", "--tolerance", "--from", "--to",
                                 "--step", "--threads", "--json", "--csv"});
    subcommand.set_examples(
        {"swirl crossing --mu 1", "swirl crossing --mu 0.2:0.2:1 --csv N_c.csv --plot",
         "swirl crossing --mu 0.5 --tolerance 0.1", "swirl crossing --sizes normal:1:0.2 --out N_c",
         "swirl crossing --mu-wall 0.5 --from 20 --json -"});
    subcommand.callback([call, &subcommand] { run_searches(subcommand, *call); });
}

const Command crossing_command("crossing", add_crossing_command);

}  // namespace
}  // namespace swirl
