// swirl map: a quantity as a function of one or two parameters.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <initializer_list>
#include <optional>

#include "swirl/cli/commands.hpp"
#include "swirl/cli/config_file.hpp"
#include "swirl/cli/output.hpp"
#include "swirl/cli/progress_line.hpp"
#include "swirl/cli/run_options.hpp"
#include "swirl/cli/stop_signal.hpp"
#include "swirl/cli/sweep_options.hpp"
#include "swirl/io/optional_file.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/python_script.hpp"
#include "swirl/run/reading.hpp"
#include "swirl/run/report.hpp"
#include "swirl/run/shell_word.hpp"
#include "swirl/study/crossing.hpp"
#include "swirl/study/map.hpp"
#include "swirl/study/map_plan.hpp"
#include "swirl/study/sweep_folder.hpp"

namespace swirl {
namespace {

namespace fs = std::filesystem;

const ParameterTexts map_defaults{{"periods", default_map_periods}, {"events", ""}};

struct MapCall {
    std::shared_ptr<ParameterTexts> parameters;
    MapSettings settings;
    std::string config_file, x, y, out, table;
    std::optional<std::int64_t> replicates, from, to;
    ShareOptions sharing;
    bool grow = false;
    bool status = false, dry_run = false, no_figure = false, quiet = false;

