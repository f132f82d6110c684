#include "swirl/measure/radial_density.hpp"

#include "swirl/math/wide.hpp"

namespace swirl {
namespace {

SWIRL_WIDE void rings_of(std::size_t n, double rings, double radius, const double* __restrict x,
                         const double* __restrict y, std::int32_t* __restrict ring) {
    const double per_length = rings / radius;
    for (std::size_t i = 0; i < n; ++i) {
        const double position = square_root(x[i] * x[i] + y[i] * y[i]) * per_length;
        ring[i] = static_cast<std::int32_t>(position < rings ? position : rings);
    }
}

}  // namespace

void RadialDensity::sample(const MFrameView& view) {
    counts_.add_weight();
    ring_.resize(view.size());
    rings_of(view.size(), static_cast<double>(rings()), container_radius_, view.x.data(),
             view.y.data(), ring_.data());
    for (const std::int32_t ring : ring_) counts_.add(static_cast<std::size_t>(ring));
}

}  // namespace swirl
