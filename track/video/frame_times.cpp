#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "swirl/math/unit_circle.hpp"
#include "swirl/run/failure.hpp"
#include "track/video/container_path_fit.hpp"
#include "track/video/frame_jumps.hpp"
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
                "followed across half a period or more\n"
                "hint: track the part before or after it (--to {}, --from {}), or give --fps if "
                "frames are equally spaced in time",
                step, number(k - 1), number(k), settings.video, 0.5 * step / half_period,
                number(k - 1), number(k)));
}

namespace {

/// "40, 41, 60 and 12 more", as numbers of frames of the video.
std::string frame_list(const TrackingSettings& settings, const std::vector<std::size_t>& frames) {
    constexpr std::size_t shown = 10;
    std::string text;
    for (std::size_t n = 0; n < std::min(shown, frames.size()); ++n)
        text += fmt::format("{}{}", n == 0 ? "" : ", ",
                            settings.first_frame + static_cast<std::int64_t>(frames[n]));
    if (frames.size() > shown) text += fmt::format(" and {} more", frames.size() - shown);
    return text;
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
    constexpr double max_share =
        0.003;  // share of the video: the error of Ω that a warning may leave
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
        const std::int64_t begin =
            settings.first_frame + static_cast<std::int64_t>(found.longest_begin);
        throw Failure(fmt::format(
            "the container moves unevenly: {}; times and Ω would be off by up to {:.1f} %\n"
            "hint: swirl track --correct-frames {} corrects the times and leaves duplicates out; "
            "--from {} "
            "--to {} tracks the longest part without any; record with a constant frame rate",
            what, 100.0 * share, accept, begin,
            begin + static_cast<std::int64_t>(found.longest) - 1));
    }
    tracked.warnings.push_back(
        fmt::format("the container moves unevenly: {}; times and Ω are off by up to {:.2f} %; "
                    "swirl track --correct-frames {} corrects that",
                    what, 100.0 * share, accept));
    return false;
}

}  // namespace swirl::tracking
