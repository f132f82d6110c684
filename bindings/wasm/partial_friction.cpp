// The page has no event loops without friction in some contacts; laboratory.cpp rejects these.
#include "swirl/engine/partial_friction.hpp"

namespace swirl {
OwnLaw without_friction_in(Frictionless) { return {}; }
}  // namespace swirl
