#include "swirl/render/scene.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "swirl/render/ball.hpp"
#include "swirl/render/label.hpp"

namespace swirl {

namespace {

constexpr double full_turn = 2.0 * pi;
constexpr Vec2 nowhere{std::numeric_limits<double>::quiet_NaN(),
                       std::numeric_limits<double>::quiet_NaN()};

/// Below this radius, in pixels, outlines and marks would only be noise.
constexpr double smallest_marked_radius = 3.5;
constexpr double smallest_outlined_radius = 2.5;

std::size_t number_of(const SceneContent& content, std::size_t i) {
    return content.ids.size() == content.now.size() ? static_cast<std::size_t>(content.ids[i]) : i;
}

Color disc_color(const SceneStyle& style, const SceneContent& content, const FrameAt& at,
                 std::size_t i) {
    const Theme& theme = style.theme;
    switch (style.coloring) {
        case Coloring::pinned:
            if (content.pinned.size() != content.now.size()) return theme.disc;
            return content.pinned[i] ? theme.pinned : theme.loose;
        case Coloring::spin: {
            const double spin = content.now.spin[i];
            if (std::isnan(spin)) return theme.disc;
            return diverging_color(spin / style.full_spin, theme.neutral);
        }
        case Coloring::speed: {
            const Vec2 v = at.velocity(content.now.position(i), content.now.velocity(i));
            return sequential_color(std::sqrt(dot(v, v)) / style.full_speed);
        }
        case Coloring::slip: {
            if (!content.now.are_spheres()) return theme.disc;
            const Vec2 c = slip_on_floor(content.now.disc(i), content.now.container_velocity);
            return sequential_color(std::sqrt(dot(c, c)) / style.full_speed);
        }
        case Coloring::id:
            return distinct_colors[number_of(content, i) % distinct_colors.size()];
        case Coloring::none:
            break;
    }
    return theme.disc;
}

void circle(cairo_t* cairo, const Vec2& centre, double radius) {
    cairo_new_sub_path(cairo);
    cairo_arc(cairo, centre.x, centre.y, radius, 0.0, full_turn);
}

/// A disc in its colour with a darker rim, and a hand that shows how it is turned.
void draw_disc(const Canvas& canvas, const Vec2& centre, double radius, const Color& color,
               double orientation) {
    cairo_t* cairo = canvas.cairo();
    if (radius < smallest_outlined_radius) {
        circle(cairo, centre, radius);
        canvas.set(color);
        cairo_fill(cairo);
        return;
    }
    const Color rim = mix(color, {0.0, 0.0, 0.0}, 0.45);
    const double rim_width = std::max(0.7, 0.055 * radius);
    circle(cairo, centre, radius);
    canvas.set(rim);
    cairo_fill(cairo);
    circle(cairo, centre, radius - rim_width);
    canvas.set(color);
    cairo_fill(cairo);
    if (radius < smallest_marked_radius || std::isnan(orientation)) return;

    // The hand: from the middle almost to the rim, dark on light and light on dark.
    const bool dark_ink = brightness(color) > 0.42;
    const Color mark = dark_ink ? mix(color, color_from_hex(0x0B0F14), 0.82)
                                : mix(color, color_from_hex(0xFFFFFF), 0.85);
    const Vec2 direction{std::cos(orientation), -std::sin(orientation)};
    const double reach = 0.74 * radius;
    cairo_set_line_cap(cairo, CAIRO_LINE_CAP_ROUND);
    cairo_set_line_width(cairo, std::max(1.0, 0.17 * radius));
    cairo_move_to(cairo, centre.x, centre.y);
    cairo_line_to(cairo, centre.x + reach * direction.x, centre.y + reach * direction.y);
    canvas.set(mark);
    cairo_stroke(cairo);
}

/// A ring and a hand, to be seen on any picture.
void outline_disc(const Canvas& canvas, const Vec2& centre, double radius, const Color& color,
                  double orientation) {
    cairo_t* cairo = canvas.cairo();
    const double width = std::max(1.2, 0.11 * radius);
    for (const bool shade : {true, false}) {
        circle(cairo, centre, radius);
        if (radius >= smallest_marked_radius && !std::isnan(orientation)) {
            cairo_move_to(cairo, centre.x, centre.y);
            cairo_line_to(cairo, centre.x + 0.74 * radius * std::cos(orientation),
                          centre.y - 0.74 * radius * std::sin(orientation));
        }
        cairo_set_line_cap(cairo, CAIRO_LINE_CAP_ROUND);
        cairo_set_line_width(cairo, shade ? 1.9 * width : width);
        canvas.set(shade ? color_from_hex(0x000000) : color, shade ? 0.4 : 1.0);
        cairo_stroke(cairo);
    }
}

/// The wall over a picture: a thin line.
void outline_container(const Canvas& canvas, const View& view, const Snapshot& now) {
    cairo_t* cairo = canvas.cairo();
    const Vec2 c = view.on_page(FrameAt(now, view.frame).position(now.container_centre));
    const double radius = view.pixels_per_unit * now.container_radius;
    for (const bool shade : {true, false}) {
        circle(cairo, c, radius);
        cairo_set_line_width(cairo, std::max(1.0, 0.006 * radius) * (shade ? 3.0 : 1.0));
        canvas.set(color_from_hex(shade ? 0x000000 : 0xFFFFFF), shade ? 0.35 : 0.9);
        cairo_stroke(cairo);
    }
}

double line_unit(const View& view, const Snapshot& now) {
    return view.pixels_per_unit * now.container_radius;
}

}  // namespace

std::optional<Coloring> coloring_named(std::string_view name) {
    if (name == "pinned") return Coloring::pinned;
    if (name == "spin") return Coloring::spin;
    if (name == "speed") return Coloring::speed;
    if (name == "slip") return Coloring::slip;
    if (name == "none") return Coloring::none;
    if (name == "id") return Coloring::id;
    return std::nullopt;
}

void draw_arrow(const Canvas& canvas, Vec2 tail, Vec2 tip, double width, const Color& color,
                const std::optional<Color>& rim) {
    const Vec2 along = tip - tail;
    const double length = std::sqrt(dot(along, along));
    const double head = 3.4 * width;
    if (!(length > 0.0) || length < 0.6 * head) return;
    const Vec2 u = (1.0 / length) * along;
    const Vec2 side = width * perpendicular(u);
    const Vec2 neck = tip - std::min(head, length) * u;
    cairo_t* cairo = canvas.cairo();
    for (const Vec2& corner : {tail + 0.5 * side, neck + 0.5 * side, neck + 1.5 * side, tip,
                               neck - 1.5 * side, neck - 0.5 * side, tail - 0.5 * side})
        cairo_line_to(cairo, corner.x, corner.y);
    cairo_close_path(cairo);
    if (rim) {
        canvas.set(*rim, 0.8);
        cairo_set_line_join(cairo, CAIRO_LINE_JOIN_ROUND);
        cairo_set_line_width(cairo, 0.7 * width);
        cairo_stroke_preserve(cairo);
    }
    canvas.set(color);
    cairo_fill(cairo);
}

void draw_backdrop(const Canvas& canvas, const View& view, const SceneContent& content) {
    const Backdrop& backdrop = *content.backdrop;
    const FrameAt at(content.now, view.frame);
    const auto place = [&](double x, double y) {
        return view.on_page(
            at.position(backdrop.origin + x * backdrop.along_x + y * backdrop.along_y));
    };
    // cairo counts from the corner of the first pixel, cameras from its middle.
    const Vec2 corner = place(-0.5, -0.5);
    const Vec2 right = place(0.5, -0.5) - corner, down = place(-0.5, 0.5) - corner;
    cairo_t* cairo = canvas.cairo();
    cairo_save(cairo);
    if (view.half_side > 0.0 && view.frame == Frame::lab)
        cairo_rectangle(cairo, view.centre.x - view.half_side, view.centre.y - view.half_side,
                        2.0 * view.half_side, 2.0 * view.half_side);
    else if (view.half_side > 0.0)
        circle(cairo, view.centre, view.half_side);
    if (view.half_side > 0.0) cairo_clip(cairo);
    const cairo_matrix_t matrix{right.x, right.y, down.x, down.y, corner.x, corner.y};
    cairo_transform(cairo, &matrix);
    cairo_set_source_surface(cairo, backdrop.image->surface(), 0.0, 0.0);
    // A picture that is made much smaller must be averaged; else this is faster and as good.
    const double scale = std::sqrt(dot(right, right));
    cairo_pattern_set_filter(cairo_get_source(cairo),
                             scale < 0.6 ? CAIRO_FILTER_GOOD : CAIRO_FILTER_BILINEAR);
    cairo_paint(cairo);
    cairo_restore(cairo);
}

void draw_container(const Canvas& canvas, const View& view, const SceneStyle& style,
                    const Snapshot& now) {
    cairo_t* cairo = canvas.cairo();
    const FrameAt at(now, view.frame);
    const Vec2 c = view.on_page(at.position(now.container_centre));
    const double radius = view.pixels_per_unit * now.container_radius;
    const double thickness = wall_thickness * radius;

    circle(cairo, c, radius + thickness);
    canvas.set(style.theme.wall);
    cairo_fill(cairo);
    // Marks that stand still on the wall: twelve, one of them broad, so that the wall's turning in
    // the M-frame, and its not turning in the lab, can be seen.
    for (int k = 0; k < 12; ++k) {
        const double angle = at.orientation(full_turn * k / 12.0);
        const Vec2 u{std::cos(angle), -std::sin(angle)};
        const double inner = radius, outer = radius + thickness;
        cairo_set_line_cap(cairo, CAIRO_LINE_CAP_BUTT);
        cairo_set_line_width(cairo, (k == 0 ? 1.5 : 0.38) * thickness);
        cairo_move_to(cairo, c.x + inner * u.x, c.y + inner * u.y);
        cairo_line_to(cairo, c.x + outer * u.x, c.y + outer * u.y);
        canvas.set(k == 0 ? style.theme.accent : style.theme.wall_mark);
        cairo_stroke(cairo);
    }
    circle(cairo, c, radius);
    canvas.set(style.theme.floor);
    cairo_fill(cairo);
}

void draw_trails(const Canvas& canvas, const View& view, const SceneStyle& style,
                 const SceneContent& content) {
    if (content.past.empty()) return;
    cairo_t* cairo = canvas.cairo();
    const std::size_t count = content.now.size();
    std::vector<std::vector<Vec2>> places;  // of all discs on the page, oldest instant first
    for (std::size_t k = 0; k <= content.past.size(); ++k) {
        const bool present = k == content.past.size();
        const Snapshot& then = present ? content.now : *content.past[k];
        const bool named = !present && content.past_ids.size() == content.past.size();
        if (!named && then.size() != count) continue;
        const FrameAt at(then, view.frame);
        std::vector<Vec2>& row = places.emplace_back(count, nowhere);
        if (!named) {
            for (std::size_t i = 0; i < count; ++i)
                row[i] = view.on_page(at.position(then.position(i)));
            continue;
        }
        // Those who were there already, by name; the names ascend.
        const auto& names = content.past_ids[k];
        for (std::size_t i = 0; i < count; ++i) {
            const auto found = std::lower_bound(names.begin(), names.end(), content.ids[i]);
            if (found == names.end() || *found != content.ids[i]) continue;
            const auto j = static_cast<std::size_t>(found - names.begin());
            row[i] = view.on_page(at.position(then.position(j)));
        }
    }
    if (places.size() < 2) return;
    // A few bands of one opacity each, all discs of a colour in one path: segment by segment it
    // would take longer than everything else.
    constexpr std::size_t bands = 8;
    const FrameAt at(content.now, view.frame);
    const std::size_t segments = places.size() - 1;
    const double radius = count > 0 ? view.pixels_per_unit * content.now.radius[0] : 1.0;
    // Round ends would show through each other where the trails are transparent.
    cairo_set_line_cap(cairo, content.backdrop ? CAIRO_LINE_CAP_BUTT : CAIRO_LINE_CAP_ROUND);
    cairo_set_line_join(cairo, CAIRO_LINE_JOIN_ROUND);
    for (std::size_t band = 0; band < bands; ++band) {
        const std::size_t from = segments * band / bands, to = segments * (band + 1) / bands;
        if (from == to) continue;
        const double age = (static_cast<double>(band) + 1.0) / bands;
        cairo_set_line_width(cairo, std::max(1.0, (0.05 + 0.14 * age) * radius));
        for (std::size_t i = 0; i < count; ++i) {
            cairo_new_sub_path(cairo);
            for (std::size_t k = from; k <= to; ++k)
                if (!std::isnan(places[k][i].x))
                    cairo_line_to(cairo, places[k][i].x, places[k][i].y);
            const bool own_color = style.coloring != Coloring::none;
            if (!own_color && i + 1 < count) continue;
            const Color color = disc_color(style, content, at, i);
            if (content.backdrop)
                canvas.set(color, 0.12 + 0.6 * age);
            else
                canvas.set(mix(style.theme.floor, color, 0.12 + 0.6 * age));
            cairo_stroke(cairo);
        }
    }
}

void draw_discs(const Canvas& canvas, const View& view, const SceneStyle& style,
                const SceneContent& content) {
    const Snapshot& now = content.now;
    const FrameAt at(now, view.frame);
    const bool balls =
        style.orientation && now.are_balls() && !now.turned.empty() && !content.backdrop;
    const Quaternion frame = turn_by(0.0, 0.0, at.orientation(0.0));
    for (std::size_t i = 0; i < now.size(); ++i) {
        const double radius = view.pixels_per_unit * now.radius[i];
        if (balls && radius >= smallest_marked_radius) {
            draw_ball(canvas, view.on_page(at.position(now.position(i))), radius,
                      disc_color(style, content, at, i), frame * now.quaternion(i));
            continue;
        }
        const double orientation =
            style.orientation ? at.orientation(now.orientation(i)) : std::nan("");
        (content.backdrop ? outline_disc : draw_disc)(
            canvas, view.on_page(at.position(now.position(i))), radius,
            disc_color(style, content, at, i), orientation);
    }
}

void draw_ghosts(const Canvas& canvas, const View& view, const SceneStyle& style,
                 const SceneContent& content) {
    cairo_t* cairo = canvas.cairo();
    const Snapshot& now = content.now;
    for (std::size_t k = 0; k < content.ghosts.size(); ++k) {
        const Snapshot& then = *content.ghosts[k];
        const FrameAt at(then, view.frame);
        const double age = double(k + 1) / double(content.ghosts.size() + 1);
        // In the lab the dish was elsewhere, too.
        if (view.frame == Frame::lab) {
            const double wall = view.pixels_per_unit * then.container_radius;
            circle(cairo, view.on_page(then.container_centre), wall);
            cairo_set_line_width(cairo, std::max(0.7, 0.012 * wall));
            canvas.set(style.theme.wall, 0.1 + 0.3 * age);
            cairo_stroke(cairo);
        }
        for (std::size_t i = 0; i < then.size(); ++i) {
            const Color color =
                then.size() == now.size() ? disc_color(style, content, at, i) : style.theme.disc;
            const double radius = view.pixels_per_unit * then.radius[i];
            circle(cairo, view.on_page(at.position(then.position(i))), 0.94 * radius);
            canvas.set(color, 0.05 + 0.2 * age);
            cairo_fill_preserve(cairo);
            cairo_set_line_width(cairo, std::max(0.7, 0.045 * radius));
            canvas.set(color, 0.15 + 0.5 * age);
            cairo_stroke(cairo);
        }
    }
}

void draw_slice(const Canvas& canvas, const View& view, const SceneStyle& style,
                const Snapshot& now) {
    if (!style.slice || view.frame != Frame::m) return;
    constexpr double half_width = pi / 18.0;
    cairo_t* cairo = canvas.cairo();
    const double radius = view.pixels_per_unit * now.container_radius;
    cairo_move_to(cairo, view.centre.x, view.centre.y);
    // The page counts y downwards, so angles change their sign.
    cairo_arc(cairo, view.centre.x, view.centre.y, radius, -*style.slice - half_width,
              -*style.slice + half_width);
    cairo_close_path(cairo);
    canvas.set(distinct_colors[2], 0.35);
    cairo_fill(cairo);
}

void draw_angles(const Canvas& canvas, const View& view, const SceneStyle& style,
                 const Snapshot& now) {
    if (!style.angles || view.frame != Frame::m) return;
    // In a small dish larger, so that they can be read.
    const double unit = line_unit(view, now),
                 type = std::max(0.055 * unit, std::min(9.5, 0.09 * unit));
    if (type < 7.0) return;
    const LabelStyle label{.size = type, .color = style.theme.ink, .align = Align::center};
    const double away = (1.0 + wall_thickness) * unit + 0.9 * type;
    for (int k = 0; k < 8; ++k) {
        const double theta = k * pi / 4.0;
        const Vec2 u{std::cos(theta), -std::sin(theta)};
        const double reach = away + 0.5 * type * std::abs(u.x);
        // M stands at the bottom already.
        if (k == 6 && style.points) continue;
        draw_label(canvas, std::to_string(45 * k) + "°",
                   {view.centre.x + reach * u.x, view.centre.y + reach * u.y + 0.35 * type}, label);
    }
}

void draw_forces(const Canvas& canvas, const View& view, const SceneStyle& style,
                 const Snapshot& now, std::span<const std::size_t> discs) {
    if (view.frame != Frame::m || now.size() == 0 || !(now.period > 0.0)) return;
    const FrameAt at(now, view.frame);
    const double omega = full_turn / now.period;
    const Vec2 swirl_centre = at.position({0.0, 0.0});
    const double amplitude = std::sqrt(dot(swirl_centre, swirl_centre));
    // Both forces on one scale: the largest centrifugal force in the dish is 2 radii long.
    const double largest = omega * omega * (now.container_radius + amplitude);
    const double length = 2.0 * now.radius[0] * view.pixels_per_unit / largest;
    for (std::size_t i : discs) {
        const Vec2 p = at.position(now.position(i));
        const Vec2 v = at.velocity(now.position(i), now.velocity(i));
        const Vec2 centrifugal = (omega * omega) * (p - swirl_centre);
        const Vec2 coriolis = (-2.0 * omega) * perpendicular(v);
        const Vec2 tail = view.on_page(p);
        const double width = std::max(1.0, 0.12 * view.pixels_per_unit * now.radius[i]);
        const auto tip = [&](const Vec2& force) {
            return Vec2{tail.x + length * force.x, tail.y - length * force.y};
        };
        draw_arrow(canvas, tail, tip(centrifugal), width, style.theme.centrifugal,
                   style.theme.floor);
        draw_arrow(canvas, tail, tip(coriolis), width, style.theme.coriolis, style.theme.floor);
    }
}

void draw_points(const Canvas& canvas, const View& view, const SceneStyle& style,
                 const SceneContent& content) {
    cairo_t* cairo = canvas.cairo();
    const Snapshot& now = content.now;
    const Theme& theme = style.theme;
    const FrameAt at(now, view.frame);
    const double unit = line_unit(view, now);
    const double line = std::max(0.8, 0.005 * unit);
    const Vec2 centre = now.container_centre;
    const double amplitude = std::sqrt(dot(centre, centre));

    if (style.path && view.frame == Frame::lab && content.path.size() > 1) {
        for (const Vec2& p : content.path) {
            const Vec2 q = view.on_page(p);
            cairo_line_to(cairo, q.x, q.y);
        }
        cairo_close_path(cairo);
        cairo_set_line_width(cairo, 2.6 * line);
        canvas.set(theme.floor, 0.75);
        cairo_stroke_preserve(cairo);
        cairo_set_line_width(cairo, 1.1 * line);
        canvas.set(theme.ink, 0.9);
        cairo_stroke(cairo);
    }
    if (!style.points) return;

    // Also in a small dish large enough to be read, as long as it does not hide the discs.
    const double type = style.point_type * std::max(0.062 * unit, std::min(13.0, 0.16 * unit));
    const bool labelled = type >= 8.0;
    const LabelStyle label{.size = type, .color = theme.ink, .bold = true, .halo = theme.floor};
    const Vec2 s = view.on_page(at.position({0.0, 0.0}));
    const Vec2 c = view.on_page(at.position(centre));

    // S: a cross.
    const double arm = 0.022 * unit;
    for (int pass = 0; pass < 2; ++pass) {
        cairo_set_line_cap(cairo, CAIRO_LINE_CAP_ROUND);
        cairo_set_line_width(cairo, (pass == 0 ? 4.2 : 2.0) * line);
        cairo_move_to(cairo, s.x - arm, s.y);
        cairo_line_to(cairo, s.x + arm, s.y);
        cairo_move_to(cairo, s.x, s.y - arm);
        cairo_line_to(cairo, s.x, s.y + arm);
        canvas.set(pass == 0 ? theme.floor : theme.ink);
        cairo_stroke(cairo);
    }
    // C: a dot.
    circle(cairo, c, 0.019 * unit + line);
    canvas.set(theme.floor);
    cairo_fill(cairo);
    circle(cairo, c, 0.019 * unit);
    canvas.set(theme.ink);
    cairo_fill(cairo);
    if (labelled) {
        draw_label(canvas, "$S$", {s.x - 1.05 * type, s.y - 0.28 * type}, label);
        draw_label(canvas, "$C$", {c.x + 0.45 * type, c.y + 0.75 * type}, label);
    }
    if (amplitude == 0.0) return;
    // M: a triangle outside the wall that points at it.
    const Vec2 outward = (1.0 / amplitude) * centre;
    const double wall = now.container_radius * (1.0 + wall_thickness);
    const Vec2 m = view.on_page(at.position(centre + wall * outward));
    Vec2 u = at.turned(outward);
    u.y = -u.y;
    const Vec2 side{-u.y, u.x};
    // In the lab frame the picture ends at the wall's farthest reach, so there M lies on the wall.
    const double inward = view.frame == Frame::lab ? -wall_thickness * unit : 0.0;
    const double height = 0.038 * unit;
    const Vec2 tip{m.x + inward * u.x, m.y + inward * u.y};
    cairo_move_to(cairo, tip.x, tip.y);
    cairo_line_to(cairo, tip.x + height * u.x + 0.6 * height * side.x,
                  tip.y + height * u.y + 0.6 * height * side.y);
    cairo_line_to(cairo, tip.x + height * u.x - 0.6 * height * side.x,
                  tip.y + height * u.y - 0.6 * height * side.y);
    cairo_close_path(cairo);
    if (content.backdrop) {
        cairo_set_line_width(cairo, 3.0 * line);
        canvas.set(theme.floor, 0.85);
        cairo_stroke_preserve(cairo);
    }
    canvas.set(theme.ink);
    cairo_fill(cairo);
    if (!labelled) return;
    const Vec2 middle = view.frame == Frame::lab
                            ? Vec2{tip.x - 0.65 * type * u.x, tip.y - 0.65 * type * u.y}
                            : Vec2{tip.x + height + 0.35 * type, tip.y + 0.6 * type};
    if (view.frame == Frame::lab) {
        LabelStyle centred = label;
        centred.align = Align::center;
        draw_label(canvas, "$M$", {middle.x, middle.y + 0.34 * type}, centred);
    } else {
        LabelStyle outside = label;
        if (!content.backdrop) outside.halo = std::nullopt;
        draw_label(canvas, "$M$", middle, outside);
    }
}

void draw_turned(const Canvas& canvas, const View& view, const SceneStyle& style,
                 const SceneContent& content) {
    if (!content.turned || view.frame != Frame::lab) return;
    cairo_t* cairo = canvas.cairo();
    const Snapshot& now = content.now;
    const Theme& theme = style.theme;
    const double unit = line_unit(view, now), width = 0.035 * unit;
    const double radius = unit * (1.0 + wall_thickness + 0.045);
    const Vec2 c = view.on_page(now.container_centre);
    const double turns = *content.turned;
    const Color color = turns < 0.0 ? theme.pinned : theme.loose;
    // From the top; beyond a whole turn only the rest is shown, the number tells the whole.
    const double top = -0.5 * pi, sweep = -full_turn * (turns - std::trunc(turns));
    cairo_set_line_cap(cairo, CAIRO_LINE_CAP_BUTT);
    cairo_set_line_width(cairo, width);
    cairo_new_sub_path(cairo);
    if (sweep < 0.0)
        cairo_arc_negative(cairo, c.x, c.y, radius, top, top + sweep);
    else
        cairo_arc(cairo, c.x, c.y, radius, top, top + sweep);
    canvas.set(color);
    cairo_stroke(cairo);
    // A head that points on along the arc.
    const double sense = turns < 0.0 ? 1.0 : -1.0, end = top + sweep;
    const Vec2 outward{std::cos(end), std::sin(end)};
    const Vec2 along{-sense * outward.y, sense * outward.x};
    const Vec2 base = c + radius * outward;
    const Vec2 tip = base + 2.4 * width * along;
    cairo_move_to(cairo, tip.x, tip.y);
    cairo_line_to(cairo, base.x + 1.5 * width * outward.x, base.y + 1.5 * width * outward.y);
    cairo_line_to(cairo, base.x - 1.5 * width * outward.x, base.y - 1.5 * width * outward.y);
    cairo_close_path(cairo);
    cairo_fill(cairo);
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
    if (style.forces) {
        std::vector<std::size_t> all(content.now.size());
        std::iota(all.begin(), all.end(), std::size_t{0});
        draw_forces(canvas, view, style, content.now, all);
    }
    draw_points(canvas, view, style, content);
    draw_angles(canvas, view, style, content.now);
    draw_turned(canvas, view, style, content);
}

}  // namespace swirl
