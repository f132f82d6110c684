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

/// ϖ of some of the discs.
struct Rates {
    double sum = 0.0, count = 0.0;

    void add(double rate) {
        sum += rate;
        count += 1.0;
    }
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

    Rates all, held, held_at_wall;
    for (std::size_t i = 0; i < view.size(); ++i) {
        const double rate = view.varpi[i];
        const Vec2 d = view.position(i) - view.centre_of_mass;
        if (!(rate == rate) || dot(d, d) < view.radius[i] * view.radius[i]) continue;
        all.add(rate);
        if (i >= pinned.size() || pinned[i] == 0) continue;
        held.add(rate);
        if (in_wall_layer(view, i)) held_at_wall.add(rate);
    }
    const auto add = [&](BlockMean& slip, const Rates& rates) {
        if (rates.count == 0.0) return;
        slip.add((view.frame.omega - rates.sum / rates.count) *
                 (P / (P_container * view.frame.omega)));
    };
    add(cluster_, all);
    add(pinned_, held);
    add(pinned_at_wall_, held_at_wall);
}

}  // namespace swirl
