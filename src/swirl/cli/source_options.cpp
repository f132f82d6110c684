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
#include "swirl/run/failure.hpp"
#include "swirl/run/measurements.hpp"

namespace swirl {
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

/// A run, or a recording of ours, is in no need of translation.
void reject_camera(const SourceTexts& texts) {
    const TrackTexts& camera = texts.camera;
    for (const auto& [name, given] :
         {std::pair("camera-fps", !camera.fps.empty()), std::pair("scale", !camera.scale.empty()),
          std::pair("omega", !camera.omega.empty()), std::pair("centre", !camera.centre.empty()),
          std::pair("phase", !camera.phase.empty()), std::pair("clockwise", camera.clockwise),
          std::pair("over", !texts.pictures.empty()),
          std::pair("over-first", texts.first_picture != 0)})
        if (given)
            throw UsageError(fmt::format(
                "--{} belongs to a camera's tracks, but {}.", name,
                texts.file.empty() ? "no FILE is given" : texts.file + " is a trajectory of ours"));
}

/// The container of a camera's tracks has the options of a run's; all others belong to runs alone.
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
            fmt::format("{} holds recorded tracks: {} cannot change them, and only --amplitude and "
                        "--container-radius say something of their container.",
                        texts.file, option_name(given.begin()->first)));
    if (const auto wrong = video_problem(texts.pictures)) throw UsageError(*wrong);
    const TrackScale scale = track_scale(camera, texts.file);
    Tracks tracks = read_tracks(texts.file, scale);
    return tracked(std::move(tracks), scale,
                   escaped(std::filesystem::path(texts.file).filename().string()), texts.pictures,
                   texts.first_picture);
}

}  // namespace

std::shared_ptr<SourceTexts> add_source_options(Subcommand& subcommand) {
    auto texts = std::make_shared<SourceTexts>();
    const auto group = "What is shown";
    subcommand
        .add_option(
            "FILE", texts->file,
            "instead of a new run: a recorded trajectory (.h5), a camera's tracks (table of "
            "trackpy, CSV), or a LAMMPS text dump; or a TOML file with the names of the options, "
            "which may name one of those as file; options given here override it")
        ->group(group);
    subcommand
        .add_option("--beside", texts->beside,
                    "a second dish to the left, with N discs and otherwise alike")
        ->type_name("N")
        ->group(group);
    subcommand
        .add_option("--rolling-ball", texts->slip,
                    "the paper's minimal model instead: one rigid ball, slip parameter from 0 "
                    "(slips) to 1 (rolls)")
        ->type_name("S")
        ->group(group);
    subcommand.add_option("--ball-radius", texts->ball_radius, "of that ball [4.3]")
        ->type_name("NUMBER")
        ->group(group);
    const auto camera = "Of tracks that are not ours (and --amplitude, --container-radius)";
    add_track_options(subcommand, texts->camera, camera);
    subcommand
        .add_option(
            "--over", texts->pictures,
            "draw over what the camera saw: files with a number, such as 'frames/%05d.png', "
            "or a film")
        ->type_name("NAME")
        ->group(camera);
    subcommand
        .add_option("--over-first", texts->first_picture,
                    "the number of frame 0 among these files [0]")
        ->type_name("NUMBER")
        ->group(camera);
    texts->parameters = add_run_options(subcommand, {"events", "periods", "warmup"});
    return texts;
}

void take_video_config(Subcommand& subcommand, SourceTexts& texts, const std::string& command,
                       const std::vector<std::vector<std::string>>& instead) {
    if (!is_config_file(texts.file)) return;
    const std::string config = std::exchange(texts.file, "");
    // What was given is the configuration; a recording may still be named in it.
    for (Option& option : subcommand.options())
        if (option.name == "FILE") option.is_given = false;
    take_config_file(subcommand, config, *texts.parameters, Lists::rejected, command, instead);
}

std::vector<FrameSource> frame_sources(const SourceTexts& texts) {
    if (!texts.file.empty()) try_reading(texts.file);
    const bool of_a_camera = !texts.file.empty() && !is_trajectory(texts.file);
    if (!of_a_camera) reject_camera(texts);
    if (of_a_camera && (texts.beside || texts.slip))
        throw UsageError("A recording stands alone: --beside and --rolling-ball need a run.");
    if (of_a_camera) return {tracked_in(texts)};
    if (!texts.file.empty()) {
        if (!texts.parameters->empty())
            throw UsageError(
                fmt::format("{} was recorded with parameters of its own: {} cannot change them.",
                            texts.file, option_name(texts.parameters->begin()->first)));
        if (texts.beside || texts.slip)
            throw UsageError("A recording stands alone: --beside and --rolling-ball need a run.");
        return {recorded(texts.file)};
    }
    const RunConfig config = resolve(*texts.parameters);
    if (texts.slip && texts.beside)
        throw UsageError("--rolling-ball and --beside show different things: give one.");
    if (texts.slip) return {rolling(ball_of(texts, config), config.amplitude, config.period)};
    std::vector<FrameSource> containers{simulated(config, &stop_signal())};
    if (texts.beside) {
        RunConfig other = config;
        other.discs = *texts.beside;
        if (const auto wrong = problem(other)) throw UsageError(*wrong);
        containers.insert(containers.begin(), simulated(other, &stop_signal()));
    }
    return containers;
}

void reject_to_draw_onto_source(const SourceTexts& texts, const std::vector<std::string>& outputs) {
    for (const std::string& output : outputs) {
        if (output.empty()) continue;
        reject_same_files({texts.file, output});
        if (!texts.pictures.empty() &&
            is_of_video(canonical_name(texts.pictures).string(), canonical_name(output).string()))
            throw UsageError(fmt::format(
                "'{}' is to be written, but it is also what the camera saw (--over {}); "
                "choose another name.",
                output, texts.pictures));
    }
}

std::string remark_on(const std::vector<FrameSource>& sources, const Appearance& appearance) {
    std::string remarks;
    for (const FrameSource& container : sources) {
        if (!container.knows_orientation)
            remarks += "The recording tells no orientation of the discs, so they have no hands.\n";
        const double frames = container.frames_per_swirl;
        if (appearance.coloring == Coloring::pinned && frames > 0.0 &&
            (frames < 0.8 * samples_per_period || frames > 1.25 * samples_per_period))
            remarks += fmt::format(
                "There are {:.0f} frames per swirl; the criteria for pinned discs are made for "
                "{}.\n",
                frames, samples_per_period);
    }
    return remarks;
}

}  // namespace swirl
