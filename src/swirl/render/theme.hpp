// Colour themes: a dark one for projectors and screens, a light one for paper. The colours with a
// meaning are the same in the browser pages, the Python module and the figures, which also work
// without the module: a test writes the copies of each (tests/render/look_test.cpp).
#pragma once

#include <array>
#include <string_view>
#include <utility>

#include "swirl/render/color.hpp"

namespace swirl {

struct Theme {
    Color page;             // background
    Color floor;            // the container's inside
    Color wall, wall_mark;  // the ring, and the marks that show its rotation
    Color ink, faint_ink;   // text; captions and axes
    Color path;             // path of the container's centre
    Color disc;             // discs that are not coloured
    Color with, against;    // rotation with the swirl, or counter-clockwise; and the opposite
    Color pinned, loose;    // discs; these hues mean no direction
    Color neutral;          // middle of the diverging scale
    Color centrifugal, coriolis, velocity;
    Color accent;  // wide mark on the wall
    Color curve;   // curve of the running plot

    constexpr const Color& direction(bool with_swirl) const { return with_swirl ? with : against; }

    /// −1…1: against the swirl or clockwise, neutral, with it or counter-clockwise.
    constexpr Color diverging(double u) const {
        const std::array<Color, 5> stops{against, mix(against, neutral, 0.5), neutral,
                                         mix(with, neutral, 0.5), with};
        return interpolate(stops, 0.5 * (u + 1.0));
    }
};

/// For projectors and screens.
constexpr Theme dark_theme() {
    return {.page = color_from_hex(0x11151C),
            .floor = color_from_hex(0x1B212B),
            .wall = color_from_hex(0x5B6675),
            .wall_mark = color_from_hex(0xDDE3EA),
            .ink = color_from_hex(0xEDF1F5),
            .faint_ink = color_from_hex(0x97A3B2),
            .path = color_from_hex(0x6C7A8C),
            .disc = color_from_hex(0x7FA6CC),
            .with = color_from_hex(0xF2954B),
            .against = color_from_hex(0x74B5F0),
            .pinned = color_from_hex(0x35C295),
            .loose = color_from_hex(0x8793A1),
            .neutral = color_from_hex(0xD9DEE4),
            .centrifugal = color_from_hex(0xE69F00),
            .coriolis = color_from_hex(0xE07BB4),
            .velocity = color_from_hex(0x8CD0F5),
            .accent = color_from_hex(0xF0E442),
            .curve = color_from_hex(0xDDE3EA)};
}

/// For paper and bright rooms.
constexpr Theme light_theme() {
    return {.page = color_from_hex(0xFFFFFF),
            .floor = color_from_hex(0xF3F5F7),
            .wall = color_from_hex(0xAEB7C1),
            .wall_mark = color_from_hex(0x2B333D),
            .ink = color_from_hex(0x161B22),
            .faint_ink = color_from_hex(0x5E6A77),
            .path = color_from_hex(0x8A95A1),
            .disc = color_from_hex(0x8DB4D6),
            .with = color_from_hex(0xC04E08),
            .against = color_from_hex(0x1F63A6),
            .pinned = color_from_hex(0x00795C),
            .loose = color_from_hex(0x98A3AF),
            .neutral = color_from_hex(0xD3D8DE),
            .centrifugal = color_from_hex(0xB87400),
            .coriolis = color_from_hex(0xC2548F),
            .velocity = color_from_hex(0x0072B2),
            .accent = color_from_hex(0xB0007A),
            .curve = color_from_hex(0x2B333D)};
}

inline constexpr std::pair<std::string_view, Theme (*)()> themes[] = {{"light", light_theme},
                                                                      {"dark", dark_theme}};

}  // namespace swirl
