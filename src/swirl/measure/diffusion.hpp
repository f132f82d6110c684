// How far the discs move, and how far they rotate, in a given time.
//
//   displacement          ⟨|Δ(r − C)|²⟩      relative to the container, in lab directions
//   angular displacement  ⟨Δα⟩ and ⟨Δα²⟩ − ⟨Δα⟩²   of the discs' orientation α
//
// for lags of 1, 2, 4, … samples, over all discs and all beginnings. In free diffusion they grow as
// 4 D t and 2 D_rot t. In a container the first saturates near the square of its size, and within a
// period it shows the sloshing. Lags of whole periods show the diffusion without the sloshing.
//
// Units: length², rad (the angle is counted through full turns). Normalisation: every disc and
// every beginning counts the same. Errors: from blocks of periods. A displacement belongs to the
// block in which it ends. Displacements over L periods overlap for L blocks, so L blocks count as
// one independent sample: the error is √L times that of the blocks. Limits: unknown orientations
// (NaN) make the angular displacement NaN. If samples are not at equal time steps (to 1 %), or the
// number of discs changes, the measurement restarts; the restarts are counted.
#pragma once

#include <cmath>
#include <cstdint>
#include <tuple>
#include <vector>

#include "swirl/measure/cell_averages.hpp"
#include "swirl/measure/measurement_report.hpp"
#include "swirl/measure/quantities.hpp"
#include "swirl/physics/snapshot.hpp"
#include "swirl/statistics/block_average.hpp"

namespace swirl {

class Diffusion : public BlockAverages<Diffusion> {
  public:
    static auto averages(auto& s) { return std::tie(s.moves_, s.rotations_); }

    /// Lags up to 2^(lags − 1) samples.
    explicit Diffusion(std::size_t lags = 10)
        : window_((std::size_t{1} << (lags - 1)) + 1), moves_(lags), rotations_(lags) {}

    void sample(const Snapshot& s) {
        const double step = s.time() - last_time_;
        const bool first = samples_ == 0;
        const bool even = step > 0.0 && (samples_ < 2 || std::abs(step - step_) <= 0.01 * step_);
        if (s.size() != discs_ || (!first && !even)) {
            if (!first) breaks_ += 1.0;
            samples_ = 0;
            discs_ = s.size();
            past_.assign(window_ * discs_, {});
        }
        if (samples_ == 1) step_ = step;
        last_time_ = s.time();
        period_ = s.period;
        if (discs_ == 0) return;

        State* const now = at(samples_);
        for (std::size_t i = 0; i < discs_; ++i)
            now[i] = {s.position(i) - s.container_centre, s.orientation(i)};
        for (std::size_t k = 0; k < lags(); ++k) {
            const std::int64_t lag = std::int64_t{1} << k;
            if (lag > samples_) break;
            const State* const then = at(samples_ - lag);
            double square = 0.0, angle = 0.0, angle_square = 0.0;
            for (std::size_t i = 0; i < discs_; ++i) {
                const Vec2 d = now[i].position - then[i].position;
                const double rotation = now[i].angle - then[i].angle;
                square += dot(d, d);
                angle += rotation;
                angle_square += rotation * rotation;
            }
            const double visits = static_cast<double>(discs_);
            moves_.add(k, {square}, visits);
            rotations_.add(k, {angle, angle_square}, visits);
        }
        ++samples_;
    }
    /// The discs of the next sample are not those of the last, though there may be as many.
    void begin_tracks() { discs_ = 0; }

    std::size_t lags() const { return moves_.size(); }
    /// In units of the snapshots' time.
    double lag(std::size_t k) const { return step_ * static_cast<double>(std::int64_t{1} << k); }
    Estimate square_displacement(std::size_t k) const { return independent(moves_.estimate(k), k); }
    /// ⟨Δα⟩.
    Estimate mean_rotation(std::size_t k) const {
        return independent(rotations_.estimate(k, 0), k);
    }
    /// ⟨Δα²⟩ − ⟨Δα⟩²; the error is that of ⟨Δα²⟩.
    Estimate rotation_variance(std::size_t k) const {
        Estimate e = independent(rotations_.estimate(k, 1), k);
        e.mean -= rotations_.mean(k, 0) * rotations_.mean(k, 0);
        return e;
    }
    double breaks() const { return breaks_; }

    /// The other must have as many lags and the same time step.
    void merge(const Diffusion& other) {
        if (step_ == 0.0) step_ = other.step_;
        if (period_ == 0.0) period_ = other.period_;
        BlockAverages::merge(other);
        breaks_ += other.breaks_;
    }
    template <class Visitor>
    void fields(Visitor&& visit) {
        visit(past_, discs_, samples_, last_time_, step_, period_, breaks_, moves_, rotations_);
    }
    /// If the next sample restarts, the stored positions do not matter.
    bool is_consistent() const { return discs_ == 0 || past_.size() / discs_ == window_; }

    struct State {
        Vec2 position{};
        double angle = 0.0;
    };

  private:
    State* at(std::int64_t index) {
        return past_.data() + static_cast<std::size_t>(index) % window_ * discs_;
    }

    /// The blocks within one lag time count as one independent sample.
    Estimate independent(Estimate e, std::size_t k) const {
        const double blocks = std::fmax(1.0, lag(k) / period_);
        e.error *= square_root(blocks);
        e.effective_samples /= blocks;
        return e;
    }

    std::size_t window_;  // samples that are stored
    std::vector<State> past_;
    std::size_t discs_ = 0;
    std::int64_t samples_ = 0;
    double last_time_ = 0.0, step_ = 0.0, period_ = 0.0, breaks_ = 0.0;
    CellMeans<1> moves_;
    CellMeans<2> rotations_;
};

/// Diffusion for lags below a period, and for lags of whole periods.
class DiffusionLags {
  public:
    static constexpr bool any_path = true;

    /// At equal steps of time within the period.
    void sample_within_period(const Snapshot& s) { within_.sample(s); }
    /// Once per period, always at the same phase.
    void sample_across_periods(const Snapshot& s) { across_.sample(s); }
    void begin_tracks() {
        within_.begin_tracks();
        across_.begin_tracks();
    }
    void close_block() {
        within_.close_block();
        across_.close_block();
    }

    /// Lags that were not reached have no row.
    template <class Visitor>
    void report(Visitor&& visit) const {
        ReportTable table{"",
                          "squared displacement and rotation of a disc against the lag",
                          {{quantity("diffusion.lag")},
                           {quantity("diffusion.displacement"), with_error_column},
                           {quantity("diffusion.rotation"), with_error_column},
                           {quantity("diffusion.rotation_variance"), with_error_column}}};
        for (const Diffusion* d : {&within_, &across_})
            for (std::size_t k = 0; k < d->lags(); ++k) {
                const Estimate displacement = d->square_displacement(k);
                if (displacement.blocks == 0 || std::isnan(displacement.mean)) continue;
                table.add(d->lag(k), displacement, d->mean_rotation(k), d->rotation_variance(k));
            }
        visit(std::move(table));
    }
    void merge(const DiffusionLags& other) {
        within_.merge(other.within_);
        across_.merge(other.across_);
    }
    template <class Visitor>
    void fields(Visitor&& visit) {
        visit(within_, across_);
    }

  private:
    Diffusion within_{7};  // up to 64 of the 73 steps of a period
    Diffusion across_{8};  // up to 128 periods
};

}  // namespace swirl
