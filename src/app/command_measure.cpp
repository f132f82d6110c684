// swirl measure: the measurements of a run, on frames that were recorded: by us, by a camera
// (trackpy), by another program (LAMMPS).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "swirl/app/commands.hpp"
#include "swirl/app/output.hpp"
#include "swirl/app/progress_line.hpp"
#include "swirl/app/stop_signal.hpp"
#include "swirl/app/track_options.hpp"
#include "swirl/files/trajectory.hpp"
#include "swirl/measure/cluster_rotation.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/json.hpp"
#include "swirl/run/measurements.hpp"
#include "swirl/run/report.hpp"
#include "swirl/run/version.hpp"

namespace swirl {
namespace {

using Json = nlohmann::ordered_json;

struct MeasureCall {
    std::string file, list, tables, json, skip;
    TrackTexts camera;
    bool quiet = false;
};

SnapshotSeries open_series(const MeasureCall& call, std::string& remark) {
    if (is_trajectory(call.file)) return series_of(std::make_shared<TrajectoryReader>(call.file));
    const TrackScale scale = track_scale(call.camera, call.file);
    Tracks tracks = read_tracks(call.file);
    if (tracks.filled > 0)
        remark =
            fmt::format("{} positions missing for up to five frames were put back.", tracks.filled);
    return series_of(std::move(tracks), scale);
}

/// Frames do not tell one collision from the next.
void drop_what_needs_events(std::vector<std::string>& names, const std::string& list) {
    for (const std::string& name : names)
        if (find_measurement(name)->needs_events && list != "all")
            throw WrongCall(fmt::format(
                "--measure has '{}' in its list, which needs every collision, and frames do not "
                "hold them; `swirl run --measure {}` can tell.",
                name, name));
    std::erase_if(names,
                  [](const std::string& name) { return find_measurement(name)->needs_events; });
}

void drop_what_needs_tracks(std::vector<std::string>& names, const MeasureCall& call) {
    for (const std::string& name : names)
        if (find_measurement(name)->needs_tracks && call.list != "all")
            throw Failure(fmt::format(
                "The discs of '{}' are not the same in every frame, so '{}' cannot be told of "
                "them; density, flow, profile, radial, temperature, order and packing can.",
                call.file, name));
    std::erase_if(names,
                  [](const std::string& name) { return find_measurement(name)->needs_tracks; });
}

void measure_file(const MeasureCall& call) {
    if (call.list == "help") return print_all(measurement_help_text());
    std::vector<std::string> names;
    if (!call.list.empty()) names = read_measurement_list(call.list);
    drop_what_needs_events(names, call.list);
    if (!call.tables.empty() && names.empty())
        throw WrongCall("--tables needs --measure LIST, which says what to write there.");
    if (!call.json.empty() && call.json != "-") refuse_unwritable(call.json);
    const double skip = number_option("skip", call.skip, 0.0, 0.0);
    std::string remark;
    const SnapshotSeries series = open_series(call, remark);
    if (series.frames == 0) throw Failure(fmt::format("'{}' holds no frames.", call.file));
    const Snapshot first = series.frame(0);
    if (!series.same_discs) drop_what_needs_tracks(names, call);

    Observation observation(first.container_radius, first.period, names, series.same_discs);
    ClusterRotation rotation;
    ProgressLine line(fmt::format("{} frames", series.frames), call.quiet);
    std::int64_t swirl = first.swirls;
    std::uint64_t used = 0;
    for (std::uint64_t k = 0; k < series.frames; ++k) {
        if (stop_signal().load()) throw Interrupted("Stopped before the last frame.");
        const Snapshot s = series.frame(k);
        if (s.time() < skip * s.period) continue;
        if (used > 0 && s.swirls != swirl) {
            rotation.close_block();
            observation.close_block();
        }
        swirl = s.swirls;
        rotation.sample_by_time(s);
        observation.sample(s);
        ++used;
        line.show(double(k + 1) / double(series.frames), fmt::format("frame {}", k + 1));
    }
    line.clear();
    if (used == 0)
        throw Failure(fmt::format("--skip {} leaves no frame of '{}'.", call.skip, call.file));
    rotation.close_block();
    observation.close_block();

    const MeasurementReports measured = observation.report();
    const RotationEstimates found = rotation.estimates();
    const double swirls = series.frame(series.frames - 1).time() / first.period - skip;
    Json json{{"file", call.file},
              {"frames", used},
              {"discs", first.size()},
              {"same_discs", series.same_discs},
              {"rotation",
               {{"by_time", estimate_json(found.by_time)},
                {"rigid_by_time", estimate_json(found.rigid_by_time)}}},
              {"measured", measured_json(measured)},
              {"remark", remark},
              {"version", version()}};
    std::string text = fmt::format(
        "{} discs {}: ϖ/Ω = {} by time, {} rigid; {} frames\n", first.size(),
        sense_of_rotation(found.by_time), with_error(found.by_time.mean, found.by_time.error),
        with_error(found.rigid_by_time.mean, found.rigid_by_time.error), used);
    text += measured_text(measured);
    if (!remark.empty()) text += remark + "\n";
    const double per_swirl = swirls > 0.0 ? double(used) / swirls : 0.0;
    const bool pinned = std::any_of(names.begin(), names.end(), [](const std::string& name) {
        return find_measurement(name)->needs_pinned;
    });
    if (pinned && (per_swirl < 0.8 * samples_per_period || per_swirl > 1.25 * samples_per_period))
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
        .add_option("file", call->file,
                    "a trajectory of swirl, a table of trackpy (CSV), or a LAMMPS text dump")
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
    subcommand.set_examples(
        {"swirl measure frames.h5 --measure density,flow --tables maps",
         "swirl measure tracks.csv --camera-fps 960 --scale 24 --omega 11.81 --centre 512,384 "
         "--container-radius 8.5"});
    subcommand.callback([call] { measure_file(*call); });
}

const Command measure_command(41, "measure",
                              "The measurements, on recorded frames or a camera's tracks.",
                              add_measure_command);

}  // namespace
}  // namespace swirl
