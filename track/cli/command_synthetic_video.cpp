// swirl synthetic-video: a video of a run as a camera would record it, with its ground truth.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <tuple>

#include "swirl/cli/commands.hpp"
#include "swirl/cli/output.hpp"
#include "swirl/cli/progress_line.hpp"
#include "swirl/cli/run_options.hpp"
#include "swirl/cli/stop_signal.hpp"
#include "swirl/io/optional_file.hpp"
#include "swirl/io/table.hpp"
#include "swirl/math/unit_circle.hpp"
#include "swirl/render/frame_source.hpp"
#include "swirl/render/movie_file.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/json.hpp"
#include "swirl/run/path_parameter.hpp"
#include "swirl/run/version.hpp"
#include "track/synthetic/camera_view.hpp"

namespace swirl {
namespace {

namespace fs = std::filesystem;

constexpr int worst_quality = 51;  // of x264 (its constant rate factor)

/// Default view angle of a tilted camera, degrees: that of a phone close to the container.
constexpr double tilted_view_angle = 30.0;

struct SyntheticVideoCall {
    std::shared_ptr<ParameterTexts> parameters;
    std::string out, preset = "laboratory";
    double periods = 3.0, start = 20.0;
    std::optional<std::int64_t> frames, frames_per_period;
    std::optional<double> scale, noise, blur, exposure, distortion, glare, texture, gloss, disc,
        floor, rim, table, flicker, tilt, towards, view_angle, rim_height, light_from,
        light_elevation, light_share, contrast;
    std::optional<double> rolling_shutter, auto_exposure, floor_pattern, disc_variation,
        transparency, hands, other_disc, speed_variation, rest, pause, shadow;
    std::optional<int> width, height;
    int fps = 60, quality = 18;
    bool rolls = false, mirrored = false, still = false, flat = false, interlaced = false;
    bool overwrite = false, quiet = false;
};

/// The direction and share of a light from one side, and levels by contrast. Throws UsageError.
template <typename Apply>
void set_light(const SyntheticVideoCall& call, const Apply& apply, CameraSettings& camera) {
    double from = 135.0, elevation = 60.0, contrast = 1.0;
    apply("light-from", call.light_from, from, -360.0, 360.0);
    apply("light-elevation", call.light_elevation, elevation, 0.0, 90.0);
    apply("light-share", call.light_share, camera.diffuse, 0.0, 1.0);
    apply("contrast", call.contrast, contrast, 0.05, 20.0);
    if (call.light_from || call.light_elevation) camera.light = light_direction(from, elevation);
    if (call.light_share) camera.ambient = 1.0 - camera.diffuse;
    if (!call.contrast) return;
    if (call.disc) throw UsageError("--contrast and --disc-level exclude each other.");
    camera.disc = contrast * camera.floor;
    if (camera.disc > 255.0)
        throw UsageError(fmt::format(
            "--contrast is {}, which makes the discs brighter than 255, the brightest level.\n"
            "hint: reduce --contrast or --floor-level.",
            contrast));
}

/// Throws UsageError.
CameraSettings camera_settings(const SyntheticVideoCall& call, const RunConfig& config) {
    const auto named = camera_preset(call.preset);
    if (!named) reject_choice("camera", call.preset, camera_presets());
    CameraSettings camera = *named;
    const auto apply = [](const char* name, const auto& given, auto& into, double from, double to) {
        if (!given) return;
        if (!(double(*given) >= from && double(*given) <= to))
            throw UsageError(
                fmt::format("--{} is {}, but it must be from {} to {}.", name, *given, from, to));
        into = *given;
    };
    apply("scale", call.scale, camera.scale, 2.0, 400.0);
    apply("noise", call.noise, camera.noise, 0.0, 100.0);
    apply("blur", call.blur, camera.blur, 0.0, 20.0);
    apply("exposure", call.exposure, camera.exposure, 0.0, 1.0);
    apply("distortion", call.distortion, camera.distortion, -0.2, 0.5);
    apply("tilt", call.tilt, camera.tilt, 0.0, 30.0);
    apply("tilt-towards", call.towards, camera.towards, -360.0, 360.0);
    apply("view-angle", call.view_angle, camera.view_angle, 0.0, 120.0);
    apply("rim-height", call.rim_height, camera.rim_height, -5.0, 20.0);
    if (!call.view_angle && camera.tilt > 0.0) camera.view_angle = tilted_view_angle;
    apply("glare", call.glare, camera.glare, 0.0, 255.0);
    apply("texture", call.texture, camera.texture, 0.0, 1.0);
    apply("gloss", call.gloss, camera.gloss, 0.0, 255.0);
    apply("flicker", call.flicker, camera.flicker, 0.0, 0.5);
    apply("disc-level", call.disc, camera.disc, 0.0, 255.0);
    apply("floor-level", call.floor, camera.floor, 0.0, 255.0);
    apply("rim-level", call.rim, camera.rim, 0.0, 255.0);
    apply("table-level", call.table, camera.table, 0.0, 255.0);
    apply("frames-per-period", call.frames_per_period, camera.frames_per_period, 4.0, 1e6);
    apply("rolling-shutter", call.rolling_shutter, camera.rolling_shutter, 0.0, 1.0);
    apply("auto-exposure", call.auto_exposure, camera.auto_exposure, 0.0, 0.9);
    apply("floor-pattern", call.floor_pattern, camera.floor_pattern, 0.0, 255.0);
    apply("disc-variation", call.disc_variation, camera.disc_variation, 0.0, 1.0);
    if (call.other_disc) camera.other_disc = camera.disc;
    apply("other-level", call.other_disc, camera.other_disc, 0.0, 255.0);
    apply("shadow", call.shadow, camera.shadow, 0.0, 255.0);
    apply("transparency", call.transparency, camera.transparency, 0.0, 1.0);
    apply("width", call.width, camera.size.width, 64.0, 4096.0);
    apply("height", call.height, camera.size.height, 64.0, 4096.0);
    set_light(call, apply, camera);
    camera.rolls = call.rolls, camera.flat = call.flat;
    camera.interlaced = call.interlaced, camera.mirrored = call.mirrored;
    camera.seed = static_cast<std::uint64_t>(config.seed);
    if (const auto wrong = movie_problem(MovieFormat::mp4, camera.size, call.fps))
        throw UsageError(*wrong);
    return camera;
}

/// Throws UsageError.
void validate(const SyntheticVideoCall& call) {
    if (call.out.empty()) throw UsageError("missing required option --out FILE.mp4.");
    if (movie_format(call.out) != MovieFormat::mp4)
        throw UsageError(fmt::format("--out is '{}', but its name must end with .mp4.", call.out));
    if (call.quality < 0 || call.quality > worst_quality)
        throw UsageError(fmt::format("--quality is {}, but it must be from 0 (lossless) to {}.",
                                     call.quality, worst_quality));
    if (!(call.periods > 0.0))
        throw UsageError(fmt::format("--periods is {}, but it must be above 0.", call.periods));
    for (const auto& [name, value, most] :
         {std::tuple("speed-variation", call.speed_variation, 0.9),
          std::tuple("rest", call.rest, 1e6), std::tuple("pause", call.pause, 1e6)})
        if (value && !(*value >= 0.0 && *value <= most))
            throw UsageError(
                fmt::format("--{} is {}, but it must be from 0 to {}.", name, *value, most));
    if (!(call.start >= 0.0))
        throw UsageError(fmt::format("--start is {}, but it must be at least 0.", call.start));
    if (call.frames && *call.frames < 1)
        throw UsageError(
            fmt::format("--frame-count is {}, but it must be at least 1.", *call.frames));
}

/// Angle of the container on its path, in degrees, counter-clockwise in the image.
double image_phase(const Snapshot& s, bool mirrored) {
    const Vec2 c{mirrored ? -s.container_centre.x : s.container_centre.x, s.container_centre.y};
    return 360.0 * turns_of(c);
}

/// Moves the camera with the container, which is then at rest.
void bring_container_to_rest(Snapshot& s) {
    for (std::size_t i = 0; i < s.size(); ++i) {
        const Vec2 p = s.position(i) - s.container_centre;
        const Vec2 v = s.velocity(i) - s.container_velocity;
        s.set_motion(i, {p, v, s.clock}, s.orientation(i), s.spin[i]);
    }
    s.container_centre = s.container_velocity = {0.0, 0.0};
}

/// Periods of the path that have passed at a time of the video, as if a hand moved the container.
double periods_at(const SyntheticVideoCall& call, double length, double time) {
    constexpr double slow = 2.7;  // periods from one slow part to the next
    const double half = 0.5 * (length - call.rest.value_or(0.0) - call.pause.value_or(0.0));
    double moving = std::max(0.0, time - call.rest.value_or(0.0));
    if (moving > half) moving = std::max(half, moving - call.pause.value_or(0.0));
    return moving + call.speed_variation.value_or(0.0) * slow / (2.0 * pi) *
                        (1.0 - std::cos(2.0 * pi * moving / slow));
}

/// Slows all motion down, as far as the exposure shows it.
void slow_down(Snapshot& s, double rate) {
    for (std::size_t i = 0; i < s.size(); ++i)
        s.set_motion(i, {s.position(i), rate * s.velocity(i), s.clock}, s.orientation(i),
                     rate * s.spin[i]);
    s.container_velocity = rate * s.container_velocity;
}

/// Grey levels as YUV 4:2:0 planes, in the limited range of videos (16 to 235).
class GreyPlanes {
  public:
    explicit GreyPlanes(std::size_t pixels) : planes_(pixels + pixels / 2, 128) {}
    const std::vector<std::uint8_t>& of(const std::vector<std::uint8_t>& grey) {
        for (std::size_t i = 0; i < grey.size(); ++i)
            planes_[i] = static_cast<std::uint8_t>(16 + (grey[i] * 219 + 127) / 255);
        return planes_;
    }

