#include "swirl/measure/slip.hpp"

#include "swirl/measure/wall_stays.hpp"

namespace swirl {
namespace {

double perimeter_of(const MFrameView& view, std::vector<Vec2>& centres) {
    if (view.size() == 0) return not_known;
    centres.clear();
    double radius = 0.0;
    for (std::size_t i = 0; i < view.size(); ++i) {
        const Vec2 p = view.position(i);
        if (!(dot(p, p) < never)) return not_known;
        centres.push_back(p);
        radius += view.radius[i] / static_cast<double>(view.size());
    }
    return perimeter(convex_hull(centres)) + 2.0 * pi * radius;
}

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

    double all = 0.0, all_count = 0.0, held = 0.0, held_count = 0.0;
    double at_wall = 0.0, at_wall_count = 0.0;
    for (std::size_t i = 0; i < view.size(); ++i) {
        const double rate = view.varpi[i];
        const Vec2 d = view.position(i) - view.centre_of_mass;
        if (!(rate == rate) || dot(d, d) < view.radius[i] * view.radius[i]) continue;
        all += rate;
        all_count += 1.0;
        if (i >= pinned.size() || pinned[i] == 0) continue;
        held += rate;
        held_count += 1.0;
        if (!in_wall_layer(view, i)) continue;
        at_wall += rate;
        at_wall_count += 1.0;
    }
    const double factor = P / (P_container * view.frame.omega);
    if (all_count > 0.0) cluster_.add((view.frame.omega - all / all_count) * factor);
    if (at_wall_count > 0.0)
        pinned_at_wall_.add((view.frame.omega - at_wall / at_wall_count) * factor);
    if (held_count > 0.0) pinned_.add((view.frame.omega - held / held_count) * factor);
}

}  // namespace swirl
