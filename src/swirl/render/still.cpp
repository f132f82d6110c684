#include "swirl/render/still.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "swirl/io/atomic_file.hpp"
#include "swirl/io/file_error.hpp"
#include "swirl/run/failure.hpp"

namespace swirl {

std::optional<ImageFormat> image_format(const std::string& path) {
    if (path.size() > 4 && path.ends_with(".png")) return ImageFormat::png;
    if (path.size() > 4 && path.ends_with(".svg")) return ImageFormat::svg;
    if (path.size() > 4 && path.ends_with(".pdf")) return ImageFormat::pdf;
    return std::nullopt;
}

std::optional<std::string> problem(const StillConfig& config) {
    if (!image_format(config.out))
        return fmt::format("--out is '{}', but its name must end with .png, .svg or .pdf.",
                           config.out);
    if (auto wrong = problem(config.sources, config.appearance)) return wrong;
    constexpr int max_flashes = 1000;
    if (config.flashes < 1 || config.flashes > max_flashes)
        return fmt::format("--strobe is {} flashes, but it must be from 1 to {}.", config.flashes,
                           max_flashes);
    if (!(config.every > 0.0) || !std::isfinite(config.every))
        return fmt::format("--every is {}, but it must be above 0 periods.", config.every);
    const double first = config.at - (config.flashes - 1) * config.every;
    if (!(first >= 0.0) || !std::isfinite(config.at))
        return fmt::format("the first instant is at period {:g}, but it must be 0 or later.",
                           first);
    for (const FrameSource& source : config.sources)
        if (source.from && (first < *source.from - 1e-9 || config.at > *source.to + 1e-9))
            return fmt::format(
                "the recording covers periods {:.3f} to {:.3f}, but the image shows {}.",
                *source.from, *source.to,
                config.flashes == 1 ? fmt::format("period {:.3f}", config.at)
                                    : fmt::format("periods {:.3f} to {:.3f}", first, config.at));
    return std::nullopt;
}

double make_still(const StillConfig& config) try {
    // The plot covers the ten periods before the instant.
    const double begin = std::max(config.sources.front().from.value_or(0.0), config.at - 10.0);
    Appearance appearance = config.appearance;
    appearance.turns_since = begin;
    const Page page(config.sources, appearance, begin, config.at);
    std::vector<Moment> moments;
    for (std::size_t k = 0; k < config.sources.size(); ++k) {
        moments.push_back(page.player(k, config.at).at(config.at));
        if (config.flashes == 1) continue;
        const Playback playback = config.sources[k].open();
        for (int flash = config.flashes - 1; flash > 0; --flash)
            moments.back().ghosts.push_back(std::make_shared<const SourceState>(
                SourceState{playback(config.at - flash * config.every), {}}));
    }
    Canvas canvas(config.appearance.size, *image_format(config.out));
    page.sheet().draw_static(canvas);
    page.draw(canvas, moments, config.at);
    write_image(config.out, canvas.finish());
    return begin;
} catch (const DrawFailure& failure) {
    throw Failure(failure.what());
}

void write_image(const std::filesystem::path& file, const std::string& bytes) try {
    write_file_atomically(file, bytes);
} catch (const FileError& failure) {
    throw Failure(failure.what());
}

}  // namespace swirl
