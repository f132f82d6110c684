// swirl movie: the container in motion.
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
#include "swirl/run/report.hpp"

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
    reject_output_onto_source(
        *call.source,
        {call.out, call.frames_folder.empty() ? "" : frame_name(call.frames_folder, 1)});
    const bool gif = call.out.size() > 4 && call.out.ends_with(".gif");
    config.appearance = appearance(*call.appearance, gif ? Size{800, 450} : Size{1920, 1080});
    config.sources = frame_sources(*call.source);
    config.frames_per_second = call.frames_per_second.value_or(gif ? 20 : 60);
    const FrameSource& first = config.sources.front();
    // Over camera images, each of them is shown once.
    config.pace = call.pace.value_or(
        first.open_backdrop ? config.frames_per_second / first.frames_per_period : 2.0);
    config.start =
        call.start.value_or(first.from.value_or(call.source->slip ? 0.0 : double(default_warmup)));
    if (call.seconds && call.periods)
        throw UsageError(
            "--seconds and --periods both set the duration, but only one may be given.");
    double seconds = call.seconds.value_or(gif ? 6.0 : 10.0);
    if (call.periods) seconds = *call.periods / config.pace;
    // A recording is shown from its first frame to its last.
    if (first.to && !call.seconds && !call.periods)
        seconds = std::floor((*first.to - config.start) / config.pace * config.frames_per_second +
                             1e-9 + 1.0) /
                  config.frames_per_second;
    if (config.frames_per_second < 1)
        throw UsageError(
            fmt::format("--fps is {}, but it must be 1 or more.", config.frames_per_second));
    const double frames = std::round(seconds * config.frames_per_second);
    if (!(frames >= 1.0 && frames <= 1e6))
        throw UsageError(fmt::format(
            "the duration is {:g} seconds, but the movie must have from 1 to 1000000 frames.",
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
    if (result.frames == 0)
        throw Interrupted("stopped before the first frame; no file was written.");
    if (!call.quiet)
        print_all(
            fmt::format("{}: {:.2f} s\n", where, double(result.frames) / config.frames_per_second) +
            report_line("frames",
                        fmt::format("{}, {} per second", result.frames, config.frames_per_second)) +
            report_line("shows", fmt::format("{:g} periods per second, from period {:g} on",
                                             config.pace, config.start)) +
            report_line("made in",
                        fmt::format("{}, {:.0f} frames per second", short_duration(seconds()),
                                    result.frames / seconds())));
    print_source_warnings(config.sources, config.appearance);
    if (!result.complete)
        throw Interrupted(fmt::format("stopped after {} of {} frames; they are in '{}'.",
                                      result.frames, config.frames, where));
}

void add_movie_command(Subcommand& subcommand) {
    const auto call = std::make_shared<MovieCall>();
    subcommand.in("Movie").add({
        {"--out", &call->out, "Movie file: .mp4, .webm or .gif", "FILE"},
        {"--frame-files", &call->frames_folder, "Folder for PNG files of all frames", "DIR"},
        {"--seconds", &call->seconds, "Duration of the movie [10; .gif: 6]", "SECONDS"},
        {"--periods", &call->periods, "Duration in periods, instead of --seconds", "PERIODS"},
        {"--pace", &call->pace, "Periods per second of the movie [2]", "NUMBER"},
        {"--fps", &call->frames_per_second, "Frames per second [60; .gif: 20]", "NUMBER"},
        {"--start", &call->start, "Period of the first frame [20; of FILE: its first]", "PERIODS"},
        {"--quiet", &call->quiet, "Suppress progress and report"},
    });
    call->appearance = add_appearance_options(subcommand);
    call->source = add_source_options(subcommand);
    subcommand.explain(std::string(source_explanation) +
                       "With --over, the default --pace shows each camera image once. The pace of "
                       "the paper's experiment was 1.88.\n");
    subcommand.set_main_options({"--out", "--frame-files", "--seconds", "--view", "--color",
                                 "--trails", "--size", "--discs", "--mu", "--over"});
    subcommand.set_examples(
        {"swirl movie --discs 48 --view both --plot --out counterrotation.mp4",
         "swirl movie --discs 28 --view m --color pinned --trails --out rotation.webm",
         "swirl movie --discs 48 --compare 20 --out reversal.gif",
         "swirl movie run.h5 --color id --out run.mp4",
         "swirl movie tracks.csv --camera-fps 960 --scale 24 --omega 11.81 --centre "
         "512,384 --amplitude 1.9 --container-radius 8.6 --over 'frames/%05d.png' --out "
         "dish.mp4"});
    subcommand.callback([call, &subcommand] {
        take_video_config(subcommand, *call->source, "movie", {{"seconds", "periods"}});
        make_and_report(*call);
    });
}

const Command movie_command("movie", add_movie_command);

}  // namespace
}  // namespace swirl
