// swirl camera: whether a camera would do. A video as it would record is made from a simulation,
// tracked by `swirl track`, and compared with the true positions.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <system_error>

#include "swirl/cli/called_command.hpp"
#include "swirl/cli/command_line.hpp"
#include "swirl/cli/commands.hpp"
#include "swirl/cli/options.hpp"
#include "swirl/cli/output.hpp"
#include "swirl/cli/progress_line.hpp"
#include "swirl/io/tracks.hpp"
#include "swirl/measure/quantities.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/reading.hpp"

namespace swirl {
namespace {

namespace fs = std::filesystem;

struct CameraCall {
    std::string size = "1280x720", light = "room", video;
    double fps = 30.0, period = 0.5;
    std::int64_t discs = 36;
    bool overwrite = false, quiet = false;
};

/// How long a camera exposes a frame, and how much its sensor scatters then.
struct Light {
    const char* name;
    double exposure;  // seconds
    double noise;     // grey levels of 255
};
constexpr Light lights[] = {
    {"bright", 1.0 / 500.0, 1.5}, {"room", 1.0 / 100.0, 3.0}, {"dim", 1.0 / 30.0, 6.0}};

const Light& light_of(const CameraCall& call) {
    std::vector<std::string> names;
    for (const Light& light : lights) {
        if (call.light == light.name) return light;
        names.emplace_back(light.name);
    }
    reject_choice("light", call.light, names);
}

ImageSides size_of(const std::string& text) {
    constexpr std::int64_t least = 120, most = 4096;
    const ImageSides size = read_image_size(text).value_or(ImageSides{});
    const auto fits = [](std::int64_t side) {
        return side >= least && side <= most && side % 2 == 0;
    };
    if (!fits(size.width) || !fits(size.height))
        throw UsageError(
            fmt::format("--size is '{}', but it must be WIDTHxHEIGHT with even sides "
                        "from {} to {} pixels, for example 1280x720.",
                        text, least, most));
    return size;
}

/// A folder that is removed at the end.
class TemporaryFolder {
  public:
    TemporaryFolder() {
        std::string name = (fs::temp_directory_path() / "swirl-camera-XXXXXX").string();
        if (mkdtemp(name.data()) == nullptr)
            throw Failure(fmt::format("'{}' cannot be made: {}.", name,
                                      std::generic_category().message(errno)));
        path = name;
    }
    ~TemporaryFolder() {
        std::error_code ignored;
        fs::remove_all(path, ignored);
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    fs::path path;
};

/// Tracks next to the true positions.
struct Deviation {
    double found = 0.0;  // share of the positions
    double error = 0.0;  // rms of a coordinate, pixels
};
Deviation deviation(const Tracks& truth, const Tracks& tracks, double radius) {
    std::map<std::int64_t, const TrackFrame*> frames;
    for (const TrackFrame& frame : tracks.frames) frames[frame.number] = &frame;
    double sum = 0.0, found = 0.0, all = 0.0;
    for (const TrackFrame& frame : truth.frames) {
        all += double(frame.position.size());
        const auto at = frames.find(frame.number);
        if (at == frames.end()) continue;
        for (const Vec2& p : frame.position) {
            double nearest = std::numeric_limits<double>::infinity();
            for (const Vec2& q : at->second->position)
                nearest = std::min(nearest, dot(q - p, q - p));
            if (nearest > 0.25 * radius * radius) continue;
            found += 1.0;
            sum += 0.5 * nearest;
        }
    }
    return {found / std::max(all, 1.0), std::sqrt(sum / std::max(found, 1.0))};
}

/// What the frame rate permits.
std::string rate_text(double frames_per_period) {
    std::string text;
    const auto add = [&](const char* what, double rate) {
        text += fmt::format("  {:<12}{}\n", what,
                            frames_per_period >= rate
                                ? std::string("can be measured")
                                : fmt::format("needs {:.0f} frames per period", rate));
    };
    add("rotation", quantity("rotation.mean_by_time").min_rates.of_tracks);
    add("pinned", quantity("pinned.share").min_rates.of_tracks);
    return text;
}

void try_camera(const CameraCall& call) {
    constexpr double fill = 0.45;        // of the shorter side, by half of what the dish sweeps
    constexpr double swept = 11.0;       // disc radii: container, its path and its wall
    constexpr double most_fps = 120.0;   // that a player shows
    constexpr double most_frames = 120;  // of the video
    const Light& light = light_of(call);
    const ImageSides size = size_of(call.size);
    if (!(call.fps > 0.0 && call.fps <= 1e5))
        throw UsageError(
            fmt::format("--fps is {}, but it must be above 0 and at most 1e5.", call.fps));
    constexpr std::int64_t most_discs = 55;  // that the paper's container holds
    if (call.discs < 1 || call.discs > most_discs)
        throw UsageError(fmt::format("--discs is {}, but the dish of this command holds 1 to {}.",
                                     call.discs, most_discs));
    if (!call.video.empty() && !call.video.ends_with(".mp4"))
        throw UsageError(
            fmt::format("--video is '{}', but its name must end with .mp4.", call.video));
    if (!(call.period > 0.0))
        throw UsageError(fmt::format("--period is {}, but it must be above 0.", call.period));
    const double frames_per_period = std::round(call.fps * call.period);
    if (frames_per_period < 4.0)
        throw UsageError(fmt::format(
            "--fps is {} and --period is {}, which is {:.0f} frames per period, but 4 are needed.",
            call.fps, call.period, frames_per_period));
    const double scale = fill * double(std::min(size.width, size.height)) / swept;
    const TemporaryFolder folder;
    const fs::path video = call.video.empty() ? folder.path / "camera.mp4" : fs::path(call.video);
    const fs::path tracks = folder.path / "tracks.csv";
    ProgressLine line("camera", call.quiet);
    line.show(0.0, "making a video");
    const auto number = [](double value) { return fmt::format("{}", value); };
    std::vector<std::string> make{"synthetic-video",
                                  "--camera",
                                  "student",
                                  "--discs",
                                  std::to_string(call.discs),
                                  "--width",
                                  std::to_string(size.width),
                                  "--height",
                                  std::to_string(size.height),
                                  "--scale",
                                  number(scale),
                                  "--frames-per-period",
                                  number(frames_per_period),
                                  "--periods",
                                  number(std::clamp(most_frames / frames_per_period, 1.3, 6.0)),
                                  "--exposure",
                                  number(std::min(0.95, light.exposure * call.fps)),
                                  "--noise",
                                  number(light.noise),
                                  "--fps",
                                  number(std::clamp(std::round(call.fps), 1.0, most_fps)),
                                  "--quality",
                                  "23",
                                  "--out",
                                  video.string(),
                                  "--quiet"};
    if (call.overwrite) make.emplace_back("--overwrite");
    const std::string stopped = "stopped before the end.";
    output_of_command(make, stopped);
    line.show(0.5, "tracking it");
    const std::string warnings =
        output_of_command({"track", "--out", tracks.string(), "--quiet", "--", video.string()},
                          stopped, "a video by this camera is rejected: ");
    line.clear();
    fs::path truth = video;
    const Deviation off = deviation(read_track_table(truth.replace_extension(".truth.csv")),
                                    read_track_table(tracks), scale);
    print_all(fmt::format("{} with a radius of {:.1f} pixels, {:.0f} frames per period\n"
                          "  found       {:.1f} % of the positions\n"
                          "  error       {:.2f} pixels per position, {:.4f} disc radii\n",
                          counted(call.discs, "disc"), scale, frames_per_period, 100.0 * off.found,
                          off.error, off.error / scale) +
              rate_text(frames_per_period) + warnings);
}

void add_camera_command(Subcommand& subcommand) {
    const auto call = std::make_shared<CameraCall>();
    std::vector<std::string> names;
    for (const Light& light : lights) names.emplace_back(light.name);
    subcommand.add({
        {"--size", &call->size, "Size of a frame in pixels [1280x720]", "WxH"},
        {"--fps", &call->fps, "Frames per second [30]", "N"},
        {"--light", &call->light, "Light on the dish [room]", one_of(names)},
        {"--period", &call->period, "Duration of one turn of the dish, seconds [0.5]", "SECONDS"},
        {"--discs", &call->discs, "Number of discs [36]", "N"},
        {"--video", &call->video, "Keep the video, and its true positions next to it", "FILE.mp4"},
        {"--overwrite", &call->overwrite, "Replace the video of --video"},
        {"--quiet", &call->quiet, "No progress line"},
    });
    subcommand.explain(
        "A video as this camera would record is made from a simulation, tracked, and compared with "
        "the true positions. It has a plain dark floor, bright discs and a still camera: yours can "
        "be worse.\n");
    subcommand.set_examples({"swirl camera --size 640x480 --fps 30 --light dim",
                             "swirl camera --size 1920x1080 --fps 240 --video phone.mp4"});
    subcommand.callback([call] { try_camera(*call); });
}

const Command camera_command("camera", add_camera_command);

}  // namespace
}  // namespace swirl
