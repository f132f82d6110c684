// How densely the discs are packed where they are.
//
//   φ_i = π R_i² / (area of the disc's cell)         cells: voronoi.hpp, cut off at the wall
//
// The densest packing of equal discs has π/√12 = 0.9069. Average: over discs and looks, and over
// the pinned ones among them; a disc counts the same however large its cell, so dense regions,
// where the discs are, weigh more than in the mean over the area (N π r²/πR²).
//
// Units: none. Error from blocks of periods. Limits: a disc whose position is not a number is left
// out.
#pragma once

#include <cstdint>
#include <span>

#include "measure/m_frame.hpp"
#include "measure/statistics.hpp"
#include "measure/voronoi.hpp"

namespace swirl {

class LocalPacking {
  public:
    void look(const MFrameView& view, const Voronoi& cells,
              std::span<const std::uint8_t> pinned = {}) {
        for (std::size_t i = 0; i < view.size(); ++i) {
            if (!(cells.area(i) > 0.0)) continue;
            const double fraction = pi * view.radius[i] * view.radius[i] / cells.area(i);
            all_.add(fraction);
            if (i < pinned.size() && pinned[i] != 0) pinned_.add(fraction);
        }
    }
    void close_block() {
        all_.close_block();
        pinned_.close_block();
    }
    Estimate all() const { return all_.estimate(); }
    Estimate pinned() const { return pinned_.estimate(); }

    void merge(const LocalPacking& other) {
        all_.merge(other.all_);
        pinned_.merge(other.pinned_);
    }
    template <class Visitor>
    void fields(Visitor&& visit) {
        all_.fields(visit);
        pinned_.fields(visit);
    }

  private:
    BlockMean all_, pinned_;
};

}  // namespace swirl
