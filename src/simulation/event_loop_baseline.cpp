#include "simulation/event_loop.hpp"

#include "simulation/all_pairs.hpp"

namespace swirl {
const EventLoops event_loops_baseline = event_loops("baseline", 32);
}  // namespace swirl
