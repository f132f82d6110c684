#include "swirl/render/scene.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "swirl/render/ball.hpp"
#include "swirl/render/label.hpp"

namespace swirl {

namespace {

constexpr Vec2 unknown_position{std::numeric_limits<double>::quiet_NaN(),
                                std::numeric_limits<double>::quiet_NaN()};
constexpr Color black = color_from_hex(0x000000), white = color_from_hex(0xFFFFFF);

/// Below these radii, in pixels, marks and outlines would only be noise.
constexpr double min_marked_radius = 3.5;
constexpr double min_outlined_radius = 2.5;
/// Length of a disc's orientation mark, in units of its radius.
constexpr double mark_length = 0.74;

/// The container's radius in pixels. Line widths and letters scale with it.
double radius_on_page(const View& view, const Snapshot& now) {
    return view.pixels_per_unit * now.container_radius;
}

double length_of(const Vec2& v) { return std::sqrt(dot(v, v)); }

std::size_t id_of(const SceneContent& content, std::size_t i) {
    return content.ids.size() == content.now.size() ? static_cast<std::size_t>(content.ids[i]) : i;
}

Color disc_color(const SceneStyle& style, const SceneContent& content, const FrameTransform& frame,
                 std::size_t i) {
    const Theme& theme = style.theme;
    const Snapshot& now = content.now;
    switch (style.coloring) {
        case Coloring::sector:
            if (content.sectors.size() != now.size()) return theme.disc;
            return sector_colors[content.sectors[i] % sector_colors.size()];
        case Coloring::pinned:
            if (content.pinned.size() != now.size()) return theme.disc;
            return content.pinned[i] ? theme.pinned : theme.loose;
        case Coloring::spin:
            if (std::isnan(now.spin[i])) return theme.disc;
            return theme.diverging(now.spin[i] / style.full_spin);
        case Coloring::speed:
            return sequential_color(length_of(frame.velocity(now.position(i), now.velocity(i))) /
                                    style.full_speed);
        case Coloring::slip:
            if (!now.are_spheres()) return theme.disc;
            return sequential_color(length_of(slip_on_floor(now.disc(i), now.container_velocity)) /
                                    style.full_speed);
        case Coloring::id:
            return distinct_colors[id_of(content, i) % distinct_colors.size()];
        case Coloring::none:
            break;
    }
    return theme.disc;
}

/// A disc in its colour with a darker rim, and a mark from its centre that shows its orientation.
void draw_disc(const Canvas& canvas, const Vec2& centre, double radius, const Color& color,
               double orientation) {
    canvas.add_circle(centre, radius);
    if (radius < min_outlined_radius) return canvas.fill(color);
    canvas.fill(mix(color, black, 0.45));
    canvas.add_circle(centre, radius - std::max(0.7, 0.055 * radius));
    canvas.fill(color);
    if (radius < min_marked_radius || std::isnan(orientation)) return;

    // The mark is dark on a light disc and light on a dark disc.
    const bool is_light = brightness(color) > 0.42;
    const Color mark =
        is_light ? mix(color, color_from_hex(0x0B0F14), 0.82) : mix(color, white, 0.85);
    const Vec2 direction{std::cos(orientation), -std::sin(orientation)};
    const double reach = mark_length * radius;
    cairo_set_line_cap(canvas.cairo(), CAIRO_LINE_CAP_ROUND);
    canvas.add_line(centre, {centre.x + reach * direction.x, centre.y + reach * direction.y});
    canvas.stroke(std::max(1.0, 0.17 * radius), mark);
}

/// A ring and an orientation mark, with a dark edge so that they are visible on any image.
void outline_disc(const Canvas& canvas, const Vec2& centre, double radius, const Color& color,
                  double orientation) {
    const double width = std::max(1.2, 0.11 * radius);
    for (const bool shade : {true, false}) {
        canvas.add_circle(centre, radius);
        if (radius >= min_marked_radius && !std::isnan(orientation))
            canvas.add_line(centre, {centre.x + mark_length * radius * std::cos(orientation),
                                     centre.y - mark_length * radius * std::sin(orientation)});
        cairo_set_line_cap(canvas.cairo(), CAIRO_LINE_CAP_ROUND);
        canvas.stroke(shade ? 1.9 * width : width, shade ? black : color, shade ? 0.4 : 1.0);
    }
}

/// The wall over a camera image, as a thin line.
void outline_container(const Canvas& canvas, const View& view, const Snapshot& now) {
    const Vec2 c = view.on_page(FrameTransform(now, view.frame).position(now.container_centre));
    const double radius = radius_on_page(view, now);
    for (const bool shade : {true, false}) {
        canvas.add_circle(c, radius);
        canvas.stroke(std::max(1.0, 0.006 * radius) * (shade ? 3.0 : 1.0), shade ? black : white,
                      shade ? 0.35 : 0.9);
    }
}

void draw_backdrop(const Canvas& canvas, const View& view, const SceneContent& content) {
    const Backdrop& backdrop = *content.backdrop;
    const FrameTransform frame(content.now, view.frame);
    const auto on_page = [&](double x, double y) {
        return view.on_page(
            frame.position(backdrop.origin + x * backdrop.along_x + y * backdrop.along_y));
    };
    // cairo counts from the corner of the first pixel, cameras from its centre.
    const Vec2 corner = on_page(-0.5, -0.5);
    const Vec2 right = on_page(0.5, -0.5) - corner, down = on_page(-0.5, 0.5) - corner;
    cairo_t* cairo = canvas.cairo();
    const StyleScope scope(canvas);
    const double half = view.half_side;
    if (half > 0.0) {
        if (view.frame == Frame::lab)
            cairo_rectangle(cairo, view.centre.x - half, view.centre.y - half, 2.0 * half,
                            2.0 * half);
        else
            canvas.add_circle(view.centre, half);
        cairo_clip(cairo);
    }
    const cairo_matrix_t matrix{right.x, right.y, down.x, down.y, corner.x, corner.y};
    cairo_transform(cairo, &matrix);
    cairo_set_source_surface(cairo, backdrop.image->surface(), 0.0, 0.0);
    // A strongly reduced image must be averaged. Otherwise the bilinear filter is faster and as
    // good.
    constexpr double strongly_reduced = 0.6;
    cairo_pattern_set_filter(cairo_get_source(cairo), length_of(right) < strongly_reduced
                                                          ? CAIRO_FILTER_GOOD
                                                          : CAIRO_FILTER_BILINEAR);
    cairo_paint(cairo);
}

/// Positions of all discs on the page at each instant that trails pass through, oldest first. A
/// disc that did not exist yet has an unknown position.
std::vector<std::vector<Vec2>> trail_positions(const View& view, const SceneContent& content) {
    const std::size_t count = content.now.size();
    std::vector<std::vector<Vec2>> positions;
    for (std::size_t k = 0; k <= content.past.size(); ++k) {
        const bool is_now = k == content.past.size();
        const Snapshot& then = is_now ? content.now : *content.past[k];
        const bool has_ids = !is_now && content.past_ids.size() == content.past.size();
        if (!has_ids && then.size() != count) continue;
        const FrameTransform frame(then, view.frame);
        std::vector<Vec2>& row = positions.emplace_back(count, unknown_position);
        for (std::size_t i = 0; i < count; ++i) {
            std::size_t j = i;
            if (has_ids) {
                const auto& ids = content.past_ids[k];
                const auto found = std::lower_bound(ids.begin(), ids.end(), content.ids[i]);
                if (found == ids.end() || *found != content.ids[i]) continue;
                j = static_cast<std::size_t>(found - ids.begin());
            }
            row[i] = view.on_page(frame.position(then.position(j)));
        }
    }
    return positions;
}

void draw_trails(const Canvas& canvas, const View& view, const SceneStyle& style,
                 const SceneContent& content) {
    if (content.past.empty()) return;
    cairo_t* cairo = canvas.cairo();
    const std::size_t count = content.now.size();
    const std::vector<std::vector<Vec2>> positions = trail_positions(view, content);
    if (positions.size() < 2) return;
    // A trail consists of a few bands of one opacity each. Discs of one colour share a path:
    // drawing segment by segment would take longer than everything else.
    constexpr std::size_t bands = 8;
    const FrameTransform frame(content.now, view.frame);
    const std::size_t segments = positions.size() - 1;
    const double radius = count > 0 ? view.pixels_per_unit * content.now.radius[0] : 1.0;
    // Round ends would show through each other where trails are transparent.
    cairo_set_line_cap(cairo, content.backdrop ? CAIRO_LINE_CAP_BUTT : CAIRO_LINE_CAP_ROUND);
    cairo_set_line_join(cairo, CAIRO_LINE_JOIN_ROUND);
    for (std::size_t band = 0; band < bands; ++band) {
        const std::size_t from = segments * band / bands, to = segments * (band + 1) / bands;
        if (from == to) continue;
        const double age = (static_cast<double>(band) + 1.0) / bands;
        const double width = std::max(1.0, (0.05 + 0.14 * age) * radius);
        const double strength = 0.12 + 0.6 * age;
        for (std::size_t i = 0; i < count; ++i) {
            cairo_new_sub_path(cairo);
            for (std::size_t k = from; k <= to; ++k)
                if (!std::isnan(positions[k][i].x))
                    cairo_line_to(cairo, positions[k][i].x, positions[k][i].y);
            if (style.coloring == Coloring::none && i + 1 < count) continue;
            const Color color = disc_color(style, content, frame, i);
            if (content.backdrop)
                canvas.stroke(width, color, strength);
            else
                canvas.stroke(width, mix(style.theme.floor, color, strength));
        }
    }
}

void draw_discs(const Canvas& canvas, const View& view, const SceneStyle& style,
                const SceneContent& content) {
    const Snapshot& now = content.now;
    const FrameTransform frame(now, view.frame);
    const bool balls =
        style.orientation && now.are_balls() && !now.turned.empty() && !content.backdrop;
    const Quaternion frame_turn = turn_by(0.0, 0.0, frame.orientation(0.0));
    for (std::size_t i = 0; i < now.size(); ++i) {
        const double radius = view.pixels_per_unit * now.radius[i];
        const Vec2 centre = view.on_page(frame.position(now.position(i)));
        const Color color = disc_color(style, content, frame, i);
        if (balls && radius >= min_marked_radius) {
            draw_ball(canvas, centre, radius, color, frame_turn * now.quaternion(i));
            continue;
        }
        const double orientation =
            style.orientation ? frame.orientation(now.orientation(i)) : std::nan("");
        (content.backdrop ? outline_disc : draw_disc)(canvas, centre, radius, color, orientation);
    }
}

void draw_ghosts(const Canvas& canvas, const View& view, const SceneStyle& style,
                 const SceneContent& content) {
    const Snapshot& now = content.now;
    for (std::size_t k = 0; k < content.ghosts.size(); ++k) {
        const Snapshot& then = *content.ghosts[k];
        const FrameTransform frame(then, view.frame);
        const double age = double(k + 1) / double(content.ghosts.size() + 1);
        // In the lab frame the container was elsewhere, too.
        if (view.frame == Frame::lab) {
            const double wall = radius_on_page(view, then);
            canvas.add_circle(view.on_page(then.container_centre), wall);
            canvas.stroke(std::max(0.7, 0.012 * wall), style.theme.wall, 0.1 + 0.3 * age);
        }
        for (std::size_t i = 0; i < then.size(); ++i) {
            const Color color =
                then.size() == now.size() ? disc_color(style, content, frame, i) : style.theme.disc;
            const double radius = view.pixels_per_unit * then.radius[i];
            canvas.add_circle(view.on_page(frame.position(then.position(i))), 0.94 * radius);
            canvas.fill(color, 0.05 + 0.2 * age, Canvas::Path::keep);
            canvas.stroke(std::max(0.7, 0.045 * radius), color, 0.15 + 0.5 * age);
        }
    }
}

void draw_slice(const Canvas& canvas, const View& view, const SceneStyle& style,
                const Snapshot& now) {
    if (!style.slice || view.frame != Frame::m) return;
    constexpr double half_width = pi / 18.0;  // 10°
    cairo_t* cairo = canvas.cairo();
    cairo_move_to(cairo, view.centre.x, view.centre.y);
    // y points down on the page, so angles change their sign.
    cairo_arc(cairo, view.centre.x, view.centre.y, radius_on_page(view, now),
              -*style.slice - half_width, -*style.slice + half_width);
    cairo_close_path(cairo);
    canvas.fill(distinct_colors[2], 0.35);
}

void draw_angles(const Canvas& canvas, const View& view, const SceneStyle& style,
                 const Snapshot& now) {
    if (!style.angles || view.frame != Frame::m) return;
    // Relatively larger letters in a small drawing, so that they stay legible.
    const double unit = radius_on_page(view, now);
    const double size = std::max(0.055 * unit, std::min(9.5, 0.09 * unit));
    if (size < min_font_size) return;
    const LabelStyle label{.size = size, .color = style.theme.ink, .align = Align::center};
    const double wall = (1.0 + wall_thickness) * unit + 0.9 * size;
    for (int k = 0; k < 8; ++k) {
        const double theta = k * pi / 4.0;
        const Vec2 u{std::cos(theta), -std::sin(theta)};
        const double reach = wall + 0.5 * size * std::abs(u.x);
        if (k == 6 && style.points) continue;  // the letter M is at the bottom
        draw_label(canvas, std::to_string(45 * k) + "°",
                   {view.centre.x + reach * u.x, view.centre.y + reach * u.y + 0.35 * size}, label);
    }
}

/// The centrifugal force Ω² (p − S) and the Coriolis force −2Ω ẑ × v on each disc, per unit of
/// mass.
void draw_forces(const Canvas& canvas, const View& view, const SceneStyle& style,
                 const Snapshot& now) {
    if (view.frame != Frame::m || now.size() == 0 || !(now.period > 0.0)) return;
    const FrameTransform frame(now, view.frame);
    const double omega = full_turn / now.period;
    const Vec2 swirl_centre = frame.position({0.0, 0.0});
    // Both forces have one scale: the largest possible centrifugal force is two radii long.
    const double largest = omega * omega * (now.container_radius + length_of(swirl_centre));
    const double scale = 2.0 * now.radius[0] * view.pixels_per_unit / largest;
    for (std::size_t i = 0; i < now.size(); ++i) {
        const Vec2 p = frame.position(now.position(i));
        const Vec2 v = frame.velocity(now.position(i), now.velocity(i));
        const Vec2 tail = view.on_page(p);
        const double width = std::max(1.0, 0.12 * view.pixels_per_unit * now.radius[i]);
        const auto draw_force = [&](const Vec2& force, const Color& color) {
            draw_arrow(canvas, tail, {tail.x + scale * force.x, tail.y - scale * force.y}, width,
                       color, style.theme.floor);
        };
        draw_force((omega * omega) * (p - swirl_centre), style.theme.centrifugal);
        draw_force((-2.0 * omega) * perpendicular(v), style.theme.coriolis);
    }
}

void draw_path(const Canvas& canvas, const View& view, const Theme& theme,
               std::span<const Vec2> path, double line) {
    cairo_t* cairo = canvas.cairo();
    for (const Vec2& vertex : path) {
        const Vec2 p = view.on_page(vertex);
        cairo_line_to(cairo, p.x, p.y);
    }
    cairo_close_path(cairo);
    canvas.stroke(2.6 * line, theme.floor, 0.75, Canvas::Path::keep);
    canvas.stroke(1.1 * line, theme.ink, 0.9);
}

/// S as a cross and C as a dot.
void draw_centres(const Canvas& canvas, const Theme& theme, const Vec2& s, const Vec2& c,
                  double unit, double line) {
    const double arm = 0.022 * unit;
    for (const bool shade : {true, false}) {
        cairo_set_line_cap(canvas.cairo(), CAIRO_LINE_CAP_ROUND);
        canvas.add_line({s.x - arm, s.y}, {s.x + arm, s.y});
        canvas.add_line({s.x, s.y - arm}, {s.x, s.y + arm});
        canvas.stroke((shade ? 4.2 : 2.0) * line, shade ? theme.floor : theme.ink);
    }
    canvas.add_circle(c, 0.019 * unit + line);
    canvas.fill(theme.floor);
    canvas.add_circle(c, 0.019 * unit);
    canvas.fill(theme.ink);
}

/// M as a triangle that points at the wall. `letter` is null if letters would be too small.
void draw_m(const Canvas& canvas, const View& view, const SceneStyle& style,
            const SceneContent& content, const LabelStyle* letter) {
    const Snapshot& now = content.now;
    const FrameTransform frame(now, view.frame);
    const Vec2 centre = now.container_centre;
    const double unit = radius_on_page(view, now), line = std::max(0.8, 0.005 * unit);
    const Vec2 outward = (1.0 / length_of(centre)) * centre;
    const double wall = now.container_radius * (1.0 + wall_thickness);
    const Vec2 m = view.on_page(frame.position(centre + wall * outward));
    Vec2 u = frame.direction(outward);
    u.y = -u.y;
    const Vec2 side{-u.y, u.x};
    // In the lab frame the view ends where the wall reaches farthest, so M lies on the wall.
    const bool in_lab = view.frame == Frame::lab;
    const double inward = in_lab ? -wall_thickness * unit : 0.0;
    const double height = 0.038 * unit;
    const Vec2 tip{m.x + inward * u.x, m.y + inward * u.y};
    canvas.add_polygon({tip,
                        {tip.x + height * u.x + 0.6 * height * side.x,
                         tip.y + height * u.y + 0.6 * height * side.y},
                        {tip.x + height * u.x - 0.6 * height * side.x,
                         tip.y + height * u.y - 0.6 * height * side.y}});
    if (content.backdrop) canvas.stroke(3.0 * line, style.theme.floor, 0.85, Canvas::Path::keep);
    canvas.fill(style.theme.ink);
    if (!letter) return;
    LabelStyle label = *letter;
    const double size = label.size;
    if (in_lab) {
        label.align = Align::center;
        draw_label(canvas, "$M$",
                   {tip.x - 0.65 * size * u.x, tip.y - 0.65 * size * u.y + 0.34 * size}, label);
        return;
    }
    if (!content.backdrop) label.halo = std::nullopt;
    draw_label(canvas, "$M$", {tip.x + height + 0.35 * size, tip.y + 0.6 * size}, label);
}

/// The head of an arrow along an arc, at an angle on the page. `direction` is 1 for clockwise.
void draw_arc_head(const Canvas& canvas, Vec2 c, double radius, double angle, double direction,
                   double width, const Color& color) {
    const Vec2 outward{std::cos(angle), std::sin(angle)};
    const Vec2 along{-direction * outward.y, direction * outward.x};
    const Vec2 base = c + radius * outward;
    canvas.add_polygon(
        {base + 2.4 * width * along, base + 1.5 * width * outward, base - 1.5 * width * outward});
    canvas.fill(color);
}

/// An arc from the top, with a head that points along it: the fraction of the last turn. Each whole
/// turn is a ring outside the arc, up to three; the number next to it (sheet.cpp) counts all. There
/// is no arrow while that number is 0.00, because nothing has turned then.
void draw_turn_arc(const Canvas& canvas, const View& view, const SceneStyle& style,
                   const SceneContent& content) {
    if (!content.turns || view.frame != Frame::lab || std::abs(*content.turns) < least_turns)
        return;
    cairo_t* cairo = canvas.cairo();
    const double unit = radius_on_page(view, content.now), width = 0.035 * unit;
    const double radius = unit * (1.0 + wall_thickness + 0.045);
    const Vec2 c = view.on_page(content.now.container_centre);
    const double turns = *content.turns, whole = std::trunc(turns);
    const Color color = style.theme.direction(content.turns_with_swirl() >= 0.0);
    for (int ring = 0; ring < std::min(3, static_cast<int>(std::abs(whole))); ++ring) {
        canvas.add_circle(c, radius + (0.8 + 0.3 * ring) * width);
        canvas.stroke(0.15 * width, color);
    }
    const double top = -0.5 * pi, sweep = -full_turn * (turns - whole);
    cairo_set_line_cap(cairo, CAIRO_LINE_CAP_BUTT);
    cairo_new_sub_path(cairo);
    (sweep < 0.0 ? cairo_arc_negative : cairo_arc)(cairo, c.x, c.y, radius, top, top + sweep);
    canvas.stroke(width, color);
    draw_arc_head(canvas, c, radius, top + sweep, turns < 0.0 ? 1.0 : -1.0, width, color);
}

/// A circular arrow with the word "swirl" in the lower left corner, which the container never
/// reaches. It points in the direction in which the container moves around S.
void draw_swirl(const Canvas& canvas, const View& view, const SceneStyle& style,
                const Snapshot& now) {
    const double turn = cross(now.container_centre, now.container_velocity);
    if (!style.swirl || view.frame != Frame::lab || turn == 0.0 || !(view.half_side > 0.0)) return;
    const double half = view.half_side, unit = style.swirl_size * half;
    const double radius = 0.085 * unit, width = 0.02 * unit, size = 0.075 * unit;
    if (size < min_font_size) return;
    // The word stays in the corner.
    const Vec2 c{view.centre.x - 0.945 * half + radius,
                 view.centre.y + 0.951 * half - 1.15 * size - radius};
    // Three quarters around; y points down on the page.
    const double direction = turn > 0.0 ? -1.0 : 1.0, begin = 0.25 * pi - direction * 0.25 * pi;
    const double end = begin + direction * 1.5 * pi;
    cairo_t* cairo = canvas.cairo();
    cairo_set_line_cap(cairo, CAIRO_LINE_CAP_BUTT);
    cairo_new_sub_path(cairo);
    (direction > 0.0 ? cairo_arc : cairo_arc_negative)(cairo, c.x, c.y, radius, begin, end);
    canvas.stroke(width, style.theme.faint_ink);
    draw_arc_head(canvas, c, radius, end, direction, width, style.theme.faint_ink);
    draw_label(canvas, "swirl", {c.x, c.y + radius + 1.15 * size},
               {.size = size, .color = style.theme.faint_ink, .align = Align::center});
}

}  // namespace

void draw_arrow(const Canvas& canvas, Vec2 tail, Vec2 tip, double width, const Color& color,
                const std::optional<Color>& rim) {
    const Vec2 along = tip - tail;
    const double length = length_of(along), head = 3.4 * width;
    if (!(length > 0.0) || length < 0.6 * head) return;
    const Vec2 u = (1.0 / length) * along;
    const Vec2 side = width * perpendicular(u);
    const Vec2 neck = tip - std::min(head, length) * u;
    canvas.add_polygon({tail + 0.5 * side, neck + 0.5 * side, neck + 1.5 * side, tip,
                        neck - 1.5 * side, neck - 0.5 * side, tail - 0.5 * side});
    if (rim) {
        cairo_set_line_join(canvas.cairo(), CAIRO_LINE_JOIN_ROUND);
        canvas.stroke(0.7 * width, *rim, 0.8, Canvas::Path::keep);
    }
    canvas.fill(color);
}

void draw_container(const Canvas& canvas, const View& view, const SceneStyle& style,
                    const Snapshot& now) {
    const FrameTransform frame(now, view.frame);
    const Vec2 c = view.on_page(frame.position(now.container_centre));
    const double radius = radius_on_page(view, now);
    const double thickness = wall_thickness * radius;

    canvas.add_circle(c, radius + thickness);
    canvas.fill(style.theme.wall);
    // Twelve marks fixed on the wall, one of them wide. They show that the wall turns in the
    // M-frame, and that it does not in the lab.
    for (int k = 0; k < 12; ++k) {
        const double angle = frame.orientation(full_turn * k / 12.0);
        const Vec2 u{std::cos(angle), -std::sin(angle)};
        const double outer = radius + thickness;
        cairo_set_line_cap(canvas.cairo(), CAIRO_LINE_CAP_BUTT);
        canvas.add_line({c.x + radius * u.x, c.y + radius * u.y},
                        {c.x + outer * u.x, c.y + outer * u.y});
        canvas.stroke((k == 0 ? 1.5 : 0.38) * thickness,
                      k == 0 ? style.theme.accent : style.theme.wall_mark);
    }
    canvas.add_circle(c, radius);
    canvas.fill(style.theme.floor);
}

void draw_points(const Canvas& canvas, const View& view, const SceneStyle& style,
                 const SceneContent& content) {
    const Snapshot& now = content.now;
    const Theme& theme = style.theme;
    const FrameTransform frame(now, view.frame);
    const double unit = radius_on_page(view, now), line = std::max(0.8, 0.005 * unit);
    if (style.path && view.frame == Frame::lab && content.path.size() > 1)
        draw_path(canvas, view, theme, content.path, line);
    if (!style.points) return;

    // Relatively larger letters in a small drawing, as long as they do not hide the discs.
    const double size = style.point_size * std::max(0.062 * unit, std::min(13.0, 0.16 * unit));
    const bool has_letters = size >= 8.0;
    const LabelStyle label{.size = size, .color = theme.ink, .bold = true, .halo = theme.floor};
    const Vec2 s = view.on_page(frame.position({0.0, 0.0}));
    const Vec2 c = view.on_page(frame.position(now.container_centre));
    draw_centres(canvas, theme, s, c, unit, line);
    if (has_letters) {
        draw_label(canvas, "$S$", {s.x - 1.05 * size, s.y - 0.28 * size}, label);
        draw_label(canvas, "$C$", {c.x + 0.45 * size, c.y + 0.75 * size}, label);
    }
    if (length_of(now.container_centre) > 0.0)
        draw_m(canvas, view, style, content, has_letters ? &label : nullptr);
}

void draw_scene(const Canvas& canvas, const View& view, const SceneStyle& style,
                const SceneContent& content) {
    const StyleScope scope(canvas);
    cairo_set_line_join(canvas.cairo(), CAIRO_LINE_JOIN_ROUND);
    if (content.backdrop) {
        draw_backdrop(canvas, view, content);
        outline_container(canvas, view, content.now);
    } else {
        draw_container(canvas, view, style, content.now);
    }
    draw_slice(canvas, view, style, content.now);
    draw_ghosts(canvas, view, style, content);
    draw_trails(canvas, view, style, content);
    draw_discs(canvas, view, style, content);
    if (style.forces) draw_forces(canvas, view, style, content.now);
    draw_points(canvas, view, style, content);
    draw_angles(canvas, view, style, content.now);
    draw_turn_arc(canvas, view, style, content);
    draw_swirl(canvas, view, style, content.now);
}

}  // namespace swirl
