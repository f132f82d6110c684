#include "swirl/render/movie.hpp"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <memory>
#include <thread>

#include "swirl/io/atomic_file.hpp"
#include "swirl/render/frame_pipeline.hpp"
#include "swirl/render/movie_file.hpp"
#include "swirl/render/planar.hpp"
#include "swirl/run/failure.hpp"

namespace swirl {

namespace {

/// A worker's canvas. What is the same in every frame is drawn once and copied.
class FrameCanvas {
  public:
    explicit FrameCanvas(const Sheet& sheet) : canvas_(sheet.spec().size) {
        sheet.draw_static(canvas_);
        const auto pixels = canvas_.pixels();
        static_part_.assign(pixels.begin(), pixels.end());
    }

    Canvas& draw(const Page& page, std::span<const Moment> moments, double periods) {
        std::copy(static_part_.begin(), static_part_.end(), canvas_.pixels().begin());
        cairo_surface_mark_dirty(cairo_get_target(canvas_.cairo()));
        page.draw(canvas_, moments, periods);
        return canvas_;
    }

  private:
    Canvas canvas_;
    std::vector<std::uint8_t> static_part_;
};

void make_folder(const std::string& folder) {
    if (::mkdir(folder.c_str(), 0777) == 0 || errno == EEXIST) return;
    throw Failure(fmt::format("cannot create the folder '{}': {}.", folder, std::strerror(errno)));
}

double time_of_frame(const MovieConfig& config, int frame) {
    return config.start + frame * config.pace / config.frames_per_second;
}

/// Not synchronised to the disk: waiting for each frame would take most of the time.
void write_frame(const std::string& name, Canvas& canvas) {
    AtomicFile file(name);
    file.append(canvas.png());
    file.flush_buffer();
    file.publish();
}

std::optional<std::string> problem_with_times(const MovieConfig& config) {
    if (!(config.pace > 0.0) || !std::isfinite(config.pace))
        return fmt::format("--pace is {}, but it must be above 0 periods per second.", config.pace);
    if (config.frames < 1 || config.frames > 1'000'000)
        return fmt::format("the movie would have {} frames, but it must have 1 to 1000000.",
                           config.frames);
    if (!(config.start >= 0.0) || !std::isfinite(config.start))
        return fmt::format("--start is {}, but it must be 0 periods or more.", config.start);
    const double end = time_of_frame(config, config.frames - 1);
    for (const FrameSource& source : config.sources) {
        if (source.from && config.start < *source.from - 1e-9)
            return fmt::format(
                "the recording starts at period {:.3f}, but the movie starts at period {:.3f}.",
                *source.from, config.start);
        if (source.to && end > *source.to + 1e-6)
            return fmt::format(
                "the recording ends at period {:.3f}, but the movie ends at period {:.3f}.\n"
                "hint: reduce --seconds or --pace.",
                *source.to, end);
    }
    return std::nullopt;
}

}  // namespace

std::string frame_name(const std::string& folder, int number) {
    return fmt::format("{}/frame-{:06d}.png", folder, number);
}

std::optional<std::string> problem(const MovieConfig& config) {
    if (config.out.empty() && config.frames_folder.empty())
        return "missing output: give --out FILE, --frame-files DIR or both.";
    const std::optional<MovieFormat> format = movie_format(config.out);
    if (!config.out.empty() && !format)
        return fmt::format("--out is '{}', but its name must end with .mp4, .webm or .gif.",
                           config.out);
    if (auto wrong = problem(config.sources, config.appearance)) return wrong;
    // Frames in a folder may have any rate and odd sides.
    const Size size = config.appearance.size;
    if (format) {
        if (auto wrong = movie_problem(*format, size, config.frames_per_second)) return wrong;
    } else if (config.frames_per_second < 1) {
        return fmt::format("--fps is {}, but it must be 1 or more.", config.frames_per_second);
    }
    if (auto wrong = problem_with_times(config)) return wrong;
    // A GIF has one palette for the whole movie, so ffmpeg keeps every frame until the end.
    constexpr double max_gif_bytes = 2e9;
    const double gif_bytes = 4.0 * size.width * size.height * config.frames;
    if (format == MovieFormat::gif && gif_bytes > max_gif_bytes)
        return fmt::format(
            "making this GIF would take {:.1f} GB of memory, but {:.0f} GB is the limit.\n"
            "hint: reduce the number of frames or --size, or write an .mp4 file.",
            gif_bytes * 1e-9, max_gif_bytes * 1e-9);
    return std::nullopt;
}

MovieResult make_movie(const MovieConfig& config, const MovieControl& control) try {
    const auto stopped = [&] { return control.stop && control.stop->load(); };
    const Page page(config.sources, config.appearance, config.start,
                    time_of_frame(config, config.frames - 1));
    const std::optional<MovieFormat> format = movie_format(config.out);
    std::unique_ptr<MovieWriter> movie;
    if (format)
        movie = std::make_unique<MovieWriter>(config.out, *format, config.appearance.size,
                                              config.frames_per_second);
    if (!config.frames_folder.empty()) make_folder(config.frames_folder);

    const unsigned workers = std::max(1u, std::thread::hardware_concurrency());
    std::vector<std::unique_ptr<FrameCanvas>> canvases(workers);
    std::atomic<int> delivered = 0;
    int frame = 0;
    {
        FramePipeline pipeline(workers, [&](const FramePipeline::Bytes& bytes) {
            if (movie) movie->write(bytes);
            ++delivered;
        });
        std::vector<SourcePlayer> players;
        for (std::size_t k = 0; k < config.sources.size(); ++k)
            players.push_back(page.player(k, config.start));
        for (; frame < config.frames && !stopped(); ++frame) {
            const double periods = time_of_frame(config, frame);
            const auto moments = std::make_shared<std::vector<Moment>>();
            try {
                for (SourcePlayer& player : players) moments->push_back(player.at(periods));
            } catch (const Interrupted&) {
                break;
            }
            pipeline.submit(
                [&, moments, periods, frame](unsigned worker, FramePipeline::Bytes& bytes) {
                    auto& own = canvases[worker];
                    if (!own) own = std::make_unique<FrameCanvas>(page.sheet());
                    Canvas& canvas = own->draw(page, *moments, periods);
                    if (!config.frames_folder.empty())
                        write_frame(frame_name(config.frames_folder, frame + 1), canvas);
                    if (!format) return;
                    if (*format == MovieFormat::gif) {
                        const auto pixels = canvas.pixels();
                        bytes.assign(pixels.begin(), pixels.end());
                    } else {
                        to_planar(canvas.pixels(), config.appearance.size, bytes);
                    }
                });
            if (control.progress) control.progress(delivered.load(), config.frames);
        }
        pipeline.finish();
    }
    if (frame == 0) return {};
    if (movie) movie->finish();
    if (control.progress) control.progress(frame, config.frames);
    return {.frames = frame, .complete = frame == config.frames};
} catch (const DrawFailure& failure) {
    throw Failure(failure.what());
}

}  // namespace swirl
