#include "simulation/event_loop.hpp"

#include "simulation/all_pairs.hpp"

namespace swirl {
const EventLoops event_loops_avx512 = event_loops("avx512", 48);
}  // namespace swirl
