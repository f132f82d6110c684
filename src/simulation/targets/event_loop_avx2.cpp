#include "swirl/simulation/targets/event_loops.hpp"

namespace swirl {
const EventLoops event_loops_avx2 = event_loops("avx2", 40);
}  // namespace swirl
