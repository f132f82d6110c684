#include "track/cli/tracked_video.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "swirl/cli/command_line.hpp"
#include "swirl/cli/output.hpp"
#include "swirl/cli/progress_line.hpp"
#include "swirl/cli/stop_signal.hpp"
#include "swirl/cli/track_options.hpp"
#include "swirl/io/optional_file.hpp"
#include "swirl/io/table.hpp"
#include "swirl/io/track_recording.hpp"
#include "swirl/math/unit_circle.hpp"
#include "swirl/render/label.hpp"
#include "swirl/render/still.hpp"
#include "swirl/render/tracked_source.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/python_script.hpp"
#include "swirl/run/report.hpp"
#include "swirl/run/version.hpp"
#include "track/video/spin.hpp"
#include "track/video/tracking.hpp"

namespace swirl {

namespace {

using namespace tracking;

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

double degrees(double radians) { return radians * 180.0 / pi; }
double whole_turn(double angle) { return angle - 360.0 * std::floor(angle / 360.0); }

Json vector_json(const Vec2& v) { return Json::array({v.x, v.y}); }

/// `frames` has {x, y, a, b} for each frame: the position p of the steady camera is seen at
/// (x + a p.x - b p.y, y + b p.x + a p.y).
Json camera_motion_json(const TrackedVideo& video) {
    Json poses = Json::array();
    for (const CameraPose& pose : video.camera.poses) {
        const Vec2 origin = pose.seen({0.0, 0.0});
        poses.push_back({origin.x, origin.y, pose.a, pose.b});
    }
    const auto& frames = video.tracks.frames;
    return {{"source",
             poses.empty() ? Json(nullptr) : Json(video.camera.from_rim ? "rim" : "background")},
            {"shake", video.camera.shake},
            {"drift", video.camera.drift},
            {"zoom", video.camera.zoom},
            {"frames_without", video.frames_without_pose},
            {"first_frame", frames.empty() ? 0 : frames.front().number},
            {"frames", poses}};
}

Json lens_json(const TrackedVideo& video) {
    const Tilt& tilt = video.tilt;
    Json json{{"distortion", video.lens.k}, {"distortion_error", video.lens.k_error}};
    const bool seen = tilt.angle > 0.0 && tilt.angle_error > 0.0;
    json["tilt"] = degrees(tilt.angle);
    json["tilt_error"] = seen ? Json(degrees(tilt.angle_error)) : Json(nullptr);
    json["tilt_below"] = degrees(tilt.below);
    json["tilt_towards"] =
        video.lens.tilted() ? Json(whole_turn(degrees(tilt.towards))) : Json(nullptr);
    json["tilt_towards_error"] =
        video.lens.tilted() ? Json(degrees(tilt.towards_error)) : Json(nullptr);
    json["rim_shift"] = vector_json(video.rim_shift);
    json["squeeze"] = vector_json(video.lens.squeeze);
    json["squeeze_error"] = tilt.squeeze_error;
    json["perspective"] = vector_json(video.lens.perspective);
    json["perspective_error"] = tilt.perspective_error;
    json["readout"] = video.readout;
    json["readout_error"] = video.readout > 0.0 ? Json(video.readout_error) : Json(nullptr);
    return json;
}

/// The most likely swaps of IDs.
Json swaps_json(const TrackedVideo& video) {
    constexpr std::size_t most = 10;
    Json swaps = Json::array();
    for (const PossibleSwap& swap : video.swaps)
        if (swaps.size() < most)
            swaps.push_back({{"frame", video.tracks.frames[swap.frame].number},
                             {"linked_from", video.tracks.frames[swap.from].number},
                             {"discs", {swap.first, swap.second}},
                             {"chance", swap.chance}});
    return swaps;
}

double expected_swaps(const TrackedVideo& video) {
    return std::accumulate(video.swaps.begin(), video.swaps.end(), 0.0,
                           [](double sum, const PossibleSwap& swap) { return sum + swap.chance; });
}

Json video_json(const TrackedVideo& video, const VideoSource& source) {
    Json species = Json::array();
    for (const TrackedSpecies& one : video.species)
        species.push_back({{"number", one.number},
                           {"radius", one.radius},
                           {"radius_error", one.radius * video.radius_error / video.radius},
                           {"radius_scatter", one.scatter}});
    const TrackScale scale = video.scale();
    return {
        {"format", camera_format},
        {"video", stored_path(source.video)},
        {"frames", video.frame_count},
        {"size", {video.width, video.height}},
        {"fps", video.fps > 0.0 ? Json(video.fps) : Json(nullptr)},
        {"discs", video.number},
        {"species", species},
        {"discs_are", video.reading.plane ? "coloured"
                      : video.mixed       ? "dark and bright"
                      : video.bright      ? "bright"
                                          : "dark"},
        {"container",
         {{"radius", video.container_radius},
          {"radius_error", video.container_radius_error},
          {"rim_radius", video.rim_radius},
          {"disc_reach", video.reach},
          {"rim_support", video.rim_support},
          {"frames_without_rim", video.rims_missed},
          {"shake", video.shake}}},
        {"camera_motion", camera_motion_json(video)},
        {"uneven_times", video.uneven_times ? Json(video.jitter) : Json(nullptr)},
        {"times_by_phase", video.by_phase},
        {"path",
         {{"centre", vector_json(video.path.centre)},
          {"centre_error", video.path.centre_error},
          {"amplitude", video.path.amplitude},
          {"amplitude_error", video.path.amplitude_error},
          {"omega", video.path.omega},
          {"omega_error", video.path.omega_error},
          {"phase", first_phase(video)},
          {"phase_error", degrees(video.path.phase_error)},
          {"clockwise", video.path.clockwise},
          {"residual", video.path.residual},
          {"agreeing_frames", video.path.used}}},
        {"lens", lens_json(video)},
        {"light",
         {{"shift", vector_json(video.shading_shift)}, {"shift_error", video.shading_shift_error}}},
        {"quality",
         {{"contact_ratio", video.contact_ratio},
          {"complete_share", video.complete_share},
          {"position_error", video.position_error},
          {"position_error_factor", video.error_factor},
          {"overlap_error", video.overlap_error},
          {"filled_positions", video.filled},
          {"possible_swaps", swaps_json(video)},
          {"possible_swap_count", video.swaps.size()},
          {"expected_swaps", expected_swaps(video)},
          {"excess_discs", video.rejected},
          {"frames_with_excess_discs", video.crowded}}},
        {"millimetres_per_pixel",
         source.disc_diameter ? Json(*source.disc_diameter / (2.0 * video.radius))
         : source.container_diameter
             ? Json(*source.container_diameter / (2.0 * video.container_radius))
             : Json(nullptr)},
        {"warnings", video.warnings},
        // The calibration, which `swirl measure` and `swirl movie` read.
        {"camera",
         {{"camera-fps", scale.frames_per_time},
          {"scale", scale.pixels_per_radius},
          {"omega", video.path.omega},
          {"centre", vector_json(scale.swirl_centre)},
          {"phase", whole_turn(degrees(scale.phase))},
          {"amplitude", scale.amplitude},
          {"container-radius", scale.container_radius},
          {"clockwise", scale.clockwise}}},
        {"version", version()}};
}

/// True if the numbers of the frames do not give their times.
bool has_uneven_steps(const std::vector<double>& times) {
    constexpr double rounding = 1e-6;  // of a step
    if (times.size() < 3) return false;
    const double step = (times.back() - times.front()) / double(times.size() - 1);
    for (std::size_t k = 0; k < times.size(); ++k)
        if (std::abs(times[k] - times.front() - step * double(k)) > rounding * step) return true;
    return false;
}

/// The columns of the table after frame, particle, x and y.
std::vector<TrackColumn> extra_columns(const TrackedVideo& video, const VideoSpins* spins) {
    std::vector<TrackColumn> columns;
    const auto add = [&](const char* name, auto value) {
        TrackColumn column{name, {}};
        for (std::size_t k = 0; k < video.tracks.frames.size(); ++k) {
            column.values.emplace_back();
            for (std::size_t i = 0; i < video.tracks.frames[k].id.size(); ++i)
                column.values.back().push_back(value(k, i));
        }
        columns.push_back(std::move(column));
    };
    add("x_seen", [&](std::size_t k, std::size_t i) { return video.in_image(k, i).x; });
    add("y_seen", [&](std::size_t k, std::size_t i) { return video.in_image(k, i).y; });
    add("radius", [&](std::size_t k, std::size_t i) { return video.tracks.frames[k].radius[i]; });
    add("error", [&](std::size_t k, std::size_t i) { return video.errors[k][i]; });
    add("seen", [&](std::size_t k, std::size_t i) { return video.seen[k][i] ? 1.0 : 0.0; });
    if (has_uneven_steps(video.times))
        add("time", [&](std::size_t k, std::size_t) { return video.times[k]; });
    if (!spins) return columns;
    // Per second if the frame rate is known, else per frame.
    const double rate = 1.0 / video.step();
    const auto add_spin = [&](const char* name, auto value) {
        add(name, [&](std::size_t k, std::size_t i) { return value(spins->discs[k][i]); });
    };
    add_spin("spin", [&](const DiscSpin& s) { return rate * s.turn[2]; });
    add_spin("spin_x", [&](const DiscSpin& s) { return rate * s.turn[0]; });
    add_spin("spin_y", [&](const DiscSpin& s) { return rate * s.turn[1]; });
    add_spin("texture_match", [&](const DiscSpin& s) { return s.match; });
    return columns;
}

Table tracks_table(const Tracks& tracks, const std::vector<TrackColumn>& columns) {
    std::vector<std::string> names{"frame", "particle", "x", "y"};
    for (const TrackColumn& column : columns) names.push_back(column.name);
    Table table(names);
    for (std::size_t k = 0; k < tracks.frames.size(); ++k) {
        const TrackFrame& f = tracks.frames[k];
        for (std::size_t i = 0; i < f.id.size(); ++i) {
            std::vector<Table::Cell> row{f.number, f.id[i], f.position[i].x, f.position[i].y};
            for (const TrackColumn& column : columns) row.emplace_back(column.values[k][i]);
            table.add(std::move(row));
        }
    }
    return table;
}

/// Writes the tracks as HDF5 or CSV, by the extension of `out`.
void write_tracks_file(const TrackedVideo& video, const VideoSource& source,
                       const std::filesystem::path& out, const VideoSpins* spins) {
    const std::vector<TrackColumn> columns = extra_columns(video, spins);
    if (out.extension() != ".h5") return tracks_table(video.tracks, columns).write(out);
    write_track_recording(
        out, video.tracks, video.times, columns,
        {{"version", version()}, {"command", command_line()}, {"film", stored_path(source.video)}});
}

/// One row per frame: number of discs and quality of their positions.
Table frames_table(const TrackedVideo& video) {
    Table table(
        {"frame", "time", "seen", "filled", "missing", "error", "deepest_overlap", "rim_off"});
    for (std::size_t k = 0; k < video.tracks.frames.size(); ++k) {
        const TrackFrame& f = video.tracks.frames[k];
        std::int64_t seen = 0;
        double square = 0.0, deepest = 0.0;
        for (std::size_t i = 0; i < f.id.size(); ++i) {
            if (!video.seen[k][i]) continue;
            ++seen;
            square += video.errors[k][i] * video.errors[k][i];
            for (std::size_t j = 0; j < i; ++j) {
                const Vec2 d = f.position[i] - f.position[j];
                if (video.seen[k][j])
                    deepest = std::max(deepest, f.radius[i] + f.radius[j] - std::sqrt(dot(d, d)));
            }
        }
        const auto there = static_cast<std::int64_t>(f.id.size());
        table.add({f.number, video.times[k], seen, there - seen,
                   static_cast<std::int64_t>(video.number) - there,
                   seen > 0 ? std::sqrt(square / double(seen)) : 0.0, deepest,
                   video.rim_offsets[k]});
    }
    return table;
}

/// One row per disc: how often it was seen.
Table discs_table(const TrackedVideo& video) {
    struct Disc {
        std::int64_t seen = 0, filled = 0, first = -1, last = -1;
        double square = 0.0, radius = 0.0;
    };
    std::vector<Disc> discs(video.number);
    for (std::size_t k = 0; k < video.tracks.frames.size(); ++k) {
        const TrackFrame& f = video.tracks.frames[k];
        for (std::size_t i = 0; i < f.id.size(); ++i) {
            Disc& disc = discs[static_cast<std::size_t>(f.id[i])];
            disc.radius = f.radius[i];
            ++(video.seen[k][i] ? disc.seen : disc.filled);
            if (!video.seen[k][i]) continue;
            if (disc.first < 0) disc.first = f.number;
            disc.last = f.number;
            disc.square += video.errors[k][i] * video.errors[k][i];
        }
    }
    Table table({"particle", "radius", "seen", "filled", "first", "last", "error"});
    for (std::size_t i = 0; i < discs.size(); ++i) {
        const Disc& d = discs[i];
        table.add({static_cast<std::int64_t>(i), d.radius, d.seen, d.filled, d.first, d.last,
                   d.seen > 0 ? std::sqrt(d.square / double(d.seen)) : 0.0});
    }
    return table;
}

std::string tilt_text(const TrackedVideo& video) {
    const Tilt& tilt = video.tilt;
    if (!video.lens.tilted())
        return tilt.squeeze_error > 0.0
                   ? fmt::format("no tilt found, below {:.1f} degrees", degrees(tilt.below))
                   : "no tilt";
    if (tilt.angle > 0.0 && tilt.angle_error == 0.0)
        return fmt::format("tilt {:g} degrees towards {:g} degrees, as given; corrected",
                           degrees(tilt.angle), whole_turn(degrees(tilt.towards)));
    std::string text =
        tilt.angle > 0.0
            ? "tilt " + with_error(degrees(tilt.angle), degrees(tilt.angle_error)) + " degrees"
            : fmt::format("tilt below {:.1f} degrees", degrees(tilt.below));
    text += " towards " +
            with_error(whole_turn(degrees(tilt.towards)), degrees(tilt.towards_error)) + " degrees";
    return text + "; corrected";
}

}  // namespace

TrackingSettings tracking_settings(const std::string& video, const std::optional<double>& fps,
                                   const std::optional<std::int64_t>& frames, ProgressLine& line) {
    TrackingSettings settings;
    settings.video = video;
    settings.fps = fps;
    settings.max_frames = frames.value_or(0);
    settings.stop = &stop_signal();
    settings.planned = [&line](std::int64_t planned, bool spins) {
        // Relative to the search for discs in one frame: measured in a video of the laboratory
        // setup with 600 frames (tests/statistics/remaining_time_test.cpp).
        constexpr double survey = 270.0, missing = 0.05, spin = 2.3;
        const auto n = static_cast<double>(planned);
        std::vector<ProgressStage> stages{{"surveying the video", survey},
                                          {"finding discs", n},
                                          {"finding missing discs", missing * n}};
        if (spins) stages.push_back({"measuring spins", spin * n});
        line.set_stages(std::move(stages));
    };
    settings.progress = [&line](const std::string& what, double share) {
        line.show_stage(what, share);
    };
    return settings;
}

void draw_found(const TrackedVideo& video, const std::string& file,
                const std::filesystem::path& image) {
    // For numbered images ('frames/%05d.png'), the name of their folder.
    const bool is_sequence = file.find('%') != file.npos && fs::path(file).has_parent_path();
    const fs::path shown = is_sequence ? fs::path(file).parent_path() : fs::path(file);
    StillConfig config;
    config.sources = {
        tracked(video.tracks, video.scale(), escaped(shown.filename().string()), file)};
    config.appearance.size = {720, 720};
    config.appearance.coloring = Coloring::id;
    config.at = config.sources.front().from.value_or(0.0);
    config.out = image.string();
    make_still(config);
}

std::filesystem::path write_video_report(const TrackedVideo& video, const VideoSource& source,
                                         const Json& found, const std::filesystem::path& folder) {
    make_folder(folder);
    std::error_code absent;
    fs::remove(folder / "report.html", absent);  // it would describe the old tables
    frames_table(video).write(folder / "frames.csv");
    discs_table(video).write(folder / "discs.csv");
    Json about = found;
    about["command"] = command_line();
    about["lens"]["camera"] = camera_text(video);
    write_output(folder / "found.json", about.dump(2) + "\n");
    draw_found(video, source.video, folder / "video.png");
    run_python_script("track", {folder.string()}, &stop_signal());
    return folder / "report.html";
}

std::string camera_text(const TrackedVideo& video) {
    if (!(video.readout > 0.0)) return tilt_text(video);
    return tilt_text(video) + "; reads a frame in " +
           with_error(video.readout, video.readout_error) + " of a frame interval; corrected";
}

double first_phase(const TrackedVideo& video) {
    return whole_turn(degrees(video.path.angle(video.times.front())));
}

Json write_tracks(const TrackedVideo& video, const VideoSource& source,
                  const std::filesystem::path& out, const VideoSpins* spins) {
    Json json = video_json(video, source);
    if (spins)
        json["spins"] = {{"step", spins->step},
                         {"steps_measured", spins->measured},
                         {"texture_match", spins->match}};
    const auto write_camera = [&] { write_output(camera_file(out), json.dump(2) + "\n"); };
    // Whenever the process is killed, tracks are never next to the calibration of other tracks, and
    // the same call works again.
    std::error_code ignored;
    const bool replaces = file_exists(out);
    replaces ? void(fs::remove(camera_file(out), ignored)) : write_camera();
    try {
        write_tracks_file(video, source, out, spins);
    } catch (...) {
        if (!replaces) fs::remove(camera_file(out), ignored);
        throw;
    }
    if (replaces) write_camera();
    return json;
}

}  // namespace swirl
