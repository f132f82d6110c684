#include "track/video/container_path_fit.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "swirl/math/unit_circle.hpp"
#include "track/video/circles.hpp"
#include "track/video/robust_statistics.hpp"

namespace swirl::tracking {

PathCircle circle_through(const std::vector<Vec2>& points) {
    constexpr int passes = 8;            // passes of reweighting
    constexpr double far_ratio = 4.0;    // median distances from the middle: no point of the circle
    constexpr double most_points = 0.9;  // share of the points
    constexpr double cutoff = 4.5, min_cutoff = 0.2;  // standard deviations; pixels
    std::vector<double> weights, distances;
    const Vec2 origin = median_point(points);
    // The equations have squares of the distances, so one far outlier would decide the first pass.
    for (const Vec2& p : points) distances.push_back(length(p - origin));
    // While the container rests, its centre stays at one point of the circle, perhaps in most
    // frames.
    const double middle = median(distances);
    const double far =
        far_ratio * (middle > min_path_amplitude ? middle : quantile(distances, most_points));
    for (const double d : distances) weights.push_back(d <= far ? 1.0 : 0.0);
    PathCircle circle;
    for (int pass = 0; pass < passes; ++pass) {
        cv::Matx33d m = cv::Matx33d::zeros();
        cv::Vec3d b(0.0, 0.0, 0.0);
        for (std::size_t k = 0; k < points.size(); ++k) {
            const Vec2 p = points[k] - origin;
            const cv::Vec3d row(2.0 * p.x, 2.0 * p.y, 1.0);
            m += weights[k] * (row * row.t());
            b += weights[k] * dot(p, p) * row;
        }
        cv::Vec3d x;
        if (!cv::solve(cv::Mat(m), cv::Mat(b), cv::Mat(x, false), cv::DECOMP_SVD)) break;
        circle.centre = origin + Vec2{x[0], x[1]};
        circle.radius = std::sqrt(std::max(0.0, x[2] + x[0] * x[0] + x[1] * x[1]));
        std::vector<double> off;
        for (const Vec2& p : points)
            off.push_back(std::abs(length(p - circle.centre) - circle.radius));
        circle.scatter = median(off);
        const double scale = std::max(cutoff * mad_to_sigma * circle.scatter, min_cutoff);
        for (std::size_t k = 0; k < points.size(); ++k) weights[k] = tukey_weight(off[k] / scale);
    }
    return circle;
}

Vec2 TrackedPath::at(double time) const {
    const double turn = angle(time);
    return {centre.x + amplitude * std::cos(turn), centre.y - amplitude * std::sin(turn)};
}

namespace {

constexpr std::size_t min_path_centres = 8;  // five parameters, and three to judge them by

/// The circle, and a straight line through the angles of the centres about it.
std::optional<TrackedPath> initial_path(const std::vector<Vec2>& centres,
                                        const std::vector<double>& times) {
    constexpr double max_scatter = 0.2;                   // share of the radius
    constexpr double outlier = 6.0, outlier_share = 0.3;  // scatters; of the radius
    const PathCircle circle = circle_through(centres);
    if (!(circle.radius > min_path_amplitude) || circle.scatter > max_scatter * circle.radius)
        return std::nullopt;
    // Angles are unwrapped from frame to frame. Outliers are omitted, since one of them could add a
    // whole turn to all later angles.
    const double max_off = std::max(outlier * circle.scatter, outlier_share * circle.radius);
    std::vector<double> angles, when;
    double last = 0.0, unwrapped = 0.0;
    for (std::size_t k = 0; k < centres.size(); ++k) {
        const Vec2 d = centres[k] - circle.centre;
        if (std::abs(length(d) - circle.radius) > max_off) continue;
        const double now = std::atan2(-d.y, d.x);
        if (angles.empty())
            unwrapped = now;
        else
            unwrapped += std::remainder(now - last, 2.0 * pi);
        last = now;
        angles.push_back(unwrapped);
        when.push_back(times[k]);
    }
    if (angles.size() < min_path_centres) return std::nullopt;
    double st = 0, sa = 0, stt = 0, sta = 0;
    const double m = double(angles.size());
    for (std::size_t k = 0; k < angles.size(); ++k) {
        st += when[k], sa += angles[k];
        stt += when[k] * when[k], sta += when[k] * angles[k];
    }
    const double rate = (m * sta - st * sa) / (m * stt - st * st);
    if (!(std::abs(rate) > 0.0)) return std::nullopt;
    TrackedPath path;
    path.centre = circle.centre, path.amplitude = circle.radius;
    path.clockwise = rate < 0.0, path.omega = std::abs(rate);
    path.phase = (sa - rate * st) / m;
    path.residual = circle.scatter;
    return path;
}

/// Gauss–Newton for S, A, φ and Ω together. Nothing if the fit fails or is too poor.
std::optional<TrackedPath> refined(TrackedPath path, const std::vector<Vec2>& centres,
                                   const std::vector<double>& times) {
    constexpr double min_span = 1e-12;  // keeps the scaled time finite
    // Pixels: start with all but gross outliers; exact centres would give 0.
    constexpr double first_scale = 0.5, min_scale = 0.05;
    constexpr double cutoff = 4.7;  // standard deviations, 95 % efficient
    constexpr int max_passes = 25, min_passes = 5;
    constexpr double settled = 1e-7;    // pixels, centre and amplitude together
    constexpr double min_weight = 5.0;  // the sum of weights: one for each parameter
    constexpr double min_used = 0.5;    // share of the frames: fewer may be another motion
    constexpr double max_error = 0.05;  // share of the amplitude
    using Matrix = cv::Matx<double, 5, 5>;
    using Vector = cv::Vec<double, 5>;
    const double sign = path.clockwise ? -1.0 : 1.0, origin = times.front(),
                 span = std::max(times.back() - times.front(), min_span);
    double scale = std::max(path.residual, first_scale), moved = settled;
    Matrix inverse = Matrix::zeros();
    for (int pass = 0; pass < max_passes && !(pass > min_passes + 1 && moved < settled); ++pass) {
        Matrix normal = Matrix::zeros();
        Vector right = Vector::all(0.0);
        std::vector<double> off;
        double weight_sum = 0.0;
        for (std::size_t k = 0; k < centres.size(); ++k) {
            const double turn = path.angle(times[k]);
            const Vec2 u{std::cos(turn), -std::sin(turn)};   // radial, y down
            const Vec2 v{-std::sin(turn), -std::cos(turn)};  // derivative of u
            const Vec2 residual = centres[k] - path.at(times[k]);
            off.push_back(length(residual));
            const double w = tukey_weight(off.back() / (cutoff * scale));
            if (w == 0.0) continue;
            weight_sum += w;
            const double t = sign * (times[k] - origin) / span;
            const Vector jx(1.0, 0.0, u.x, path.amplitude * v.x, path.amplitude * v.x * t);
            const Vector jy(0.0, 1.0, u.y, path.amplitude * v.y, path.amplitude * v.y * t);
            normal += w * (jx * jx.t() + jy * jy.t());
            right += w * (residual.x * jx + residual.y * jy);
        }
        if (weight_sum < min_weight) return std::nullopt;
        inverse = normal.inv(cv::DECOMP_SVD);
        const Vector d = inverse * right;
        path.centre = path.centre + Vec2{d[0], d[1]};
        path.amplitude += d[2];
        path.omega += d[4] / span;
        // The angle at the origin of the times changes by d[3], and the slope about it by d[4].
        path.phase += d[3] - sign * d[4] / span * origin;
        // Weighted squares would give too small a value, since the weights favour small residuals.
        path.residual = median(off) / length_median;
        scale = std::max(path.residual, min_scale);
        const auto used =
            std::count_if(off.begin(), off.end(), [&](double o) { return o < cutoff * scale; });
        path.used = double(used) / double(centres.size());
        moved = std::abs(d[0]) + std::abs(d[1]) + std::abs(d[2]);
    }
    const auto error = [&](int k) {
        return path.residual * std::sqrt(std::max(0.0, inverse(k, k)));
    };
    path.centre_error = std::max(error(0), error(1)), path.amplitude_error = error(2);
    path.phase_error = error(3), path.omega_error = error(4) / span;
    path.phase = std::remainder(path.phase, 2.0 * pi);
    if (path.used < min_used || path.amplitude_error > max_error * path.amplitude)
        return std::nullopt;
    return path;
}

}  // namespace

std::optional<TrackedPath> fit_container_path(const std::vector<Vec2>& centres,
                                              const std::vector<double>& times) {
    if (centres.size() < min_path_centres) return std::nullopt;
    const std::optional<TrackedPath> start = initial_path(centres, times);
    return start ? refined(*start, centres, times) : std::nullopt;
}

}  // namespace swirl::tracking
