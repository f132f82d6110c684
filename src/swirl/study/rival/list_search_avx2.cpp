#include "swirl/study/rival/list_search.hpp"

namespace swirl {
FirstMeeting list_search_avx2(const ListedDisc* discs, std::uint32_t i, const std::uint32_t* list,
                              std::uint32_t nobody) {
    return find_first_on_list(discs, i, list, nobody);
}
}  // namespace swirl
