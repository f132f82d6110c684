// The position and shape of the cluster in the M-frame, and the forces that act on its discs there
// (paper, main text: the centrifugal force pushes the discs towards M, the Coriolis force to the
// left of it; the oblong shape of the cluster).
//
//   x, y          the centre of mass; M is at (0, −R), so x < 0 is left of it
//   distance      of the centre of mass from C
//   theta         direction of the centre of mass about C; M is at 270°. A smaller θ is clockwise
//                 of M: the cluster lags behind the swirl by 270° − θ
//   left          share of the discs with x < 0
//   elongation    √(λ₁/λ₂) of the discs' mean square distances along and across the longest axis
//                 through the centre of mass: 1 for a round cluster
//   centrifugal   Ω² |p − S| for a disc of mass 1, mean and maximum; S is (0, A)
//   coriolis      2 Ω |v|, v in the M-frame, mean and maximum
//
// By default only every 8th sample is used. Units: r, ° and v²/r for the forces. Errors: from
// blocks of periods; the maxima have none. Limits: a centre of mass at C has no direction; fewer
// than three discs, or discs in a line, have no elongation.
#pragma once

#include <algorithm>
#include <cstdint>
#include <tuple>

#include "swirl/measure/direction_histogram.hpp"
#include "swirl/measure/m_frame.hpp"
#include "swirl/measure/measurement_report.hpp"
#include "swirl/measure/quantities.hpp"
#include "swirl/measure/strided.hpp"
#include "swirl/statistics/block_average.hpp"
#include "swirl/statistics/circular_mean.hpp"

namespace swirl {

class ClusterCentre : public BlockAverages<ClusterCentre>, public Strided {
  public:
    static auto averages(auto& s) {
        return std::tie(s.x_, s.y_, s.distance_, s.left_, s.elongation_, s.centrifugal_,
                        s.coriolis_, s.direction_);
    }

    explicit ClusterCentre(int every = 8) : Strided(every) {}

    void sample(const MFrameView& view) {
        if (skips_next() || view.size() == 0) return;
        const Vec2 centre = view.centre_of_mass().position;
        x_.add(centre.x);
        y_.add(centre.y);
        distance_.add(square_root(dot(centre, centre)));
        direction_.add(centre);
        const double omega = view.frame.omega, n = static_cast<double>(view.size());
        const double amplitude =
            square_root(dot(view.frame.centre, view.frame.centre));  // S is the lab's origin
        double left = 0.0, xx = 0.0, xy = 0.0, yy = 0.0;
        for (std::size_t i = 0; i < view.size(); ++i) {
            const Vec2 p = view.position(i), d = p - centre, v = view.velocity(i);
            const Vec2 from_S = p - Vec2{0.0, amplitude};
            left += p.x < 0.0 ? 1.0 : 0.0;
            xx += d.x * d.x;
            xy += d.x * d.y;
            yy += d.y * d.y;
            const double centrifugal = omega * omega * square_root(dot(from_S, from_S));
            const double coriolis = 2.0 * omega * square_root(dot(v, v));
            centrifugal_.add(centrifugal);
            coriolis_.add(coriolis);
            max_centrifugal_ = std::max(max_centrifugal_, centrifugal);
            max_coriolis_ = std::max(max_coriolis_, coriolis);
        }
        left_.add(left / n);
        const double mean = 0.5 * (xx + yy);
        const double difference = square_root(0.25 * (xx - yy) * (xx - yy) + xy * xy);
        if (view.size() > 2 && mean - difference > in_a_line * mean)
            elongation_.add(square_root((mean + difference) / (mean - difference)));
    }

    const CircularMean& direction() const { return direction_; }

    template <class Visitor>
    void report(Visitor&& visit) const {
        visit(ReportRow{quantity("centre.x"), x_.estimate()});
        visit(ReportRow{quantity("centre.y"), y_.estimate()});
        visit(ReportRow{quantity("centre.distance"), distance_.estimate()});
        visit(direction_row(quantity("centre.theta"), direction_));
        visit(ReportRow{quantity("centre.left"), left_.estimate()});
        visit(ReportRow{quantity("centre.elongation"), elongation_.estimate()});
        visit(ReportRow{quantity("centre.centrifugal"), centrifugal_.estimate()});
        visit(ReportRow{quantity("centre.coriolis"), coriolis_.estimate()});
        const auto maximum = [&](double value) { return samples_ > 0 ? value : not_available; };
        visit(number_row(quantity("centre.max_centrifugal"), maximum(max_centrifugal_)));
        visit(number_row(quantity("centre.max_coriolis"), maximum(max_coriolis_)));
    }
    void merge(const ClusterCentre& other) {
        BlockAverages::merge(other);
        samples_ += other.samples_;
        max_centrifugal_ = std::max(max_centrifugal_, other.max_centrifugal_);
        max_coriolis_ = std::max(max_coriolis_, other.max_coriolis_);
    }
    template <class Visitor>
    void fields(Visitor&& visit) {
        visit(samples_, max_centrifugal_, max_coriolis_);
        this->visit_averages(visit);
    }

  private:
    // Relative size of λ₂ below which the discs count as lying in a line: far above rounding.
    static constexpr double in_a_line = 1e-9;

    double max_centrifugal_ = 0.0, max_coriolis_ = 0.0;
    BlockMean x_, y_, distance_, left_, elongation_, centrifugal_, coriolis_;
    CircularMean direction_;
};

}  // namespace swirl
