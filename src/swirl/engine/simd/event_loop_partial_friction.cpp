#include "swirl/engine/simd/event_loops.hpp"
#include "swirl/math/cpu_width.hpp"

namespace swirl {
const EventLoops event_loops_partial_friction = event_loops_with_partial_friction(baseline_name);
}  // namespace swirl
