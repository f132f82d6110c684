// Which discs are pinned to the wall and which are loose, and where in the M-frame they change
// (paper, main text, Fig. 3 and SI "Calculation of location that particles become pinned and
// free").
//
// From trajectories, sampled at equal time steps (the paper: 511 frames per period). What the SI
// says, with the average it means instead of the sum it writes, and angle compared with angle:
//
//   path direction   straight-line fit of x and of y against the frame number over the frame, the 7
//                    before and the 7 after: s = Σ_k k r_{t+k}, in the M-frame
//   parallel         s deviates from the azimuthal direction about C by at most 10°, in the sense
//                    of the wall (clockwise): |s·p| ≤ sin 10° |s||p| and p × s < 0
//   pinned           parallel for 8 frames in a row, until it no longer is
//   becoming free    the position where a pinned disc is parallel no more, and stays so for 8
//                    frames in a row (discs that jostle are off by 10° for a moment now and then)
//   sharp turn       second difference |r_{t+1} − 2 r_t + r_{t−1}| ≥ ½ ΩR Δt: the velocity jumps
//                    by at least half the wall's speed in the M-frame (the SI gives no threshold)
//   becoming pinned  the positions where loose discs turn sharply: "the average angle at which
//                    these collisions occur"
//
// The state of a disc is known 7 frames late. From collisions, which a simulation knows exactly and
// without a threshold: in every swirl a disc goes round the dish once, about, and is freest in the
// longest of its flights from one collision to the next:
//
//   becoming free    the position where a disc's longest flight of a swirl begins
//   becoming pinned  the position where it ends
//
// The angles θ about C in the M-frame are averaged as directions (circular_mean.hpp); the table
// `places` has how those of the tracks are distributed.
// Units: radians. Limits: frames whose times do not ascend, or not in equal steps (to 1 %), begin
// new tracks, and are counted; so does a change of the number of discs. Fewer than 15 frames:
// nothing.
#pragma once

#include <algorithm>
#include <cstdint>
#include <initializer_list>
#include <vector>

#include "swirl/measure/cell_averages.hpp"
#include "swirl/measure/direction_histogram.hpp"
#include "swirl/measure/m_frame.hpp"
#include "swirl/measure/measurement_report.hpp"
#include "swirl/physics/event.hpp"
#include "swirl/statistics/block_average.hpp"
#include "swirl/statistics/circular_mean.hpp"

namespace swirl {

struct PinningCriteria {
    double deviation = pi / 18.0;  // 10°
    double sharp_turn = 0.5;       // in units of ΩR
};

class PinnedLoose {
  public:
    static constexpr int half_width = 7;
    static constexpr int width = 2 * half_width + 1;

    explicit PinnedLoose(const PinningCriteria& criteria = {});

    /// One frame; frames at equal time steps.
    void sample(const MFrameView& view);
    /// The discs of the next frame are not those of the last, though there may be as many.
    void begin_anew();
    void close_block();

    /// For each disc whether it is pinned, seven frames ago; all 0 before there are enough frames.
    const std::vector<std::uint8_t>& pinned() const { return pinned_; }

    /// Whether pinned() says anything: the present tracks are long enough.
    bool knows() const { return frames_ >= width; }

    /// θ where discs become pinned, and where they become free.
    const CircularMean& becoming_pinned() const { return becoming_pinned_; }
    const CircularMean& becoming_free() const { return becoming_free_; }
    const DirectionHistogram& pinned_places() const { return pinned_places_; }
    const DirectionHistogram& free_places() const { return free_places_; }
    /// The share of the discs that is pinned.
    Estimate share() const { return share_.estimate(); }
    /// How often the frames' times broke the track.
    double breaks() const { return breaks_; }

