#include "swirl/render/tracked_source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <utility>

#include "swirl/io/series.hpp"
#include "swirl/render/numbered_frames.hpp"
#include "swirl/run/failure.hpp"

namespace swirl {
namespace {

/// Numbers, times (in periods) and disc IDs of a camera's frames.
class FrameTable {
  public:
    FrameTable(const Tracks& tracks, const TrackScale& scale) {
        for (const TrackFrame& frame : tracks.frames) {
            numbers.push_back(frame.number);
            times_.push_back(frame.time.value_or(double(frame.number) / scale.frames_per_time) /
                             scale.period);
            ids.push_back(frame.id);
        }
    }

    std::size_t nearest(double periods) const {
        const auto after = std::lower_bound(times_.begin(), times_.end(), periods);
        if (after == times_.begin()) return 0;
        const auto k = static_cast<std::size_t>(after - times_.begin());
        if (after == times_.end()) return k - 1;
        return periods - times_[k - 1] < times_[k] - periods ? k - 1 : k;
    }

    std::vector<std::int64_t> numbers;
    std::vector<std::vector<std::int64_t>> ids;

  private:
    std::vector<double> times_;
};

/// The position of the camera's pixels in the plane of the discs.
Backdrop backdrop_position(const TrackScale& scale, bool y_down) {
    const double unit = 1.0 / scale.pixels_per_radius;
    Backdrop backdrop;
    backdrop.along_x = {scale.clockwise ? -unit : unit, 0.0};
    backdrop.along_y = {0.0, y_down ? -unit : unit};
    backdrop.origin =
        -scale.swirl_centre.x * backdrop.along_x - scale.swirl_centre.y * backdrop.along_y;
    return backdrop;
}

}  // namespace

Backdrop ImageMotion::applied(Backdrop backdrop, std::int64_t frame) const {
    if (frame < first || frame - first >= static_cast<std::int64_t>(poses.size())) return backdrop;
    const Pose& pose = poses[static_cast<std::size_t>(frame - first)];
    // The inverse of the pose takes pixels to positions of the steady camera.
    const double scale = 1.0 / (pose.a * pose.a + pose.b * pose.b);
    const Vec2 x = backdrop.along_x, y = backdrop.along_y;
    backdrop.along_x = scale * (pose.a * x - pose.b * y);
    backdrop.along_y = scale * (pose.b * x + pose.a * y);
    backdrop.origin =
        backdrop.origin - pose.origin.x * backdrop.along_x - pose.origin.y * backdrop.along_y;
    return backdrop;
}

FrameSource tracked(Tracks tracks, const TrackScale& scale, const std::string& caption,
                    const std::string& images, std::int64_t first_image,
                    const ImageMotion& motion) {
    const auto table = std::make_shared<const FrameTable>(tracks, scale);
    const Backdrop position = backdrop_position(scale, tracks.y_down);
    const SnapshotSeries series = series_of(std::move(tracks), scale);
    FrameSource source = recorded(series, caption);
    source.frames_per_period = scale.frames_per_time * scale.period;
    if (series.same_discs()) source.open_interpolated = source.open;
    if (!series.same_discs() || !images.empty())
        source.open = [series, table]() -> Playback {
            return
                [series, table](double periods) { return series.frame(table->nearest(periods)); };
        };
    if (!series.same_discs())
        source.ids = [table](double periods) { return table->ids[table->nearest(periods)]; };
    if (images.empty()) return source;

    const NumberedFrames video(images);
    for (const std::int64_t number : {table->numbers.front(), table->numbers.back()})
        if (!video.has_file(number + first_image))
            throw Failure(fmt::format("no such camera image: '{}', for frame {} of the tracks.",
                                      video.name(number + first_image), number));
    source.open_backdrop = [=]() -> BackdropPlayback {
        const auto playback = std::make_shared<NumberedFrames>(images);
        return [=](double periods) {
            const std::int64_t number = table->numbers[table->nearest(periods)];
            Backdrop backdrop = motion.applied(position, number);
            backdrop.image = playback->image(number + first_image);
            return backdrop;
        };
    };
    return source;
}

}  // namespace swirl
