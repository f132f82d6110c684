#include "simulation/event_loop.hpp"

namespace swirl {
const EventLoop event_loop_avx2{"avx2", start, step, run};
}  // namespace swirl
