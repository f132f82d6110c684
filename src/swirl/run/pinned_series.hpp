// Which discs are pinned and which are resident at the wall, in every frame of a recording. The
// definitions are those of measure/pinned_loose.hpp and measure/long_residence.hpp.
//
// Both need later frames: 7/511 of a period for pinned discs, and up to 40/511 for resident ones.
// So the states of a chunk of frames are determined together, from the frames of the chunk and as
// many before and after as matter.
//
// Values: 1, 0, or NaN if that is unknown: in the first and last frames of tracks, and below the
// frame rate that the definition needs.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "swirl/io/series.hpp"

namespace swirl {

class PinnedSeries {
  public:
    explicit PinnedSeries(SnapshotSeries series);
    /// False if neither is known in any frame.
    bool knows_any() const { return knows_resident_; }
    const PinnedColumns& at(std::uint64_t frame);

  private:
    struct Stay {
        std::uint64_t begin = 0;  // first frame in the wall layer
        double time = 0.0;
        bool is_inside = false, knows_begin = false;
    };
    void find(std::uint64_t begin);
    void end_stay(Stay& stay, std::size_t disc, std::uint64_t end, bool knows_end);
    PinnedColumns& columns_of(std::uint64_t frame) { return found_[frame - first_]; }

    SnapshotSeries series_;
    double rate_;
    bool knows_pinned_, knows_resident_;
    std::uint64_t margin_;                           // frames before and after a chunk
    std::uint64_t first_ = 0, begin_ = 0, end_ = 0;  // begin of found_, and the chunk in it
    double last_time_ = 0.0, minimum_ = 0.0;         // frame before; shortest residence
    std::vector<PinnedColumns> found_;
};

/// The series with the states of its discs, unless they are known in no frame.
SnapshotSeries with_pinned_discs(const SnapshotSeries& series);

}  // namespace swirl
