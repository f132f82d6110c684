// How much more often two discs are at a distance r than independent discs would be: the pair
// correlation function g(r).
//
//   g(r)       ⟨pairs with a distance in the bin⟩ / (½ N(N − 1) (F(r₂) − F(r₁)))
//   F(r)       probability that two independent points in the circle of radius a are closer than r:
//              with s = r/a, F = 1 + (2/π)(s² − 1) arccos(s/2) − (s/π)(1 + s²/2) √(1 − s²/4)
//              (Solomon, Geometric Probability, 1978, ch. 2)
//   g_inner(r) ⟨partners in the bin of a disc of the inner circle⟩ / (ρ π (r₂² − r₁²))
//   ρ          ⟨discs in the inner circle⟩ / its area
//   contact    g_inner extrapolated to touching discs
//
// a = R − (mean radius of a disc): centres cannot be closer to the wall. g has no edge effect; it
// is 1 for independent discs in the whole container, and Σ g (F(r₂) − F(r₁)) over all bins is 1. In
// a cluster, g is above 1 at short distances for this reason alone. g_inner takes reference discs
// in the inner circle of radius R/2 about C only, and their partners anywhere. It is that of the
// bulk, without the layers that a wall causes, if the density is uniform.
//
// Contact. With the gap h = r − R_i − R_j, three cells of width δ = 0.1 × (mean radius) have the
// averages g_1, g_2, g_3 of g_inner. The parabola with these averages has the value
// (11 g_1 − 7 g_2 + 2 g_3)/6 at h = 0. The gas of elastic hard discs at the packing fraction φ has
// g(σ) = (1 − 7φ/16)/(1 − φ)² (Henderson 1975, doi:10.1080/00268977500102511).
//
// By default only every 64th sample is used: neighbouring samples hardly differ. Units: none.
// Errors: from blocks of periods; that of ρ is added to those of g_inner. Limits: bins that reach
// out of the circles (r > 2a for g, r > R/2 − (mean radius) for g_inner) and fewer than two discs
// give NaN. Distances are at most 20 r. Overlapping discs (a camera's errors) do not count at
// contact. If radii differ, a is that of their mean, and g shows the distances of all species.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <vector>

#include "swirl/measure/cell_averages.hpp"
#include "swirl/measure/m_frame.hpp"
#include "swirl/measure/measurement_report.hpp"
#include "swirl/measure/pair_distances.hpp"
#include "swirl/measure/quantities.hpp"
#include "swirl/measure/strided.hpp"

namespace swirl {

/// Probability that two independent points, uniform in a circle of radius 1, are closer than s.
double closer_in_circle(double s);

class PairCorrelation : public BlockAverages<PairCorrelation>, public Strided {
  public:
    static constexpr bool any_path = true;  // no axis of the M-frame matters
    static auto averages(auto& s) {
        return std::tie(s.pairs_, s.partners_, s.contact_, s.inside_, s.packing_, s.radius_);
    }

    explicit PairCorrelation(const ObservedDish& dish, int every = 64)
        : Strided(every),
          inner_radius_(0.5 * dish.container_radius),
          container_radius_(dish.container_radius),
          bins_(dish.container_radius, dish.units.r),
          pairs_(bins_.count),
          partners_(bins_.count) {}

    void sample(const MFrameView& view);

    const DistanceBins& bins() const { return bins_; }
    Estimate g(std::size_t bin) const;
    Estimate inner_g(std::size_t bin) const;
    Estimate contact() const { return over_density(contact_.estimate(), 1.0); }
    /// Packing fraction of the inner circle.
    Estimate inner_packing() const { return packing_.estimate(); }

    template <class Visitor>
    void report(Visitor&& visit) const {
        visit(ReportRow{quantity("pair_correlation.contact"), contact()});
        visit(ReportRow{quantity("pair_correlation.inner_packing"), inner_packing()});
        ReportTable table{"function",
                          "pair correlation g in the whole container, and g_inner about discs in "
                          "its inner circle",
                          {{quantity("pair_correlation.function.distance")},
                           {quantity("pair_correlation.function.g"), with_error_column},
                           {quantity("pair_correlation.function.g_inner"), with_error_column}}};
        for (std::size_t bin = 0; bin < bins_.count; ++bin)
            table.add(bins_.middle(bin), g(bin), inner_g(bin));
        visit(std::move(table));
    }
    template <class Visitor>
    void fields(Visitor&& visit) {
        visit(samples_);
        this->visit_averages(visit);
    }

  private:
    /// Partners per reference disc and area as a multiple of ρ.
    Estimate over_density(Estimate partners, double area) const;
    /// Σ over the partners of a disc gives the value at contact.
    static double contact_weight(double gap, double cell, double contact_distance);

    double inner_radius_, container_radius_;
    DistanceBins bins_;
    CellRates pairs_;     // rates per pair of discs
    CellRates partners_;  // rates per disc in the inner circle
    BlockMean contact_, inside_, packing_, radius_;
    std::vector<std::uint32_t> order_;
    std::vector<char> is_inside_;
};

}  // namespace swirl
