#include "swirl/render/frame_diagram.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "swirl/render/label.hpp"
#include "swirl/render/scene.hpp"
#include "swirl/render/view.hpp"

namespace swirl {

namespace {

constexpr double once_round = 2.0 * std::numbers::pi;

/// An arrow along a circle about the view's centre, from an angle on; counter-clockwise as seen, if
/// `turn` is positive.
void draw_bent_arrow(const Canvas& canvas, const View& view, double radius, double begin,
                     double turn, double line, const Color& color) {
    cairo_t* cairo = canvas.cairo();
    const double along = view.pixels_per_unit * radius;
    const auto on_arc = [&](double angle) {  // y of the page points down
        return Vec2{view.centre.x + along * std::cos(angle),
                    view.centre.y - along * std::sin(angle)};
    };
    cairo_new_sub_path(cairo);
    if (turn > 0.0)
        cairo_arc_negative(cairo, view.centre.x, view.centre.y, along, -begin, -(begin + turn));
    else
        cairo_arc(cairo, view.centre.x, view.centre.y, along, -begin, -(begin + turn));
    cairo_set_line_width(cairo, line);
    cairo_set_line_cap(cairo, CAIRO_LINE_CAP_ROUND);
    canvas.set(color);
    cairo_stroke(cairo);
    const double head = std::copysign(5.0 * line / along, turn), end = begin + turn;
    draw_arrow(canvas, on_arc(end - 0.1 * head), on_arc(end + head), line, color);
}

void draw_centrifugal_field(const Canvas& canvas, const View& view, const Theme& theme,
                            double container_radius, double amplitude, const Vec2& spare) {
    const Vec2 swirl_centre{0.0, amplitude};
    const double spacing = container_radius / 3.6;
    const double longest = container_radius + amplitude;
    for (int row = -4; row <= 4; ++row) {
        for (int column = -4; column <= 4; ++column) {
            const Vec2 p{(column + (row % 2 != 0 ? 0.5 : 0.0)) * spacing, 0.87 * row * spacing};
            if (dot(p, p) > 0.72 * container_radius * container_radius) continue;
            const Vec2 apart = p - spare;
            if (dot(apart, apart) < 0.09 * container_radius * container_radius) continue;
            const Vec2 force = (1.5 * spacing / longest) * (p - swirl_centre);
            draw_arrow(canvas, view.on_page(p), view.on_page(p + force),
                       0.055 * spacing * view.pixels_per_unit, theme.centrifugal);
        }
    }
}

}  // namespace

void draw_frame_diagram(const Canvas& canvas, const Theme& theme, const Snapshot& now,
                        std::size_t disc) {
    canvas.fill_page(theme.page);
    const double width = canvas.size().width, height = canvas.size().height;
    const double type = 0.062 * std::min(height, width / 3.1), gap = 0.02 * width;
    const double side = std::min(width / 3.0 - gap, height - 4.2 * type);
    const Vec2 centre = now.container_centre;
    const double amplitude = std::sqrt(dot(centre, centre)), radius = now.container_radius;
    Snapshot empty = now;
    empty.resize(0);
    SceneStyle style;
    style.theme = theme;
    style.point_type = 1.8;
    const auto square = [&](int k) {
        return Rectangle{width * (k + 0.5) / 3.0 - 0.5 * side, 3.0 * type, side,
                         height - 3.2 * type};
    };
    View views[3] = {fitting_view(square(0), Frame::lab, radius, amplitude),
                     fitting_view(square(1), Frame::m, radius, amplitude),
                     fitting_view(square(2), Frame::m, radius, amplitude)};
    const double scale = std::min(views[0].pixels_per_unit, views[1].pixels_per_unit);
    const char* const titles[3] = {"lab frame", "M-frame", "forces in the M-frame"};
    // What to look at, in a line.
    const char* const says[3] = {"$C$ runs round $S$, the dish does not turn",
                                 "the wall turns clockwise, with $−Ω$",
                                 "$F_{cent}$ away from $S$, $F_{Cor}$ to the right of $v$"};
    for (int k = 0; k < 3; ++k) {
        views[k].pixels_per_unit = scale;
        draw_label(canvas, says[k], {width * (k + 0.5) / 3.0, 2.2 * type},
                   {.size = 0.76 * type, .color = theme.faint_ink, .align = Align::center});
        draw_label(canvas, titles[k], {width * (k + 0.5) / 3.0, 1.2 * type},
                   {.size = type, .color = theme.ink, .align = Align::center});
    }
    const double line = std::max(1.0, 0.06 * type);
    cairo_t* cairo = canvas.cairo();

    // Lab: the path of C, and how far the wall reaches, as dots.
    std::vector<Vec2> path;
    for (int k = 0; k < 120; ++k)
        path.push_back({amplitude * std::cos(once_round * k / 120),
                        amplitude * std::sin(once_round * k / 120)});
    draw_container(canvas, views[0], style, empty);
    draw_points(canvas, views[0], style, {.now = empty, .path = path});
    cairo_new_sub_path(cairo);
    cairo_arc(cairo, views[0].centre.x, views[0].centre.y,
              scale * (radius * (1.0 + wall_thickness) + amplitude), 0.0, once_round);
    const double dots[2] = {0.0, 5.0 * line};
    cairo_set_dash(cairo, dots, 2, 0.0);
    cairo_set_line_cap(cairo, CAIRO_LINE_CAP_ROUND);
    cairo_set_line_width(cairo, 2.0 * line);
    canvas.set(theme.faint_ink);
    cairo_stroke(cairo);
    cairo_set_dash(cairo, nullptr, 0, 0.0);
    // Of M, a quarter of a turn ahead of where it is.
    draw_bent_arrow(canvas, views[0], radius * (1.0 + wall_thickness) + amplitude,
                    std::atan2(centre.y, centre.x) + once_round / 8.0, once_round / 9.0, 2.4 * line,
                    theme.faint_ink);
    draw_bent_arrow(canvas, views[0], amplitude, std::atan2(centre.y, centre.x) + once_round / 8.0,
                    once_round / 4.0, 2.0 * line, theme.ink);

    draw_container(canvas, views[1], style, empty);
    draw_points(canvas, views[1], style, {.now = empty});
    for (int k = 0; k < 3; ++k)
        draw_bent_arrow(canvas, views[1], 0.9 * radius, once_round * (k / 3.0 + 1.0 / 12.0),
                        -once_round / 6.5, 2.4 * line, theme.ink);

    draw_container(canvas, views[2], style, empty);
    if (disc < now.size() && now.period > 0.0) {
        const FrameAt at(now, Frame::m);
        const Vec2 p = at.position(now.position(disc));
        const Vec2 v = at.velocity(now.position(disc), now.velocity(disc));
        draw_centrifugal_field(canvas, views[2], theme, radius, amplitude, p);
        const Vec2 place = views[2].on_page(p);
        const double r = scale * now.radius[disc];
        cairo_new_sub_path(cairo);
        cairo_arc(cairo, place.x, place.y, r, 0.0, once_round);
        canvas.set(distinct_colors[2]);
        cairo_fill(cairo);
        // Velocity and force on scales of their own; the force is 2Ω|v|, to the right of v.
        const double speed = std::sqrt(dot(v, v));
        const Vec2 u = (2.9 * now.radius[disc] / std::max(speed, 1e-300)) * v;
        const Vec2 force = -0.85 * perpendicular(u);
        const LabelStyle plain{.size = 0.8 * type,
                               .color = theme.ink,
                               .align = Align::center,
                               .bold = true,
                               .halo = theme.floor};
        const auto named = [&](const Vec2& arm, double along_arm, const Vec2& beside,
                               const Color& color, const char* name) {
            draw_arrow(canvas, place, views[2].on_page(p + arm), 0.17 * r, color);
            LabelStyle label = plain;
            label.color = color;
            const Vec2 at_label = views[2].on_page(p + along_arm * arm);
            draw_label(canvas, name,
                       {at_label.x + type * beside.x, at_label.y - type * beside.y + 0.25 * type},
                       label);
        };
        // Each name stands beside its arrow: that of v away from the force, that of the force on
        // the side where v points to, as C may stand on the other.
        const Vec2 along = (1.0 / std::sqrt(dot(u, u))) * u;
        const Vec2 right = -1.0 * perpendicular(along);
        named(u, 0.75, -0.75 * right, theme.velocity, "$v$");
        named(force, 1.0, 0.8 * along, theme.coriolis, "$F_{Cor}$");
        LabelStyle field = plain;
        field.color = theme.centrifugal;
        field.halo = std::nullopt;
        draw_label(canvas, "$F_{cent}$", views[2].on_page({0.72 * radius, -1.02 * radius}), field);
    }
    draw_points(canvas, views[2], style, {.now = empty});
}

}  // namespace swirl
