// Snapshots to draw, and access to the pixels drawn.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "swirl/math/unit_circle.hpp"
#include "swirl/physics/snapshot.hpp"
#include "swirl/render/canvas.hpp"
#include "swirl/render/color.hpp"

namespace swirl {

/// The paper's container (radius 8.6, amplitude 1.892) at the given phase, in turns.
inline Snapshot container(double turns) {
    Snapshot s;
    s.period = 12.0;
    s.clock = turns * s.period;
    s.container_centre = 1.892 * unit_circle(turns);
    s.container_velocity = (1.892 * 2.0 * pi / s.period) * perpendicular(unit_circle(turns));
    s.container_radius = 8.6;
    return s;
}

inline void add_disc(Snapshot& s, const Vec2& position, double angle = 0.0, double radius = 1.0,
                     double spin = 0.0) {
    s.resize(s.size() + 1);
    s.set(s.size() - 1, {position, {0.0, 0.0}, angle, spin, s.clock, radius, 1.0, 10.0});
}

struct Pixel {
    int red, green, blue;
};

inline Pixel pixel(Canvas& canvas, int x, int y) {
    const auto bytes = canvas.pixels();
    const std::size_t at = 4 * (static_cast<std::size_t>(y) * canvas.size().width + x);
    return {bytes[at + 2], bytes[at + 1], bytes[at]};
}

inline Pixel pixel(Canvas& canvas, const Vec2& position) {
    return pixel(canvas, static_cast<int>(position.x), static_cast<int>(position.y));
}

/// True if each component differs by at most one of 255 levels.
inline bool is(const Pixel& p, const Color& c) {
    return std::abs(p.red - 255.0 * c.red) <= 1.0 && std::abs(p.green - 255.0 * c.green) <= 1.0 &&
           std::abs(p.blue - 255.0 * c.blue) <= 1.0;
}

struct Patch {
    double count = 0.0;
    Vec2 middle{0.0, 0.0};
};

/// Number and centroid of all pixels of one colour.
inline Patch patch_of(Canvas& canvas, const Color& color) {
    Patch patch;
    for (int y = 0; y < canvas.size().height; ++y)
        for (int x = 0; x < canvas.size().width; ++x)
            if (is(pixel(canvas, x, y), color)) {
                patch.count += 1.0;
                patch.middle = patch.middle + Vec2{x + 0.5, y + 0.5};
            }
    if (patch.count > 0.0) patch.middle = (1.0 / patch.count) * patch.middle;
    return patch;
}

}  // namespace swirl
