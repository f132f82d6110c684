// swirl sweep: many runs, on all cores or on a cluster.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdio>
#include <optional>

#include "swirl/cli/commands.hpp"
#include "swirl/cli/config_file.hpp"
#include "swirl/cli/output.hpp"
#include "swirl/cli/progress_line.hpp"
#include "swirl/cli/run_options.hpp"
#include "swirl/cli/stop_signal.hpp"
#include "swirl/cli/sweep_options.hpp"
#include "swirl/cli/sweep_tables.hpp"
#include "swirl/io/optional_file.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/measurements.hpp"
#include "swirl/run/ramp.hpp"
#include "swirl/run/reading.hpp"
#include "swirl/run/report.hpp"
#include "swirl/run/shell_word.hpp"
#include "swirl/study/point_table.hpp"
#include "swirl/study/slurm.hpp"
#include "swirl/study/sweep.hpp"
#include "swirl/study/sweep_folder.hpp"

namespace swirl {
namespace {

namespace fs = std::filesystem;

struct SweepCall {
    std::shared_ptr<ParameterTexts> parameters;
    std::string config_file, out, points, replicates, measure, frames, chain, my_points;
    ShareOptions sharing;
    bool status = false, dry_run = false, quiet = false, grow = false, series = false, plot = false;
};

std::vector<std::string> further_measurements(const SweepCall& call) {
    if (!call.frames.empty() || call.series || !call.chain.empty())
        throw UsageError(
            "--frames-per-period, --series and --chain cannot be used with --grow: they apply to "
            "all runs of a sweep or to none.");
    if (call.measure.empty()) return {};
    return read_measurement_list(call.measure);
}

/// The plan of a call, and the plan that it was grown from.
struct PlanOfCall {
    SweepPlan plan;
    std::optional<SweepPlan> grown_from = {};
};

std::vector<PointRow> points_of_call(const SweepCall& call) {
    return read_points(call.points, whole_number("replicates", call.replicates, 1, max_replicas));
}

PlanOfCall grown_plan(const SweepCall& call) {
    const SweepPlan before = read_plan(call.out);
    if (!call.points.empty())
        return {grown(before, points_of_call(call), *call.parameters, further_measurements(call)),
                before};
    return {grown(before, *call.parameters,
                  whole_number("replicates", call.replicates, 0, max_replicas),
                  further_measurements(call)),
            before};
}

SweepPlan existing_plan(const SweepCall& call) {
    if (!file_exists(fs::path(call.out) / "plan.json"))
        throw UsageError(
            "no parameters to sweep over.\nhint: give a plan (plan.toml), or lists, such as "
            "--discs 5:48 --mu 0.1,0.5,1.");
    return read_plan(call.out);
}

PlanOfCall plan_of(const SweepCall& call) {
    if (call.grow) return grown_plan(call);
    if (call.parameters->empty() && call.points.empty() && call.replicates.empty() &&
        call.measure.empty() && call.frames.empty() && call.chain.empty() && !call.series)
        return {existing_plan(call)};
    SweepPlan plan = call.points.empty()
                         ? make_plan(*call.parameters,
                                     whole_number("replicates", call.replicates, 1, max_replicas))
                         : make_plan(points_of_call(call), *call.parameters);
    if (!call.measure.empty()) plan.measure = read_measurement_list(call.measure);
    plan.frames = static_cast<int>(whole_number("frames_per_period", call.frames, 0, max_frames));
    plan.series = call.series;
    plan.chain = plain_name(call.chain);
    validate_extras(plan);
    return {plan};
}

void print_status(const SweepCall& call, const SweepPlan& plan) {
    require_sweep(call.out, plan);
    const SweepStatus s = sweep_status(call.out, plan);
    std::string text =
        fmt::format("{} of {} runs done, {} running, {} failed, {} to do\n", s.done, s.points,
                    s.running, s.failed, s.points - s.done - s.running - s.failed);
    if (const auto job = slurm_status(call.out)) text += *job + "\n";
    print_all(text);
    warn_of_damaged_results(s, call.out);
}

/// "8 replicates"; "3 to 8 replicates" for a table whose rows differ.
std::string replicates_text(const SweepPlan& plan) {
    if (plan.is_table())
        if (const auto few = *std::min_element(plan.row_replicas.begin(), plan.row_replicas.end());
            few < plan.replicas)
            return fmt::format("{} to {} replicates", few, plan.replicas);
    return counted(plan.replicas, "replicate");
}

void print_outcome(const SweepCall& call, const SweepPlan& plan, const SweepOutcome& outcome) {
    const SweepStatus s = sweep_status(call.out, plan);
    if (!call.quiet) {
        std::string text =
            fmt::format("{} of {} runs done ({} by this call)", s.done, s.points, outcome.done);
        if (s.running > 0) text += fmt::format(", {} running elsewhere", s.running);
        std::vector<std::string> axes;
        if (plan.is_table()) axes.push_back(counted(std::int64_t(plan.rows()), "row"));
        for (const SweepAxis& axis : plan.axes)
            if (axis.values.size() > 1 && !plan.is_table())
                axes.push_back(fmt::format("{} values of {}", axis.values.size(), axis.name));
        axes.push_back(replicates_text(plan));
        print_all(text + "\n" + report_line("points", fmt::format("{}", fmt::join(axes, ", "))) +
                  report_line("results", (fs::path(call.out) / "results").string()) +
                  report_line("table", "swirl collect " + shell_word(call.out)));
    }
    if (outcome.stopped)
        throw Interrupted(
            fmt::format("stopped before the end.\nhint: run `swirl sweep --out {}` to continue.",
                        shell_word(call.out)));
    if (outcome.failed > 0)
        throw Failure(fmt::format("{} of the runs failed (errors in '{}'), the first at {}",
                                  outcome.failed, (fs::path(call.out) / "failures").string(),
                                  outcome.first_failure));
}

std::string plan_text(const SweepPlan& plan) {
    std::string text = fmt::format("{} runs:\n", plan.points());
    if (plan.is_table())
        text += fmt::format("  table of {}\n", counted(std::int64_t(plan.rows()), "point"));
    for (const SweepAxis& axis : plan.axes) {
        text += fmt::format("  {}:", axis.name);
        for (const std::string& value : axis.values) text += " " + (value.empty() ? "-" : value);
        text += "\n";
    }
    if (!plan.measure.empty()) text += fmt::format("  measure: {}\n", fmt::join(plan.measure, " "));
    if (plan.frames > 0) text += fmt::format("  frames per period: {}\n", plan.frames);
    if (plan.series) text += "  series of every run\n";
    if (!plan.chain.empty()) text += fmt::format("  chain along {}, up and down\n", plan.chain);
    text += "  replicates:";
    if (!plan.is_table()) text += fmt::format(" {}", plan.replicas);
    for (const std::int64_t replicas : plan.row_replicas) text += fmt::format(" {}", replicas);
    return text + "\n";
}

SweepOutcome run_with_progress(const SweepCall& call, const SweepPlan& plan,
                               const SweepShare& share) {
    ProgressLine line(fmt::format("{} runs", plan.points()), call.quiet);
    SweepControl control;
    control.stop = &stop_signal();
    control.progress = [&](double done, double total, std::uint64_t events) {
        line.show_events(total > 0.0 ? done / total : 1.0, events);
    };
    return run_sweep(call.out, plan, share, control);
}

void sweep(const Subcommand& subcommand, const SweepCall& call) {
    take_config_file(subcommand, call.config_file, *call.parameters, Lists::accepted, "sweep");
    if (call.status) return print_status(call, read_plan(call.out));
    if (call.plot && (call.sharing.slurm || !call.sharing.part.empty()))
        throw UsageError(fmt::format(
            "--plot cannot be used with --slurm or --part: each task makes a part of the runs.\n"
            "hint: run `swirl collect {} --plot` when all runs are done.",
            shell_word(call.out)));
    const auto [plan, grown_from] = plan_of(call);
    if (!call.my_points.empty() && !call.plot)
        throw UsageError("--my-points is given, but nothing is drawn.\nhint: add --plot.");
    const SweepShare share = call.sharing.share();
    const SlurmJob job = call.sharing.slurm_job();
    if (call.dry_run) return print_all(plan_text(plan));
    // Made first: it rejects options that Slurm cannot take before anything is written.
    const std::string script = call.sharing.slurm ? slurm_script(job, call.out) : "";
    make_folder(call.out);
    write_plan(call.out, plan, grown_from ? &*grown_from : nullptr);
    if (!call.sharing.slurm) {
        print_outcome(call, plan, run_with_progress(call, plan, share));
        if (call.plot) draw_sweep(call.out, call.my_points, call.quiet);
        return;
    }
    print_all(
        fmt::format("Submitted as job {}; for its progress run `swirl sweep --out {} "
                    "--status`.\n",
                    submit(script, call.out), shell_word(call.out)));
}

Option chain_option(std::string& name) {
    Option option{"--chain", &name, "Parameter along which each run continues from the last",
                  "NAME"};
    option.values = ramp_parameter_names();
    return option;
}

void add_sweep_command(Subcommand& subcommand) {
    const auto call = std::make_shared<SweepCall>();
    subcommand.add(
        {{"plan", &call->config_file, "TOML file with parameters and lists of them", "PLAN.toml"}});
    call->parameters = add_run_options(subcommand);
    subcommand.in("Sweep").add({
        {"--out", &call->out, "Folder of the sweep; a repeated call completes it", "DIR", required},
        {"--points", &call->points, "Table of points instead of lists of values", "FILE.csv"},
        {"--replicates", &call->replicates, "Number of replicates of each point [1]", "N"},
        measure_option(call->measure, "Measurements, as for swirl run"),
        {"--frames-per-period", &call->frames, "Recorded frames per period of each run [none]",
         "N"},
        {"--series", &call->series, "Table of the averages of every period, for each run"},
        chain_option(call->chain),
        threads_option(call->sharing),
        {"--plot", &call->plot, "Collect and draw the table when all runs are done"},
        {"--my-points", &call->my_points, "Your table of N, turns, circles, to compare with",
         "FILE.csv"},
        {"--grow", &call->grow, "Extend an existing sweep; finished runs are kept"},
        {"--status", &call->status, "Print the numbers of runs done and failed"},
        {"--dry-run", &call->dry_run, "Print the plan and do not run"},
        {"--quiet", &call->quiet, "No progress and no report"},
    });
    add_cluster_options(subcommand, call->sharing, true);
    subcommand.explain(
        "Every parameter may be a list: 5:48, 0:0.25:1 (from : step : to) or 0.1,0.5,1. A table of "
        "points has a column for each parameter that varies, and may have a column replicates, the "
        "number of replicates of each row; other parameters have one value. With "
        "--grow, the given values, replicates (--replicates is their new total) and measurements "
        "are added to the sweep in DIR. Recorded runs are in DIR/trajectories, series in "
        "DIR/series. "
        "With --chain NAME, the runs follow each other in rising and then in falling values of "
        "NAME, and each starts from the final state of the run before it.\n");
    subcommand.set_main_options({"--discs", "--mu", "--events", "--periods", "--points",
                                 "--replicates", "--out", "--measure", "--threads", "--grow",
                                 "--status"});
    subcommand.set_examples(
        {"swirl sweep --discs 5:48 --mu 0.1,0.5,1 --replicates 8 --out study",
         "swirl sweep --out study --grow --discs 49:55 --replicates 16",
         "swirl sweep --points points.csv --periods 200 --replicates 8 --out study",
         "swirl sweep plan.toml --out study --slurm --tasks 4 --time 2:00:00",
         "swirl sweep --mu 0.1:0.1:1 --periods 60 --chain mu --out loop --plot",
         "swirl sweep --out study --status"});
    subcommand.callback([call, &subcommand] { sweep(subcommand, *call); });
}

const Command sweep_command("sweep", add_sweep_command);

}  // namespace
}  // namespace swirl
