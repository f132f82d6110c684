// How closely the neighbours of a disc are arranged as in a honeycomb.
//
//   ψ_6(i) = |Σ_j l_ij exp(6 i θ_ij)| / Σ_j l_ij
//
// over the neighbours j of disc i in the Voronoi diagram (voronoi.hpp). θ_ij is the direction from
// i to j, l_ij the length of the common border inside the container. The weight makes ψ_6
// continuous where a neighbour appears or vanishes (Mickel, Kapfer, Schröder-Turk, Mecke 2013,
// doi:10.1063/1.4774084). It is 1 for a perfect hexagon and 0 for a square. A disc at the wall has
// neighbours on one side only; there is no correction for that.
//
// Six neighbours: the share of the discs with exactly six neighbours, among the discs that are
// farther than their diameter from the wall. At that distance the wall does not prevent six
// neighbours. The share is 1 in a crystal and 0.29 for random points.
//
// Average: over discs and samples, and over the pinned and the resident ones among them. Errors:
// from blocks of periods. Units: none. Limits: a disc without neighbours has no ψ_6 and is omitted.
#pragma once

#include "swirl/measure/m_frame.hpp"
#include "swirl/measure/measurement_report.hpp"
#include "swirl/measure/quantities.hpp"
#include "swirl/measure/region_averages.hpp"
#include "swirl/measure/voronoi.hpp"

namespace swirl {

/// ψ_6 of one disc; NaN without neighbours.
inline double hexatic_order(const MFrameView& view, const Voronoi& cells, std::size_t disc) {
    double re = 0.0, im = 0.0, total = 0.0;
    for (const Voronoi::Border* b = cells.begin(disc); b != cells.end(disc); ++b) {
        const Vec2 d = view.position(b->neighbour) - view.position(disc);
        const double square = dot(d, d);
        // (d/|d|)^6 as a complex number: d², d²·d² · d², over |d|⁶.
        const Vec2 two{(d.x * d.x - d.y * d.y) / square, 2.0 * d.x * d.y / square};
        const Vec2 four{two.x * two.x - two.y * two.y, 2.0 * two.x * two.y};
        re += b->length * (four.x * two.x - four.y * two.y);
        im += b->length * (four.x * two.y + four.y * two.x);
        total += b->length;
    }
    return total > 0.0 ? square_root(re * re + im * im) / total : not_available;
}

class HexaticOrder : public RegionAverages {
  public:
    static constexpr bool any_path = true;

    void sample(const MFrameView& view, const Voronoi& cells, PinnedFlags pinned = {}) {
        add(view, pinned, [&](std::size_t i) { return hexatic_order(view, cells, i); });
        for (std::size_t i = 0; i < view.size(); ++i) {
            const Vec2 p = view.position(i);
            const double inside = view.container_radius - 2.0 * view.radius[i];
            if (!(inside > 0.0 && dot(p, p) < inside * inside)) continue;
            const double six = cells.end(i) - cells.begin(i) == 6 ? 1.0 : 0.0;
            six_.add(six);
            if (is_pinned(pinned, i)) six_pinned_.add(six);
        }
    }
    void close_block() {
        RegionAverages::close_block();
        six_.close_block();
        six_pinned_.close_block();
    }
    Estimate six() const { return six_.estimate(); }
    Estimate six_pinned() const { return six_pinned_.estimate(); }

    template <class Visitor>
    void report(Visitor&& visit) const {
        visit(ReportRow{quantity("order.all"), all()});
        visit(ReportRow{quantity("order.pinned"), pinned()});
        visit(ReportRow{quantity("order.resident"), resident()});
        visit(ReportRow{quantity("order.six"), six()});
        visit(ReportRow{quantity("order.six_pinned"), six_pinned()});
    }
    void merge(const HexaticOrder& other) {
        RegionAverages::merge(other);
        six_.merge(other.six_);
        six_pinned_.merge(other.six_pinned_);
    }
    template <class Visitor>
    void fields(Visitor&& visit) {
        RegionAverages::fields(visit);
        visit(six_, six_pinned_);
    }

  private:
    BlockMean six_, six_pinned_;
};

}  // namespace swirl
