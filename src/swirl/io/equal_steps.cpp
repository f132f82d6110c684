#include "swirl/io/equal_steps.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "swirl/io/seen_container.hpp"

namespace swirl {
namespace {

/// The index of a disc in a frame.
std::optional<std::size_t> index_of(const TrackFrame& frame, std::int64_t id) {
    const auto at = std::lower_bound(frame.id.begin(), frame.id.end(), id);
    if (at == frame.id.end() || *at != id) return std::nullopt;
    return std::size_t(at - frame.id.begin());
}

/// Interpolates between frame k and the next one.
class Interpolation {
  public:
    Interpolation(const Tracks& tracks, const TrackScale& scale)
        : frames_(tracks.frames), container_(scale, tracks.y_down) {}

    TrackFrame frame(std::size_t k, double time, std::int64_t number) const {
        const TrackFrame &before = frames_[k], &after = frames_[k + 1];
        const double share = (time - *before.time) / (*after.time - *before.time);
        const TrackFrame& near = share < 0.5 ? before : after;
        TrackFrame found;
        found.number = number;
        for (std::size_t i = 0; i < near.id.size(); ++i) {
            const std::int64_t id = near.id[i];
            if (!index_of(before, id) || !index_of(after, id)) continue;
            found.id.push_back(id);
            found.position.push_back(container_.position(time) + relative(k, id, share));
            if (!near.radius.empty()) found.radius.push_back(near.radius[i]);
            if (!near.mass.empty()) found.mass.push_back(near.mass[i]);
            if (!near.spin.empty()) found.spin.push_back(near.spin[i]);
        }
        return found;
    }

  private:
    /// The position relative to the container.
    std::optional<Vec2> relative_in(std::size_t k, std::int64_t id) const {
        if (k >= frames_.size()) return std::nullopt;
        const auto i = index_of(frames_[k], id);
        if (!i) return std::nullopt;
        return frames_[k].position[*i] - container_.position(*frames_[k].time);
    }
    /// The change over the step from frame k on, at the rate between two frames.
    Vec2 slope(std::size_t k, std::size_t from, std::size_t to, std::int64_t id) const {
        const auto a = relative_in(from, id), b = relative_in(to, id);
        if (!a || !b) return slope(k, k, k + 1, id);
        const double step = *frames_[k + 1].time - *frames_[k].time;
        return (step / (*frames_[to].time - *frames_[from].time)) * (*b - *a);
    }
    Vec2 relative(std::size_t k, std::int64_t id, double u) const {
        const Vec2 p = *relative_in(k, id), q = *relative_in(k + 1, id);
        const Vec2 m = k > 0 ? slope(k, k - 1, k + 1, id) : q - p, n = slope(k, k, k + 2, id);
        const double v = 1.0 - u;
        return v * v * (1.0 + 2.0 * u) * p + u * v * v * m + u * u * (3.0 - 2.0 * u) * q -
               u * u * v * n;
    }

    const std::vector<TrackFrame>& frames_;
    SeenContainer container_;
};

}  // namespace

Tracks at_equal_steps(Tracks tracks, const TrackScale& scale) {
    const bool timed = tracks.frames.size() > 1 &&
                       std::all_of(tracks.frames.begin(), tracks.frames.end(),
                                   [](const TrackFrame& f) { return f.time.has_value(); });
    if (!timed) return tracks;
    const Interpolation interpolation(tracks, scale);
    Tracks found;
    found.y_down = tracks.y_down;
    found.repaired = tracks.repaired;
    const double rate = scale.frames_per_time;
    std::size_t k = 0;
    for (auto n = static_cast<std::int64_t>(std::ceil(*tracks.frames.front().time * rate));
         double(n) <= *tracks.frames.back().time * rate; ++n) {
        const double time = double(n) / rate;
        while (k + 2 < tracks.frames.size() && *tracks.frames[k + 1].time < time) ++k;
        if (tracks.frames[k + 1].number - tracks.frames[k].number > longest_gap + 1) continue;
        TrackFrame frame = interpolation.frame(k, time, n);
        if (!frame.id.empty()) found.frames.push_back(std::move(frame));
    }
    return found;
}

}  // namespace swirl
