#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <future>

#include "swirl/run/failure.hpp"
#include "swirl/run/parallel_for.hpp"
#include "track/video/contact_distance.hpp"
#include "track/video/robust_statistics.hpp"
#include "track/video/tracking_steps.hpp"

namespace swirl::tracking {

namespace {

/// The difference of two frames that 1 % of their pixels exceed. Edges that move by a fraction of a
/// pixel change by tens of grey levels, the compression of a duplicate changes hardly any pixel.
double change_between(const cv::Mat& before, const cv::Mat& after) {
    constexpr std::size_t one_in = 100;
    std::array<std::size_t, 256> number{};
    for (int row = 0; row < after.rows; ++row) {
        const std::uint8_t *a = before.ptr(row), *b = after.ptr(row);
        for (int column = 0; column < after.cols; ++column)
            ++number[static_cast<std::size_t>(std::abs(int(a[column]) - int(b[column])))];
    }
    std::size_t level = number.size(), above = 0;
    while (level > 1 && above * one_in <= after.total()) above += number[--level];
    return double(level);
}

bool is_skipped(const TrackingSettings& settings, std::size_t index) {
    const std::int64_t number = settings.first_frame + static_cast<std::int64_t>(index);
    return std::any_of(settings.skip.begin(), settings.skip.end(), [&](const FrameRange& range) {
        return number >= range.first && number <= range.last;
    });
}

/// Frame number `index` of those that are tracked. `before` is the frame before it, or empty.
FrameDetections detect_frame(const TrackingSettings& settings, const VideoSurvey& survey,
                             std::size_t index, const cv::Mat& before, cv::Mat image) {
    settings.throw_if_stopped();
    FrameDetections found;
    if (!before.empty()) found.change = change_between(before, image);
    if (is_skipped(settings, index)) {
        found.used = false;
        return found;
    }
    if (survey.background) {
        found.pose = survey.background->pose(image);
        if (!found.pose) return found;
        stabilise(image, *found.pose);
    }
    if (survey.floor) survey.floor->remove(image);
    const PreparedFrame frame(image, survey.reduction(), survey.appearance.blur);
    found.rim = find_container_rim(frame, survey.rim);
    if (found.rim.good && !settings.motion_only)
        found.particles = find_particles(frame, found.rim, survey.appearance);
    return found;
}

/// Combines the distortion by sizes with that by discs in contact. Not for a tilted camera: its
/// tilt was fitted with the distortion by sizes.
void add_contact_distortion(const Detections& all, const ParticleAppearance& appearance,
                            Lens& lens) {
    constexpr double near = 1.4;         // sums of radii: includes contacts, whatever the lens
    constexpr std::size_t enough = 400;  // frames
    if (lens.tilted()) return;
    std::vector<DiscPair> pairs;
    const std::size_t stride = all.size() / enough + 1;
    for (std::size_t k = 0; k < all.size(); k += stride) {
        const std::vector<DetectedParticle>& particles = all[k].particles;
        for (std::size_t a = 0; a < particles.size(); ++a)
            for (std::size_t b = a + 1; b < particles.size(); ++b) {
                if (!particles[a].sure || !particles[b].sure) continue;
                const double radii =
                    appearance.spacing * (appearance.species[particles[a].species].radius +
                                          appearance.species[particles[b].species].radius);
                if (length(particles[a].centre - particles[b].centre) < near * radii)
                    pairs.push_back({particles[a].centre, particles[b].centre, radii});
            }
    }
    const auto found = distortion_of(pairs, lens.image_centre, lens.half_height);
    if (!found) return;
    lens.contact_k = found->k;
    lens.contact_k_error = found->error;
    lens.combine_distortions();
}

}  // namespace

// A batch of frames is shared between the threads while the next one is read.
Detections detect_frames(const TrackingSettings& settings, const VideoSurvey& survey,
                         std::int64_t expected, TrackedVideo& tracked) {
    constexpr std::size_t per_thread = 4;  // frames: threads wait little for the slowest one
    const unsigned threads = thread_count(settings);
    Video video(settings.video, 1, settings.first_frame, settings.reading);
    Detections all;
    struct Batch {
        std::vector<cv::Mat> images;
        std::size_t number = 0;
    } now, next;
    cv::Mat previous;
    now.images.resize(per_thread * threads);
    next.images.resize(per_thread * threads);
    const auto read = [&](Batch& batch) {
        for (batch.number = 0; batch.number < batch.images.size(); ++batch.number) {
            if (settings.max_frames > 0 && video.count() >= settings.max_frames) return;
            cv::Mat& image = batch.images[batch.number];
            if (!video.next(image)) return;
            if (image.size() != survey.size)
                throw Failure(fmt::format("frame {} of '{}' differs in size from the first frame",
                                          video.count(), settings.video));
        }
    };
    for (read(now); now.number > 0; std::swap(now, next)) {
        settings.throw_if_stopped();
        std::future<void> reading = std::async(std::launch::async, [&] { read(next); });
        const std::size_t begin = all.size();
        all.resize(begin + now.number);
        parallel_for(
            now.number,
            [&](std::size_t k) {
                all[begin + k] = detect_frame(settings, survey, begin + k,
                                              k > 0 ? now.images[k - 1] : previous, now.images[k]);
            },
            threads);
        reading.get();
        previous = now.images[now.number - 1].clone();
        const auto done = std::int64_t(all.size());
        settings.report_progress("finding discs",
                                 double(done) / double(std::max(expected, done + 1)));
    }
    tracked.damage = video.problem();
    if (!tracked.damage.empty())
        tracked.warnings.push_back(
            fmt::format("the video is damaged or cut off after {} frames; ffmpeg reports: {}",
                        all.size(), tracked.damage));
    else if (settings.max_frames == 0 && std::int64_t(all.size()) < expected)
        tracked.warnings.push_back(
            fmt::format("the video has {} frames according to its index, but only {} can be read",
                        expected, all.size()));
    return all;
}

void correct_lens(const VideoSurvey& survey, Detections& all, TrackedVideo& tracked) {
    tracked.lens = survey.appearance.lens;
    add_contact_distortion(all, survey.appearance, tracked.lens);
    std::vector<double> radii;
    for (FrameDetections& found : all) {
        if (!found.rim.good) continue;
        const Lens::Circle rim = tracked.lens.ideal({found.rim.centre, found.rim.radius});
        found.rim.centre = rim.centre;
        radii.push_back(rim.radius);
        for (DetectedParticle& p : found.particles)
            p.centre =
                tracked.lens.ideal({p.centre, survey.appearance.species[p.species].radius}).centre;
    }
    tracked.rim_radius = quantile(radii, 0.5);
}

}  // namespace swirl::tracking
