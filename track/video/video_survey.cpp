#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "swirl/math/unit_circle.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/parallel_for.hpp"
#include "track/video/appearance_template.hpp"
#include "track/video/contact_distance.hpp"
#include "track/video/floor_pattern.hpp"
#include "track/video/robust_statistics.hpp"
#include "track/video/shading_detection.hpp"
#include "track/video/tracking_steps.hpp"

namespace swirl::tracking {

namespace {

/// Removes images in which hardly anything has moved since the one before: many images of one state
/// count its texture as often as its discs.
void drop_repeated(std::vector<cv::Mat>& images) {
    constexpr double least = 0.4;        // of the usual change
    constexpr std::size_t minimum = 12;  // images
    std::vector<double> changes{0.0};
    for (std::size_t k = 1; k < images.size(); ++k)
        changes.push_back(cv::norm(images[k], images[k - 1], cv::NORM_L1));
    const double usual = quantile(changes, 0.9);
    std::vector<cv::Mat> chosen;
    for (std::size_t k = 0; k < images.size(); ++k)
        if (k == 0 || changes[k] > least * usual) chosen.push_back(images[k]);
    if (chosen.size() >= minimum) images = std::move(chosen);
}

std::vector<cv::Mat> read_survey_frames(const TrackingSettings& settings,
                                        std::int64_t frame_count) {
    const std::int64_t every = std::max<std::int64_t>(1, frame_count / survey_frames);
    std::size_t maximum = survey_frames + 2;  // the division rounds down
    if (settings.max_frames > 0)
        maximum = std::min(maximum, static_cast<std::size_t>((frame_count + every - 1) / every));
    Video video(settings.video, every, settings.first_frame, settings.reading);
    cv::Mat grey;
    std::vector<cv::Mat> images;
    while (images.size() < maximum && video.next(grey)) {
        settings.throw_if_stopped();
        images.push_back(grey.clone());
        settings.report_progress("surveying the video", double(images.size()) / double(maximum));
    }
    drop_repeated(images);
    return images;
}

std::vector<PreparedFrame> prepare_all(const std::vector<cv::Mat>& images, double reduction,
                                       const TrackingSettings& settings) {
    std::vector<std::optional<PreparedFrame>> prepared(images.size());
    parallel_for(
        images.size(),
        [&](std::size_t k) {
            settings.throw_if_stopped();
            prepared[k].emplace(images[k], reduction, rim_blur);
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
    if (part.empty()) throw Failure("no dish was found in the frames");
    settings.throw_if_stopped();
    KnownDiscs known;
    if (settings.discs) known.number = static_cast<std::size_t>(*settings.discs);
    known.radius_share = settings.radius_share;
    const auto by_shading = [&] {
        return survey_shading(part, rims, known, thread_count(settings));
    };
    std::optional<ParticleAppearance> found;
    try {
        const ParticleAppearance by_edges =
            survey_particles(part, rims, known, thread_count(settings));
        // Circles that are only the lit parts of balls are displaced by different amounts.
        if (by_edges.spacing > 1.0)
            if (const auto shaded = by_shading()) return *shaded;
        found = by_edges;
    } catch (const Failure&) {
        if (const auto shaded = by_shading()) return *shaded;
        throw;
    }
    found->opposite = count_opposite_discs(part, rims, *found);
    return *found;
}

std::vector<AppearanceTemplate::Example> find_examples(const std::vector<cv::Mat>& images,
                                                       const TrackingSettings& settings,
                                                       const VideoSurvey& survey) {
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
    return examples;
}

/// Soft edges give a wrong radius, and circles of that radius are displaced. If the commonest
/// distance of neighbours is far from the diameter, halves the difference: the visible outline is
/// between the edge and the contact. True if the radius changed.
bool correct_radius_by_contacts(const std::vector<AppearanceTemplate::Example>& examples,
                                ParticleAppearance& appearance) {
    std::vector<double> ratios;
    for (const AppearanceTemplate::Example& example : examples) {
        const std::vector<DetectedParticle>& discs = example.particles;
        for (std::size_t a = 0; a < discs.size(); ++a)
            for (std::size_t b = a + 1; b < discs.size(); ++b) {
                if (!discs[a].sure || !discs[b].sure) continue;
                const double radii = appearance.species[discs[a].species].radius +
                                     appearance.species[discs[b].species].radius;
                const double ratio = length(discs[a].centre - discs[b].centre) / radii;
                if (std::abs(ratio - 1.0) < contact_range) ratios.push_back(ratio);
            }
    }
    constexpr double dominates = 1.25;  // standard deviations of a distance
    const auto contact = contact_of_discs(ratios);
    if (appearance.spacing > 1.0 || !contact) return false;
    if (!appearance.shading && 1.0 - contact->at > dominates * contact->error)
        appearance.contact = contact->at;
    // A circle far inside a ball is the sharp edge of its bright part, and stays the best guide.
    constexpr double inner_edge = 1.1;
    if (std::abs(contact->at - 1.0) < max_contact_off || contact->at > inner_edge) return false;
    for (ParticleSpecies& species : appearance.species) species.radius *= 0.5 * (1.0 + contact->at);
    appearance.contact = 1.0;
    appearance.lens.ball_radius = appearance.radius();
    return true;
}

/// The gradient of the brightness over the inner part of a disc, of the contrast per radius. Its
/// sign is arbitrary: dark and bright discs differ. Texture, which has any direction, is removed.
/// Sets `both_signs` if a tenth of the discs is darker than the floor and others are brighter.
Vec2 shading_gradient(const std::vector<AppearanceTemplate::Example>& examples,
                      const ParticleAppearance& appearance, bool& both_signs) {
    constexpr double clear = 0.3, other_share = 0.1;          // of the contrast; of the discs
    constexpr double inner = 0.7, floor = 1.15, outer = 1.3;  // radii: without the edge
    double across = 0.0, diagonal = 0.0, number = 0.0;
    std::vector<double> inside, outside, levels;
    for (const AppearanceTemplate::Example& example : examples)
        for (const DetectedParticle& p : example.particles) {
            if (!p.sure) continue;
            const double radius = appearance.species[p.species].radius, reach = outer * radius;
            const int top = std::max(0, int(p.centre.y - reach) + 1),
                      bottom = std::min(example.sharp.rows - 1, int(p.centre.y + reach)),
                      left = std::max(0, int(p.centre.x - reach) + 1),
                      right = std::min(example.sharp.cols - 1, int(p.centre.x + reach));
            Vec2 sum{0.0, 0.0};
            double weight = 0.0, level_sum = 0.0, pixels = 0.0;
            for (int row = top; row <= bottom; ++row)
                for (int column = left; column <= right; ++column) {
                    const Vec2 d = (1.0 / radius) * (Vec2{double(column), double(row)} - p.centre);
                    const double level = double(example.sharp.ptr<float>(row)[column]);
                    if (dot(d, d) > floor * floor && dot(d, d) < outer * outer)
                        outside.push_back(level);
                    if (dot(d, d) > inner * inner) continue;
                    inside.push_back(level);
                    level_sum += level;
                    pixels += 1.0;
                    sum = sum + level * d;
                    weight += 0.5 * dot(d, d);
                }
            const Vec2 g = (1.0 / std::max(weight, 1e-9)) * sum;
            levels.push_back(level_sum / std::max(pixels, 1.0));
            across += g.x * g.x - g.y * g.y;
            diagonal += 2.0 * g.x * g.y;
            number += 1.0;
        }
    const double floor_level = median(outside), contrast = median(inside) - floor_level;
    const auto others = std::count_if(levels.begin(), levels.end(), [&](double level) {
        return (level - floor_level) / contrast < -clear;
    });
    both_signs = double(others) > other_share * number;
    if (number == 0.0 || contrast == 0.0) return {0.0, 0.0};
    const double size = std::sqrt(std::hypot(across, diagonal) / number) / contrast,
                 angle = 0.5 * std::atan2(diagonal, across);
    return size * Vec2{std::cos(angle), std::sin(angle)};
}

/// True if the template misses discs that edges show, in some of the images.
bool loses_discs(const std::vector<cv::Mat>& images, const TrackingSettings& settings,
                 const VideoSurvey& survey) {
    constexpr std::size_t enough = 6;  // images
    constexpr double min_share = 0.8;  // of the discs
    std::vector<cv::Mat> some;
    for (std::size_t k = 0; k < images.size(); k += images.size() / enough + 1)
        some.push_back(images[k]);
    const auto number_by = [&](const VideoSurvey& by) {
        std::ptrdiff_t number = 0;
        for (const AppearanceTemplate::Example& example : find_examples(some, settings, by))
            number += std::count_if(example.particles.begin(), example.particles.end(),
                                    [](const DetectedParticle& p) { return p.sure; });
        return double(number);
    };
    VideoSurvey by_edges = survey;
    by_edges.appearance.appearance_template.reset();
    return number_by(survey) < min_share * number_by(by_edges);
}

/// Learns the discs' mean appearance, for videos with poor edges.
void learn_appearance(const std::vector<cv::Mat>& images, const TrackingSettings& settings,
                      VideoSurvey& survey) {
    std::vector<AppearanceTemplate::Example> examples = find_examples(images, settings, survey);
    if (correct_radius_by_contacts(examples, survey.appearance))
        examples = find_examples(images, settings, survey);
    if (!survey.appearance.shading)
        survey.shading = shading_gradient(examples, survey.appearance, survey.both_signs);
    if (auto learned =
            AppearanceTemplate::learned(examples, survey.appearance, thread_count(settings))) {
        survey.appearance.appearance_template =
            std::make_shared<const AppearanceTemplate>(std::move(*learned));
        if (!survey.appearance.shading && loses_discs(images, settings, survey))
            survey.appearance.appearance_template.reset();
    } else if (survey.appearance.shading)
        throw UncertainDiscs(
            "the container was found, but no discs: balls were found by their shading, but they "
            "have no common appearance.\nhint: a higher contrast and less compression help.");
}

/// The typical distance of the rim from its path, pixels. Removing a mere shadow increases it.
double off_path(const std::vector<PreparedFrame>& frames, const ContainerRim& path) {
    std::vector<double> off{0.0};
    for (const PreparedFrame& frame : frames)
        if (const CircleFit rim = find_container_rim(frame, path); rim.good)
            off.push_back(std::abs(length(rim.centre - path.path_centre) - path.amplitude));
    return quantile(off, 0.5);
}

/// If the background shows that the camera moves, stabilises the images and surveys the rim again.
void remove_camera_motion(const TrackingSettings& settings, double reduction,
                          std::vector<cv::Mat>& images, std::vector<PreparedFrame>& frames,
                          VideoSurvey& survey) {
    constexpr double min_motion = 0.3;     // pixels, rms: about ten errors of a pose
    constexpr double min_known = 0.7;      // share of the frames
    constexpr double rim_width = 0.1;      // share of the radius: the outer edge of the wall
    constexpr double min_amplitude = 0.5;  // of the path: less if the background moves with it
    const double reach = survey.rim.amplitude + (1.0 + rim_width) * survey.rim.radius;
    const auto background = std::make_shared<const StaticBackground>(images[images.size() / 2],
                                                                     survey.rim.path_centre, reach);
    if (!background->usable()) return;
    std::vector<std::optional<CameraPose>> poses(images.size());
    parallel_for(
        images.size(),
        [&](std::size_t k) {
            settings.throw_if_stopped();
            poses[k] = background->pose(images[k]);
        },
        thread_count(settings));
    double square = 0.0;
    std::vector<cv::Mat> stable;
    for (std::size_t k = 0; k < images.size(); ++k) {
        if (!poses[k]) continue;
        const Vec2 moved = poses[k]->seen(survey.rim.path_centre) - survey.rim.path_centre;
        square += dot(moved, moved);
        stable.push_back(images[k]);
        stabilise(stable.back(), *poses[k]);
    }
    if (double(stable.size()) < min_known * double(images.size()) ||
        square < min_motion * min_motion * double(stable.size()))
        return;
    std::vector<PreparedFrame> again = prepare_all(stable, reduction, settings);
    const std::optional<ContainerRim> rim = find_moving_rim(again, false);
    if (!rim || rim->amplitude < min_amplitude * survey.rim.amplitude ||
        (!survey.rim.rough && off_path(again, *rim) > off_path(frames, survey.rim)))
        return;
    survey.rim = *rim;
    survey.background = background;
    images = std::move(stable);
    frames = std::move(again);
}

void remove_floor(const TrackingSettings& settings, const std::vector<cv::Mat>& seen,
                  double reduction, FloorPattern&& floor, std::vector<cv::Mat>& images,
                  std::vector<PreparedFrame>& frames, VideoSurvey& survey) {
    survey.floor = std::make_shared<const FloorPattern>(std::move(floor));
    parallel_for(
        images.size(),
        [&](std::size_t k) {
            settings.throw_if_stopped();
            images[k] = seen[k].clone();
            survey.floor->remove(images[k]);
        },
        thread_count(settings));
    frames = prepare_all(images, reduction, settings);
    if (const auto rim = find_moving_rim(frames, true)) survey.rim = *rim;
}

/// Throws Failure if the floor has no pattern.
void remove_floor_pattern(const TrackingSettings& settings, double reduction,
                          std::vector<cv::Mat>& images, std::vector<PreparedFrame>& frames,
                          VideoSurvey& survey) {
    // The edge of a patterned floor is no circle. Without the pattern the rim is found exactly, and
    // then the pattern can be learned up to the wall.
    constexpr int rounds = 2;
    const std::vector<cv::Mat> seen = images;
    for (int round = 0; round < rounds; ++round) {
        std::optional<FloorPattern> floor =
            FloorPattern::learned(seen, survey.rim, reduction, thread_count(settings));
        if (!floor) throw Failure("the floor of the container has no pattern");
        remove_floor(settings, seen, reduction, std::move(*floor), images, frames, survey);
    }
}

/// Some discs are darker and some brighter than the floor: folds the images. Throws Failure if that
/// does not show all of them.
void fold_mixed_brightness(const TrackingSettings& settings, double reduction, double detail,
                           std::vector<cv::Mat>& images, std::vector<PreparedFrame>& frames,
                           VideoSurvey& survey) {
    const ParticleAppearance one = survey.appearance;
    const std::vector<cv::Mat> seen = images;
    try {
        remove_floor(settings, seen, reduction, FloorPattern::folded(seen, survey.rim), images,
                     frames, survey);
        survey.appearance = survey_appearance(images, frames, detail, survey.rim, settings);
        if (survey.appearance.polarity > 0 && !survey.appearance.shading &&
            survey.appearance.number >= one.number + one.opposite / 2)
            return;
    } catch (const Failure&) {
        settings.throw_if_stopped();
    }
    throw Failure(
        fmt::format("there are {} {} discs and {} {} ones, but both could not be found together.\n"
                    "hint: use a floor that is darker or brighter than all discs.",
                    one.number, one.polarity > 0 ? "bright" : "dark", one.opposite,
                    one.polarity > 0 ? "dark" : "bright"));
}

/// A survey and the frames that it is made from.
struct Surveyed {
    VideoSurvey survey;
    std::vector<cv::Mat> images;
    std::vector<PreparedFrame> frames;
    double reduction = 1.0, detail = 1.0;  // of the frames for the rim, and for discs
};

/// Reads the frames and finds the rim.
Surveyed survey_rim(const TrackingSettings& settings, std::int64_t frame_count) {
    constexpr double min_side = 64.0;      // pixels: smaller frames show no discs
    constexpr double rim_side = 300.0;     // pixels: enough to find the rim
    constexpr double particle_side = 1.3;  // times that, for discs: they are smaller
    Surveyed all;
    all.images = read_survey_frames(settings, frame_count);
    all.survey.size = all.images.front().size();
    const double side = std::min(all.survey.size.width, all.survey.size.height);
    if (side < min_side)
        throw Failure(fmt::format("the frames of '{}' have {}x{} pixels, too few to show discs",
                                  settings.video, all.survey.size.width, all.survey.size.height));
    all.reduction = std::min(1.0, rim_side / side);
    all.detail = std::min(1.0, particle_side * rim_side / side);
    all.frames = prepare_all(all.images, all.reduction, settings);
    const std::optional<ContainerRim> moving = find_moving_rim(all.frames, true);
    const bool on_circle = moving && !(settings.motion_only && moving->rough);
    all.survey.rim = on_circle              ? *moving
                     : settings.motion_only ? find_rim_on_any_path(all.frames)
                                            : survey_container_rim(all.frames);
    return all;
}

void survey_discs(const TrackingSettings& settings, Surveyed& all) {
    auto& [survey, images, frames, reduction, detail] = all;
    remove_camera_motion(settings, reduction, images, frames, survey);
    if (survey.rim.rough) survey.rim.amplitude = 0.0;  // it wanders, see remove_wandering()
    survey.view = view_of_rim(frames, survey.rim);
    if (settings.patterned_floor) remove_floor_pattern(settings, reduction, images, frames, survey);
    survey.appearance = survey_appearance(images, frames, detail, survey.rim, settings);
    constexpr std::size_t one_in = 10;  // discs: fewer of the other brightness may be marks
    if (one_in * survey.appearance.opposite > survey.appearance.number && !settings.motion_only &&
        !survey.floor)
        fold_mixed_brightness(settings, reduction, detail, images, frames, survey);
    settings.throw_if_stopped();
}

/// The tilt and the appearance of discs, which need their sizes.
VideoSurvey finished_survey(const TrackingSettings& settings, Surveyed& all) {
    VideoSurvey& survey = all.survey;
    // Where edges are too poor for discs, they are too poor for the tilt.
    KnownCamera camera = settings.camera;
    if (survey.appearance.shading && !camera.tilt) camera.tilt = 0.0;
    survey.tilt = find_tilt(all.frames, camera, survey.rim, survey.appearance.lens);
    learn_appearance(all.images, settings, survey);
    return survey;
}

/// Colours of pixels inside the rim, in frames spread over the video.
std::vector<cv::Vec3b> colours_inside(const TrackingSettings& settings, std::int64_t frame_count,
                                      const Surveyed& grey) {
    constexpr std::int64_t enough = 12;   // frames
    constexpr double inside = 0.9;        // share of the rim's radius: no wall
    constexpr double per_frame = 1000.0;  // pixels
    FrameReading reading = settings.reading;
    reading.in_colours = true;
    Video video(settings.video, std::max<std::int64_t>(1, frame_count / enough),
                settings.first_frame, reading);
    const double reach = inside * grey.survey.rim.radius;
    const int stride = std::max(1, int(reach * std::sqrt(pi / per_frame)));
    std::vector<cv::Vec3b> colours;
    cv::Mat image, level;
    while (video.count() < enough && video.next(image)) {
        settings.throw_if_stopped();
        cv::cvtColor(image, level, cv::COLOR_RGB2GRAY);
        const CircleFit rim =
            find_container_rim(PreparedFrame(level, grey.reduction, rim_blur), grey.survey.rim);
        if (!rim.good) continue;
        for (int row = 0; row < image.rows; row += stride)
            for (int column = 0; column < image.cols; column += stride)
                if (length(Vec2{double(column), double(row)} - rim.centre) < reach)
                    colours.push_back(image.at<cv::Vec3b>(row, column));
        if (is_grey(colours)) break;
    }
    return colours;
}

/// The survey in a plane of colours, if it shows at least as many discs as `grey`.
/// Sets `settings.reading.plane`.
std::optional<Surveyed> survey_in_plane(ColourPlane plane, TrackingSettings& settings,
                                        std::int64_t frame_count, const VideoSurvey& grey) {
    TrackingSettings in_plane = settings;
    in_plane.reading.plane = std::make_shared<const ColourPlane>(std::move(plane));
    std::optional<Surveyed> coloured;
    try {
        coloured = survey_rim(in_plane, frame_count);
        survey_discs(in_plane, *coloured);
    } catch (const Failure&) {
        settings.throw_if_stopped();
        return std::nullopt;
    }
    if (coloured->survey.appearance.number < grey.appearance.number) return std::nullopt;
    // A hand on the rim is seen in grey, too, but a plane of colours may not show a grey rim.
    if (grey.view.hidden < coloured->survey.view.hidden) coloured->survey.view = grey.view;
    settings = std::move(in_plane);
    return coloured;
}

}  // namespace

VideoSurvey survey_video(TrackingSettings& settings, std::int64_t frame_count) {
    Surveyed grey = survey_rim(settings, frame_count);
    std::optional<ColourPlane> plane;
    if (!settings.motion_only)
        plane = ColourPlane::proposed(colours_inside(settings, frame_count, grey));
    std::exception_ptr failed;
    try {
        survey_discs(settings, grey);
    } catch (const Failure&) {
        settings.throw_if_stopped();
        failed = std::current_exception();
        grey.survey.appearance.number = 0;
    }
    if (plane)
        if (auto coloured = survey_in_plane(std::move(*plane), settings, frame_count, grey.survey))
            return finished_survey(settings, *coloured);
    try {
        if (failed) std::rethrow_exception(failed);
        return finished_survey(settings, grey);
    } catch (const UncertainDiscs& failure) {
        rethrow_with_cause(failure, grey.survey.view);
    } catch (const Failure& failure) {
        rethrow_with_cause(failure, grey.survey.view);
    }
}

}  // namespace swirl::tracking
