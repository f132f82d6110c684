#include "swirl/engine/simd/event_loops.hpp"

namespace swirl {
const EventLoops event_loops_avx2 = event_loops<true>("avx2", {{never, never, never, 0.49, 0.40}});
}  // namespace swirl