    fs::path table_file() const {
        return table.empty() ? fs::path(out) / "map.csv" : fs::path(table);
    }
    /// One of several processes leaves table and figure to the call that has no part.
    bool is_part() const { return !sharing.part.empty(); }
};

/// Throws UsageError for the folder of a sweep.
SweepPlan map_in(const std::string& folder) {
    SweepPlan plan = read_plan(folder);
    if (!plan.map)
        throw UsageError(
            fmt::format("'{}' holds a sweep, not a map.\nhint: run `swirl sweep --out {}`.", folder,
                        shell_word(folder)));
    return plan;
}

SweepPlan existing_map_plan(const MapCall& call) {
    if (!file_exists(fs::path(call.out) / "plan.json"))
        throw UsageError(
            "missing required option --x NAME=VALUES.\nhint: give, for example, --x mu=0:1.");
    return map_in(call.out);
}

/// The first of these options that is given, or "".
std::string first_given(const Subcommand& subcommand, std::initializer_list<const char*> names) {
    for (const Option& option : subcommand.options())
        for (const char* name : names)
            if (option.name == name && option.is_given) return name;
    return "";
}

/// Without axes the map in the folder continues, and its plan cannot change. A plan that grows gets
/// further values and runs only.
void reject_options_of_other_maps(const Subcommand& subcommand, const MapCall& call) {
    const bool has_axes = !call.x.empty() || !call.y.empty();
    if (call.grow) {
        std::string name =
            first_given(subcommand, {"--quantity", "--level", "--change", "--rate", "--tolerance"});
        if (!call.parameters->empty()) name = option_name(call.parameters->begin()->first);
        if (!name.empty())
            throw UsageError(
                fmt::format("{} is given, but --grow keeps it as it is.\nhint: give --x, --y, "
                            "--steps, --replicates, --from and --to, or use another folder.",
                            name));
        if (!has_axes && !call.replicates && !call.from && !call.to)
            throw UsageError("--grow is given, but no --x, --y, --replicates, --from or --to.");
        if (!has_axes && !first_given(subcommand, {"--steps"}).empty())
            throw UsageError("--steps is given, but no axis.\nhint: give --x, --y or both.");
        return;
    }
    if (has_axes) return;
    const std::string name =
        first_given(subcommand, {"--quantity", "--steps", "--level", "--change", "--replicates",
                                 "--from", "--to", "--rate", "--tolerance"});
    if (!name.empty())
        throw UsageError(
            fmt::format("{} is given, but --x is not.\nhint: give all options of the map, or only "
                        "--out to continue it.",
                        name));
}

/// The plan of a call, and the plan that it was grown from.
struct MapPlanOfCall {
    SweepPlan plan;
    std::optional<SweepPlan> grown_from = {};
};

MapPlanOfCall map_plan_of(MapCall& call) {
    if (call.grow) {
        SweepPlan before = read_plan(call.out);
        MapGrowth growth{.steps = call.settings.steps,
                         .max_runs = call.replicates,
                         .from = call.from,
                         .to = call.to};
        if (!call.x.empty()) growth.axes.push_back(read_map_axis("--x", call.x));
        if (!call.y.empty()) growth.axes.push_back(read_map_axis("--y", call.y));
        SweepPlan larger = grown_map(before, growth);
        return {std::move(larger), std::move(before)};
    }
    if (call.x.empty() && call.y.empty() && call.parameters->empty())
        return {existing_map_plan(call)};
    MapSettings& settings = call.settings;
    if (!call.x.empty()) settings.x = read_map_axis("--x", call.x);
    if (!call.y.empty()) settings.y = read_map_axis("--y", call.y);
    settings.max_runs = call.replicates.value_or(settings.max_runs);
    settings.from = call.from.value_or(settings.from);
    settings.to = call.to.value_or(settings.to);
    settings.parameters = *call.parameters;
    return {make_map_plan(settings)};
}

void reject_wrong_table(const MapCall& call) {
    const fs::path file = call.table_file();
    if (file == "-") return;
    reject_same_files({call.config_file, file});
    if (belongs_to_sweep(call.out, canonical_name(file)))
        throw UsageError(
            fmt::format("'{}' belongs to the map itself.\nhint: use another name.", file.string()));
    if (file.extension() != ".csv" && !call.no_figure)
        throw UsageError(
            fmt::format("--csv is '{}', but the name must end in .csv, because the figure "
                        "gets the same name.\nhint: use --no-figure for another name.",
                        file.string()));
}

MapOutcome run_map_with_progress(const MapCall& call, const SweepPlan& plan,
                                 const SweepShare& share) {
    ProgressLine line("map", call.quiet);
    MapControl control;
    control.stop = &stop_signal();
    control.progress = [&](std::size_t decided, std::size_t sites, double done, double runs,
                           std::uint64_t events) {
        // More sites may follow, and an undecided site may need more runs.
        const auto all = static_cast<double>(sites), now = static_cast<double>(decided);
        const double step = runs > 0.0 ? done / runs : 0.0;
        line.show_events(all > 0.0 ? (now + 0.5 * (all - now) * step) / all : 0.0, events);
    };
    return run_map(call.out, plan, share, control);
}

/// The table, and the figure next to it. Returns the report on the files.
std::string write_map_files(const MapCall& call, const SweepPlan& plan, const MapState& state) {
    const std::string table = map_table(plan, state).csv();
    const fs::path file = call.table_file();
    if (file == "-") {
        print_all(table);
        return "";
    }
    write_output(file, table);
    const std::string lines = report_line("table", file.string());
    if (call.no_figure || state.sites.size() < 2) return lines;
    run_python_script("parameter_map",
                      {file.string(), "--level", fmt::format("{}", plan.map->level)},
                      &stop_signal());
    const auto with = [&](const char* ending) {
        return fs::path(file).replace_extension(ending).string();
    };
    return lines + report_line("figure", fmt::format("{}, {}", with(".png"), with(".pdf")));
}

void warn_about(const MapCall& call, const SweepPlan& plan, const MapState& state) {
    std::size_t unclear = 0, failed = 0;
    for (const MapSite& s : state.sites) {
        unclear += s.verdict == "undetermined" || s.verdict == "undecided" ? 1 : 0;
        failed += s.failed > 0 ? 1 : 0;
    }
    if (unclear > 0)
        print_warning(fmt::format(
            "the sign of {} of {} points is undetermined even with all allowed runs.\nhint: use a "
            "larger --replicates or longer runs in another folder.",
            unclear, state.sites.size()));
    if (failed > 0)
        print_warning(
            fmt::format("runs failed at {} of {} points (column failed; all reasons in '{}'). The "
                        "next call tries them again. The first is {}",
                        failed, state.sites.size(), (fs::path(call.out) / "failures").string(),
                        first_failure(call.out, plan)));
}

std::string quantity_text(const SweepPlan& plan) {
    const std::string& quantity = plan.map->of;
    std::string over = plan.map->x;
    if (!plan.map->y.empty()) over += " and " + plan.map->y;
    if (quantity != "N_c") return fmt::format("{} over {}", quantity, over);
    return fmt::format("N_c by {} over {}", plan.map->rate, over);
}

void report_map(const MapCall& call, const SweepPlan& plan, const MapOutcome& outcome) {
    if (outcome.stopped)
        throw Interrupted(
            fmt::format("stopped before the end.\nhint: run `swirl map --out {}` to continue.",
                        shell_word(call.out)));
    std::string text =
        map_summary(plan, outcome.state) + "\n" + report_line("quantity", quantity_text(plan));
    if (!call.is_part()) text += write_map_files(call, plan, outcome.state);
    if (!call.quiet && call.table != "-") print_all(text);
    warn_about(call, plan, outcome.state);
    const bool nothing = std::all_of(outcome.state.sites.begin(), outcome.state.sites.end(),
                                     [](const MapSite& s) { return s.runs == 0; });
    if (nothing)
        throw Failure(fmt::format("every run failed.\nhint: see the errors in '{}'.",
                                  (fs::path(call.out) / "failures").string()));
}

void print_map_status(const MapCall& call, const SweepPlan& plan) {
    const MapState state = read_map(call.out, plan);
    std::string text = map_summary(plan, state) +
                       fmt::format("; {} runs to do in this step, {} running\n",
                                   state.missing.size(), sweep_status(call.out, plan).running);
    if (const auto job = slurm_status(call.out)) text += *job + "\n";
    print_all(text);
}

std::string map_plan_text(const SweepPlan& plan) {
    std::string text =
        fmt::format("map of {}, at most {} runs at a point:\n", plan.map->of, plan.replicas);
    for (const SweepAxis& axis : plan.axes)
        text += fmt::format("  {}: {}\n", axis.name, fmt::join(axis.values, " "));
    return text;
}

void make_map(const Subcommand& subcommand, MapCall& call) {
    take_config_file(subcommand, call.config_file, *call.parameters, Lists::rejected, "map");
    reject_options_of_other_maps(subcommand, call);
    if (call.status) return print_map_status(call, map_in(call.out));
    const auto [plan, grown_from] = map_plan_of(call);
    const SweepShare share = call.sharing.share();
    const SlurmJob job = call.sharing.slurm_job();
    if (call.dry_run) return print_all(map_plan_text(plan));
    reject_wrong_table(call);
    const std::string script = call.sharing.slurm ? slurm_script(job, call.out, "map") : "";
    make_folder(call.out);
    if (!call.table.empty() && call.table != "-") reject_unwritable(call.table);
    write_plan(call.out, plan, grown_from ? &*grown_from : nullptr);
    if (!call.sharing.slurm)
        return report_map(call, plan, run_map_with_progress(call, plan, share));
    print_all(
        fmt::format("Submitted as job {}; for its progress run `swirl map --out {} --status`, and "
                    "for table and figure `swirl map --out {}`.\n",
                    submit(script, call.out), shell_word(call.out), shell_word(call.out)));
}

void add_map_options(Subcommand& subcommand, MapCall& call) {
    const char *const map = "Map", *const crossing = "N_c";
    MapSettings& s = call.settings;
    subcommand.in(map).add({
        {"--x", &call.x, "Axis along x, such as mu=0:1", "NAME=VALUES"},
        {"--y", &call.y, "Axis along y; without it, a curve", "NAME=VALUES"},
        {"--quantity", &s.of, "Quantity: N_c, a rate or a measured row [mean_by_time]", "NAME"},
        {"--out", &call.out, "Folder of the map; a repeated call completes it", "DIR", required},
        {"--steps", &s.steps, "Number of values of a range FROM:TO [16]", "N"},
        {"--level", &s.level, "Refine where the quantity crosses this [0]", "NUMBER"},
        {"--change", &s.change, "Refine where neighbours differ by more [never; N_c 2]", "NUMBER"},
        {"--replicates", &call.replicates, "Maximum number of runs at a point [16]", "N"},
        threads_option(call.sharing),
        {"--csv", &call.table, "File for the table, or - for stdout [DIR/map.csv]", "FILE|-"},
        {"--grow", &call.grow, "Extend an existing map; finished runs are kept"},
        {"--no-figure", &call.no_figure, "Do not draw the map"},
        {"--status", &call.status, "Print the numbers of points and runs"},
        {"--dry-run", &call.dry_run, "Print the plan and do not run"},
        {"--quiet", &call.quiet, "No progress and no report"},
    });
    subcommand.in(crossing).add({
        {"--from", &call.from, "Smallest number of discs [5]", "N"},
        {"--to", &call.to, "Largest number of discs [48]", "N"},
        {"--rate", &s.rate, "Rotation rate that changes its sign at N_c [mean_by_time]",
         one_of(rate_names())},
        {"--tolerance", &s.tolerance, "Target standard error of N_c [0.5]", "NUMBER"},
    });
    add_cluster_options(subcommand, call.sharing, false);
}

void add_map_command(Subcommand& subcommand) {
    const auto call = std::make_shared<MapCall>();
    subcommand.add({{"config", &call->config_file,
                     "TOML file with options; the command line overrides it", "FILE.toml"}});
    call->parameters = add_run_options(subcommand, {"seed"}, map_defaults);
    add_map_options(subcommand, *call);
    subcommand.explain(
        "An axis has the values FROM:TO (--steps of them), FROM:STEP:TO, or a list. First a "
        "coarse grid is computed, then the cells in which the quantity crosses --level or is "
        "undetermined. A point gets two runs, and more near the level: their number doubles "
        "until its sign is certain. The figure shows the level with its 95 % band. With --quantity "
        "N_c, each point is a search for the number of discs at which the rotation changes its "
        "sign. With --grow, the values of --x and --y are added to the map in DIR, --replicates is "
        "its "
        "new maximum, and --from and --to enlarge the range of numbers of discs.\n");
    subcommand.set_main_options({"--discs", "--mu", "--periods", "--x", "--y", "--quantity",
                                 "--out", "--steps", "--replicates", "--threads", "--grow",
                                 "--status"});
    subcommand.set_examples(
        {"swirl map --x mu=0:1 --y amplitude=0.5:4 --out map",
         "swirl map --out map --grow --x mu=0:2 --steps 31 --replicates 32",
         "swirl map --x mu=0:1 --y discs=20:48 --quantity rigid_by_time --out map",
         "swirl map --x mu=0.1:1 --quantity N_c --out N_c",
         "swirl map --x mu=0.1:1 --y amplitude=1:3 --quantity N_c --out N_c_map",
         "swirl map --x discs=10:48 --quantity slip.cluster --level 0.8 --out slip"});
    subcommand.callback([call, &subcommand] { make_map(subcommand, *call); });
}

const Command map_command("map", add_map_command);

}  // namespace
}  // namespace swirl
