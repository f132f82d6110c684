#include "swirl/tracking/lens.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "swirl/math/unit_circle.hpp"

namespace swirl {

namespace {

constexpr int points = 24;

/// S = 1 less e along its direction.
struct Squeeze {
    double xx, xy, yy;
    explicit Squeeze(const Vec2& w) {
        const double half = 0.5 * std::sqrt(dot(w, w));
        xx = 1.0 - half - 0.5 * w.x, yy = 1.0 - half + 0.5 * w.x, xy = -0.5 * w.y;
    }
    Vec2 of(const Vec2& p) const { return {xx * p.x + xy * p.y, xy * p.x + yy * p.y}; }
    Vec2 undone(const Vec2& q) const {
        const double area = xx * yy - xy * xy;
        return {(yy * q.x - xy * q.y) / area, (xx * q.y - xy * q.x) / area};
    }
};

}  // namespace

Vec2 Lens::ideal(const Vec2& seen) const {
    const Vec2 q = seen - middle;
    const Vec2 straight = (1.0 + k * dot(q, q) / (half * half)) * q;
    if (!tilted()) return middle + straight;
    const Vec2 p = Squeeze(squeeze).undone(straight);
    return middle + (1.0 / (1.0 - dot(perspective, p))) * p;
}

Vec2 Lens::seen(const Vec2& ideal) const {
    if (k == 0.0 && !tilted()) return ideal;
    Vec2 p = ideal - middle;
    if (tilted()) p = (1.0 / (1.0 + dot(perspective, p))) * Squeeze(squeeze).of(p);
    Vec2 q = p;
    // Newton on |q| (1 + k |q|²/h²) = |p|, along the same direction.
    const double length = std::sqrt(dot(p, p));
    if (!(length > 0.0)) return middle;
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

Lens::Circle Lens::image(const Circle& ideal) const {
    Vec2 at[points], mean{0.0, 0.0};
    for (int k = 0; k < points; ++k) {
        at[k] = seen(ideal.centre + ideal.radius * unit_circle(double(k) / points));
        mean = mean + (1.0 / points) * at[k];
    }
    // Distances from a guess: r(θ) = a + d·u to first order, as the fit has it.
    Circle image{mean, 0.0};
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

double Lens::seen_radius(const Vec2& seen, double radius) const {
    const Vec2 q = seen - middle;
    const double s = k * dot(q, q) / (half * half);
    // Nearer balls are larger, and so are those away from the axis.
    const double size = tilted() ? 1.0 / (1.0 + dot(perspective, ideal(seen) - middle)) : 1.0;
    const double longer = 1.0 + 0.25 * nearness * nearness * dot(q, q);
    return 0.5 * size * longer * radius * (1.0 / (1.0 + s) + 1.0 / (1.0 + 3.0 * s));
}

Lens::Circle Lens::ideal(const Circle& seen_circle) const {
    if (k == 0.0 && !tilted()) return seen_circle;
    Circle c{ideal(seen_circle.centre), seen_circle.radius};
    for (int n = 0; n < 6; ++n) {
        const Circle seen_now = image(c);
        c.centre = c.centre + (seen_circle.centre - seen_now.centre);
        c.radius += seen_circle.radius - seen_now.radius;
    }
    return c;
}

void Lens::settle_distortion() {
    // Of the radius of a ball: what shade and texture do to it in one place more than in another.
    constexpr double size_misleads = 0.1;  // pixels
    // Standard errors.
    constexpr double contradicts = 3.0, supports = 1.5, stands_out = 4.0, with_contacts = 3.0;
    constexpr double not_available = 0.01, min_seen = 0.002, max_possible = 0.3;  // of k
    const double hidden = nearness * half * nearness * half / 8.0, by_sizes = apparent_k + hidden;
    double whole = by_sizes;
    k_error = std::hypot(apparent_k_error, ball > 0.0 ? size_misleads / ball : 0.0);
    bool seen = std::abs(whole) > stands_out * k_error;
    if (contact_error > 0.0) {
        const double off = std::abs(by_sizes - contact_k);
        const bool agree = off < contradicts * std::hypot(k_error, contact_error);
        const double sizes = agree ? 1.0 / (k_error * k_error) : 0.0,
                     contacts = 1.0 / (contact_error * contact_error);
        whole = (sizes * by_sizes + contacts * contact_k) / (sizes + contacts);
        k_error = 1.0 / std::sqrt(sizes + contacts);
        seen = std::abs(whole) > with_contacts * k_error;
        // A distortion that is too weak to stand out so is believed as sizes have it where contacts
        // side with them rather than with no distortion: balls that look alike all over the dish
        // know it better.
        if (!seen && std::abs(by_sizes) > stands_out * apparent_k_error &&
            off < supports * contact_error && off < std::abs(contact_k)) {
            whole = by_sizes;
            seen = true;
        }
    }
    const bool possible = std::abs(whole) > min_seen && std::abs(whole) < max_possible;
    k = seen && possible && k_error < not_available ? whole : 0.0;
}

Lens lens_of(const std::vector<SeenSize>& sizes, const Vec2& middle, double half) {
    Lens lens{middle, half};
    if (sizes.size() < 60) return lens;
    // size = α + β q² + γ·q, reweighted; k = −β/2α, and γ is that of a tilt.
    std::vector<double> weights(sizes.size(), 1.0), rests(sizes.size());
    cv::Vec4d fit;
    double error = 0.0, slope_error = 0.0;
    const auto row_of = [&](const SeenSize& seen) {
        const Vec2 q = (1.0 / half) * (seen.centre - middle);
        return cv::Vec4d(1.0, dot(q, q), q.x, q.y);
    };
    for (int pass = 0; pass < 12; ++pass) {
        cv::Matx44d normal = cv::Matx44d::zeros();
        cv::Vec4d right(0.0, 0.0, 0.0, 0.0);
        double sum = 0.0;
        for (std::size_t i = 0; i < sizes.size(); ++i) {
            const cv::Vec4d row = row_of(sizes[i]);
            normal += weights[i] * (row * row.t());
            right += weights[i] * sizes[i].size * row;
            sum += weights[i];
        }
        bool solved = false;
        const cv::Matx44d inverse = normal.inv(cv::DECOMP_CHOLESKY, &solved);
        if (!solved) return lens;
        fit = inverse * right;
        std::vector<double> off;
        double square = 0.0;
        for (std::size_t i = 0; i < sizes.size(); ++i) {
            rests[i] = sizes[i].size - row_of(sizes[i]).dot(fit);
            off.push_back(std::abs(rests[i]));
            square += weights[i] * rests[i] * rests[i];
        }
        std::nth_element(off.begin(), off.begin() + std::ptrdiff_t(off.size() / 2), off.end());
        const double scale = std::max(4.7 * 1.48 * off[off.size() / 2], 1e-6);
        error = std::sqrt(square / sum * std::max(0.0, inverse(1, 1)));
        slope_error = std::sqrt(square / sum * std::max({0.0, inverse(2, 2), inverse(3, 3)}));
        for (std::size_t i = 0; i < sizes.size(); ++i) {
            const double u = rests[i] / scale;
            weights[i] = std::abs(u) < 1.0 ? (1.0 - u * u) * (1.0 - u * u) : 0.0;
        }
    }
    lens.apparent_k_error = 0.5 * error / fit[0];
    lens.apparent_perspective = (-1.0 / fit[0] / half) * Vec2{fit[2], fit[3]};
    lens.apparent_error = slope_error / fit[0] / half;
    lens.apparent_k = -0.5 * fit[1] / fit[0];
    lens.settle_distortion();
    return lens;
}

}  // namespace swirl
