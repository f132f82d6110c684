#include "swirl/physics/partial_friction.hpp"

#include "swirl/engine/own_law.hpp"
#include "swirl/engine/partial_friction.hpp"

namespace swirl {

OwnLaw without_friction_in(Frictionless contacts) {
    if (contacts != Frictionless::boundary && contacts != Frictionless::bulk) return {};
    return own_law(PartialFriction{contacts});
}

}  // namespace swirl
