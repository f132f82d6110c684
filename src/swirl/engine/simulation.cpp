#include "swirl/engine/simulation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <map>
#include <new>
#include <utility>

#if defined(__linux__)
#include <sys/mman.h>
#endif

#include "swirl/engine/neighbors/engine_state.hpp"
#include "swirl/math/real.hpp"

namespace swirl {
namespace {

const EventLoops& event_loops(Width width) {
    width = width_meant(width);
#if defined(SWIRL_HAS_WIDE_VECTORS)
    if (width == Width::avx512) return event_loops_avx512;
    if (width == Width::avx2) return event_loops_avx2;
#endif
    return event_loops_baseline;
}

/// Memory for columns, aligned to cache lines; large ones to huge pages. Gigabytes of it take
/// seconds, so it asks between two pieces whether anybody still wants them; if not, what it gives
/// holds anything.
class AlignedMemory {
  public:
    explicit AlignedMemory(const std::function<bool()>& is_stopped) : is_stopped_(is_stopped) {}
    template <class T>
    T* add(std::size_t count) {
        const std::size_t bytes = (count * sizeof(T) + 63) / 64 * 64;
        const std::align_val_t alignment{bytes < huge_page ? 64 : huge_page};
        auto* block = static_cast<unsigned char*>(::operator new(bytes, alignment));
        blocks_.emplace_back(block, Free{alignment});
#if defined(__linux__)
        // The neighbours of a disc of 10⁶ lie on other pages, more of them than the processor knows
        // the addresses of, unless pages are large. A wish: refused, all goes on as before.
        if (bytes >= huge_page) madvise(block, bytes / huge_page * huge_page, MADV_HUGEPAGE);
#endif
        clear(block, bytes);
        bytes_ += bytes;
        return reinterpret_cast<T*>(block);
    }
    std::uint64_t bytes() const { return bytes_; }

  private:
    static constexpr std::size_t huge_page = std::size_t{1} << 21;
    void clear(unsigned char* block, std::size_t bytes) const {
        constexpr std::size_t piece = 32 * huge_page;
        for (std::size_t at = 0; at < bytes; at += piece) {
            if (bytes > piece && is_stopped_ && is_stopped_()) return;
            std::memset(block + at, 0, std::min(piece, bytes - at));
        }
    }
    struct Free {
        std::align_val_t alignment;
        void operator()(unsigned char* p) const { ::operator delete(p, alignment); }
    };
    const std::function<bool()>& is_stopped_;
    std::vector<std::unique_ptr<unsigned char, Free>> blocks_;
    std::uint64_t bytes_ = 0;
};

/// How many small discs can touch a large one at once, at most: π / asin(1/(1 + q)) for a ratio q
/// of the radii, and half as much again for those that are merely near.
std::uint32_t list_capacity(double ratio) {
    const double contacts = pi / std::asin(1.0 / (1.0 + smaller(ratio, 1e6)));
    const auto wanted = static_cast<std::uint32_t>(1.5 * contacts) + 3;
    return (wanted + 3) / 4 * 4;
}

/// In a dish so large against its discs skins cannot be narrow (verlet_lists.hpp), so their lists
/// have all the room that HotDisc::neighbours can count.
constexpr double container_too_wide_for_narrow_skins = 2e5;
constexpr std::uint32_t max_capacity = 124;

/// Discs this many times as large as the smallest keep their whole list with them.
constexpr double ratio_without_tail = 4.0;

/// Discs closer than twice a disc's skin radius, at most: so many that a list of equal discs fits
/// in one vector, and a layer around a larger one. Others may add themselves to its list.
std::uint32_t wanted_neighbours(double ratio) {
    return 7 + static_cast<std::uint32_t>(pi * (smaller(ratio, 1e6) - 1.0));
}

/// The discs around one are as many or fewer in most places; if not, they are looked for nearer.
constexpr std::uint32_t min_candidates = 512;

/// How often the radius can be halved and is not less than the smallest: of each such size one
/// grid.
std::uint32_t size_class(double radius, double smallest) {
    std::uint32_t halvings = 0;
    for (; radius >= 2.0 * smallest && halvings + 1 < max_grids; radius *= 0.5) ++halvings;
    return halvings;
}

struct Radii {
    double smallest, largest;
};
Radii radii_of(const InitialState& scene) {
    Radii radii{never, 0.0};
    for (const Disc& d : scene.discs) {
        radii.smallest = smaller(radii.smallest, d.radius);
        radii.largest = larger(radii.largest, d.radius);
    }
    return radii;
}

/// The square over which the container's centre moves: its middle, and half its diagonal.
struct PathExtent {
    Vec2 middle;
    double radius;

