#include "swirl/vision/lens.hpp"

#include <algorithm>
#include <cmath>

#include "swirl/math/unit_circle.hpp"

namespace swirl {

namespace {

constexpr int points = 24;

/// The circle that edge points of the image of a circle are fitted by.
Lens::Circle image_of(const Lens& lens, const Lens::Circle& ideal) {
    Vec2 at[points], mean{0.0, 0.0};
    for (int k = 0; k < points; ++k) {
        at[k] = lens.seen(ideal.centre + ideal.radius * unit_circle(double(k) / points));
        mean = mean + (1.0 / points) * at[k];
    }
    // Distances from a guess: r(θ) = a + d·u to first order, as the fit has it.
    Lens::Circle image{mean, 0.0};
    for (int pass = 0; pass < 3; ++pass) {
        double a = 0.0;
        for (const Vec2& p : at) a += std::sqrt(dot(p - image.centre, p - image.centre)) / points;
        Vec2 d{0.0, 0.0};
        for (const Vec2& p : at) {
            const Vec2 r = p - image.centre;
            const double length = std::sqrt(dot(r, r));
            d = d + (2.0 / points * (length - a) / length) * r;
        }
        image.centre = image.centre + d;
        image.radius = a;
    }
    return image;
}

}  // namespace

Vec2 Lens::ideal(const Vec2& seen) const {
    const Vec2 q = seen - middle;
    return middle + (1.0 + k * dot(q, q) / (half * half)) * q;
}

Vec2 Lens::seen(const Vec2& ideal) const {
    if (k == 0.0) return ideal;
    const Vec2 p = ideal - middle;
    Vec2 q = p;
    // Newton on |q| (1 + k |q|²/h²) = |p|, along the same direction.
    const double length = std::sqrt(dot(p, p));
    if (!(length > 0.0)) return ideal;
    double r = length;
    for (int n = 0; n < 8; ++n) {
        const double s = k * r * r / (half * half), slope = 1.0 + 3.0 * s;
        if (!(slope > 0.2)) break;
        const double step = (r * (1.0 + s) - length) / slope;
        r -= step;
        if (std::abs(step) < 1e-9 * length) break;
    }
    q = (r / length) * p;
    return middle + q;
}

double Lens::seen_radius(const Vec2& seen, double radius) const {
    const Vec2 q = seen - middle;
    const double s = k * dot(q, q) / (half * half);
    return 0.5 * radius * (1.0 / (1.0 + s) + 1.0 / (1.0 + 3.0 * s));
}

Lens::Circle Lens::ideal(const Circle& seen_circle) const {
    if (k == 0.0) return seen_circle;
    Circle c{ideal(seen_circle.centre), seen_circle.radius};
    for (int n = 0; n < 6; ++n) {
        const Circle image = image_of(*this, c);
        c.centre = c.centre + (seen_circle.centre - image.centre);
        c.radius += seen_circle.radius - image.radius;
    }
    return c;
}

Lens lens_of(const std::vector<SeenSize>& sizes, const Vec2& middle, double half) {
    Lens lens{middle, half};
    if (sizes.size() < 60) return lens;
    // size = α + β q², reweighted; k = −β/2α.
    std::vector<double> weights(sizes.size(), 1.0), rests(sizes.size());
    double alpha = 1.0, beta = 0.0, error = 0.0;
    for (int pass = 0; pass < 12; ++pass) {
        double s = 0, sx = 0, sxx = 0, sy = 0, sxy = 0;
        for (std::size_t i = 0; i < sizes.size(); ++i) {
            const Vec2 q = sizes[i].centre - middle;
            const double x = dot(q, q) / (half * half), w = weights[i];
            s += w, sx += w * x, sxx += w * x * x, sy += w * sizes[i].size;
            sxy += w * x * sizes[i].size;
        }
        const double det = s * sxx - sx * sx;
        if (!(det > 1e-9 * s * sxx)) return lens;
        alpha = (sxx * sy - sx * sxy) / det;
        beta = (s * sxy - sx * sy) / det;
        std::vector<double> off;
        double square = 0.0;
        for (std::size_t i = 0; i < sizes.size(); ++i) {
            const Vec2 q = sizes[i].centre - middle;
            rests[i] = sizes[i].size - alpha - beta * dot(q, q) / (half * half);
            off.push_back(std::abs(rests[i]));
            square += weights[i] * rests[i] * rests[i];
        }
        std::nth_element(off.begin(), off.begin() + std::ptrdiff_t(off.size() / 2), off.end());
        const double scale = std::max(4.7 * 1.48 * off[off.size() / 2], 1e-6);
        error = std::sqrt(square / s * s / det);
        for (std::size_t i = 0; i < sizes.size(); ++i) {
            const double u = rests[i] / scale;
            weights[i] = std::abs(u) < 1.0 ? (1.0 - u * u) * (1.0 - u * u) : 0.0;
        }
    }
    lens.k_error = 0.5 * error / alpha;
    const double k = -0.5 * beta / alpha;
    if (std::abs(k) > 4.0 * lens.k_error && std::abs(k) > 0.002 && std::abs(k) < 0.3) lens.k = k;
    return lens;
}

}  // namespace swirl
