#include "swirl/cli/live_camera.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <memory>

#include "swirl/run/failure.hpp"
#ifdef SWIRL_CAMERA
#include "swirl/cli/stop_signal.hpp"
#include "swirl/render/frame_server.hpp"
#include "swirl/tracking/live_tracking.hpp"
#endif

namespace swirl {

void add_live_options(Subcommand& subcommand, LiveOptions& options) {
    constexpr const char* group = "Live";
    subcommand.add_option("--live", options.source,
                          "Camera (/dev/video0), folder that receives images, or -", "SOURCE",
                          group);
    subcommand.add_option("--survey", options.survey_frames,
                          "Number of frames in the first search for rim and discs [96]", "N",
                          group);
    subcommand.add_option("--timeout", options.timeout,
                          "Time without a new frame that ends the tracking [10]", "SECONDS", group);
    subcommand.add_option("--view", options.port,
                          "Port of this machine that shows the tracking in a browser", "PORT",
                          group);
}

void check_live_options(const LiveOptions& options) {
    constexpr std::int64_t min_survey = 8, max_survey = 100000, max_port = 65535;
    if (options.source.empty()) {
        for (const auto& [name, given] : {std::pair("survey", options.survey_frames.has_value()),
                                          std::pair("timeout", options.timeout.has_value()),
                                          std::pair("view", options.port.has_value())})
            if (given) throw UsageError(fmt::format("--{} needs --live.", name));
        return;
    }
    if (options.survey_frames &&
        (*options.survey_frames < min_survey || *options.survey_frames > max_survey))
        throw UsageError(fmt::format("--survey is {}, but it must be from {} to {}.",
                                     *options.survey_frames, min_survey, max_survey));
    if (options.timeout && !(*options.timeout > 0.0 && *options.timeout <= 1e6))
        throw UsageError(fmt::format("--timeout is {}, but it must be above 0.", *options.timeout));
    if (options.port && (*options.port < 0 || *options.port > max_port))
        throw UsageError(
            fmt::format("--view is {}, but it must be from 0 to {}.", *options.port, max_port));
}

#ifdef SWIRL_CAMERA

namespace {

/// Status on stderr: one line that changes on a terminal, else a line now and then.
class LiveStatusLine {
  public:
    explicit LiveStatusLine(bool quiet) : quiet_(quiet), terminal_(::isatty(STDERR_FILENO) == 1) {}
    ~LiveStatusLine() {
        if (drawn_) fmt::print(stderr, "\r\x1b[K");
    }
    LiveStatusLine(const LiveStatusLine&) = delete;
    LiveStatusLine& operator=(const LiveStatusLine&) = delete;

    void show(const LiveFrame& frame) {
        const auto now = Clock::now();
        if (quiet_ || now < next_) return;
        next_ = now + (terminal_ ? std::chrono::milliseconds(250) : std::chrono::seconds(5));
        const std::string text = text_of(frame, now);
        if (!terminal_) {
            fmt::print(stderr, "{}\n", text);
            return;
        }
        fmt::print(stderr, "\r\x1b[K{}", text);
        std::fflush(stderr);
        drawn_ = true;
    }

  private:
    using Clock = std::chrono::steady_clock;

    std::string text_of(const LiveFrame& frame, Clock::time_point now) {
        const double seconds = std::chrono::duration<double>(now - last_).count();
        const double rate = seconds > 0.0 ? double(frame.number - last_number_) / seconds : 0.0;
        last_ = now;
        last_number_ = frame.number;
        if (!frame.surveyed) return fmt::format("frame {}: survey", frame.number);
        std::string text = fmt::format("frame {}, {:.0f} frames/s: {} of {} discs", frame.number,
                                       rate, frame.discs.size(), frame.number_of_discs);
        const LiveRotation& r = frame.rotation;
        if (r.periods == 1) text += fmt::format(", ϖ/Ω = {:.3f} in 1 period", r.mean.mean);
        if (r.periods > 1)
            text += fmt::format(", ϖ/Ω = {:.3f} ± {:.3f} in {} periods, last {:.3f}", r.mean.mean,
                                r.mean.error, r.periods, r.last_period);
        return text;
    }

    const bool quiet_, terminal_;
    bool drawn_ = false;
    Clock::time_point next_{}, last_ = Clock::now();
    std::int64_t last_number_ = 0;
};

}  // namespace

LiveResult track_live_source(const LiveOptions& options, TrackingSettings settings, bool quiet) {
    LiveSource source;
    source.name = options.source;
    source.fps = settings.fps;
    source.timeout = options.timeout.value_or(source.timeout);
    source.max_frames = settings.max_frames;
    source.stop = &stop_signal();
    LiveVideo video(source);
    std::unique_ptr<FrameServer> server;
    if (options.port) {
        server = std::make_unique<FrameServer>(static_cast<int>(*options.port));
        fmt::print(stderr, "live images: {}\n", server->address());
    }
    // The first Ctrl-C ends the video, and what was tracked is written. A second one ends the
    // program.
    settings.stop = nullptr;
    settings.progress = nullptr;
    settings.max_frames = 0;
    LiveSettings live;
    live.survey_frames = options.survey_frames.value_or(live.survey_frames);
    LiveStatusLine line(quiet);
    live.show = [&](const LiveFrame& frame) {
        line.show(frame);
        if (server) server->publish([frame] { return live_jpeg(frame); });
    };
    try {
        return track_live(video, settings, live);
    } catch (const Failure& failure) {
        if (!source.stop->load()) throw;
        throw Interrupted(
            fmt::format("stopped after {} frames, too few to track; nothing was written: {}",
                        video.count(), failure.what()));
    }
}

#endif

}  // namespace swirl