    /// As far as the container goes in half a swirl, if the path is round: π/√2 times the radius.
    double max_drift() const { return 2.25 * radius; }
    double reach() const { return radius + max_drift(); }
};
PathExtent extent_of(const ContainerPath& path) {
    Vec2 low{never, never}, high{-never, -never};
    const auto reach_to = [&](const Vec2& at) {
        low = {smaller(low.x, at.x), smaller(low.y, at.y)};
        high = {larger(high.x, at.x), larger(high.y, at.y)};
    };
    for (const Segment& segment : path.segments) {
        reach_to(segment.position_at(segment.begin));
        reach_to(segment.position_at(segment.end));
        if (segment.turning == 0.0) continue;
        const Vec2 from_centre = (-1.0 / segment.turning) * perpendicular(segment.velocity);
        const double radius = square_root(dot(from_centre, from_centre));
        reach_to(segment.start - from_centre + Vec2{radius, radius});
        reach_to(segment.start - from_centre - Vec2{radius, radius});
    }
    const Vec2 half = 0.5 * (high - low);
    return {low + half, square_root(dot(half, half))};
}

bool rests(const InitialState& scene) {
    return std::all_of(scene.path.segments.begin(), scene.path.segments.end(),
                       [](const Segment& segment) {
                           return segment.velocity.x == 0.0 && segment.velocity.y == 0.0;
                       });
}

/// Of linked cells (linked_cells.hpp).
struct CellWidths {
    double narrowest, wanted, widest;
};
/// Discs in cells that do not touch cannot meet, with room for rounding; and there are not so many
/// more cells than discs that memory counts. A cell of a thin gas has so many discs that nine just
/// fit into one vector, and one in four million has more than its room.
CellWidths cell_widths(const InitialState& scene, const Radii& radii) {
    constexpr double discs_per_cell = 0.6, cells_per_disc = 16.0;
    const double R = scene.container_radius, discs = static_cast<double>(scene.discs.size());
    const double side = 2.0 * (R + extent_of(scene.path).reach());
    const double minimum =
        larger(2.05 * radii.largest, side / square_root(64.0 + cells_per_disc * discs));
    const double wanted = larger(square_root(discs_per_cell * pi * R * R / discs), minimum);
    return {minimum, wanted, 1.2 * wanted};
}
/// If the discs are spread evenly.
double discs_per_cell(const InitialState& scene, double width) {
    const double R = scene.container_radius;
    return static_cast<double>(scene.discs.size()) * width * width / (pi * R * R);
}
/// Small discs among large ones may fill cells. Where they are spread evenly, one cell in a million
/// is not to overflow. In a dish that swirls discs gather, and where cells overflow lists are
/// faster.
std::uint32_t overflow_capacity(const InitialState& scene, double width) {
    const double mean = discs_per_cell(scene, width);
    const double overflow = mean + 6.0 * square_root(mean) - Cell::room;
    if (overflow <= 0.0 || !rests(scene)) return 0;
    return static_cast<std::uint32_t>(smaller(overflow / 8.0, max_overflow_capacity / 8 - 1.0)) *
               8 +
           8;
}

/// The corners of a path are only told on straight legs (linked_cells.hpp); a circle has none.
bool cells_can_be_laid(const InitialState& scene) {
    return scene.path.segments.size() == 1 ||
           std::all_of(scene.path.segments.begin(), scene.path.segments.end(),
                       [](const Segment& segment) { return segment.turning == 0.0; });
}

/// So thin that lists do not last. For equal discs that is asked of their packing, for others of
/// its geometric mean with that of as many discs of the mean radius; and with n discs in a cell
/// each prediction looks at 9n. In a dish that swirls discs gather, and then lists last.
bool is_thin(const InitialState& scene, const Radii& radii) {
    double sum = 0.0, squares = 0.0;
    for (const Disc& d : scene.discs) {
        sum += d.radius;
        squares += d.radius * d.radius;
    }
    const double R = scene.container_radius, discs = static_cast<double>(scene.discs.size());
    const double packing = sum * square_root(squares / discs) / (R * R);
    const double in_cell = discs_per_cell(scene, cell_widths(scene, radii).wanted);
    return packing * (0.92 + 0.1 * in_cell) < (rests(scene) ? 0.6 : 0.4);
}

/// Or coins: what a floor may accelerate.
bool are_spheres(const InitialState& scene) { return scene.shape != Shape::disc; }

NeighbourSearch neighbours_for(const InitialState& scene, const Radii& radii, const Tuning& tuning,
                               std::uint32_t few) {
    if (are_spheres(scene)) {
        const bool wanted = tuning.neighbours == NeighbourSearch::best ||
                            tuning.neighbours == NeighbourSearch::all_pairs;
        return wanted && scene.discs.size() <= SphereColumns::maximum ? NeighbourSearch::all_pairs
                                                                      : NeighbourSearch::cells;
    }
    const bool few_enough = scene.discs.size() <= few;
    switch (tuning.neighbours) {
        case NeighbourSearch::all_pairs:
            return few_enough ? NeighbourSearch::all_pairs : NeighbourSearch::lists;
        case NeighbourSearch::cells:
            return cells_can_be_laid(scene) ? NeighbourSearch::cells : NeighbourSearch::lists;
        case NeighbourSearch::lists:
            return NeighbourSearch::lists;
        case NeighbourSearch::best:
            break;
    }
    if (tuning.cells_per_side != 0) return NeighbourSearch::lists;
    if (few_enough) return NeighbourSearch::all_pairs;
    return is_thin(scene, radii) && cells_can_be_laid(scene) ? NeighbourSearch::cells
                                                             : NeighbourSearch::lists;
}

}  // namespace

const EventLoop& loop_for(const InitialState& scene, NeighbourSearch neighbours,
                          const EventLoops& loops) {
    const std::size_t last = scene.discs.size() - 1;
    const bool all_pairs = neighbours == NeighbourSearch::all_pairs;
    if (are_spheres(scene)) return all_pairs ? loops.few_spheres[last / 16] : loops.many_spheres;
    if (all_pairs) return loops.all_pairs[last / 8];
    return neighbours == NeighbourSearch::cells ? loops.cells : loops.lists;
}

struct Simulation::Storage {
    const EventLoop* loop;
    Width vectors;
    std::vector<Segment> segments;
    std::vector<DiscKind> kinds;
    AlignedMemory memory;
    EngineState state{};

