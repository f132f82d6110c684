#include "swirl/measure/pair_correlation.hpp"

#include <cmath>

namespace swirl {

double closer_in_circle(double s) {
    if (!(s < 2.0)) return s >= 2.0 ? 1.0 : not_available;
    const double half = 0.5 * s, sine = square_root(1.0 - half * half);
    const double arccos = 2.0 * pi * turns_of({half, sine});
    return 1.0 + 2.0 / pi * (s * s - 1.0) * arccos - s / pi * (1.0 + 0.5 * s * s) * sine;
}

double PairCorrelation::contact_weight(double gap, double cell, double contact_distance) {
    static constexpr std::array<double, 3> parabola{11.0 / 6.0, -7.0 / 6.0, 2.0 / 6.0};
    const double k = larger(std::floor(gap / cell), 0.0);
    // Discs that touch may overlap by a rounding error.
    if (!(gap > -1e-9 * contact_distance && k < 3.0)) return 0.0;
    const double inner = contact_distance + k * cell, outer = inner + cell;
    return parabola[static_cast<std::size_t>(k)] / (pi * (outer - inner) * (outer + inner));
}

void PairCorrelation::sample(const MFrameView& view) {
    if (skips_next()) return;
    const auto n = static_cast<double>(view.size());
    double inside = 0.0, area = 0.0, at_contact = 0.0;
    is_inside_.resize(view.size());
    for (std::size_t i = 0; i < view.size(); ++i) {
        const Vec2 p = view.position(i);
        is_inside_[i] = dot(p, p) < inner_radius_ * inner_radius_ ? 1 : 0;
        if (is_inside_[i] == 0) continue;
        inside += 1.0;
        area += view.radius[i] * view.radius[i];
    }
    inside_.add(inside);
    packing_.add(area / (inner_radius_ * inner_radius_));
    if (view.size() < 2) return;
    const double mean_radius = view.mean_radius();
    radius_.add(mean_radius);
    const double cell = 0.1 * mean_radius;
    pairs_.add_weight(0.5 * n * (n - 1.0));
    partners_.add_weight(inside);
    for_each_close_pair(
        view, bins_.reach, order_, [&](std::uint32_t i, std::uint32_t j, double distance) {
            const std::size_t bin = bins_.bin_of(distance);
            pairs_.add(bin);
            const int references = is_inside_[i] + is_inside_[j];
            if (references == 0) return;
            partners_.add(bin, references);
            const double touching = view.radius[i] + view.radius[j];
            at_contact += references * contact_weight(distance - touching, cell, touching);
        });
    if (inside > 0.0) contact_.add(at_contact / inside, inside);
}

Estimate PairCorrelation::over_density(Estimate partners, double area) const {
    const Estimate inside = inside_.estimate();
    const double density = inside.mean / (pi * inner_radius_ * inner_radius_);
    const double relative = inside.error / inside.mean;
    Estimate e = scaled(partners, 1.0 / (density * area));
    e.error = square_root(e.error * e.error + e.mean * e.mean * relative * relative);
    return e;
}

Estimate PairCorrelation::g(std::size_t bin) const {
    const double a = container_radius_ - radius_.estimate().mean;
    const Estimate none{.mean = not_available, .error = not_available};
    if (!(bins_.upper(bin) <= 2.0 * a)) return none;
    const double expected =
        closer_in_circle(bins_.upper(bin) / a) - closer_in_circle(bins_.lower(bin) / a);
    return expected > 0.0 ? scaled(pairs_.estimate(bin), 1.0 / expected) : none;
}

Estimate PairCorrelation::inner_g(std::size_t bin) const {
    const double lower = bins_.lower(bin), upper = bins_.upper(bin);
    if (!(upper <= container_radius_ - inner_radius_ - radius_.estimate().mean))
        return {.mean = not_available, .error = not_available};
    return over_density(partners_.estimate(bin), pi * (upper - lower) * (upper + lower));
}

}  // namespace swirl
