// Map of the spin: the mean spin of the discs in each cell of the M-frame. The spin itself is that
// in the lab frame. A disc that sticks to the wall has spin 0, since the container does not rotate.
// Discs that roll on each other have opposite signs.
#pragma once

#include <cstdint>
#include <vector>

#include "swirl/math/real.hpp"
#include "swirl/measure/m_frame.hpp"
#include "swirl/measure/square_grid.hpp"

namespace swirl {

class SpinMap {
  public:
    explicit SpinMap(double container_radius, std::size_t side = 30)
        : grid_{side, container_radius},
          sum_(grid_.cells() + 1, 0.0),
          visits_(grid_.cells() + 1, 0.0) {}

    void sample(const MFrameView& view) {
        cell_.resize(view.size());
        grid_.locate(view.size(), view.x.data(), view.y.data(), cell_.data());
        for (std::size_t i = 0; i < view.size(); ++i) {
            const auto cell = static_cast<std::size_t>(cell_[i]);
            sum_[cell] += view.spin[i] / view.frame.omega;
            visits_[cell] += 1.0;
        }
    }
    /// In units of Ω, for each cell; NaN in a cell that no disc has visited.
    std::vector<double> means() const {
        std::vector<double> means(grid_.cells());
        for (std::size_t c = 0; c < means.size(); ++c)
            means[c] = visits_[c] > 0.0 ? sum_[c] / visits_[c] : not_available;
        return means;
    }

  private:
    SquareGrid grid_;
    std::vector<double> sum_, visits_;  // the last cell is outside
    std::vector<std::int32_t> cell_;    // one per disc, at one sample
};

}  // namespace swirl