  private:
    std::vector<std::uint8_t> planes_;
};

/// True positions and rotations in each frame, in pixels of an undistorted image.
struct GroundTruth {
    Table discs{{"frame", "particle", "x", "y", "x_ideal", "y_ideal", "radius", "spin_x", "spin_y",
                 "spin_z"}};
    Table container{{"frame", "x_ideal", "y_ideal", "radius"}};
    double phase = 0.0;  // of the container in frame 0, degrees

    void add(std::int64_t frame, const Snapshot& s, const CameraView& view,
             const CameraSettings& camera) {
        if (frame == 0) phase = image_phase(s, camera.mirrored);
        const Vec2 c = view.ideal(s.container_centre);
        container.add({frame, c.x, c.y, s.container_radius * camera.scale});
        for (std::size_t i = 0; i < s.size(); ++i) {
            const Vec2 ideal = view.ideal(s.position(i)), seen = view.seen(ideal);
            const auto& turned = view.rotation(i);
            discs.add({frame, std::int64_t(i), seen.x, seen.y, ideal.x, ideal.y,
                       s.radius[i] * camera.scale, turned[0], turned[1], turned[2]});
        }
    }
};

using Json = nlohmann::ordered_json;

/// Only a circular path has a phase and a direction.
Json truth_json(const SyntheticVideoCall& call, const RunConfig& config,
                const CameraSettings& camera, const Vec2& path_centre, std::int64_t frames,
                double phase) {
    const bool is_round = has_m_frame(config) && !config.turns_clockwise();
    return {{"video", fs::path(call.out).filename().string()},
            {"frames", frames},
            {"discs", config.discs},
            {"scale", camera.scale},
            {"centre", {path_centre.x, path_centre.y}},
            {"amplitude", config.amplitude * camera.scale},
            {"container_radius", config.container_radius * camera.scale},
            {"omega", 2.0 * pi / double(camera.frames_per_period)},
            {"phase", is_round ? Json(phase) : Json()},
            {"clockwise", is_round ? Json(camera.mirrored) : Json()},
            {"distortion", camera.distortion},
            {"tilt", camera.tilt},
            {"tilt_towards", camera.towards},
            {"view_angle", camera.view_angle},
            {"camera", call.preset},
            {"run", config_json(config)},
            {"version", version()}};
}

void make_synthetic_video(const SyntheticVideoCall& call) {
    validate(call);
    const RunConfig config = resolve(*call.parameters);
    if (const auto wrong = problem(config)) throw UsageError(*wrong);
    CameraSettings camera = camera_settings(call, config);
    const std::int64_t frames = call.frames.value_or(static_cast<std::int64_t>(
        call.periods * static_cast<double>(camera.frames_per_period) + 0.5));
    if (frames < 1)
        throw UsageError(
            fmt::format("--periods is {}, which is less than one frame.", call.periods));
    camera.frames = frames;
    if (call.hands) {
        if (!(*call.hands >= 0.0 && *call.hands <= 0.5 * call.periods))
            throw UsageError(
                fmt::format("--hand-time is {}, but it must be from 0 to half of --periods, {}.",
                            *call.hands, 0.5 * call.periods));
        camera.hand_frames =
            static_cast<std::int64_t>(*call.hands * double(camera.frames_per_period) + 0.5);
    }
    const fs::path out = call.out;
    const auto companion = [&](const char* extension) {
        fs::path name = out;
        return name.replace_extension(extension);
    };
    const fs::path disc_file = companion(".truth.csv"),
                   container_file = companion(".container.csv"),
                   json_file = companion(".truth.json");
    reject_unwritable(out);
    if (!call.overwrite && file_exists(out))
        throw Failure(
            fmt::format("'{}' already exists.\nhint: use --overwrite to replace it.", call.out));

    const std::atomic<bool>& stopped = stop_signal();
    const Playback playback = simulated(config, &stopped).open();
    CameraView view(camera);
    MovieWriter writer(call.out, MovieFormat::mp4, camera.size, call.fps,
                       {.loss = call.quality, .by_camera = true});
    GroundTruth truth;
    GreyPlanes planes(static_cast<std::size_t>(camera.size.width) *
                      static_cast<std::size_t>(camera.size.height));
    const double length = double(frames) / double(camera.frames_per_period);
    const bool by_hand = call.speed_variation || call.rest || call.pause;
    constexpr double instant = 1e-4;  // periods
    ProgressLine line(fmt::format("{} frames", frames), call.quiet);
    for (std::int64_t k = 0; k < frames; ++k) {
        if (stopped.load())
            throw Interrupted("stopped before the last frame; no video was written.");
        std::vector<Snapshot> states;
        for (const double delay : view.delays()) {
            const double time = (double(k) + delay) / double(camera.frames_per_period);
            Snapshot s = playback(call.start + periods_at(call, length, time));
            if (by_hand)
                slow_down(s, 0.5 / instant *
                                 (periods_at(call, length, time + instant) -
                                  periods_at(call, length, time - instant)));
            if (call.still) bring_container_to_rest(s);
            states.push_back(s);
        }
        writer.write(planes.of(view.render(states)));
        truth.add(k, states[states.size() / 2], view, camera);
        line.show(double(k + 1) / double(frames), fmt::format("frame {}", k + 1));
    }
    line.clear();
    // Old files are removed first and the video is published last. So no video is ever next to the
    // ground truth of another one.
    std::error_code absent;
    for (const auto& old : {out, disc_file, container_file, json_file}) fs::remove(old, absent);
    truth.discs.write(disc_file);
    truth.container.write(container_file);
    write_output(
        json_file,
        truth_json(call, config, camera, view.ideal({0.0, 0.0}), frames, truth.phase).dump(2) +
            "\n");
    writer.finish();
    if (call.quiet) return;
    print_all(fmt::format(
        "{}: {} frames of {}x{} pixels, {} per period\nground truth: {} (discs; rotation since the "
        "previous frame in radians), {} (container), {}\n",
        call.out, frames, camera.size.width, camera.size.height, camera.frames_per_period,
        disc_file.string(), container_file.string(), json_file.string()));
}

void add_synthetic_video_command(Subcommand& subcommand) {
    const auto call = std::make_shared<SyntheticVideoCall>();
    const char* section = "Video";
    const auto add = [&](const char* name, auto& into, const std::string& type,
                         const char* description) {
        subcommand.in(section).add({{name, &into, description, type}});
    };
    const auto flag = [&](const char* name, bool& into, const char* description) {
        subcommand.in(section).add({{name, &into, description}});
    };
    add("--out", call->out, "FILE.mp4", "Video; its ground truth is written next to it");
    add("--periods", call->periods, "PERIODS", "Duration, in periods [3]");
    add("--frame-count", call->frames, "N", "Number of frames, instead of --periods");
    add("--start", call->start, "PERIODS", "Period of the first frame [20]");
    add("--fps", call->fps, "N", "Nominal frames per second for playback [60]");
    add("--quality", call->quality, "N", "Compression: 0 lossless, 18 good, 35 poor [18]");
    flag("--overwrite", call->overwrite, "Replace an existing video");
    flag("--quiet", call->quiet, "No progress line and no summary");
    section = "Camera";
    add("--camera", call->preset, one_of(camera_presets()),
        "Preset of the camera and the discs [laboratory]");
    add("--scale", call->scale, "NUMBER", "Image scale, pixels per disc radius");
    add("--frames-per-period", call->frames_per_period, "N", "Frames per period");
    add("--width", call->width, "PIXELS", "Frame width");
    add("--height", call->height, "PIXELS", "Frame height");
    add("--noise", call->noise, "LEVELS", "Sensor noise, rms in grey levels of 255");
    add("--blur", call->blur, "PIXELS", "Lens blur, standard deviation");
    add("--exposure", call->exposure, "FRACTION", "Exposure time per frame interval");
    add("--distortion", call->distortion, "NUMBER", "Radial lens distortion; barrel if positive");
    add("--tilt", call->tilt, "DEG", "Camera tilt about the image centre [0]");
    add("--tilt-towards", call->towards, "DEG",
        "Side of a tilted camera, counter-clockwise from +x [0]");
    add("--view-angle", call->view_angle, "DEG",
        "Vertical view angle; 0: far away [0; 30 if tilted]");
    add("--rim-height", call->rim_height, "NUMBER",
        "Rim height above disc centres, disc radii [0]");
    add("--glare", call->glare, "LEVELS", "Brightness of a lamp's glare spot, of 255");
    add("--gloss", call->gloss, "LEVELS", "Brightness of the highlight on each disc, of 255");
    add("--texture", call->texture, "FRACTION", "Brightness variation of disc textures");
    add("--flicker", call->flicker, "FRACTION", "Brightness variation between frames");
    add("--disc-level", call->disc, "LEVEL", "Brightness of the discs, of 255");
    add("--floor-level", call->floor, "LEVEL", "Brightness of the container's floor, of 255");
    add("--rim-level", call->rim, "LEVEL", "Brightness of the container's wall, of 255");
    add("--table-level", call->table, "LEVEL", "Brightness of the surroundings, of 255");
    add("--rolling-shutter", call->rolling_shutter, "FRACTION",
        "Readout time of a frame per frame interval [0]");
    flag("--interlaced", call->interlaced, "Odd rows half a frame interval after even rows");
    add("--auto-exposure", call->auto_exposure, "FRACTION",
        "Slow brightness variation, as of a phone [0]");
    add("--hand-time", call->hands, "PERIODS", "Time with a hand in view, at start and end [0]");
    add("--floor-pattern", call->floor_pattern, "LEVELS",
        "Contrast of a pattern of squares on the floor [0]");
    add("--disc-variation", call->disc_variation, "FRACTION",
        "Brightness variation from disc to disc (colours) [0]");
    add("--transparency", call->transparency, "FRACTION",
        "Transparency of the discs: 0 opaque, 1 clear glass [0]");
    add("--speed-variation", call->speed_variation, "FRACTION", "Speed variation, as by hand [0]");
    add("--rest", call->rest, "PERIODS", "Time at rest before the motion starts [0]");
    add("--pause", call->pause, "PERIODS", "Time at rest in the middle of the motion [0]");
    flag("--flat", call->flat, "Draw discs as flat coins with a bright edge");
    add("--other-level", call->other_disc, "LEVEL", "Brightness of every second disc, of 255");
    add("--shadow", call->shadow, "LEVELS", "Darkness of a shadow that moves over the table [0]");
    add("--light-from", call->light_from, "DEG",
        "Side of the light, counter-clockwise from +x [135]");
    add("--light-elevation", call->light_elevation, "DEG",
        "Elevation of the light above the floor; 90: above [60]");
    add("--light-share", call->light_share, "FRACTION", "Fraction of light from --light-from");
    add("--contrast", call->contrast, "RATIO",
        "Disc brightness relative to the floor's; sets --disc-level");
    flag("--roll", call->rolls, "Draw discs as spheres that roll on the floor");
    flag("--mirrored", call->mirrored, "Mirror the image, as seen from below");
    flag("--camera-on-container", call->still, "Camera that moves with the container");
    call->parameters =
        add_run_options(subcommand, {"events", "periods", "warmup", "events_per_sample", "ramp"});
    subcommand.set_main_options({"--out", "--periods", "--frame-count", "--fps", "--camera",
                                 "--scale", "--frames-per-period", "--discs", "--mu", "--seed"});
    subcommand.set_examples({"swirl synthetic-video --discs 36 --out lab.mp4",
                             "swirl synthetic-video --camera phone --discs 48 --quality 28 --out "
                             "phone.mp4",
                             "swirl track lab.mp4 --out tracks.csv"});
    subcommand.callback([call] { make_synthetic_video(*call); });
}

const Command synthetic_video_command("synthetic-video", add_synthetic_video_command);

}  // namespace
}  // namespace swirl
