#include "swirl/cli/appearance_options.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "swirl/run/failure.hpp"
#include "swirl/run/parameters.hpp"

namespace swirl {
namespace {

std::vector<Frame> frames_named(const std::string& name) {
    if (name == "lab") return {Frame::lab};
    if (name == "m") return {Frame::m};
    if (name == "both") return {Frame::lab, Frame::m};
    throw UsageError(fmt::format("--frame is '{}', but it must be lab, m or both.", name));
}

Size size_from(const std::string& text) {
    const auto cross = std::min(text.find('x'), text.size());
    const auto width = read_whole_number(text.substr(0, cross)).value_or(0);
    const auto height =
        cross < text.size() ? read_whole_number(text.substr(cross + 1)).value_or(0) : 0;
    if (std::min(width, height) < 16 || std::max(width, height) > 8192)
        throw UsageError(fmt::format(
            "--size is '{}', but it must be WIDTHxHEIGHT with sides from 16 to 8192 pixels, for "
            "example 1920x1080.",
            text));
    return {static_cast<int>(width), static_cast<int>(height)};
}

}  // namespace

std::shared_ptr<AppearanceTexts> add_appearance_options(Subcommand& subcommand) {
    auto texts = std::make_shared<AppearanceTexts>();
    texts->frame = "lab";
    const auto group = "Appearance";
    subcommand
        .add_option("--frame", texts->frame,
                    "lab; m: turning with the swirl, the point M at the bottom; or both [lab]")
        ->type_name("lab|m|both")
        ->group(group);
    subcommand
        .add_option("--color", texts->color,
                    "what the discs' colours tell: pinned, spin, speed, slip (of spheres on the "
                    "floor), none, id [none]")
        ->type_name("NAME")
        ->group(group);
    subcommand.add_flag("--trails", texts->trails, "draw where the discs come from")->group(group);
    subcommand
        .add_option("--trail-length", texts->trail_length,
                    "draw them, reaching back so many swirls [0.3]")
        ->type_name("SWIRLS")
        ->group(group);
    subcommand
        .add_flag("--forces", texts->forces,
                  "centrifugal and Coriolis force on each disc (M-frame)")
        ->group(group);
    subcommand
        .add_flag("--turned", texts->turned,
                  "an arc round the dish: how far the cluster has turned (lab frame)")
        ->group(group);
    subcommand.add_flag("--angles", texts->angles, "the angle θ along the wall (M-frame)")
        ->group(group);
    subcommand.add_flag("--plot", texts->plot, "the cluster's rotation against time")->group(group);
    subcommand.add_option("--theme", texts->theme, "dark or light [dark]")
        ->type_name("NAME")
        ->group(group);
    subcommand.add_option("--title", texts->title, "a headline")->type_name("TEXT")->group(group);
    subcommand.add_flag("--bare", texts->bare, "no text, no points: dish and discs only")
        ->group(group);
    subcommand.add_option("--size", texts->size, "in pixels [1920x1080]")
        ->type_name("WxH")
        ->group(group);
    return texts;
}

Appearance appearance(const AppearanceTexts& texts, Size otherwise) {
    Appearance look;
    look.frames = frames_named(texts.frame);
    const auto coloring = coloring_named(texts.color);
    if (!coloring)
        throw UsageError(fmt::format(
            "--color is '{}', but it must be pinned, spin, speed, slip, none or id.", texts.color));
    look.coloring = *coloring;
    const auto theme = theme_named(texts.theme);
    if (!theme)
        throw UsageError(
            fmt::format("--theme is '{}', but it must be dark or light.", texts.theme));
    look.theme = *theme;
    look.size = texts.size.empty() ? otherwise : size_from(texts.size);
    if (texts.trail_length) {
        if (!(*texts.trail_length > 0.0) || *texts.trail_length > 100.0)
            throw UsageError(
                fmt::format("--trail-length is {}, but it must be above 0 and at most 100 swirls.",
                            *texts.trail_length));
        look.trail_length = *texts.trail_length;
    }
    look.trails = texts.trails || texts.trail_length;
    look.forces = texts.forces;
    look.plot = texts.plot;
    look.turned = texts.turned;
    look.angles = texts.angles;
    look.title = texts.title;
    look.texts = !texts.bare;
    look.points = !texts.bare;
    look.path = !texts.bare;
    if (look.turned && texts.frame == "m")
        throw UsageError(
            "--turned shows the rotation in the lab: it needs --frame lab or --frame both.");
    if (look.angles && texts.frame == "lab")
        throw UsageError(
            "--angles shows the θ of the turning frame: it needs --frame m or --frame both.");
    if (look.forces && texts.frame == "lab")
        throw UsageError(
            "--forces shows the forces of the turning frame: it needs --frame m or --frame both.");
    return look;
}

}  // namespace swirl
