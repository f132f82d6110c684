#include "swirl/cli/appearance_options.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "swirl/render/movie.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/parameters.hpp"

namespace swirl {

std::shared_ptr<AppearanceTexts> add_appearance_options(Subcommand& subcommand) {
    auto texts = std::make_shared<AppearanceTexts>();
    texts->frame = "lab";
    subcommand.in("Appearance")
        .add({
            {"--frame", &texts->frame, "Frame of reference: lab, co-rotating (M), or both [lab]",
             "lab|m|both"},
            {"--color", &texts->color, "Colour by sector, pinned, spin, speed, slip, id or none",
             "NAME"},
            {"--trails", &texts->trails, "Draw the recent path of each disc"},
            {"--trail-length", &texts->trail_length, "Draw trails of this length [0.3]", "PERIODS"},
            {"--forces", &texts->forces, "Centrifugal and Coriolis force on each disc (M-frame)"},
            {"--turned-angle", &texts->turned,
             "Arc for the turned angle (lab) [with --color sector]"},
            {"--angles", &texts->angles, "Scale of the angle θ along the wall (M-frame)"},
            {"--plot", &texts->plot, "Plot of the cluster's rotation against time"},
            {"--theme", &texts->theme, "Colour theme: light or dark [light]", "NAME"},
            {"--title", &texts->title, "Title above the image", "TEXT"},
            {"--no-annotations", &texts->bare, "Container and discs only, no text or markers"},
            {"--size", &texts->size, "Image size in pixels [1920x1080]", "WxH"},
        });
    return texts;
}

namespace {

constexpr std::int64_t min_side = 16, max_side = 8192;  // side of an image, pixels
constexpr double longest_trail = 100.0;                 // periods

std::vector<Frame> parse_frames(const std::string& name) {
    if (name == "lab") return {Frame::lab};
    if (name == "m") return {Frame::m};
    if (name == "both") return {Frame::lab, Frame::m};
    throw UsageError(fmt::format("--frame is '{}', but it must be lab, m or both.{}", name,
                                 nearest_value_hint(name, {"lab", "both"})));
}

Size parse_size(const std::string& text) {
    const auto separator = std::min(text.find('x'), text.size());
    const auto width = read_whole_number(text.substr(0, separator)).value_or(0);
    const auto height =
        separator < text.size() ? read_whole_number(text.substr(separator + 1)).value_or(0) : 0;
    if (std::min(width, height) < min_side || std::max(width, height) > max_side)
        throw UsageError(fmt::format(
            "--size is '{}', but it must be WIDTHxHEIGHT with sides from {} to {} pixels, for "
            "example 1920x1080.",
            text, min_side, max_side));
    return {static_cast<int>(width), static_cast<int>(height)};
}

}  // namespace

Appearance appearance(const AppearanceTexts& texts, Size otherwise) {
    Appearance result;
    result.frames = parse_frames(texts.frame);
    const auto coloring = coloring_named(texts.color);
    if (!coloring)
        throw UsageError(fmt::format(
            "--color is '{}', but it must be sector, pinned, spin, speed, slip, none or id.{}",
            texts.color,
            nearest_value_hint(texts.color,
                               {"sector", "pinned", "spin", "speed", "slip", "none"})));
    result.coloring = *coloring;
    const auto theme = theme_named(texts.theme);
    if (!theme)
        throw UsageError(fmt::format("--theme is '{}', but it must be dark or light.{}",
                                     texts.theme,
                                     nearest_value_hint(texts.theme, {"dark", "light"})));
    result.theme = *theme;
    result.size = texts.size.empty() ? otherwise : parse_size(texts.size);
    if (texts.trail_length) {
        if (!(*texts.trail_length > 0.0) || *texts.trail_length > longest_trail)
            throw UsageError(
                fmt::format("--trail-length is {}, but it must be above 0 and at most {} periods.",
                            *texts.trail_length, longest_trail));
        result.trail_length = *texts.trail_length;
    }
    result.trails = texts.trails || texts.trail_length;
    result.forces = texts.forces;
    result.plot = texts.plot;
    const bool shows_rotation =
        result.coloring == Coloring::sector && texts.frame != "m" && !texts.bare;
    result.turned = texts.turned || shows_rotation;
    result.swirl = !texts.bare;
    result.angles = texts.angles;
    result.title = texts.title;
    result.texts = !texts.bare;
    result.points = !texts.bare && (texts.forces || texts.angles);  // they refer to S and M
    result.path = !texts.bare;
    if (texts.turned && texts.frame == "m")
        throw UsageError(
            "--turned-angle shows the rotation in the lab frame.\nhint: use --frame lab or --frame "
            "both.");
    if (result.angles && texts.frame == "lab")
        throw UsageError("--angles shows θ in the M-frame.\nhint: use --frame m or --frame both.");
    if (result.forces && texts.frame == "lab")
        throw UsageError(
            "--forces shows forces in the M-frame.\nhint: use --frame m or --frame both.");
    return result;
}

}  // namespace swirl
