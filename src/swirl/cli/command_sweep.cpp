// swirl sweep: many runs, on all cores or on a cluster. swirl collect: the table of what they
// found.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdio>
#include <map>
#include <optional>

#include "swirl/cli/commands.hpp"
#include "swirl/cli/config_file.hpp"
#include "swirl/cli/output.hpp"
#include "swirl/cli/progress_line.hpp"
#include "swirl/cli/run_options.hpp"
#include "swirl/cli/stop_signal.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/measurements.hpp"
#include "swirl/run/shell_word.hpp"
#include "swirl/study/collected_sweep.hpp"
#include "swirl/study/slurm.hpp"
#include "swirl/study/sweep.hpp"
#include "swirl/study/sweep_folder.hpp"

namespace swirl {
namespace {

namespace fs = std::filesystem;

struct SweepCall {
    std::shared_ptr<ParameterTexts> parameters;
    std::string config_file, out, seeds, measure, frames, part, threads, nodes, cpus;
    SlurmJob job;
    bool status = false, slurm = false, rest = false, dry_run = false, quiet = false;
    bool grow = false;
};

std::int64_t whole(const char* name, const std::string& text, std::int64_t otherwise,
                   std::int64_t to) {
    if (text.empty()) return otherwise;
    const auto value = read_whole_number(text);
    if (!value || *value < 1 || *value > to)
        throw UsageError(fmt::format("--{} is '{}', but it must be a whole number from 1 to {}.",
                                     name, text, to));
    return *value;
}

void take_config_file(SweepCall& call) {
    const std::map<std::string, std::string*> others{
        {"seeds", &call.seeds}, {"measure", &call.measure}, {"frames", &call.frames}};
    std::vector<std::string> names = parameter_names();
    for (const auto& [name, target] : others) names.push_back(name);
    const ConfigFile plan = read_config_file(call.config_file, names, Lists::taken, "sweep");
    *call.parameters = overridden(plan.parameters, *call.parameters);
    take_others(plan.others, others);
}

std::vector<std::string> more_measurements(const SweepCall& call) {
    if (!call.frames.empty())
        throw UsageError(
            "--frames cannot be added to a sweep with --grow; its runs are recorded from the "
            "beginning or not at all.");
    if (call.measure.empty()) return {};
    return read_measurement_list(call.measure);
}

/// Says also which plan it was grown from, if it was.
SweepPlan plan_of(SweepCall& call, std::optional<SweepPlan>& grown_from) {
    if (!call.config_file.empty()) take_config_file(call);
    if (call.grow) {
        grown_from = read_plan(call.out);
        return grown(*grown_from, *call.parameters, whole("seeds", call.seeds, 0, 1'000'000),
                     more_measurements(call));
    }
    // Without a plan: the one that is there.
    if (call.parameters->empty() && call.seeds.empty() && call.measure.empty() &&
        call.frames.empty()) {
        std::error_code ignored;
        if (!fs::exists(fs::path(call.out) / "plan.json", ignored))
            throw UsageError(
                "There is nothing to sweep over: give a plan (plan.toml), or lists, as in --discs "
                "5:48 --mu 0.1,0.5,1.");
        return read_plan(call.out);
    }
    SweepPlan plan = make_plan(*call.parameters, whole("seeds", call.seeds, 1, 1'000'000));
    if (!call.measure.empty()) plan.measure = read_measurement_list(call.measure);
    plan.frames = static_cast<int>(whole("frames", call.frames, 0, 1'000'000));
    return plan;
}

SweepShare share_of(const SweepCall& call) {
    SweepShare share;
    share.rest = call.rest;
    share.threads = static_cast<unsigned>(whole("threads", call.threads, 0, 4096));
    if (call.part.empty()) return share;
    const std::size_t slash = call.part.find('/');
    const auto part = read_whole_number(std::string_view(call.part).substr(0, slash));
    const auto parts = slash == std::string::npos
                           ? std::nullopt
                           : read_whole_number(std::string_view(call.part).substr(slash + 1));
    if (!part || !parts || *part < 1 || *parts < *part || *parts > 1'000'000)
        throw UsageError(fmt::format(
            "--part is '{}', but it must be PART/PARTS, for example 2/10 for the second of ten.",
            call.part));
    share.part = static_cast<std::size_t>(*part);
    share.parts = static_cast<std::size_t>(*parts);
    return share;
}

void print_status(const SweepCall& call, const SweepPlan& plan) {
    const SweepStatus s = sweep_status(call.out, plan);
    std::string text =
        fmt::format("{} of {} runs done, {} running, {} failed, {} to do\n", s.done, s.points,
                    s.running, s.failed, s.points - s.done - s.running - s.failed);
    if (const auto job = slurm_status(call.out)) text += *job + "\n";
    print_all(text);
}

void print_outcome(const SweepCall& call, const SweepPlan& plan, const SweepOutcome& outcome) {
    const SweepStatus s = sweep_status(call.out, plan);
    if (!call.quiet) {
        std::string text =
            fmt::format("{} of {} runs done ({} by this call)", s.done, s.points, outcome.done);
        if (s.running > 0) text += fmt::format(", {} running elsewhere", s.running);
        print_all(text + fmt::format("; table: swirl collect {}\n", shell_word(call.out)));
    }
    if (outcome.stopped)
        throw Interrupted(fmt::format(
            "Stopped before the end; `swirl sweep --out {}` goes on with what is missing.",
            shell_word(call.out)));
    if (outcome.failed > 0)
        throw Failure(fmt::format(
            "{} of the runs could not be done, the first is {} All of them are "
            "in '{}'.",
            outcome.failed, outcome.first_failure, (fs::path(call.out) / "failures").string()));
}

void sweep(SweepCall& call) {
    if (call.status) return print_status(call, read_plan(call.out));
    std::optional<SweepPlan> grown_from;
    const SweepPlan plan = plan_of(call, grown_from);
    const SweepShare share = share_of(call);
    call.job.nodes = static_cast<int>(whole("nodes", call.nodes, 1, 100'000));
    call.job.cpus = static_cast<int>(whole("cpus", call.cpus, 0, 4096));
    if (call.dry_run) {
        std::string text = fmt::format("{} runs:\n", plan.points());
        for (const SweepAxis& axis : plan.axes) {
            text += fmt::format("  {}:", axis.name);
            for (const std::string& value : axis.values) text += " " + value;
            text += "\n";
        }
        if (!plan.measure.empty())
            text += fmt::format("  measure: {}\n", fmt::join(plan.measure, " "));
        if (plan.frames > 0) text += fmt::format("  frames per swirl: {}\n", plan.frames);
        return print_all(text + fmt::format("  replicas: {}\n", plan.replicas));
    }
    // What is wrong in the call is told before anything is made of it.
    const std::string script = call.slurm ? slurm_script(call.job, call.out) : "";
    make_folder(call.out);
    write_plan(call.out, plan, grown_from ? &*grown_from : nullptr);
    if (call.slurm) {
        const std::string number = submit(script, call.out);
        return print_all(fmt::format(
            "Submitted as job {}; `swirl sweep --out {} --status` tells how far it is.\n", number,
            shell_word(call.out)));
    }
    ProgressLine line(fmt::format("{} runs", plan.points()), call.quiet);
    const auto begin = std::chrono::steady_clock::now();
    SweepControl control;
    control.stop = &stop_signal();
    control.progress = [&](double done, double all, std::uint64_t events) {
        const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - begin;
        line.show(all > 0.0 ? done / all : 1.0,
                  short_number(double(events) / elapsed.count()) + " events/s");
    };
    const SweepOutcome outcome = run_sweep(call.out, plan, share, control);
    line.clear();
    print_outcome(call, plan, outcome);
}

void add_sweep_command(Subcommand& subcommand) {
    const auto call = std::make_shared<SweepCall>();
    subcommand
        .add_option("plan", call->config_file, "a TOML file with parameters and lists of them")
        ->type_name("PLAN.toml");
    call->parameters = add_run_options(subcommand);
    const auto text = [&](const char* name, std::string& into, const char* type,
                          const char* description, const char* group) {
        return subcommand.add_option(name, into, description)->type_name(type)->group(group);
    };
    const char* const sweep_group =
        "The sweep (every parameter may be a list: 5:48, 0:0.25:1, "
        "0.1,0.5,1)";
    text("--out", call->out, "DIR", "folder of the sweep; called again, it does what is missing",
         sweep_group)
        ->required();
    text("--seeds", call->seeds, "N", "replicas of each point, with seeds of their own [1]",
         sweep_group);
    text("--measure", call->measure, "LIST", "as for swirl run: slip,pinned,… or all", sweep_group);
    text("--frames", call->frames, "N",
         "record every run, N frames per swirl, in DIR/trajectories [no recording]", sweep_group);
    text("--threads", call->threads, "N", "runs at the same time [one for each core]", sweep_group);
    subcommand
        .add_flag(
            "--grow", call->grow,
            "add these values, replicas (--seeds, all of them counted) and measurements to the "
            "sweep in DIR; what is done stays")
        ->group(sweep_group);
    subcommand.add_flag("--status", call->status, "only say what is done, running, failed")
        ->group(sweep_group);
    subcommand.add_flag("--dry-run", call->dry_run, "only say what would be run")
        ->group(sweep_group);
    subcommand.add_flag("--quiet", call->quiet, "no progress, no report")->group(sweep_group);
    const char* const cluster = "On a cluster";
    text("--part", call->part, "PART/PARTS", "do only this part, for example 2/10", cluster);
    subcommand.add_flag("--rest", call->rest, "after the part, go on with what nobody works on")
        ->group(cluster);
    subcommand.add_flag("--slurm", call->slurm, "submit a job array instead of running here")
        ->group(cluster);
    text("--nodes", call->nodes, "N", "tasks of the array, one node each [1]", cluster);
    text("--cpus", call->cpus, "N", "processors of each task [the whole node]", cluster);
    text("--time", call->job.time, "TIME", "limit for each task, as sbatch takes it", cluster);
    text("--partition", call->job.partition, "NAME", "of the cluster", cluster);
    subcommand.set_examples({"swirl sweep --discs 5:48 --mu 0.1,0.5,1 --seeds 8 --out study",
                             "swirl sweep --out study --grow --discs 49:55 --seeds 16",
                             "swirl sweep plan.toml --out study --slurm --nodes 4 --time 2:00:00",
                             "swirl sweep --out study --status"});
    subcommand.callback([call] { sweep(*call); });
}

/// What a reader of the table must know of its errors.
std::string remarks_on(const CollectedSweep& collected) {
    std::string text;
    if (collected.disagreeing > 0)
        text += fmt::format(
            "In {} of {} rows the replicas scatter more than the errors of their own blocks can "
            "explain (column scatter, in units of those); the errors are those between them.\n",
            collected.disagreeing, collected.rows.size());
    if (collected.without_swirl > 0)
        text += fmt::format(
            "{} of the runs made no whole swirl after the warm-up; there is nothing to average of "
            "them. More --events would be right.\n",
            collected.without_swirl);
    if (collected.not_steady > 0)
        text += fmt::format(
            "In {} of {} rows a run was not shown to be steady (column steady_state).\n",
            collected.not_steady, collected.rows.size());
    if (collected.versions.size() > 1)
        text += fmt::format(
            "The runs were made by different versions of swirl ({}), which may differ in a "
            "trajectory; CHANGELOG.md says whether they do.\n",
            fmt::join(collected.versions, ", "));
    return text;
}

/// The table of a sweep takes the place of nothing that it is made of, nor of what the sweep needs
/// to go on.
void reject_part_of_sweep(const fs::path& folder, const fs::path& output) {
    if (output.empty() || output == "-" || !belongs_to_sweep(folder, whole_name(output))) return;
    throw UsageError(fmt::format(
        "'{}' belongs to the sweep itself, which needs it; another name would be '{}'.",
        output.string(), (folder / output.filename().replace_extension(".csv")).string()));
}

void add_collect_command(Subcommand& subcommand) {
    struct Collect {
        std::string folder, table, crossings;
    };
    const auto call = std::make_shared<Collect>();
    subcommand.add_option("folder", call->folder, "folder of a sweep")
        ->type_name("DIR")
        ->required();
    subcommand
        .add_option("--csv", call->table,
                    "where to write the table, or - for stdout "
                    "[DIR/table.csv]")
        ->type_name("FILE|-");
    subcommand
        .add_option(
            "--crossings", call->crossings,
            "where to write N_c, the number of discs at which the rotation (by time) changes "
            "its sign, for each combination of the other parameters; - for stdout")
        ->type_name("FILE|-");
    subcommand.set_examples({"swirl collect study", "swirl collect study --crossings N_c.csv",
                             "swirl collect study --csv -"});
    subcommand.callback([call] {
        const fs::path folder = call->folder;
        const std::string file =
            call->table.empty() ? (folder / "table.csv").string() : call->table;
        reject_same_files({file, call->crossings});
        for (const std::string& output : {file, call->crossings})
            reject_part_of_sweep(folder, output);
        const SweepPlan plan = read_plan(folder);
        const CollectedSweep collected = collect_sweep(call->folder, plan);
        const std::string crossings =
            call->crossings.empty() ? "" : crossings_in(plan, collected).csv();
        const SweepStatus s = sweep_status(call->folder, plan);
        if (s.done < s.points)
            fmt::print(stderr, "swirl: {} of {} runs are not done yet; the table holds the rest.\n",
                       s.points - s.done, s.points);
        const std::string remarks = remarks_on(collected);
        if (file != "-") write_output(file, collected.table.csv());
        if (!call->crossings.empty() && call->crossings != "-")
            write_output(call->crossings, crossings);
        if (file == "-" || call->crossings == "-") {
            fmt::print(stderr, "{}", remarks);
            return print_all(file == "-" ? collected.table.csv() : crossings);
        }
        print_all(fmt::format("{} of {} runs in {}{}\n{}", s.done, s.points, file,
                              crossings.empty() ? "" : ", crossings in " + call->crossings,
                              remarks));
    });
}

const Command sweep_command(30, "sweep", "Many runs: lists of parameters, all cores, clusters.",
                            add_sweep_command);
const Command collect_command(31, "collect", "The table of what a sweep has found.",
                              add_collect_command);

}  // namespace
}  // namespace swirl
