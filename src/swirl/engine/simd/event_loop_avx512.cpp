#include "swirl/engine/simd/event_loops.hpp"

namespace swirl {
const EventLoops event_loops_avx512 = event_loops<40>("avx512");
}  // namespace swirl
