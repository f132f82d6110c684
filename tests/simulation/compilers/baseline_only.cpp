// The wide loops, left out to build fast: nothing here may run them.
#include "simulation/machine.hpp"

namespace swirl {
const EventLoop event_loop_avx2{};
const EventLoop event_loop_avx512{};
}  // namespace swirl
