#include "simulation/reference_loop.hpp"

namespace swirl {

SoonestMeeting soonest_meeting(Width width) {
#if defined(__x86_64__)
    const bool best = width == Width::best;
    if (width == Width::avx512 || (best && has_width(Width::avx512))) return soonest_meeting_avx512;
    if (width == Width::avx2 || (best && has_width(Width::avx2))) return soonest_meeting_avx2;
#endif
    return soonest_meeting_baseline;
}

}  // namespace swirl
