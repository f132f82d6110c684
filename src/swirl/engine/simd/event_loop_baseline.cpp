#include "swirl/engine/simd/event_loops.hpp"
#include "swirl/math/cpu_width.hpp"

namespace swirl {
const EventLoops event_loops_baseline = event_loops<32>(baseline_name);
}  // namespace swirl
