// How the rotation rate of the cluster fluctuates from period to period, for finite-size scaling.
//
// The values are the means of ϖ over each period (cluster_rotation.hpp), of both estimators: the
// rigid body, and the mean over the discs (rows with the prefix discs_). The quantities are
// those of fluctuations.hpp. The variance is multiplied by the number N of discs: N var(ϖ) does not
// depend on N if the cluster consists of independent parts.
//
// At a continuous transition N var(ϖ) and τ grow with the size at N_c, and the Binder cumulants of
// all sizes cross at one point. Two states with lifetimes that grow with the size indicate a
// discontinuous one.
//
// By default only every 8th sample is used. Units: Ω, Ω² for the variance; periods for times.
// Limits: those of fluctuations.hpp. At one instant the mean over the discs has an infinite
// variance, because ϖ_i diverges at the centre of mass; its fluctuations are dominated by discs
// there. The rigid body has no such limit. Values are for whole periods after the warm-up. Every
// path of the container is possible.
#pragma once

#include <array>
#include <cstdint>

#include "swirl/math/unit_circle.hpp"
#include "swirl/measure/cluster_rotation.hpp"
#include "swirl/measure/measurement_report.hpp"
#include "swirl/measure/quantities.hpp"
#include "swirl/measure/strided.hpp"
#include "swirl/statistics/fluctuations.hpp"

namespace swirl {

/// A quantity of Fluctuations: its row for the rigid body, and that for the mean over the discs.
struct FluctuationRow {
    Estimate Fluctuations::*quantity;
    const Quantity *rigid, *discs;
};
// clang-format off
inline constexpr std::array<FluctuationRow, 9> fluctuation_rows{{
    {&Fluctuations::variance, &quantity("fluctuations.n_variance"),
     &quantity("fluctuations.discs_n_variance")},
    {&Fluctuations::skewness, &quantity("fluctuations.skewness"),
     &quantity("fluctuations.discs_skewness")},
    {&Fluctuations::excess_kurtosis, &quantity("fluctuations.excess_kurtosis"),
     &quantity("fluctuations.discs_excess_kurtosis")},
    {&Fluctuations::binder, &quantity("fluctuations.binder"),
     &quantity("fluctuations.discs_binder")},
    {&Fluctuations::autocorrelation_time, &quantity("fluctuations.correlation_time"),
     &quantity("fluctuations.discs_correlation_time")},
    {&Fluctuations::low, &quantity("fluctuations.low"),
     &quantity("fluctuations.discs_low")},
    {&Fluctuations::high, &quantity("fluctuations.high"),
     &quantity("fluctuations.discs_high")},
    {&Fluctuations::low_lifetime, &quantity("fluctuations.low_lifetime"),
     &quantity("fluctuations.discs_low_lifetime")},
    {&Fluctuations::high_lifetime, &quantity("fluctuations.high_lifetime"),
     &quantity("fluctuations.discs_high_lifetime")},
}};
// clang-format on

class RotationFluctuations : public Strided {
  public:
    /// A block is the mean of one period. With few samples, their scatter adds to its variance: by
    /// half with 4 samples, fourfold with 1.
    static constexpr double min_frames_per_period =
        quantity("fluctuations.n_variance").min_rates.of_frames;
    static constexpr bool any_path = true;

    explicit RotationFluctuations(int every = 8) : Strided(every) {}

    void sample_in_lab(const Snapshot& lab) {
        if (skips_next()) return;
        const double per_omega = lab.period / (2.0 * pi);
        const RotationSample now = cluster_rotation(lab);
        discs_ = static_cast<double>(lab.size());
        individual_.add(now.individual * per_omega);
        rigid_.add(now.rigid * per_omega);
    }
    void close_block() {
        individual_.close_block();
        rigid_.close_block();
    }
    void merge(const RotationFluctuations& other) {
        individual_.merge(other.individual_);
        rigid_.merge(other.rigid_);
        if (discs_ == 0.0) discs_ = other.discs_;
    }

    Fluctuations individual() const { return fluctuations_of(individual_.runs()); }
    Fluctuations rigid() const { return fluctuations_of(rigid_.runs()); }

    template <class Visitor>
    void report(Visitor&& visit) const {
        Fluctuations rigid_body = rigid(), discs = individual();
        for (Fluctuations* f : {&rigid_body, &discs}) f->variance = scaled(f->variance, discs_);
        for (const FluctuationRow& row : fluctuation_rows)
            visit(ReportRow{*row.rigid, rigid_body.*row.quantity});
        for (const FluctuationRow& row : fluctuation_rows)
            visit(ReportRow{*row.discs, discs.*row.quantity});
    }

    template <class Visitor>
    void fields(Visitor&& visit) {
        visit(samples_, discs_, individual_, rigid_);
    }

  private:
    double discs_ = 0.0;
    PeriodMeans individual_, rigid_;
};

}  // namespace swirl
