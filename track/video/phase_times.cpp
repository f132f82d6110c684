// Times of the frames by the phase of the container, if it moves unevenly.
//
// A hand swirls faster and slower, starts and stops. Results relative to Ω need only the phase, which
// every frame shows: the angle of the rim's centre about the centre of its path. If the rate of the
// phase varies over half a period by more than a motor's, frame k gets the time φ_k/Ω with the mean Ω
// of the moving part. The path is then uniform, and all later steps work as for a motor.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "swirl/math/unit_circle.hpp"
#include "swirl/run/failure.hpp"
#include "track/video/container_path_fit.hpp"
#include "track/video/robust_statistics.hpp"
#include "track/video/tracking_steps.hpp"

namespace swirl::tracking {

namespace {

/// The phase in every frame, unwrapped and ascending on the whole; nothing if the centres of the rim
/// are not on a circle.
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

/// The motion of an uneven container: which frames show it moving, and its usual rates.
struct UnevenMotion {
    std::vector<char> moving;
    double slowest = 0.0, fastest = 0.0;  // rad per frame, of nearly all moving frames
    std::size_t quarter = 0;              // frames of a quarter of a period
};

/// The range of the rates of moving frames, relative to their median.
double variation_of(const std::vector<double>& rates, const std::vector<char>& moving) {
    std::vector<double> chosen;
    for (std::size_t k = 0; k < rates.size(); ++k)
        if (moving[k]) chosen.push_back(rates[k]);
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
    std::size_t resting = 0;
    for (const double rate : rates) {
        motion.moving.push_back(rate > moving_share * usual);
        if (motion.moving.back()) while_moving.push_back(rate);
        resting += !motion.moving.back();
    }
    if (while_moving.size() < min_frames) return std::nullopt;
    // Near a rest the mean over half a period is not a rate of the motion.
    std::vector<double> clear;
    for (std::size_t k = quarter; k + quarter < rates.size(); ++k)
        if (std::all_of(motion.moving.begin() + std::ptrdiff_t(k - quarter),
                        motion.moving.begin() + std::ptrdiff_t(k + quarter + 1),
                        [](char moving) { return moving != 0; }))
            clear.push_back(rates[k]);
    motion.slowest = quantile(clear.empty() ? while_moving : clear, 0.02);
    motion.fastest = quantile(clear.empty() ? while_moving : clear, 0.98);
    const double variation = std::min(variation_of(rates, motion.moving),
                                      variation_of(median_steps(phases, quarter), motion.moving));
    if (variation < max_variation && resting < quarter) return std::nullopt;
    return motion;
}

/// Gives the frames of each rest its median phase: noise would add up in ascending times.
void still(const std::vector<char>& moving, std::vector<double>& phases) {
    for (std::size_t k = 0, end = 0; k < phases.size(); k = std::max(end, k + 1)) {
        for (end = k; end < phases.size() && !moving[end];) ++end;
        if (end == k) continue;
        const double phase = quantile(
            {phases.begin() + std::ptrdiff_t(k), phases.begin() + std::ptrdiff_t(end)}, 0.5);
        std::fill(phases.begin() + std::ptrdiff_t(k), phases.begin() + std::ptrdiff_t(end), phase);
    }
}

/// "0 to 59, 120 to 150": the frames at rest.
std::string resting_frames(const std::vector<char>& moving, std::int64_t first) {
    std::string text;
    for (std::size_t k = 0; k < moving.size(); ++k) {
        if (moving[k]) continue;
        std::size_t end = k;
        while (end + 1 < moving.size() && !moving[end + 1]) ++end;
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
    still(motion->moving, *phases);
    const double step = tracked.step(), unit = tracked.fps > 0.0 ? 1.0 : step;
    double turned = 0.0, passed = 0.0;
    for (std::size_t k = 1; k < phases->size(); ++k) {
        if (!motion->moving[k]) continue;
        turned += (*phases)[k] - (*phases)[k - 1];
        passed += tracked.times[k] - tracked.times[k - 1];
    }
    const double rate = turned / passed;
    for (std::size_t k = 1; k < phases->size(); ++k) {
        const double by_phase = tracked.times.front() + ((*phases)[k] - (*phases)[0]) / rate;
        tracked.times[k] = std::max(by_phase, tracked.times[k - 1] + least_step * step);
    }
    tracked.by_phase = tracked.uneven_times = true;
    const auto period = [&](double of_rate) { return 2.0 * pi / of_rate * step / unit; };
    std::string text = fmt::format(
        "the container moves unevenly: its period changes from {:.2f} to {:.2f} {}; the phase of "
        "its rim in each frame is used instead of the time",
        period(motion->fastest), period(motion->slowest), tracked.fps > 0.0 ? "s" : "frames");
    if (const std::string rest = resting_frames(motion->moving, settings.first_frame);
        !rest.empty())
        text += fmt::format("; it rests in frames {}, which are not measured", rest);
    tracked.warnings.push_back(text);
    return true;
}

}  // namespace swirl::tracking
