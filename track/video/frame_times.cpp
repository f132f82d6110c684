#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "swirl/math/unit_circle.hpp"
#include "swirl/run/failure.hpp"
#include "track/video/circles.hpp"
#include "track/video/container_path_fit.hpp"
#include "track/video/frame_jumps.hpp"
#include "track/video/robust_statistics.hpp"
#include "track/video/tracking_steps.hpp"

namespace swirl::tracking {

bool set_frame_times(const TrackingSettings& settings, const VideoTimes& times, Detections& all,
                     TrackedVideo& tracked) {
    constexpr double max_jitter = 0.2;   // steps: the rounding of coarse clocks stays below
    constexpr double max_untimed = 0.1;  // share of the frames
    tracked.fps = settings.fps.value_or(times.fps);
    tracked.jitter = times.jitter;
    const std::size_t frames = all.size();
    const auto first = static_cast<std::size_t>(settings.first_frame);
    const bool known = times.seconds.size() == first + frames ||
                       (settings.max_frames > 0 && times.seconds.size() > first + frames);
    if (settings.fps || times.jitter <= max_jitter || !known) {
        for (std::size_t k = 0; k < frames; ++k)
            tracked.times.push_back(double(k + first) / (tracked.fps > 0.0 ? tracked.fps : 1.0));
        return false;
    }
    tracked.uneven_times = true;
    const AscendingTimes own =
        ascending_times({times.seconds.begin() + std::ptrdiff_t(first),
                         times.seconds.begin() + std::ptrdiff_t(first + frames)});
    for (const double second : own.seconds) tracked.times.push_back(second - times.seconds.front());
    tracked.warnings.push_back(fmt::format(
        "the frame rate varies: steps between frames differ from their mean by up to {:.2f} times "
        "the mean, as with phones in poor light; the video's own times are used, but a fixed frame "
        "rate is better",
        times.jitter));
    if (own.untimed.empty()) return true;
    for (const std::size_t k : own.untimed) all[k].discard();
    const std::string what = fmt::format(
        "{} of the {} frames of '{}' have no valid time, the first at frame {}: their times do not "
        "advance",
        own.untimed.size(), frames, settings.video, own.untimed.front());
    if (double(own.untimed.size()) > max_untimed * double(frames))
        throw Failure(what + "\nhint: if the frames are equally spaced in time, give --fps");
    tracked.warnings.push_back(what +
                               "; they are not used, and positions are filled in from the frames "
                               "around them; if the frames are equally spaced in time, --fps uses "
                               "all of them");
    return true;
}

void reject_time_gaps(const TrackingSettings& settings, const RimCentres& rims,
                      const TrackedVideo& tracked) {
    // The period in frames does not depend on the clock, so that no gap can falsify it.
    const auto by_frame =
        fit_container_path(rims.centres, {rims.frames.begin(), rims.frames.end()});
    if (!by_frame) return;
    const auto number = [&](std::size_t k) {
        return settings.first_frame + static_cast<std::int64_t>(k);
    };
    const double half_period = pi / by_frame->omega * tracked.step();
    for (std::size_t k = 1; k < tracked.times.size(); ++k)
        if (const double step = tracked.times[k] - tracked.times[k - 1]; step >= half_period)
            throw Failure(fmt::format(
                "{:.3g} s pass between frames {} and {} of '{}', {:.3g} periods: discs cannot be "
                "followed across half a period or more\nhint: track the part before or after it "
                "(--last-frame {}, --first-frame {}), or give --fps if frames are equally spaced "
                "in time",
                step, number(k - 1), number(k), settings.video, 0.5 * step / half_period,
                number(k - 1), number(k)));
}

namespace {

/// The numbers of frames of the video.
std::string frame_list(const TrackingSettings& settings, const std::vector<std::size_t>& frames) {
    std::vector<std::string> numbers;
    for (const std::size_t k : frames)
        numbers.push_back(std::to_string(settings.first_frame + static_cast<std::int64_t>(k)));
    return first_of(numbers);
}

/// Frames that are duplicates, frames that follow dropped ones, and the longest part without any.
struct JumpSummary {
    std::vector<std::size_t> duplicates, after_missing;
    std::size_t longest = 0, longest_begin = 0;
    double wrong = 0.0;  // steps by which times are off
};

JumpSummary summary_of(const std::vector<FrameJump>& jumps, std::size_t frames) {
    JumpSummary summary;
    std::size_t begin = 0;
    for (std::size_t n = 0; n <= jumps.size(); ++n) {
        const std::size_t end = n < jumps.size() ? jumps[n].after : frames;
        if (end - begin > summary.longest)
            summary.longest = end - begin, summary.longest_begin = begin;
        if (n == jumps.size()) break;
        const FrameJump& jump = jumps[n];
        // The part that follows starts after the duplicate.
        begin = jump.duplicate ? std::min(jump.after + 1, frames) : jump.after;
        if (jump.duplicate)
            summary.duplicates.push_back(jump.after);
        else
            summary.after_missing.push_back(jump.after);
        summary.wrong += std::abs(jump.steps - 1.0);
    }
    return summary;
}

std::string jumps_text(const TrackingSettings& settings, const JumpSummary& found) {
    std::string text;
    if (!found.duplicates.empty())
        text += fmt::format(
            "{} duplicated (number{} {})",
            found.duplicates.size() == 1 ? "1 frame is"
                                         : fmt::format("{} frames are", found.duplicates.size()),
            found.duplicates.size() == 1 ? "" : "s", frame_list(settings, found.duplicates));
    if (!found.after_missing.empty())
        text += fmt::format("{}frames are missing before {}", text.empty() ? "" : ", and ",
                            frame_list(settings, found.after_missing));
    return text;
}

/// Counts time in steps of the camera: a step for each dropped frame, none for an inserted
/// duplicate. If many frames are duplicates, they are regular, and the file's times are right.
void correct_times(const std::vector<FrameJump>& jumps, TrackedVideo& tracked) {
    constexpr std::size_t regular = 10;  // one in ten frames
    const std::size_t frames = tracked.times.size();
    const bool many = std::size_t(std::count_if(jumps.begin(), jumps.end(),
                                                [](const FrameJump& j) { return j.duplicate; })) *
                          regular >
                      frames;
    std::vector<double> steps(frames, 1.0);
    for (const FrameJump& jump : jumps) {
        if (!jump.duplicate) {
            steps[jump.after] = std::max(1.0, std::round(jump.steps));
        } else if (jump.inserted && !many) {
            // The duplicate itself is not used; its time is between those of its neighbours.
            steps[jump.after] = 0.5;
            if (jump.after + 1 < frames) steps[jump.after + 1] -= 0.5;
        }
    }
    const double step = tracked.step();
    for (std::size_t k = 1; k < frames; ++k)
        tracked.times[k] = tracked.times[k - 1] + steps[k] * step;
}

}  // namespace

bool check_frame_jumps(const TrackingSettings& settings, const RimCentres& rims, Detections& all,
                       TrackedVideo& tracked) {
    constexpr double max_share = 0.003;  // of the video: the error of Ω that a warning may leave
    std::vector<double> changes;
    for (const FrameDetections& found : all) changes.push_back(found.change);
    const std::vector<FrameJump> jumps =
        find_frame_jumps(rims.centres, rims.frames, tracked.path, changes);
    if (jumps.empty()) return false;
    const JumpSummary found = summary_of(jumps, tracked.times.size());
    const std::string what = jumps_text(settings, found);
    const double share = found.wrong / double(tracked.times.size());
    const bool accepted = (found.duplicates.empty() || settings.accept_duplicates) &&
                          (found.after_missing.empty() || settings.accept_missing);
    if (accepted) {
        correct_times(jumps, tracked);
        for (const std::size_t k : found.duplicates) all[k].discard();
        tracked.warnings.push_back(what +
                                   "; accepted: duplicates are not used, and times are corrected");
        return true;
    }
    const char* const accept = found.duplicates.empty()      ? "missing"
                               : found.after_missing.empty() ? "duplicates"
                                                             : "duplicates,missing";
    if (share >= max_share) {
        constexpr std::int64_t min_part = 16;  // frames, as for a video
        const std::int64_t begin =
            settings.first_frame + static_cast<std::int64_t>(found.longest_begin);
        const auto longest = static_cast<std::int64_t>(found.longest);
        const std::string part =
            longest < min_part ? ""
                               : fmt::format(
                                     "--first-frame {} --last-frame {} tracks the longest part "
                                     "without any; ",
                                     begin, begin + longest - 1);
        throw Failure(fmt::format(
            "the container moves unevenly: {}; times and Ω would be off by up to {:.1f} %\nhint: "
            "swirl track --correct-frames {} corrects the times and leaves duplicates out; {}"
            "record with a constant frame rate",
            what, 100.0 * share, accept, part));
    }
    tracked.warnings.push_back(
        fmt::format("the container moves unevenly: {}; times and Ω are off by up to {:.2f} %; "
                    "swirl track --correct-frames {} corrects that",
                    what, 100.0 * share, accept));
    return false;
}

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

// Times of the frames by the phase of the container, if it moves unevenly.
//
// A hand swirls faster and slower, starts and stops. Results relative to Ω need only the phase,
// which every frame shows: the angle of the rim's centre about the centre of its path. If the rate
// of the phase varies over half a period by more than a motor's, frame k gets the time φ_k/Ω with
// the mean Ω of the moving part. The path is then uniform, and all later steps work as for a motor.

namespace {

/// The phase in every frame, unwrapped and ascending on the whole; nothing if the centres of the
/// rim are not on a circle.
std::optional<std::vector<double>> unwrapped_phases(const RimCentres& rims, std::size_t frames) {
    constexpr double max_scatter = 0.1, max_off = 0.35;  // of the radius
    constexpr std::size_t min_centres = 8;
    if (rims.centres.size() < min_centres) return std::nullopt;
    const PathCircle circle = circle_through(rims.centres);
    if (!(circle.radius > min_path_amplitude) || circle.scatter > max_scatter * circle.radius)
        return std::nullopt;
    std::vector<double> phases(frames, 0.0);
    std::optional<std::size_t> last;
    for (std::size_t n = 0; n < rims.centres.size(); ++n) {
        const Vec2 d = rims.centres[n] - circle.centre;
        if (std::abs(length(d) - circle.radius) > max_off * circle.radius) continue;
        const std::size_t k = rims.frames[n];
        phases[k] = std::atan2(-d.y, d.x);
        if (last) {
            const double turn = std::remainder(phases[k] - phases[*last], 2.0 * pi);
            for (std::size_t j = *last + 1; j <= k; ++j)
                phases[j] = phases[*last] + turn * double(j - *last) / double(k - *last);
        } else {
            std::fill(phases.begin(), phases.begin() + std::ptrdiff_t(k), phases[k]);
        }
        last = k;
    }
    if (!last) return std::nullopt;
    std::fill(phases.begin() + std::ptrdiff_t(*last), phases.end(), phases[*last]);
    if (phases.back() < phases.front())
        for (double& phase : phases) phase = -phase;
    return phases;
}

/// Means over `width` frames to either side, of fewer near the ends.
std::vector<double> smoothed_phases(const std::vector<double>& phases, std::size_t width) {
    std::vector<double> means;
    for (std::size_t k = 0; k < phases.size(); ++k) {
        const std::size_t w = std::min({width, k, phases.size() - 1 - k});
        double sum = 0.0;
        for (std::size_t j = k - w; j <= k + w; ++j) sum += phases[j];
        means.push_back(sum / double(2 * w + 1));
    }
    return means;
}

/// The median step of the phase about each frame: a dropped or duplicated frame does not change it.
std::vector<double> median_steps(const std::vector<double>& phases, std::size_t width) {
    std::vector<double> medians;
    for (std::size_t k = 0; k < phases.size(); ++k) {
        std::vector<double> steps;
        const std::size_t from = k - std::min(k, width),
                          to = std::min(k + width, phases.size() - 1);
        for (std::size_t j = from; j < to; ++j) steps.push_back(phases[j + 1] - phases[j]);
        medians.push_back(quantile(steps, 0.5));
    }
    return medians;
}

/// The rate of the phase about each frame, per frame, over `width` frames to either side.
std::vector<double> local_rates(const std::vector<double>& phases, std::size_t width) {
    std::vector<double> rates;
    for (std::size_t k = 0; k < phases.size(); ++k) {
        const std::size_t from = k - std::min(k, width),
                          to = std::min(k + width, phases.size() - 1);
        rates.push_back((phases[to] - phases[from]) / double(to - from));
    }
    return rates;
}

/// The motion of an uneven container: which frames show it at rest, and its usual rates.
struct UnevenMotion {
    std::vector<char> rests;
    double slowest = 0.0, fastest = 0.0;  // rad per frame, of nearly all moving frames
    std::size_t quarter = 0;              // frames of a quarter of a period
};

/// The range of the rates of moving frames, relative to their median.
double variation_of(const std::vector<double>& rates, const std::vector<char>& rests) {
    std::vector<double> chosen;
    for (std::size_t k = 0; k < rates.size(); ++k)
        if (!rests[k]) chosen.push_back(rates[k]);
    return (quantile(chosen, 0.9) - quantile(chosen, 0.1)) / quantile(chosen, 0.5);
}

/// Nothing if the container moves evenly.
std::optional<UnevenMotion> uneven_motion(const std::vector<double>& phases) {
    constexpr double moving_share = 0.15;   // of the usual rate
    constexpr double max_variation = 0.12;  // relative: motors and polygons stay below
    constexpr std::size_t min_frames = 16;
    if (phases.size() < min_frames) return std::nullopt;
    // The container may rest in most frames.
    const std::vector<double> quick_rates = local_rates(phases, 2);
    double usual = quantile(quick_rates, 0.75);
    if (const double fast = quantile(quick_rates, 0.9); usual < moving_share * fast) usual = fast;
    if (!(usual > 0.0)) return std::nullopt;
    const auto quarter = std::max<std::size_t>(1, std::size_t(0.5 * pi / usual));
    if (phases.size() < 4 * quarter) return std::nullopt;
    const std::vector<double> rates = local_rates(phases, quarter);
    UnevenMotion motion;
    motion.quarter = quarter;
    std::vector<double> while_moving;
    for (const double rate : rates) {
        motion.rests.push_back(!(rate > moving_share * usual));
        if (!motion.rests.back()) while_moving.push_back(rate);
    }
    if (while_moving.size() < min_frames) return std::nullopt;
    // Near a rest the mean over half a period is not a rate of the motion.
    std::vector<double> clear;
    for (std::size_t k = quarter; k + quarter < rates.size(); ++k)
        if (std::none_of(motion.rests.begin() + std::ptrdiff_t(k - quarter),
                         motion.rests.begin() + std::ptrdiff_t(k + quarter + 1),
                         [](char rests) { return rests != 0; }))
            clear.push_back(rates[k]);
    motion.slowest = quantile(clear.empty() ? while_moving : clear, 0.02);
    motion.fastest = quantile(clear.empty() ? while_moving : clear, 0.98);
    const double variation = std::min(variation_of(rates, motion.rests),
                                      variation_of(median_steps(phases, quarter), motion.rests));
    if (variation < max_variation && rates.size() - while_moving.size() < quarter)
        return std::nullopt;
    return motion;
}

/// Gives the frames of each rest the phase in its middle: noise would add up in ascending times.
void still(const std::vector<char>& rests, std::vector<double>& phases) {
    for (std::size_t k = 0, end = 0; k < phases.size(); k = std::max(end, k + 1)) {
        for (end = k; end < phases.size() && rests[end];) ++end;
        if (end == k) continue;
        const double phase = phases[(k + end) / 2];
        std::fill(phases.begin() + std::ptrdiff_t(k), phases.begin() + std::ptrdiff_t(end), phase);
    }
}

/// "0 to 59, 120 to 150": the frames at rest.
std::string resting_frames(const std::vector<char>& rests, std::int64_t first) {
    std::string text;
    for (std::size_t k = 0; k < rests.size(); ++k) {
        if (!rests[k]) continue;
        std::size_t end = k;
        while (end + 1 < rests.size() && rests[end + 1]) ++end;
        text += fmt::format("{}{} to {}", text.empty() ? "" : ", ", first + std::int64_t(k),
                            first + std::int64_t(end));
        k = end;
    }
    return text;
}

}  // namespace

bool set_times_by_phase(const TrackingSettings& settings, const RimCentres& rims,
                        TrackedVideo& tracked) {
    constexpr double least_step = 1e-4;  // of a frame: times ascend
    constexpr std::size_t one_in = 8;    // of a quarter of a period: noise is smoothed
    auto phases = unwrapped_phases(rims, tracked.times.size());
    if (!phases) return false;
    const auto motion = uneven_motion(*phases);
    if (!motion) return false;
    phases = smoothed_phases(*phases, motion->quarter / one_in);
    still(motion->rests, *phases);
    const double step = tracked.step(), unit = tracked.fps > 0.0 ? 1.0 : step;
    double turned = 0.0, passed = 0.0;
    for (std::size_t k = 1; k < phases->size(); ++k) {
        if (motion->rests[k]) continue;
        turned += (*phases)[k] - (*phases)[k - 1];
        passed += tracked.times[k] - tracked.times[k - 1];
    }
    const double rate = turned / passed;
    for (std::size_t k = 1; k < phases->size(); ++k) {
        const double by_phase = tracked.times.front() + ((*phases)[k] - (*phases)[0]) / rate;
        tracked.times[k] = std::max(by_phase, tracked.times[k - 1] + least_step * step);
    }
    tracked.by_phase = tracked.uneven_times = true;
    tracked.rests = motion->rests;
    const auto period = [&](double of_rate) { return 2.0 * pi / of_rate * step / unit; };
    std::string text = fmt::format(
        "the container moves unevenly: its period changes from {:.2f} to {:.2f} {}; the phase of "
        "its rim in each frame is used instead of the time",
        period(motion->fastest), period(motion->slowest), tracked.fps > 0.0 ? "s" : "frames");
    if (const std::string rest = resting_frames(motion->rests, settings.first_frame); !rest.empty())
        text += fmt::format("; it rests in frames {}, which are not measured", rest);
    tracked.warnings.push_back(text);
    return true;
}

}  // namespace swirl::tracking
