#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "swirl/math/unit_circle.hpp"
#include "swirl/run/failure.hpp"
#include "track/video/robust_statistics.hpp"
#include "track/video/tracking_steps.hpp"

namespace swirl::tracking {

namespace {

/// Share of a circle that lies outside a frame.
double share_outside(const TrackedVideo& tracked, std::size_t frame, const Vec2& centre,
                     double radius) {
    constexpr int steps = 36;  // 10 degrees
    int out = 0;
    for (int k = 0; k < steps; ++k) {
        const Vec2 p = tracked.in_frame(
            frame, tracked.lens.seen(centre + radius * unit_circle(double(k) / steps)));
        if (p.x < 0.0 || p.y < 0.0 || p.x > tracked.width - 1.0 || p.y > tracked.height - 1.0)
            ++out;
    }
    return double(out) / steps;
}

}  // namespace

std::string first_of(const std::vector<std::string>& items) {
    constexpr std::size_t most = 10;
    std::string text;
    for (std::size_t n = 0; n < std::min(most, items.size()); ++n)
        text += (n == 0 ? "" : ", ") + items[n];
    if (items.size() > most) text += fmt::format(" and {} more", items.size() - most);
    return text;
}

double share_outside(const TrackedVideo& tracked) {
    const RimCentres& rims = tracked.rims;
    double sum = 0.0;
    for (std::size_t n = 0; n < rims.centres.size(); ++n)
        sum += share_outside(tracked, rims.frames[n], rims.centres[n], tracked.rim_radius);
    return sum / std::max(1.0, double(rims.centres.size()));
}

bool is_whole(const TrackedVideo& tracked, double disc_radius, std::size_t frame) {
    const double reach = tracked.rim_radius - tracked.spacing * disc_radius;
    return share_outside(tracked, frame, tracked.container(frame), reach) == 0.0;
}

namespace {

constexpr std::size_t min_occlusion = 4;  // frames in which a hand hides discs
constexpr double min_complete = 0.9, min_folded = 0.7, max_crowded = 0.05;  // share of the frames

/// Successive frames in each of which many discs are missing.
struct Occlusion {
    std::size_t begin = 0, end = 0;
    double share = 0.0;  // share of the discs, mean
    std::size_t size() const { return end - begin; }
};

std::int64_t number_of(const TrackedVideo& tracked, std::size_t frame) {
    return tracked.tracks.frames[frame].number;
}

bool is_seen(const TrackedVideo& tracked, std::size_t id, std::size_t frame) {
    const auto& ids = tracked.tracks.frames[frame].id;
    const auto at = std::find(ids.begin(), ids.end(), std::int64_t(id));
    return at != ids.end() && tracked.seen[frame][std::size_t(at - ids.begin())];
}

/// ", above all disc 7 in frames 12 to 40": the longest time for which a disc is missing.
std::string missing_text(const TrackedVideo& tracked) {
    std::size_t disc = 0, begin = 0, end = 0;
    for (std::size_t id = 0; id < tracked.number; ++id)
        for (std::size_t k = 0, from = 0; k < tracked.seen.size(); ++k) {
            if (is_seen(tracked, id, k)) from = k + 1;
            if (k + 1 - from > end - begin) disc = id, begin = from, end = k + 1;
        }
    return begin == end ? ""
                        : fmt::format(", above all disc {} in frames {} to {}", disc,
                                      number_of(tracked, begin), number_of(tracked, end - 1));
}

/// ", such as one at (120, 84) in frame 3": a circle beyond the number of discs.
std::string extra_text(const TrackedVideo& tracked) {
    if (!tracked.extra) return "";
    const Vec2 at =
        tracked.in_frame(tracked.extra->frame, tracked.lens.seen(tracked.extra->position));
    return fmt::format(", such as one at ({:.0f}, {:.0f}) in frame {}", at.x, at.y,
                       number_of(tracked, tracked.extra->frame));
}

Occlusion longest_occlusion(const TrackedVideo& tracked) {
    constexpr double min_share = 0.2;   // share of the discs
    constexpr std::size_t minimum = 3;  // discs: of very few, one is a large share
    Occlusion longest, here;
    for (std::size_t k = 0; k <= tracked.seen.size(); ++k) {
        std::size_t missing = 0;
        if (k < tracked.seen.size()) missing = tracked.number - tracked.number_seen(k);
        if (missing >= minimum && double(missing) >= min_share * double(tracked.number)) {
            if (here.end != k) here = {k, k, 0.0};
            ++here.end;
            here.share += double(missing) / double(tracked.number);
        } else if (here.size() > longest.size()) {
            longest = here;
        }
    }
    if (longest.size() > 0) longest.share /= double(longest.size());
    return longest;
}

/// How to leave out a part at the beginning or at the end; empty for any other part.
std::string omission_text(const Occlusion& occlusion, const TrackedVideo& tracked) {
    constexpr std::size_t one_in = 10;  // frames that may be left out in addition
    const std::size_t frames = tracked.seen.size();
    if (one_in * occlusion.begin < frames)
        return fmt::format("--first-frame {} leaves these frames out",
                           number_of(tracked, occlusion.end - 1) + 1);
    if (one_in * (frames - occlusion.end) < frames)
        return fmt::format("--last-frame {} leaves these frames out",
                           number_of(tracked, occlusion.begin) - 1);
    return "";
}

template <typename... Values>
void warn(TrackedVideo& tracked, fmt::format_string<Values...> text, Values&&... values) {
    tracked.warnings.push_back(fmt::format(text, std::forward<Values>(values)...));
}

void warn_about_motion(TrackedVideo& tracked) {
    constexpr double min_periods = 1.0, min_per_period = 24.0, min_used = 0.9;
    constexpr std::size_t max_missed = 20;  // one rim in 20 may be missed
    const double per_period = 2.0 * pi / (tracked.path.omega * tracked.step());
    const double periods = tracked.periods();
    if (periods < min_periods)
        warn(tracked, "the video shows {:.2f} periods; Ω and the centre need at least one",
             periods);
    if (per_period < min_per_period)
        warn(tracked,
             "there are only {:.1f} frames per period: discs may be confused, and their spins "
             "cannot be measured; use 60 or more (the paper has 511)",
             per_period);
    if (tracked.wandering > 0.0)
        warn(tracked,
             "the centre of the container's path wanders by {:.1f} pixels, as if a hand moved it; "
             "the phase is that about the local centre, and positions are relative to the rim of "
             "each frame",
             tracked.wandering);
    if (tracked.path.used < min_used)
        warn(tracked,
             "in {:.0f} % of the frames the rim is not on the fitted path: something may cover it, "
             "the camera may have moved, or the motion changed during the video",
             100.0 * (1.0 - tracked.path.used));
    if (tracked.rims_missed * max_missed > static_cast<std::size_t>(tracked.frame_count))
        warn(tracked, "the rim was not found in {:.0f} % of the frames",
             100.0 * double(tracked.rims_missed) / double(tracked.frame_count));
}

void warn_about_fields(TrackedVideo& tracked) {
    if (tracked.reading.fields == FieldOrder::progressive) return;
    warn(tracked,
         "the video is interlaced: the {} rows of each frame, which were taken later, are replaced "
         "by estimates; ffmpeg -i VIDEO -vf bwdif=mode=send_field:parity={}:deint=all "
         "-qp 16 twice.mp4 makes a video with twice as many frames per period",
         tracked.reading.fields == FieldOrder::top_first ? "odd" : "even",
         parity_of(tracked.reading.fields));
}

void warn_about_wall(TrackedVideo& tracked) {
    constexpr double max_off = 0.06;     // disc radii between the rim and the discs' reach
    constexpr double max_beyond = 0.05;  // disc radii from the centres to the circle
    const double inside = tracked.rim_radius - tracked.reach, limit = max_off * tracked.radius;
    if (inside > limit && !tracked.wall_reached)
        warn(tracked,
             "discs are at the wall too seldom to determine its radius: the visible rim, with a "
             "radius of {:.2f} pixels, is used; if it is the outer edge of the wall, the container "
             "is smaller",
             tracked.rim_radius);
    else if (inside > limit)
        warn(tracked,
             "the visible rim has a radius of {:.2f} pixels, but discs never come farther out than "
             "{:.2f}: the rim is the outer edge of the wall, and the smaller radius is used",
             tracked.rim_radius, tracked.reach);
    if (-inside > limit)
        warn(
            tracked,
            "discs seem to come {:.2f} pixels farther out than the visible rim, which has a radius "
            "of {:.2f} pixels: positions relative to the container err by as much; the rim is used",
            -inside, tracked.rim_radius);
    if (length(tracked.rim_shift) > 0.0)
        warn(tracked,
             "the circle at which discs are stopped is {:.2f} pixels away from the visible rim, as "
             "if the camera saw the rim at an angle and at another height; this circle and its "
             "path are used",
             length(tracked.rim_shift));
    if (tracked.tilt.oval)
        warn(tracked,
             "the container looks elongated in another direction than a tilted camera explains: it "
             "is not round, or its rim is not flat; distances in different directions are not "
             "comparable to better than that");
    // A shake that was taken from the rim is in the residual, but no longer in the positions.
    if (tracked.path.residual > max_beyond * tracked.radius && !tracked.camera.from_rim)
        warn(
            tracked,
            "the centre of the container is {:.2f} pixels off the circle that fits its path, as on "
            "a polygon of few sides; positions relative to the container, and its radius, may be "
            "wrong by as much",
            tracked.path.residual);
}

void warn_about_errors(TrackedVideo& tracked) {
    constexpr double max_factor = 1.5;
    if (tracked.contact_fitted && tracked.error_factor > max_factor)
        warn(tracked,
             "the claimed error of a position, {:.2f} pixels, is right within a factor of {:.1f} "
             "only: few discs touch each other, or light from one side may have shifted all; a "
             "longer video and even light determine it better",
             tracked.position_error, tracked.error_factor);
    if (tracked.contact_ratio == 0.0)
        warn(tracked,
             "discs touch each other too seldom to confirm their radius: the visible outline is "
             "used, which may err by {:.1f} % of the radius",
             100.0 * tracked.contact_error);
}

void warn_about_discs(double outside, TrackedVideo& tracked) {
    const Occlusion occlusion = longest_occlusion(tracked);
    const bool hidden = occlusion.size() >= min_occlusion && outside <= complete_rim;
    const std::string omission = omission_text(occlusion, tracked);
    std::vector<std::string> swaps;
    if (hidden)
        warn(tracked,
             "in frames {} to {} about {:.0f} % of the discs are missing at once{}: something "
             "covered the container, perhaps a hand; a disc may have different IDs before and "
             "after{}{}",
             number_of(tracked, occlusion.begin), number_of(tracked, occlusion.end - 1),
             100.0 * occlusion.share, missing_text(tracked), omission.empty() ? "" : "; ",
             omission);
    for (const PossibleSwap& swap : tracked.swaps)
        swaps.push_back(fmt::format("{} and {} in frame {} ({:.0f} %)", swap.first, swap.second,
                                    number_of(tracked, swap.frame), 100.0 * swap.chance));
    if (!swaps.empty())
        warn(tracked,
             "some IDs are uncertain: discs that were hidden or fast may have swapped theirs: {}",
             first_of(swaps));
    if (tracked.opposed)
        warn(tracked,
             "dark and bright discs are tracked together: light from one side shifts them in "
             "opposite directions, so discs of one brightness give more accurate positions");
    const double crowded = double(tracked.crowded) / double(tracked.frame_count);
    if ((tracked.complete_share < min_complete && !hidden) || crowded > max_crowded)
        warn(tracked,
             "all {} discs are detected in {:.1f} % of the frames{}, and {:.0f} % have more "
             "circles{}: more even light, less glare, a sharper image or a shorter exposure would "
             "help",
             tracked.number, 100.0 * tracked.complete_share, missing_text(tracked), 100.0 * crowded,
             extra_text(tracked));
}

/// The number of discs that a seventh of the frames show.
double number_found(const TrackedVideo& tracked) {
    std::vector<double> numbers;
    for (std::size_t k = 0; k < tracked.seen.size(); ++k)
        numbers.push_back(double(tracked.number_seen(k)));
    return quantile(numbers, 1.0 - counted_frames);
}

/// Throws Failure if discs may be outside the frame too often to be counted.
void reject_discs_outside(const TrackedVideo& tracked) {
    const double frames = double(tracked.seen.size()), found = number_found(tracked);
    if (tracked.whole >= counted_frames * frames ||
        (tracked.number_given && found >= double(*tracked.number_given)))
        return;
    throw Failure(fmt::format(
        "{}{:.0f} discs are found, and in {:.0f} % of the frames others may be outside the frame\n"
        "hint: record again with the whole container in the frame. If all discs are in it at some "
        "time, count them, and give --discs.",
        tracked.number_given ? fmt::format("--discs is {}, but ", *tracked.number_given) : "",
        found, 100.0 * (1.0 - tracked.whole / frames)));
}

/// Throws UncertainDiscs if the video contradicts the number that the user gave.
void reject_contradicted_number(const TrackedVideo& tracked) {
    constexpr double most = 0.5;         // share of the frames
    constexpr double max_excess = 0.05;  // share of the discs: phantoms are rejected
    const double given = double(*tracked.number_given), crowded = double(tracked.crowded),
                 excess = double(tracked.rejected) / std::max(crowded, 1.0),
                 found = number_found(tracked);
    const bool fewer = found < given, more = crowded >= most * double(tracked.frame_count) &&
                                             excess > std::max(1.0, max_excess * given);
    if (fewer || more)
        throw UncertainDiscs(fmt::format(
            "--discs is {}, but the video shows {:.0f}{}.\nhint: omit --discs, or give the number "
            "of discs in the container. Discs that are hidden or blurred need a better view.",
            given, fewer ? std::floor(found) : given + excess, fewer ? "" : extra_text(tracked)));
}

/// Throws UncertainDiscs if a third of the video shows no disc. Resting discs look like the floor.
void reject_hidden_discs(const TrackedVideo& tracked) {
    constexpr double most = 1.0 / 3.0, all = 0.9;  // share of the frames, of the discs
    const Occlusion missing = longest_occlusion(tracked);
    if (double(missing.size()) < most * double(tracked.seen.size()) || missing.share < all) return;
    const std::string omission = omission_text(missing, tracked);
    throw UncertainDiscs(fmt::format(
        "in frames {} to {} no disc is visible: they are covered, the light changes, or they rest "
        "for so long that they look like the floor.\nhint: {}.",
        number_of(tracked, missing.begin), number_of(tracked, missing.end - 1),
        omission.empty() ? "--first-frame and --last-frame limit the video to frames in which the "
                           "container moves"
                         : omission));
}

}  // namespace

void reject_contradicted_discs(const TrackedVideo& tracked) {
    reject_discs_outside(tracked);
    reject_hidden_discs(tracked);
    if (tracked.number_given) return reject_contradicted_number(tracked);
    const double crowded = double(tracked.crowded) / double(tracked.frame_count),
                 hidden = double(longest_occlusion(tracked).size());
    // Discs outside the frame or under a hand contradict no number; a folded floor hides some.
    const double least = tracked.mixed ? min_folded : min_complete;
    if (tracked.complete_whole + hidden >= least * tracked.whole) return;
    throw UncertainDiscs(fmt::format(
        "{} discs with a radius of {:.1f} pixels were counted, but the frames contradict that: all "
        "of them are found in only {:.0f} %{}, and {:.0f} % have more{}. Some of these circles may "
        "be texture or noise.\nhint: count the discs, and give --discs; or give --disc-diameter "
        "and --container-diameter. A plain floor, more contrast and less compression help, too.",
        tracked.number, tracked.radius, 100.0 * tracked.complete_share, missing_text(tracked),
        100.0 * crowded, extra_text(tracked)));
}

void reject_confused_discs(const TrackedVideo& tracked) {
    constexpr double most = 1.0;  // possible swap for each disc and period; 0.3 with hands
    // A disc that something covered may be any of those that it covered: that is only a warning.
    const auto uncovered = [](const PossibleSwap& swap) {
        return std::max(swap.frame, swap.from) - std::min(swap.frame, swap.from) < min_occlusion;
    };
    const auto seen = std::count_if(tracked.swaps.begin(), tracked.swaps.end(), uncovered);
    const double periods = std::max(1.0, tracked.periods()),
                 swaps = double(seen) / (double(tracked.number) * periods);
    if (swaps < most) return;
    throw Failure(fmt::format(
        "the discs cannot be told apart: at {:.1f} frames per period there are {:.1f} possible "
        "swaps of IDs for each disc and period\nhint: record 16 or more frames per period, by a "
        "faster camera or a slower swirl",
        2.0 * pi / (tracked.path.omega * tracked.step()), swaps));
}

void add_warnings(TrackedVideo& tracked) {
    constexpr double min_shake = 0.5, shake_factor = 3.0;  // pixels; position errors
    constexpr double max_contact_off = 0.03;               // share of the contact ratio
    warn_about_fields(tracked);
    warn_about_motion(tracked);
    warn_about_wall(tracked);
    warn_about_errors(tracked);
    const double outside = share_outside(tracked);
    if (outside > complete_rim)
        warn(tracked,
             "the container is not entirely in the frame: {:.0f} % of its rim, averaged over a "
             "period, lies outside; discs there are not detected, and results are from a part of "
             "the container",
             std::max(100.0 * outside, 1.0));
    warn_about_discs(outside, tracked);
    if (tracked.frames_without_pose > 0)
        warn(tracked,
             "the camera moves, and in {} of {} frames the background does not show by how much; "
             "they are not used, and positions are filled in",
             tracked.frames_without_pose, tracked.frame_count);
    if (tracked.shake > std::max(min_shake, shake_factor * tracked.position_error))
        warn(
            tracked,
            "the container shakes by {:.1f} pixels from frame to frame: the camera was not steady, "
            "or the rim is hard to see; positions relative to the container err by as much",
            tracked.shake);
    if (tracked.contact_ratio > 0.0 && std::abs(tracked.contact_ratio - 1.0) > max_contact_off)
        warn(tracked,
             "discs in contact are {:.3f} times the sum of their visible radii apart, since their "
             "outlines are not sharp; the radii are corrected to that distance",
             tracked.contact_ratio);
}

}  // namespace swirl::tracking
