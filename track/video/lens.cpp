#include "track/video/lens.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "swirl/math/median.hpp"
#include "swirl/math/unit_circle.hpp"
#include "track/video/robust_statistics.hpp"

namespace swirl::tracking {

namespace {

/// S: the identity, less e along its direction.
struct Squeeze {
    double xx, xy, yy;
    explicit Squeeze(const Vec2& w) {
        const double half = 0.5 * std::sqrt(dot(w, w));
        xx = 1.0 - half - 0.5 * w.x, yy = 1.0 - half + 0.5 * w.x, xy = -0.5 * w.y;
    }
    Vec2 apply(const Vec2& p) const { return {xx * p.x + xy * p.y, xy * p.x + yy * p.y}; }
    Vec2 invert(const Vec2& q) const {
        const double area = xx * yy - xy * xy;
        return {(yy * q.x - xy * q.y) / area, (xx * q.y - xy * q.x) / area};
    }
};

}  // namespace

Lens Lens::in_frame(const Vec2& centre, const Vec2& way) const {
    Lens lens = *this;
    lens.pivot = centre;
    lens.arm = way;
    return lens;
}

Vec2 Lens::rolled(const Vec2& seen) const {
    if (!(dot(arm, arm) > 0.0)) return {0.0, 0.0};
    const double angle = dot(shutter, seen - pivot);
    return (std::cos(angle) - 1.0) * arm + std::sin(angle) * perpendicular(arm);
}

Vec2 Lens::ideal(const Vec2& seen) const {
    const Vec2 q = seen - rolled(seen) - image_centre;
    const Vec2 straight = (1.0 + k * dot(q, q) / (half_height * half_height)) * q;
    if (!tilted()) return image_centre + straight;
    const Vec2 p = Squeeze(squeeze).invert(straight);
    return image_centre + (1.0 / (1.0 - dot(perspective, p))) * p;
}

Vec2 Lens::seen(const Vec2& ideal) const {
    constexpr int max_steps = 8;        // steps of Newton's method, which doubles the digits
    constexpr double min_slope = 0.2;   // slope at 0 the distortion folds the image over
    constexpr double precision = 1e-9;  // relative
    if (k == 0.0 && !tilted() && !rolls()) return ideal;
    Vec2 p = ideal - image_centre;
    if (tilted()) p = (1.0 / (1.0 + dot(perspective, p))) * Squeeze(squeeze).apply(p);
    // Newton's method for |q| (1 + k |q|²/h²) = |p|; q has the direction of p.
    const double length = std::sqrt(dot(p, p));
    if (!(length > 0.0)) return image_centre;
    double r = length;
    for (int n = 0; n < max_steps; ++n) {
        const double s = k * r * r / (half_height * half_height), slope = 1.0 + 3.0 * s;
        if (!(slope > min_slope)) break;
        const double step = (r * (1.0 + s) - length) / slope;
        r -= step;
        if (std::abs(step) < precision * length) break;
    }
    const Vec2 q = image_centre + (r / length) * p;
    Vec2 way = rolled(q);
    for (int n = 0; n < max_steps && dot(arm, arm) > 0.0; ++n) way = rolled(q + way);
    return q + way;
}

Lens::Circle Lens::image(const Circle& ideal) const {
    constexpr int points = 24, passes = 3;  // the fit errs by less than 0.03 pixels at k = 0.03
    Vec2 at[points], mean{0.0, 0.0};
    for (int k = 0; k < points; ++k) {
        at[k] = seen(ideal.centre + ideal.radius * unit_circle(double(k) / points));
        mean = mean + (1.0 / points) * at[k];
    }
    // Distances from an initial estimate of the centre are r(θ) = a + d·u to first order.
    Circle image{mean, 0.0};
    for (int pass = 0; pass < passes; ++pass) {
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
    const Vec2 q = seen - image_centre;
    const double s = k * dot(q, q) / (half_height * half_height);
    // Near balls look larger.
    const double size = tilted() ? 1.0 / (1.0 + dot(perspective, ideal(seen) - image_centre)) : 1.0;
    return 0.5 * size * radius * (1.0 / (1.0 + s) + 1.0 / (1.0 + 3.0 * s));
}

Lens::Circle Lens::ideal(const Circle& seen_circle) const {
    if (k == 0.0 && !tilted()) return seen_circle;
    constexpr int passes = 6;  // passes of a fixed-point iteration; the correction is small
    Circle c{ideal(seen_circle.centre), seen_circle.radius};
    for (int n = 0; n < passes; ++n) {
        const Circle seen_now = image(c);
        c.centre = c.centre + (seen_circle.centre - seen_now.centre);
        c.radius += seen_circle.radius - seen_now.radius;
    }
    return c;
}

void Lens::combine_distortions() {
    // Shade and texture change the apparent radius of a ball by this much, by an amount that varies
    // over the container; pixels.
    constexpr double size_bias = 0.1;
    // In standard errors: the two contradict each other; contacts support the sizes; k is not 0, by
    // sizes alone; k is not 0, by both. A distortion moves all positions, and shade and a near
    // camera make k too small (lens.hpp). So a negative one needs more evidence: that of steel
    // balls in a video without a lens was 3.7 errors, and that of contacts alone 8.7 at a contrast
    // of 1.3:1, where sizes show nothing.
    constexpr double contradicts = 3.0, supports = 1.5, stands_out = 4.0, both_stand_out = 3.0,
                     negative_stands_out = 5.0;
    constexpr double max_k_error = 0.01, min_k = 0.002,
                     max_k = 0.3;  // limits of a correction
    double combined = size_k;
    k_error = std::hypot(size_k_error, ball_radius > 0.0 ? size_bias / ball_radius : 0.0);
    bool detected = std::abs(combined) > stands_out * k_error;
    if (contact_k_error > 0.0) {
        const double off = std::abs(size_k - contact_k);
        const bool agree = off < contradicts * std::hypot(k_error, contact_k_error);
        const double size_weight = agree ? 1.0 / (k_error * k_error) : 0.0,
                     contact_weight = 1.0 / (contact_k_error * contact_k_error);
        combined =
            (size_weight * size_k + contact_weight * contact_k) / (size_weight + contact_weight);
        k_error = 1.0 / std::sqrt(size_weight + contact_weight);
        detected = combined > both_stand_out * k_error ||
                   (agree && -combined > negative_stands_out * k_error);
        // A weak distortion is taken from the sizes alone if contacts are closer to it than to no
        // distortion: balls that look alike all over the container determine it better.
        if (!detected && size_k > stands_out * size_k_error && off < supports * contact_k_error &&
            off < std::abs(contact_k)) {
            combined = size_k;
            detected = true;
        }
    }
    const bool plausible = std::abs(combined) > min_k && std::abs(combined) < max_k;
    k = detected && plausible && k_error < max_k_error ? combined : 0.0;
}

Lens fit_lens(const std::vector<ApparentSize>& sizes, const Vec2& image_centre,
              double half_height) {
    constexpr std::size_t min_sizes = 60;  // fewer do not cover the container
    constexpr int passes = 12;             // passes of reweighting
    constexpr double cutoff = 4.7 * 1.48;  // of Tukey's weights, median absolute deviations
    constexpr double min_scale = 1e-6;     // scale of exact sizes, relative
    Lens lens{image_centre, half_height};
    if (sizes.size() < min_sizes) return lens;
    // size = α + β q² + γ·q, reweighted. Then k = −β/2α, and γ is that of a tilt.
    std::vector<double> weights(sizes.size(), 1.0), residuals(sizes.size());
    cv::Vec4d fit;
    double error = 0.0, slope_error = 0.0;
    const auto row_of = [&](const ApparentSize& seen) {
        const Vec2 q = (1.0 / half_height) * (seen.centre - image_centre);
        return cv::Vec4d(1.0, dot(q, q), q.x, q.y);
    };
    for (int pass = 0; pass < passes; ++pass) {
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
            residuals[i] = sizes[i].size - row_of(sizes[i]).dot(fit);
            off.push_back(std::abs(residuals[i]));
            square += weights[i] * residuals[i] * residuals[i];
        }
        const double scale = std::max(cutoff * median(off), min_scale);
        error = std::sqrt(square / sum * std::max(0.0, inverse(1, 1)));
        slope_error = std::sqrt(square / sum * std::max({0.0, inverse(2, 2), inverse(3, 3)}));
        for (std::size_t i = 0; i < sizes.size(); ++i)
            weights[i] = tukey_weight(residuals[i] / scale);
    }
    lens.size_k_error = 0.5 * error / fit[0];
    lens.size_perspective = (-1.0 / fit[0] / half_height) * Vec2{fit[2], fit[3]};
    lens.size_perspective_error = slope_error / fit[0] / half_height;
    lens.size_k = -0.5 * fit[1] / fit[0];
    lens.combine_distortions();
    return lens;
}

}  // namespace swirl::tracking
