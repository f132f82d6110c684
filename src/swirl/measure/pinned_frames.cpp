#include "swirl/measure/pinned_frames.hpp"

namespace swirl {

const MFrameView& PinnedFrames::sample(const Snapshot& lab) {
    MFrameView& now = recent_[frames_++ % recent_.size()];
    now.update(lab);
    pinned_loose_.sample(now);
    return now;
}

const MFrameView* PinnedFrames::earlier() const {
    if (!pinned_loose_.is_known()) return nullptr;
    return &recent_[(frames_ - 1 - delay()) % recent_.size()];
}

}  // namespace swirl
