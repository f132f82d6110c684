// Text with a little mathematics. Plain text is upright. Between two dollar signs letters are
// italic, _{…} lowers and ^{…} raises; digits and operators stay upright:
//
//     "rotation $ϖ$/$Ω$ at $μ_{d}$ = 1"
//
// The font is DejaVu Sans, as in all figures: it has every symbol that is used.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "swirl/render/canvas.hpp"

namespace swirl {

/// Smaller letters, in pixels, are not legible.
inline constexpr double min_font_size = 7.0;

enum class Align { left, center, right };

struct LabelStyle {
    double size;  // font size in pixels
    Color color;
    Align align = Align::left;
    bool bold = false;
    double opacity = 1.0;
    bool even_digits = false;        // all digits have one width: a running number does not jitter
    std::optional<Color> halo = {};  // drawn behind the letters, for contrast
};

/// Writes `text` with its baseline at `position`, in pixels. Returns its width.
double draw_label(const Canvas& canvas, std::string_view text, Vec2 position,
                  const LabelStyle& style);

/// The width that draw_label() would return.
double label_width(const Canvas& canvas, std::string_view text, const LabelStyle& style);

/// The largest font size, at most style.size, at which `text` is no wider than `width`.
double fitting_size(const Canvas& canvas, std::string_view text, const LabelStyle& style,
                    double width);

/// Text that draw_label() writes literally: dollar signs lose their meaning.
std::string escaped(std::string_view text);

}  // namespace swirl
