// swirl measure: the measurements of a run, on frames that were recorded: by us, by a camera
// (trackpy), by another program (LAMMPS).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "swirl/cli/commands.hpp"
#include "swirl/cli/output.hpp"
#include "swirl/cli/progress_line.hpp"
#include "swirl/cli/stop_signal.hpp"
#include "swirl/cli/track_options.hpp"
#include "swirl/cli/tracks_input.hpp"
#include "swirl/cli/trial_reading.hpp"
#include "swirl/io/trajectory.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/json.hpp"
#include "swirl/run/measured_series.hpp"
#include "swirl/run/report.hpp"
#include "swirl/run/version.hpp"

namespace swirl {
namespace {

using Json = nlohmann::ordered_json;

struct MeasureCall {
    std::string file, list, tables, json, skip, misfit;
    TrackTexts camera;
    bool quiet = false;
};

OpenedSeries open_series(const MeasureCall& call) {
    std::error_code ignored;
    if (std::filesystem::is_directory(call.file, ignored))
        throw UsageError(fmt::format(
            "'{}' is a folder, but FILE must be a recording: a trajectory or tracks of swirl, a "
            "table of trackpy (CSV), or a LAMMPS text dump.",
            call.file));
    try_reading(call.file);
    if (is_trajectory(call.file))
        return {series_of(std::make_shared<TrajectoryReader>(call.file)), "", nullptr};
    return open_tracks(call.file, call.camera,
                       number_option("misfit", call.misfit, default_misfit, 0.0));
}

/// Frames do not tell one collision from the next.
void reject_what_needs_events(const std::vector<std::string>& names, const std::string& list) {
    for (const std::string& name : names)
        if (find_measurement(name)->needs_events && list != "all")
            throw UsageError(fmt::format(
                "--measure has '{}' in its list, which needs every collision, and frames do not "
                "hold them; `swirl run --measure {}` can tell.",
                name, name));
}

void reject_what_needs_tracks(const std::vector<std::string>& names, const MeasureCall& call) {
    for (const std::string& name : names)
        if (find_measurement(name)->needs_tracks && call.list != "all")
            throw Failure(fmt::format(
                "The discs of '{}' are never the same for {} frames in a row, so '{}' cannot be "
                "told of them; density, flow, profile, radial, temperature, order and packing can.",
                call.file, PinnedLoose::width + 1, name));
}

/// At a corner of the path the floor has just changed its velocity under everybody.
std::string remark_on_rolling(const Json& measured) {
    for (const MeasuredNumber& number : measured_numbers(measured))
        if (number.name == "rolling.rolling_share" && number.estimate.mean == 0.0)
            return "No sphere rolls in any of the frames. At a corner of the path the floor has "
                   "just changed its "
                   "velocity, and all slide: a recording with 30 frames per swirl on 30 sides has "
                   "no "
                   "other frames. One with 511 frames per swirl would tell.\n";
    return "";
}

void measure_file(const MeasureCall& call) {
    if (call.list == "help") return print_all(measurement_help_text());
    std::vector<std::string> names;
    if (!call.list.empty()) names = read_measurement_list(call.list);
    reject_what_needs_events(names, call.list);
    if (!call.tables.empty() && names.empty())
        throw UsageError("--tables needs --measure LIST, which says what to write there.");
    if (!call.json.empty() && call.json != "-") reject_unwritable(call.json);
    std::vector<std::filesystem::path> all{call.file, camera_file(call.file), call.json,
                                           call.tables};
    if (!call.tables.empty())
        for (auto& table : measured_table_files(names, call.tables))
            all.push_back(std::move(table));
    reject_same_files(all);
    const double skip = number_option("skip", call.skip, 0.0, 0.0);
    const OpenedSeries opened = open_series(call);
    const SnapshotSeries& series = opened.series;
    if (series.frames == 0) throw Failure(fmt::format("'{}' holds no frames.", call.file));
    const bool tracked = holds_tracks(series);
    if (!tracked) reject_what_needs_tracks(names, call);
    names = measurable(names, tracked);
    if (skip > 0.0 && series.frame(series.frames - 1).time() < skip * series.frame(0).period)
        throw Failure(fmt::format("--skip {} leaves no frame of '{}'.", call.skip, call.file));

    ProgressLine line(fmt::format("{} frames", series.frames), call.quiet);
    MeasuringControl control;
    control.stop = &stop_signal();
    control.progress = [&](std::uint64_t k, std::uint64_t of) {
        line.show(double(k) / double(of), fmt::format("frame {}", k));
    };
    const MeasuredSeries measured_series = measure_series(series, names, skip, control);
    line.clear();
    const MeasurementReports& measured = measured_series.reports;
    const RotationEstimates& found = measured_series.rotation;
    const std::uint64_t used = measured_series.frames;
    const std::size_t discs = measured_series.discs;
    const Json measured_values = measured_json(measured);
    const std::string remarks = opened.remarks + remark_on_rolling(measured_values);
    Json json{{"file", call.file},
              {"frames", used},
              {"discs", discs},
              {"same_discs", series.same_discs()},
              {"rotation",
               {{"by_time", estimate_json(found.by_time)},
                {"rigid_by_time", estimate_json(found.rigid_by_time)}}},
              {"measured", measured_values},
              {"camera", opened.camera},
              {"remark", remarks},
              {"version", version()}};
    std::string text = fmt::format(
        "{} {} {}: ϖ/Ω = {} by time, {} rigid; {} frames\n", discs,
        series.frame(0).are_balls() ? "spheres" : "discs", sense_of_rotation(found.by_time),
        with_error(found.by_time.mean, found.by_time.error),
        with_error(found.rigid_by_time.mean, found.rigid_by_time.error), used);
    text += measured_text(measured);
    text += remarks;
    const double per_swirl = measured_series.frames_per_period();
    const bool pinned = std::any_of(names.begin(), names.end(), [](const std::string& name) {
        return find_measurement(name)->needs_pinned;
    });
    if (pinned && !fits_criteria(per_swirl))
        text += fmt::format(
            "There are {:.0f} frames per swirl; the criteria for pinned discs are made for {}.\n",
            per_swirl, samples_per_period);
    if (!call.tables.empty()) {
        make_folder(call.tables);
        write_measured_tables(measured, call.tables);
    }
    if (call.json == "-") return print_all(json.dump(2) + "\n");
    if (!call.json.empty()) write_output(call.json, json.dump(2) + "\n");
    if (!call.quiet) print_all(text);
}

void add_measure_command(Subcommand& subcommand) {
    const auto call = std::make_shared<MeasureCall>();
    const auto text = [&](const char* name, std::string& into, const char* type,
                          const char* description, const char* group) {
        return subcommand.add_option(name, into, description)->type_name(type)->group(group);
    };
    subcommand
        .add_option(
            "file", call->file,
            "a trajectory or tracks of swirl, a table of trackpy (CSV), or a LAMMPS text dump")
        ->type_name("FILE")
        ->required();
    text("--measure", call->list, "LIST", "as for swirl run: density,flow,profile,… or all",
         "Output");
    text("--tables", call->tables, "DIR", "write what was measured as CSV files", "Output");
    text("--json", call->json, "FILE|-", "write everything found to FILE, or - for stdout",
         "Output");
    text("--skip", call->skip, "PERIODS", "swirls at the start that do not count [0]", "Output");
    subcommand.add_flag("--quiet", call->quiet, "no progress, no report")->group("Output");
    const char* const camera = "Of tracks that are not ours";
    add_track_options(subcommand, call->camera, camera);
    text("--amplitude", call->camera.amplitude, "NUMBER", "of the swirl, in disc radii [0]",
         camera);
    text("--container-radius", call->camera.container_radius, "NUMBER", "in disc radii", camera);
    text("--misfit", call->misfit, "SHARE",
         "of the frames may show discs outside the dish or in each other [0.05]", camera);
    subcommand.set_examples(
        {"swirl measure frames.h5 --measure density,flow --tables maps",
         "swirl measure tracks.csv --camera-fps 960 --scale 24 --omega 11.81 --centre 512,384 "
         "--phase 90 --amplitude 1.9 --container-radius 8.6"});
    subcommand.callback([call] { measure_file(*call); });
}

const Command measure_command(41, "measure",
                              "The measurements, on recorded frames or a camera's tracks.",
                              add_measure_command);

}  // namespace
}  // namespace swirl
