// How densely the discs are packed around each disc.
//
//   φ_i = π R_i² / (area of the disc's cell)         cells: voronoi.hpp, cut off at the wall
//
// The densest packing of equal discs has π/√12 = 0.9069. Average: over discs and samples, and over
// the pinned and the resident ones among them. A disc counts the same whatever the size of its
// cell. So dense regions, where the discs are, weigh more than in the mean over the area
// (N π r²/πR²).
//
// Units: none. Errors: from blocks of periods. Limits: a disc without a finite position is omitted.
#pragma once

#include "swirl/measure/m_frame.hpp"
#include "swirl/measure/measurement_report.hpp"
#include "swirl/measure/quantities.hpp"
#include "swirl/measure/region_averages.hpp"
#include "swirl/measure/voronoi.hpp"

namespace swirl {

class LocalPacking : public RegionAverages {
  public:
    static constexpr bool any_path = true;

    void sample(const MFrameView& view, const Voronoi& cells, PinnedFlags pinned = {}) {
        add(view, pinned, [&](std::size_t i) {
            const double area = cells.area(i);
            return area > 0.0 ? pi * view.radius[i] * view.radius[i] / area : not_available;
        });
    }

    template <class Visitor>
    void report(Visitor&& visit) const {
        visit(ReportRow{quantity("packing.all"), all()});
        visit(ReportRow{quantity("packing.pinned"), pinned()});
        visit(ReportRow{quantity("packing.resident"), resident()});
    }
};

}  // namespace swirl
