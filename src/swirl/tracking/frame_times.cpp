#include <fmt/format.h>

#include <cmath>

#include "swirl/math/unit_circle.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/tracking/container_path_fit.hpp"
#include "swirl/tracking/frame_jumps.hpp"
#include "swirl/tracking/tracking_steps.hpp"

namespace swirl {

bool set_frame_times(const TrackingSettings& settings, const VideoTimes& times, Detections& all,
                     TrackedVideo& tracked) {
    constexpr double max_jitter = 0.2;   // steps: the rounding of coarse clocks stays below
    constexpr double max_untimed = 0.1;  // of the frames
    tracked.fps = settings.fps.value_or(times.fps);
    tracked.jitter = times.jitter;
    const std::size_t frames = all.size();
    const bool known = times.seconds.size() == frames ||
                       (settings.max_frames > 0 && times.seconds.size() > frames);
    if (settings.fps || times.jitter <= max_jitter || !known) {
        for (std::size_t k = 0; k < frames; ++k)
            tracked.times.push_back(double(k) / (tracked.fps > 0.0 ? tracked.fps : 1.0));
        return false;
    }
    const AscendingTimes own =
        ascending_times({times.seconds.begin(), times.seconds.begin() + std::ptrdiff_t(frames)});
    for (const double second : own.seconds) tracked.times.push_back(second - own.seconds.front());
    tracked.warnings.push_back(fmt::format(
        "the frame rate varies: steps between frames differ by up to {:.0f} % from their mean, as "
        "with phones in poor light; the video's own times are used, but a fixed frame rate is "
        "better",
        100.0 * times.jitter));
    if (own.untimed.empty()) return true;
    for (const std::size_t k : own.untimed) all[k] = {{}, {}, false};
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
    const double half_period = pi / by_frame->omega * tracked.step();
    for (std::size_t k = 1; k < tracked.times.size(); ++k)
        if (const double step = tracked.times[k] - tracked.times[k - 1]; step >= half_period)
            throw Failure(fmt::format(
                "{:.3g} s pass between frames {} and {} of '{}', {:.3g} periods: discs cannot be "
                "followed across half a period or more\n"
                "hint: cut the video there, or give --fps if its frames are equally spaced in time",
                step, k - 1, k, settings.video, 0.5 * step / half_period));
}

void check_frame_jumps(const RimCentres& rims, TrackedVideo& tracked) {
    constexpr double max_share = 0.003;  // of the video: the error of Ω that a warning may leave
    constexpr double duplicate = 0.5;    // steps: less is a frame that is there twice
    const std::vector<FrameJump> jumps = find_frame_jumps(rims.centres, rims.frames, tracked.path);
    if (jumps.empty()) return;
    double wrong = 0.0;  // steps
    std::size_t begin = 0, longest = 0, longest_begin = 0, duplicates = 0;
    for (std::size_t n = 0; n <= jumps.size(); ++n) {
        const std::size_t end = n < jumps.size() ? jumps[n].before + 1 : tracked.times.size();
        if (end - begin > longest) longest = end - begin, longest_begin = begin;
        if (n == jumps.size()) break;
        begin = jumps[n].after;
        wrong += std::abs(jumps[n].steps - 1.0);
        duplicates += jumps[n].steps < duplicate ? 1 : 0;
    }
    const std::string what = fmt::format(
        "the container moves unevenly: {} at {} position{} of the video (first between frames {} "
        "and {}, {:.1f} times the usual step)",
        duplicates == jumps.size() ? "frames are duplicated"
        : duplicates == 0          ? "frames are missing"
                                   : "frames are missing or duplicated",
        jumps.size(), jumps.size() == 1 ? "" : "s", jumps.front().before, jumps.front().after,
        jumps.front().steps);
    const double share = wrong / double(tracked.times.size());
    if (share >= max_share)
        throw Failure(fmt::format(
            "{}; times and Ω would be off by up to {:.1f} %\n"
            "hint: cut the video to frames {} to {}, which have no such position, or record with a "
            "constant frame rate",
            what, 100.0 * share, longest_begin, longest_begin + longest - 1));
    tracked.warnings.push_back(
        fmt::format("{}; times and Ω are off by up to {:.2f} %", what, 100.0 * share));
}

}  // namespace swirl
