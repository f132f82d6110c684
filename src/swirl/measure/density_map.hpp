// The density of discs in the M-frame: the paper's Figs 2b, 2c and 5c.
//
//   density of a cell = ⟨number of disc centres in it⟩ / area of the cell
//
// in discs per unit area (unit of length: the disc radius), averaged over samples. Summed over all
// cells and multiplied by the area of a cell, it is the number of discs.
//
//   by event   as in the paper: sampled after every event, or after every k-th, which changes the
//              error but not the mean
//   by time    sampled at equal time steps
//
// Errors: from blocks of periods (cell_averages.hpp). Source: paper, SI "Simulation parameters"
// (100 × 100 cells over the container's bounding square). Limits: no samples: NaN everywhere. A
// centre outside the square is counted in outside() alone.
#pragma once

#include <cstdint>
#include <tuple>
#include <vector>

#include "swirl/measure/cell_averages.hpp"
#include "swirl/measure/m_frame.hpp"
#include "swirl/measure/measurement_report.hpp"
#include "swirl/measure/quantities.hpp"
#include "swirl/measure/square_grid.hpp"

namespace swirl {

class DensityMap {
  public:
    explicit DensityMap(double container_radius, std::size_t side = 100)
        : grid_{side, container_radius}, counts_(grid_.cells() + 1) {}

    void sample(const MFrameView& view) {
        counts_.add_weight();
        cell_.resize(view.size());
        grid_.locate(view.size(), view.x.data(), view.y.data(), cell_.data());
        for (const std::int32_t cell : cell_) counts_.add(static_cast<std::size_t>(cell));
    }
    void close_block() { counts_.close_block(); }

    const SquareGrid& grid() const { return grid_; }
    Estimate density(std::size_t cell) const {
        return scaled(counts_.estimate(cell), 1.0 / grid_.cell_area());
    }
    double count(std::size_t cell) const { return counts_.sum(cell); }
    double samples() const { return counts_.weight(); }
    double outside() const { return counts_.sum(grid_.cells()); }

    void merge(const DensityMap& other) { counts_.merge(other.counts_); }
    template <class Visitor>
    void fields(Visitor&& visit) {
        visit(counts_);
    }

  private:
    SquareGrid grid_;
    CellRates counts_;                // the last cell is outside
    std::vector<std::int32_t> cell_;  // one per disc, at one sample
};

/// The density by time and by event.
class DensityMaps : public BlockAverages<DensityMaps> {
  public:
    static auto averages(auto& s) { return std::tie(s.by_time_, s.by_event_); }

    explicit DensityMaps(double container_radius)
        : by_time_(container_radius), by_event_(container_radius) {}

    void sample(const MFrameView& view) { by_time_.sample(view); }
    void sample_by_event(const MFrameView& view) { by_event_.sample(view); }

    template <class Visitor>
    void report(Visitor&& visit) const {
        ReportTable table{"",
                          "discs per area, in cells of the container's bounding square",
                          {{quantity("density.x")},
                           {quantity("density.y")},
                           {quantity("density.by_time"), with_error_column},
                           {quantity("density.by_event"), with_error_column}}};
        for (std::size_t c = 0; c < by_time_.grid().cells(); ++c) {
            const Vec2 p = by_time_.grid().centre_of(c);
            table.add(p.x, p.y, by_time_.density(c), by_event_.density(c));
        }
        visit(std::move(table));
    }
    template <class Visitor>
    void fields(Visitor&& visit) {
        visit(by_time_, by_event_);
    }

  private:
    DensityMap by_time_, by_event_;
};

}  // namespace swirl
