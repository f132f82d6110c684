// Speed only; results stay bitwise identical. A grid of cells that holds discs by the centres of
// their skins. Verlet lists and the search for many spheres find neighbours in it. `state` is
// theirs.
#pragma once

#include "swirl/engine/neighbors/search_states.hpp"
#include "swirl/math/lanes.hpp"

namespace swirl {
inline namespace SWIRL_TARGET {

template <class State>
SWIRL_INLINE void enter_cell(State& state, const DiscGrid& grid, std::uint32_t i) {
    Skin& mine = state.skins[i];
    const std::uint32_t number = grid.cell_at(mine.X, mine.Y);
    if (grid.cells != nullptr && grid.cells[number].count < Cell::capacity) {
        Cell& cell = grid.cells[number];
        cell.disc[cell.count++] = i;
        return;
    }
    std::uint32_t& head = grid.heads[number];
    mine.next_in_cell = head;
    head = i;
}

/// Removes disc i from a Cell. Returns false if it is not there.
SWIRL_INLINE bool remove_from_cell(const DiscGrid& grid, std::uint32_t number, std::uint32_t i) {
    if (grid.cells == nullptr) return false;
    Cell& cell = grid.cells[number];
    // The eighth number is the count; numbers from index `count` on are outdated.
    const std::uint32_t slot = index_in_list(cell.disc, 8, i);
    if (slot >= cell.count || cell.disc[slot] != i) return false;
    cell.disc[slot] = cell.disc[--cell.count];
    return true;
}
/// Must be called before the skin of disc i moves.
template <class State>
SWIRL_INLINE void leave_cell(State& state, const DiscGrid& grid, std::uint32_t i) {
    const std::uint32_t number = grid.cell_at(state.skins[i].X, state.skins[i].Y);
    if (remove_from_cell(grid, number, i)) return;
    std::uint32_t* link = &grid.heads[number];
    while (*link != i) link = &state.skins[*link].next_in_cell;
    *link = state.skins[i].next_in_cell;
}

SWIRL_INLINE void empty_cells(const EngineState& state, const DiscGrid& grid) {
    for (std::uint32_t c = 0; c < grid.cell_count(); ++c) grid.heads[c] = state.size;
    if (grid.cells == nullptr) return;
    for (std::uint32_t c = 0; c < grid.cell_count(); ++c) grid.cells[c].count = 0;
}

}  // namespace SWIRL_TARGET
}  // namespace swirl
