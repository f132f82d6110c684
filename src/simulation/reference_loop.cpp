#include "swirl/simulation/reference_loop.hpp"

namespace swirl {

SoonestMeeting soonest_meeting(Width width) {
    width = width_meant(width);
#if defined(__x86_64__)
    if (width == Width::avx512) return soonest_meeting_avx512;
    if (width == Width::avx2) return soonest_meeting_avx2;
#endif
    return soonest_meeting_baseline;
}

}  // namespace swirl
