#include "track/video/tracking.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>

#include "swirl/math/unit_circle.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/parallel_for.hpp"
#include "track/video/robust_statistics.hpp"
#include "track/video/tracking_steps.hpp"

namespace swirl::tracking {

void TrackingSettings::throw_if_stopped() const {
    if (stop && stop->load())
        throw Interrupted("stopped while the video was tracked; nothing was written.");
}

unsigned thread_count(const TrackingSettings& settings) {
    return settings.threads ? settings.threads : available_cores();
}

double TrackedVideo::step() const {
    std::vector<double> steps;
    for (std::size_t k = 1; k < times.size(); ++k)
        if (!rests_in(k)) steps.push_back(times[k] - times[k - 1]);
    return quantile(steps, 0.5);
}

double TrackedVideo::periods() const {
    return (times.back() - times.front() + step()) * path.omega / (2.0 * pi);
}

TrackScale TrackedVideo::scale() const {
    TrackScale s;
    s.frames_per_time = fps > 0.0 ? fps : 1.0;
    s.pixels_per_radius = radius;
    s.swirl_centre = path.centre;
    s.period = 2.0 * pi / path.omega;
    s.amplitude = path.amplitude / radius;
    s.phase = path.angle(0.0);
    s.container_radius = container_radius / radius;
    s.clockwise = path.clockwise;
    return s;
}

namespace {

/// Number of discs that `counts` accepts: the largest number of sure discs that is reached in more
/// than a seventh of the frames; of those that show all of the container, if they are enough.
template <typename Counts>
std::size_t count_discs(const Detections& all, const TrackedVideo& tracked, double radius,
                        Counts&& counts) {
    std::vector<double> numbers, whole;
    for (std::size_t k = 0; k < all.size(); ++k) {
        if (!all[k].rim.good) continue;
        numbers.push_back(
            double(std::count_if(all[k].particles.begin(), all[k].particles.end(),
                                 [&](const auto& p) { return p.sure && counts(p.species); })));
        if (is_whole(tracked, radius, k)) whole.push_back(numbers.back());
    }
    if (double(whole.size()) >= counted_frames * double(numbers.size())) numbers = whole;
    return std::size_t(quantile(numbers, 1.0 - counted_frames));
}

/// Numbers of the two species that are most common among frames with `total` sure discs.
std::optional<std::array<std::size_t, 2>> common_composition(const Detections& all,
                                                             std::size_t total) {
    std::map<std::size_t, std::size_t> frames_with;  // number of the second species
    for (const FrameDetections& found : all) {
        std::array<std::size_t, 2> number{};
        for (const DetectedParticle& p : found.particles)
            if (p.sure) ++number[p.species];
        if (number[0] + number[1] == total) ++frames_with[number[1]];
    }
    const auto best =
        std::max_element(frames_with.begin(), frames_with.end(),
                         [](const auto& a, const auto& b) { return a.second < b.second; });
    if (best == frames_with.end()) return std::nullopt;
    return std::array{total - best->first, best->first};
}

/// Sets the species and their numbers of discs.
void set_species(const TrackingSettings& settings, const ParticleAppearance& appearance,
                 const Detections& all, TrackedVideo& tracked) {
    for (std::size_t k = 0; k < appearance.species.size(); ++k)
        tracked.species.push_back({appearance.species[k].radius, appearance.species[k].scatter,
                                   count_discs(all, tracked, appearance.radius(),
                                               [k](std::size_t species) { return species == k; })});
    if (tracked.species.size() == 2) {
        // A disc whose size is ambiguous is of either species in some frames: it counts once.
        const std::size_t counted = count_discs(all, tracked, appearance.radius(),
                                                [](std::size_t) { return true; }),
                          sum = tracked.species[0].number + tracked.species[1].number,
                          total = settings.discs ? static_cast<std::size_t>(*settings.discs)
                                                 : std::min(counted, sum);
        if (sum != total) {
            const auto numbers = common_composition(all, total);
            if (!numbers && settings.discs)
                throw UncertainDiscs(fmt::format(
                    "--discs is {}, but no frame shows this number: discs of two sizes are found, "
                    "{} in most frames. Some of these circles may be texture or noise.\n"
                    "hint: use a plain floor, or give --disc-diameter and --container-diameter.",
                    total, counted));
            if (numbers) {
                tracked.species[0].number = (*numbers)[0];
                tracked.species[1].number = (*numbers)[1];
            }
        }
    }
    if (settings.discs) tracked.number_given = static_cast<std::size_t>(*settings.discs);
    if (settings.discs && tracked.species.size() == 1)
        tracked.species[0].number = static_cast<std::size_t>(*settings.discs);
    // The first one of the most frequent.
    tracked.radius =
        std::max_element(tracked.species.begin(), tracked.species.end(),
                         [](const auto& a, const auto& b) { return a.number < b.number; })
            ->radius;
}

/// All steps after the detection. Throws Failure, and UncertainDiscs.
void finish_tracking(const TrackingSettings& settings, const VideoSurvey& survey,
                     const VideoTimes& times, Detections& all, TrackedVideo& tracked) {
    constexpr std::size_t min_frames = 8;  // frames to fit a path
    tracked.width = survey.size.width;
    tracked.height = survey.size.height;
    tracked.bright = survey.appearance.polarity > 0;
    tracked.mixed = survey.floor && survey.floor->folds();
    tracked.opposed = tracked.mixed || survey.both_signs;
    tracked.tilt = survey.tilt;
    tracked.spacing = survey.appearance.spacing;
    if (tracked.spacing > 1.0) tracked.contact_ratio = tracked.spacing;
    if (survey.rim.second_container)
        tracked.warnings.emplace_back(
            "there is a second circle of the container's size: of two containers in the frame, the "
            "one with the clearer rim was followed; crop the video to one of them");
    constexpr std::size_t min_opposite = 2;  // a single one may be a mark on the floor
    if (survey.appearance.opposite >= min_opposite)
        tracked.warnings.push_back(
            fmt::format("there are also {} {} discs, which are not tracked: use a floor that is {} "
                        "than all discs",
                        survey.appearance.opposite, tracked.bright ? "dark" : "bright",
                        tracked.bright ? "darker" : "brighter"));
    collect_camera_motion(all, tracked);
    correct_lens(survey, all, tracked);
    tracked.frame_count = static_cast<std::int64_t>(all.size());
    if (all.size() < min_frames)
        throw Failure(fmt::format("'{}' has {} frames, too few to determine the path: at least {}",
                                  settings.video, all.size(), min_frames));
    const bool uneven_times = set_frame_times(settings, times, all, tracked);
    fit_container_motion(settings, survey.rim, uneven_times, all, tracked);
    set_species(settings, survey.appearance, all, tracked);

    const Links links = link_detections(settings, survey, all, tracked);
    assemble_tracks(all, links, settings.first_frame, tracked);
    if (tracked.number == 0) throw Failure("no disc could be followed through the video");
    find_wall(survey, tracked);
    find_contacts(tracked);
    measure_quality(all, tracked);
    reject_contradicted_discs(tracked);
    reject_confused_discs(tracked);
    set_radii(tracked);
    if (survey.floor && !tracked.mixed)
        tracked.warnings.emplace_back(
            "the floor of the container has a pattern, which was learned from the video and "
            "removed; a plain floor gives more accurate positions");
    add_warnings(tracked);
}

/// The number of frames to track, or 0 if it is unknown. Throws Failure if there are none.
std::int64_t expected_frames(const TrackingSettings& settings, const VideoTimes& times) {
    std::int64_t expected = times.frame_count;
    if (expected > 0 && settings.first_frame >= expected)
        throw Failure(fmt::format("frame {} is the first to be tracked, but '{}' has {} frames",
                                  settings.first_frame, settings.video, expected));
    if (expected > 0) expected -= settings.first_frame;
    if (settings.max_frames > 0)
        expected = expected > 0 ? std::min(expected, settings.max_frames) : settings.max_frames;
    return expected;
}

/// A video whose frames have been searched.
struct DetectedVideo {
    VideoTimes times;
    VideoSurvey survey;
    Detections all;
};

/// Sets `settings.reading`.
DetectedVideo detect_video(TrackingSettings& settings, TrackedVideo& tracked) {
    constexpr std::int64_t assumed_frames = 4 * survey_frames;  // if the number is unknown
    cv::setNumThreads(1);  // the frames are distributed over our threads
    DetectedVideo video;
    video.times = video_times(settings.video);
    const std::int64_t expected = expected_frames(settings, video.times);
    settings.reading.fields = field_order(settings.video, settings.first_frame);
    const std::int64_t planned = expected > 0 ? expected : assumed_frames;
    if (settings.planned) settings.planned(planned, settings.spins);
    video.survey = survey_video(settings, planned);
    tracked.reading = settings.reading;
    video.all = detect_frames(settings, video.survey, expected, tracked);
    return video;
}

TrackedVideo detect_and_link(TrackingSettings settings) {
    TrackedVideo tracked;
    auto [times, survey, all] = detect_video(settings, tracked);
    try {
        finish_tracking(settings, survey, times, all, tracked);
    } catch (const UncertainDiscs& failure) {
        if (!tracked.damage.empty()) throw;
        rethrow_with_cause(failure, survey.view);
    } catch (const Failure& failure) {
        // Causes that no other message states.
        std::string cause;
        if (!tracked.damage.empty())
            cause = fmt::format("; the video is damaged, ffmpeg reports: {}", tracked.damage);
        else if (share_outside(tracked) > complete_rim)
            cause = fmt::format("; {:.0f} % of the container's rim lies outside the frame",
                                100.0 * share_outside(tracked));
        if (cause.empty()) throw;
        std::string text = failure.what();
        text.insert(std::min(text.find('\n'), text.size()), cause);
        throw Failure(text);
    }
    return tracked;
}

}  // namespace

TrackedVideo track_container(const TrackingSettings& given) {
    TrackingSettings settings = given;
    settings.motion_only = true;
    TrackedVideo tracked;
    auto [times, survey, all] = detect_video(settings, tracked);
    collect_camera_motion(all, tracked);
    correct_lens(survey, all, tracked);
    tracked.frame_count = static_cast<std::int64_t>(all.size());
    set_frame_times(settings, times, all, tracked);
    tracked.rims = rim_centres(all, tracked);
    tracked.tilt = survey.tilt;
    tracked.radius = survey.appearance.spacing * survey.appearance.radius();
    tracked.container_radius = tracked.rim_radius;
    return tracked;
}

TrackedVideo track_video(const TrackingSettings& settings) {
    try {
        return detect_and_link(settings);
    } catch (const UncertainDiscs&) {
        TrackingSettings again = settings;
        again.patterned_floor = true;
        try {
            return detect_and_link(again);
        } catch (const Failure&) {
        }
        throw;  // the first attempt states the cause
    }
}

}  // namespace swirl::tracking
