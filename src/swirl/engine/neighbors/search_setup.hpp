// Fills the state of each neighbour search before its first prediction. EngineState must be
// complete.
#pragma once

#include "swirl/engine/aligned_memory.hpp"
#include "swirl/engine/neighbors/choose_search.hpp"
#include "swirl/engine/neighbors/search_states.hpp"
#include "swirl/physics/initial_state.hpp"

namespace swirl {

/// The capacity of the list that each disc stores next to its other data (ColdDisc). Longer lists
/// continue in a tail.
std::uint32_t list_capacity(const InitialState& scene, const RadiusRange& radii);

void set_up(AllPairsState& state);
void set_up(FewSpheresState& state);
void set_up(ManySpheresState& state, const RadiusRange& radii, AlignedMemory& memory);
/// `cells_per_side` is that of Tuning. `species_count` is the number of EngineState::species.
void set_up(VerletListsState& state, const InitialState& scene, const RadiusRange& radii,
            int cells_per_side, std::size_t species_count, AlignedMemory& memory);
void set_up(LinkedCellsState& state, const InitialState& scene, const RadiusRange& radii,
            const CellWidths& widths, AlignedMemory& memory);

}  // namespace swirl
