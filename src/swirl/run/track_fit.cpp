#include "swirl/run/track_fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "swirl/math/median.hpp"
#include "swirl/math/unit_circle.hpp"
#include "swirl/measure/container_fit.hpp"
#include "swirl/run/failure.hpp"

namespace swirl {
namespace {

constexpr std::uint64_t max_frames = 400, max_positions = 40000;
// A tracker's positions are accurate to a few hundredths of a radius.
constexpr double protrusion = 0.2;  // radii
constexpr double overlap = 0.85;    // fraction of the sum of two radii
// In a swirled container, discs are always flung against the wall and each other.
constexpr double far_from_wall = 0.5;  // radii
constexpr double far_apart = 1.15;     // fraction of the sum of two radii
constexpr double hardly_ever = 0.1;    // fraction of the frames
constexpr std::size_t many_frames = 50, many_discs = 8;
// Thresholds of the possible causes, in radii.
constexpr double off_centre = 0.7, constant_gap = 0.35;
// Deviations that deserve a remark.
constexpr double loose_fit = 0.15;       // radii
constexpr double phase_tolerance = 3.0;  // degrees
constexpr double longest_window = 10.0;  // frames: smoothed over more, a jump is not sharp
// Protrusion that remains even with the best phase: a twentieth of a radius of one disc per frame.
constexpr double squared_protrusion_per_frame = 0.003;

template <class Holds>
double share(const std::vector<double>& values, Holds holds) {
    return double(std::count_if(values.begin(), values.end(), holds)) / double(values.size());
}

double quantile_of(std::vector<double> values, double share) {
    const auto at = values.begin() + std::ptrdiff_t(share * double(values.size() - 1));
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

/// The angle in the image, which is mirrored if the swirl ran clockwise.
double degrees_in_image(double phase, bool clockwise) {
    const double degrees = phase * 180.0 / pi, seen = clockwise ? 180.0 - degrees : degrees;
    return seen - 360.0 * std::floor(seen / 360.0);
}

/// The repairs, one line each.
std::string repaired_text(const Tracks& tracks) {
    const auto& [filled, renamed, dropped] = tracks.repaired;
    std::string text;
    if (filled > 0)
        text += fmt::format("{} positions missing for up to five frames were filled in.\n", filled);
    if (renamed > 0)
        text +=
            fmt::format("{} times a disc changed its ID; the original ID was restored.\n", renamed);
    if (dropped > 0)
        text +=
            fmt::format("{} positions of discs seen in a single frame were omitted.\n", dropped);
    return text;
}

double angle_between(double a, double b) { return std::abs(std::remainder(a - b, 360.0)); }

/// Remarks on small misfits, one line each.
std::string fit_text(const TrackFit& fit) {
    std::string text;
    if (!fit.phase_fits)
        text += fmt::format(
            "The discs fit the container better with --phase {:.0f} than with {:.0f}.\n",
            fit.fitting_phase, fit.phase);
    if (std::abs(fit.wall_gap) > loose_fit)
        text += fmt::format(
            "The median distance of the outermost disc from the wall is {:.2g} radii, but it "
            "should be 0: check --container-radius and --scale.\n",
            fit.wall_gap);
    if (fit.pairs_known && std::abs(fit.closest_pair - 1.0) > 0.5 * loose_fit)
        text += fmt::format(
            "The median distance of the closest centres is {:.3g} radii, but it should be 2: check "
            "--scale.\n",
            2.0 * fit.closest_pair);
    return text;
}

/// The accuracy of positions and velocities, in one line.
std::string smoothing_text(const TrackSmoothing& s) {
    if (!s.done) return "";
    const std::string smoothed =
        s.bend > s.noise
            ? fmt::format(
                  "which is less than the tracks bend between two frames ({:.2g}); so they were "
                  "smoothed over {:.1f} frames only",
                  s.bend, s.window)
            : fmt::format("and were smoothed over {:.1f} frames, to {:.2g} pixels", s.window,
                          s.position_error);
    const char* const rounded = s.window > longest_window
                                    ? " This rounds sharp turns: it cannot be determined where "
                                      "discs become pinned, and the "
                                      "temperature is too low by a fifth."
                                    : "";
    return fmt::format(
        "Positions have a noise of {:.2g} pixels, {}. Between collisions, velocities are accurate "
        "to {:.2g} of the container's.{}\n",
        s.noise, smoothed, s.velocity_error(), rounded);
}

/// The scale at which the closest discs touch.
std::string scale_advice(const TrackFit& fit, const TrackScale& scale) {
    const double closest = fit.closest_pair * fit.disc_radius;
    if (!fit.pairs_known || std::abs(closest - 1.0) <= 0.5 * loose_fit) return "";
    return fmt::format(
        "the closest centres are {:.3g} radii apart, but touching discs are 2 apart; with --scale "
        "{:.3g} they would touch.",
        2.0 * closest, scale.pixels_per_radius * closest);
}

std::string percent(double share) { return fmt::format("{:.0f} %", 100.0 * share); }

/// The last line of an error: the advice, if any, and how to accept the misfit.
std::string misfit_hint(const std::string& advice, const char* accept) {
    return fmt::format("\nhint: {}{}{}", advice, advice.empty() ? "" : " ", accept);
}

/// The two discs that are closest relative to their radii: "discs 3 and 17 in frame 120".
std::string closest_discs(const Tracks& tracks, const TrackScale& scale) {
    std::string text;
    double closest = std::numeric_limits<double>::infinity();
    for (const TrackFrame& f : tracks.frames)
        for (std::size_t i = 0; i < f.id.size(); ++i)
            for (std::size_t j = 0; j < i; ++j) {
                const double radii =
                    f.radius.empty() ? 2.0 * scale.pixels_per_radius : f.radius[i] + f.radius[j];
                const Vec2 d = f.position[i] - f.position[j];
                const double apart = std::sqrt(dot(d, d)) / radii;
                if (apart >= closest) continue;
                closest = apart;
                text = fmt::format("discs {} and {} in frame {}", f.id[j], f.id[i], f.number);
            }
    return text;
}

/// Throws Failure if more than this share of the frames contradicts the calibration by `swirl
/// track`.
void reject_contradicted_calibration(const Tracks& tracks, const TrackFit& fit,
                                     const TrackScale& scale, double share) {
    if (fit.overlapping <= share && fit.outside <= share) return;
    throw Failure(fmt::format(
        "the tracks contradict themselves: discs overlap in {} of the frames, most of all {}, and "
        "discs protrude from the container in {}.\nhint: swirl track --overlay shows which circles "
        "are no discs, and --discs sets their number. swirl measure --max-invalid sets the share "
        "of frames that may do so.",
        percent(fit.overlapping), closest_discs(tracks, scale), percent(fit.outside)));
}

/// Throws Failure if more than this share of the frames contradicts the given parameters.
void reject_misfit(const TrackFit& fit, const TrackScale& scale, double share) {
    constexpr const char* allow_frames = "--max-invalid sets the share of frames that may do so.";
    constexpr const char* accept = "--max-invalid 1 accepts the tracks as they are.";
    const std::string advice = scale_advice(fit, scale);
    const std::string touching_scale =
        fmt::format("with --scale {:.3g} the closest discs would touch.",
                    scale.pixels_per_radius * fit.closest_pair);
    if (fit.overlapping > share)
        throw Failure(
            fmt::format("discs overlap in {} of the frames: their centres are {:.3g} radii apart "
                        "in the median, but at least 2 is possible; --scale {} is too large.{}",
                        percent(fit.overlapping), 2.0 * fit.closest_pair, scale.pixels_per_radius,
                        misfit_hint(touching_scale, allow_frames)));
    if (fit.outside > share)
        throw Failure(fmt::format(
            "discs protrude from the container in {} of the frames, by {:.2g} radii in the median: "
            "--scale, --centre, --phase, --amplitude, --container-radius, --omega, --camera-fps "
            "or --clockwise is wrong.{}",
            percent(fit.outside), std::max(-fit.wall_gap, 0.0),
            misfit_hint(advice.empty() ? fit.advice : advice, allow_frames)));
    if (share >= 1.0) return;
    if (fit.never_at_wall)
        throw Failure(fmt::format(
            "discs hardly ever come near the wall: the outermost is {:.2g} radii from it in the "
            "median, but a swirl flings discs against it; --container-radius {} or --scale {} is "
            "too large.{}",
            fit.wall_gap, scale.container_radius, scale.pixels_per_radius,
            misfit_hint(advice, accept)));
    if (fit.never_touching)
        throw Failure(fmt::format(
            "no two discs touch: the closest centres are {:.3g} radii apart in the median, but "
            "touching discs are 2 apart; --scale {} is too small.{}",
            2.0 * fit.closest_pair, scale.pixels_per_radius, misfit_hint(touching_scale, accept)));
}

/// The centre of all positions in the image.
Vec2 in_image(const Vec2& position, const TrackScale& scale, bool y_down) {
    const double x = scale.clockwise ? -position.x : position.x;
    const double y = y_down ? -position.y : position.y;
    return {scale.swirl_centre.x + scale.pixels_per_radius * x,
            scale.swirl_centre.y + scale.pixels_per_radius * y};
}

/// Statistics of the frames of a series, before it is compared with the parameters.
struct Survey {
    std::vector<double> gaps, pairs, radii;  // one for each frame with discs
    FittingPhase fitting;
    std::size_t max_discs = 0;
    double periods = 0.0;   // time between the first and the last frame
    Vec2 centre{0.0, 0.0};  // mean of all positions
};

Survey survey_of(const SnapshotSeries& series, const TrackScale& scale) {
    Survey survey;
    double last = 0.0;
    const std::uint64_t per_frame = std::max<std::uint64_t>(series.frame(0).size(), 1);
    const std::uint64_t count = std::clamp<std::uint64_t>(max_positions / per_frame, 1,
                                                          std::min(max_frames, series.frames));
    for (std::uint64_t k = 0; k < count; ++k) {
        const Snapshot s = series.frame(k * series.frames / count);
        if (s.size() == 0) continue;
        survey.gaps.push_back(wall_gap(s));
        survey.radii.push_back(s.radius[0]);
        for (std::size_t i = 0; i < s.size(); ++i)
            survey.centre =
                survey.centre + (1.0 / double(s.size()) / double(count)) * s.position(i);
        if (s.size() > 1) survey.pairs.push_back(closest_pair(s));
        if (scale.amplitude > 0.0) survey.fitting.sample(s);
        survey.max_discs = std::max(survey.max_discs, s.size());
        last = s.time() / s.period;
    }
    survey.periods = last - series.frame(0).time() / series.frame(0).period;
    return survey;
}

/// Compares the given phase with the best one, and finds the likely reason for a misfit.
void fit_phase(TrackFit& fit, const Survey& survey, const TrackScale& scale, bool y_down,
               bool swirled) {
    const FittingPhase::Fit found = survey.fitting.best(), reverse = survey.fitting.best(true);
    const double given = survey.fitting.protrusion();
    const auto& gaps = survey.gaps;
    fit.fitting_phase = degrees_in_image(found.phase, scale.clockwise);
    const double noise = squared_protrusion_per_frame * double(gaps.size());
    fit.phase_fits = angle_between(fit.fitting_phase, fit.phase) <= phase_tolerance ||
                     given < 1.5 * found.protrusion + noise;
    if (reverse.protrusion < 0.1 * found.protrusion && reverse.protrusion < 0.1 * given) {
        fit.advice = fmt::format(
            "the discs would fit if the swirl ran the other way ({} --clockwise), with --phase "
            "{:.0f}.",
            scale.clockwise ? "without" : "with", degrees_in_image(reverse.phase, scale.clockwise));
    } else if (!fit.phase_fits && found.protrusion < 0.2 * given) {
        fit.advice = fmt::format("the phase that fits best is --phase {:.0f}.", fit.fitting_phase);
    } else if (swirled && std::sqrt(dot(survey.centre, survey.centre)) > off_centre) {
        const Vec2 centre = in_image(survey.centre, scale, y_down);
        fit.advice = fmt::format(
            "the centre of all positions is {:.0f},{:.0f}; over whole periods it is the --centre.",
            centre.x, centre.y);
    } else if (quantile_of(gaps, 0.9) - quantile_of(gaps, 0.1) < constant_gap) {
        fit.advice = fmt::format(
            "they protrude equally all the way round; --container-radius {:.3g} would contain "
            "them.",
            scale.container_radius - fit.wall_gap);
    }
}

}  // namespace

TrackFit fit_of(const SnapshotSeries& series, const TrackScale& scale, bool y_down) {
    const Survey survey = survey_of(series, scale);
    TrackFit fit;
    if (survey.gaps.empty()) return fit;
    fit.outside = share(survey.gaps, [](double gap) { return gap < -protrusion; });
    fit.wall_gap = median(survey.gaps);
    const bool swirled =
        scale.amplitude > 0.0 && survey.gaps.size() >= many_frames && survey.periods > 0.9;
    fit.never_at_wall =
        swirled && share(survey.gaps, [](double gap) { return gap < far_from_wall; }) < hardly_ever;
    if (!survey.pairs.empty()) {
        fit.overlapping = share(survey.pairs, [](double pair) { return pair < overlap; });
        fit.closest_pair = median(survey.pairs);
        fit.disc_radius = median(survey.radii);
        fit.pairs_known = survey.max_discs >= many_discs;
        fit.never_touching = swirled && fit.pairs_known && share(survey.pairs, [](double pair) {
                                                               return pair < far_apart;
                                                           }) < hardly_ever;
    }
    fit.phase = degrees_in_image(scale.clockwise ? pi - scale.phase : scale.phase, scale.clockwise);
    fit.fitting_phase = fit.phase;
    if (scale.amplitude > 0.0) fit_phase(fit, survey, scale, y_down, swirled);
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
    if (scale.calibrated)
        reject_contradicted_calibration(tracks, fitted.fit, scale, misfit);
    else
        reject_misfit(fitted.fit, scale, misfit);
    fitted.series = smoothed_series(tracks, scale, fitted.smoothing);
    fitted.remarks =
        repaired_text(tracks) + smoothing_text(fitted.smoothing) + fit_text(fitted.fit);
    if (!fitted.series.same_discs())
        fitted.remarks += fmt::format(
            "Discs appear or disappear at {} of {} frames. After each of them, the search for "
            "pinned discs starts again.\n",
            fitted.series.breaks.size(), fitted.series.frames);
    return fitted;
}

}  // namespace swirl
