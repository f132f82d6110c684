#include "swirl/simulation/targets/event_loops.hpp"

namespace swirl {
const EventLoops event_loops_baseline = event_loops("baseline", 32);
}  // namespace swirl
