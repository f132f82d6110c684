#include "swirl/measure/angular_profile.hpp"

#include <algorithm>

#include "swirl/math/wide.hpp"

namespace swirl {
namespace {

/// ϖ_M,i, the rate of the wall's nearest point, and the slice, of every disc.
///
/// Relative to the container the wall does not move, so relative to the centre of mass it has the
/// velocity −u_cm. The rotation of the frame subtracts Ω, exactly as for ϖ_i.
SWIRL_WIDE void rates_of(std::size_t n, double R, double omega, double slices,
                         const CentreOfMass& centre_of_mass, const double* __restrict x,
                         const double* __restrict y, const double* __restrict ux,
                         const double* __restrict uy, double* __restrict own,
                         double* __restrict wall, double* __restrict slice) {
    const CentreOfMass c = centre_of_mass;
    const double per_omega = 1.0 / omega, per_radian = slices / (2.0 * pi);
    for (std::size_t i = 0; i < n; ++i) {
        const double square = x[i] * x[i] + y[i] * y[i];
        // A disc at C has no θ; turns_of puts it at 0, and so does this.
        const double scale = R / square_root(square > 0.0 ? square : 1.0);
        const double ax = (square > 0.0 ? scale * x[i] : R) - c.position.x;
        const double ay = scale * y[i] - c.position.y;
        own[i] = c.varpi({x[i], y[i]}, {ux[i], uy[i]}) * per_omega - 1.0;
        wall[i] = (ay * c.velocity.x - ax * c.velocity.y) / (ax * ax + ay * ay) * per_omega - 1.0;
        const double theta = 2.0 * pi * turns_of({x[i], y[i]});
        slice[i] = theta * per_radian;
    }
}

}  // namespace

void AngularProfile::sample(const MFrameView& view) {
    const std::size_t n = view.size();
    for (auto* column : {&own_, &wall_, &slice_}) column->resize(n);
    const CentreOfMass centre = view.centre_of_mass();
    rates_of(n, view.container_radius, view.frame.omega, static_cast<double>(slices()), centre,
             view.x.data(), view.y.data(), view.ux.data(), view.uy.data(), own_.data(),
             wall_.data(), slice_.data());
    for (std::size_t i = 0; i < n; ++i) {
        if (!(own_[i] == own_[i])) continue;
        const std::size_t slice = std::min(static_cast<std::size_t>(slice_[i]), slices() - 1);
        const Vec2 d = view.position(i) - centre.position;
        const double square = dot(d, d);
        if (square < view.radius[i] * view.radius[i]) continue;
        const Vec2 v =
            view.relative_velocity(i) - centre.velocity - view.frame.omega * perpendicular(d);
        cells_.add(slice, {own_[i], wall_[i], square_root(square), square_root(dot(v, v))});
    }
}

}  // namespace swirl
