// Which discs are pinned to the wall and which are loose, and where in the M-frame they change
// (paper, main text, Fig. 3 and SI "Calculation of location that particles become pinned and
// free").
//
// From tracks, sampled at equal time steps. The numbers of frames below are those at 511 frames per
// period, the paper's. They stand for times: at another rate, n frames are those nearest to n/511
// of a period (FrameWindow). These are the SI's criteria, with two corrections: the average that it
// means instead of the sum that it writes, and an angle compared with an angle.
//
//   path direction   straight-line fit of x and of y against the frame number over the frame, the 7
//                    before and the 7 after: s = Σ_k k r_{t+k}, in the M-frame
//   parallel         s deviates by at most 10° from the azimuthal direction about C in which the
//                    wall moves (clockwise): |s·p| ≤ sin 10° |s||p| and p × s < 0
//   pinned           parallel for 8 frames in a row, until it is no longer parallel
//   becoming free    the position where a pinned disc is no longer parallel, if it stays so for 8
//                    frames in a row (discs that jostle are off by 10° for a moment now and then)
//   sharp turn       second difference |r_{t+1} − 2 r_t + r_{t−1}| ≥ ½ ΩR Δt: the velocity jumps
//                    by at least half the wall's speed in the M-frame (the SI gives no threshold)
//   becoming pinned  the positions where loose discs turn sharply: "the average angle at which
//                    these collisions occur"
//
// The state of a disc is known 7 frames late.
//
// From collisions, which a simulation knows exactly and without a threshold. In every period a disc
// goes round the container about once; it is freest in its longest flight from one collision to the
// next:
//
//   becoming free    the position where a disc's longest flight of a period begins
//   becoming pinned  the position where it ends
//
// The angles θ about C in the M-frame are averaged as directions (circular_mean.hpp); the table
// `positions` has the distribution of those from tracks.
//
// Units: radians. Limits: tracks restart if the times of frames do not ascend in equal steps (to 1
// %), and if the number of discs changes. These restarts are counted. With fewer than 15 frames
// nothing is known. Below min_rate_of_pinned the direction of a path is that of too long a piece of
// it: at 30 frames per period discs would depin at 133° instead of 4°.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <tuple>
#include <vector>

#include "swirl/math/real.hpp"
#include "swirl/measure/cell_averages.hpp"
#include "swirl/measure/direction_histogram.hpp"
#include "swirl/measure/m_frame.hpp"
#include "swirl/measure/measurement_report.hpp"
#include "swirl/measure/quantities.hpp"
#include "swirl/measure/strided.hpp"
#include "swirl/physics/event.hpp"
#include "swirl/statistics/block_average.hpp"
#include "swirl/statistics/circular_mean.hpp"

namespace swirl {

/// For each disc of a frame, whether it is pinned. Empty if that is unknown.
using PinnedFlags = std::span<const std::uint8_t>;

/// False if that is unknown.
inline bool is_pinned(PinnedFlags pinned, std::size_t disc) {
    return disc < pinned.size() && pinned[disc] != 0;
}

struct PinningCriteria {
    double deviation = pi / 18.0;  // 10°
    double sharp_turn = 0.5;       // unit: ΩR
};

/// Lowest frame rate at which pinned discs and sharp turns are determined. At 120 frames per
/// period, sharp turns are found 1.6° too late.
inline constexpr double min_rate_of_pinned = quantity("pinned.share").min_rates.of_frames;

/// Numbers of frames in the criteria.
struct FrameWindow {
    int half_width = 7;        // half width for the path direction; a change has one frame more
    int turn = 1;              // frames between the positions of a second difference
    bool knows_pinned = true;  // otherwise only sharp turns are found

    int width() const { return 2 * half_width + 1; }
};
inline FrameWindow frame_window(double frames_per_period) {
    const double scale = frames_per_period / samples_per_period;
    const auto nearest = [&](int frames) {
        return static_cast<int>(larger(1.0, std::floor(frames * scale + 0.5)));
    };
    const FrameWindow paper;
    return {nearest(paper.half_width), nearest(paper.turn),
            rate_suffices(frames_per_period, min_rate_of_pinned)};
}

class PinnedLoose : public BlockAverages<PinnedLoose> {
  public:
    static auto averages(auto& s) { return std::tie(s.pinning_, s.depinning_, s.share_); }

    explicit PinnedLoose(const FrameWindow& window = {}, const PinningCriteria& criteria = {});
    const FrameWindow& window() const { return window_; }

    /// One frame; frames at equal time steps.
    void sample(const MFrameView& view);
    /// The discs of the next frame are not those of the last, though there may be as many.
    void begin_tracks();

    /// For each disc whether it was pinned half a window ago; all 0 before there are enough frames.
    const std::vector<std::uint8_t>& pinned() const { return pinned_; }
    /// True if the present tracks are long enough for pinned() to be known.
    bool is_known() const { return frames_ >= window_.width(); }

