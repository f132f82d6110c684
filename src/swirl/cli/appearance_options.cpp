#include "swirl/cli/appearance_options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <utility>
#include <vector>

#include "swirl/render/movie.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/parameters.hpp"

namespace swirl {
namespace {

constexpr std::int64_t min_side = 16, max_side = 8192;  // side of an image, pixels
constexpr double longest_trail = 100.0;                 // periods

const std::pair<std::string_view, std::vector<Frame>> views[] = {
    {"laboratory", {Frame::lab}}, {"m", {Frame::m}}, {"both", {Frame::lab, Frame::m}}};

template <typename Value, std::size_t n>
using NamedValues = std::pair<std::string_view, Value>[n];

template <typename Value, std::size_t n>
std::vector<std::string> names_of(const NamedValues<Value, n>& values) {
    std::vector<std::string> names;
    for (const auto& [name, value] : values) names.emplace_back(name);
    return names;
}

/// Throws UsageError.
template <typename Value, std::size_t n>
const Value& value_named(const std::string& text, const char* option,
                         const NamedValues<Value, n>& values) {
    for (const auto& [name, value] : values)
        if (name == text) return value;
    reject_choice(option, text, names_of(values));
}

}  // namespace

std::shared_ptr<AppearanceTexts> add_appearance_options(Subcommand& subcommand) {
    auto texts = std::make_shared<AppearanceTexts>();
    texts->view = "laboratory";
    subcommand.in("Appearance")
        .add({
            {"--view", &texts->view, "Frame of reference; m rotates with the swirl [laboratory]",
             one_of(names_of(views))},
            {"--color", &texts->color, "What the colours of the discs show [sector]",
             one_of(names_of(colorings))},
            {"--trails", &texts->trails, "Draw the recent path of each disc"},
            {"--trail-length", &texts->trail_length, "Draw trails of this length [0.3]", "PERIODS"},
            {"--forces", &texts->forces, "Centrifugal and Coriolis force on each disc (M-frame)"},
            {"--turned-angle", &texts->turned,
             "Arc for the turned angle (lab) [with --color sector]"},
            {"--angles", &texts->angles, "Scale of the angle θ along the wall (M-frame)"},
            {"--plot", &texts->plot, "Plot of the cluster's rotation against time"},
            {"--theme", &texts->theme, "Colour theme [light]", one_of(names_of(themes))},
            {"--title", &texts->title, "Title above the image", "TEXT"},
            {"--captions-only", &texts->captions,
             "Large captions, without title, clock and parameters"},
            {"--no-annotations", &texts->bare, "Container and discs only, no text or markers"},
            {"--size", &texts->size, "Image size in pixels [1920x1080]", "WxH"},
        });
    return texts;
}

namespace {

Size parse_size(const std::string& text) {
    const auto [width, height] = read_image_size(text).value_or(ImageSides{});
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
    result.frames = value_named(texts.view, "view", views);
    result.coloring = value_named(texts.color, "color", colorings);
    result.theme = value_named(texts.theme, "theme", themes)();
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
        result.coloring == Coloring::sector && texts.view != "m" && !texts.bare;
    result.turned = texts.turned || shows_rotation;
    result.swirl = !texts.bare;
    result.angles = texts.angles;
    result.title = texts.title;
    result.texts = !texts.bare;
    result.points = !texts.bare && (texts.forces || texts.angles);  // they refer to S and M
    result.path = !texts.bare;
    result.captions_only = texts.captions;
    if (texts.captions && (texts.bare || !texts.title.empty()))
        throw UsageError(
            "--captions-only leaves the captions only, so it excludes --title and "
            "--no-annotations.");
    if (texts.turned && texts.view == "m")
        throw UsageError(
            "--turned-angle shows the rotation in the lab frame.\n"
            "hint: use --view laboratory or --view both.");
    if (result.angles && texts.view == "laboratory")
        throw UsageError("--angles shows θ in the M-frame.\nhint: use --view m or --view both.");
    if (result.forces && texts.view == "laboratory")
        throw UsageError(
            "--forces shows forces in the M-frame.\nhint: use --view m or --view both.");
    return result;
}

}  // namespace swirl
