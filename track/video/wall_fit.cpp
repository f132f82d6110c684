// The wall, from the positions at which it stops discs.
//
// Tilted camera: seen at an angle, the rim is shifted relative to the discs, which lie lower. Being
// nearer to the camera, it is larger, and so is its path. For discs at the wall,
//
//     r = reach + shift·n − excess C·n
//
// with r the outer end of a disc from the rim's centre, n its direction, and C the direction of the
// path's centre to the rim's. `excess` is by how much the rim's amplitude is too large.
//
// Light from one side: the shaded side of a ball looks like the floor, so its position is shifted
// towards the side that stands out. The shift is the same in all frames and grows with the radius.
// It is determined as above, with n in units of the most frequent radius and without the last term.
#include <algorithm>
#include <cmath>
#include <optional>

#include "track/video/robust_statistics.hpp"
#include "track/video/tracking_steps.hpp"

namespace swirl::tracking {

namespace {

constexpr double stands_out = 4.0;  // standard errors

/// Positions at which discs may be at the wall.
struct WallRows {
    std::vector<cv::Vec4d> rows;  // factors of reach, shift and excess
    std::vector<double> outer;    // outer ends of the discs from the rim's centre
};

struct WallFit {
    cv::Vec4d value{}, error{};  // value of reach, shift and excess
};

/// None if discs are too seldom at the wall.
std::optional<WallFit> fit_wall(const WallRows& wall, double radius, std::size_t discs) {
    constexpr double first_range = 0.5, range = 0.15;  // radii: a disc this close is at the wall
    constexpr double narrowing = 0.8;                  // share of the range, from pass to pass
    constexpr int passes = 20;                         // more than the narrowing takes
    constexpr std::size_t min_positions = 400;         // positions at the wall, for four unknowns
    const double number = double(std::max<std::size_t>(discs, 1));
    WallFit fit;
    // Initial estimate: the outermost disc of every frame is at the wall. With a better estimate of
    // the wall, more discs are found at it.
    fit.value[0] = quantile(wall.outer, 1.0 - 0.5 / number);
    double near = first_range * radius;
    for (int pass = 0; pass < passes; ++pass, near = std::max(narrowing * near, range * radius)) {
        cv::Matx44d normal = cv::Matx44d::zeros();
        cv::Vec4d right = cv::Vec4d::all(0.0);
        double square = 0.0;
        std::size_t used = 0;
        for (std::size_t k = 0; k < wall.rows.size(); ++k) {
            const double residual = wall.outer[k] - wall.rows[k].dot(fit.value);
            if (std::abs(residual) > near) continue;
            normal += wall.rows[k] * wall.rows[k].t();
            right += residual * wall.rows[k];
            square += residual * residual;
            ++used;
        }
        if (used < min_positions) return std::nullopt;
        if (normal(3, 3) == 0.0) normal(3, 3) = 1.0;  // an unused term is zero
        const cv::Matx44d inverse = normal.inv(cv::DECOMP_SVD);
        fit.value += inverse * right;
        // A disc stays at one position of the wall for many frames, which count as one.
        const double scatter = std::sqrt(square / double(used) * number);
        for (int a = 0; a < 4; ++a)
            fit.error[a] = scatter * std::sqrt(std::max(0.0, inverse(a, a)));
    }
    return fit;
}

}  // namespace

void move_path_to_wall(TrackedVideo& tracked) {
    WallRows wall;
    for (std::size_t k = 0; k < tracked.tracks.frames.size(); ++k) {
        const TrackFrame& f = tracked.tracks.frames[k];
        const Vec2 c = tracked.container(k);
        const Vec2 out = (1.0 / tracked.path.amplitude) * (c - tracked.path.centre);
        for (std::size_t i = 0; i < f.id.size(); ++i) {
            const Vec2 d = f.position[i] - c;
            const double distance = length(d);
            if (!tracked.seen[k][i] || !(distance > 0.0)) continue;
            const Vec2 n = (1.0 / distance) * d;
            wall.rows.emplace_back(1.0, n.x, n.y, -dot(out, n));
            wall.outer.push_back(distance + f.radius[i]);
        }
    }
    const auto found = fit_wall(wall, tracked.radius, tracked.number);
    if (!found) return;
    const cv::Vec4d &fit = found->value, &error = found->error;
    if (std::hypot(fit[1], fit[2]) < stands_out * std::max(error[1], error[2])) return;
    tracked.rim_shift = {fit[1], fit[2]};
    tracked.path.centre = tracked.path.centre + tracked.rim_shift;
    tracked.path.centre_error = std::hypot(tracked.path.centre_error, std::max(error[1], error[2]));
    if (std::abs(fit[3]) < stands_out * error[3]) return;
    tracked.path.amplitude -= fit[3];
    tracked.path.amplitude_error = std::hypot(tracked.path.amplitude_error, error[3]);
}

void remove_shading_shift(const Links& links, const Vec2& brighter, Detections& all,
                          TrackedVideo& tracked) {
    constexpr double unknown_shift = 0.1;  // radii: rms of a coordinate in four videos
    constexpr double min_share = 0.5;  // share of the shift along the gradient of the brightness
    if (tracked.lens.tilted()) return;
    WallRows wall;
    for_each_linked(links, [&](std::size_t k, std::size_t, std::size_t d) {
        const DetectedParticle& p = all[k].particles[d];
        const double radius = tracked.species[p.species].radius;
        const Vec2 apart = p.centre - tracked.container(k);
        const double distance = length(apart);
        if (!(distance > 0.0)) return;
        const Vec2 n = (radius / (tracked.radius * distance)) * apart;
        wall.rows.emplace_back(1.0, n.x, n.y, 0.0);
        wall.outer.push_back(distance + radius);
    });
    const auto found = fit_wall(wall, tracked.spacing * tracked.radius, links.species.size());
    // A template without edges does not define a centre, so its shift is removed in any case. If
    // the wall does not show it, the positions err by it.
    const bool unknown = length(brighter) == 0.0;
    if (!found && unknown) tracked.shading_shift_error = unknown_shift * tracked.radius;
    if (!found) return;
    const Vec2 shift{found->value[1], found->value[2]};
    const double error = std::max(found->error[1], found->error[2]);
    // The side that stands out from the floor: the bright side of bright balls, and of dark ones
    // the dark side.
    const Vec2 towards = (tracked.bright ? 1.0 : -1.0) * brighter;
    if ((!unknown && length(shift) < stands_out * error) ||
        dot(shift, towards) < min_share * length(shift) * length(towards))
        return;
    tracked.shading_shift = shift;
    tracked.shading_shift_error = error;
    for (FrameDetections& frame : all)
        for (DetectedParticle& p : frame.particles)
            p.centre = p.centre - (tracked.species[p.species].radius / tracked.radius) * shift;
}

}  // namespace swirl::tracking
