// swirl measure: the measurements of a run on recorded frames: of swirl, of a camera (trackpy), or
// of another program (LAMMPS).
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>

#include "swirl/cli/command_line.hpp"
#include "swirl/cli/commands.hpp"
#include "swirl/cli/output.hpp"
#include "swirl/cli/progress_line.hpp"
#include "swirl/cli/run_options.hpp"
#include "swirl/cli/stop_signal.hpp"
#include "swirl/cli/track_options.hpp"
#include "swirl/cli/tracks_input.hpp"
#include "swirl/cli/trial_reading.hpp"
#include "swirl/io/trajectory.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/json.hpp"
#include "swirl/run/measured_series.hpp"
#include "swirl/run/reading.hpp"
#include "swirl/run/report.hpp"
#include "swirl/run/version.hpp"

namespace swirl {
namespace {

using Json = nlohmann::ordered_json;

struct MeasureCall {
    std::string file, list, tables, json, warmup, max_invalid;
    TrackTexts camera;
    bool quiet = false;
};

OpenedSeries open_series(const MeasureCall& call) {
    std::error_code ignored;
    if (std::filesystem::is_directory(call.file, ignored))
        throw UsageError(fmt::format(
            "'{}' is a folder, but FILE must be a recording.\nhint: give a trajectory or tracks of "
            "swirl, a table of a tracker (CSV), or a LAMMPS text dump.",
            call.file));
    try_reading(call.file);
    if (is_trajectory(call.file)) {
        reject_track_options(call.camera, call.file);
        if (!call.max_invalid.empty()) throw_option_of_tracks("max-invalid", call.file);
        OpenedSeries opened;
        opened.series = series_of_run(std::make_shared<TrajectoryReader>(call.file));
        return opened;
    }
    return open_tracks(call.file, call.camera,
                       number_option("max-invalid", call.max_invalid, default_misfit, 0.0));
}

/// Frames do not contain the collisions.
void reject_measurements_of_events(const std::vector<std::string>& names, const std::string& list) {
    for (const std::string& name : names)
        if (find_measurement(name)->needs_events && list != "all")
            throw UsageError(fmt::format(
                "--measure lists '{0}', which needs every collision, but frames do not contain "
                "them.\nhint: use `swirl run --measure {0}`.",
                name));
}

void reject_measurements_of_tracks(const std::vector<std::string>& names, const MeasureCall& call) {
    for (const std::string& name : names)
        if (find_measurement(name)->needs_tracks && call.list != "all")
            throw Failure(fmt::format(
                "'{}' needs the same discs in {} consecutive frames, but '{}' never has "
                "them.\nhint: measure density, flow, profile, radial, temperature, order or "
                "packing.",
                name, FrameWindow().width() + 1, call.file));
}

/// At a vertex of the path the velocity of the floor has just changed, so all spheres slide.
std::string remark_on_rolling(const Json& measured) {
    for (const MeasuredNumber& number : measured_numbers(measured))
        if (number.name == "rolling.rolling_share" && number.estimate.mean == 0.0)
            return fmt::format(
                "no sphere rolls in any of the frames: all spheres slide at a vertex of the path, "
                "and a recording with 30 frames per period on 30 sides has no other frames.\nhint: "
                "record {} frames per period.",
                samples_per_period);
    return "";
}

void validate_outputs(const MeasureCall& call, const std::vector<std::string>& names) {
    if (!call.tables.empty() && names.empty())
        throw UsageError("--tables also needs --measure LIST.");
    if (!call.json.empty() && call.json != "-") reject_unwritable(call.json);
    std::vector<std::filesystem::path> all{call.file, camera_file(call.file), call.json,
                                           call.tables};
    if (!call.tables.empty())
        for (auto& table : measured_table_files(names, call.tables))
            all.push_back(std::move(table));
    reject_same_files(all);
}

MeasuredSeries measure_with_progress(const MeasureCall& call, const SnapshotSeries& series,
                                     const std::vector<std::string>& names, double warmup) {
    ProgressLine line(fmt::format("{} frames", series.frames), call.quiet);
    MeasuringControl control;
    control.stop = &stop_signal();
    control.progress = [&](std::uint64_t k, std::uint64_t of) {
        line.show(double(k) / double(of), fmt::format("frame {}", k));
    };
    return measure_series(series, names, warmup, control);
}

Json rotation_json(const RotationEstimates& rotation) {
    return {{"mean_by_time", estimate_json(rotation.mean_by_time)},
            {"rigid_by_time", estimate_json(rotation.rigid_by_time)}};
}

/// What ϖ is without the links that `swirl track` calls uncertain.
std::optional<RotationEstimates> rotation_without_swaps(const OpenedSeries& opened, double warmup) {
    if (!opened.without_swaps || opened.without_swaps->frames == 0) return {};
    return measure_series(*opened.without_swaps, {}, warmup).rotation;
}

Json json_of(const MeasureCall& call, const OpenedSeries& opened, const MeasuredSeries& measured,
             const std::optional<RotationEstimates>& certain, const Json& values,
             const std::string& remarks) {
    Json rotation = rotation_json(measured.rotation);
    if (certain) rotation["without_swaps"] = rotation_json(*certain);
    return {{"file", stored_path(call.file)},
            {"frames", measured.frames},
            {"discs", measured.discs},
            {"same_discs", opened.series.same_discs()},
            {"rotation", rotation},
            {"measured", values},
            {"camera", Json::parse(opened.camera)},
            {"remark", remarks},
            {"version", version()}};
}

std::string report_text(const OpenedSeries& opened, const MeasuredSeries& measured,
                        const std::optional<RotationEstimates>& certain) {
    const SnapshotSeries& series = opened.series;
    const RotationEstimates& e = measured.rotation;
    const std::string bodies =
        counted(std::int64_t(measured.discs), series.frame(0).are_balls() ? "sphere" : "disc");
    const std::string words =
        std::isnan(e.mean_by_time.mean)
            ? bodies
            : bodies + " " + rotation_words(e.mean_by_time, series.has_m_frame, series.clockwise);
    std::string text = measured.discs == 1
                           ? bodies + " has no rotation about its own centre of mass\n"
                           : fmt::format("{}: ϖ/Ω = {}\n", words,
                                         with_error(e.mean_by_time.mean, e.mean_by_time.error));
    text += rigid_body_line(e);
    if (certain)
        text += report_line(
            "swaps",
            fmt::format("ϖ/Ω = {} without {} of IDs",
                        with_error(certain->mean_by_time.mean, certain->mean_by_time.error),
                        counted(std::int64_t(opened.swaps), "possible swap")));
    return text + report_line("average", counted(std::int64_t(measured.frames), "frame")) +
           measured_text(measured.reports);
}

void measure_file(const MeasureCall& call) {
    if (call.list == "help") return print_all(measurement_help_text());
    if (call.file.empty()) throw UsageError("missing required argument FILE.");
    std::vector<std::string> names;
    if (!call.list.empty()) names = read_measurement_list(call.list);
    reject_measurements_of_events(names, call.list);
    validate_outputs(call, names);
    const double warmup = number_option("warmup", call.warmup, 0.0, 0.0);
    const OpenedSeries opened = open_series(call);
    const SnapshotSeries& series = opened.series;
    if (series.frames == 0) throw Failure(fmt::format("'{}' holds no frames.", call.file));
    const bool tracked = holds_tracks(series);
    if (!tracked) reject_measurements_of_tracks(names, call);
    if (!series.has_m_frame && call.list != "all") require_m_frame_for(names);
    names = measurable(names, tracked, series.has_m_frame);
    if (warmup > 0.0 && series.frame(series.frames - 1).time() < warmup * series.frame(0).period)
        throw Failure(fmt::format("--warmup {} leaves no frame of '{}'.", call.warmup, call.file));

    const MeasuredSeries measured = measure_with_progress(call, series, names, warmup);
    const auto certain = rotation_without_swaps(opened, warmup);
    const Json values = measured_json(measured.reports);
    std::string remarks = opened.remarks;
    const std::array warnings{remark_on_rolling(values), measured.remark};
    for (const std::string& warning : warnings) remarks += warning.empty() ? "" : warning + "\n";
    const Json json = json_of(call, opened, measured, certain, values, remarks);
    if (!call.tables.empty()) {
        make_folder(call.tables);
        write_measured_tables(measured.reports, call.tables);
    }
    if (call.json == "-")
        print_all(json.dump(2) + "\n");
    else if (!call.json.empty())
        write_output(call.json, json.dump(2) + "\n");
    if (call.json != "-" && !call.quiet)
        print_all(report_text(opened, measured, certain) + opened.remarks);
    for (const std::string& warning : warnings)
        if (!warning.empty()) print_warning(warning);
}

void add_measure_command(Subcommand& subcommand) {
    const auto call = std::make_shared<MeasureCall>();
    const char *const output = "Output", *const camera = "Tracks of other programs";
    subcommand.add({{"file", &call->file, "Trajectory, tracks (CSV) or LAMMPS text dump", "FILE"}});
    subcommand.in(output).add({
        measure_option(call->list, "Measurements, separated by commas, or all (or help)"),
        {"--tables", &call->tables, "Folder for the measurements as CSV tables", "DIR"},
        {"--json", &call->json, "File for all results, or - for stdout", "FILE|-"},
        {"--warmup", &call->warmup, "Periods at the start to exclude [0]", "PERIODS"},
        omit_paths_option(),
        {"--quiet", &call->quiet, "No progress and no report"},
    });
    add_track_options(subcommand, call->camera, camera);
    subcommand.in(camera).add({
        {"--amplitude", &call->camera.amplitude,
         "Amplitude of the swirling motion, in disc radii [0]", "NUMBER"},
        {"--container-radius", &call->camera.container_radius,
         "Radius of the container, in disc radii", "NUMBER"},
        {"--max-invalid", &call->max_invalid, "Allowed fraction of invalid frames [0.05]", "SHARE"},
    });
    subcommand.explain(
        "FILE is a trajectory or tracks of swirl, a table of another tracker (CSV), or a LAMMPS "
        "text dump. A frame is invalid if discs overlap or lie outside the container "
        "(--max-invalid).\n");
    subcommand.set_main_options({"--measure", "--tables", "--json", "--warmup", "--camera-fps",
                                 "--scale", "--omega", "--centre", "--amplitude",
                                 "--container-radius"});
    subcommand.set_examples(
        {"swirl measure frames.h5 --measure density,flow --tables maps",
         "swirl measure tracks.csv --camera-fps 960 --scale 24 --omega 11.81 --centre 512,384 "
         "--phase 90 --amplitude 1.9 --container-radius 8.6"});
    subcommand.callback([call] { measure_file(*call); });
}

const Command measure_command("measure", add_measure_command);

}  // namespace
}  // namespace swirl
