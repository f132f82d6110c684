// How densely the discs are packed where they are.
//
//   φ_i = π R_i² / (area of the disc's cell)         cells: voronoi.hpp, cut off at the wall
//
// The densest packing of equal discs has π/√12 = 0.9069. Average: over discs and samples, and over
// the pinned ones among them; a disc counts the same however large its cell, so dense regions,
// where the discs are, weigh more than in the mean over the area (N π r²/πR²).
//
// Units: none. Error from blocks of periods. Limits: a disc whose position is not a number is left
// out.
#pragma once

#include <cstdint>
#include <span>

#include "swirl/measure/all_and_pinned.hpp"
#include "swirl/measure/m_frame.hpp"
#include "swirl/measure/measurement_report.hpp"
#include "swirl/measure/voronoi.hpp"

namespace swirl {

class LocalPacking : public AllAndPinned {
  public:
    void sample(const MFrameView& view, const Voronoi& cells,
                std::span<const std::uint8_t> pinned = {}) {
        add(view, pinned, [&](std::size_t i) {
            const double area = cells.area(i);
            return area > 0.0 ? pi * view.radius[i] * view.radius[i] / area : not_available;
        });
    }

    template <class Visitor>
    void report(Visitor&& visit) const {
        visit(ReportRow{"all", "1", "local packing fraction φ of all discs", all()});
        visit(ReportRow{"pinned", "1", "local packing fraction φ of the pinned discs", pinned()});
        visit(ReportRow{"stays", "1", "local packing fraction φ of the discs on a stay at the wall",
                        on_residences()});
    }
};

}  // namespace swirl
