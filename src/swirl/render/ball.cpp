#include "swirl/render/ball.hpp"

#include <algorithm>
#include <cmath>

namespace swirl {
namespace {

/// From 0 to 1 where u passes 0, over a width of 2 `soft`.
double step_at(double u, double soft) { return std::clamp(0.5 + 0.5 * u / soft, 0.0, 1.0); }

/// −1 or 1, with a soft edge.
double sign_of(double u, double soft) { return 2.0 * step_at(u, soft) - 1.0; }

struct Pattern {
    Color dark, pale, pole;
    double soft;  // half the width of an edge, in units of the radius: one pixel

    Color at(const Direction& d) const {
        const double patch = sign_of(d.x, soft) * sign_of(d.y, soft) * sign_of(d.z, soft);
        const Color body = mix(dark, pale, 0.5 + 0.5 * patch);
        constexpr double cap = 0.93;  // share of the distance from the centre: 21° about the pole
        return mix(body, pole, step_at(std::abs(d.z) - cap, 0.4 * soft + 1e-3));
    }
};

/// Direction of the light: from the upper left, above the page.
constexpr double lx = -0.45, ly = 0.55, lz = 0.70;

/// One pixel as cairo's ARGB32, with colours multiplied by the opacity. (nx, ny, nz) is the unit
/// normal of the surface.
std::uint32_t shaded(const Color& surface, double nx, double ny, double nz, double opacity) {
    const double light = 0.38 + 0.67 * std::max(nx * lx + ny * ly + nz * lz, 0.0);
    // Highlight where the normal is half way between the light and the viewer.
    static const double half_way = std::sqrt(lx * lx + ly * ly + (lz + 1.0) * (lz + 1.0));
    const double highlight =
        std::pow(std::max((nx * lx + ny * ly + nz * (lz + 1.0)) / half_way, 0.0), 60.0);
    const auto byte = [&](double channel) {
        const double lit = std::min(channel * light + 0.55 * highlight, 1.0);
        return static_cast<std::uint32_t>(std::lround(255.0 * lit * opacity));
    };
    return static_cast<std::uint32_t>(std::lround(255.0 * opacity)) << 24 |
           byte(surface.red) << 16 | byte(surface.green) << 8 | byte(surface.blue);
}

}  // namespace

void draw_ball(const Canvas& canvas, const Vec2& centre, double radius, const Color& color,
               const Quaternion& orientation) {
    // As many pixels as on the page; in a vector file enough for print.
    cairo_t* const cairo = canvas.cairo();
    const bool is_vector =
        cairo_surface_get_type(cairo_get_target(cairo)) != CAIRO_SURFACE_TYPE_IMAGE;
    const double enlarged = is_vector ? std::max(1.0, 64.0 / std::max(radius, 1.0)) : 1.0;
    const double r = radius * enlarged;
    const int half = static_cast<int>(std::ceil(r)) + 1, side = 2 * half;
    cairo_surface_t* const surface = cairo_image_surface_create(CAIRO_FORMAT_ARGB32, side, side);
    if (cairo_surface_status(surface) != CAIRO_STATUS_SUCCESS)
        throw DrawFailure("not enough memory to draw a sphere.");
    cairo_surface_flush(surface);
    unsigned char* const pixels = cairo_image_surface_get_data(surface);
    const int stride = cairo_image_surface_get_stride(surface);

    const Quaternion to_sphere{orientation.w, -orientation.x, -orientation.y, -orientation.z};
    const Color black{0.0, 0.0, 0.0}, white{1.0, 1.0, 1.0};
    const Pattern pattern{color, mix(color, white, 0.78), mix(color, black, 0.72),
                          1.0 / std::max(r, 1.0)};
    // The centre need not lie on a corner of the page's pixels.
    const double fx = is_vector ? 0.0 : centre.x - std::floor(centre.x),
                 fy = is_vector ? 0.0 : centre.y - std::floor(centre.y);
    for (int row = 0; row < side; ++row)
        for (int column = 0; column < side; ++column) {
            const double x = (column + 0.5 - half - fx) / r, y = -(row + 0.5 - half - fy) / r;
            const double distance = std::sqrt(x * x + y * y);
            const double opacity = std::clamp((1.0 - distance) * r + 0.5, 0.0, 1.0);
            if (opacity == 0.0) continue;
            // Pixels on the edge take the colour just inside it.
            const double shrink = distance > 0.999 ? 0.999 / distance : 1.0;
            const double nx = x * shrink, ny = y * shrink,
                         nz = std::sqrt(std::max(1.0 - nx * nx - ny * ny, 0.0));
            const Color surface_color = pattern.at(turned(to_sphere, {nx, ny, nz}));
            *reinterpret_cast<std::uint32_t*>(pixels + row * stride + 4 * column) =
                shaded(surface_color, nx, ny, nz, opacity);
        }
    cairo_surface_mark_dirty(surface);
    {
        const StyleScope scope(canvas);
        if (is_vector) {
            cairo_translate(cairo, centre.x, centre.y);
            cairo_scale(cairo, 1.0 / enlarged, 1.0 / enlarged);
            cairo_set_source_surface(cairo, surface, -half, -half);
        } else {
            cairo_set_source_surface(cairo, surface, std::floor(centre.x) - half,
                                     std::floor(centre.y) - half);
        }
        cairo_paint(cairo);
    }
    cairo_surface_destroy(surface);
}

}  // namespace swirl
