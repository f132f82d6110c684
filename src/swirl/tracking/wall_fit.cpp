// The wall of a tilted container, from the positions at which it stops discs.
//
// Seen at an angle, the rim is shifted relative to the discs, which lie lower. Being nearer to the
// camera, it is larger, and so is its path. For discs at the wall,
//
//     r = reach + shift·n − excess C·n
//
// with r the outer end of a disc from the rim's centre, n its direction, and C the direction of the
// path's centre to the rim's. `excess` is by how much the rim's amplitude is too large.
#include <algorithm>
#include <cmath>

#include "swirl/tracking/robust_statistics.hpp"
#include "swirl/tracking/tracking_steps.hpp"

namespace swirl {

void move_path_to_wall(TrackedVideo& tracked) {
    constexpr double stands_out = 4.0;                 // standard errors
    constexpr double first_range = 0.5, range = 0.15;  // radii: a disc this close is at the wall
    constexpr double narrowing = 0.8;                  // of the range, from pass to pass
    constexpr int passes = 20;                         // more than the narrowing takes
    constexpr std::size_t min_positions = 400;         // at the wall, for four unknowns
    std::vector<cv::Vec4d> rows;
    std::vector<double> outer;
    for (std::size_t k = 0; k < tracked.tracks.frames.size(); ++k) {
        const TrackFrame& f = tracked.tracks.frames[k];
        const Vec2 c = tracked.container(k);
        const Vec2 out = (1.0 / tracked.path.amplitude) * (c - tracked.path.centre);
        for (std::size_t i = 0; i < f.id.size(); ++i) {
            const Vec2 d = f.position[i] - c;
            const double distance = length(d);
            if (!tracked.seen[k][i] || !(distance > 0.0)) continue;
            const Vec2 n = (1.0 / distance) * d;
            rows.emplace_back(1.0, n.x, n.y, -dot(out, n));
            outer.push_back(distance + f.radius[i]);
        }
    }
    // Initial estimate: the outermost disc of every frame is at the wall. A better wall then has
    // more discs.
    cv::Vec4d fit(quantile(outer, 1.0 - 0.5 / double(std::max<std::size_t>(tracked.number, 1))),
                  0.0, 0.0, 0.0);
    cv::Vec4d error = cv::Vec4d::all(0.0);
    double near = first_range * tracked.radius;
    for (int pass = 0; pass < passes;
         ++pass, near = std::max(narrowing * near, range * tracked.radius)) {
        cv::Matx44d normal = cv::Matx44d::zeros();
        cv::Vec4d right = cv::Vec4d::all(0.0);
        double square = 0.0;
        std::size_t used = 0;
        for (std::size_t k = 0; k < rows.size(); ++k) {
            const double residual = outer[k] - rows[k].dot(fit);
            if (std::abs(residual) > near) continue;
            normal += rows[k] * rows[k].t();
            right += residual * rows[k];
            square += residual * residual;
            ++used;
        }
        if (used < min_positions) return;
        const cv::Matx44d inverse = normal.inv(cv::DECOMP_SVD);
        fit += inverse * right;
        // A disc stays at one position of the wall for many frames, which count as one.
        const double scatter = std::sqrt(square / double(used) * double(tracked.number));
        for (int a = 0; a < 4; ++a) error[a] = scatter * std::sqrt(std::max(0.0, inverse(a, a)));
    }
    if (std::hypot(fit[1], fit[2]) < stands_out * std::max(error[1], error[2])) return;
    tracked.rim_shift = {fit[1], fit[2]};
    tracked.path.centre = tracked.path.centre + tracked.rim_shift;
    tracked.path.centre_error = std::hypot(tracked.path.centre_error, std::max(error[1], error[2]));
    if (std::abs(fit[3]) < stands_out * error[3]) return;
    tracked.polygon.vertex_distance *= 1.0 - fit[3] / tracked.path.amplitude;
    tracked.path.amplitude -= fit[3];
    tracked.path.amplitude_error = std::hypot(tracked.path.amplitude_error, error[3]);
}

}  // namespace swirl
