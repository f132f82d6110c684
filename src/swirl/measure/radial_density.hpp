// The density of discs as a function of the distance from the container's centre C.
//
//   ρ(ring) = ⟨number of disc centres in the ring⟩ / area of the ring
//
// in discs per unit area. The rings about C are equally wide, from 0 to R. Σ ρ × area is the number
// of discs. Multiplied by the area of a disc, ρ is the packing fraction of a container that has
// this density everywhere.
//
// Units: 1/length². Normalisation: per sample. Errors: from blocks of periods. Limits: no samples:
// NaN. A centre outside the container (a camera's error) is counted in no ring.
#pragma once

#include <cstdint>
#include <vector>

#include "swirl/measure/cell_averages.hpp"
#include "swirl/measure/m_frame.hpp"
#include "swirl/measure/measurement_report.hpp"
#include "swirl/measure/quantities.hpp"

namespace swirl {

class RadialDensity {
  public:
    static constexpr bool any_path = true;

    explicit RadialDensity(double container_radius, std::size_t rings = 43)
        : container_radius_(container_radius), counts_(rings + 1) {}

    void sample(const MFrameView& view);
    void close_block() { counts_.close_block(); }

    std::size_t rings() const { return counts_.size() - 1; }
    double inner_radius(std::size_t ring) const {
        return container_radius_ * static_cast<double>(ring) / static_cast<double>(rings());
    }
    double outer_radius(std::size_t ring) const { return inner_radius(ring + 1); }
    double area(std::size_t ring) const {
        const double inner = inner_radius(ring), outer = outer_radius(ring);
        return pi * (outer - inner) * (outer + inner);
    }
    Estimate density(std::size_t ring) const {
        return scaled(counts_.estimate(ring), 1.0 / area(ring));
    }

    template <class Visitor>
    void report(Visitor&& visit) const {
        ReportTable table{"",
                          "discs per area, in rings about the container's centre",
                          {{quantity("radial.inner_radius")},
                           {quantity("radial.outer_radius")},
                           {quantity("radial.density"), with_error_column}}};
        for (std::size_t ring = 0; ring < rings(); ++ring)
            table.add(inner_radius(ring), outer_radius(ring), density(ring));
        visit(std::move(table));
    }
    void merge(const RadialDensity& other) { counts_.merge(other.counts_); }
    template <class Visitor>
    void fields(Visitor&& visit) {
        visit(counts_);
    }

  private:
    double container_radius_;
    CellRates counts_;                // the last ring is outside
    std::vector<std::int32_t> ring_;  // one per disc, at one sample
};

}  // namespace swirl
