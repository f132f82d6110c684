// Normal and tangential stress of the discs on the wall, in the M-frame.
//
//   pressure(θ)   Σ J_n / (R Δθ t)     force on the wall per length, outwards
//   traction(θ)   Σ J_t / (R Δθ t)     force on the wall per length, along it, counter-clockwise
//
// over the disc–wall collisions whose contact lies in the slice Δθ of θ within the time t; J is the
// impulse on the wall. In the M-frame the wall moves clockwise. Discs that the wall drags along
// exert an opposite force on it, so the traction is positive at these θ. |traction| ≤ μ_w ·
// pressure everywhere.
//
// Units: force/length, in disc mass × speed² / length². Errors: from blocks of periods. Limits: no
// time: NaN; slices without a collision: 0.
#pragma once

#include <algorithm>
#include <tuple>

#include "swirl/measure/cell_averages.hpp"
#include "swirl/measure/m_frame.hpp"
#include "swirl/measure/measurement_report.hpp"
#include "swirl/measure/quantities.hpp"
#include "swirl/physics/event.hpp"
#include "swirl/statistics/block_average.hpp"

namespace swirl {

class WallStress : public MergedAverages<WallStress> {
  public:
    static auto averages(auto& s) {
        return std::tie(s.normal_, s.tangential_, s.all_normal_, s.all_tangential_);
    }

    static constexpr bool reads_only_event = true;
    explicit WallStress(double container_radius, std::size_t slices = 72)
        : container_radius_(container_radius), normal_(slices), tangential_(slices) {}

    void sample_event(const Event& event, const Snapshot& after) {
        if (event.kind != EventKind::disc_wall) return;
        const double u = turns_of(m_frame(after).rotate(event.normal));
        const std::size_t slice = std::min(
            static_cast<std::size_t>(u * static_cast<double>(normal_.size())), normal_.size() - 1);
        normal_.add(slice, event.impulse.normal);
        // The law's tangent (n_y, −n_x) points clockwise.
        tangential_.add(slice, -event.impulse.tangential);
        open_normal_ += event.impulse.normal;
        open_tangential_ -= event.impulse.tangential;
    }
    /// `duration`: the time in which the events since the last call happened.
    void close_event_block(double duration) {
        normal_.add_weight(duration);
        tangential_.add_weight(duration);
        normal_.close_block();
        tangential_.close_block();
        all_normal_.add(open_normal_, duration);
        all_tangential_.add(open_tangential_, duration);
        open_normal_ = open_tangential_ = 0.0;
    }

    std::size_t slices() const { return normal_.size(); }
    double theta(std::size_t slice) const {
        return 2.0 * pi * (static_cast<double>(slice) + 0.5) / static_cast<double>(slices());
    }
    Estimate pressure(std::size_t slice) const {
        return scaled(normal_.estimate(slice), per_length());
    }
    Estimate traction(std::size_t slice) const {
        return scaled(tangential_.estimate(slice), per_length());
    }
    /// Averaged along the whole wall.
    Estimate mean_pressure() const { return scaled(all_normal_.estimate(), per_circumference()); }
    Estimate mean_traction() const {
        return scaled(all_tangential_.estimate(), per_circumference());
    }

    template <class Visitor>
    void report(Visitor&& visit) const {
        visit(ReportRow{quantity("wall.pressure"), mean_pressure()});
        visit(ReportRow{quantity("wall.traction"), mean_traction()});
        ReportTable table{"profile",
                          "pressure and traction in slices of θ",
                          {{quantity("wall.profile.theta")},
                           {quantity("wall.profile.pressure"), with_error_column},
                           {quantity("wall.profile.traction"), with_error_column}}};
        for (std::size_t s = 0; s < slices(); ++s)
            table.add(theta(s) * degrees_per_radian, pressure(s), traction(s));
        visit(std::move(table));
    }
    template <class Visitor>
    void fields(Visitor&& visit) {
        visit(normal_, tangential_, open_normal_, open_tangential_, all_normal_, all_tangential_);
    }

  private:
    double per_length() const {
        return static_cast<double>(slices()) / (2.0 * pi * container_radius_);
    }
    double per_circumference() const { return 1.0 / (2.0 * pi * container_radius_); }

    double container_radius_;
    CellRates normal_, tangential_;
    double open_normal_ = 0.0, open_tangential_ = 0.0;
    BlockSeries all_normal_, all_tangential_;
};

}  // namespace swirl
