// swirl film-test: what a camera would see of a run, with the truth beside it.
#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "swirl/cli/commands.hpp"
#include "swirl/cli/output.hpp"
#include "swirl/cli/progress_line.hpp"
#include "swirl/cli/run_options.hpp"
#include "swirl/cli/stop_signal.hpp"
#include "swirl/io/table.hpp"
#include "swirl/math/unit_circle.hpp"
#include "swirl/render/camera_view.hpp"
#include "swirl/render/frame_source.hpp"
#include "swirl/render/movie_file.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/json.hpp"
#include "swirl/run/version.hpp"

namespace swirl {
namespace {

/// A telephone's, whose picture is cropped to the dish a little; who tilts a camera is near.
constexpr double tilted_view_angle = 30.0;

struct SyntheticVideoCall {
    std::shared_ptr<ParameterTexts> parameters;
    std::string out, preset = "laboratory";
    double periods = 3.0, from = 20.0;
    std::optional<std::int64_t> frames, frames_per_period;
    std::optional<double> scale, noise, blur, exposure, distortion, glare, texture, gloss, disc,
        floor, rim, table, flicker, tilt, towards, view_angle, rim_height;
    std::optional<int> width, height;
    int fps = 60, quality = 18;
    bool rolls = false, mirrored = false, still = false, overwrite = false, quiet = false;
};

CameraSettings settings_of(const SyntheticVideoCall& call, const RunConfig& config) {
    const auto named = camera_preset(call.preset);
    if (!named)
        throw UsageError(fmt::format("--camera is '{}', but it must be one of {}.", call.preset,
                                     camera_presets()));
    CameraSettings camera = *named;
    const auto take = [](const char* name, const auto& given, auto& into, double from, double to) {
        if (!given) return;
        if (!(double(*given) >= from && double(*given) <= to))
            throw UsageError(
                fmt::format("--{} is {}, but it must be from {} to {}.", name, *given, from, to));
        into = *given;
    };
    take("scale", call.scale, camera.scale, 2.0, 400.0);
    take("noise", call.noise, camera.noise, 0.0, 100.0);
    take("blur", call.blur, camera.blur, 0.0, 20.0);
    take("exposure", call.exposure, camera.exposure, 0.0, 1.0);
    take("distortion", call.distortion, camera.distortion, -0.2, 0.5);
    take("tilt", call.tilt, camera.tilt, 0.0, 30.0);
    take("tilt-towards", call.towards, camera.towards, -360.0, 360.0);
    take("view-angle", call.view_angle, camera.view_angle, 0.0, 120.0);
    take("rim-height", call.rim_height, camera.rim_height, -5.0, 20.0);
    if (!call.view_angle && camera.tilt > 0.0) camera.view_angle = tilted_view_angle;
    take("glare", call.glare, camera.glare, 0.0, 255.0);
    take("texture", call.texture, camera.texture, 0.0, 1.0);
    take("gloss", call.gloss, camera.gloss, 0.0, 255.0);
    take("flicker", call.flicker, camera.flicker, 0.0, 0.5);
    take("disc-level", call.disc, camera.disc, 0.0, 255.0);
    take("floor-level", call.floor, camera.floor, 0.0, 255.0);
    take("rim-level", call.rim, camera.rim, 0.0, 255.0);
    take("table-level", call.table, camera.table, 0.0, 255.0);
    take("frames-per-period", call.frames_per_period, camera.frames_per_period, 4.0, 1e6);
    take("width", call.width, camera.size.width, 64.0, 4096.0);
    take("height", call.height, camera.size.height, 64.0, 4096.0);
    camera.rolls = call.rolls;
    camera.mirrored = call.mirrored;
    camera.seed = static_cast<std::uint64_t>(config.seed);
    if (const auto wrong = movie_problem(MovieFormat::mp4, camera.size, call.fps))
        throw UsageError(*wrong);
    return camera;
}

/// Where C is at the beginning, in degrees as one reads them off the picture.
double phase_in_picture(const Snapshot& s, bool mirrored) {
    const Vec2 c{mirrored ? -s.container_centre.x : s.container_centre.x, s.container_centre.y};
    return 360.0 * turns_of(c);
}

void video(const SyntheticVideoCall& call) {
    if (call.out.empty())
        throw UsageError("There is nowhere for the film to go: give --out FILE.mp4.");
    if (movie_format(call.out) != MovieFormat::mp4)
        throw UsageError(fmt::format("--out is '{}', but its name must end with .mp4.", call.out));
    if (call.quality < 0 || call.quality > 51)
        throw UsageError(
            fmt::format("--quality is {}, but it must be from 0 (no loss) to 51.", call.quality));
    if (!(call.periods > 0.0) || !(call.from >= 0.0))
        throw UsageError("--length must be above 0 and --from at least 0.");
    const RunConfig config = resolve(*call.parameters);
    if (const auto wrong = problem(config)) throw UsageError(*wrong);
    const CameraSettings camera = settings_of(call, config);
    const std::int64_t frames = call.frames.value_or(static_cast<std::int64_t>(
        call.periods * static_cast<double>(camera.frames_per_period) + 0.5));
    if (frames < 1) throw UsageError("--frames must be at least 1.");
    const std::filesystem::path out = call.out;
    const auto beside = [&](const char* ending) {
        std::filesystem::path name = out;
        return name.replace_extension(ending);
    };
    reject_unwritable(out);
    if (!call.overwrite && std::filesystem::exists(out))
        throw Failure(fmt::format("'{}' is there already; --overwrite replaces it.", call.out));

    const std::atomic<bool>& stop = stop_signal();
    const Reel reel = simulated(config, &stop).open();
    CameraView view(camera);
    MovieWriter writer(call.out, MovieFormat::mp4, camera.size, call.fps, call.quality);
    Table discs({"frame", "particle", "x", "y", "x_ideal", "y_ideal", "radius", "spin_x", "spin_y",
                 "spin_z"});
    Table container({"frame", "x_ideal", "y_ideal", "radius"});
    ProgressLine line(fmt::format("{} pictures", frames), call.quiet);
    const std::size_t pixels =
        static_cast<std::size_t>(camera.size.width) * static_cast<std::size_t>(camera.size.height);
    std::vector<std::uint8_t> planes(pixels + pixels / 2, 128);
    double phase = 0.0;
    for (std::int64_t k = 0; k < frames; ++k) {
        if (stop.load()) throw Interrupted("Stopped before the last picture; no film was left.");
        Snapshot s = reel(call.from + double(k) / double(camera.frames_per_period));
        if (call.still) {  // a dish that nobody swirls: the camera rides with it
            for (std::size_t i = 0; i < s.size(); ++i) {
                const Vec2 p = s.position(i) - s.container_centre;
                const Vec2 v = s.velocity(i) - s.container_velocity;
                s.set_motion(i, {p, v, s.clock}, s.orientation(i), s.spin[i]);
            }
            s.container_centre = s.container_velocity = {0.0, 0.0};
        }
        if (k == 0) phase = phase_in_picture(s, camera.mirrored);
        const std::vector<std::uint8_t>& picture = view.take(s);
        for (std::size_t at = 0; at < pixels; ++at)  // to the limited range of films
            planes[at] = static_cast<std::uint8_t>(16 + (picture[at] * 219 + 127) / 255);
        writer.write(planes);
        const Vec2 c = view.ideal(s.container_centre);
        container.add({k, c.x, c.y, s.container_radius * camera.scale});
        for (std::size_t i = 0; i < s.size(); ++i) {
            const Vec2 p = view.ideal(s.position(i)), seen = view.seen(p);
            const auto& turned = view.turned(i);
            discs.add({k, std::int64_t(i), seen.x, seen.y, p.x, p.y, s.radius[i] * camera.scale,
                       turned[0], turned[1], turned[2]});
        }
        line.show(double(k + 1) / double(frames), fmt::format("picture {}", k + 1));
    }
    line.clear();
    // What is replaced goes first, and the film gets its name last, so that none stands beside the
    // truth of another.
    std::error_code absent;
    for (const auto& old : {out, beside(".truth.csv"), beside(".dish.csv"), beside(".truth.json")})
        std::filesystem::remove(old, absent);
    discs.write(beside(".truth.csv"));
    container.write(beside(".dish.csv"));
    const Vec2 centre = view.ideal({0.0, 0.0});
    nlohmann::ordered_json json{{"film", out.filename().string()},
                                {"frames", frames},
                                {"discs", config.discs},
                                {"scale", camera.scale},
                                {"centre", {centre.x, centre.y}},
                                {"amplitude", config.amplitude * camera.scale},
                                {"container_radius", config.container_radius * camera.scale},
                                {"omega", 2.0 * pi / double(camera.frames_per_period)},
                                {"phase", phase},
                                {"clockwise", camera.mirrored},
                                {"distortion", camera.distortion},
                                {"tilt", camera.tilt},
                                {"tilt_towards", camera.towards},
                                {"view_angle", camera.view_angle},
                                {"camera", call.preset},
                                {"run", config_json(config)},
                                {"version", version()}};
    write_output(beside(".truth.json"), json.dump(2) + "\n");
    writer.finish();
    if (!call.quiet)
        print_all(fmt::format(
            "{}: {} pictures, {}x{} pixels, {} for a swirl.\n"
            "The truth: {} (discs; spins in radians since the picture before), {} (dish), {}.\n",
            call.out, frames, camera.size.width, camera.size.height, camera.frames_per_period,
            beside(".truth.csv").string(), beside(".dish.csv").string(),
            beside(".truth.json").string()));
}

void add_synthetic_video_command(Subcommand& subcommand) {
    const auto call = std::make_shared<SyntheticVideoCall>();
    const auto add = [&](const char* name, auto& into, const char* type, const char* description,
                         const char* group) {
        subcommand.add_option(name, into, description)->type_name(type)->group(group);
    };
    const char* const video_group = "Film";
    add("--out", call->out, "FILE.mp4", "the film; its truth goes beside it (.truth.csv, …)",
        video_group);
    add("--length", call->periods, "PERIODS", "how much of the run is filmed [3]", video_group);
    add("--frames", call->frames, "NUMBER", "the same in pictures", video_group);
    add("--from", call->from, "PERIODS", "where in the run the film begins [20]", video_group);
    add("--fps", call->fps, "NUMBER", "at which the film says it is to be played [60]",
        video_group);
    add("--quality", call->quality, "NUMBER",
        "loss of the compression: 0 is none, 18 hardly visible, 35 much [18]", video_group);
    subcommand.add_flag("--overwrite", call->overwrite, "replace a film that is there")
        ->group(video_group);
    subcommand.add_flag("--quiet", call->quiet, "no progress, no report")->group(video_group);
    const char* const lens = "Camera";
    add("--camera", call->preset, "NAME",
        "laboratory, telephone, bad or steel: all of what follows [laboratory]", lens);
    add("--scale", call->scale, "NUMBER", "pixels per disc radius", lens);
    add("--frames-per-period", call->frames_per_period, "NUMBER", "pictures for a swirl", lens);
    add("--width", call->width, "PIXELS", "of a picture", lens);
    add("--height", call->height, "PIXELS", "of a picture", lens);
    add("--noise", call->noise, "LEVELS", "of the sensor, of 255 grey levels", lens);
    add("--blur", call->blur, "PIXELS", "of the lens, standard deviation", lens);
    add("--exposure", call->exposure, "SHARE", "of the time between two pictures", lens);
    add("--distortion", call->distortion, "NUMBER", "of the lens; above 0: a barrel", lens);
    add("--tilt", call->tilt, "DEGREES", "of the camera, about the middle of the picture [0]",
        lens);
    add("--tilt-towards", call->towards, "DEGREES",
        "the side where a tilted camera stands, counter-clockwise from the right [0]", lens);
    add("--view-angle", call->view_angle, "DEGREES",
        "over the picture's height; 0: from very far away [0, with a tilt 30]", lens);
    add("--rim-height", call->rim_height, "NUMBER",
        "of the rim's edge above the discs' centres, in disc radii [0]", lens);
    add("--glare", call->glare, "LEVELS", "a lamp's reflection in front of the dish", lens);
    add("--gloss", call->gloss, "LEVELS", "the lamp's reflection in every disc", lens);
    add("--texture", call->texture, "SHARE", "by which discs vary in brightness", lens);
    add("--flicker", call->flicker, "SHARE", "by which the light varies", lens);
    add("--disc-level", call->disc, "LEVEL", "brightness of the discs, of 255", lens);
    add("--floor-level", call->floor, "LEVEL", "of the floor of the dish", lens);
    add("--rim-level", call->rim, "LEVEL", "of its wall", lens);
    add("--table-level", call->table, "LEVEL", "of what is around it", lens);
    subcommand.add_flag("--roll", call->rolls, "discs roll on the floor as spheres would")
        ->group(lens);
    subcommand.add_flag("--mirrored", call->mirrored, "as seen in a mirror, or from below")
        ->group(lens);
    subcommand.add_flag("--still", call->still, "a dish that does not move")->group(lens);
    call->parameters = add_run_options(subcommand, {"events", "periods", "warmup"});
    subcommand.set_examples({"swirl film-test --discs 36 --out lab.mp4",
                             "swirl film-test --camera telephone --discs 48 --quality 28 --out "
                             "phone.mp4",
                             "swirl track lab.mp4 --out tracks.csv"});
    subcommand.callback([call] { video(*call); });
}

const Command synthetic_video_command(71, "film-test",
                                      "What a camera would see of a run, with the truth beside it.",
                                      add_synthetic_video_command);

}  // namespace
}  // namespace swirl
