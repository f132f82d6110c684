// Scenes whose discs have no friction in some of their contacts with each other.
#pragma once

#include "swirl/physics/frictionless.hpp"
#include "swirl/physics/initial_state.hpp"

namespace swirl {

/// The law for InitialState::law if the kind is boundary or bulk. Otherwise there is none: at the
/// wall, a friction coefficient of 0 is enough.
OwnLaw without_friction_in(Frictionless contacts);

}  // namespace swirl