    void merge(const PinnedLoose& other);
    template <class Visitor>
    void fields(Visitor&& visit) {
        visit(frames_);
        visit(last_time_);
        visit(step_);
        visit(breaks_);
        for (auto* column : {&past_x_, &past_y_, &sum_x_, &sum_y_, &slope_x_, &slope_y_})
            visit(*column);
        for (auto* column : {&loose_for_, &left_x_, &left_y_, &parallel_for_, &freed_, &turned_})
            visit(*column);
        visit(is_pinned_);
        visit(pinned_);
        visit(becoming_pinned_);
        visit(becoming_free_);
        visit(share_);
        for (DirectionHistogram* places : {&pinned_places_, &free_places_}) visit(*places);
    }
    /// Without tracks the columns may be those of the tracks before.
    bool is_consistent() const {
        const std::size_t n = pinned_.size();
        const auto all = [](std::size_t length,
                            std::initializer_list<const std::vector<double>*> c) {
            return std::all_of(c.begin(), c.end(),
                               [=](const auto* column) { return column->size() == length; });
        };
        return n == 0 || (all(n * width, {&past_x_, &past_y_}) &&
                          all(n, {&sum_x_, &sum_y_, &slope_x_, &slope_y_, &loose_for_, &left_x_,
                                  &left_y_, &parallel_for_, &is_pinned_, &freed_, &turned_}));
    }

  private:
    void begin_tracks(std::size_t discs);
    void sum_window();
    double* slot(std::vector<double>& past, std::int64_t frame);
    void judge(const MFrameView& view);

    double sine_square_, sharp_turn_;
    std::int64_t frames_ = 0;  // in the present tracks
    double last_time_ = 0.0, step_ = 0.0, breaks_ = 0.0;
    // The last 15 positions of every disc, frame by frame in a ring.
    std::vector<double> past_x_, past_y_;
    // Over those: Σ r and Σ k r.
    std::vector<double> sum_x_, sum_y_, slope_x_, slope_y_;
    std::vector<double> loose_for_;        // frames since it was pinned; 0: not, or told already
    std::vector<double> left_x_, left_y_;  // where it was parallel no more
    std::vector<double> parallel_for_;     // frames in a row
    std::vector<double> is_pinned_;        // 0 or 1
    std::vector<double> freed_, turned_;   // 0 or 1, at this frame
    std::vector<std::uint8_t> pinned_;
    CircularMean becoming_pinned_, becoming_free_;
    BlockMean share_;
    DirectionHistogram pinned_places_, free_places_;
};

class PinnedByCollisions {
  public:
    /// After every event, with the state after it.
    void sample(const Event& event, const Snapshot& after);
    /// At the end of every swirl: now the longest flights are known.
    void close_block();
    const CircularMean& becoming_pinned() const { return becoming_pinned_; }
    const CircularMean& becoming_free() const { return becoming_free_; }

    /// What the collisions say, beside what the tracks of the same discs say.
    template <class Visitor>
    void report(Visitor&& visit, const PinnedLoose& by_tracks) const {
        visit(row_of("becoming_pinned", "θ where discs become pinned, by tracks",
                     by_tracks.becoming_pinned()));
        visit(row_of("becoming_free", "θ where discs become free, by tracks",
                     by_tracks.becoming_free()));
        visit(row_of("becoming_pinned_by_collisions", "θ where discs become pinned, by collisions",
                     becoming_pinned()));
        visit(row_of("becoming_free_by_collisions", "θ where discs become free, by collisions",
                     becoming_free()));
        visit(ReportRow{"share", "1", "share of the discs that is pinned", by_tracks.share()});
        visit(table_of(
            "how the places of becoming pinned and free, by tracks, are distributed over θ",
            by_tracks.pinned_places(), by_tracks.free_places()));
    }
    void merge(const PinnedByCollisions& other) {
        becoming_pinned_.merge(other.becoming_pinned_);
        becoming_free_.merge(other.becoming_free_);
    }
    template <class Visitor>
    void fields(Visitor&& visit) {
        visit(last_);
        visit(longest_);
        visit(becoming_pinned_);
        visit(becoming_free_);
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

    std::vector<Collision> last_;  // of every disc
    std::vector<Flight> longest_;  // of every disc in this swirl
    CircularMean becoming_pinned_, becoming_free_;
};

}  // namespace swirl
