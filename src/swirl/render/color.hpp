// Colours, and two scales from numbers to colours.
//
// All sets can be distinguished with every common kind of colour vision:
//   - the categorical hues are those of Okabe and Ito ("Color Universal Design", 2008);
//   - the sequential scale rises evenly in lightness, as viridis does (van der Walt and Smith,
//     2015);
//   - the diverging scale of a theme (theme.hpp) goes from blue to orange through a neutral colour.
//     People with red-green colour blindness separate this pair best.
#pragma once

#include <array>
#include <cstddef>

namespace swirl {

/// sRGB components from 0 to 1.
struct Color {
    double red, green, blue;
};

constexpr Color color_from_hex(unsigned hex) {
    return {((hex >> 16) & 0xff) / 255.0, ((hex >> 8) & 0xff) / 255.0, (hex & 0xff) / 255.0};
}

constexpr Color mix(const Color& a, const Color& b, double share_of_b) {
    return {a.red + share_of_b * (b.red - a.red), a.green + share_of_b * (b.green - a.green),
            a.blue + share_of_b * (b.blue - a.blue)};
}

/// Perceived brightness from 0 to 1, with the weights of Rec. 709. They are applied to the
/// gamma-encoded values, which is good enough to choose between dark and light ink.
constexpr double brightness(const Color& c) {
    return 0.2126 * c.red + 0.7152 * c.green + 0.0722 * c.blue;
}

/// Okabe and Ito's hues, ordered so that neighbours differ in lightness, too.
inline constexpr std::array<Color, 7> distinct_colors{
    color_from_hex(0x56B4E9), color_from_hex(0xE69F00), color_from_hex(0x009E73),
    color_from_hex(0xCC79A7), color_from_hex(0xF0E442), color_from_hex(0x0072B2),
    color_from_hex(0xD55E00)};

/// Sectors of a cluster, around the circle: neighbours are similar, and opposite ones differ in
/// lightness. Blue and orange are missing, because they mean a direction of rotation (theme.hpp).
inline constexpr std::array<Color, 6> sector_colors{
    color_from_hex(0xEBDD45), color_from_hex(0x9CC63F), color_from_hex(0x1F9077),
    color_from_hex(0x59636E), color_from_hex(0x8654B0), color_from_hex(0xE591BA)};

/// Interpolates evenly spaced stops. `u` is clamped to 0…1; NaN counts as 0.
template <std::size_t count>
constexpr Color interpolate(const std::array<Color, count>& stops, double u) {
    if (!(u > 0.0)) return stops.front();
    if (u >= 1.0) return stops.back();
    const double position = u * static_cast<double>(count - 1);
    const auto below = static_cast<std::size_t>(position);
    return mix(stops[below], stops[below + 1], position - static_cast<double>(below));
}

inline constexpr std::array<Color, 7> sequential_stops{
    color_from_hex(0x46337E), color_from_hex(0x365C8D), color_from_hex(0x277F8E),
    color_from_hex(0x1FA187), color_from_hex(0x4AC16D), color_from_hex(0xA0DA39),
    color_from_hex(0xFDE725)};

/// 0…1 → dark blue, green, yellow.
constexpr Color sequential_color(double u) { return interpolate(sequential_stops, u); }

}  // namespace swirl
