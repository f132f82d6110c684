// How the discs move, in the M-frame: the arrows of the paper's Figs 2b, 2c and 5d.
//
//   flow of a cell = ⟨u⟩ over the discs found in it
//
// where u is the velocity relative to the container, rotated into the M-frame (m_frame.hpp): the
// paper's "average local disc velocity deviation from the container". A disc that moves with the
// container has 0.
//
// Units: the snapshot's velocity, in which the container's speed is 1. Normalisation: every disc
// found in the cell counts the same, at every sample. Errors: from blocks of periods
// (cell_averages.hpp). Source: paper, SI "Simulation parameters" (20 × 20 cells over the
// container's bounding square). Limits: a cell never visited has no flow (NaN). A centre outside
// the square belongs to no cell.
#pragma once

#include <cstdint>
#include <vector>

#include "swirl/measure/cell_averages.hpp"
#include "swirl/measure/m_frame.hpp"
#include "swirl/measure/measurement_report.hpp"
#include "swirl/measure/quantities.hpp"
#include "swirl/measure/square_grid.hpp"

namespace swirl {

class FlowMap {
  public:
    explicit FlowMap(double container_radius, std::size_t side = 20)
        : grid_{side, container_radius}, cells_(grid_.cells() + 1) {}

    void sample(const MFrameView& view) {
        cell_.resize(view.size());
        grid_.locate(view.size(), view.x.data(), view.y.data(), cell_.data());
        for (std::size_t i = 0; i < view.size(); ++i)
            cells_.add(static_cast<std::size_t>(cell_[i]), {view.ux[i], view.uy[i]});
    }
    void close_block() { cells_.close_block(); }

    const SquareGrid& grid() const { return grid_; }
    /// How often a disc was found in the cell.
    double visits(std::size_t cell) const { return cells_.visits(cell); }
    Estimate flow_x(std::size_t cell) const { return cells_.estimate(cell, 0); }
    Estimate flow_y(std::size_t cell) const { return cells_.estimate(cell, 1); }

    template <class Visitor>
    void report(Visitor&& visit) const {
        ReportTable table{"",
                          "velocity relative to the container, in cells of its bounding square",
                          {{quantity("flow.x")},
                           {quantity("flow.y")},
                           {quantity("flow.visits")},
                           {quantity("flow.u_x"), with_error_column},
                           {quantity("flow.u_y"), with_error_column}}};
        for (std::size_t c = 0; c < grid_.cells(); ++c) {
            const Vec2 p = grid_.centre_of(c);
            table.add(p.x, p.y, visits(c), flow_x(c), flow_y(c));
        }
        visit(std::move(table));
    }
    void merge(const FlowMap& other) { cells_.merge(other.cells_); }
    template <class Visitor>
    void fields(Visitor&& visit) {
        visit(cells_);
    }

  private:
    SquareGrid grid_;
    CellMeans<2> cells_;              // the last cell is outside
    std::vector<std::int32_t> cell_;  // one per disc, at one sample
};

}  // namespace swirl
