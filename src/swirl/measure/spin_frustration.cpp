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

    const bool hold = held_spins_.empty();  // and no pairs: one of each is in the layer
    if (hold) held_at_ = view.time;
    for (std::size_t i = 0; i < n; ++i) {
        if (hold && in_wall_layer(view, i))
            held_spins_.push_back({i, std::abs(view.spin[i]) / view.frame.omega});
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
        if (hold && (in_wall_layer(view, pair.i) || in_wall_layer(view, pair.j)))
            held_pairs_.push_back({pair.i, pair.j, a, b});
        const auto& others = neighbours_[pair.j];
        const bool triangle = std::any_of(
            neighbours_[pair.i].begin(), neighbours_[pair.i].end(),
            [&](auto k) { return std::find(others.begin(), others.end(), k) != others.end(); });
        triangles_.add(triangle ? 1.0 : 0.0);
    }
}

void SpinFrustration::sample_residences(const LongResidences& residences) {
    if (held_spins_.empty() || !residences.knows(held_at_)) return;
    const auto pinned = [&](std::size_t disc) { return residences.pinned(disc, held_at_); };
    for (const Spin& one : held_spins_)
        if (pinned(one.disc)) residence_spin_.add(one.spin);
    for (const Spins& pair : held_pairs_) {
        const bool i = pinned(pair.i), j = pinned(pair.j);
        if (i || j) add_pair(residence_correlation_, pair.a, pair.b);
        if (i && j) add_pair(along_wall_, pair.a, pair.b);
    }
    held_spins_.clear();
    held_pairs_.clear();
}

}  // namespace swirl
