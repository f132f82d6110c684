#include "simulation/event_loop.hpp"

namespace swirl {
const EventLoop event_loop_baseline{"baseline", start, step, run};
}  // namespace swirl
