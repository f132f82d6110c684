// swirl track: finds the container, its path and the discs in a video, and tracks the discs.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "swirl/cli/command_line.hpp"
#include "swirl/cli/commands.hpp"
#include "swirl/cli/output.hpp"
#include "swirl/cli/progress_line.hpp"
#include "swirl/cli/stop_signal.hpp"
#include "swirl/cli/track_options.hpp"
#include "swirl/io/optional_file.hpp"
#include "swirl/math/unit_circle.hpp"
#include "swirl/render/label.hpp"
#include "swirl/render/movie.hpp"
#include "swirl/render/movie_file.hpp"
#include "swirl/render/tracked_source.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/reading.hpp"
#include "swirl/run/report.hpp"
#include "swirl/run/shell_word.hpp"
#include "track/cli/recorded_path.hpp"
#include "track/cli/tracked_video.hpp"
#include "track/cli/video_options.hpp"
#include "track/video/spin.hpp"
#include "track/video/tracking.hpp"

namespace swirl {
namespace {

struct TrackCall {
    VideoSource source;
    std::string out, path, json, overlay, report, image;
    std::optional<double> fps;
    std::optional<std::int64_t> discs, frames;
    std::optional<std::int64_t> from, to;
    std::string skip, accept, tilt;
    bool spin = false, quiet = false, verbose = false, overwrite = false;
};

using namespace tracking;

/// The camera's tilt as given. Throws UsageError.
KnownCamera known_camera(const TrackCall& call) {
    constexpr double radians = pi / 180.0, max_tilt = 45.0;  // degrees
    KnownCamera camera;
    if (call.tilt.empty()) return camera;
    const std::size_t comma = call.tilt.find(',');
    const bool has_side = comma != call.tilt.npos;
    const auto angle = read_number(call.tilt.substr(0, comma));
    const auto towards = has_side ? read_number(call.tilt.substr(comma + 1)) : std::optional(0.0);
    if (!angle || !towards || !(*angle >= 0.0 && *angle <= max_tilt) || (!has_side && *angle > 0.0))
        throw UsageError(fmt::format(
            "--tilt is '{}', but it must be 0, or two angles in degrees: the tilt (at most {}) and "
            "the side of the camera, for example 5,270.",
            call.tilt, max_tilt));
    camera.tilt = radians * *angle;
    camera.towards = radians * *towards;
    return camera;
}

/// Frame ranges such as "40,60-64". Throws UsageError.
std::vector<FrameRange> frame_ranges(const std::string& text) {
    std::vector<FrameRange> ranges;
    if (text.empty()) return ranges;
    for (const std::string_view part : split(text, ",")) {
        const std::size_t dash = part.find('-');
        const auto first = read_whole_number(part.substr(0, dash));
        const auto last = dash == part.npos ? first : read_whole_number(part.substr(dash + 1));
        if (!first || !last || *first < 0 || *last < *first)
            throw UsageError(fmt::format(
                "--ignore-frames is '{}', but it must be numbers of frames, for example 40,60-64.",
                text));
        ranges.push_back({*first, *last});
    }
    return ranges;
}

/// The frames to track, and what to accept. Throws UsageError.
void set_frames(const TrackCall& call, TrackingSettings& settings) {
    if (call.from && *call.from < 0)
        throw UsageError(
            fmt::format("--first-frame is {}, but it must be at least 0.", *call.from));
    settings.first_frame = call.from.value_or(0);
    if (call.to) {
        if (call.frames) throw UsageError("--last-frame and --max-frames exclude each other.");
        if (*call.to < settings.first_frame)
            throw UsageError(
                fmt::format("--last-frame is {}, but it must be at least {}, the first frame.",
                            *call.to, settings.first_frame));
        settings.max_frames = *call.to - settings.first_frame + 1;
    }
    settings.skip = frame_ranges(call.skip);
    if (call.accept.empty()) return;
    settings.accept_duplicates = call.accept.find("duplicates") != call.accept.npos;
    settings.accept_missing = call.accept.find("missing") != call.accept.npos;
    if (call.accept != "duplicates" && call.accept != "missing" &&
        call.accept != "duplicates,missing" && call.accept != "missing,duplicates")
        throw UsageError(fmt::format(
            "--correct-frames is '{}', but it must be duplicates, missing or duplicates,missing.",
            call.accept));
}

/// The camera's motion, if it was removed.
std::string camera_motion_text(const TrackedVideo& video) {
    const CameraMotion& camera = video.camera;
    if (camera.poses.empty()) return "";
    std::string text =
        fmt::format("  shake       {:.2f} pixels from frame to frame, drift {:.1f} pixels",
                    camera.shake, camera.drift);
    if (!camera.from_rim) text += fmt::format(", zoom {:.2f} %", 100.0 * camera.zoom);
    return text +
           (camera.from_rim ? "; removed, from the rim\n" : "; removed, from the background\n");
}

/// The shift by light from one side, if it is more than its error.
std::string light_text(const TrackedVideo& video) {
    const double shift = std::hypot(video.shading_shift.x, video.shading_shift.y);
    if (!(shift > 2.0 * video.shading_shift_error)) return "";
    const double towards = 360.0 * turns_of({video.shading_shift.x, -video.shading_shift.y});
    return fmt::format(
        "  light       from one side; shifts discs by {} pixels towards {:.0f} degrees; removed\n",
        with_error(shift, video.shading_shift_error),
        towards - 360.0 * std::floor(towards / 360.0));
}

/// What the claimed error of a position follows from.
std::string error_source(const TrackedVideo& video) {
    if (!video.contact_fitted && video.bounce_error > 0.0) return "bounces off the wall";
    if (video.position_error <= video.overlap_error)
        return video.contact_fitted ? "overlaps" : "free flights";
    return "edges";
}

std::string species_text(const TrackedVideo& video) {
    std::string text;
    for (const TrackedSpecies& one : video.species)
        text += fmt::format("{}{} of radius {} pixels", text.empty() ? "" : ", ", one.number,
                            with_error(one.radius, one.radius * video.radius_error / video.radius));
    return text;
}

/// What was found, and how well.
std::string summary(const TrackedVideo& video, const TrackCall& call) {
    return fmt::format("{}: {} tracked in {} frames\n", call.source.video,
                       counted(std::int64_t(video.number), "disc"), video.frame_count) +
           report_line(
               "swirl",
               fmt::format("Ω = {} rad/{}, amplitude {:.3f} disc radii, {}",
                           with_error(video.path.omega, video.path.omega_error),
                           video.fps > 0.0 ? "s" : "frame", video.path.amplitude / video.radius,
                           video.path.clockwise ? "clockwise" : "counter-clockwise")) +
           report_line("quality",
                       fmt::format("{:.2f} % of frames have all discs; error {:.3f} pixels per "
                                   "position{}",
                                   100.0 * video.complete_share, video.position_error,
                                   video.swaps.empty() ? "" : "; some IDs are uncertain")) +
           report_line("tracks", call.out);
}

/// The lines that only --verbose prints.
std::string geometry_text(const TrackedVideo& video, const TrackCall& call) {
    const std::string unit = video.fps > 0.0 ? "s" : "frame";
    const double period = 2.0 * pi / video.path.omega;
    const double ratio = video.container_radius / video.radius;
    const double step = video.times.size() > 1 ? (video.times.back() - video.times.front()) /
                                                     double(video.times.size() - 1)
                                               : 1.0;
    std::string text = fmt::format(
        "  video       {}x{} pixels\n  discs       {}, {} floor\n"
        "  container   radius {} pixels, {} disc radii\n  path        {}\n"
        "  centre      {}, {} pixels\n  amplitude   {} pixels, {:.3f} disc radii\n"
        "  period      {} {}, {:.1f} frames; Ω = {} rad/{}\n"
        "  phase       {} degrees in the first frame\n"
        "  lens        distortion {}{}\n  camera      {}\n{}{}"
        "  filled in   {} positions\n  error       from {}\n",
        video.width, video.height, species_text(video),
        video.reading.plane ? "of several colours on the"
        : video.mixed       ? "dark and bright on the"
        : video.bright      ? "bright on a dark"
                            : "dark on a bright",
        with_error(video.container_radius, video.container_radius_error),
        with_error(ratio, std::hypot(video.container_radius_error, ratio * video.radius_error) /
                              video.radius),
        video.path.clockwise ? "clockwise in the image" : "counter-clockwise",
        with_error(video.path.centre.x, video.path.centre_error),
        with_error(video.path.centre.y, video.path.centre_error),
        with_error(video.path.amplitude, video.path.amplitude_error),
        video.path.amplitude / video.radius,
        with_error(period, period * video.path.omega_error / video.path.omega), unit, period / step,
        with_error(video.path.omega, video.path.omega_error), unit,
        with_error(first_phase(video), video.path.phase_error * 180.0 / pi),
        with_error(video.lens.k, video.lens.k_error), video.lens.k != 0.0 ? ", corrected" : "",
        camera_text(video), camera_motion_text(video), light_text(video), video.filled,
        error_source(video));
    if (call.source.disc_diameter)
        text += fmt::format("  scale       {:.5f} mm per pixel, from the discs\n",
                            *call.source.disc_diameter / (2.0 * video.radius));
    if (call.source.container_diameter)
        text += fmt::format("  scale       {:.5f} mm per pixel, from the container\n",
                            *call.source.container_diameter / (2.0 * video.container_radius));
    return text;
}

/// Writes the video with the detected discs drawn over it.
void make_overlay(const TrackedVideo& video, const TrackCall& call) {
    ImageMotion motion;
    if (!video.tracks.frames.empty()) motion.first = video.tracks.frames.front().number;
    for (const CameraPose& pose : video.camera.poses)
        motion.poses.push_back({pose.seen({0.0, 0.0}), pose.a, pose.b});
    MovieConfig config;
    config.out = call.overlay;
    config.sources = {tracked(video.tracks, video.scale(),
                              escaped(std::filesystem::path(call.source.video).filename().string()),
                              call.source.video, 0, motion)};
    const FrameSource& source = config.sources.front();
    config.appearance.size = {960, 960};
    config.appearance.coloring = Coloring::id;
    config.appearance.trails = true;
    config.frames_per_second = movie_format(call.overlay) == MovieFormat::gif ? 25 : 60;
    config.pace = config.frames_per_second / source.frames_per_period;
    config.start = source.from.value_or(0.0);
    config.frames = static_cast<int>(video.frame_count);
    if (const auto wrong = problem(config)) throw UsageError(*wrong);
    ProgressLine line(call.overlay, call.quiet);
    MovieControl control;
    control.stop = &stop_signal();
    control.progress = [&](int done, int of) { line.show(double(done) / of, "overlay"); };
    const MovieResult result = make_movie(config, control);
    line.clear();
    if (!result.complete)
        throw Interrupted(
            fmt::format("stopped before the overlay was complete; the tracks are in '{}'.\n"
                        "hint: to draw the overlay, use swirl movie {} --over {} --out {}",
                        call.out, shell_word(call.out), shell_word(call.source.video),
                        shell_word(call.overlay)));
}

/// Without tracks only the container is followed.
void reject_options_of_tracks(const TrackCall& call) {
    for (const auto& [name, given] :
         {std::pair("overlay", !call.overlay.empty()), std::pair("report", !call.report.empty()),
          std::pair("image", !call.image.empty()), std::pair("json", !call.json.empty()),
          std::pair("spin", call.spin), std::pair("accept", !call.accept.empty())})
        if (given)
            throw UsageError(
                fmt::format("--{} is given, but --out is not.\nhint: give --out FILE.csv.", name));
}

/// Throws UsageError or Failure before any work is done.
void validate(const TrackCall& call) {
    if (call.out.empty() && call.path.empty())
        throw UsageError(
            "missing required option --out FILE.csv|FILE.h5, or --motion-out FILE.csv.");
    if (!call.path.empty() && !call.path.ends_with(".csv"))
        throw UsageError(
            fmt::format("--motion-out is '{}', but its name must end with .csv.", call.path));
    if (call.out.empty()) reject_options_of_tracks(call);
    if (!call.out.empty() && !is_named_as_tracks(call.out))
        throw UsageError(
            fmt::format("--out is '{}', but its name must end with .csv or .h5.", call.out));
    check_video_options(call.fps, call.frames);
    if (call.discs && !(*call.discs > 0))
        throw UsageError(fmt::format("--discs is {}, but it must be at least 1.", *call.discs));
    for (const auto& [name, given] :
         {std::pair("container-diameter", call.source.container_diameter),
          std::pair("disc-diameter", call.source.disc_diameter)})
        if (given && !(*given > 0.0))
            throw UsageError(fmt::format("--{} is {}, but it must be above 0.", name, *given));
    if (!call.out.empty()) reject_unwritable(call.out);
    if (!call.path.empty()) reject_unwritable(call.path);
    if (!call.overlay.empty()) {
        if (!movie_format(call.overlay))
            throw UsageError(
                fmt::format("--overlay is '{}', but its name must end with .mp4, .webm or .gif.",
                            call.overlay));
        reject_unwritable(call.overlay);
    }
    if (!call.image.empty() && !call.image.ends_with(".png"))
        throw UsageError(
            fmt::format("--image is '{}', but its name must end with .png.", call.image));
    if (!call.image.empty()) reject_unwritable(call.image);
    if (!call.json.empty() && call.json != "-") reject_unwritable(call.json);
    std::vector<std::filesystem::path> all{call.source.video, call.out,   call.path,
                                           call.overlay,      call.image, call.json};
    if (!call.out.empty()) all.push_back(camera_file(call.out));
    if (!call.report.empty())
        for (const char* file : video_report_files)
            all.push_back(std::filesystem::path(call.report) / file);
    reject_same_files(all);
    if (!call.report.empty()) make_folder(call.report);
    for (const std::string& file : {call.out, call.path})
        if (!call.overwrite && file_exists(file))
            throw Failure(
                fmt::format("'{}' already exists.\nhint: use --overwrite to replace it.", file));
}

void warn_of_missing_spins(const VideoSpins& spins, TrackedVideo& video) {
    constexpr double enough = 0.9;  // fraction of the steps
    if (spins.measured >= enough) return;
    video.warnings.push_back(fmt::format(
        "Spins could be measured in only {:.0f} % of the steps of {} frame{}. A clearer pattern on "
        "the discs, sharper images or a higher frame rate would help.",
        100.0 * spins.measured, spins.step, spins.step == 1 ? "" : "s"));
}

void warn_of_contradictory_diameters(const VideoSource& source, TrackedVideo& video) {
    constexpr double tolerance = 0.03;  // share of the ratio; radii are found to about 1 %
    if (!source.container_diameter || !source.disc_diameter) return;
    const double given = *source.container_diameter / *source.disc_diameter;
    const double found = video.container_radius / video.radius;
    if (std::abs(given / found - 1.0) <= tolerance) return;
    video.warnings.push_back(fmt::format(
        "The ratio of container diameter to disc diameter is {:.3f} as given, but {:.3f} in the "
        "video. One of them may be wrong, or the container's is the outer diameter.",
        given, found));
}

/// Follows the container alone, on any path.
void record_path(const TrackCall& call, TrackingSettings& settings, ProgressLine& line) {
    const TrackedVideo video = track_container(settings);
    const RecordedMotion motion = record_motion(video);
    line.clear();
    write_motion(video, motion, call.source, call.path);
    for (const std::string& text : video.warnings) print_warning(text);
    for (const std::string& text : motion_warnings(motion)) print_warning(text);
    if (!call.quiet) print_all(motion_text(video, motion, call.source, call.path));
}

void track(TrackCall call) {
    if (call.source.video.empty()) throw UsageError("missing required argument VIDEO.");
    const KnownCamera camera = known_camera(call);
    ProgressLine line(call.source.video, call.quiet);
    TrackingSettings settings = tracking_settings(call.source.video, call.fps, call.frames, line);
    set_frames(call, settings);
    validate(call);
    settings.discs = call.discs;
    settings.camera = camera;
    settings.spins = call.spin;
    if (call.source.disc_diameter && call.source.container_diameter)
        settings.radius_share = *call.source.disc_diameter / *call.source.container_diameter;
    if (call.out.empty()) return record_path(call, settings, line);
    TrackedVideo video = track_video(settings);
    std::optional<VideoSpins> spins;
    if (call.spin) spins = measure_spins(video, settings);
    line.clear();
    if (spins) warn_of_missing_spins(*spins, video);
    warn_of_contradictory_diameters(call.source, video);

    std::optional<RecordedMotion> motion;
    if (!call.path.empty()) {
        motion = record_motion(video);
        write_motion(video, *motion, call.source, call.path);
        for (const std::string& text : motion_warnings(*motion)) video.warnings.push_back(text);
    }
    nlohmann::ordered_json json =
        write_tracks(video, call.source, call.out, spins ? &*spins : nullptr);
    if (!call.overlay.empty()) make_overlay(video, call);
    if (!call.image.empty()) draw_found(video, call.source.video, call.image);
    std::filesystem::path report;
    if (!call.report.empty()) report = write_video_report(video, call.source, json, call.report);
    for (const std::string& text : video.warnings) fmt::print(stderr, "warning: {}\n", text);
    if (call.json == "-") return print_all(json.dump(2) + "\n");
    if (!call.json.empty()) write_output(call.json, json.dump(2) + "\n");
    if (call.quiet) return;
    print_all(summary(video, call) + (call.verbose ? geometry_text(video, call) : "") +
              (motion ? motion_text(video, *motion, call.source, call.path) : ""));
    if (!report.empty()) print_all(fmt::format("wrote {}\n", report.string()));
}

void add_track_command(Subcommand& subcommand) {
    const auto call = std::make_shared<TrackCall>();
    const auto add = [&](const char* name, auto& into, const char* type, const char* description) {
        subcommand.add({{name, &into, description, type}});
    };
    add("video", call->source.video, "VIDEO", "Video file, or numbered images (%05d.png)");
    add("--out", call->out, "FILE.csv|FILE.h5",
        "Tracks; calibration goes next to them (.camera.json)");
    add("--motion-out", call->path, "FILE.csv", "Motion of the container, for swirl run --motion");
    add("--fps", call->fps, "N", "Frames per second [from the video]");
    add("--container-diameter", call->source.container_diameter, "MM",
        "Inner diameter of the container");
    add("--disc-diameter", call->source.disc_diameter, "MM", "Diameter of a disc");
    add("--discs", call->discs, "N", "Number of discs [counted]");
    add("--tilt", call->tilt, "DEG,SIDE",
        "Camera tilt, and its side counter-clockwise from +x [found]");
    add("--max-frames", call->frames, "N", "Number of frames to track [all]");
    add("--first-frame", call->from, "K", "First frame to track, counted from 0 [0]");
    add("--last-frame", call->to, "K", "Last frame to track [the last one]");
    add("--ignore-frames", call->skip, "LIST", "Frames that are not used, such as 40,60-64");
    add("--correct-frames", call->accept, "duplicates|missing|duplicates,missing",
        "Faults of frames to correct");
    add("--overlay", call->overlay, "FILE", "Movie of the video with the discs drawn over it");
    add("--image", call->image, "FILE.png", "First frame with the discs drawn over it");
    add("--report", call->report, "DIR", "Folder for a report on the tracking, report.html");
    add("--json", call->json, "FILE|-", "File for all results, or - for standard output");
    subcommand.add({
        {"--spin", &call->spin, "Measure spins from textures; adds columns to the tracks"},
        {"--overwrite", &call->overwrite, "Replace existing tracks"},
        omit_paths_option(),
        {"--verbose", &call->verbose, "Also print the geometry of container and camera"},
        {"--quiet", &call->quiet, "No progress line and no summary"},
    });
    subcommand.set_main_options({"--out", "--motion-out", "--fps", "--container-diameter",
                                 "--disc-diameter", "--discs", "--tilt", "--overlay", "--report",
                                 "--json", "--spin"});
    subcommand.set_examples({"swirl track dish.mp4 --out tracks.csv",
                             "swirl track slow-motion.mp4 --fps 960 --out tracks.csv",
                             "swirl track shaker.mp4 --motion-out shaker.csv",
                             "swirl measure tracks.csv --measure density,flow,slip",
                             "swirl movie tracks.csv --over dish.mp4 --out overlay.mp4"});
    subcommand.callback([call] { track(*call); });
}

const Command track_command("track", add_track_command);

}  // namespace
}  // namespace swirl
