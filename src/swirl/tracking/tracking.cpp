#include "swirl/tracking/tracking.hpp"

#include <fmt/format.h>

#include <functional>
#include <map>

#include "swirl/math/unit_circle.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/parallel_for.hpp"
#include "swirl/tracking/robust_statistics.hpp"
#include "swirl/tracking/tracking_steps.hpp"

namespace swirl {

void TrackingSettings::throw_if_stopped() const {
    if (stop && stop->load())
        throw Interrupted("stopped while the video was tracked; nothing was written.");
}

unsigned thread_count(const TrackingSettings& settings) {
    return settings.threads ? settings.threads : available_cores();
}

double TrackedVideo::step() const {
    std::vector<double> steps;
    for (std::size_t k = 1; k < times.size(); ++k) steps.push_back(times[k] - times[k - 1]);
    return quantile(steps, 0.5);
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

/// Number of discs of a species: the largest number of sure discs that is reached in more than a
/// seventh of the frames, so that it is no accident.
std::size_t count_discs(const Detections& all, std::size_t species) {
    constexpr std::size_t one_in = 7;
    std::map<std::size_t, std::size_t, std::greater<>> frames_with;
    std::size_t frames = 0;
    for (const FrameDetections& found : all) {
        if (!found.rim.good) continue;
        ++frames;
        ++frames_with[static_cast<std::size_t>(
            std::count_if(found.particles.begin(), found.particles.end(),
                          [&](const Particle& p) { return p.sure && p.species == species; }))];
    }
    std::size_t so_far = 0;
    for (const auto& [number, count] : frames_with) {
        so_far += count;
        if (so_far * one_in > frames) return number;
    }
    return 0;
}

}  // namespace

void set_species(const TrackingSettings& settings, const ParticleAppearance& appearance,
                 const Detections& all, TrackedVideo& tracked) {
    for (std::size_t k = 0; k < appearance.species.size(); ++k)
        tracked.species.push_back(
            {appearance.species[k].radius, appearance.species[k].scatter, count_discs(all, k)});
    if (settings.discs && tracked.species.size() == 1)
        tracked.species[0].number = static_cast<std::size_t>(*settings.discs);
    // The first one of the most frequent.
    tracked.radius =
        std::max_element(tracked.species.begin(), tracked.species.end(),
                         [](const auto& a, const auto& b) { return a.number < b.number; })
            ->radius;
}

void finish_tracking(const TrackingSettings& settings, const VideoSurvey& survey,
                     const VideoTimes& times, Detections& all, TrackedVideo& tracked) {
    constexpr std::size_t min_frames = 8;  // to fit a path
    tracked.width = survey.size.width;
    tracked.height = survey.size.height;
    tracked.bright = survey.appearance.polarity > 0;
    tracked.tilt = survey.tilt;
    if (survey.rim.second_container)
        tracked.warnings.emplace_back(
            "there is a second circle of the container's size: of two containers in the frame, the "
            "one with the clearer rim was followed; crop the video to one of them");
    collect_camera_motion(all, tracked);
    correct_lens(survey, all, tracked);
    tracked.frame_count = static_cast<std::int64_t>(all.size());
    if (all.size() < min_frames)
        throw Failure(fmt::format("'{}' has {} frames, too few to determine the path: at least {}",
                                  settings.video, all.size(), min_frames));
    const bool uneven_times = set_frame_times(settings, times, all, tracked);
    fit_container_motion(settings, uneven_times, all, tracked);
    set_species(settings, survey.appearance, all, tracked);

    const Links links = link_detections(settings, survey, all, tracked);
    separate_overlaps(links, all, tracked);
    assemble_tracks(all, links, settings.first_frame, tracked);
    if (tracked.number == 0) throw Failure("no disc could be followed through the video");

    if (tracked.lens.tilted()) move_path_to_wall(tracked);
    measure_quality(all, tracked);
    set_radii(tracked);
    add_warnings(tracked);
}

TrackedVideo track_video(const TrackingSettings& settings) {
    constexpr std::int64_t assumed_frames = 4 * survey_frames;  // if the number is unknown
    TrackedVideo tracked;
    cv::setNumThreads(1);  // the frames are distributed over our threads
    const VideoTimes times = video_times(settings.video);
    std::int64_t expected = times.frame_count;
    if (expected > 0 && settings.first_frame >= expected)
        throw Failure(fmt::format("frame {} is the first to be tracked, but '{}' has {} frames",
                                  settings.first_frame, settings.video, expected));
    if (expected > 0) expected -= settings.first_frame;
    if (settings.max_frames > 0)
        expected = expected > 0 ? std::min(expected, settings.max_frames) : settings.max_frames;
    const std::int64_t planned = expected > 0 ? expected : assumed_frames;
    if (settings.planned) settings.planned(planned, settings.spins);
    const VideoSurvey survey = survey_video(settings, planned);
    Detections all = detect_frames(settings, survey, expected, tracked);
    finish_tracking(settings, survey, times, all, tracked);
    return tracked;
}

}  // namespace swirl
