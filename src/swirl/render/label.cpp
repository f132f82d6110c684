#include "swirl/render/label.hpp"

#include <algorithm>
#include <vector>

namespace swirl {

namespace {

/// A piece of text in one font face, size and height.
struct TextRun {
    std::string text;
    bool italic = false;
    int level = 0;  // −1 lowered, +1 raised
};

bool is_symbol(unsigned char c) {
    // ASCII letters, and every byte of a multi-byte character (Greek letters).
    return c >= 0x80 || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

void append(std::vector<TextRun>& runs, char c, bool italic, int level) {
    if (runs.empty() || runs.back().italic != italic || runs.back().level != level)
        runs.push_back({"", italic, level});
    runs.back().text += c;
}

std::vector<TextRun> parse(std::string_view text) {
    std::vector<TextRun> runs;
    bool math = false;
    int level = 0;
    for (std::size_t k = 0; k < text.size(); ++k) {
        const char c = text[k];
        const bool has_next = k + 1 < text.size();
        if (c == '\\' && has_next) {
            append(runs, text[++k], false, level);
        } else if (c == '$') {
            math = !math;
        } else if (math && (c == '_' || c == '^') && has_next && text[k + 1] == '{') {
            level = c == '_' ? -1 : 1;
            ++k;
        } else if (math && c == '}') {
            level = 0;
        } else {
            append(runs, c, math && is_symbol(static_cast<unsigned char>(c)), level);
        }
    }
    return runs;
}

void select_face(cairo_t* cairo, const TextRun& run, const LabelStyle& style) {
    constexpr double subscript_scale = 0.72;
    cairo_select_font_face(cairo, "DejaVu Sans",
                           run.italic ? CAIRO_FONT_SLANT_ITALIC : CAIRO_FONT_SLANT_NORMAL,
                           style.bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(cairo, style.size * (run.level != 0 ? subscript_scale : 1.0));
}

bool is_digit(const TextRun& run) {
    return run.text.size() == 1 && run.text[0] >= '0' && run.text[0] <= '9';
}

double advance_of(cairo_t* cairo, const TextRun& run, const LabelStyle& style) {
    select_face(cairo, run, style);
    cairo_text_extents_t extents;
    const bool even = style.even_digits && is_digit(run);
    cairo_text_extents(cairo, even ? "0" : run.text.c_str(), &extents);
    return extents.x_advance;
}

std::vector<TextRun> runs_of(std::string_view text, const LabelStyle& style) {
    const std::vector<TextRun> runs = parse(text);
    if (!style.even_digits) return runs;
    std::vector<TextRun> single;
    for (const TextRun& run : runs) {
        for (char c : run.text) {
            const bool digit = c >= '0' && c <= '9';
            if (digit || single.empty() || is_digit(single.back()) ||
                single.back().italic != run.italic || single.back().level != run.level)
                single.push_back({"", run.italic, run.level});
            single.back().text += c;
        }
    }
    return single;
}

/// Calls visit(run, left) for each run, with its face selected; the first starts at `x`.
void for_each_run(cairo_t* cairo, const std::vector<TextRun>& runs, const LabelStyle& style,
                  double x, auto&& visit) {
    for (const TextRun& run : runs) {
        const double advance = advance_of(cairo, run, style);
        double left = x;
        if (style.even_digits && is_digit(run)) {
            // A narrow digit is centred within the common width.
            cairo_text_extents_t extents;
            cairo_text_extents(cairo, run.text.c_str(), &extents);
            left += 0.5 * (advance - extents.x_advance);
        }
        visit(run, left);
        x += advance;
    }
}

}  // namespace

double label_width(const Canvas& canvas, std::string_view text, const LabelStyle& style) {
    double width = 0.0;
    for (const TextRun& run : runs_of(text, style)) width += advance_of(canvas.cairo(), run, style);
    return width;
}

double draw_label(const Canvas& canvas, std::string_view text, Vec2 position,
                  const LabelStyle& style) {
    cairo_t* cairo = canvas.cairo();
    const std::vector<TextRun> runs = runs_of(text, style);
    const double width = label_width(canvas, text, style);
    double left = position.x;
    if (style.align == Align::center) left -= 0.5 * width;
    if (style.align == Align::right) left -= width;
    const auto move_to_run = [&](const TextRun& run, double x) {
        const double lift = run.level * (run.level > 0 ? 0.38 : 0.22) * style.size;
        cairo_move_to(cairo, x, position.y - lift);
    };
    if (style.halo) {
        for_each_run(cairo, runs, style, left, [&](const TextRun& run, double x) {
            move_to_run(run, x);
            cairo_text_path(cairo, run.text.c_str());
        });
        canvas.set(*style.halo, 0.85 * style.opacity);
        cairo_set_line_width(cairo, 0.17 * style.size);
        cairo_set_line_join(cairo, CAIRO_LINE_JOIN_ROUND);
        cairo_stroke(cairo);
    }
    canvas.set(style.color, style.opacity);
    for_each_run(cairo, runs, style, left, [&](const TextRun& run, double x) {
        move_to_run(run, x);
        cairo_show_text(cairo, run.text.c_str());
    });
    cairo_new_path(cairo);
    return width;
}

double fitting_size(const Canvas& canvas, std::string_view text, const LabelStyle& style,
                    double width) {
    const double full = label_width(canvas, text, style);
    return full <= width ? style.size : style.size * width / full;
}

std::string escaped(std::string_view text) {
    std::string result;
    for (char c : text) {
        if (c == '$' || c == '\\') result += '\\';
        result += c;
    }
    return result;
}

}  // namespace swirl
