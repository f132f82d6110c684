#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "swirl/run/failure.hpp"
#include "swirl/run/parallel_for.hpp"
#include "swirl/tracking/appearance_template.hpp"
#include "swirl/tracking/tracking_steps.hpp"

namespace swirl {

namespace {

std::vector<cv::Mat> read_survey_frames(const TrackingSettings& settings,
                                        std::int64_t frame_count) {
    constexpr std::size_t maximum = survey_frames + 2;  // the division below rounds down
    Video video(settings.video, std::max<std::int64_t>(1, frame_count / survey_frames));
    cv::Mat grey;
    std::vector<cv::Mat> images;
    while (images.size() < maximum && video.next(grey)) {
        settings.throw_if_stopped();
        images.push_back(grey.clone());
        settings.report_progress("surveying the video", double(images.size()) / double(maximum));
    }
    return images;
}

std::vector<PreparedFrame> prepare_all(const std::vector<cv::Mat>& images, double reduction,
                                       const TrackingSettings& settings) {
    constexpr double blur = 1.0;  // pixels, against noise: the edge of a rim is broader
    std::vector<std::optional<PreparedFrame>> prepared(images.size());
    parallel_for(
        images.size(),
        [&](std::size_t k) {
            settings.throw_if_stopped();
            prepared[k].emplace(images[k], reduction, blur);
        },
        thread_count(settings));
    std::vector<PreparedFrame> frames;
    for (auto& frame : prepared) frames.push_back(std::move(*frame));
    return frames;
}

/// The discs' appearance, from a part of the frames.
ParticleAppearance survey_appearance(const std::vector<cv::Mat>& images,
                                     const std::vector<PreparedFrame>& frames, double reduction,
                                     const ContainerRim& known_rim,
                                     const TrackingSettings& settings) {
    constexpr std::size_t enough = 24;  // frames: discs are many, and their survey is slow
    std::vector<PreparedFrame> part;
    std::vector<CircleFit> rims;
    const std::size_t stride = std::max<std::size_t>(1, frames.size() / enough);
    for (std::size_t k = 0; k < frames.size(); k += stride) {
        settings.throw_if_stopped();
        const CircleFit rim = find_container_rim(frames[k], known_rim);
        if (!rim.good) continue;
        rims.push_back(rim);
        part.emplace_back(images[k], reduction, survey_blur);
    }
    if (part.empty()) throw Failure("no container found in the frames");
    settings.throw_if_stopped();
    return survey_particles(part, rims, thread_count(settings));
}

/// Learns the discs' mean appearance, for videos with poor edges.
void learn_appearance(const std::vector<cv::Mat>& images, const TrackingSettings& settings,
                      VideoSurvey& survey) {
    std::vector<std::optional<AppearanceTemplate::Example>> found(images.size());
    parallel_for(
        images.size(),
        [&](std::size_t k) {
            settings.throw_if_stopped();
            const PreparedFrame frame(images[k], survey.reduction(), survey.appearance.blur);
            const CircleFit rim = find_container_rim(frame, survey.rim);
            if (rim.good)
                found[k] = {frame.sharp, rim, find_particles(frame, rim, survey.appearance)};
        },
        thread_count(settings));
    std::vector<AppearanceTemplate::Example> examples;
    for (auto& example : found)
        if (example) examples.push_back(std::move(*example));
    settings.throw_if_stopped();
    if (auto learned =
            AppearanceTemplate::learned(examples, survey.appearance, thread_count(settings)))
        survey.appearance.appearance_template =
            std::make_shared<const AppearanceTemplate>(std::move(*learned));
}

}  // namespace

VideoSurvey survey_video(const TrackingSettings& settings, std::int64_t frame_count) {
    constexpr double min_side = 64.0;      // pixels: smaller frames show no discs
    constexpr double rim_side = 300.0;     // pixels: enough to find the rim
    constexpr double particle_side = 1.3;  // times that, for discs: they are smaller
    const std::vector<cv::Mat> images = read_survey_frames(settings, frame_count);
    VideoSurvey survey;
    survey.size = images.front().size();
    const double side = std::min(survey.size.width, survey.size.height);
    if (side < min_side)
        throw Failure(fmt::format("the frames of '{}' have {}x{} pixels, too few to show discs",
                                  settings.video, survey.size.width, survey.size.height));
    const std::vector<PreparedFrame> frames =
        prepare_all(images, std::min(1.0, rim_side / side), settings);
    survey.rim = survey_container_rim(frames);
    survey.appearance = survey_appearance(
        images, frames, std::min(1.0, particle_side * rim_side / side), survey.rim, settings);
    settings.throw_if_stopped();
    survey.tilt = find_tilt(frames, settings.camera, survey.rim, survey.appearance.lens);
    learn_appearance(images, settings, survey);
    return survey;
}

}  // namespace swirl
