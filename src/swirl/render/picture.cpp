#include "swirl/render/picture.hpp"

#include <fmt/format.h>

#include <cmath>
#include <memory>

#include "swirl/io/atomic_file.hpp"
#include "swirl/io/file_error.hpp"
#include "swirl/run/failure.hpp"

namespace swirl {

namespace {

/// One dish with everything its picture needs.
struct Exposure {
    Snapshot now;
    std::vector<Snapshot> past, ghosts;
    std::vector<std::uint8_t> pinned;
    std::vector<const Snapshot*> past_pointers, ghost_pointers;
    std::optional<Backdrop> backdrop;
    std::vector<std::int64_t> ids;
    std::vector<std::vector<std::int64_t>> past_ids;
    std::vector<std::span<const std::int64_t>> past_id_spans;
};

Exposure expose(const FrameSource& source, const PictureConfig& config) {
    Exposure exposure;
    const double from = source.from.value_or(0.0);
    const Reel reel = source.open();
    for (int k = config.flashes - 1; k > 0; --k)
        exposure.ghosts.push_back(reel(config.at - k * config.every));
    if (config.appearance.trails) {
        // A reel of its own: trails may begin before the last flash.
        const Reel trail = source.open();
        constexpr int points = 96;  // per swirl
        const double begin = std::max(from, config.at - config.appearance.trail_length);
        for (auto k = static_cast<std::int64_t>(std::ceil(begin * points));
             static_cast<double>(k) / points < config.at; ++k) {
            const double then = static_cast<double>(k) / points;
            exposure.past.push_back(trail(then));
            if (source.ids) exposure.past_ids.push_back(source.ids(then));
        }
    }
    exposure.now = reel(config.at);
    if (source.ids) exposure.ids = source.ids(config.at);
    if (source.open_backdrop) exposure.backdrop = source.open_backdrop()(config.at);
    if (config.appearance.coloring == Coloring::pinned)
        exposure.pinned = PinnedWatch(source, config.at).at(config.at);
    return exposure;
}

}  // namespace

std::optional<PictureFormat> picture_format(const std::string& path) {
    if (path.size() > 4 && path.ends_with(".png")) return PictureFormat::png;
    if (path.size() > 4 && path.ends_with(".svg")) return PictureFormat::svg;
    if (path.size() > 4 && path.ends_with(".pdf")) return PictureFormat::pdf;
    return std::nullopt;
}

std::optional<std::string> problem(const PictureConfig& config) {
    if (!picture_format(config.out))
        return fmt::format(
            "The name '{}' does not tell what kind of picture is wanted: it must end in .png, .svg "
            "or .pdf.",
            config.out);
    if (auto wrong = problem(config.sources, config.appearance)) return wrong;
    if (config.flashes < 1 || config.flashes > 1000)
        return fmt::format("A stroboscope of {} flashes cannot be drawn: 1 to 1000 can.",
                           config.flashes);
    if (!(config.every > 0.0) || !std::isfinite(config.every))
        return fmt::format("Flashes every {} swirls cannot be drawn: it must be above 0.",
                           config.every);
    const double first = config.at - (config.flashes - 1) * config.every;
    if (!(first >= 0.0) || !std::isfinite(config.at))
        return fmt::format("The first instant would be at swirl {:g}: it must be 0 or later.",
                           first);
    for (const FrameSource& source : config.sources) {
        if (source.from && (first < *source.from - 1e-9 || config.at > *source.to + 1e-9))
            return fmt::format(
                "The recording holds the swirls from {:.3f} to {:.3f}, not all from {:.3f} to "
                "{:.3f}.",
                *source.from, *source.to, first, config.at);
    }
    return std::nullopt;
}

void make_picture(const PictureConfig& config) try {
    std::vector<Curve> curves;
    const double begin = std::max(config.sources.front().from.value_or(0.0), config.at - 10.0);
    const Sheet sheet = make_sheet(config.sources, config.appearance, begin, config.at, curves);
    std::vector<Exposure> exposures;
    for (const FrameSource& source : config.sources) exposures.push_back(expose(source, config));

    std::vector<SceneContent> contents;
    for (std::size_t k = 0; k < exposures.size(); ++k) {
        Exposure& e = exposures[k];
        for (const Snapshot& s : e.past) e.past_pointers.push_back(&s);
        for (const Snapshot& s : e.ghosts) e.ghost_pointers.push_back(&s);
        for (const auto& ids : e.past_ids) e.past_id_spans.push_back(ids);
        for (std::size_t f = 0; f < config.appearance.frames.size(); ++f)
            contents.push_back({.now = e.now,
                                .path = config.sources[k].path,
                                .pinned = e.pinned,
                                .past = e.past_pointers,
                                .ghosts = e.ghost_pointers,
                                .backdrop = e.backdrop ? &*e.backdrop : nullptr,
                                .ids = e.ids,
                                .past_ids = e.past_id_spans});
        if (config.appearance.turned)
            for (std::size_t f = 0; f < config.appearance.frames.size(); ++f)
                contents[contents.size() - 1 - f].turned = turns_until(curves[k], begin, config.at);
    }
    Canvas canvas(config.appearance.size, *picture_format(config.out));
    sheet.draw_still(canvas);
    sheet.draw_moving(canvas, contents, curves, config.at);
    write_picture(config.out, canvas.finish());
} catch (const DrawFailure& failure) {
    throw Failure(failure.what());
}

void write_picture(const std::filesystem::path& file, const std::string& bytes) try {
    write_named_file(file, bytes);
} catch (const FileError& failure) {
    throw Failure(failure.what());
}

}  // namespace swirl
