// Which discs touch. Hard discs touch only for an instant, so two discs count as touching when the
// gap between them is below a tolerance given by the caller.
//
// A sweep over the discs in order of x finds them: O(N^1.5) in a container. The order of the pairs
// depends on the positions alone.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "swirl/measure/m_frame.hpp"

namespace swirl {

struct Pair {
    std::uint32_t i, j;
};

class TouchingPairs {
  public:
    /// All pairs with |r_i − r_j| − (R_i + R_j) < gap. Discs without a finite position touch no
    /// disc.
    const std::vector<Pair>& find(const MFrameView& view, double gap) {
        pairs_.clear();
        view.order_by_x(order_);
        double largest = 0.0;
        for (const std::uint32_t i : order_) largest = std::max(largest, view.radius[i]);
        for (std::size_t a = 0; a < order_.size(); ++a) {
            const std::uint32_t i = order_[a];
            for (std::size_t b = a + 1; b < order_.size(); ++b) {
                const std::uint32_t j = order_[b];
                const Vec2 d = view.position(j) - view.position(i);
                if (d.x >= view.radius[i] + largest + gap) break;
                const double reach = view.radius[i] + view.radius[j] + gap;
                if (dot(d, d) < reach * reach) pairs_.push_back({i, j});
            }
        }
        return pairs_;
    }

  private:
    std::vector<std::uint32_t> order_;
    std::vector<Pair> pairs_;
};

}  // namespace swirl
