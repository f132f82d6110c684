#include "swirl/run/track_fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "swirl/math/median.hpp"
#include "swirl/math/unit_circle.hpp"
#include "swirl/measure/container_fit.hpp"
#include "swirl/run/failure.hpp"

namespace swirl {
namespace {

constexpr std::uint64_t max_frames = 400, max_positions = 40000;
// A tracker's places are good to a few hundredths of a radius.
constexpr double sticks_out = 0.2, lie_in_each_other = 0.85;
// Swirled discs are flung against the wall and each other all the time.
constexpr double far_from_wall = 0.5, far_apart = 1.15, hardly_ever = 0.1;
constexpr std::size_t many_frames = 50, many_discs = 8;
// Of a cause: radii.
constexpr double off_centre = 0.7, steady = 0.35;
// Worth a remark.
constexpr double loose_fit = 0.15;       // radii
constexpr double phase_tolerance = 3.0;  // degrees
constexpr double longest_window = 10.0;  // pictures: a jump spread over more is sharp no more

template <class Holds>
double share(const std::vector<double>& values, Holds holds) {
    return double(std::count_if(values.begin(), values.end(), holds)) / double(values.size());
}

double quantile_of(std::vector<double> values, double share) {
    const auto at = values.begin() + std::ptrdiff_t(share * double(values.size() - 1));
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

/// In the picture, which is mirrored where the swirl ran clockwise.
double degrees_in_picture(double phase, bool clockwise) {
    const double degrees = phase * 180.0 / pi, seen = clockwise ? 180.0 - degrees : degrees;
    return seen - 360.0 * std::floor(seen / 360.0);
}

/// What was mended, a line each.
std::string repaired_text(const Tracks& tracks) {
    const auto& [filled, renamed, dropped] = tracks.repaired;
    std::string text;
    if (filled > 0)
        text += fmt::format("{} positions missing for up to five frames were put back.\n", filled);
    if (renamed > 0)
        text += fmt::format(
            "{} times a disc went on under another name, and was given its own back.\n", renamed);
    if (dropped > 0)
        text +=
            fmt::format("{} positions of discs seen in a single frame were left out.\n", dropped);
    return text;
}

double apart(double a, double b) { return std::abs(std::remainder(a - b, 360.0)); }

/// What does not quite fit, a line each.
std::string fit_text(const TrackFit& fit) {
    std::string text;
    if (!fit.phase_fits)
        text += fmt::format("The discs fit the dish better with --phase {:.0f} than with {:.0f}.\n",
                            fit.fitting_phase, fit.phase);
    if (std::abs(fit.wall_gap) > loose_fit)
        text += fmt::format(
            "The discs come to {:.2g} radii of the wall in the median, not to 0: is "
            "--container-radius right, and --scale?\n",
            fit.wall_gap);
    if (fit.pairs_known && std::abs(fit.closest_pair - 1.0) > 0.5 * loose_fit)
        text += fmt::format(
            "The discs come to {:.3g} radii of each other in the median, centre to centre, not to "
            "2: is --scale right?\n",
            2.0 * fit.closest_pair);
    return text;
}

/// How far places and velocities can be believed, in a line.
std::string smoothing_text(const TrackSmoothing& s) {
    if (!s.done) return "";
    const std::string smoothed =
        s.bend > s.noise
            ? fmt::format(
                  "which is less than courses bend between two pictures ({:.2g}); so they "
                  "were smoothed over {:.1f} pictures and no more",
                  s.bend, s.window)
            : fmt::format("and were smoothed over {:.1f} pictures, to {:.2g} pixels", s.window,
                          s.place_error);
    const char* const rounded =
        s.window > longest_window
            ? " Sharp turns are rounded over as many pictures: hardly any is sharp, and where "
              "discs "
              "become pinned is not told; the temperature is too low by a fifth."
            : "";
    return fmt::format(
        "Places have a noise of {:.2g} pixels, {}; velocities are good to {:.2g} of the "
        "container's, between collisions.{}\n",
        s.noise, smoothed, s.velocity_error(), rounded);
}

/// What the distances of discs say of the scale.
std::string scale_advice(const TrackFit& fit, const TrackScale& scale) {
    const double closest = fit.closest_pair * fit.disc_radius;
    if (!fit.pairs_known || std::abs(closest - 1.0) <= 0.5 * loose_fit) return "";
    return fmt::format(
        " The discs' centres come to {:.3g} radii of each other, and where discs touch it is 2: "
        "--scale {:.3g} would let them.",
        2.0 * closest, scale.pixels_per_radius * closest);
}

/// Throws Failure where more than this share of the frames contradicts what was said.
void reject_misfit(const TrackFit& fit, const TrackScale& scale, double share) {
    const auto frames = [](double part) { return fmt::format("{:.0f} %", 100.0 * part); };
    const std::string advice = scale_advice(fit, scale);
    if (fit.overlapping > share)
        throw Failure(fmt::format(
            "Discs lie in each other in {} of the frames, their centres {:.3g} radii apart where "
            "2 is the least: --scale {} is too large; {:.3g} would let them touch. (--misfit "
            "gives the share of frames that may say so.)",
            frames(fit.overlapping), 2.0 * fit.closest_pair, scale.pixels_per_radius,
            scale.pixels_per_radius * fit.closest_pair));
    if (fit.outside > share)
        throw Failure(fmt::format(
            "Discs stick out of the dish in {} of the frames, by {:.2g} radii in the median: "
            "--scale, --centre, --phase, --amplitude, --container-radius, --omega, --camera-fps "
            "or --clockwise is wrong.{} (--misfit gives the share of frames that may say so.)",
            frames(fit.outside), std::max(-fit.wall_gap, 0.0),
            advice.empty() ? fit.advice : advice));
    if (share >= 1.0) return;
    if (fit.never_at_wall)
        throw Failure(fmt::format(
            "The discs hardly ever come near the wall, {:.2g} radii from it in the median, but a "
            "swirl flings them there: --container-radius {} or --scale {} is too large.{} "
            "(--misfit "
            "1 takes it as it is.)",
            fit.wall_gap, scale.container_radius, scale.pixels_per_radius, advice));
    if (fit.never_touching)
        throw Failure(fmt::format(
            "No two discs touch, their centres are {:.3g} radii apart at least in the median: "
            "--scale {} is too small; {:.3g} would let them touch. (--misfit 1 takes it as it is.)",
            2.0 * fit.closest_pair, scale.pixels_per_radius,
            scale.pixels_per_radius * fit.closest_pair));
}

}  // namespace

TrackFit fit_of(const SnapshotSeries& series, const TrackScale& scale, bool y_down) {
    std::vector<double> gaps, pairs, radii;
    FittingPhase fitting;
    std::size_t discs = 0;
    double last = 0.0;
    Vec2 middle{0.0, 0.0};
    const std::uint64_t per_frame = std::max<std::uint64_t>(series.frame(0).size(), 1);
    const std::uint64_t count = std::clamp<std::uint64_t>(max_positions / per_frame, 1,
                                                          std::min(max_frames, series.frames));
    for (std::uint64_t k = 0; k < count; ++k) {
        const Snapshot s = series.frame(k * series.frames / count);
        if (s.size() == 0) continue;
        gaps.push_back(wall_gap(s));
        radii.push_back(s.radius[0]);
        for (std::size_t i = 0; i < s.size(); ++i)
            middle = middle + (1.0 / double(s.size()) / double(count)) * s.position(i);
        if (s.size() > 1) pairs.push_back(closest_pair(s));
        if (scale.amplitude > 0.0) fitting.sample(s);
        discs = std::max(discs, s.size());
        last = s.time() / s.period;
    }
    TrackFit fit;
    if (gaps.empty()) return fit;
    fit.outside = share(gaps, [](double gap) { return gap < -sticks_out; });
    fit.wall_gap = median(gaps);
    const bool swirled = scale.amplitude > 0.0 && gaps.size() >= many_frames &&
                         last - series.frame(0).time() / series.frame(0).period > 0.9;
    fit.never_at_wall =
        swirled && share(gaps, [](double gap) { return gap < far_from_wall; }) < hardly_ever;
    if (!pairs.empty()) {
        fit.overlapping = share(pairs, [](double pair) { return pair < lie_in_each_other; });
        fit.closest_pair = median(pairs);
        fit.disc_radius = median(radii);
        fit.pairs_known = discs >= many_discs;
        fit.never_touching = swirled && discs >= many_discs && share(pairs, [](double pair) {
                                                                   return pair < far_apart;
                                                               }) < hardly_ever;
    }
    fit.phase =
        degrees_in_picture(scale.clockwise ? pi - scale.phase : scale.phase, scale.clockwise);
    fit.fitting_phase = fit.phase;
    if (!(scale.amplitude > 0.0)) return fit;
    const FittingPhase::Fit found = fitting.best(), reverse = fitting.best(true);
    const double given = fitting.protrusion();
    fit.fitting_phase = degrees_in_picture(found.phase, scale.clockwise);
    // So much sticks out with any phase: a disc by a twentieth of a radius, in every frame.
    const double noise = 0.003 * double(gaps.size());
    fit.phase_fits = apart(fit.fitting_phase, fit.phase) <= phase_tolerance ||
                     given < 1.5 * found.protrusion + noise;
    if (reverse.protrusion < 0.1 * found.protrusion && reverse.protrusion < 0.1 * given)
        fit.advice = fmt::format(
            " The discs would fit if the swirl ran the other way ({} "
            "--clockwise), with --phase {:.0f}.",
            scale.clockwise ? "without" : "with",
            degrees_in_picture(reverse.phase, scale.clockwise));
    else if (!fit.phase_fits && found.protrusion < 0.2 * given)
        fit.advice = fmt::format(" The phase that fits best is --phase {:.0f}.", fit.fitting_phase);
    else if (swirled && std::sqrt(dot(middle, middle)) > off_centre)
        fit.advice = fmt::format(
            " The middle of all places of discs lies at {:.0f},{:.0f}, and of whole swirls it is "
            "the --centre.",
            scale.swirl_centre.x +
                scale.pixels_per_radius * (scale.clockwise ? -middle.x : middle.x),
            scale.swirl_centre.y + scale.pixels_per_radius * (y_down ? -middle.y : middle.y));
    else if (quantile_of(gaps, 0.9) - quantile_of(gaps, 0.1) < steady)
        fit.advice = fmt::format(
            " They do so by the same all the way round: --container-radius {:.3g} would hold them.",
            scale.container_radius - fit.wall_gap);
    return fit;
}

SnapshotSeries smoothed_series(Tracks tracks, const TrackScale& scale, TrackSmoothing& smoothing) {
    smoothing = smooth(tracks, scale);
    SnapshotSeries series = series_of(std::move(tracks), scale);
    series.missing_energy = smoothing.missing_energy;
    return series;
}

FittedSeries fitted_series(const Tracks& tracks, const TrackScale& scale, double misfit) {
    FittedSeries fitted;
    fitted.fit = fit_of(series_of(tracks, scale), scale, tracks.y_down);
    reject_misfit(fitted.fit, scale, misfit);
    fitted.series = smoothed_series(tracks, scale, fitted.smoothing);
    fitted.remarks =
        repaired_text(tracks) + smoothing_text(fitted.smoothing) + fit_text(fitted.fit);
    if (!fitted.series.same_discs())
        fitted.remarks += fmt::format(
            "Discs come or go at {} of {} frames; who is pinned is followed anew from there.\n",
            fitted.series.breaks.size(), fitted.series.frames);
    return fitted;
}

}  // namespace swirl
