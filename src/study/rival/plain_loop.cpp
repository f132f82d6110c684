#include "swirl/study/rival/plain_loop.hpp"

namespace swirl {

PlainSearch plain_search(Width width) {
    width = width_meant(width);
#if defined(__x86_64__)
    if (width == Width::avx512) return plain_search_avx512;
    if (width == Width::avx2) return plain_search_avx2;
#endif
    return plain_search_baseline;
}

}  // namespace swirl
