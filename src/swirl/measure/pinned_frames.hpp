// Which discs are pinned in a sequence of frames (pinned_loose.hpp), with the frame to which that
// answer belongs.
#pragma once

#include <cstddef>
#include <vector>

#include "swirl/measure/m_frame.hpp"
#include "swirl/measure/pinned_loose.hpp"
#include "swirl/physics/snapshot.hpp"

namespace swirl {

/// Determines which discs are pinned, and stores the last frames. The result for a frame is
/// available half a window later, so a measurement of pinned discs needs the stored frame.
class PinnedFrames {
  public:
    explicit PinnedFrames(double frames_per_period = samples_per_period)
        : pinned_loose_(frame_window(frames_per_period)), recent_(delay() + 1) {}
    const MFrameView& sample(const Snapshot& lab);
    void begin_tracks() { pinned_loose_.begin_tracks(); }
    void close_block() { pinned_loose_.close_block(); }
    const PinnedLoose& pinned_loose() const { return pinned_loose_; }
    /// The frame to which pinned() belongs; null in the first frames of the tracks.
    const MFrameView* earlier() const;

    void merge(const PinnedFrames& other) { pinned_loose_.merge(other.pinned_loose_); }
    template <class Visitor>
    void fields(Visitor&& visit) {
        visit(pinned_loose_, recent_, frames_);
    }
    bool is_consistent() const { return recent_.size() == delay() + 1; }

  private:
    std::size_t delay() const {
        return static_cast<std::size_t>(pinned_loose_.window().half_width);
    }

    PinnedLoose pinned_loose_;
    std::vector<MFrameView> recent_;
    std::size_t frames_ = 0;
};

}  // namespace swirl
