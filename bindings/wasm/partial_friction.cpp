// The page has no event loops for discs that lack friction in some contacts with each other.
// laboratory.cpp rejects such runs.
#include "swirl/engine/neighbors/engine_state.hpp"

namespace swirl {
const EventLoops event_loops_partial_friction{};
}  // namespace swirl
