#include "swirl/render/sheet.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "swirl/render/label.hpp"

namespace swirl {

namespace {

std::string joined(const std::vector<std::string>& parts) {
    std::string text;
    for (const std::string& part : parts) text += (text.empty() ? "" : "   ·   ") + part;
    return text;
}

std::string fixed(double value, int decimals) { return fmt::format("{:.{}f}", value, decimals); }

}  // namespace

Sheet::Sheet(const SheetSpec& spec) : spec_(spec) {
    const Canvas ruler(Size{8, 8});  // measures text only
    lay_out(ruler);
}

/// Centred over its container, or on the right if the number of turns is on the left.
void Sheet::lay_out_caption(const Canvas& canvas, const Panel& panel, const Rectangle& square,
                            double gap) {
    LabelStyle style{.size = em_, .color = spec_.style.theme.faint_ink, .align = Align::center};
    // "−12.34 turns" in bold letters takes 8.5 em.
    const double room = panel.shows_turns ? square.width - 9.0 * em_ : square.width + 0.8 * gap;
    style.size = fitting_size(canvas, panel.caption, style, room);
    Vec2 position{square.x + 0.5 * square.width, caption_line_};
    if (panel.shows_turns) {
        style.align = Align::right;
        position.x = square.x + square.width;
    }
    texts_.push_back({panel.caption, position, style});
}

double Sheet::caption_height() const {
    const bool captions = std::any_of(spec_.panels.begin(), spec_.panels.end(),
                                      [](const Panel& p) { return !p.caption.empty(); });
    return captions && em_ >= min_font_size ? 1.7 * em_ : 0.0;
}

void Sheet::lay_out_panels(const Canvas& canvas, const Rectangle& area, double side, double gap) {
    const auto count = static_cast<double>(spec_.panels.size());
    double x = area.x + 0.5 * (area.width - count * side - (count - 1.0) * gap);
    const double caption = caption_height();
    const double y = area.y + 0.5 * (area.height - side - caption) + caption;
    caption_line_ = y - 0.55 * em_;
    for (const Panel& panel : spec_.panels) {
        const Rectangle square{x, y, side, side};
        views_.push_back(fitting_view(square, panel.frame, panel.container_radius, panel.amplitude,
                                      panel.shows_turns ? 0.1 : 0.0));
        if (caption > 0.0) lay_out_caption(canvas, panel, square, gap);
        x += side + gap;
    }
    // One scale for all, so that containers can be compared by eye.
    for (const View& view : views_) scale_ = std::min(scale_, view.pixels_per_unit);
    for (View& view : views_) view.pixels_per_unit = scale_;
}

void Sheet::lay_out(const Canvas& canvas) {
    const double width = spec_.size.width, height = spec_.size.height;
    const double shorter = std::min(width, height);
    margin_ = 0.026 * shorter;
    // Small pages have relatively larger letters, as long as they leave space for the container.
    em_ = std::max(0.0235 * shorter, std::min(11.0, 0.038 * shorter));
    // Letters follow the width of the page: a page that is shown in a column has that width.
    em_ = std::max(em_, std::min(0.0235 * 9.0 / 16.0 * width, 0.038 * height));
    if (spec_.has_large_captions) em_ = std::max(em_, std::min(width / 40.0, 0.08 * height));
    const auto count = static_cast<double>(spec_.panels.size());
    const double side = height - 2.0 * margin_;
    const double left_over = width - count * side - (count + 2.0) * margin_;
    const bool has_text =
        em_ >= min_font_size && (!spec_.title.empty() || !spec_.parameters.empty() || spec_.plot);
    if (!has_text || left_over <= 0.36 * height) return lay_out_bands(canvas);
    const double panel = side - caption_height();
    const double panels = count * panel + (count - 1.0) * margin_;
    const double column = std::min(width - panels - 4.0 * margin_, column_width(canvas));
    const double total = panels + 2.0 * margin_ + column;
    const double x = 0.5 * (width - total);
    lay_out_panels(canvas, {x, margin_, panels, side}, panel, margin_);
    lay_out_column(canvas, {x + panels + 2.0 * margin_, margin_, column, side});
}

/// The width that texts, legend and plot need, at most 0.8 of the page's height.
double Sheet::column_width(const Canvas& canvas) const {
    const double height = spec_.size.height;
    double width = spec_.plot ? 0.72 * height : !legend().empty() ? 0.6 * height : 8.0 * em_;
    const LabelStyle plain{.size = 1.05 * em_, .color = spec_.style.theme.ink};
    for (const std::string& parameter : spec_.parameters)
        width = std::max(width, label_width(canvas, parameter, plain));
    const LabelStyle title{.size = 1.9 * em_, .color = spec_.style.theme.ink, .bold = true};
    width = std::max(width, label_width(canvas, spec_.title, title));
    return std::min(width, 0.8 * height);
}

void Sheet::lay_out_column(const Canvas& canvas, const Rectangle& column) {
    const Theme& theme = spec_.style.theme;
    double y = column.y + 0.06 * column.height;
    if (!spec_.title.empty()) {
        LabelStyle style{.size = 1.9 * em_, .color = theme.ink, .bold = true};
        style.size = fitting_size(canvas, spec_.title, style, column.width);
        texts_.push_back({spec_.title, {column.x, y + style.size}, style});
        y += 1.1 * style.size + 1.3 * em_;
    }
    for (const std::string& parameter : spec_.parameters) {
        LabelStyle style{.size = 1.05 * em_, .color = theme.faint_ink};
        style.size = fitting_size(canvas, parameter, style, column.width);
        y += 1.75 * em_;
        texts_.push_back({parameter, {column.x, y}, style});
    }
    y += 1.6 * em_;
    if (!legend().empty()) {
        legend_area_ = Rectangle{column.x, y, column.width, 2.0 * em_};
        y += 3.2 * em_;
    }
    const double bottom = column.y + column.height;
    double clock = bottom - 0.5 * em_;
    if (spec_.plot && bottom - y > 8.0 * em_) {
        const double height = std::min(0.36 * column.height, bottom - y - 3.0 * em_);
        plot_area_ = Rectangle{column.x, bottom - height, column.width, height};
        spec_.plot->em = 0.9 * em_;
        clock = bottom - height - 0.9 * em_;
    }
    if (spec_.clock) clock_position_ = Vec2{column.x, clock};
}

/// True if title, captions and clock fit next to each other on one line.
bool Sheet::title_shares_line(const Canvas& canvas, double inner) const {
    const LabelStyle title{.size = 1.5 * em_, .color = spec_.style.theme.ink, .bold = true};
    const LabelStyle caption{.size = em_, .color = spec_.style.theme.ink};
    const auto count = static_cast<double>(spec_.panels.size());
    double widest = 0.0;
    for (const Panel& panel : spec_.panels) {
        if (panel.shows_turns) return false;
        widest = std::max(widest, label_width(canvas, panel.caption, caption));
    }
    // The page's height limits the width of the containers below the captions.
    const double side = std::min(0.62 * spec_.size.height, inner / count);
    const double captions = (count - 1.0) * (side + margin_) + widest;
    const double left = 0.5 * (inner - captions);
    return left > label_width(canvas, spec_.title, title) + 2.0 * em_ && left > 9.5 * em_;
}

void Sheet::lay_out_bands(const Canvas& canvas) {
    const Theme& theme = spec_.style.theme;
    const double width = spec_.size.width, height = spec_.size.height;
    const double inner = width - 2.0 * margin_;
    const bool readable = em_ >= min_font_size;
    double top = margin_, bottom = height - margin_;
    const double clock = readable && spec_.clock ? clock_width() : 0.0;
    if (readable && !spec_.title.empty()) {
        LabelStyle style{.size = 1.5 * em_, .color = theme.ink, .bold = true};
        style.size = fitting_size(canvas, spec_.title, style, inner - clock);
        texts_.push_back({spec_.title, {margin_, top + 1.3 * em_}, style});
    }
    if (readable && spec_.clock) {
        clock_position_ = Vec2{width - margin_, top + 1.15 * em_};
        clock_align_ = Align::right;
    }
    // A short title and the clock share the line of the captions, so that containers are larger.
    if ((clock > 0.0 || (readable && !spec_.title.empty())) && !title_shares_line(canvas, inner))
        top += 2.2 * em_;
    if (readable && !spec_.parameters.empty()) {
        const std::string line = joined(spec_.parameters);
        LabelStyle style{.size = 0.9 * em_, .color = theme.faint_ink, .align = Align::center};
        style.size = fitting_size(canvas, line, style, inner);
        if (style.size >= min_font_size) {
            texts_.push_back({line, {0.5 * width, bottom - 0.2 * em_}, style});
            bottom -= 1.9 * em_;
        }
    }
    if (readable && spec_.plot) {
        const double plot = std::clamp(0.17 * height, 7.0 * em_, 0.3 * height);
        const double plot_width = std::min(inner, 2.2 * height);
        plot_area_ = Rectangle{0.5 * (width - plot_width), bottom - plot, plot_width, plot};
        spec_.plot->em = 0.85 * em_;
        bottom -= plot + 0.1 * em_;
    }
    if (readable && !legend().empty()) {
        legend_area_ = Rectangle{margin_, bottom - 1.5 * em_, inner, 1.5 * em_};
        bottom -= 2.1 * em_;
    }
    const auto count = static_cast<double>(spec_.panels.size());
    const double side = std::max(
        1.0, std::min(bottom - top - caption_height(), (inner - (count - 1.0) * margin_) / count));
    const double spare = inner - count * side;
    lay_out_panels(canvas, {margin_, top, inner, bottom - top}, side,
                   count > 1.0 ? std::min(spare / (count - 1.0), 3.0 * margin_) : 0.0);
}

std::vector<Sheet::LegendEntry> Sheet::legend() const {
    using Kind = LegendEntry::Kind;
    const SceneStyle& style = spec_.style;
    const Theme& theme = style.theme;
    std::vector<LegendEntry> entries;
    switch (style.coloring) {
        case Coloring::pinned:
            entries = {{Kind::dot, theme.pinned, "pinned"}, {Kind::dot, theme.loose, "loose"}};
            break;
        case Coloring::spin:
            entries = {{Kind::diverging_bar, theme.neutral, "spin $ω_{i}$",
                        "−" + fixed(style.full_spin, 2), fixed(style.full_spin, 2)}};
            break;
        case Coloring::speed:
        case Coloring::slip:
            entries = {{Kind::sequential_bar, theme.ink,
                        style.coloring == Coloring::speed ? "speed" : "slip on the floor", "0",
                        fixed(style.full_speed, 1)}};
            break;
        case Coloring::none:
        case Coloring::id:
        case Coloring::sector:
            break;
    }
    if (style.points)
        entries.push_back({Kind::text, theme.ink,
                           "$S$ centre of the swirl, $C$ of the container, $M$ farthest from $S$"});
    if (!style.forces) return entries;
    entries.push_back({Kind::arrow, theme.centrifugal, "centrifugal"});
    entries.push_back({Kind::arrow, theme.coriolis, "Coriolis"});
    return entries;
}

void Sheet::draw_legend(const Canvas& canvas) const {
    if (!legend_area_) return;
    using Kind = LegendEntry::Kind;
    constexpr double spacing = 1.6;  // space after an entry in font sizes
    cairo_t* cairo = canvas.cairo();
    const Theme& theme = spec_.style.theme;
    const Rectangle& area = *legend_area_;
    const double baseline = area.y + 1.05 * em_, middle = baseline - 0.34 * em_;
    const std::vector<LegendEntry> entries = legend();
    // The width of the mark before the text; a colour bar includes the numbers at its ends.
    const auto mark_width = [](const LegendEntry& entry) {
        return entry.kind == Kind::text            ? 0.0
               : entry.kind == Kind::dot           ? 1.4
               : entry.kind == Kind::arrow         ? 2.2
               : entry.kind == Kind::diverging_bar ? 14.5
                                                   : 12.0;
    };
    const LabelStyle full{.size = 0.95 * em_, .color = theme.ink};
    double width = 0.0;
    for (const LegendEntry& entry : entries)
        width += mark_width(entry) * em_ + label_width(canvas, entry.text, full) + spacing * em_;
    const double em = em_ * std::min(1.0, area.width / std::max(width, 1.0));
    const LabelStyle label{.size = 0.95 * em, .color = theme.ink};
    double x = area.x;
    const auto draw_bar = [&](const LegendEntry& entry) {
        x += draw_label(canvas, entry.low, {x, baseline}, label) + 0.5 * em;
        constexpr int steps = 64;
        const double length = 7.0 * em;
        for (int k = 0; k < steps; ++k) {
            const double u = (k + 0.5) / steps;
            // Each step reaches under the next, so that there is no visible seam.
            const double end = k + 1 < steps ? (k + 1.5) / steps : 1.0;
            cairo_rectangle(cairo, x + length * k / steps, middle - 0.4 * em,
                            length * (end - static_cast<double>(k) / steps), 0.8 * em);
            canvas.fill(entry.kind == Kind::diverging_bar ? theme.diverging(2.0 * u - 1.0)
                                                          : sequential_color(u));
        }
        x += length + 0.5 * em;
        x += draw_label(canvas, entry.high, {x, baseline}, label) + 0.9 * em;
    };
    for (const LegendEntry& entry : entries) {
        if (entry.kind == Kind::dot) {
            canvas.add_circle({x + 0.45 * em, middle}, 0.45 * em);
            canvas.fill(entry.color);
            x += mark_width(entry) * em;
        } else if (entry.kind == Kind::arrow) {
            draw_arrow(canvas, {x, middle}, {x + 1.7 * em, middle}, 0.16 * em, entry.color);
            x += mark_width(entry) * em;
        } else if (entry.kind != Kind::text) {
            draw_bar(entry);
        }
        x += draw_label(canvas, entry.text, {x, baseline}, label) + spacing * em;
    }
}

void Sheet::draw_static(const Canvas& canvas) const {
    const StyleScope scope(canvas);
    canvas.fill_page(spec_.style.theme.page);
    for (const Text& text : texts_) draw_label(canvas, text.text, text.position, text.style);
    draw_legend(canvas);
    if (plot_area_) draw_plot_frame(canvas, *plot_area_, spec_.style.theme, *spec_.plot);
}

void Sheet::draw_panel(const Canvas& canvas, std::size_t k, const SceneContent& content) const {
    draw_scene(canvas, views_[k], spec_.style, content);
    const Panel& panel = spec_.panels[k];
    // Without captions there is no line for the number, and the arc is enough.
    if (!content.turns || !panel.shows_turns || caption_height() == 0.0) return;
    // The number is on the line of the captions, which the container never reaches.
    const double reach = views_[k].pixels_per_unit * panel.container_radius;
    const double turns = content.turns_with_swirl();
    const bool turned = std::abs(turns) >= least_turns;
    const std::string sign = !turned ? "" : turns < 0.0 ? "−" : "+";
    const std::string number = sign + fixed(std::abs(turns), 2) + " turns";
    const Theme& theme = spec_.style.theme;
    const Vec2 left{views_[k].centre.x - 1.24 * reach, caption_line_};
    const double width =
        draw_label(canvas, number, left,
                   {.size = 1.1 * em_,
                    .color = turned ? theme.direction(turns > 0.0) : theme.faint_ink,
                    .bold = true,
                    .even_digits = true});
    if (!spec_.turns_since) return;
    LabelStyle style{.size = em_, .color = theme.faint_ink};
    const std::string since = fmt::format(" since period {:g}", *spec_.turns_since);
    const double end = views_[k].centre.x + views_[k].half_side;
    const double room =
        end - left.x - width - 0.5 * em_ - label_width(canvas, panel.caption, style);
    style.size = fitting_size(canvas, since, style, room);
    if (style.size >= min_font_size)
        draw_label(canvas, since, {left.x + width, caption_line_}, style);
}

void Sheet::draw_frame(const Canvas& canvas, std::span<const SceneContent> contents,
                       std::span<const Curve> curves, double periods) const {
    const StyleScope scope(canvas);
    for (std::size_t k = 0; k < contents.size() && k < views_.size(); ++k)
        draw_panel(canvas, k, contents[k]);
    if (plot_area_)
        draw_plot_curves(canvas, *plot_area_, spec_.style.theme, *spec_.plot, curves, periods);
    if (clock_position_)
        draw_label(canvas, "period " + fixed(periods, spec_.clock_decimals), *clock_position_,
                   {.size = em_,
                    .color = spec_.style.theme.faint_ink,
                    .align = clock_align_,
                    .even_digits = true});
}

}  // namespace swirl
