// The wide loops, left out to build fast: nothing here may run them.
#include "swirl/engine/neighbors/engine_state.hpp"

namespace swirl {
const EventLoops event_loops_avx2{};
const EventLoops event_loops_avx512{};
}  // namespace swirl
