// Which discs touch. Hard discs never do for longer than an instant, so two discs count as touching
// when the gap between them is below a tolerance given by the caller.
//
// Found by sweeping over the discs in order of x: O(N^1.5) in a dish. Pairs come in a fixed order
// that depends on the positions alone.
#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

#include "swirl/measure/m_frame.hpp"

namespace swirl {

struct Pair {
    std::uint32_t i, j;
};

class TouchingPairs {
  public:
    /// All pairs with |r_i − r_j| − (R_i + R_j) < gap. Discs whose place is not a number touch
    /// nobody.
    const std::vector<Pair>& find(const MFrameView& view, double gap) {
        pairs_.clear();
        order_.resize(view.size());
        std::iota(order_.begin(), order_.end(), 0u);
        order_.erase(std::remove_if(order_.begin(), order_.end(),
                                    [&](std::uint32_t i) {
                                        return !(view.x[i] == view.x[i] && view.y[i] == view.y[i]);
                                    }),
                     order_.end());
        std::sort(order_.begin(), order_.end(), [&](std::uint32_t a, std::uint32_t b) {
            return view.x[a] < view.x[b] || (view.x[a] == view.x[b] && a < b);
        });
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
