#include "swirl/measure/spin_frustration.hpp"

#include <algorithm>
#include <cmath>

namespace swirl {

void SpinFrustration::sample(const MFrameView& view, std::span<const std::uint8_t> pinned) {
    if (samples_++ % every_ != 0) return;
    const std::size_t n = view.size();
    if (n == 0) return;
    double mean_radius = 0.0;
    for (const double r : view.radius) mean_radius += r / static_cast<double>(n);

    for (std::size_t i = 0; i < n; ++i) {
        const Vec2 p = view.position(i);
        const double gap = view.container_radius - view.radius[i] - square_root(dot(p, p));
        if (!(gap < gap_ * view.radius[i])) continue;
        const double spin = std::abs(view.spin[i]) / view.frame.omega;
        wall_spin_.add(spin);
        if (i < pinned.size() && pinned[i] != 0) pinned_wall_spin_.add(spin);
    }

    const std::vector<Pair>& pairs = touching_.find(view, gap_ * mean_radius);
    coordination_.add(2.0 * static_cast<double>(pairs.size()) / static_cast<double>(n));
    neighbours_.resize(n);
    for (auto& list : neighbours_) list.clear();
    for (const Pair& pair : pairs) {
        neighbours_[pair.i].push_back(pair.j);
        neighbours_[pair.j].push_back(pair.i);
    }
    for (const Pair& pair : pairs) {
        const double a = view.spin[pair.i], b = view.spin[pair.j];
        add_pair(correlation_, a, b);
        const bool both_pinned = pair.i < pinned.size() && pair.j < pinned.size() &&
                                 pinned[pair.i] != 0 && pinned[pair.j] != 0;
        if (both_pinned) add_pair(pinned_correlation_, a, b);
        const auto& others = neighbours_[pair.j];
        const bool triangle = std::any_of(
            neighbours_[pair.i].begin(), neighbours_[pair.i].end(),
            [&](auto k) { return std::find(others.begin(), others.end(), k) != others.end(); });
        triangles_.add(triangle ? 1.0 : 0.0);
    }
}

}  // namespace swirl
