#include "swirl/cli/sweep_tables.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>

#include "swirl/cli/output.hpp"
#include "swirl/cli/stop_signal.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/python_script.hpp"
#include "swirl/run/reading.hpp"
#include "swirl/run/report.hpp"
#include "swirl/run/shell_word.hpp"
#include "swirl/run/units.hpp"
#include "swirl/study/collected_sweep.hpp"
#include "swirl/study/own_points.hpp"
#include "swirl/study/point_table.hpp"
#include "swirl/study/sweep.hpp"
#include "swirl/study/sweep_folder.hpp"

namespace swirl {

namespace fs = std::filesystem;

void warn_of_damaged_results(const SweepStatus& status, const std::string& folder) {
    if (status.damaged == 0) return;
    const bool one = status.damaged == 1;
    print_warning(fmt::format(
        "a file of {} is missing or not whole, and the run{} as not done; the first file is '{}'."
        "\nhint: run `swirl sweep --out {}` to repeat {}.",
        counted(std::int64_t(status.damaged), "run"), one ? " counts" : "s count",
        status.first_damaged, shell_word(folder), one ? "the run" : "the runs"));
}

namespace {

/// The table must not overwrite the files of the sweep.
void reject_part_of_sweep(const fs::path& folder, const SweepPlan& plan, const fs::path& output) {
    if (output.empty() || output == "-" || !belongs_to_sweep(folder, canonical_name(output)))
        return;
    throw UsageError(fmt::format(
        "'{}' belongs to the {} itself.\nhint: use another name, such as '{}'.", output.string(),
        plan.kind(), (folder / output.filename().replace_extension(".csv")).string()));
}

void write_or_print(const std::string& file, const std::string& table) {
    if (file == "-")
        print_all(table);
    else if (!file.empty())
        write_output(file, table);
}

std::string loops_text(const CollectCall& call, const SweepPlan& plan,
                       const CollectedSweep& collected) {
    const std::string name = call.quantity.empty() ? "mean_by_time" : call.quantity;
    const auto& all = collected.loop_quantities;
    const auto found = std::find(all.begin(), all.end(), name);
    if (found == all.end()) return "";
    std::string text;
    for (const LoopAreas& loop : collected.loops) {
        const Estimate& area = loop.areas[static_cast<std::size_t>(found - all.begin())];
        std::vector<std::string> where = varied_options(plan, loop.parameters);
        where.insert(where.begin(), name);
        text += fmt::format("loop area of {}: {} ({})\n", fmt::join(where, " "),
                            with_error(area.mean, area.error), counted(loop.replicas, "loop"));
    }
    return text;
}

void reject_plot_options(const CollectCall& call) {
    if (!call.quantity.empty() && !call.plot)
        throw UsageError("--quantity is given, but nothing is drawn.\nhint: add --plot.");
    if (call.plot && call.table_file() == "-")
        throw UsageError(
            "--plot draws a table in a file, but --csv is '-'.\nhint: give --csv a file name.");
}

/// The points of --my-points, for the report and for the drawing.
std::vector<RotationPoint> own_points(const CollectCall& call, const SweepPlan& plan) {
    if (call.my_points.empty()) return {};
    std::optional<double> period;
    if (const auto units = user_units(plan.config(0))) period = plan.config(0).period * units->time;
    return read_own_points(call.my_points, period);
}

/// Draws the table, with the own points; the figures lie next to it.
void draw_table(const CollectCall& call, const std::vector<RotationPoint>& points) {
    std::vector<std::string> arguments{call.table_file()};
    if (!call.quantity.empty()) arguments.push_back(call.quantity);
    if (!points.empty()) {
        const fs::path file = fs::path(call.table_file()).replace_filename("my_points.csv");
        write_output(file, own_points_csv(points));
        arguments.insert(arguments.end(), {"--points", file.string()});
    }
    run_python_script("sweep_table", arguments, &stop_signal());
    const fs::path stem = fs::path(call.table_file()).replace_extension();
    if (call.prints_report()) print_all(fmt::format("drawn: {0}.png, {0}.pdf\n", stem.string()));
}

/// "11 of 12 runs"; "102 runs" of a map, which does not need all of its points.
std::string runs_text(const SweepStatus& status, const SweepPlan& plan) {
    return plan.needs_all_points() ? fmt::format("{} of {} runs", status.done, status.points)
                                   : counted(std::int64_t(status.done), "run");
}

}  // namespace

void collect(const CollectCall& call) {
    const fs::path folder = call.folder;
    const std::string file = call.table_file();
    reject_same_files({file, call.crossings, call.loops});
    reject_plot_options(call);
    const SweepPlan plan = read_plan(folder);
    for (const std::string& output : {file, call.crossings, call.loops})
        reject_part_of_sweep(folder, plan, output);
    if (!call.loops.empty() && plan.chain.empty())
        throw UsageError(
            "--loops is given, but this sweep is not a chain with rising and falling values.\n"
            "hint: use --chain NAME of `swirl sweep`, and then `swirl collect`.");
    const std::vector<RotationPoint> points = own_points(call, plan);
    const CollectedSweep collected = collect_sweep(folder, plan);
    const std::string compared =
        points.empty() ? "" : comparison_text(compare_with_sweep(plan, collected, points));
    const std::string crossings = call.crossings.empty() ? "" : crossings_in(plan, collected).csv();
    const SweepStatus s = sweep_status(folder, plan, Counted::results);
    write_or_print(file, collected.table.csv());
    write_or_print(call.crossings, crossings);
    if (!call.loops.empty())
        write_or_print(call.loops,
                       loop_table(plan, collected.loops, collected.loop_quantities).csv());
    if (call.prints_report())
        print_all(fmt::format("wrote {} ({}){}{}\n", file, runs_text(s, plan),
                              crossings.empty() ? "" : ", " + call.crossings + " (crossings)",
                              call.loops.empty() ? "" : ", " + call.loops + " (areas of loops)") +
                  loops_text(call, plan, collected));
    if (!compared.empty() && file != "-") print_all(compared);
    if (call.plot) draw_table(call, points);
    warn_of_damaged_results(s, call.folder);
    if (s.done < s.points && plan.needs_all_points())
        print_warning(fmt::format("the table is incomplete: no result yet for {} of {} runs.",
                                  s.points - s.done, s.points));
    for (const std::string& warning : warnings(collected)) print_warning(warning);
}

void draw_sweep(const std::string& folder, const std::string& my_points, bool quiet) {
    CollectCall tables;
    tables.folder = folder;
    if (!read_plan(folder).chain.empty()) tables.loops = (fs::path(folder) / "loops.csv").string();
    tables.plot = true;
    tables.my_points = my_points;
    tables.quiet = quiet;
    collect(tables);
}

}  // namespace swirl
