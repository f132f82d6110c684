#include "swirl/measure/slip.hpp"

namespace swirl {
namespace {

double perimeter_of(const MFrameView& view, std::vector<Vec2>& centres) {
    if (view.size() == 0) return not_available;
    centres.clear();
    double radius = 0.0;
    for (std::size_t i = 0; i < view.size(); ++i) {
        const Vec2 p = view.position(i);
        if (!(dot(p, p) < never)) return not_available;
        centres.push_back(p);
        radius += view.radius[i] / static_cast<double>(view.size());
    }
    return perimeter(convex_hull(centres)) + 2.0 * pi * radius;
}

/// The mean of ϖ over some of the discs.
struct MeanRate {
    double sum = 0.0, count = 0.0;

    void add(double rate) {
        sum += rate;
        count += 1.0;
    }
    /// Adds −ϖ_M × factor to the average; nothing without discs.
    void add_slip_to(BlockMean& average, double omega, double factor) const {
        if (count > 0.0) average.add((omega - sum / count) * factor);
    }
};

}  // namespace

double cluster_perimeter(const MFrameView& view) {
    std::vector<Vec2> centres;
    return perimeter_of(view, centres);
}

void Slip::sample(const MFrameView& view, PinnedFlags pinned) {
    if (skips_next()) return;
    const double P = perimeter_of(view, centres_);
    if (!(P == P)) return;
    const double P_container = 2.0 * pi * view.container_radius;
    perimeter_.add(P);
    pancake_.add(pancake_rotation(P, P_container));

    const double omega = view.frame.omega, factor = P / (P_container * omega);
    const CentreOfMass centre = view.centre_of_mass();
    const bool nothing_pending = pending_.empty();
    MeanRate all, of_pinned;
    for (std::size_t i = 0; i < view.size(); ++i) {
        const double rate = centre.varpi(view.position(i), view.relative_velocity(i));
        const Vec2 d = view.position(i) - centre.position;
        if (!(rate == rate) || dot(d, d) < view.radius[i] * view.radius[i]) continue;
        all.add(rate);
        if (is_pinned(pinned, i)) of_pinned.add(rate);
        if (nothing_pending && in_wall_layer(view, i)) pending_.push_back({i, rate});
    }
    if (nothing_pending) {
        pending_time_ = view.time;
        pending_factor_ = factor;
        pending_omega_ = omega;
    }
    all.add_slip_to(cluster_, omega, factor);
    of_pinned.add_slip_to(pinned_, omega, factor);
}

void Slip::sample_residences(const LongResidences& residences) {
    if (pending_.empty() || !residences.is_known(pending_time_)) return;
    MeanRate of_resident;
    for (const Rate& rate : pending_)
        if (residences.resident(rate.disc, pending_time_)) of_resident.add(rate.varpi);
    of_resident.add_slip_to(resident_, pending_omega_, pending_factor_);
    pending_.clear();
}

}  // namespace swirl
