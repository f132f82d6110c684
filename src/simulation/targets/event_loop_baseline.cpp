#include "swirl/math/cpu_width.hpp"
#include "swirl/simulation/targets/event_loops.hpp"

namespace swirl {
const EventLoops event_loops_baseline = event_loops<32>(baseline_name);
}  // namespace swirl
