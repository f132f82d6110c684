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

/// ϖ of some of the discs.
struct Rates {
    double sum = 0.0, count = 0.0;

    void add(double rate) {
        sum += rate;
        count += 1.0;
    }
    double mean() const { return sum / count; }
};

}  // namespace

double cluster_perimeter(const MFrameView& view) {
    std::vector<Vec2> centres;
    return perimeter_of(view, centres);
}

void Slip::sample(const MFrameView& view, std::span<const std::uint8_t> pinned) {
    if (samples_++ % every_ != 0) return;
    const double P = perimeter_of(view, centres_);
    if (!(P == P)) return;
    const double P_container = 2.0 * pi * view.container_radius;
    perimeter_.add(P);
    pancake_.add(pancake_rotation(P, P_container));

    const double omega = view.frame.omega, factor = P / (P_container * omega);
    const CentreOfMass centre = view.centre_of_mass();
    const bool hold = held_.empty();
    Rates all, pinned_ones;
    for (std::size_t i = 0; i < view.size(); ++i) {
        const double rate = centre.varpi(view.position(i), view.relative_velocity(i));
        const Vec2 d = view.position(i) - centre.position;
        if (!(rate == rate) || dot(d, d) < view.radius[i] * view.radius[i]) continue;
        all.add(rate);
        if (i < pinned.size() && pinned[i] != 0) pinned_ones.add(rate);
        if (hold && in_wall_layer(view, i)) held_.push_back({i, rate});
    }
    if (hold) held_at_ = view.time, held_factor_ = factor, held_omega_ = omega;
    if (all.count > 0.0) cluster_.add((omega - all.mean()) * factor);
    if (pinned_ones.count > 0.0) pinned_.add((omega - pinned_ones.mean()) * factor);
}

void Slip::sample_residences(const LongResidences& residences) {
    if (held_.empty() || !residences.knows(held_at_)) return;
    Rates on_residences;
    for (const Rate& rate : held_)
        if (residences.pinned(rate.disc, held_at_)) on_residences.add(rate.varpi);
    if (on_residences.count > 0.0)
        residences_.add((held_omega_ - on_residences.mean()) * held_factor_);
    held_.clear();
}

}  // namespace swirl
