// swirl movie: the dish in motion.
#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <optional>

#include "swirl/cli/appearance_options.hpp"
#include "swirl/cli/commands.hpp"
#include "swirl/cli/output.hpp"
#include "swirl/cli/progress_line.hpp"
#include "swirl/cli/source_options.hpp"
#include "swirl/cli/stop_signal.hpp"
#include "swirl/render/movie.hpp"
#include "swirl/run/failure.hpp"

namespace swirl {
namespace {

struct MovieCall {
    std::shared_ptr<SourceTexts> source;
    std::shared_ptr<AppearanceTexts> appearance;
    std::string out, frames_folder;
    std::optional<double> seconds, periods, start;
    std::optional<int> frames_per_second;
    std::optional<double> pace;
    bool quiet = false;
};

MovieConfig movie_config(const MovieCall& call) {
    MovieConfig config;
    config.out = call.out;
    config.frames_folder = call.frames_folder;
    reject_to_draw_onto_source(
        *call.source,
        {call.out, call.frames_folder.empty() ? "" : frame_name(call.frames_folder, 1)});
    const bool gif = call.out.size() > 4 && call.out.ends_with(".gif");
    config.appearance = appearance(*call.appearance, gif ? Size{800, 450} : Size{1920, 1080});
    config.sources = frame_sources(*call.source);
    config.frames_per_second = call.frames_per_second.value_or(gif ? 25 : 60);
    const FrameSource& first = config.sources.front();
    // Over a camera's pictures: one after the other, none twice.
    config.pace = call.pace.value_or(
        first.open_backdrop ? config.frames_per_second / first.frames_per_swirl : 0.5);
    config.start =
        call.start.value_or(first.from.value_or(call.source->slip ? 0.0 : double(default_warmup)));
    if (call.seconds && call.periods)
        throw UsageError("--seconds and --swirls both set the length of the movie: give one.");
    double seconds = call.seconds.value_or(gif ? 6.0 : 20.0);
    if (call.periods) seconds = *call.periods / config.pace;
    // A recording is shown to its end, both ends included.
    if (first.to && !call.seconds && !call.periods)
        seconds = std::floor((*first.to - config.start) / config.pace * config.frames_per_second +
                             1e-9 + 1.0) /
                  config.frames_per_second;
    if (config.frames_per_second < 1)
        throw UsageError(fmt::format("{} frames per second cannot be had: 1 or more can.",
                                     config.frames_per_second));
    const double frames = std::round(seconds * config.frames_per_second);
    if (!(frames >= 1.0 && frames <= 1e6))
        throw UsageError(fmt::format(
            "A movie of {:g} seconds cannot be made: it must have from 1 to 1000000 frames.",
            seconds));
    config.frames = static_cast<int>(frames);
    if (const auto wrong = problem(config)) throw UsageError(*wrong);
    return config;
}

void make_and_report(const MovieCall& call) {
    const MovieConfig config = movie_config(call);
    ProgressLine line(call.out.empty() ? call.frames_folder : call.out, call.quiet);
    const auto begin = std::chrono::steady_clock::now();
    const auto seconds = [&] {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    };
    MovieControl control;
    control.stop = &stop_signal();
    control.progress = [&](int done, int of) {
        line.show(double(done) / of, fmt::format("{:.0f} frames/s", done / seconds()));
    };
    const MovieResult result = make_movie(config, control);
    line.clear();
    const std::string where = call.out.empty() ? call.frames_folder : call.out;
    if (result.frames == 0) throw Interrupted("Stopped before the first frame; nothing written.");
    if (!call.quiet)
        print_all(
            fmt::format("{}: {} frames, {:.2f} s at {} frames/s, {:g} swirls/s; made in {} "
                        "({:.0f} frames/s).\n",
                        where, result.frames, double(result.frames) / config.frames_per_second,
                        config.frames_per_second, config.pace, short_duration(seconds()),
                        result.frames / seconds()));
    if (!call.quiet) print_all(remark_on(config.sources, config.appearance));
    if (!result.complete)
        throw Interrupted(fmt::format("Stopped after {} of {} frames; {} holds them.",
                                      result.frames, config.frames, where));
}

void add_movie_command(Subcommand& subcommand) {
    const auto call = std::make_shared<MovieCall>();
    const auto group = "Movie";
    subcommand.add_option("--out", call->out, "the movie; its ending decides: .mp4, .webm or .gif")
        ->type_name("FILE")
        ->group(group);
    subcommand
        .add_option("--frames", call->frames_folder,
                    "write every frame as a PNG file, with or without a movie")
        ->type_name("DIR")
        ->group(group);
    subcommand.add_option("--seconds", call->seconds, "how long it plays [20; .gif 6]")
        ->type_name("NUMBER")
        ->group(group);
    subcommand.add_option("--swirls", call->periods, "how many swirls it shows, instead")
        ->type_name("NUMBER")
        ->group(group);
    subcommand
        .add_option(
            "--pace", call->pace,
            "swirls per second of playing; the paper's table makes 1.88 [0.5; with --over one of "
            "the camera's frames after the other]")
        ->type_name("NUMBER")
        ->group(group);
    subcommand.add_option("--fps", call->frames_per_second, "frames per second [60; .gif 25]")
        ->type_name("NUMBER")
        ->group(group);
    subcommand.add_option("--start", call->start, "swirls before the first frame [20]")
        ->type_name("SWIRLS")
        ->group(group);
    subcommand.add_flag("--quiet", call->quiet, "no progress, no report")->group(group);
    call->appearance = add_appearance_options(subcommand);
    call->source = add_source_options(subcommand);
    subcommand.set_examples(
        {"swirl movie --discs 48 --frame both --plot --out counterrotation.mp4",
         "swirl movie --discs 28 --frame m --color pinned --trails --out rotation.webm",
         "swirl movie --discs 48 --beside 28 --seconds 4 --out swirl.gif",
         "swirl movie run.h5 --color id --out run.mp4",
         "swirl movie tracks.csv --camera-fps 960 --scale 24 --omega 11.81 --centre "
         "512,384 --amplitude 1.9 --container-radius 8.6 --over 'frames/%05d.png' --out "
         "dish.mp4"});
    subcommand.callback([call, &subcommand] {
        take_video_config(subcommand, *call->source, "movie", {{"seconds", "swirls"}});
        make_and_report(*call);
    });
}

const Command movie_command(60, "movie", "A movie of the dish, in the lab frame or the M-frame.",
                            add_movie_command);

}  // namespace
}  // namespace swirl
