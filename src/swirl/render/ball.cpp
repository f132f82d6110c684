#include "swirl/render/ball.hpp"

#include <algorithm>
#include <cmath>

#include "swirl/render/image.hpp"

namespace swirl {
namespace {

/// From 0 to 1 where u goes through 0, over a width of 2 `soft`.
double step_at(double u, double soft) { return std::clamp(0.5 + 0.5 * u / soft, 0.0, 1.0); }

/// −1 or 1, with a soft edge.
double sign_of(double u, double soft) { return 2.0 * step_at(u, soft) - 1.0; }

struct Pattern {
    Color dark, pale, pole;
    double soft;  // half the width of an edge, in radii: a pixel

    Color at(const Direction& d) const {
        const double patch = sign_of(d.x, soft) * sign_of(d.y, soft) * sign_of(d.z, soft);
        const Color body = mix(dark, pale, 0.5 + 0.5 * patch);
        constexpr double cap = 0.93;  // of the distance from the centre: 21° about the pole
        return mix(body, pole, step_at(std::abs(d.z) - cap, 0.4 * soft + 1e-3));
    }
};

}  // namespace

void draw_ball(const Canvas& canvas, const Vec2& centre, double radius, const Color& color,
               const Quaternion& turned_to) {
    // So many pixels of its own as on the page; in a file of vectors enough for print.
    const bool vectors =
        cairo_surface_get_type(cairo_get_target(canvas.cairo())) != CAIRO_SURFACE_TYPE_IMAGE;
    const double fine = vectors ? std::max(1.0, 64.0 / std::max(radius, 1.0)) : 1.0;
    const double r = radius * fine;
    const int half = static_cast<int>(std::ceil(r)) + 1, side = 2 * half;
    cairo_surface_t* const surface = cairo_image_surface_create(CAIRO_FORMAT_ARGB32, side, side);
    if (cairo_surface_status(surface) != CAIRO_STATUS_SUCCESS)
        throw DrawFailure("There is no memory for the picture of a sphere.");
    cairo_surface_flush(surface);
    unsigned char* const pixels = cairo_image_surface_get_data(surface);
    const int stride = cairo_image_surface_get_stride(surface);

    // Back into the sphere's own axes.
    const Quaternion back{turned_to.w, -turned_to.x, -turned_to.y, -turned_to.z};
    const Color black{0.0, 0.0, 0.0}, white{1.0, 1.0, 1.0};
    const Pattern pattern{color, mix(color, white, 0.78), mix(color, black, 0.72),
                          1.0 / std::max(r, 1.0)};
    // Towards the light: upper left, above the page. Halfway between it and the eye shines.
    constexpr double lx = -0.45, ly = 0.55, lz = 0.70;
    const double hn = std::sqrt(lx * lx + ly * ly + (lz + 1.0) * (lz + 1.0));
    // On the page the centre need not lie on a corner of pixels.
    const double fx = vectors ? 0.0 : centre.x - std::floor(centre.x),
                 fy = vectors ? 0.0 : centre.y - std::floor(centre.y);
    for (int row = 0; row < side; ++row)
        for (int column = 0; column < side; ++column) {
            const double x = (column + 0.5 - half - fx) / r, y = -(row + 0.5 - half - fy) / r;
            const double away = std::sqrt(x * x + y * y);
            const double inside = std::clamp((1.0 - away) * r + 0.5, 0.0, 1.0);
            if (inside == 0.0) continue;
            const double shrink = away > 0.999 ? 0.999 / away : 1.0;
            const double nx = x * shrink, ny = y * shrink,
                         nz = std::sqrt(std::max(1.0 - nx * nx - ny * ny, 0.0));
            const Color surface_color = pattern.at(turned(back, {nx, ny, nz}));
            const double facing = std::max(nx * lx + ny * ly + nz * lz, 0.0);
            const double light = 0.38 + 0.67 * facing;
            const double glint =
                std::pow(std::max((nx * lx + ny * ly + nz * (lz + 1.0)) / hn, 0.0), 60.0);
            const auto byte = [&](double channel) {
                const double lit = std::min(channel * light + 0.55 * glint, 1.0);
                return static_cast<unsigned char>(std::lround(255.0 * lit * inside));
            };
            unsigned char* const p = pixels + row * stride + 4 * column;
            const std::uint32_t word =
                static_cast<std::uint32_t>(std::lround(255.0 * inside)) << 24 |
                std::uint32_t{byte(surface_color.red)} << 16 |
                std::uint32_t{byte(surface_color.green)} << 8 | byte(surface_color.blue);
            *reinterpret_cast<std::uint32_t*>(p) = word;
        }
    cairo_surface_mark_dirty(surface);
    cairo_t* const cairo = canvas.cairo();
    cairo_save(cairo);
    if (vectors) {
        cairo_translate(cairo, centre.x, centre.y);
        cairo_scale(cairo, 1.0 / fine, 1.0 / fine);
        cairo_set_source_surface(cairo, surface, -half, -half);
    } else {
        cairo_set_source_surface(cairo, surface, std::floor(centre.x) - half,
                                 std::floor(centre.y) - half);
    }
    cairo_paint(cairo);
    cairo_restore(cairo);
    cairo_surface_destroy(surface);
}

}  // namespace swirl
