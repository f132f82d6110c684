#include "swirl/cli/source_options.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <utility>

#include "swirl/cli/config_file.hpp"
#include "swirl/cli/output.hpp"
#include "swirl/cli/run_options.hpp"
#include "swirl/cli/stop_signal.hpp"
#include "swirl/cli/trial_reading.hpp"
#include "swirl/render/label.hpp"
#include "swirl/render/numbered_frames.hpp"
#include "swirl/render/page.hpp"
#include "swirl/render/tracked_source.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/measured_series.hpp"
#include "swirl/run/measurements.hpp"
#include "swirl/run/reading.hpp"

namespace swirl {

std::shared_ptr<SourceTexts> add_source_options(Subcommand& subcommand) {
    auto texts = std::make_shared<SourceTexts>();
    subcommand.in("Source").add({
        {"FILE", &texts->file, "Recording or TOML file, instead of a new run", ""},
        {"--compare", &texts->compared, "Further containers on the left, with N discs", "N[,N…]"},
        {"--rolling-ball", &texts->slip, "Minimal model: one ball; 0 slips, 1 rolls", "S"},
        {"--ball-radius", &texts->ball_radius, "Radius of the ball in disc radii [4.3]", "NUMBER"},
    });
    const auto camera = "Scale of tracks (also --amplitude, --container-radius)";
    add_track_options(subcommand, texts->camera, camera);
    subcommand.in(camera).add({
        {"--over", &texts->images, "Camera images or video to draw over", "NAME"},
        {"--over-first", &texts->first_image, "Number of frame 0 among the images [0]", "NUMBER"},
    });
    texts->parameters =
        add_run_options(subcommand, {"events", "periods", "warmup", "events_per_sample", "ramp"});
    return texts;
}

void take_video_config(Subcommand& subcommand, SourceTexts& texts, const std::string& command,
                       const std::vector<std::vector<std::string>>& instead) {
    if (!is_config_file(texts.file)) return;
    const std::string config = std::exchange(texts.file, "");
    // FILE was the configuration, which may itself name a recording as `file`.
    for (Option& option : subcommand.options())
        if (option.name == "FILE") option.is_given = false;
    take_config_file(subcommand, config, *texts.parameters, Lists::rejected, command, instead);
}

namespace {

RollingBall ball_of(const SourceTexts& texts, const RunConfig& container) {
    if (!(*texts.slip >= 0.0 && *texts.slip <= 1.0))
        throw UsageError(fmt::format(
            "--rolling-ball is {}, but it must be from 0 (slips) to 1 (rolls).", *texts.slip));
    if (!(texts.ball_radius > 0.0 && texts.ball_radius < container.container_radius))
        throw UsageError(
            fmt::format("--ball-radius is {}, but it must be above 0 and below the container's {}.",
                        texts.ball_radius, container.container_radius));
    RollingBall ball;
    ball.container_radius = container.container_radius;
    ball.ball_radius = texts.ball_radius;
    ball.slip = *texts.slip;
    return ball;
}

/// The scale of tracks has no meaning for a run or a trajectory of this program.
void reject_scale_options(const SourceTexts& texts) {
    reject_track_options(texts.camera, texts.file);
    if (!texts.images.empty()) throw_option_of_tracks("over", texts.file);
    if (texts.first_image != 0) throw_option_of_tracks("over-first", texts.file);
}

/// The numbers in a list "8,38". Throws UsageError.
std::vector<std::int64_t> compared_in(const std::string& list) {
    constexpr std::size_t most = 5;
    std::vector<std::int64_t> numbers;
    if (list.empty()) return numbers;
    for (const std::string_view part : split(list, ",")) {
        const auto number = read_whole_number(part);
        if (!number || *number < 1 || numbers.size() == most)
            throw UsageError(
                fmt::format("--compare is '{}', but it must be from 1 to {} numbers of discs, for "
                            "example 8,38.",
                            list, most));
        numbers.push_back(*number);
    }
    return numbers;
}

/// Only the options of the container apply to tracks, not the other options of a run.
FrameSource tracked_in(const SourceTexts& texts) {
    TrackTexts camera = texts.camera;
    ParameterTexts given = *texts.parameters;
    const auto take = [&](const char* name) {
        const auto found = given.find(name);
        if (found == given.end()) return std::string();
        std::string text = found->second;
        given.erase(found);
        return text;
    };
    camera.amplitude = take("amplitude");
    camera.container_radius = take("container_radius");
    if (!given.empty())
        throw UsageError(
            fmt::format("{} does not apply to the tracks in '{}'; only --amplitude and "
                        "--container-radius do.",
                        option_name(given.begin()->first), texts.file));
    if (const auto wrong = video_problem(texts.images)) throw UsageError(*wrong);
    const TrackScale scale = track_scale(camera, texts.file);
    Tracks tracks = read_tracks(texts.file, scale, table_layout(texts.camera));
    const CameraRecord camera_motion = camera_record(texts.file);
    ImageMotion motion{camera_motion.first_frame};
    for (const auto& [x, y, a, b] : camera_motion.poses) motion.poses.push_back({{x, y}, a, b});
    return tracked(std::move(tracks), scale,
                   escaped(std::filesystem::path(texts.file).filename().string()), texts.images,
                   texts.first_image, motion);
}

}  // namespace

std::vector<FrameSource> frame_sources(const SourceTexts& texts) {
    if (!texts.file.empty()) try_reading(texts.file);
    const bool is_tracks = !texts.file.empty() && !is_trajectory(texts.file);
    if (!is_tracks) reject_scale_options(texts);
    if (!texts.file.empty() && (!texts.compared.empty() || texts.slip))
        throw UsageError(fmt::format(
            "--compare and --rolling-ball need a run, but '{}' is a recording.", texts.file));
    if (is_tracks) return {tracked_in(texts)};
    if (!texts.file.empty()) {
        if (!texts.parameters->empty())
            throw UsageError(fmt::format("{} cannot change the parameters of the recording '{}'.",
                                         option_name(texts.parameters->begin()->first),
                                         texts.file));
        return {recorded(texts.file)};
    }
    const RunConfig config = resolve(*texts.parameters);
    if (texts.slip && !texts.compared.empty())
        throw UsageError("--rolling-ball and --compare exclude each other.");
    if (texts.slip) return {rolling(ball_of(texts, config), config.amplitude, config.period)};
    std::vector<FrameSource> containers{simulated(config, &stop_signal())};
    for (const std::int64_t discs : compared_in(texts.compared))
        containers.insert(containers.end() - 1,
                          simulated(with_discs(config, discs), &stop_signal()));
    return containers;
}

void reject_output_onto_source(const SourceTexts& texts, const std::vector<std::string>& outputs) {
    for (const std::string& output : outputs) {
        if (output.empty()) continue;
        reject_same_files({texts.file, output});
        if (!texts.images.empty() && belongs_to_video(canonical_name(texts.images).string(),
                                                      canonical_name(output).string()))
            throw UsageError(fmt::format(
                "'{}' is an output, but it also belongs to the camera images (--over {}).\n"
                "hint: choose another name.",
                output, texts.images));
    }
}

void print_source_warnings(const std::vector<FrameSource>& sources, const Appearance& appearance) {
    for (const FrameSource& source : sources) {
        if (!source.has_orientation)
            fmt::print(stderr,
                       "warning: the recording has no orientations; discs are drawn without "
                       "orientation marks.\n");
        const double frames = source.frames_per_period;
        if (appearance.coloring == Coloring::pinned && frames > 0.0 &&
            !rate_suffices(frames, min_rate_of_pinned))
            fmt::print(stderr,
                       "warning: the recording has {:.0f} frames per period, but the criteria for "
                       "pinned discs need {:.0f}.\n",
                       frames, min_rate_of_pinned);
    }
}

}  // namespace swirl
