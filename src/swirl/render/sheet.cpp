#include "swirl/render/sheet.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string_view>

#include "swirl/render/label.hpp"

namespace swirl {

namespace {

/// Type smaller than this, in pixels, cannot be read.
constexpr double smallest_type = 7.0;

std::string joined(const std::vector<std::string>& parts) {
    std::string text;
    for (const std::string& part : parts) text += (text.empty() ? "" : "   ·   ") + part;
    return text;
}

std::string fixed(double value, int decimals) {
    char text[64];
    std::snprintf(text, sizeof text, "%.*f", decimals, value);
    return text;
}

}  // namespace

Sheet::Sheet(const SheetSpec& spec) : spec_(spec) {
    const Canvas ruler(Size{8, 8});
    lay_out(ruler);
}

/// In the middle over its dish; on the right where the number of turns stands on the left.
void Sheet::lay_out_caption(const Canvas& canvas, const Panel& panel, const Rectangle& square,
                            double gap) {
    LabelStyle style{.size = type_, .color = spec_.style.theme.faint_ink, .align = Align::center};
    const double number = panel.turned ? 7.0 * type_ : 0.0;
    style.size = fitting_size(canvas, panel.caption, style, square.width + 0.8 * gap - number);
    Vec2 place{square.x + 0.5 * square.width, number_line_};
    if (panel.turned) {
        style.align = Align::right;
        place.x = square.x + square.width;
        // The clock may stand on the same line.
        if (clock_place_ && clock_align_ == Align::right)
            place.x = std::min(place.x, clock_place_->x - clock_width());
    }
    texts_.push_back({panel.caption, place, style});
}

void Sheet::lay_out_panels(const Canvas& canvas, const Rectangle& area, double side, double gap) {
    const auto count = static_cast<double>(spec_.panels.size());
    double x = area.x + 0.5 * (area.width - count * side - (count - 1.0) * gap);
    const bool captions = std::any_of(spec_.panels.begin(), spec_.panels.end(),
                                      [](const Panel& p) { return !p.caption.empty(); });
    const double caption = captions && type_ >= smallest_type ? 1.7 * type_ : 0.0;
    const double y = area.y + 0.5 * (area.height - side - caption) + caption;
    number_line_ = y - 0.55 * type_;
    for (const Panel& panel : spec_.panels) {
        const Rectangle square{x, y, side, side};
        views_.push_back(fitting_view(square, panel.frame, panel.container_radius, panel.amplitude,
                                      panel.turned ? 0.1 : 0.0));
        if (caption > 0.0) lay_out_caption(canvas, panel, {x, y, side, side}, gap);
        x += side + gap;
    }
    // One scale for all, so that dishes can be compared by eye.
    for (const View& view : views_) scale_ = std::min(scale_, view.pixels_per_unit);
    for (View& view : views_) view.pixels_per_unit = scale_;
}

double Sheet::legend_height() const {
    return spec_.style.coloring == Coloring::pinned || spec_.style.forces ||
                   spec_.style.coloring == Coloring::spin ||
                   spec_.style.coloring == Coloring::speed || spec_.style.coloring == Coloring::slip
               ? 2.0 * type_
               : 0.0;
}

void Sheet::lay_out(const Canvas& canvas) {
    const double width = spec_.size.width, height = spec_.size.height;
    const double shorter = std::min(width, height);
    margin_ = 0.026 * shorter;
    // Small pictures have larger letters in proportion, as long as they leave room for the dish.
    type_ = std::max(0.0235 * shorter, std::min(11.0, 0.038 * shorter));
    const auto count = static_cast<double>(spec_.panels.size());
    const double side = height - 2.0 * margin_;
    const double left_over = width - count * side - (count + 2.0) * margin_;
    const bool has_text =
        type_ >= smallest_type && (!spec_.title.empty() || !spec_.parameters.empty() || spec_.plot);
    if (has_text && left_over > 0.36 * height) {
        const bool captions = std::any_of(spec_.panels.begin(), spec_.panels.end(),
                                          [](const Panel& p) { return !p.caption.empty(); });
        const double panel = side - (captions ? 1.7 * type_ : 0.0);
        const double panels = count * panel + (count - 1.0) * margin_;
        const double column = std::min(width - panels - 4.0 * margin_, column_width(canvas));
        const double total = panels + 2.0 * margin_ + column;
        const double x = 0.5 * (width - total);
        lay_out_panels(canvas, {x, margin_, panels, side}, panel, margin_);
        lay_out_column(canvas, {x + panels + 2.0 * margin_, margin_, column, side});
        return;
    }
    lay_out_bands(canvas);
}

/// As wide as its texts need, and the plot likes.
double Sheet::column_width(const Canvas& canvas) const {
    const double height = spec_.size.height;
    double width = spec_.plot ? 0.72 * height : legend_height() > 0.0 ? 0.6 * height : 8.0 * type_;
    const LabelStyle plain{.size = 1.05 * type_, .color = spec_.style.theme.ink};
    for (const std::string& parameter : spec_.parameters)
        width = std::max(width, label_width(canvas, parameter, plain));
    const LabelStyle title{.size = 1.9 * type_, .color = spec_.style.theme.ink, .bold = true};
    width = std::max(width, label_width(canvas, spec_.title, title));
    return std::min(width, 0.8 * height);
}

void Sheet::lay_out_column(const Canvas& canvas, const Rectangle& column) {
    const Theme& theme = spec_.style.theme;
    double y = column.y + 0.06 * column.height;
    if (!spec_.title.empty()) {
        LabelStyle style{.size = 1.9 * type_, .color = theme.ink, .bold = true};
        style.size = fitting_size(canvas, spec_.title, style, column.width);
        texts_.push_back({spec_.title, {column.x, y + style.size}, style});
        y += 1.1 * style.size + 1.3 * type_;
    }
    for (const std::string& parameter : spec_.parameters) {
        LabelStyle style{.size = 1.05 * type_, .color = theme.faint_ink};
        style.size = fitting_size(canvas, parameter, style, column.width);
        y += 1.75 * type_;
        texts_.push_back({parameter, {column.x, y}, style});
    }
    y += 1.6 * type_;
    if (legend_height() > 0.0) {
        legend_area_ = Rectangle{column.x, y, column.width, 2.0 * type_};
        y += 3.2 * type_;
    }
    const double bottom = column.y + column.height;
    if (spec_.plot && bottom - y > 8.0 * type_) {
        const double height = std::min(0.36 * column.height, bottom - y - 3.0 * type_);
        plot_area_ = Rectangle{column.x, bottom - height, column.width, height};
        spec_.plot->type = 0.9 * type_;
        if (spec_.clock) clock_place_ = Vec2{column.x, bottom - height - 0.9 * type_};
        return;
    }
    if (spec_.clock) clock_place_ = Vec2{column.x, bottom - 0.5 * type_};
}

/// Whether headline, captions and clock have room beside each other.
bool Sheet::title_shares_line(const Canvas& canvas, double inner) const {
    const LabelStyle title{.size = 1.5 * type_, .color = spec_.style.theme.ink, .bold = true};
    const LabelStyle caption{.size = type_, .color = spec_.style.theme.ink};
    const auto count = static_cast<double>(spec_.panels.size());
    double widest = 0.0;
    for (const Panel& panel : spec_.panels) {
        if (panel.turned) return false;
        widest = std::max(widest, label_width(canvas, panel.caption, caption));
    }
    // The captions stand over dishes that are no wider than the height of the page allows.
    const double side = std::min(0.62 * spec_.size.height, inner / count);
    const double captions = (count - 1.0) * (side + margin_) + widest;
    const double left = 0.5 * (inner - captions);
    return left > label_width(canvas, spec_.title, title) + 2.0 * type_ && left > 9.5 * type_;
}

void Sheet::lay_out_bands(const Canvas& canvas) {
    const Theme& theme = spec_.style.theme;
    const double width = spec_.size.width, height = spec_.size.height;
    const double inner = width - 2.0 * margin_;
    const bool readable = type_ >= smallest_type;
    double top = margin_, bottom = height - margin_;
    const double clock = readable && spec_.clock ? clock_width() : 0.0;
    const bool shared = title_shares_line(canvas, inner);
    if (readable && (!spec_.title.empty() || spec_.clock)) {
        if (!spec_.title.empty()) {
            LabelStyle style{.size = 1.5 * type_, .color = theme.ink, .bold = true};
            style.size = fitting_size(canvas, spec_.title, style, inner - clock);
            texts_.push_back({spec_.title, {margin_, top + 1.3 * type_}, style});
        }
        if (spec_.clock) {
            clock_place_ = Vec2{width - margin_, top + 1.15 * type_};
            clock_align_ = Align::right;
        }
        // A short headline and the clock share the line of the captions; so the dish is larger.
        top += spec_.title.empty() || shared ? 0.0 : 2.2 * type_;
    }
    if (readable && !spec_.parameters.empty()) {
        const std::string line = joined(spec_.parameters);
        LabelStyle style{.size = 0.9 * type_, .color = theme.faint_ink, .align = Align::center};
        style.size = fitting_size(canvas, line, style, inner);
        if (style.size >= smallest_type) {
            texts_.push_back({line, {0.5 * width, bottom - 0.2 * type_}, style});
            bottom -= 1.9 * type_;
        }
    }
    if (readable && spec_.plot) {
        const double plot = std::clamp(0.17 * height, 7.0 * type_, 0.3 * height);
        const double plot_width = std::min(inner, 2.2 * height);
        plot_area_ = Rectangle{0.5 * (width - plot_width), bottom - plot, plot_width, plot};
        spec_.plot->type = 0.85 * type_;
        bottom -= plot + 0.1 * type_;
    }
    if (readable && legend_height() > 0.0) {
        legend_area_ = Rectangle{margin_, bottom - 1.5 * type_, inner, 1.5 * type_};
        bottom -= 2.1 * type_;
    }
    const auto count = static_cast<double>(spec_.panels.size());
    const bool captions = std::any_of(spec_.panels.begin(), spec_.panels.end(),
                                      [](const Panel& p) { return !p.caption.empty(); });
    const double caption = captions && readable ? 1.7 * type_ : 0.0;
    const double side =
        std::max(1.0, std::min(bottom - top - caption, (inner - (count - 1.0) * margin_) / count));
    const double spare = inner - count * side;
    lay_out_panels(canvas, {margin_, top, inner, bottom - top}, side,
                   count > 1.0 ? std::min(spare / (count - 1.0), 3.0 * margin_) : 0.0);
}

/// Of all that the legend holds, before it is made to fit.
double Sheet::legend_width(const Canvas& canvas, const LabelStyle& label) const {
    double width = 0.0;
    const auto add = [&](double mark, std::string_view text) {
        width += mark * type_ + label_width(canvas, text, label) + 1.6 * type_;
    };
    switch (spec_.style.coloring) {
        case Coloring::pinned:
            add(1.4, "pinned");
            add(1.4, "loose");
            break;
        case Coloring::spin:
            add(14.5, "spin $ω_{i}$");
            break;
        case Coloring::speed:
            add(12.0, "speed");
            break;
        case Coloring::slip:
            add(12.0, "slip on the floor");
            break;
        default:
            break;
    }
    if (!spec_.style.forces) return width;
    add(2.2, "centrifugal");
    add(2.2, "Coriolis");
    return width;
}

void Sheet::draw_legend(const Canvas& canvas) const {
    if (!legend_area_) return;
    cairo_t* cairo = canvas.cairo();
    const SceneStyle& style = spec_.style;
    const Theme& theme = style.theme;
    const Rectangle& area = *legend_area_;
    const double baseline = area.y + 1.05 * type_, middle = baseline - 0.34 * type_;
    const LabelStyle full{.size = 0.95 * type_, .color = theme.ink};
    const double type =
        type_ * std::min(1.0, area.width / std::max(legend_width(canvas, full), 1.0));
    const LabelStyle label{.size = 0.95 * type, .color = theme.ink};
    double x = area.x;
    const auto spot = [&](const Color& color, std::string_view text) {
        cairo_new_sub_path(cairo);
        cairo_arc(cairo, x + 0.45 * type, middle, 0.45 * type, 0.0, 2.0 * pi);
        canvas.set(color);
        cairo_fill(cairo);
        x += 1.4 * type;
        x += draw_label(canvas, text, {x, baseline}, label) + 1.6 * type;
    };
    const auto arrow = [&](const Color& color, std::string_view text) {
        draw_arrow(canvas, {x, middle}, {x + 1.7 * type, middle}, 0.16 * type, color);
        x += 2.2 * type;
        x += draw_label(canvas, text, {x, baseline}, label) + 1.6 * type;
    };
    const auto bar = [&](bool diverging, std::string_view low, std::string_view high,
                         std::string_view text) {
        x += draw_label(canvas, low, {x, baseline}, label) + 0.5 * type;
        constexpr int steps = 64;
        const double length = 7.0 * type;
        for (int k = 0; k < steps; ++k) {
            const double u = (k + 0.5) / steps;
            canvas.set(diverging ? diverging_color(2.0 * u - 1.0, theme.neutral)
                                 : sequential_color(u));
            // Each step reaches under the next, so no seam shows between them.
            const double end = k + 1 < steps ? (k + 1.5) / steps : 1.0;
            cairo_rectangle(cairo, x + length * k / steps, middle - 0.4 * type,
                            length * (end - static_cast<double>(k) / steps), 0.8 * type);
            cairo_fill(cairo);
        }
        x += length + 0.5 * type;
        x += draw_label(canvas, high, {x, baseline}, label) + 0.9 * type;
        x += draw_label(canvas, text, {x, baseline}, label) + 1.6 * type;
    };
    switch (style.coloring) {
        case Coloring::pinned:
            spot(theme.pinned, "pinned");
            spot(theme.loose, "loose");
            break;
        case Coloring::spin:
            bar(true, "−" + fixed(style.full_spin, 2), fixed(style.full_spin, 2), "spin $ω_{i}$");
            break;
        case Coloring::speed:
            bar(false, "0", fixed(style.full_speed, 1), "speed");
            break;
        case Coloring::slip:
            bar(false, "0", fixed(style.full_speed, 1), "slip on the floor");
            break;
        default:
            break;
    }
    if (!style.forces) return;
    arrow(theme.centrifugal, "centrifugal");
    arrow(theme.coriolis, "Coriolis");
}

void Sheet::draw_still(const Canvas& canvas) const {
    const StyleScope scope(canvas);
    canvas.fill_page(spec_.style.theme.page);
    for (const Text& text : texts_) draw_label(canvas, text.text, text.place, text.style);
    draw_legend(canvas);
    if (plot_area_) draw_plot_frame(canvas, *plot_area_, spec_.style.theme, *spec_.plot);
}

void Sheet::draw_panel(const Canvas& canvas, std::size_t k, const SceneContent& content) const {
    draw_scene(canvas, views_[k], spec_.style, content);
    const Panel& panel = spec_.panels[k];
    if (!content.turned || !panel.turned || type_ < smallest_type) return;
    // On the line of the captions, where the dish never comes.
    const double reach = views_[k].pixels_per_unit * panel.container_radius;
    const std::string number =
        (*content.turned < 0.0 ? "−" : "+") + fixed(std::abs(*content.turned), 2) + " turns";
    const Theme& theme = spec_.style.theme;
    draw_label(canvas, number, {views_[k].centre.x - 1.24 * reach, number_line_},
               {.size = 1.1 * type_,
                .color = *content.turned < 0.0 ? theme.pinned : theme.loose,
                .bold = true,
                .even_digits = true});
}

void Sheet::draw_moving(const Canvas& canvas, std::span<const SceneContent> contents,
                        std::span<const Curve> curves, double periods) const {
    const StyleScope scope(canvas);
    for (std::size_t k = 0; k < contents.size() && k < views_.size(); ++k)
        draw_panel(canvas, k, contents[k]);
    if (plot_area_)
        draw_plot_curves(canvas, *plot_area_, spec_.style.theme, *spec_.plot, curves, periods);
    if (clock_place_)
        draw_label(canvas, "swirl " + fixed(periods, spec_.clock_decimals), *clock_place_,
                   {.size = type_,
                    .color = spec_.style.theme.faint_ink,
                    .align = clock_align_,
                    .even_digits = true});
}

}  // namespace swirl
