#include "baselines/list_search.hpp"

namespace swirl {
FirstContact list_search_baseline(const ListedDisc* discs, std::uint32_t i,
                                  const std::uint32_t* list, std::uint32_t no_disc) {
    return find_first_on_list(discs, i, list, no_disc);
}
}  // namespace swirl
