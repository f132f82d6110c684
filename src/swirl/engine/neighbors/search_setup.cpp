#include "swirl/engine/neighbors/search_setup.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "swirl/math/real.hpp"

namespace swirl {
namespace {

constexpr double nowhere = std::numeric_limits<double>::quiet_NaN();

void set_up_queue(EventQueue& queue, std::uint32_t size, AlignedMemory& memory) {
    // Prefetching pays when the discs no longer fit into the nearest cache.
    constexpr std::uint32_t min_discs_to_prefetch = 4001;
    queue.prefetches = size >= min_discs_to_prefetch;
    std::size_t entries = size;
    do {
        std::size_t padded = (entries + 7) / 8 * 8;
        // The top level has one row or an even number of rows (EventQueue::top_rows).
        if (padded > 8 && padded <= 8 * max_top_rows) padded = (padded + 15) / 16 * 16;
        queue.level_times[queue.levels] = memory.add<double>(padded);
        if (queue.levels > 0) queue.level_winners[queue.levels] = memory.add<std::uint32_t>(padded);
        ++queue.levels;
        entries = padded / 8;
    } while (entries > max_top_rows);
    queue.top_rows = static_cast<std::uint32_t>(entries);
    // Rows that only pad the top level never win.
    std::fill_n(queue.level_times[queue.levels - 1], 8 * entries, never);
}

/// Sets the geometry of a grid whose cells are at least `min_width` wide; returns their width.
double set_geometry(CellGrid& grid, double min_width, double side) {
    grid.cells_per_side = static_cast<std::uint32_t>(
        larger(1.0, smaller(side / min_width, double{max_cells_per_side})));
    grid.cells_per_length = grid.cells_per_side / side;
    grid.corner = -0.5 * side;
    return side / grid.cells_per_side;
}

// ---- Verlet lists

/// Capacity for the largest number of small discs that can touch a large one at once. For a ratio q
/// of the radii it is π / asin(1/(1 + q)), plus half as much for discs that are merely near. Ratios
/// above 10⁶ count as 10⁶.
std::uint32_t capacity_for(double ratio) {
    const double contacts = pi / std::asin(1.0 / (1.0 + smaller(ratio, 1e6)));
    const auto needed = static_cast<std::uint32_t>(1.5 * contacts) + 3;
    return (needed + 3) / 4 * 4;
}

/// Discs up to this many times as large as the smallest have no tail.
constexpr double ratio_without_tail = 4.0;

/// Target for the number of discs nearer than twice a disc's skin radius. A list of equal discs
/// then fits in one vector, and that of a larger disc holds a layer around it. Later insertions may
/// make the list longer.
std::uint32_t target_length(double ratio) {
    return 7 + static_cast<std::uint32_t>(pi * (smaller(ratio, 1e6) - 1.0));
}

/// Capacity for the discs around one whose list is rebuilt. If there are more, the search for them
/// is repeated within a smaller distance.
constexpr std::uint32_t min_candidates = 512;

/// How often the radius can be halved without falling below the smallest. Each such class of sizes
/// has one grid.
std::uint32_t size_class(double radius, double smallest) {
    std::uint32_t halvings = 0;
    for (; radius >= 2.0 * smallest && halvings + 1 < max_grids; radius *= 0.5) ++halvings;
    return halvings;
}

void add_contents(DiscGrid& grid, const VerletListsState& state, AlignedMemory& memory) {
    constexpr std::uint32_t too_many_for_cells = 200000;  // linked lists alone take less memory
    if (state.grid_count == 1 && state.size < too_many_for_cells)
        grid.cells = memory.add<Cell>(grid.cell_count());
    grid.heads = memory.add<std::uint32_t>(grid.cell_count());
}

/// Width of the cells for equal discs, or for the smallest class of sizes. On average the area of a
/// cell holds three discs. Skins of discs in cells that do not touch must never overlap. That is,
/// |X_i − X_k| < 2 (largest radius + largest skin radius) = the width.
double list_cell_width(double area, std::uint32_t size, double largest_radius) {
    // The discs of a dilute system may gather. Cells wider than for seven discs would overflow
    // there.
    const double for_one = square_root(area / size), for_seven = 4.4 * largest_radius;
    const double width = smaller(square_root(3.0) * for_one, larger(for_seven, for_one));
    return larger(2.6 * largest_radius, width);
}

/// One grid for discs of about one size. If sizes differ more, each class of sizes has its own
/// grid, and skins are no larger than with cells for the smallest. With few discs there is no grid.
void set_up_grids(VerletListsState& state, const InitialState& scene, const RadiusRange& radii,
                  int cells_per_side, std::size_t species_count, AlignedMemory& memory) {
    constexpr std::uint32_t max_without_grid = 100;
    const double R = scene.container_radius, side = 2.0 * R, area = pi * R * R;
    state.has_no_grid = cells_per_side == 1 ? state.size <= min_candidates
                                            : cells_per_side == 0 && state.size <= max_without_grid;
    state.grid_count = 1;
    state.grids[0].largest_radius = radii.largest;
    if (state.has_no_grid) {
        state.largest_skin_radius = 4.0 * side;  // unlimited
        return;
    }

    std::array<double, max_grids> largest{}, smallest{};
    smallest.fill(never);
    std::array<std::size_t, max_grids> discs{};
    for (std::uint32_t i = 0; i < state.size && !state.stops_at(i); ++i) {
        const Disc& d = scene.discs[i];
        const std::uint32_t size = size_class(d.radius, radii.smallest);
        largest[size] = larger(largest[size], d.radius);
        smallest[size] = smaller(smallest[size], d.radius);
        ++discs[size];
    }
    std::array<std::uint32_t, max_grids> index{};
    state.grid_count = 0;
    for (std::uint32_t size = 0; size < max_grids; ++size) {
        index[size] = state.grid_count;
        if (discs[size] == 0) continue;
        DiscGrid& grid = state.grids[state.grid_count++];
        grid.largest_radius = largest[size];
        grid.equal_radii = smallest[size] == largest[size];
    }
    for (std::size_t k = 0; k < species_count; ++k)
        state.species_lists[k].grid = index[size_class(state.species[k].radius, radii.smallest)];

    double width = list_cell_width(area, state.size, largest[0]);
    if (cells_per_side > 0) width = side / cells_per_side;
    width = set_geometry(state.grids[0], larger(width, 2.1 * largest[0]), side);
    add_contents(state.grids[0], state, memory);
    // Slightly less than the cells allow, for the rounding of positions into cells. Each of several
    // grids is searched as far as the largest skin may reach, but most skins are smaller.
    constexpr double fraction_with_several_grids = 0.75;
    state.largest_skin_radius = (0.5 * width - largest[0]) * (1.0 - 1e-6);
    if (state.grid_count > 1) state.largest_skin_radius *= fraction_with_several_grids;
    for (std::uint32_t size = 1; size < max_grids; ++size) {
        if (discs[size] == 0) continue;
        DiscGrid& grid = state.grids[index[size]];
        const double for_three = square_root(3.0 * area / static_cast<double>(discs[size]));
        const double for_skins = 2.0 * (largest[size] + state.largest_skin_radius);
        set_geometry(grid, larger(for_skins, for_three), side);
        add_contents(grid, state, memory);
    }
}

void set_up_candidates(CandidateColumns& candidates, std::uint32_t longest_list,
                       AlignedMemory& memory) {
    candidates.capacity = std::max(min_candidates, (2 * longest_list + 7) / 8 * 8);
    // Eight sentinels follow the last candidate.
    candidates.gap = memory.add<double>(candidates.capacity + 8);
    candidates.reach = memory.add<double>(candidates.capacity + 8);
    candidates.X = memory.add<float>(candidates.capacity);
    candidates.Y = memory.add<float>(candidates.capacity);
    candidates.disc = memory.add<std::uint32_t>(candidates.capacity + 8);
    candidates.chosen = memory.add<std::uint32_t>(candidates.capacity);
    candidates.rebuilt = memory.add<std::uint32_t>(candidates.capacity);
}

/// Storage for the lists of discs that are much larger than others: enough for all discs that fit
/// around them.
void set_up_lists(VerletListsState& state, const InitialState& scene, const RadiusRange& radii,
                  std::size_t species_count, AlignedMemory& memory) {
    std::map<double, std::uint32_t> smaller_than;  // number of smaller discs, by radius
    for (std::uint32_t i = 0; i < state.size && !state.stops_at(i); ++i)
        ++smaller_than[scene.discs[i].radius];
    std::uint32_t counted = 0;
    for (auto& [radius, count] : smaller_than) count = std::exchange(counted, counted + count);
    const auto max_length = [&](double radius) {
        const auto larger_one = smaller_than.lower_bound(radius / ratio_without_tail);
        const std::uint32_t smaller_ones =
            larger_one == smaller_than.end() ? state.size : larger_one->second;
        return std::min(capacity_for(radius / radii.smallest),
                        capacity_for(ratio_without_tail) + smaller_ones);
    };
    for (std::size_t k = 0; k < species_count; ++k)
        state.species_lists[k].target_length =
            target_length(state.species[k].radius / radii.smallest);

    const std::uint32_t longest = max_length(radii.largest);
    set_up_candidates(state.candidates, longest, memory);
    if (longest <= state.list_capacity) return;
    const auto tail_capacity = [&](std::uint32_t i) {
        const std::uint32_t length = max_length(scene.discs[i].radius);
        return length <= state.list_capacity ? 0 : (length - state.list_capacity + 7) / 8 * 8;
    };
    constexpr std::uint32_t entries = sizeof(ListTail) / sizeof(std::uint32_t);
    state.tail_index = memory.add<std::uint32_t>(state.size);
    std::uint32_t end = 1;
    for (std::uint32_t i = 0; i < state.size && !state.stops_at(i); ++i) {
        if (tail_capacity(i) == 0) continue;
        state.tail_index[i] = end;
        end += 1 + tail_capacity(i) / entries;
    }
    state.tails = memory.add<ListTail>(end);
    if (state.stops_at(0)) return;
    for (std::uint32_t i = 0; i < state.size; ++i)
        if (state.tail_index[i] != 0) state.tail(i).capacity = tail_capacity(i);
}

// ---- Linked cells

/// Capacity of each cell's overflow bucket. Small discs among large ones may fill cells. If they
/// are spread evenly, one cell in a million may overflow the bucket. In a moving container discs
/// gather, and where cells overflow lists are faster, so there are no buckets.
std::uint32_t overflow_capacity(const InitialState& scene, double width) {
    const double mean = discs_per_cell(scene, width);
    const double overflow = mean + 6.0 * square_root(mean) - Cell::capacity;
    if (overflow <= 0.0 || !container_rests(scene)) return 0;
    return static_cast<std::uint32_t>(smaller(overflow / 8.0, max_overflow_capacity / 8 - 1.0)) *
               8 +
           8;
}

}  // namespace

std::uint32_t list_capacity(const InitialState& scene, const RadiusRange& radii) {
    // In a container this large against its discs skins cannot be narrow (verlet_lists.hpp), so
    // lists have the largest capacity that HotDisc::list_length can count.
    constexpr double too_large_for_narrow_skins = 2e5;
    constexpr std::uint32_t max_capacity = 124;
    if (scene.container_radius > too_large_for_narrow_skins * radii.smallest) return max_capacity;
    return capacity_for(smaller(radii.largest / radii.smallest, ratio_without_tail));
}

void set_up(AllPairsState& state) {
    DiscColumns& columns = state.columns;
    for (std::uint32_t k = 0; k < DiscColumns::maximum; ++k) {
        const bool exists = k < state.size;
        columns.x[k] = columns.y[k] = exists ? 0.0 : nowhere;
        columns.radius[k] = exists ? state.discs[k].radius : 0.0;
        columns.padding[k] = exists ? 0.0 : never;
        columns.contact[k] = columns.wall[k] = never;
    }
}

void set_up(FewSpheresState& state) {
    SphereColumns& columns = state.columns;
    for (std::uint32_t k = 0; k < SphereColumns::maximum; ++k) {
        columns.x[k] = columns.y[k] = columns.X[k] = columns.Y[k] = nowhere;
        columns.radius[k] = k < state.size ? state.discs[k].radius : 0.0;
        columns.reach[k] = 0.0;
        columns.contact[k] = columns.wall[k] = columns.rolls[k] = columns.first[k] = never;
    }
}

void set_up(ManySpheresState& state, const RadiusRange& radii, AlignedMemory& memory) {
    set_up_queue(state.queue, state.size, memory);
    state.queue.prefetches = false;
    state.skins = memory.add<Skin>(state.size);
    // A cell holds three spheres on average, and it is no narrower than one sphere.
    const double R = state.container_radius;
    const double for_three = square_root(3.0 * pi * R * R / state.size);
    set_geometry(state.grid, larger(2.0 * radii.largest, for_three), 2.0 * R);
    state.grid.heads = memory.add<std::uint32_t>(state.grid.cell_count());
}

void set_up(VerletListsState& state, const InitialState& scene, const RadiusRange& radii,
            int cells_per_side, std::size_t species_count, AlignedMemory& memory) {
    set_up_queue(state.queue, state.size, memory);
    state.skins = memory.add<Skin>(state.size);
    state.smallest_radius = radii.smallest;
    state.equal_radii = radii.smallest == radii.largest;
    state.species_lists = memory.add<SpeciesLists>(species_count);
    if (state.stops_at(0)) return;
    set_up_grids(state, scene, radii, cells_per_side, species_count, memory);
    set_up_lists(state, scene, radii, species_count, memory);
}

/// The grid covers everything that the container reaches, seen from cells that move as fast as the
/// container does. Two more cells on each side ensure that a cell with discs has eight around it.
void set_up(LinkedCellsState& state, const InitialState& scene, const RadiusRange& radii,
            const CellWidths& widths, AlignedMemory& memory) {
    set_up_queue(state.queue, state.size, memory);
    state.positions = memory.add<CellPosition>(state.size);
    state.smallest_radius = radii.smallest;
    const PathExtent path = extent_of(scene.path);
    const double R = scene.container_radius;
    CellGrid& grid = state.grid;
    grid.cells_per_side = static_cast<std::uint32_t>(2.0 * (R + path.reach()) / widths.target) + 5;
    grid.cells_per_length = 1.0 / widths.target;
    grid.corner = -0.5 * widths.target * grid.cells_per_side;
    state.min_width = widths.minimum;
    state.max_cell_width = widths.maximum;
    state.path_middle = path.middle;
    state.max_drift = path.max_drift();
    const std::size_t cells = static_cast<std::size_t>(grid.cells_per_side) * grid.cells_per_side;
    state.cells = memory.add<Cell>(cells);
    state.overflow_capacity = overflow_capacity(scene, widths.target);
    state.overflows_of_cells = memory.add<std::uint32_t>(cells * state.overflow_capacity);
    // Half a cell's diagonal, and a margin for the rounding of its centre to single precision.
    state.reach_of_far_cells =
        (R - path.radius) * (1.0 - 1e-6) - radii.largest - 0.71 * widths.target;
    state.near_wall = memory.add<std::uint32_t>(state.size + 8);
    state.unassigned = memory.add<std::uint32_t>(state.size + 8);
}

}  // namespace swirl
