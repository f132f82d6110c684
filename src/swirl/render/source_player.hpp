// Plays a source forwards: its state at each time asked for, the states before it that trails need,
// the camera image, and which discs are pinned.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <vector>

#include "swirl/measure/m_frame.hpp"
#include "swirl/measure/pinned_loose.hpp"
#include "swirl/render/frame_source.hpp"

namespace swirl {

/// A state, and the IDs of its discs if they come and go.
struct SourceState {
    Snapshot snapshot;
    std::vector<std::int64_t> ids;
};

/// All that one source contributes to a drawing. Several threads may read it.
struct Moment {
    std::shared_ptr<const SourceState> now;
    std::vector<std::shared_ptr<const SourceState>> past;    // states of the trails, oldest first
    std::vector<std::shared_ptr<const SourceState>> ghosts;  // states of a stroboscopic image
    std::vector<std::uint8_t> pinned;                        // empty if it is not needed
    std::optional<Backdrop> backdrop;
};

/// Determines at each time which discs are pinned. The criterion needs seven later frames
/// (measure/pinned_loose.hpp), so this reads the source in a separate pass, ahead of the shown
/// frames.
class PinnedPlayback {
  public:
    /// `first` is the first requested time, in periods.
    PinnedPlayback(const FrameSource& source, double first);
    /// For each disc 1 (pinned) or 0. Times must not decrease.
    const std::vector<std::uint8_t>& at(double periods);

  private:
    static constexpr int frames_per_period = 511;  // rate of the paper's camera

    Playback playback_;
    std::optional<double> to_;
    bool clockwise_;
    PinnedLoose pinned_;
    MFrameView view_;
    std::int64_t next_;
};

class SourcePlayer {
  public:
    /// `trail_length` is in periods; 0: no trails. `start` is the first requested time.
    SourcePlayer(const FrameSource& source, double trail_length, bool needs_pinned, double start);
    /// Times must not decrease.
    Moment at(double periods);

  private:
    std::shared_ptr<const SourceState> state_at(double periods) const;
    void extend_trails(double periods);

    const FrameSource& source_;
    Playback playback_;
    BackdropPlayback backdrops_;
    double trail_length_;
    std::int64_t next_ = 0;  // number of the next point of the trails
    std::deque<std::shared_ptr<const SourceState>> past_;
    std::optional<PinnedPlayback> pinned_;
};

}  // namespace swirl
