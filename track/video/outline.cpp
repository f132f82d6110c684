#include "track/video/outline.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "swirl/math/unit_circle.hpp"
#include "track/video/robust_statistics.hpp"

namespace swirl::tracking {

namespace {

constexpr int outline_rays = 360;

/// The brightness at p, interpolated linearly between pixels.
float level_at(const cv::Mat& image, const Vec2& p) {
    const int column = static_cast<int>(p.x), row = static_cast<int>(p.y);
    const auto u = static_cast<float>(p.x - column), v = static_cast<float>(p.y - row);
    const float *above = image.ptr<float>(row) + column,
                *below = image.ptr<float>(row + 1) + column;
    return (1.0f - v) * ((1.0f - u) * above[0] + u * above[1]) +
           v * ((1.0f - u) * below[0] + u * below[1]);
}

/// The steepest point on the line through `at` along `u`; `profile` is memory for the samples.
std::optional<Vec2> steepest_point(const cv::Mat& image, const Vec2& at, const Vec2& u,
                                   const OutlineSettings& settings, std::vector<float>& profile) {
    constexpr double spacing = 0.5;  // spacing between samples, pixels
    const int reach = static_cast<int>(std::ceil(settings.window / spacing)) + 2;
    const auto inside = [&](const Vec2& p) {
        return p.x >= 0.0 && p.y >= 0.0 && p.x < image.cols - 1 && p.y < image.rows - 1;
    };
    if (!inside(at - reach * spacing * u) || !inside(at + reach * spacing * u)) return {};
    profile.clear();
    for (int j = -reach; j <= reach; ++j)
        profile.push_back(level_at(image, at + (spacing * j) * u));
    const auto slope = [&](std::size_t j) {
        return -0.5 * settings.polarity * double(profile[j + 2] - profile[j - 2]);
    };
    std::size_t best = 0;
    double maximum = settings.minimum;
    for (std::size_t j = 2; j + 2 < profile.size(); ++j)
        if (slope(j) > maximum) maximum = slope(j), best = j;
    if (best < 3 || best + 3 >= profile.size()) return {};
    const double shift = vertex_offset(slope(best - 1), maximum, slope(best + 1));
    return at + (spacing * (double(best) - reach + std::clamp(shift, -1.0, 1.0))) * u;
}

}  // namespace

std::vector<Vec2> outline_edge(const cv::Mat& image, const Lens& lens, const Lens::Circle& circle,
                               const OutlineSettings& settings) {
    std::vector<Vec2> edge;
    std::vector<float> profile;
    for (int k = 0; k < outline_rays; ++k) {
        const Vec2 u = unit_circle(double(k) / outline_rays);
        if (const auto p = steepest_point(image, lens.seen(circle.centre + circle.radius * u), u,
                                          settings, profile))
            edge.push_back(*p);
    }
    return edge;
}

CircleFit fit_outline(const cv::Mat& image, const Lens& lens, Lens::Circle circle,
                      const OutlineSettings& settings) {
    constexpr int rounds = 3, passes = 6;  // rounds of edge search; passes of reweighting in each
    constexpr std::size_t min_edge = outline_rays / 10;
    constexpr double tolerance = 1.5;  // an edge this close supports the circle, pixels
    constexpr double cutoff = 3.0, min_scale = 0.15;  // standard deviations; pixels
    constexpr double regularisation = 1e-9;           // keeps the matrix invertible without edges
    CircleFit fit{circle.centre, circle.radius};
    std::vector<double> off;
    double scale = settings.window;
    for (int round = 0; round < rounds; ++round) {
        const std::vector<Vec2> edge = outline_edge(image, lens, circle, settings);
        if (edge.size() < min_edge) return fit;
        for (int pass = 0; pass < passes; ++pass) {
            cv::Matx22d normal = regularisation * cv::Matx22d::eye();
            cv::Vec2d right(0.0, 0.0);
            off.clear();
            double square = 0.0;
            std::size_t on = 0;
            for (const Vec2& seen : edge) {
                const Vec2 d = lens.ideal(seen) - circle.centre;
                const double distance = length(d), residual = distance - circle.radius;
                off.push_back(std::abs(residual));
                if (std::abs(residual) < tolerance) square += residual * residual, ++on;
                const double w = tukey_weight(residual / (cutoff * scale));
                if (w == 0.0) continue;
                const cv::Vec2d row(d.x / distance, d.y / distance);
                normal += w * (row * row.t());
                right += w * residual * row;
            }
            const cv::Matx22d inverse = normal.inv();
            const cv::Vec2d moved = inverse * right;
            circle.centre = circle.centre + Vec2{moved[0], moved[1]};
            scale = std::clamp(mad_to_sigma * median(off), min_scale, settings.window);
            fit.support = double(on) / outline_rays;
            fit.residual = on > 2 ? std::sqrt(square / double(on - 2)) : 0.0;
            fit.error = fit.residual * std::sqrt(0.5 * (inverse(0, 0) + inverse(1, 1)));
        }
    }
    const Lens::Circle image_circle = lens.image(circle);
    fit.centre = image_circle.centre;
    fit.radius = image_circle.radius;
    fit.good = true;
    return fit;
}

}  // namespace swirl::tracking
