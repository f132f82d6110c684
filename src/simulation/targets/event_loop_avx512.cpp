#include "swirl/simulation/targets/event_loops.hpp"

namespace swirl {
const EventLoops event_loops_avx512 = event_loops("avx512", 40);
}  // namespace swirl
