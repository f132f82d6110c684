#include "swirl/measure/spin_frustration.hpp"

#include <algorithm>
#include <cmath>

namespace swirl {

void SpinFrustration::sample(const MFrameView& view, PinnedFlags pinned) {
    if (skips_next()) return;
    const std::size_t n = view.size();
    if (n == 0) return;

    // A pending pair has a disc in the layer, so without pending spins there are no pairs either.
    const bool nothing_pending = pending_spins_.empty();
    if (nothing_pending) pending_time_ = view.time;
    for (std::size_t i = 0; i < n; ++i) {
        const double spin = std::abs(view.spin[i]) / view.frame.omega;
        if (nothing_pending && in_wall_layer(view, i)) pending_spins_.push_back({i, spin});
        const Vec2 p = view.position(i);
        const double gap = view.container_radius - view.radius[i] - square_root(dot(p, p));
        if (!(gap < gap_ * view.radius[i])) continue;
        wall_spin_.add(spin);
        if (is_pinned(pinned, i)) pinned_wall_spin_.add(spin);
    }

    const std::vector<Pair>& pairs = touching_.find(view, gap_ * view.mean_radius());
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
        if (is_pinned(pinned, pair.i) && is_pinned(pinned, pair.j))
            add_pair(pinned_correlation_, a, b);
        if (nothing_pending && (in_wall_layer(view, pair.i) || in_wall_layer(view, pair.j)))
            pending_pairs_.push_back({pair.i, pair.j, a, b});
        const auto& others = neighbours_[pair.j];
        const bool triangle = std::any_of(
            neighbours_[pair.i].begin(), neighbours_[pair.i].end(),
            [&](auto k) { return std::find(others.begin(), others.end(), k) != others.end(); });
        triangles_.add(triangle ? 1.0 : 0.0);
        add_pair(triangle ? in_triangle_ : in_chain_, a, b);
    }
}

void SpinFrustration::sample_residences(const LongResidences& residences) {
    if (pending_spins_.empty() || !residences.is_known(pending_time_)) return;
    const auto resident = [&](std::size_t disc) {
        return residences.resident(disc, pending_time_);
    };
    for (const Spin& one : pending_spins_)
        if (resident(one.disc)) resident_spin_.add(one.spin);
    for (const SpinPair& pair : pending_pairs_) {
        const bool i = resident(pair.i), j = resident(pair.j);
        if (i || j) add_pair(resident_correlation_, pair.spin_i, pair.spin_j);
        if (i && j) add_pair(along_wall_, pair.spin_i, pair.spin_j);
    }
    pending_spins_.clear();
    pending_pairs_.clear();
}

}  // namespace swirl
