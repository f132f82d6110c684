// swirl track: from a film to tracks, and to everything about the dish that can be seen in it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "swirl/cli/commands.hpp"
#include "swirl/cli/output.hpp"
#include "swirl/cli/progress_line.hpp"
#include "swirl/cli/stop_signal.hpp"
#include "swirl/cli/track_options.hpp"
#include "swirl/cli/tracked_video.hpp"
#include "swirl/math/unit_circle.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/reading.hpp"
#include "swirl/run/report.hpp"
#include "swirl/run/shell_word.hpp"
#ifdef SWIRL_CAMERA
#include "swirl/render/label.hpp"
#include "swirl/render/movie.hpp"
#include "swirl/render/movie_file.hpp"
#include "swirl/tracking/spin.hpp"
#include "swirl/tracking/tracking.hpp"
#endif

namespace swirl {
namespace {

struct TrackCall {
    VideoSource source;
    std::string out, json, overlay, report;
    std::optional<double> fps;
    std::optional<std::int64_t> discs, frames;
    std::string tilt;
    std::optional<double> view_angle;
    bool spin = false, quiet = false, overwrite = false;
};

#ifndef SWIRL_CAMERA

void track(const TrackCall&) { throw_no_eyes(); }

#else

/// What is said of the camera. Throws WrongCall.
KnownCamera camera_of(const TrackCall& call) {
    constexpr double radians = pi / 180.0;
    KnownCamera camera;
    if (call.view_angle) {
        if (!(*call.view_angle >= 0.0 && *call.view_angle <= 150.0))
            throw UsageError(fmt::format(
                "--view-angle is {}, but it must be from 0 to 150 degrees.", *call.view_angle));
        camera.view_angle = radians * *call.view_angle;
    }
    if (call.tilt.empty()) return camera;
    const std::size_t comma = call.tilt.find(',');
    const auto angle = read_number(call.tilt.substr(0, comma));
    const auto towards =
        comma == call.tilt.npos ? std::optional(0.0) : read_number(call.tilt.substr(comma + 1));
    if (!angle || !towards || !(*angle >= 0.0 && *angle <= 45.0) ||
        (comma == call.tilt.npos && *angle > 0.0))
        throw UsageError(fmt::format(
            "--tilt is '{}', but it must be 0, or two angles in degrees: up to 45, and the side "
            "where the camera stands, as in 5,270.",
            call.tilt));
    camera.tilt = radians * *angle;
    camera.towards = radians * *towards;
    return camera;
}

std::string text_of(const TrackedVideo& video, const TrackCall& call) {
    const std::string unit = video.fps > 0.0 ? "s" : "picture";
    std::string sizes;
    for (const TrackedKind& kind : video.kinds)
        sizes += fmt::format("{}{} of {:.2f} pixels radius", sizes.empty() ? "" : ", ", kind.number,
                             kind.radius);
    const double period = 2.0 * pi / video.path.omega;
    const double step = video.times.size() > 1 ? (video.times.back() - video.times.front()) /
                                                     double(video.times.size() - 1)
                                               : 1.0;
    std::string text = fmt::format(
        "{}: {} discs in {} pictures of {}x{}.\n"
        "  discs       {}, {} on {} floor\n"
        "  dish        radius {:.2f} pixels, {:.3f} disc radii\n"
        "  swirl       centre {}, {}; amplitude {} pixels, {:.3f} disc radii; {}\n"
        "  path        {}\n"
        "  period      {} {}, {:.1f} pictures; Ω = {} rad/{}\n"
        "  phase       {} degrees at the first picture\n"
        "  lens        distortion {}{}\n"
        "  camera      {}\n"
        "  all seen    in {:.2f} % of the pictures; {} positions filled in\n"
        "  error       {:.3f} pixels of a place, from {}\n",
        call.source.video, video.number, video.pictures, video.width, video.height, sizes,
        video.bright ? "bright" : "dark", video.bright ? "a dark" : "a bright",
        video.container_radius, video.container_radius / video.radius,
        with_error(video.path.centre.x, video.path.centre_error),
        with_error(video.path.centre.y, video.path.centre_error),
        with_error(video.path.amplitude, video.path.amplitude_error),
        video.path.amplitude / video.radius,
        video.path.clockwise ? "clockwise in the picture" : "counter-clockwise", shape_text(video),
        with_error(period, period * video.path.omega_error / video.path.omega), unit, period / step,
        with_error(video.path.omega, video.path.omega_error), unit,
        with_error(phase_of(video), video.path.phase_error * 180.0 / pi),
        with_error(video.lens.k, video.lens.k_error), video.lens.k != 0.0 ? ", corrected" : "",
        tilt_text(video), 100.0 * video.complete, video.filled, video.position_error,
        video.position_error > video.overlap_error ? "the edges" : "overlaps that cannot be");
    if (call.source.disc_diameter)
        text += fmt::format("  scale       {:.5f} mm a pixel, from the discs\n",
                            *call.source.disc_diameter / (2.0 * video.radius));
    if (call.source.container_diameter)
        text += fmt::format("  scale       {:.5f} mm a pixel, from the dish\n",
                            *call.source.container_diameter / (2.0 * video.container_radius));
    for (const std::string& warning : video.warnings) text += warning + "\n";
    return text;
}

/// The film with the discs that were found drawn over it, picture by picture.
void make_overlay(const TrackedVideo& video, const TrackCall& call) {
    MovieConfig config;
    config.out = call.overlay;
    config.sources = {tracked(video.tracks, video.scale(),
                              escaped(std::filesystem::path(call.source.video).filename().string()),
                              call.source.video)};
    const FrameSource& source = config.sources.front();
    config.appearance.size = {960, 960};
    config.appearance.coloring = Coloring::id;
    config.appearance.trails = true;
    config.frames_per_second = movie_format(call.overlay) == MovieFormat::gif ? 25 : 60;
    config.pace = config.frames_per_second / source.frames_per_swirl;
    config.start = source.from.value_or(0.0);
    config.frames = static_cast<int>(video.pictures);
    if (const auto wrong = problem(config)) throw UsageError(*wrong);
    ProgressLine line(call.overlay, call.quiet);
    MovieControl control;
    control.stop = &stop_signal();
    control.progress = [&](int done, int of) { line.show(double(done) / of, "overlay"); };
    const MovieResult result = make_movie(config, control);
    line.clear();
    if (!result.complete)
        throw Interrupted(
            fmt::format("Stopped while the overlay was drawn; the tracks are in '{}', and swirl "
                        "movie {} --over "
                        "{} --out {} draws it.",
                        call.out, shell_word(call.out), shell_word(call.source.video),
                        shell_word(call.overlay)));
}

void track(const TrackCall& call) {
    if (call.out.empty())
        throw UsageError("There is nowhere for the tracks to go: give --out FILE.csv or FILE.h5.");
    if (!is_named_as_tracks(call.out))
        throw UsageError(
            fmt::format("--out is '{}', but its name must end with .csv or .h5.", call.out));
    check_video_options(call.fps, call.frames);
    if (call.discs && !(*call.discs > 0))
        throw UsageError(fmt::format("--discs is {}, but it must be at least 1.", *call.discs));
    for (const auto& [name, given] : {std::pair("dish-diameter", call.source.container_diameter),
                                      std::pair("disc-diameter", call.source.disc_diameter)})
        if (given && !(*given > 0.0))
            throw UsageError(fmt::format("--{} is {}, but it must be above 0.", name, *given));
    const KnownCamera camera = camera_of(call);
    reject_unwritable(call.out);
    if (!call.overlay.empty()) {
        if (!movie_format(call.overlay))
            throw UsageError(
                fmt::format("--overlay is '{}', but its name must end with .mp4, .webm or .gif.",
                            call.overlay));
        reject_unwritable(call.overlay);
    }
    if (!call.json.empty() && call.json != "-") reject_unwritable(call.json);
    std::vector<std::filesystem::path> all{call.source.video, call.out, camera_file(call.out),
                                           call.overlay, call.json};
    if (!call.report.empty())
        for (const char* file : video_report_files)
            all.push_back(std::filesystem::path(call.report) / file);
    reject_same_files(all);
    if (!call.report.empty()) make_folder(call.report);
    if (!call.overwrite && std::filesystem::exists(call.out))
        throw Failure(fmt::format("'{}' is there already; --overwrite replaces it.", call.out));

    ProgressLine line(call.source.video, call.quiet);
    TrackingSettings settings = tracking_settings(call.source.video, call.fps, call.frames, line);
    settings.discs = call.discs;
    settings.camera = camera;
    TrackedVideo video = track_video(settings);
    std::optional<VideoSpins> spins;
    if (call.spin) spins = spins_of(video, settings);
    line.clear();
    if (spins && spins->measured < 0.9)
        video.warnings.push_back(fmt::format(
            "The texture of the discs tells their turning in {:.0f} % of the steps of {} picture{} "
            "only: more of a pattern on them, sharper pictures or more of them would help.",
            100.0 * spins->measured, spins->step, spins->step == 1 ? "" : "s"));
    if (call.source.container_diameter && call.source.disc_diameter) {
        const double given = *call.source.container_diameter / *call.source.disc_diameter;
        const double seen = video.container_radius / video.radius;
        if (std::abs(given / seen - 1.0) > 0.03)
            video.warnings.push_back(fmt::format(
                "The diameters given are as {:.3f} to 1, but the dish in the film is {:.3f} times "
                "as wide as a disc: one of them is wrong, or the dish's is that of its outside.",
                given, seen));
    }

    const nlohmann::ordered_json json =
        write_tracks(video, call.source, call.out, spins ? &*spins : nullptr);
    if (!call.overlay.empty()) make_overlay(video, call);
    std::filesystem::path report;
    if (!call.report.empty()) report = write_video_report(video, call.source, json, call.report);
    if (call.json == "-") return print_all(json.dump(2) + "\n");
    if (!call.json.empty()) write_output(call.json, json.dump(2) + "\n");
    if (!call.quiet)
        print_all(text_of(video, call) +
                  (report.empty() ? "" : fmt::format("wrote {}\n", report.string())));
}

#endif

void add_track_command(Subcommand& subcommand) {
    const auto call = std::make_shared<TrackCall>();
    const auto add = [&](const char* name, auto& into, const char* type, const char* description) {
        return subcommand.add_option(name, into, description)->type_name(type);
    };
    add("film", call->source.video, "VIDEO",
        "a film that ffmpeg reads, numbered pictures ('frames/%05d.png'), or a camera "
        "(/dev/video0)")
        ->required();
    add("--out", call->out, "FILE.csv|FILE.h5",
        "the tracks, as trackpy writes them, or as HDF5 (H5MD); what was found of the dish goes "
        "beside them "
        "(.camera.json), where swirl measure finds it");
    add("--fps", call->fps, "NUMBER", "pictures per second [as the film says]");
    add("--dish-diameter", call->source.container_diameter, "MM",
        "of the dish inside, in millimetres");
    add("--disc-diameter", call->source.disc_diameter, "MM", "of a disc, in millimetres");
    add("--discs", call->discs, "NUMBER", "how many there are [counted]");
    add("--tilt", call->tilt, "DEGREES,TOWARDS",
        "of the camera, and the side where it stands, counter-clockwise from the right; 0: looks "
        "straight down [found from the rim]");
    add("--view-angle", call->view_angle, "DEGREES",
        "that the camera sees over the height of a picture; balls far from the middle look longer "
        "by it [found if the camera is tilted]");
    add("--frames", call->frames, "NUMBER", "only the first so many pictures");
    add("--overlay", call->overlay, "FILE", "a movie of the film with the discs drawn over it");
    add("--report", call->report, "DIR",
        "a report of the film, DIR/report.html: what was found, how well, and where not");
    add("--json", call->json, "FILE|-", "write everything found to FILE, or - for stdout");
    subcommand.add_flag("--spin", call->spin,
                        "how fast each disc turns, from its texture: columns spin (about the "
                        "vertical), spin_x, spin_y, and the paper's PIV");
    subcommand.add_flag("--overwrite", call->overwrite, "replace tracks that are there");
    subcommand.add_flag("--quiet", call->quiet, "no progress, no report");
    subcommand.set_examples({"swirl track dish.mp4 --out tracks.csv",
                             "swirl track slow-motion.mp4 --fps 960 --out tracks.csv",
                             "swirl measure tracks.csv --measure density,flow,slip",
                             "swirl movie tracks.csv --over dish.mp4 --out overlay.mp4"});
    subcommand.callback([call] { track(*call); });
}

const Command track_command(40, "track", "From a film of a dish to the tracks of its discs.",
                            add_track_command);

}  // namespace
}  // namespace swirl
