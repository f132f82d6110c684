// Runs a scene with a contact law of your own (contact_law.hpp):
//
//     scene.law = swirl::own_law(Softening{.a = 0.2});
//     swirl::Simulation simulation(scene);
//
// Your program compiles the event loop with the law in it, in one search for discs and one for
// spheres. A law that returns the constants of the scene gives the built-in trajectory, bit by bit.
// If SWIRL_INTERNAL_CHECKS is defined in the file that includes this header, the loop for discs
// checks the invariants of every collision (invariant.hpp), and stops the program in the function
// of the invariant that does not hold.
#pragma once

#include <memory>
#include <utility>

#include "swirl/engine/event_loop.hpp"
#include "swirl/engine/neighbors/many_spheres.hpp"
#include "swirl/engine/neighbors/verlet_lists.hpp"
#include "swirl/math/cpu_width.hpp"
#include "swirl/physics/contact_law.hpp"
#include "swirl/physics/initial_state.hpp"

namespace swirl {
inline namespace SWIRL_TARGET {

/// A search whose bodies collide by the law that EngineState::law points to.
template <NeighborSearch Search, ContactLaw Law>
struct WithLaw : Search {
    struct Bodies : Search::Bodies {
        using Body = typename Search::Bodies::Body;

        SWIRL_INLINE static Surface surface_of(const EngineState& state, const Surface& surface,
                                               const Contact<Body>& contact) {
            const Vec2 centre = state.segments[state.segment].flight_at(contact.t).position;
            Impact impact = impact_of(contact.i, contact.j, contact.separation);
            impact.from_centre_i = contact.at_i - centre;
            if (!impact.is_with_wall) impact.from_centre_j = contact.at_j - centre;
            impact.container_radius = state.container_radius;
            return (*static_cast<const Law*>(state.law))(surface, impact);
        }
    };
};

/// A law may say that it is for discs only, `static constexpr bool is_for_discs_only = true`. Its
/// loop for spheres is then not compiled.
template <class Law>
constexpr bool is_for_spheres() {
    if constexpr (requires { Law::is_for_discs_only; }) return !Law::is_for_discs_only;
    return true;
}
template <ContactLaw Law>
constexpr EventLoop loop_for_spheres() {
    if constexpr (is_for_spheres<Law>())
        return event_loop<WithLaw<ManySpheres, Law>>(baseline_name);
    return {};
}

/// The loops of the law. There are no other searches, because each costs seconds of compilation.
template <ContactLaw Law>
inline constexpr EventLoops loops_with_law = {
    .lists = event_loop<WithLaw<VerletLists, Law>>(baseline_name),
    .cells = {},
    .all_pairs = {},
    .all_pairs_up_to_packing = {},
    .few_spheres = {},
    .many_spheres = loop_for_spheres<Law>()};

}  // namespace SWIRL_TARGET

/// The law for InitialState::law.
template <ContactLaw Law>
OwnLaw own_law(Law law) {
    return {.law = std::make_shared<const Law>(std::move(law)),
            .surface_of = [](const void* object, const Surface& surface, const Impact& impact)
                -> Surface { return (*static_cast<const Law*>(object))(surface, impact); },
            .loops = &loops_with_law<Law>};
}

}  // namespace swirl
