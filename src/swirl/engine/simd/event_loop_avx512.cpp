#include "swirl/engine/simd/event_loops.hpp"

namespace swirl {
const EventLoops event_loops_avx512 =
    event_loops<true>("avx512", {{never, never, never, 0.60, 0.55}});
}  // namespace swirl
