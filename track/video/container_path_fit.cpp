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
    // While the container rests, its centre stays at one point of the circle, perhaps in most frames.
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
    path.centre = circle.centre;
    path.amplitude = circle.radius;
    path.clockwise = rate < 0.0;
    path.omega = std::abs(rate);
    path.phase = (sa - rate * st) / m;
    path.residual = circle.scatter;
    return path;
}

/// Gauss–Newton for S, A, φ and Ω together.
class PathRefinement {
  public:
    PathRefinement(const std::vector<Vec2>& centres, const std::vector<double>& times,
                   const TrackedPath& start)
        : centres_(centres),
          times_(times),
          path_(start),
          sign_(start.clockwise ? -1.0 : 1.0),
          origin_(times.front()),
          span_(std::max(times.back() - times.front(), min_span)),
          scale_(std::max(start.residual, first_scale)) {}

    /// Nothing if the fit fails or is too poor.
    std::optional<TrackedPath> run() {
        for (int pass = 0; pass < max_passes; ++pass) {
            const std::optional<double> moved = improve();
            if (!moved) return std::nullopt;
            if (pass > min_passes && *moved < settled) break;
        }
        const auto error = [&](int k) {
            return path_.residual * std::sqrt(std::max(0.0, inverse_(k, k)));
        };
        path_.centre_error = std::max(error(0), error(1));
        path_.amplitude_error = error(2);
        path_.phase_error = error(3);
        path_.omega_error = error(4) / span_;
        path_.phase = std::remainder(path_.phase, 2.0 * pi);
        if (path_.used < min_used || path_.amplitude_error > max_error * path_.amplitude)
            return std::nullopt;
        return path_;
    }

  private:
    static constexpr double min_span = 1e-12;   // keeps the scaled time finite
    static constexpr double first_scale = 0.5;  // pixels: start with all but gross outliers
    static constexpr double min_scale = 0.05;   // pixels: exact centres would give 0
    static constexpr double cutoff = 4.7;       // standard deviations, 95 % efficient
    static constexpr int max_passes = 25, min_passes = 5;
    static constexpr double settled = 1e-7;    // pixels, centre and amplitude together
    static constexpr double min_weight = 5.0;  // the sum of weights: one for each parameter
    static constexpr double min_used = 0.5;    // share of the frames: fewer may be another motion
    static constexpr double max_error = 0.05;  // share of the amplitude
    using Matrix = cv::Matx<double, 5, 5>;
    using Vector = cv::Vec<double, 5>;

    /// One step; how far the centre and the amplitude moved, or nothing if no frames are left.
    std::optional<double> improve() {
        Matrix normal = Matrix::zeros();
        Vector right = Vector::all(0.0);
        std::vector<double> off;
        double weight_sum = 0.0;
        for (std::size_t k = 0; k < centres_.size(); ++k) {
            const double turn = path_.angle(times_[k]);
            const Vec2 u{std::cos(turn), -std::sin(turn)};   // radial, y down
            const Vec2 v{-std::sin(turn), -std::cos(turn)};  // derivative of u
            const Vec2 residual = centres_[k] - path_.at(times_[k]);
            off.push_back(length(residual));
            const double w = tukey_weight(off.back() / (cutoff * scale_));
            if (w == 0.0) continue;
            weight_sum += w;
            const double t = sign_ * (times_[k] - origin_) / span_;
            const Vector jx(1.0, 0.0, u.x, path_.amplitude * v.x, path_.amplitude * v.x * t);
            const Vector jy(0.0, 1.0, u.y, path_.amplitude * v.y, path_.amplitude * v.y * t);
            normal += w * (jx * jx.t() + jy * jy.t());
            right += w * (residual.x * jx + residual.y * jy);
        }
        if (weight_sum < min_weight) return std::nullopt;
        inverse_ = normal.inv(cv::DECOMP_SVD);
        const Vector d = inverse_ * right;
        path_.centre = path_.centre + Vec2{d[0], d[1]};
        path_.amplitude += d[2];
        path_.omega += d[4] / span_;
        // The angle at the origin of the times changes by d[3], and the slope about it by d[4].
        path_.phase += d[3] - sign_ * d[4] / span_ * origin_;
        // Weighted squares would give too small a value, since the weights favour small residuals.
        path_.residual = median(off) / length_median;
        scale_ = std::max(path_.residual, min_scale);
        const auto used =
            std::count_if(off.begin(), off.end(), [&](double o) { return o < cutoff * scale_; });
        path_.used = double(used) / double(centres_.size());
        return std::abs(d[0]) + std::abs(d[1]) + std::abs(d[2]);
    }

    const std::vector<Vec2>& centres_;
    const std::vector<double>& times_;
    TrackedPath path_;
    double sign_, origin_, span_, scale_;
    Matrix inverse_ = Matrix::zeros();
};

}  // namespace

std::optional<TrackedPath> fit_container_path(const std::vector<Vec2>& centres,
                                              const std::vector<double>& times) {
    if (centres.size() < min_path_centres) return std::nullopt;
    const std::optional<TrackedPath> start = initial_path(centres, times);
    return start ? PathRefinement(centres, times, *start).run() : std::nullopt;
}

}  // namespace swirl::tracking
