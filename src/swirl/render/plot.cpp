#include "swirl/render/plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "swirl/render/label.hpp"

namespace swirl {

namespace {

/// The area of the curves. Numbers are on the left and below, the name of the quantity above.
Rectangle inner_area(const Rectangle& area, const PlotStyle& style) {
    const double left = 3.6 * style.em, below = 2.3 * style.em, above = 1.7 * style.em;
    return {area.x + left, area.y + above, area.width - left - 0.6 * style.em,
            area.height - below - above};
}

Vec2 on_page(const Rectangle& inner, const PlotStyle& style, double time, double value) {
    return {inner.x + inner.width * (time - style.from) / (style.to - style.from),
            inner.y + inner.height * (style.highest - value) / (style.highest - style.lowest)};
}

std::string number(double value, double step) {
    const int decimals = std::clamp(static_cast<int>(std::ceil(-std::log10(step) - 1e-9)), 0, 6);
    return fmt::format("{}{:.{}f}", value < -0.5 * step ? "−" : "", std::abs(value), decimals);
}

/// Times are written as (time − origin)/unit. For tiny steps the origin is the beginning and the
/// unit a power of ten: 20.000001 and 20.000002 would not be readable.
struct TimeAxis {
    double origin = 0.0, unit = 1.0;
    std::string label;
};

TimeAxis time_axis(const PlotStyle& style, double step) {
    TimeAxis axis{0.0, 1.0, style.time_label};
    if (step >= 1e-3) return axis;
    const int thousands = static_cast<int>(std::floor(std::log10(step) / 3.0 + 1e-9));
    axis.origin = style.from;
    axis.unit = std::pow(10.0, 3 * thousands);
    axis.label = fmt::format("10$^{{−{}}}$ {}", -3 * thousands, style.time_label);
    if (style.from > 0.0) axis.label += fmt::format(" after {:.6g}", style.from);
    return axis;
}

/// The name of a curve, next to its end.
struct Tag {
    const Curve* curve;
    Vec2 position;
    Align align;
};

/// Moves the tags so that their distances are at least `minimum` and they lie within the plot.
void separate(std::vector<Tag>& tags, double top, double bottom, double minimum) {
    std::stable_sort(tags.begin(), tags.end(),
                     [](const Tag& a, const Tag& b) { return a.position.y < b.position.y; });
    double lowest = top;
    for (Tag& tag : tags) {
        tag.position.y = std::max(tag.position.y, lowest);
        lowest = tag.position.y + minimum;
    }
    double highest = bottom;
    for (auto tag = tags.rbegin(); tag != tags.rend(); ++tag) {
        tag->position.y = std::min(tag->position.y, highest);
        highest = tag->position.y - minimum;
    }
}

void add_curve(cairo_t* cairo, const Rectangle& inner, const PlotStyle& style, const Curve& curve,
               const std::vector<double>& values, double now) {
    bool drawing = false;
    for (std::size_t k = 0; k < curve.time.size() && curve.time[k] <= now; ++k) {
        if (curve.time[k] < style.from || std::isnan(values[k])) {
            drawing = false;
            continue;
        }
        const Vec2 p = on_page(inner, style, curve.time[k], values[k]);
        if (drawing)
            cairo_line_to(cairo, p.x, p.y);
        else
            cairo_move_to(cairo, p.x, p.y);
        drawing = true;
    }
}

}  // namespace

double round_step(double span, int count) {
    const double minimum = span / count;
    const double power = std::pow(10.0, std::floor(std::log10(minimum)));
    for (double factor : {1.0, 2.0, 5.0})
        if (factor * power >= minimum * (1.0 - 1e-9)) return factor * power;
    return 10.0 * power;
}

void fit_range(PlotStyle& style, std::span<const Curve> curves) {
    constexpr double tail = 0.025;  // share of the raw values that is ignored at each end
    double lowest = 0.0, highest = 0.0;
    for (const Curve& curve : curves) {
        std::vector<double> raw;
        for (std::size_t k = 0; k < curve.time.size(); ++k) {
            if (curve.time[k] < style.from || curve.time[k] > style.to) continue;
            if (!std::isnan(curve.raw[k])) raw.push_back(curve.raw[k]);
            if (std::isnan(curve.smooth[k])) continue;
            lowest = std::min(lowest, curve.smooth[k]);
            highest = std::max(highest, curve.smooth[k]);
        }
        if (raw.empty()) continue;
        std::sort(raw.begin(), raw.end());
        const auto cut = static_cast<std::size_t>(tail * static_cast<double>(raw.size()));
        lowest = std::min(lowest, raw[cut]);
        highest = std::max(highest, raw[raw.size() - 1 - cut]);
    }
    const double margin = std::max(0.05 * (highest - lowest), 0.02);
    style.lowest = lowest - margin;
    style.highest = highest + margin;
}

void draw_plot_frame(const Canvas& canvas, const Rectangle& area, const Theme& theme,
                     const PlotStyle& style) {
    const Rectangle inner = inner_area(area, style);
    if (inner.width <= 0.0 || inner.height <= 0.0) return;
    const double line = std::max(0.6, 0.05 * style.em);
    cairo_rectangle(canvas.cairo(), inner.x, inner.y, inner.width, inner.height);
    canvas.fill(theme.floor);

    LabelStyle tick{.size = 0.88 * style.em, .color = theme.faint_ink, .align = Align::right};
    int parts = std::max(2, static_cast<int>(inner.height / (1.7 * style.em)));
    double step = round_step(style.highest - style.lowest, parts);
    // At least two numbers are needed to read a scale.
    while (parts < 64 &&
           std::floor(style.highest / step) - std::ceil(style.lowest / step) + 1.0 < 2.0)
        step = round_step(style.highest - style.lowest, parts *= 2);
    for (double k = std::ceil(style.lowest / step); k * step <= style.highest; k += 1.0) {
        const Vec2 p = on_page(inner, style, style.from, k * step);
        const bool zero = k == 0.0;
        canvas.add_line({inner.x, p.y}, {inner.x + inner.width, p.y});
        canvas.stroke(zero ? 1.6 * line : line, theme.faint_ink, zero ? 0.9 : 0.25);
        draw_label(canvas, number(k * step, step),
                   {inner.x - 0.5 * style.em, p.y + 0.32 * style.em}, tick);
    }
    tick.align = Align::center;
    const double time_step =
        std::max(round_step(style.to - style.from,
                            std::max(2, static_cast<int>(inner.width / (5.0 * style.em)))),
                 1e-12);
    const TimeAxis axis = time_axis(style, time_step);
    const double from = style.from - axis.origin, to = style.to - axis.origin;
    for (double k = std::ceil(from / time_step - 1e-9); k * time_step <= to + 1e-9 * time_step;
         k += 1.0) {
        const Vec2 p = on_page(inner, style, axis.origin + k * time_step, style.lowest);
        const std::string text = number(k * time_step / axis.unit, time_step / axis.unit);
        // The number stays within the plot, and so within the page.
        const double half = 0.5 * label_width(canvas, text, tick);
        const double x = std::clamp(p.x, area.x + half, area.x + area.width - half);
        draw_label(canvas, text, {x, p.y + 1.2 * style.em}, tick);
    }
    const LabelStyle name{.size = style.em, .color = theme.ink};
    draw_label(canvas, style.vertical_label, {inner.x, inner.y - 0.5 * style.em}, name);
    draw_label(canvas, axis.label,
               {inner.x + 0.5 * (inner.width - label_width(canvas, axis.label, name)),
                inner.y + inner.height + 2.2 * style.em},
               name);
}

void draw_plot_curves(const Canvas& canvas, const Rectangle& area, const Theme& theme,
                      const PlotStyle& style, std::span<const Curve> curves, double now) {
    cairo_t* cairo = canvas.cairo();
    const Rectangle inner = inner_area(area, style);
    if (inner.width <= 0.0 || inner.height <= 0.0) return;
    const double line = std::max(1.0, 0.1 * style.em);
    cairo_save(cairo);
    cairo_rectangle(cairo, inner.x, inner.y, inner.width, inner.height);
    cairo_clip(cairo);
    cairo_set_line_join(cairo, CAIRO_LINE_JOIN_ROUND);
    cairo_set_line_cap(cairo, CAIRO_LINE_CAP_ROUND);
    for (const Curve& curve : curves) {
        add_curve(cairo, inner, style, curve, curve.raw, now);
        canvas.stroke(0.5 * line, mix(theme.floor, curve.color, 0.4));
    }
    for (const Curve& curve : curves) {
        add_curve(cairo, inner, style, curve, curve.smooth, now);
        canvas.stroke(1.6 * line, curve.color);
    }
    cairo_restore(cairo);
    std::vector<Tag> tags;
    for (const Curve& curve : curves) {
        const auto after = std::upper_bound(curve.time.begin(), curve.time.end(), now);
        if (after == curve.time.begin()) continue;
        const auto last = static_cast<std::size_t>(after - curve.time.begin()) - 1;
        if (std::isnan(curve.smooth[last]) || curve.time[last] < style.from) continue;
        const Vec2 p = on_page(inner, style, curve.time[last], curve.smooth[last]);
        canvas.add_circle(p, 2.4 * line);
        canvas.fill(curve.color);
        if (curve.label.empty()) continue;
        const bool left = p.x > inner.x + 0.8 * inner.width;
        tags.push_back({&curve,
                        {p.x + (left ? -0.6 : 0.6) * style.em, p.y - 0.5 * style.em},
                        left ? Align::right : Align::left});
    }
    separate(tags, inner.y + 1.0 * style.em, inner.y + inner.height - 0.2 * style.em,
             1.1 * style.em);
    for (const Tag& tag : tags)
        draw_label(canvas, tag.curve->label, tag.position,
                   {.size = 0.92 * style.em,
                    .color = tag.curve->color,
                    .align = tag.align,
                    .halo = theme.floor});
}

}  // namespace swirl