    /// With the search that an outgrown one wanted, if there was one.
    Storage(const InitialState& scene, const Progress& progress, const Tuning& tuning,
            const Storage* outgrown = nullptr);
    bool prepare(const InitialState& scene, NeighbourSearch neighbours, const Radii& radii,
                 int cells_per_side, const Storage* outgrown);
    NeighbourSearch take_over(const EngineState& outgrown);
    Progress progress() const;
    Disc disc(std::uint32_t i) const;
    InitialState as_it_stands() const;
    bool stopped() const { return state.stops_at(0); }
    void allocate(const InitialState& scene, NeighbourSearch neighbours);
    void lay_grids(const InitialState& scene, const Radii& radii, int cells_per_side);
    double lay_grid(Grid& grid, double min_width, double side);
    void lay_lists(const InitialState& scene, const Radii& radii);
    void lay_cells(const InitialState& scene, const Radii& radii, const CellWidths& widths);
    void place(const InitialState& scene);
    void lay_cells_of_spheres(const InitialState& scene, const Radii& radii);
    void place_spheres(const InitialState& scene);
};

Simulation::Storage::Storage(const InitialState& scene, const Progress& progress,
                             const Tuning& tuning, const Storage* outgrown)
    : vectors(tuning.width), segments(scene.path.segments), memory(tuning.is_stopped) {
    const EventLoops& loops = event_loops(tuning.width);
    state.size = static_cast<std::uint32_t>(scene.discs.size());
    const Radii radii = radii_of(scene);
    NeighbourSearch neighbours = neighbours_for(scene, radii, tuning, loops.few);
    state.chooses_search =
        neighbours == NeighbourSearch::cells && tuning.neighbours == NeighbourSearch::best;
    if (outgrown != nullptr) neighbours = take_over(outgrown->state);
    loop = &loop_for(scene, neighbours, loops);
    state.segments = segments.data();
    state.segment_count = static_cast<std::uint32_t>(segments.size());
    state.segment = progress.segment;
    state.period = scene.path.period;
    state.container_radius = scene.container_radius;
    state.disc_surface = scene.disc_surface;
    state.wall_surface = scene.wall_surface;
    state.periods = progress.periods;
    state.clock = progress.clock;
    state.disc_disc = progress.events.disc_disc;
    state.disc_wall = progress.events.disc_wall;
    state.path_vertex = progress.events.path_vertex;
    state.elastic_by_tc = progress.events.elastic_by_tc;
    state.begun_to_roll = progress.events.begins_to_roll;
    state.floor = scene.floor;

    state.smallest_radius = radii.smallest;
    state.equal_radii = radii.smallest == radii.largest;
    state.capacity =
        neighbours == NeighbourSearch::lists
            ? list_capacity(smaller(radii.largest / radii.smallest, ratio_without_tail))
            : 0;
    if (state.capacity > 0 &&
        scene.container_radius > container_too_wide_for_narrow_skins * radii.smallest)
        state.capacity = max_capacity;
    state.cold_bytes = static_cast<std::uint32_t>(sizeof(ColdDisc)) + 4 * state.capacity;
    state.prefetches = state.size > 4000 && !are_spheres(scene);
    if (tuning.is_stopped) {
        state.caller = &tuning.is_stopped;
        state.is_stopped = [](const void* caller) {
            return (*static_cast<const std::function<bool()>*>(caller))();
        };
    }
    if (prepare(scene, neighbours, radii, tuning.cells_per_side, outgrown)) loop->start(state);
    if (stopped()) {
        state.size = 0;
        state.should_switch_search = false;
    }
    state.is_stopped = nullptr;
}

/// After lists come cells as wide as those before, after cells others or lists.
NeighbourSearch Simulation::Storage::take_over(const EngineState& outgrown) {
    const bool from_cells = outgrown.cells != nullptr;
    const bool to_lists = from_cells && outgrown.wanted_cell == 0.0;
    state.wanted_cell = to_lists ? 1.0 / outgrown.grids[0].cells_per_length : outgrown.wanted_cell;
    state.widest_cell = outgrown.widest_cell;
    state.chooses_search = outgrown.chooses_search;
    state.returns_to_cells = outgrown.returns_to_cells;
    return to_lists ? NeighbourSearch::lists : NeighbourSearch::cells;
}

/// All that is there before the first prediction; false if it was stopped on the way.
bool Simulation::Storage::prepare(const InitialState& scene, NeighbourSearch neighbours,
                                  const Radii& radii, int cells_per_side, const Storage* outgrown) {
    allocate(scene, neighbours);
    if (stopped()) return false;
    place(scene);
    if (are_spheres(scene)) {
        place_spheres(scene);
        if (neighbours == NeighbourSearch::cells) lay_cells_of_spheres(scene, radii);
    } else if (neighbours == NeighbourSearch::lists) {
        lay_grids(scene, radii, cells_per_side);
        lay_lists(scene, radii);
    } else if (neighbours == NeighbourSearch::cells) {
        CellWidths widths = cell_widths(scene, radii);
        if (outgrown != nullptr) {
            widths.wanted = state.wanted_cell;
            widths.widest = state.widest_cell;
        }
        lay_cells(scene, radii, widths);
    }
    return !stopped();
}

void Simulation::Storage::allocate(const InitialState& scene, NeighbourSearch neighbours) {
    const std::size_t size = scene.discs.size();
    state.discs = memory.add<HotDisc>(size + 1);
    state.cold_discs = memory.add<unsigned char>((size + 1) * state.cold_bytes);
    if (are_spheres(scene)) state.spheres = memory.add<SphereState>(size);
    if (neighbours == NeighbourSearch::all_pairs) {
        if (are_spheres(scene))
            state.sphere_columns = memory.add<SphereColumns>(1);
        else
            state.columns = memory.add<Columns>(1);
        return;
    }
    state.skins = memory.add<Skin>(size);
    std::size_t entries = size;
    do {
        std::size_t padded = (entries + 7) / 8 * 8;
        // One row, or an even number.
        if (padded > 8 && padded <= 8 * max_top_rows) padded = (padded + 15) / 16 * 16;
        state.level_times[state.levels] = memory.add<double>(padded);
        if (state.levels > 0) state.level_winners[state.levels] = memory.add<std::uint32_t>(padded);
        ++state.levels;
        entries = padded / 8;
    } while (entries > max_top_rows);
    state.top_rows = static_cast<std::uint32_t>(entries);
    std::fill_n(state.level_times[state.levels - 1], 8 * entries, never);  // more than there are
}

/// Where all discs are of about one size, cells wide enough that the skins of discs in cells that
/// do not touch never overlap: |X_i − X_k| < 2 (largest radius + largest skin radius) = the width.
/// On average a cell's worth of area holds three discs. Where they are not, each size has a grid of
/// its own, and a skin is no larger than with cells for the smallest. A small dish has none.
void Simulation::Storage::lay_grids(const InitialState& scene, const Radii& radii,
                                    int cells_per_side) {
    const double reach = scene.container_radius;
    const double side = 2.0 * reach;
    state.cell_origin = -reach;
    constexpr std::uint32_t few = 100;
    state.has_no_grid = cells_per_side == 1 ? state.size <= min_candidates
                                            : cells_per_side == 0 && state.size <= few;
    state.grid_count = 1;
    state.grids[0].largest_radius = radii.largest;
    if (state.has_no_grid) {
        state.largest_skin_radius = 4.0 * side;
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
    std::array<std::uint32_t, max_grids> row{};
    state.grid_count = 0;
    for (std::uint32_t size = 0; size < max_grids; ++size) {
        row[size] = state.grid_count;
        if (discs[size] == 0) continue;
        Grid& grid = state.grids[state.grid_count++];
        grid.largest_radius = largest[size];
        grid.equal_radii = smallest[size] == largest[size];
    }
    for (DiscKind& kind : kinds) kind.grid = row[size_class(kind.radius, radii.smallest)];

    const double area = pi * reach * reach;
    // Where a thin dish has gathered, wider cells than for seven discs would hold more.
    const double for_one = square_root(area / state.size), for_seven = 4.4 * largest[0];
    double width = smaller(square_root(3.0) * for_one, larger(for_seven, for_one));
    width = larger(2.6 * largest[0], width);
    if (cells_per_side > 0) width = side / cells_per_side;
    width = lay_grid(state.grids[0], larger(width, 2.1 * largest[0]), side);
    // A hair less than the cells allow, for the rounding of positions into cells. Of several grids
    // each is searched as far as the largest skin may reach, and most skins are smaller.
    constexpr double worth_searching = 0.75;
    state.largest_skin_radius = (0.5 * width - largest[0]) * (1.0 - 1e-6);
    if (state.grid_count > 1) state.largest_skin_radius *= worth_searching;
    for (std::uint32_t size = 1; size < max_grids; ++size) {
        if (discs[size] == 0) continue;
        const double three = square_root(3.0 * area / static_cast<double>(discs[size]));
        lay_grid(state.grids[row[size]],
                 larger(2.0 * (largest[size] + state.largest_skin_radius), three), side);
    }
}

/// No narrower than told; says how wide.
double Simulation::Storage::lay_grid(Grid& grid, double min_width, double side) {
    grid.cells_per_side =
        static_cast<std::uint32_t>(larger(1.0, smaller(side / min_width, 30000.0)));
    grid.cells_per_length = grid.cells_per_side / side;
    const std::size_t cells = static_cast<std::size_t>(grid.cells_per_side) * grid.cells_per_side;
    constexpr std::uint32_t too_many_for_room = 200000;
    if (state.spheres == nullptr && state.grid_count == 1 && state.size < too_many_for_room)
        grid.cells = memory.add<Cell>(cells);
    grid.heads = memory.add<std::uint32_t>(cells);
    return side / grid.cells_per_side;
}

/// Room for the lists of discs that are much larger than others: for all that may lie around them.
void Simulation::Storage::lay_lists(const InitialState& scene, const Radii& radii) {
    std::map<double, std::uint32_t> smaller_than;  // each radius that there is: how many discs are
    for (std::uint32_t i = 0; i < state.size && !state.stops_at(i); ++i)
        ++smaller_than[scene.discs[i].radius];
    std::uint32_t counted = 0;
    for (auto& [radius, count] : smaller_than) count = std::exchange(counted, counted + count);
    const auto list_room = [&](double radius) {
        const auto larger_one = smaller_than.lower_bound(radius / ratio_without_tail);
        const std::uint32_t smaller_ones =
            larger_one == smaller_than.end() ? state.size : larger_one->second;
        return std::min(list_capacity(radius / radii.smallest),
                        list_capacity(ratio_without_tail) + smaller_ones);
    };
    for (DiscKind& kind : kinds)
        kind.wanted_neighbours = wanted_neighbours(kind.radius / radii.smallest);

    const std::uint32_t longest = list_room(radii.largest);
    CandidateColumns& candidates = state.candidates;
    candidates.room = std::max(min_candidates, (2 * longest + 7) / 8 * 8);
    // Behind the last candidate stand eight that are nobody.
    candidates.gap = memory.add<double>(candidates.room + 8);
    candidates.reach = memory.add<double>(candidates.room + 8);
    candidates.X = memory.add<float>(candidates.room);
    candidates.Y = memory.add<float>(candidates.room);
    candidates.disc = memory.add<std::uint32_t>(candidates.room + 8);
    candidates.chosen = memory.add<std::uint32_t>(candidates.room);
    candidates.rebuilt = memory.add<std::uint32_t>(candidates.room);

    if (longest <= state.capacity) return;
    const auto tail_room = [&](std::uint32_t i) {
        const std::uint32_t room = list_room(scene.discs[i].radius);
        return room <= state.capacity ? 0 : (room - state.capacity + 7) / 8 * 8;
    };
    constexpr std::uint32_t entries = sizeof(ListTail) / sizeof(std::uint32_t);
    state.tail_places = memory.add<std::uint32_t>(state.size);
    std::uint32_t end = 1;
    for (std::uint32_t i = 0; i < state.size && !state.stops_at(i); ++i) {
        if (tail_room(i) == 0) continue;
        state.tail_places[i] = end;
        end += 1 + tail_room(i) / entries;
    }
    state.tails = memory.add<ListTail>(end);
    if (stopped()) return;
    for (std::uint32_t i = 0; i < state.size; ++i)
        if (state.tail_places[i] != 0) state.tail(i).room = tail_room(i);
}

/// Over all that the container comes to, seen from cells that move as fast as it does; and two
/// cells more on each side, so that a disc in a cell always has eight around.
void Simulation::Storage::lay_cells(const InitialState& scene, const Radii& radii,
                                    const CellWidths& widths) {
    const PathExtent path = extent_of(scene.path);
    const double R = scene.container_radius;
    Grid& grid = state.grids[0];
    grid.cells_per_side = static_cast<std::uint32_t>(2.0 * (R + path.reach()) / widths.wanted) + 5;
    grid.cells_per_length = 1.0 / widths.wanted;
    state.narrowest_cell = widths.narrowest;
    state.widest_cell = widths.widest;
    state.cell_origin = -0.5 * widths.wanted * grid.cells_per_side;
    state.middle_of_path = path.middle;
    state.max_drift = path.max_drift();
    const std::size_t cells = static_cast<std::size_t>(grid.cells_per_side) * grid.cells_per_side;
    state.cells = memory.add<Cell>(cells);
    state.overflow_capacity = overflow_capacity(scene, widths.wanted);
    state.annexes = memory.add<std::uint32_t>(cells * state.overflow_capacity);
    // Half a cell's diagonal, and a hair for the rounding of its centre to single precision.
    state.reach_of_far_cells =
        (R - path.radius) * (1.0 - 1e-6) - radii.largest - 0.71 * widths.wanted;
    state.near_wall = memory.add<std::uint32_t>(state.size + 8);
    state.unassigned = memory.add<std::uint32_t>(state.size + 8);
}

/// Three spheres' worth of area on average, no narrower than one of them (many_spheres.hpp).
void Simulation::Storage::lay_cells_of_spheres(const InitialState& scene, const Radii& radii) {
    const double R = scene.container_radius;
    state.cell_origin = -R;
    state.grid_count = 1;
    lay_grid(state.grids[0],
             larger(2.0 * radii.largest, square_root(3.0 * pi * R * R / state.size)), 2.0 * R);
}

void Simulation::Storage::place(const InitialState& scene) {
    std::map<std::array<double, 3>, std::uint32_t> rows;
    for (std::uint32_t i = 0; i < state.size && !state.stops_at(i); ++i) {
        const Disc& d = scene.discs[i];
        const auto [row, is_new] = rows.try_emplace({d.radius, d.mass, d.inertia},
                                                    static_cast<std::uint32_t>(kinds.size()));
        if (is_new)
            kinds.push_back({d.radius, d.mass, d.inertia, 1.0 / d.mass, 1.0 / d.inertia, 0, 0});
        state.discs[i] = {
            d.position, d.velocity, d.time, d.radius, d.spin, 0, row->second & 0xffffffu, 0, 0};
        state.cold(i).angle = d.angle;
    }
    state.kinds = kinds.data();
    const double nowhere = std::numeric_limits<double>::quiet_NaN();
    state.discs[state.size] = {{nowhere, nowhere}, {0.0, 0.0}, 0.0, 0.0, 0.0, 0, 0, 0, 0};
    if (state.columns == nullptr) return;
    for (std::uint32_t k = 0; k < Columns::maximum; ++k) {
        Columns& all = *state.columns;
        const bool somebody = k < state.size;
        all.x[k] = all.y[k] = somebody ? 0.0 : nowhere;
        all.radius[k] = somebody ? state.discs[k].radius : 0.0;
        all.nobody[k] = somebody ? 0.0 : never;
        all.meeting[k] = all.wall[k] = never;
    }
}

void Simulation::Storage::place_spheres(const InitialState& scene) {
    const Vec2 floor_velocity = segments[state.segment].velocity;
    for (std::uint32_t i = 0; i < state.size && !state.stops_at(i); ++i) {
        const Disc& d = scene.discs[i];
        state.spheres[i] = {floor_motion(d, scene.floor, floor_velocity), d.rolling_spin,
                            d.last_collision};
    }
    if (state.sphere_columns == nullptr) return;
    SphereColumns& all = *state.sphere_columns;
    for (std::uint32_t k = 0; k < SphereColumns::maximum; ++k) {
        all.x[k] = all.y[k] = all.X[k] = all.Y[k] = std::numeric_limits<double>::quiet_NaN();
        all.radius[k] = k < state.size ? state.discs[k].radius : 0.0;
        all.reach[k] = 0.0;
        all.meeting[k] = all.wall[k] = all.rolls[k] = all.first[k] = never;
    }
}

Progress Simulation::Storage::progress() const {
    return {state.periods,
            state.clock,
            state.segment,
            {state.disc_disc, state.disc_wall, state.path_vertex, state.elastic_by_tc,
             state.begun_to_roll}};
}

/// Resumed from this, with whatever search, it goes on bit for bit.
InitialState Simulation::Storage::as_it_stands() const {
    InitialState scene{{},
                       {state.period, segments},
                       state.container_radius,
                       state.disc_surface,
                       state.wall_surface};
    scene.discs.reserve(state.size);
    for (std::uint32_t i = 0; i < state.size; ++i) scene.discs.push_back(disc(i));
    return scene;
}

Simulation::Simulation(const InitialState& scene, const Progress& progress, const Tuning& tuning)
    : storage_(std::make_unique<Storage>(scene, progress, tuning)) {
    while (storage_->state.should_switch_search)
        storage_ = std::make_unique<Storage>(scene, progress, tuning, storage_.get());
}
Simulation::~Simulation() = default;
Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;

/// Other cells take over, or lists.
void Simulation::switch_search() {
    const InitialState scene = storage_->as_it_stands();
    Tuning tuning;
    tuning.width = storage_->vectors;
    while (storage_->state.should_switch_search) {
        const LoopCounts before = loop_counts();
        storage_ = std::make_unique<Storage>(scene, progress(), tuning, storage_.get());
        EngineState& state = storage_->state;
        state.invalidated = before.invalidated;
        state.list_rebuilds += before.list_rebuilds;
        state.rebuilds_when_asked = state.entered_before = state.list_rebuilds;
        state.full_rebuilds = before.full_rebuilds + 1;
    }
}

Event Simulation::step() {
    const Event event = storage_->loop->step(storage_->state);
    if (storage_->state.should_switch_search) [[unlikely]]
        switch_search();
    return event;
}

std::uint64_t Simulation::run(std::uint64_t count, std::int64_t periods, double clock) {
    std::uint64_t done = 0;
    for (;;) {
        done += storage_->loop->run(storage_->state, count - done, periods, clock);
        if (!storage_->state.should_switch_search) return done;
        switch_search();
    }
}

void Simulation::run(std::uint64_t count) {
    run(count, std::numeric_limits<std::int64_t>::max(), never);
}

void Simulation::advance_to(std::int64_t periods, double clock) {
    advance_to(periods, clock, std::numeric_limits<std::uint64_t>::max());
}

bool Simulation::advance_to(std::int64_t periods, double clock, std::uint64_t maximum) {
    if (run(maximum, periods, clock) == maximum) return false;
    EngineState& state = storage_->state;
    if (state.periods == periods && state.clock < clock) state.clock = clock;
    return true;
}

std::int64_t Simulation::periods() const { return storage_->state.periods; }
double Simulation::clock() const { return storage_->state.clock; }
std::size_t Simulation::size() const { return storage_->state.size; }
EventCounts Simulation::events() const { return storage_->progress().events; }
Progress Simulation::progress() const { return storage_->progress(); }
LoopCounts Simulation::loop_counts() const {
    const EngineState& state = storage_->state;
    return {state.invalidated,   state.list_rebuilds,      state.overflows,
            state.full_rebuilds, storage_->memory.bytes(), storage_->loop->width};
}

Disc Simulation::Storage::disc(std::uint32_t i) const {
    const HotDisc& d = state.discs[i];
    const DiscKind& kind = state.kinds[d.kind];
    Disc disc{d.position, d.velocity,  state.cold(i).angle, d.spin,
              d.time,     kind.radius, kind.mass,           kind.inertia};
    if (state.spheres != nullptr) {
        disc.rolling_spin = state.spheres[i].rolling_spin;
        disc.last_collision = state.spheres[i].last_collision;
    }
    return disc;
}
Disc Simulation::disc(std::size_t i) const { return storage_->disc(static_cast<std::uint32_t>(i)); }

Snapshot Simulation::snapshot() const {
    Snapshot s;
    const EngineState& state = storage_->state;
    if (state.spheres != nullptr)
        s.resize_for_spheres(size());
    else
        s.resize(size());
    s.on_floor = state.spheres != nullptr && state.floor.deceleration != 0.0;
    s.lie_flat = state.floor.bodies_lie_flat;
    s.period = state.period;
    s.container_radius = state.container_radius;
    for (std::size_t i = 0; i < s.size(); ++i) {
        s.set(i, disc(i));
        if (state.spheres == nullptr) continue;
        const SphereState& sphere = state.spheres[i];
        s.set_floor_motion(i, sphere.rolling_spin, sphere.motion.acceleration);
    }
    refresh(s, Event{0, 0.0, EventKind::path_vertex, 0, 0, {}, {}, 0.0});
    return s;
}

void Simulation::refresh(Snapshot& s, const Event& event) const {
    const EngineState& state = storage_->state;
    const Segment& segment = state.segments[state.segment];
    const auto hand_over_sphere = [&](std::uint32_t i) __attribute__((noinline)) {
        if (!s.turned.empty()) s.turned[i] = s.quaternion(i, event.clock);
        const SphereState& sphere = state.spheres[i];
        s.set_floor_motion(i, sphere.rolling_spin, sphere.motion.acceleration);
    };
    const auto hand_over = [&](std::uint32_t i) __attribute__((always_inline)) {
        const HotDisc& d = state.discs[i];
        if (state.spheres != nullptr) hand_over_sphere(i);
        s.set_motion(i, {d.position, d.velocity, d.time}, state.cold(i).angle, d.spin);
    };
    if (event.kind != EventKind::path_vertex) {
        hand_over(event.i);
        if (event.j != event.i) hand_over(event.j);
    } else if (state.segment == 0 || s.on_floor) {
        for (std::uint32_t i = 0; i < state.size; ++i) hand_over(i);
    }
    // Last: how spheres have turned follows from the floor's velocity up to now.
    s.periods = state.periods;
    s.clock = state.clock;
    s.container_centre = segment.position_at(state.clock);
    s.container_velocity = segment.velocity_at(state.clock);
}

std::uint64_t Simulation::state_hash() const {
    std::uint64_t hash = 0xcbf29ce484222325u;
    const auto mix = [&](std::uint64_t bits) {
        hash = (hash ^ bits) * 0x9e3779b97f4a7c15u;
        hash ^= hash >> 32;
    };
    const auto mix_double = [&](double x) {
        std::uint64_t bits;
        std::memcpy(&bits, &x, sizeof bits);
        mix(bits);
    };
    const EngineState& state = storage_->state;
    mix(static_cast<std::uint64_t>(state.periods));
    mix(state.segment);
    mix(events().total());
    for (std::size_t i = 0; i < size(); ++i) {
        const Disc d = disc(i);
        for (const double x :
             {d.position.x, d.position.y, d.velocity.x, d.velocity.y, d.angle, d.spin, d.time})
            mix_double(x);
        if (state.spheres == nullptr) continue;
        for (const double x : {d.rolling_spin.x, d.rolling_spin.y, d.last_collision}) mix_double(x);
    }
    return hash;
}

}  // namespace swirl
