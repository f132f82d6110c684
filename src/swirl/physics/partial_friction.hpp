// Discs that have no friction in some of their contacts with each other. Where a contact belongs
// depends only on the positions at the collision, so every search gives the same trajectory.
#pragma once

#include "swirl/physics/contact_law.hpp"
#include "swirl/physics/frictionless.hpp"

namespace swirl {

/// A contact law (contact_law.hpp). It has no rule for the wall: there a coefficient of 0 is the
/// same.
struct PartialFriction {
    static constexpr bool is_for_discs_only = true;
    Frictionless smooth;

    SWIRL_INLINE Surface operator()(Surface surface, const Impact& impact) const {
        if (impact.is_with_wall) return surface;
        const bool both_at_wall =
            is_at_wall(impact.from_centre_i, impact.radius_i, impact.container_radius) &&
            is_at_wall(impact.from_centre_j, impact.radius_j, impact.container_radius);
        if (smooth == (both_at_wall ? Frictionless::boundary : Frictionless::bulk))
            surface.mu = 0.0;
        return surface;
    }

    SWIRL_INLINE static bool is_at_wall(const Vec2& from_centre, double radius,
                                        double container_radius) {
        const double inner = container_radius - boundary_layer * radius;
        return !(inner > 0.0) || dot(from_centre, from_centre) > inner * inner;
    }
};

}  // namespace swirl
