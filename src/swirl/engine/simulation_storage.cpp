#include "swirl/engine/simulation_storage.hpp"

#include <array>
#include <limits>
#include <map>
#include <type_traits>

#include "swirl/engine/neighbors/search_setup.hpp"

namespace swirl {
namespace {

const EventLoops& event_loops([[maybe_unused]] Width width) {
#if defined(SWIRL_HAS_AVX512)
    if (width == Width::avx512) return event_loops_avx512;
#endif
#if defined(SWIRL_HAS_AVX2)
    if (width == Width::avx2) return event_loops_avx2;
#endif
    return event_loops_baseline;
}

const EventLoops& event_loops(const InitialState& scene, Width width) {
    return scene.law ? *scene.law.loops : event_loops(width_meant(width));
}

/// The method that suits the scene, if there is a loop for it; otherwise the one that always
/// exists.
SearchMethod method_of(const InitialState& scene, const RadiusRange& radii, const Tuning& tuning,
                       const EventLoops& loops) {
    const SearchMethod method = choose_search(scene, radii, tuning, loops);
    if (are_spheres(scene))
        return loops.few_spheres[0].run == nullptr ? SearchMethod::cells : method;
    return method == SearchMethod::cells && loops.cells.run == nullptr ? SearchMethod::lists
                                                                       : method;
}

}  // namespace

Simulation::Storage::Storage(const InitialState& scene, const Progress& progress,
                             const Tuning& tuning, const Storage* previous)
    : width(tuning.width),
      law(scene.law),
      segments(scene.path.segments),
      memory(tuning.is_stopped) {
    if (previous != nullptr)
        replace_search(scene, progress, tuning, *previous);
    else
        begin_search(scene, progress, tuning);
    if (!stopped()) loop->start(*state);
    if (stopped()) {
        state->size = 0;
        state->should_switch_search = false;
    }
    state->is_stopped = nullptr;
}

/// Makes `search` hold a `State` and fills what it shares with other searches (EngineState).
template <class State>
State& Simulation::Storage::begin(const InitialState& scene, const Progress& progress,
                                  const Tuning& tuning, const EventLoop& event_loop,
                                  std::uint32_t list_capacity) {
    loop = &event_loop;
    State& begun = search.emplace<State>();
    state = &begun;
    state->size = static_cast<std::uint32_t>(scene.discs.size());
    state->cold_bytes = static_cast<std::uint32_t>(sizeof(ColdDisc)) + 4 * list_capacity;
    state->segments = segments.data();
    state->segment_count = static_cast<std::uint32_t>(segments.size());
    state->segment = progress.segment;
    state->period = scene.path.period;
    state->container_radius = scene.container_radius;
    state->disc_surface = scene.disc_surface;
    state->wall_surface = scene.wall_surface;
    state->law = law.law.get();
    state->floor = scene.floor;
    // Discs in columns are all predicted for the wall at once, so a wide horizon pays.
    state->horizons_per_turn = std::is_same_v<State, AllPairsState> ? 6.0 : 30.0;
    state->periods = progress.periods;
    state->clock = progress.clock;
    state->disc_disc = progress.events.disc_disc;
    state->disc_wall = progress.events.disc_wall;
    state->path_vertex = progress.events.path_vertex;
    state->elastic_by_tc = progress.events.elastic_by_tc;
    state->begun_to_roll = progress.events.begins_to_roll;
    if (tuning.is_stopped) {
        state->caller = &tuning.is_stopped;
        state->is_stopped = [](const void* caller) {
            return (*static_cast<const std::function<bool()>*>(caller))();
        };
    }
    add_discs(scene);
    if (are_spheres(scene)) add_spheres(scene);
    return begun;
}

void Simulation::Storage::begin_search(const InitialState& scene, const Progress& progress,
                                       const Tuning& tuning) {
    const EventLoops& loops = event_loops(scene, tuning.width);
    const RadiusRange radii = radii_of(scene);
    const std::size_t last = scene.discs.size() - 1;
    const SearchMethod method = method_of(scene, radii, tuning, loops);
    if (are_spheres(scene)) {
        if (method == SearchMethod::all_pairs)
            return set_up(
                begin<FewSpheresState>(scene, progress, tuning, loops.few_spheres[last / 16]));
        return set_up(begin<ManySpheresState>(scene, progress, tuning, loops.many_spheres), radii,
                      memory);
    }
    if (method == SearchMethod::all_pairs)
        return set_up(begin<AllPairsState>(scene, progress, tuning, loops.all_pairs[last / 8]));
    if (method == SearchMethod::cells) {
        auto& cells = begin<LinkedCellsState>(scene, progress, tuning, loops.cells);
        cells.chooses_search = tuning.search == SearchMethod::best;
        return set_up(cells, scene, radii, cell_widths(scene, radii), memory);
    }
    const std::uint32_t capacity = list_capacity(scene, radii);
    auto& lists = begin<VerletListsState>(scene, progress, tuning, loops.lists, capacity);
    lists.list_capacity = capacity;
    set_up(lists, scene, radii, tuning.cells_per_side, species.size(), memory);
}

/// Lists are replaced by cells as wide as the last ones; cells by lists or by cells of another
/// width.
void Simulation::Storage::replace_search(const InitialState& scene, const Progress& progress,
                                         const Tuning& tuning, const Storage& previous) {
    const EventLoops& loops = event_loops(scene, tuning.width);
    const RadiusRange radii = radii_of(scene);
    const auto take_over = [&](ListsOrCellsState& next, const ListsOrCellsState& last) {
        next.chooses_search = last.chooses_search;
        next.failed_lists = last.failed_lists;
        next.target_cell_width = last.target_cell_width;
        next.max_cell_width = last.max_cell_width;
    };
    const auto* last_cells = std::get_if<LinkedCellsState>(&previous.search);
    if (last_cells != nullptr && last_cells->target_cell_width == 0.0) {
        const std::uint32_t capacity = list_capacity(scene, radii);
        auto& lists = begin<VerletListsState>(scene, progress, tuning, loops.lists, capacity);
        lists.list_capacity = capacity;
        take_over(lists, *last_cells);
        lists.target_cell_width = last_cells->grid.width();
        return set_up(lists, scene, radii, tuning.cells_per_side, species.size(), memory);
    }
    const auto& last = static_cast<const ListsOrCellsState&>(*previous.state);
    auto& cells = begin<LinkedCellsState>(scene, progress, tuning, loops.cells);
    take_over(cells, last);
    CellWidths widths = cell_widths(scene, radii);
    widths.target = last.target_cell_width;
    widths.maximum = last.max_cell_width;
    set_up(cells, scene, radii, widths, memory);
}

void Simulation::Storage::add_discs(const InitialState& scene) {
    const std::size_t size = scene.discs.size();
    state->discs = memory.add<HotDisc>(size + 1);
    state->cold_discs = memory.add<unsigned char>((size + 1) * state->cold_bytes);
    std::map<std::array<double, 4>, std::uint32_t> species_of;
    for (std::uint32_t i = 0; i < size && !state->stops_at(i); ++i) {
        const Disc& d = scene.discs[i];
        const auto [entry, is_new] = species_of.try_emplace(
            {d.radius, d.mass, d.inertia, d.can_spin}, static_cast<std::uint32_t>(species.size()));
        if (is_new)
            species.push_back(
                {.radius = d.radius,
                 .mass = d.mass,
                 .inertia = d.inertia,
                 .inverse_mass = 1.0 / d.mass,
                 .inverse_inertia = are_spheres(scene) ? 1.0 / d.inertia : d.inverse_inertia(),
                 .can_spin = d.can_spin});
        state->discs[i] = {.position = d.position,
                           .velocity = d.velocity,
                           .time = d.time,
                           .radius = d.radius,
                           .spin = d.spin,
                           .collisions = 0,
                           .species = entry->second & 0xffffffu,
                           .list_length = 0,
                           .far_from_wall = 0};
        state->cold(i).angle = d.angle;
    }
    state->species = species.data();
    const double nowhere = std::numeric_limits<double>::quiet_NaN();
    state->discs[size] = {{nowhere, nowhere}, {0.0, 0.0}, 0.0, 0.0, 0.0, 0, 0, 0, 0};
}

void Simulation::Storage::add_spheres(const InitialState& scene) {
    state->spheres = memory.add<SphereState>(scene.discs.size());
    const Vec2 floor_velocity = segments[state->segment].velocity;
    for (std::uint32_t i = 0; i < state->size && !state->stops_at(i); ++i) {
        const Disc& d = scene.discs[i];
        state->spheres[i] = {floor_motion(d, scene.floor, floor_velocity), d.rolling_spin,
                             d.last_collision};
    }
}

void Simulation::Storage::allocate_copies() {
    const bool has_columns = std::holds_alternative<AllPairsState>(search) ||
                             std::holds_alternative<FewSpheresState>(search);
    if (has_columns || state->size == 0) return;
    const std::size_t size = state->size, columns = state->spheres != nullptr ? 7 : 5;
    copies.resize(columns * size);
    double* const first = copies.data();
    const auto column = [&](std::size_t k) { return first + k * size; };
    state->copies = {.x = first,
                     .y = column(1),
                     .vx = column(2),
                     .vy = column(3),
                     .time = column(4),
                     .ax = columns == 7 ? column(5) : nullptr,
                     .ay = columns == 7 ? column(6) : nullptr,
                     .events = std::numeric_limits<std::uint64_t>::max()};
}

Progress Simulation::Storage::progress() const {
    return {.periods = state->periods,
            .clock = state->clock,
            .segment = state->segment,
            .events = {.disc_disc = state->disc_disc,
                       .disc_wall = state->disc_wall,
                       .path_vertex = state->path_vertex,
                       .elastic_by_tc = state->elastic_by_tc,
                       .begins_to_roll = state->begun_to_roll}};
}

Disc Simulation::Storage::disc(std::uint32_t i) const {
    const HotDisc& d = state->discs[i];
    const Species& s = species[d.species];
    Disc disc{.position = d.position,
              .velocity = d.velocity,
              .angle = state->cold(i).angle,
              .spin = d.spin,
              .time = d.time,
              .radius = s.radius,
              .mass = s.mass,
              .inertia = s.inertia,
              .can_spin = s.can_spin};
    if (state->spheres != nullptr) {
        disc.rolling_spin = state->spheres[i].rolling_spin;
        disc.last_collision = state->spheres[i].last_collision;
    }
    return disc;
}

InitialState Simulation::Storage::current_scene() const {
    InitialState scene{.path = {state->period, segments},
                       .container_radius = state->container_radius,
                       .disc_surface = state->disc_surface,
                       .wall_surface = state->wall_surface,
                       .law = law};
    scene.discs.reserve(state->size);
    for (std::uint32_t i = 0; i < state->size; ++i) scene.discs.push_back(disc(i));
    return scene;
}

}  // namespace swirl
