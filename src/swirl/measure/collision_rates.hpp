// How often the discs collide.
//
//   disc–disc rate   2 n_dd / (N t): collisions with other discs that a disc has per unit time
//                    (every collision is one for both partners)
//   wall rate        n_dw / (N t)
//   mean free time   N t / (2 n_dd + n_dw): from one collision of a disc to its next, on average
//
// where n is the number of events of a kind in the time t. Units: 1/time, time. Normalisation: per
// disc; the literature on hard-disc gases uses the same convention (Kolafa and Rottner 2006,
// doi:10.1080/00268970600967963). Errors: from blocks of periods. Limits: no time or no discs: NaN;
// no collision: the mean free time is infinite.
#pragma once

#include <tuple>

#include "swirl/measure/measurement_report.hpp"
#include "swirl/measure/quantities.hpp"
#include "swirl/physics/event.hpp"
#include "swirl/statistics/block_average.hpp"

namespace swirl {

class CollisionRates : public MergedAverages<CollisionRates> {
  public:
    static constexpr bool any_path = true;

    static auto averages(auto& s) { return std::tie(s.disc_rate_, s.wall_rate_, s.rate_); }

    void sample_event(const Event& event) {
        if (event.kind == EventKind::disc_disc) disc_ += 2.0;
        if (event.kind == EventKind::disc_wall) wall_ += 1.0;
    }
    /// `duration`: the time in which the events since the last call happened.
    void close_event_block(double duration, std::size_t discs) {
        const double weight = duration * static_cast<double>(discs);
        disc_rate_.add(disc_, weight);
        wall_rate_.add(wall_, weight);
        rate_.add(disc_ + wall_, weight);
        disc_ = wall_ = 0.0;
    }
    Estimate mean_free_time() const {
        Estimate e = rate_.estimate();
        e.weight *= e.mean;  // what it is averaged over: the collisions
        e.error /= e.mean * e.mean;
        e.mean = 1.0 / e.mean;
        return e;
    }

    template <class Visitor>
    void report(Visitor&& visit) const {
        visit(ReportRow{quantity("collisions.disc_disc_rate"), disc_rate_.estimate()});
        visit(ReportRow{quantity("collisions.disc_wall_rate"), wall_rate_.estimate()});
        visit(ReportRow{quantity("collisions.mean_free_time"), mean_free_time()});
    }
    template <class Visitor>
    void fields(Visitor&& visit) {
        visit(disc_, wall_, disc_rate_, wall_rate_, rate_);
    }

  private:
    double disc_ = 0.0, wall_ = 0.0;  // collisions of the open block, once per partner
    BlockSeries disc_rate_, wall_rate_, rate_;
};

}  // namespace swirl
