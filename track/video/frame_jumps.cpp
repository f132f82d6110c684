#include "track/video/frame_jumps.hpp"

#include <algorithm>
#include <cmath>

#include "swirl/math/unit_circle.hpp"
#include "track/video/circles.hpp"
#include "track/video/container_path_fit.hpp"
#include "track/video/robust_statistics.hpp"

namespace swirl::tracking {

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
    constexpr double max_off =
        0.2;  // share of the amplitude: farther from the path, the rim is wrong
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

/// For each frame, whether its pixels are nearly those of the frame before. Even compression leaves
/// a fraction of the usual change.
std::vector<bool> same_pixels(const std::vector<double>& changes) {
    constexpr double max_share = 0.15;     // share of the usual change; 0.04 for strong compression
    constexpr double usual_change = 0.85;  // quantile: most frames of a window may be duplicates
    constexpr std::size_t around = 16;     // frames to each side
    std::vector<bool> same;
    for (std::size_t k = 0; k < changes.size(); ++k) {
        std::vector<double> window;
        for (std::size_t j = k < around ? 0 : k - around;
             j < std::min(changes.size(), k + around + 1); ++j)
            if (changes[j] >= 0.0) window.push_back(changes[j]);
        same.push_back(changes[k] >= 0.0 &&
                       changes[k] < max_share * quantile(window, usual_change));
    }
    return same;
}

/// For each step, whether it leads to a duplicate: the same pixels, and the rim does not move.
std::vector<bool> duplicate_steps(const AngleSteps& steps, const std::vector<Vec2>& centres,
                                  const std::vector<std::size_t>& frames,
                                  const std::vector<double>& changes) {
    constexpr double standstill = 0.35;  // share of a usual step
    constexpr double usual_step = 0.85;  // quantile
    constexpr double min_usual = 0.4;    // pixels: several errors of the rim
    const std::vector<bool> same = same_pixels(changes);
    std::vector<double> lengths;
    for (const std::size_t k : steps.first) lengths.push_back(length(centres[k + 1] - centres[k]));
    const double usual = quantile(lengths, usual_step);
    std::vector<bool> duplicate;
    for (std::size_t n = 0; n < steps.first.size(); ++n) {
        const std::size_t frame = frames[steps.first[n] + 1];
        duplicate.push_back(frame < same.size() && same[frame] && usual > min_usual &&
                            lengths[n] < standstill * usual);
    }
    return duplicate;
}

}  // namespace

std::vector<FrameJump> find_frame_jumps(const std::vector<Vec2>& centres,
                                        const std::vector<std::size_t>& frames,
                                        const TrackedPath& path,
                                        const std::vector<double>& changes) {
    constexpr std::size_t around = 5, min_steps = 12;  // two windows of neighbours, and more
    constexpr double stands_out = 6.0;                 // standard deviations of a step
    constexpr double min_jump = 0.6;                   // steps: a dropped frame is one step
    constexpr double outlier_share = 0.5;  // share of a jump that an opposite one cancels
    constexpr double replaced = 1.5;       // steps after a duplicate that replaces another frame
    const AngleSteps all = angle_steps(centres, frames, path);
    const std::vector<double>& steps = all.angles;
    if (steps.size() < min_steps) return {};
    const std::vector<bool> duplicate = duplicate_steps(all, centres, frames, changes);
    std::vector<double> usual, off;
    for (std::size_t k = 0; k < steps.size(); ++k) {
        std::vector<double> window;
        for (std::size_t j = k < around ? 0 : k - around;
             j < std::min(steps.size(), k + around + 1); ++j)
            if (!duplicate[j]) window.push_back(steps[j]);
        usual.push_back(window.empty() ? 0.0 : median(window));
        if (!duplicate[k]) off.push_back(std::abs(steps[k] - usual.back()));
    }
    const double scatter = off.empty() ? 0.0 : mad_to_sigma * median(off);
    std::vector<FrameJump> jumps;
    for (std::size_t k = 0; k < steps.size(); ++k) {
        FrameJump jump{frames[all.first[k]], frames[all.first[k] + 1],
                       usual[k] > 0.0 ? steps[k] / usual[k] : 0.0};
        if (duplicate[k]) {
            jump.duplicate = true;
            jump.inserted = k + 1 >= steps.size() || steps[k + 1] < replaced * usual[k];
            jumps.push_back(jump);
            continue;
        }
        const double excess = steps[k] - usual[k];
        if (!(usual[k] > stands_out * scatter) || excess < min_jump * usual[k]) continue;
        // A single wrong centre makes two opposite jumps, and so does a duplicate that replaces a
        // frame.
        const auto cancels = [&](std::size_t j) {
            return j < steps.size() &&
                   std::abs(steps[k] + steps[j] - 2.0 * usual[k]) < outlier_share * excess;
        };
        if (cancels(k + 1) || (k > 0 && cancels(k - 1))) continue;
        jumps.push_back(jump);
    }
    return jumps;
}

}  // namespace swirl::tracking
