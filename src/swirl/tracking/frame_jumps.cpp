#include "swirl/tracking/frame_jumps.hpp"

#include <algorithm>
#include <cmath>

#include "swirl/math/unit_circle.hpp"
#include "swirl/tracking/circles.hpp"
#include "swirl/tracking/container_path_fit.hpp"
#include "swirl/tracking/robust_statistics.hpp"

namespace swirl {

double camera_shake(const std::vector<Vec2>& centres, const std::vector<std::size_t>& frames,
                    const TrackedPath& path) {
    std::vector<double> bends;
    for (std::size_t k = 1; k + 1 < centres.size(); ++k) {
        if (frames[k + 1] != frames[k - 1] + 2) continue;
        bends.push_back(std::abs(length(centres[k - 1] - path.centre) -
                                 2.0 * length(centres[k] - path.centre) +
                                 length(centres[k + 1] - path.centre)));
    }
    // The variance of a second difference is 1 + 4 + 1 times that of a value.
    return bends.empty() ? 0.0 : mad_to_sigma * median(bends) / std::sqrt(6.0);
}

namespace {

/// Angles between successive frames, positive in the direction of the path.
struct AngleSteps {
    std::vector<double> angles;
    std::vector<std::size_t> first;  // index of the first of the two centres
};

AngleSteps angle_steps(const std::vector<Vec2>& centres, const std::vector<std::size_t>& frames,
                       const TrackedPath& path) {
    constexpr double max_off = 0.2;  // of the amplitude: farther from the path, the rim is wrong
    AngleSteps steps;
    for (std::size_t k = 0; k + 1 < centres.size(); ++k) {
        const Vec2 a = centres[k] - path.centre, b = centres[k + 1] - path.centre;
        if (frames[k + 1] != frames[k] + 1) continue;
        if (std::abs(length(a) - path.amplitude) > max_off * path.amplitude ||
            std::abs(length(b) - path.amplitude) > max_off * path.amplitude)
            continue;
        const double angle = std::atan2(-b.y, b.x) - std::atan2(-a.y, a.x);
        steps.angles.push_back((path.clockwise ? -1.0 : 1.0) * std::remainder(angle, 2.0 * pi));
        steps.first.push_back(k);
    }
    return steps;
}

}  // namespace

std::vector<FrameJump> find_frame_jumps(const std::vector<Vec2>& centres,
                                        const std::vector<std::size_t>& frames,
                                        const TrackedPath& path) {
    constexpr std::size_t around = 5, min_steps = 12;  // two windows of neighbours, and more
    constexpr double stands_out = 6.0;                 // standard deviations of a step
    constexpr double min_jump = 0.6;       // steps: a dropped or duplicated frame is one step
    constexpr double standstill = 0.15;    // steps: the image moved no more than this
    constexpr double outlier_share = 0.5;  // of a jump that an opposite one cancels
    const AngleSteps all = angle_steps(centres, frames, path);
    const std::vector<double>& steps = all.angles;
    if (steps.size() < min_steps) return {};
    std::vector<double> usual, off;
    for (std::size_t k = 0; k < steps.size(); ++k) {
        const std::size_t from = k < around ? 0 : k - around,
                          to = std::min(steps.size(), k + around + 1);
        usual.push_back(median({steps.begin() + static_cast<std::ptrdiff_t>(from),
                                steps.begin() + static_cast<std::ptrdiff_t>(to)}));
        off.push_back(std::abs(steps[k] - usual.back()));
    }
    const double scatter = mad_to_sigma * median(off);
    std::vector<FrameJump> jumps;
    const auto add = [&](std::size_t k, double step) {
        jumps.push_back({frames[all.first[k]], frames[all.first[k] + 1], steps[k] / step});
    };
    // If every other frame is a duplicate, half of the steps vanish and the median step is
    // meaningless. The ninth decile then is the true step. Steps of a shaking camera vanish by
    // chance, so this holds for a steady camera only.
    std::vector<double> sorted = steps;
    std::sort(sorted.begin(), sorted.end());
    const double large = sorted[sorted.size() * 9 / 10];
    const bool steady =
        large * path.amplitude > stands_out * std::sqrt(2.0) * camera_shake(centres, frames, path);
    const auto moves = [&](std::size_t k) {
        return k >= steps.size() || (steps[k] > 0.5 * large && steps[k] < 1.5 * large);
    };
    for (std::size_t k = 0; k < steps.size(); ++k) {
        const bool duplicate = steady && std::abs(steps[k]) < standstill * large &&
                               large * path.amplitude > min_path_amplitude && moves(k - 1) &&
                               moves(k + 1);
        if (duplicate) {
            add(k, large);
            continue;
        }
        if (!(usual[k] > stands_out * scatter) || off[k] < min_jump * usual[k]) continue;
        // A single wrong centre makes two opposite jumps.
        const auto cancels = [&](std::size_t j) {
            return j < steps.size() &&
                   std::abs(steps[k] + steps[j] - 2.0 * usual[k]) < outlier_share * off[k];
        };
        if (cancels(k + 1) || (k > 0 && cancels(k - 1))) continue;
        add(k, usual[k]);
    }
    return jumps;
}

}  // namespace swirl