    /// θ where discs pin, and where they depin.
    const CircularMean& pinning() const { return pinning_; }
    const CircularMean& depinning() const { return depinning_; }
    const DirectionHistogram& pinned_positions() const { return pinned_positions_; }
    const DirectionHistogram& free_positions() const { return free_positions_; }
    /// The share of the discs that is pinned.
    Estimate share() const { return share_.estimate(); }
    /// How often the frames' times broke the tracks.
    double breaks() const { return breaks_; }

    void merge(const PinnedLoose& other);
    template <class Visitor>
    void fields(Visitor&& visit) {
        visit(frames_, last_time_, step_, breaks_);
        visit(past_x_, past_y_, sum_x_, sum_y_, slope_x_, slope_y_);
        visit(loose_for_, left_x_, left_y_, parallel_for_, freed_, turned_sharply_);
        visit(is_pinned_, pinned_);
        this->visit_averages(visit);
        visit(pinned_positions_, free_positions_);
    }
    /// While there are no tracks, the columns may still be those of earlier tracks.
    bool is_consistent() const {
        const std::size_t n = pinned_.size();
        const auto all = [](std::size_t length,
                            std::initializer_list<const std::vector<double>*> c) {
            return std::all_of(c.begin(), c.end(),
                               [=](const auto* column) { return column->size() == length; });
        };
        return n == 0 ||
               (all(n * static_cast<std::size_t>(window_.width()), {&past_x_, &past_y_}) &&
                all(n, {&sum_x_, &sum_y_, &slope_x_, &slope_y_, &loose_for_, &left_x_, &left_y_,
                        &parallel_for_, &is_pinned_, &freed_, &turned_sharply_}));
    }

  private:
    void restart(std::size_t discs);
    void sum_window();
    double* slot(std::vector<double>& past, std::int64_t frame);
    void apply_criteria(const MFrameView& view);

    FrameWindow window_;
    double sine_square_, sharp_turn_;
    std::int64_t frames_ = 0;  // frames of the present tracks
    double last_time_ = 0.0, step_ = 0.0, breaks_ = 0.0;
    // The positions of every disc in the window, frame by frame in a ring.
    std::vector<double> past_x_, past_y_;
    // Over those: Σ r and Σ k r.
    std::vector<double> sum_x_, sum_y_, slope_x_, slope_y_;
    std::vector<double> loose_for_;        // frames since it left; 0: it did not, or was counted
    std::vector<double> left_x_, left_y_;  // position where it was no longer parallel
    std::vector<double> parallel_for_;     // frames in a row
    std::vector<double> is_pinned_;        // 0 or 1
    std::vector<double> freed_, turned_sharply_;  // 0 or 1, at this frame
    std::vector<std::uint8_t> pinned_;
    CircularMean pinning_, depinning_;
    BlockMean share_;
    DirectionHistogram pinned_positions_, free_positions_;
};

class PinnedByCollisions {
  public:
    static constexpr double min_frames_per_period = min_rate_of_pinned;
    static constexpr bool reads_only_event = true;

    void sample_event(const Event& event, const Snapshot& after);
    /// At the end of every period: now the longest flights are known.
    void close_block();
    const CircularMean& pinning() const { return pinning_; }
    const CircularMean& depinning() const { return depinning_; }

    /// The results from collisions, next to those from the tracks of the same discs.
    template <class Visitor>
    void report(Visitor&& visit, const PinnedLoose& by_tracks) const {
        visit(direction_row(quantity("pinned.pinning"), by_tracks.pinning()));
        visit(direction_row(quantity("pinned.depinning"), by_tracks.depinning()));
        visit(direction_row(quantity("pinned.pinning_by_collisions"), pinning()));
        visit(direction_row(quantity("pinned.depinning_by_collisions"), depinning()));
        visit(ReportRow{quantity("pinned.share"), by_tracks.share()});
        visit(positions_table("distribution over θ of pinning and depinning, by tracks",
                              by_tracks.pinned_positions(), by_tracks.free_positions()));
    }
    void merge(const PinnedByCollisions& other) {
        pinning_.merge(other.pinning_);
        depinning_.merge(other.depinning_);
    }
    template <class Visitor>
    void fields(Visitor&& visit) {
        visit(last_, longest_, pinning_, depinning_);
    }
    bool is_consistent() const { return last_.size() == longest_.size(); }

    struct Collision {
        double time = never;  // none yet
        Vec2 position{};      // M-frame
    };
    struct Flight {
        double duration = 0.0;  // none yet
        Vec2 begin{}, end{};
    };

  private:
    void collide(std::size_t disc, double time, const Vec2& position);

    std::vector<Collision> last_;  // one per disc
    std::vector<Flight> longest_;  // one per disc and period
    CircularMean pinning_, depinning_;
};

}  // namespace swirl
