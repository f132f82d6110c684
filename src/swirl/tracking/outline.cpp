#include "swirl/tracking/outline.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "swirl/math/unit_circle.hpp"

namespace swirl {

namespace {

constexpr int outline_rays = 360;
constexpr double sample_step = 0.5;  // between samples, pixels
constexpr double tolerance = 1.5;    // an edge so near to the circle supports it, pixels

float level_at(const cv::Mat& picture, const Vec2& p) {
    const int column = static_cast<int>(p.x), row = static_cast<int>(p.y);
    const auto u = static_cast<float>(p.x - column), v = static_cast<float>(p.y - row);
    const float *above = picture.ptr<float>(row) + column,
                *below = picture.ptr<float>(row + 1) + column;
    return (1.0f - v) * ((1.0f - u) * above[0] + u * above[1]) +
           v * ((1.0f - u) * below[0] + u * below[1]);
}

/// On the way through `at` along `u`.
std::optional<Vec2> steepest(const cv::Mat& picture, const Vec2& at, const Vec2& u,
                             const OutlineSettings& settings, std::vector<float>& profile) {
    const int reach = static_cast<int>(std::ceil(settings.window / sample_step)) + 2;
    const auto inside = [&](const Vec2& p) {
        return p.x >= 0.0 && p.y >= 0.0 && p.x < picture.cols - 1 && p.y < picture.rows - 1;
    };
    if (!inside(at - reach * sample_step * u) || !inside(at + reach * sample_step * u)) return {};
    profile.clear();
    for (int j = -reach; j <= reach; ++j)
        profile.push_back(level_at(picture, at + (sample_step * j) * u));
    const auto slope = [&](std::size_t j) {
        return -0.5 * settings.polarity * double(profile[j + 2] - profile[j - 2]);
    };
    std::size_t best = 0;
    double maximum = settings.minimum;
    for (std::size_t j = 2; j + 2 < profile.size(); ++j)
        if (slope(j) > maximum) maximum = slope(j), best = j;
    if (best < 3 || best + 3 >= profile.size()) return {};
    const double before = slope(best - 1), after = slope(best + 1);
    const double bend = before - 2.0 * maximum + after;
    const double shift = bend < 0.0 ? 0.5 * (before - after) / bend : 0.0;
    return at + (sample_step * (double(best) - reach + std::clamp(shift, -1.0, 1.0))) * u;
}

}  // namespace

std::vector<Vec2> outline_edge(const cv::Mat& picture, const Lens& lens, const Lens::Circle& circle,
                               const OutlineSettings& settings) {
    std::vector<Vec2> edge;
    std::vector<float> profile;
    for (int k = 0; k < outline_rays; ++k) {
        const Vec2 u = unit_circle(double(k) / outline_rays);
        if (const auto p = steepest(picture, lens.seen(circle.centre + circle.radius * u), u,
                                    settings, profile))
            edge.push_back(*p);
    }
    return edge;
}

CircleFit fit_outline(const cv::Mat& picture, const Lens& lens, Lens::Circle circle,
                      const OutlineSettings& settings) {
    CircleFit fit{circle.centre, circle.radius};
    std::vector<double> off;
    double scale = settings.window;
    for (int round = 0; round < 3; ++round) {
        const std::vector<Vec2> edge = outline_edge(picture, lens, circle, settings);
        if (edge.size() < outline_rays / 10) return fit;
        for (int pass = 0; pass < 6; ++pass) {
            cv::Matx22d normal = 1e-9 * cv::Matx22d::eye();
            cv::Vec2d right(0.0, 0.0);
            off.clear();
            double square = 0.0;
            std::size_t on = 0;
            for (const Vec2& seen : edge) {
                const Vec2 d = lens.ideal(seen) - circle.centre;
                const double far = length(d), rest = far - circle.radius;
                off.push_back(std::abs(rest));
                if (std::abs(rest) < tolerance) square += rest * rest, ++on;
                const double q = rest / (3.0 * scale);
                if (q * q >= 1.0) continue;
                const double w = (1.0 - q * q) * (1.0 - q * q);
                const cv::Vec2d row(d.x / far, d.y / far);
                normal += w * (row * row.t());
                right += w * rest * row;
            }
            const cv::Matx22d inverse = normal.inv();
            const cv::Vec2d moved = inverse * right;
            circle.centre = circle.centre + Vec2{moved[0], moved[1]};
            scale = std::clamp(1.4826 * median(off), 0.15, settings.window);
            fit.support = double(on) / outline_rays;
            fit.residual = on > 2 ? std::sqrt(square / double(on - 2)) : 0.0;
            fit.error = fit.residual * std::sqrt(0.5 * (inverse(0, 0) + inverse(1, 1)));
        }
    }
    const Lens::Circle image = lens.image(circle);
    fit.centre = image.centre;
    fit.radius = image.radius;
    fit.good = true;
    return fit;
}

}  // namespace swirl
