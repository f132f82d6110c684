// How often the discs collide.
//
//   disc–disc rate   2 n_dd / (N t): collisions with other discs that a disc has per unit time
//                    (every collision is one for both partners)
//   wall rate        n_dw / (N t)
//   mean free time   N t / (2 n_dd + n_dw): from one collision of a disc to its next, on average
//
// with n the events of a kind in the time t. Units: 1/time, time. Normalisation: per disc. The
// literature on hard-disc gases counts as the first line does (Kolafa and Rottner 2006,
// doi:10.1080/00268970600967963). Error from blocks of periods. Limits: no time or no discs: NaN;
// no collision: the mean free time is infinite.
#pragma once

#include "swirl/measure/cell_averages.hpp"
#include "swirl/measure/measurement_report.hpp"
#include "swirl/physics/event.hpp"
#include "swirl/statistics/block_average.hpp"

namespace swirl {

class CollisionRates {
  public:
    void sample(const Event& event) {
        if (event.kind == EventKind::disc_disc) disc_ += 2.0;
        if (event.kind == EventKind::disc_wall) wall_ += 1.0;
    }
    /// `duration`: the time the events since the last call took.
    void close_block(double duration, std::size_t discs) {
        const double weight = duration * static_cast<double>(discs);
        disc_rate_.add(disc_, weight);
        wall_rate_.add(wall_, weight);
        rate_.add(disc_ + wall_, weight);
        disc_ = wall_ = 0.0;
    }
    Estimate disc_disc() const { return disc_rate_.estimate(); }
    Estimate disc_wall() const { return wall_rate_.estimate(); }
    Estimate mean_free_time() const {
        Estimate e = rate_.estimate();
        e.error /= e.mean * e.mean;
        e.mean = 1.0 / e.mean;
        return e;
    }

    template <class Visitor>
    void report(Visitor&& visit) const {
        visit(ReportRow{"disc_disc_rate", "v/r", "collisions of a disc with discs per time",
                        disc_disc()});
        visit(ReportRow{"disc_wall_rate", "v/r", "collisions of a disc with the wall per time",
                        disc_wall()});
        visit(ReportRow{"mean_free_time", "r/v", "from one collision of a disc to its next",
                        mean_free_time()});
    }
    void merge(const CollisionRates& other) {
        disc_rate_.merge(other.disc_rate_);
        wall_rate_.merge(other.wall_rate_);
        rate_.merge(other.rate_);
    }
    template <class Visitor>
    void fields(Visitor&& visit) {
        visit(disc_);
        visit(wall_);
        visit(disc_rate_);
        visit(wall_rate_);
        visit(rate_);
    }

  private:
    double disc_ = 0.0, wall_ = 0.0;
    BlockSeries disc_rate_, wall_rate_, rate_;
};

}  // namespace swirl
