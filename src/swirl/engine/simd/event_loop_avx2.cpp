#include "swirl/engine/simd/event_loops.hpp"

namespace swirl {
const EventLoops event_loops_avx2 = event_loops<40>("avx2");
}  // namespace swirl
