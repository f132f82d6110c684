// Text with a little mathematics in it. Plain text is set upright; what stands between two dollar
// signs is set in italics, as symbols are, and there _{…} lowers and ^{…} raises:
//
//     "rotation $ϖ$/$Ω$ at $μ_{d}$ = 1"
//
// Digits and operators within the dollars stay upright. A glyph that the chosen fonts lack is taken
// from DejaVu Sans, which has all that is written here.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "swirl/render/canvas.hpp"

namespace swirl {

enum class Align { left, center, right };

struct LabelStyle {
    double size;  // of the type, in pixels
    Color color;
    Align align = Align::left;
    bool bold = false;
    double opacity = 1.0;
    bool even_digits = false;        // digits of one width, so that a running number stands still
    std::optional<Color> halo = {};  // drawn behind the letters, to lift them off what is there
};

/// Writes `text` with its baseline at `place`. Returns the width it took.
double draw_label(const Canvas& canvas, std::string_view text, Vec2 place, const LabelStyle& style);

/// The width that draw_label would take.
double label_width(const Canvas& canvas, std::string_view text, const LabelStyle& style);

/// The largest size, at most style.size, at which `text` is no wider than `width`.
double fitting_size(const Canvas& canvas, std::string_view text, const LabelStyle& style,
                    double width);

/// Text as it is, for titles that come from people: dollar signs lose their meaning.
std::string escaped(std::string_view text);

}  // namespace swirl
