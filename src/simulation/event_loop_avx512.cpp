#include "simulation/event_loop.hpp"

namespace swirl {
const EventLoop event_loop_avx512{"avx512", start, step, run};
}  // namespace swirl
