#include "swirl/render/frame_diagram.hpp"

#include <algorithm>
#include <cmath>

#include "swirl/math/unit_circle.hpp"
#include "swirl/render/label.hpp"
#include "swirl/render/scene.hpp"
#include "swirl/render/view.hpp"

namespace swirl {

namespace {

/// An arrow along a circle about the view's centre, from the angle `begin` on. A positive `turn`
/// is counter-clockwise.
void draw_bent_arrow(const Canvas& canvas, const View& view, double radius, double begin,
                     double turn, double line, const Color& color) {
    cairo_t* cairo = canvas.cairo();
    const double on_page = view.pixels_per_unit * radius;
    const auto on_arc = [&](double angle) {  // y points down on the page
        return Vec2{view.centre.x + on_page * std::cos(angle),
                    view.centre.y - on_page * std::sin(angle)};
    };
    cairo_new_sub_path(cairo);
    (turn > 0.0 ? cairo_arc_negative : cairo_arc)(cairo, view.centre.x, view.centre.y, on_page,
                                                  -begin, -(begin + turn));
    cairo_set_line_cap(cairo, CAIRO_LINE_CAP_ROUND);
    canvas.stroke(line, color);
    const double head = std::copysign(5.0 * line / on_page, turn), end = begin + turn;
    draw_arrow(canvas, on_arc(end - 0.1 * head), on_arc(end + head), line, color);
}

/// Arrows on a triangular lattice, omitted around the disc at `omitted` and near the wall.
void draw_centrifugal_field(const Canvas& canvas, const View& view, const Theme& theme,
                            double container_radius, double amplitude, const Vec2& omitted) {
    const Vec2 swirl_centre{0.0, amplitude};
    const double spacing = container_radius / 3.6;
    const double longest = container_radius + amplitude;
    for (int row = -4; row <= 4; ++row) {
        for (int column = -4; column <= 4; ++column) {
            const Vec2 p{(column + (row % 2 != 0 ? 0.5 : 0.0)) * spacing, 0.87 * row * spacing};
            if (dot(p, p) > 0.72 * container_radius * container_radius) continue;
            const Vec2 apart = p - omitted;
            if (dot(apart, apart) < 0.09 * container_radius * container_radius) continue;
            const Vec2 force = (1.5 * spacing / longest) * (p - swirl_centre);
            draw_arrow(canvas, view.on_page(p), view.on_page(p + force),
                       0.055 * spacing * view.pixels_per_unit, theme.centrifugal);
        }
    }
}

struct Diagram {
    const Canvas& canvas;
    const Theme& theme;
    const Snapshot& now;
    Snapshot empty;  // the container without discs
    SceneStyle style;
    double em, line;  // font size and line width, in pixels
    double radius, amplitude;
    View views[3];
};

/// The path of C, the reach of the wall as a dotted circle, and the motion of M and C.
void draw_lab_part(const Diagram& d) {
    const View& view = d.views[0];
    cairo_t* cairo = d.canvas.cairo();
    std::vector<Vec2> path;
    for (int k = 0; k < 120; ++k)
        path.push_back({d.amplitude * std::cos(full_turn * k / 120),
                        d.amplitude * std::sin(full_turn * k / 120)});
    draw_container(d.canvas, view, d.style, d.empty);
    draw_points(d.canvas, view, d.style, {.now = d.empty, .path = path});
    const double reach = d.radius * (1.0 + wall_thickness) + d.amplitude;
    d.canvas.add_circle(view.centre, view.pixels_per_unit * reach);
    const double dots[2] = {0.0, 5.0 * d.line};
    cairo_set_dash(cairo, dots, 2, 0.0);
    cairo_set_line_cap(cairo, CAIRO_LINE_CAP_ROUND);
    d.canvas.stroke(2.0 * d.line, d.theme.faint_ink);
    cairo_set_dash(cairo, nullptr, 0, 0.0);
    // Both arrows start an eighth of a turn ahead of M and C.
    const Vec2 centre = d.now.container_centre;
    const double ahead = std::atan2(centre.y, centre.x) + full_turn / 8.0;
    draw_bent_arrow(d.canvas, view, reach, ahead, full_turn / 9.0, 2.4 * d.line, d.theme.faint_ink);
    draw_bent_arrow(d.canvas, view, d.amplitude, ahead, full_turn / 4.0, 2.0 * d.line, d.theme.ink);
}

void draw_m_frame_part(const Diagram& d) {
    draw_container(d.canvas, d.views[1], d.style, d.empty);
    draw_points(d.canvas, d.views[1], d.style, {.now = d.empty});
    for (int k = 0; k < 3; ++k)
        draw_bent_arrow(d.canvas, d.views[1], 0.9 * d.radius, full_turn * (k / 3.0 + 1.0 / 12.0),
                        -full_turn / 6.5, 2.4 * d.line, d.theme.ink);
}

/// The disc with its velocity v, its Coriolis force, and the centrifugal field.
void draw_forces_on(const Diagram& d, std::size_t disc) {
    const View& view = d.views[2];
    const Theme& theme = d.theme;
    const FrameTransform frame(d.now, Frame::m);
    const Vec2 p = frame.position(d.now.position(disc));
    const Vec2 v = frame.velocity(d.now.position(disc), d.now.velocity(disc));
    draw_centrifugal_field(d.canvas, view, theme, d.radius, d.amplitude, p);
    const Vec2 centre = view.on_page(p);
    const double r = view.pixels_per_unit * d.now.radius[disc];
    d.canvas.add_circle(centre, r);
    d.canvas.fill(distinct_colors[2]);
    // Velocity and force have separate scales. The force is 2Ω|v|, to the right of v.
    const double speed = std::sqrt(dot(v, v));
    const Vec2 u = (2.9 * d.now.radius[disc] / std::max(speed, 1e-300)) * v;
    const Vec2 force = -0.85 * perpendicular(u);
    LabelStyle label{.size = 0.8 * d.em,
                     .color = theme.ink,
                     .align = Align::center,
                     .bold = true,
                     .halo = theme.floor};
    const auto draw_named = [&](const Vec2& arm, double share, const Vec2& offset,
                                const Color& color, const char* name) {
        draw_arrow(d.canvas, centre, view.on_page(p + arm), 0.17 * r, color);
        label.color = color;
        const Vec2 at = view.on_page(p + share * arm);
        draw_label(d.canvas, name, {at.x + d.em * offset.x, at.y - d.em * offset.y + 0.25 * d.em},
                   label);
    };
    // Each name is next to its arrow: that of v on the side away from the force, that of the force
    // on the side to which v points, because C may be on the other side.
    const Vec2 along = (1.0 / std::sqrt(dot(u, u))) * u;
    const Vec2 right = -1.0 * perpendicular(along);
    draw_named(u, 0.75, -0.75 * right, theme.velocity, "$v$");
    draw_named(force, 1.0, 0.8 * along, theme.coriolis, "$F_{Cor}$");
    label.color = theme.centrifugal;
    label.halo = std::nullopt;
    draw_label(d.canvas, "$F_{cent}$", view.on_page({0.72 * d.radius, -1.02 * d.radius}), label);
}

}  // namespace

void draw_frame_diagram(const Canvas& canvas, const Theme& theme, const Snapshot& now,
                        std::size_t disc) {
    canvas.fill_page(theme.page);
    const double width = canvas.size().width, height = canvas.size().height;
    const double em = 0.062 * std::min(height, width / 3.1), gap = 0.02 * width;
    const double side = std::min(width / 3.0 - gap, height - 4.2 * em);
    const Vec2 centre = now.container_centre;
    const double amplitude = std::sqrt(dot(centre, centre)), radius = now.container_radius;
    const auto view_of = [&](int k, Frame frame) {
        const Rectangle square{width * (k + 0.5) / 3.0 - 0.5 * side, 3.0 * em, side,
                               height - 3.2 * em};
        return fitting_view(square, frame, radius, amplitude);
    };
    Diagram d{canvas,
              theme,
              now,
              now,
              {},
              em,
              std::max(1.0, 0.06 * em),
              radius,
              amplitude,
              {view_of(0, Frame::lab), view_of(1, Frame::m), view_of(2, Frame::m)}};
    d.empty.resize(0);
    d.style.theme = theme;
    d.style.point_size = 1.8;
    const double scale = std::min(d.views[0].pixels_per_unit, d.views[1].pixels_per_unit);
    const char* const titles[3] = {"lab frame", "M-frame", "forces in the M-frame"};
    const char* const explanations[3] = {"$C$ circles $S$, the container does not rotate",
                                         "the wall turns clockwise, with $−Ω$",
                                         "$F_{cent}$ away from $S$, $F_{Cor}$ to the right of $v$"};
    for (int k = 0; k < 3; ++k) {
        d.views[k].pixels_per_unit = scale;
        draw_label(canvas, explanations[k], {width * (k + 0.5) / 3.0, 2.2 * em},
                   {.size = 0.76 * em, .color = theme.faint_ink, .align = Align::center});
        draw_label(canvas, titles[k], {width * (k + 0.5) / 3.0, 1.2 * em},
                   {.size = em, .color = theme.ink, .align = Align::center});
    }
    draw_lab_part(d);
    draw_m_frame_part(d);
    draw_container(canvas, d.views[2], d.style, d.empty);
    if (disc < now.size() && now.period > 0.0) draw_forces_on(d, disc);
    draw_points(canvas, d.views[2], d.style, {.now = d.empty});
}

}  // namespace swirl
