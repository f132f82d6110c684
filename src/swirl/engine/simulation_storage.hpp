// The data of a Simulation: its arrays, the state of its neighbour search, and the event loop for
// it.
#pragma once

#include <variant>
#include <vector>

#include "swirl/engine/aligned_memory.hpp"
#include "swirl/engine/neighbors/choose_search.hpp"
#include "swirl/engine/neighbors/search_states.hpp"
#include "swirl/engine/simulation.hpp"

namespace swirl {

struct Simulation::Storage {
    /// Starts with the search that `previous` asked to be replaced by, if it is not null; otherwise
    /// with the one that suits the scene. If `tuning.is_stopped` says so, there are no discs.
    Storage(const InitialState& scene, const Progress& progress, const Tuning& tuning,
            const Storage* previous = nullptr);
    // `state` points into the object itself.
    Storage(const Storage&) = delete;
    Storage& operator=(const Storage&) = delete;

    Progress progress() const;
    Disc disc(std::uint32_t i) const;
    /// A scene from which any search continues with bitwise identical results.
    InitialState current_scene() const;
    /// Provides EngineState::copies if the search has no columns.
    void add_copies() {
        if (state->copies.x == nullptr) allocate_copies();
    }

    const EventLoop* loop = nullptr;
    Width width;
    OwnLaw law;
    std::vector<Segment> segments;
    std::vector<Species> species;
    AlignedMemory memory;
    std::vector<double> copies;
    std::variant<AllPairsState, VerletListsState, LinkedCellsState, FewSpheresState,
                 ManySpheresState>
        search;
    EngineState* state = nullptr;  // the alternative that `search` holds

  private:
    template <class State>
    State& begin(const InitialState& scene, const Progress& progress, const Tuning& tuning,
                 const EventLoop& event_loop, std::uint32_t list_capacity = 0);
    void begin_search(const InitialState& scene, const Progress& progress, const Tuning& tuning);
    void replace_search(const InitialState& scene, const Progress& progress, const Tuning& tuning,
                        const Storage& previous);
    void add_discs(const InitialState& scene);
    void add_spheres(const InitialState& scene);
    void allocate_copies();
    bool stopped() const { return state->stops_at(0); }
};

}  // namespace swirl
