#include "swirl/render/source_player.hpp"

#include <algorithm>
#include <cmath>

#include "swirl/physics/mirrored.hpp"

namespace swirl {

namespace {

constexpr int trail_points = 96;  // points per period

}  // namespace

PinnedPlayback::PinnedPlayback(const FrameSource& source, double first)
    : playback_(source.open_interpolated ? source.open_interpolated() : source.open()),
      to_(source.to),
      clockwise_(source.clockwise) {
    // One period earlier if the source has it: a disc counts as pinned only after eight frames at
    // the wall.
    const double begin = std::max(source.from.value_or(0.0), first - 1.0);
    next_ = static_cast<std::int64_t>(std::ceil(begin * frames_per_period));
}

const std::vector<std::uint8_t>& PinnedPlayback::at(double periods) {
    const auto last = static_cast<std::int64_t>(std::floor(periods * frames_per_period + 1e-9)) +
                      FrameWindow().half_width;
    for (; next_ <= last; ++next_) {
        const double time = static_cast<double>(next_) / frames_per_period;
        if (to_ && time > *to_) break;
        view_.update(clockwise_ ? mirrored(playback_(time)) : playback_(time));
        pinned_.sample(view_);
    }
    return pinned_.pinned();
}

SourcePlayer::SourcePlayer(const FrameSource& source, double trail_length, bool needs_pinned,
                           double start)
    : source_(source), playback_(source.open()), trail_length_(trail_length) {
    if (needs_pinned) pinned_.emplace(source, start);
    if (source.open_backdrop) backdrops_ = source.open_backdrop();
}

Moment SourcePlayer::at(double periods) {
    if (trail_length_ > 0.0) extend_trails(periods);
    Moment moment;
    moment.past = {past_.begin(), past_.end()};
    moment.now = state_at(periods);
    if (pinned_) moment.pinned = pinned_->at(periods);
    if (backdrops_) moment.backdrop = backdrops_(periods);
    return moment;
}

std::shared_ptr<const SourceState> SourcePlayer::state_at(double periods) const {
    return std::make_shared<const SourceState>(SourceState{
        playback_(periods), source_.ids ? source_.ids(periods) : std::vector<std::int64_t>()});
}

void SourcePlayer::extend_trails(double periods) {
    const double first =
        std::max(source_.from.value_or(0.0), periods - trail_length_) * trail_points;
    next_ = std::max(next_, static_cast<std::int64_t>(std::ceil(first)));
    // The times themselves are compared, because a playback never goes back by a rounding.
    const auto time = [&] { return static_cast<double>(next_) / trail_points; };
    for (; time() < periods; ++next_) past_.push_back(state_at(time()));
    const auto longest = static_cast<std::size_t>(std::ceil(trail_length_ * trail_points));
    while (past_.size() > longest) past_.pop_front();
}

}  // namespace swirl
