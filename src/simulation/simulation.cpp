#include "swirl/simulation/simulation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <map>
#include <new>

#if defined(__linux__)
#include <sys/mman.h>
#endif

#include "swirl/math/real.hpp"
#include "swirl/simulation/search/state.hpp"

namespace swirl {
namespace {

const EventLoops& event_loops(Width width) {
    width = width_meant(width);
#if defined(__x86_64__)
    if (width == Width::avx512) return event_loops_avx512;
    if (width == Width::avx2) return event_loops_avx2;
#endif
    return event_loops_baseline;
}

/// Memory for columns, aligned to cache lines; large ones to huge pages.
class Columns {
  public:
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
        std::memset(block, 0, bytes);
        bytes_ += bytes;
        return reinterpret_cast<T*>(block);
    }
    std::uint64_t bytes() const { return bytes_; }

  private:
    static constexpr std::size_t huge_page = std::size_t{1} << 21;
    struct Free {
        std::align_val_t alignment;
        void operator()(unsigned char* p) const { ::operator delete(p, alignment); }
    };
    std::vector<std::unique_ptr<unsigned char, Free>> blocks_;
    std::uint64_t bytes_ = 0;
};

/// How many small discs can touch a large one at once, at most: π / asin(1/(1 + q)) for a ratio q
/// of the radii, and half as much again for those that are merely near.
std::uint32_t list_capacity(double ratio) {
    const double contacts = pi / std::asin(1.0 / (1.0 + ratio));
    const auto wanted = static_cast<std::uint32_t>(1.5 * contacts) + 3;
    return std::min<std::uint32_t>(longest_list, (wanted + 3) / 4 * 4);
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

/// Of a thin gas, in radii of the smallest disc (linked_cells.hpp).
constexpr double cell_width = 3.6;

bool cells_can_be_laid(const InitialState& scene, const Radii& radii) {
    if (2.01 * radii.largest > cell_width * radii.smallest) return false;
    return std::all_of(scene.path.legs.begin(), scene.path.legs.end(),
                       [](const Leg& leg) { return leg.turning == 0.0; });
}

/// A gas at rest so thin that lists do not last, and not so thin that cells are mostly empty.
bool is_thin_gas(const InitialState& scene) {
    double packing = 0.0;
    for (const Disc& d : scene.discs) packing += d.radius * d.radius;
    packing /= scene.container_radius * scene.container_radius;
    return packing < 0.46 && packing > 0.02 &&
           std::all_of(scene.path.legs.begin(), scene.path.legs.end(), [](const Leg& leg) {
               return leg.velocity.x == 0.0 && leg.velocity.y == 0.0;
           });
}

Neighbours neighbours_for(const InitialState& scene, const Radii& radii, const Tuning& tuning,
                          std::uint32_t few) {
    const bool few_enough = scene.discs.size() <= few;
    switch (tuning.neighbours) {
        case Neighbours::all_pairs:
            return few_enough ? Neighbours::all_pairs : Neighbours::lists;
        case Neighbours::cells:
            return cells_can_be_laid(scene, radii) ? Neighbours::cells : Neighbours::lists;
        case Neighbours::lists:
            return Neighbours::lists;
        case Neighbours::best:
            break;
    }
    if (tuning.cells_per_side != 0) return Neighbours::lists;
    if (few_enough) return Neighbours::all_pairs;
    return is_thin_gas(scene) && cells_can_be_laid(scene, radii) ? Neighbours::cells
                                                                 : Neighbours::lists;
}

}  // namespace

struct Simulation::Storage {
    const EventLoop* loop;
    std::vector<Leg> legs;
    std::vector<DiscKind> kinds;
    Columns columns;
    Machine machine{};

    Storage(const InitialState& scene, const Progress& progress, const Tuning& tuning);
    void allocate(std::size_t size, Neighbours neighbours);
    void lay_grid(const InitialState& scene, double largest, int cells_per_side);
    void lay_cells(const InitialState& scene);
    void place(const InitialState& scene);
};

Simulation::Storage::Storage(const InitialState& scene, const Progress& progress,
                             const Tuning& tuning)
    : legs(scene.path.legs) {
    const EventLoops& loops = event_loops(tuning.width);
    Machine& m = machine;
    m.size = static_cast<std::uint32_t>(scene.discs.size());
    const Radii radii = radii_of(scene);
    const Neighbours neighbours = neighbours_for(scene, radii, tuning, loops.few);
    loop = neighbours == Neighbours::all_pairs ? &loops.all_pairs[(m.size - 1) / 8]
           : neighbours == Neighbours::cells   ? &loops.cells
                                               : &loops.lists;
    m.legs = legs.data();
    m.leg_count = static_cast<std::uint32_t>(legs.size());
    m.leg = progress.leg;
    m.period = scene.path.period;
    m.container_radius = scene.container_radius;
    m.disc_surface = scene.disc_surface;
    m.wall_surface = scene.wall_surface;
    m.swirls = progress.swirls;
    m.clock = progress.clock;
    m.disc_disc = progress.events.disc_disc;
    m.disc_wall = progress.events.disc_wall;
    m.path_vertex = progress.events.path_vertex;
    m.lasting = progress.events.lasting;

    m.smallest_radius = radii.smallest;
    m.equal_radii = radii.smallest == radii.largest;
    m.capacity =
        neighbours == Neighbours::lists ? list_capacity(radii.largest / radii.smallest) : 0;
    m.plan_bytes = static_cast<std::uint32_t>(sizeof(Plan)) + 4 * m.capacity;
    m.prefetches = m.size > 4000;
    allocate(scene.discs.size(), neighbours);
    if (neighbours == Neighbours::lists) lay_grid(scene, radii.largest, tuning.cells_per_side);
    if (neighbours == Neighbours::cells) lay_cells(scene);
    place(scene);
    loop->start(m);
}

void Simulation::Storage::allocate(std::size_t size, Neighbours neighbours) {
    Machine& m = machine;
    m.discs = columns.add<HotDisc>(size + 1);
    m.plans = columns.add<unsigned char>((size + 1) * m.plan_bytes);
    if (neighbours == Neighbours::all_pairs) {
        m.side_by_side = columns.add<SideBySide>(1);
        return;
    }
    m.neighbourhoods = columns.add<Neighbourhood>(size);
    std::size_t entries = size;
    do {
        const std::size_t padded = (entries + 7) / 8 * 8;
        m.level_times[m.levels] = columns.add<double>(padded);
        if (m.levels > 0) m.level_winners[m.levels] = columns.add<std::uint32_t>(padded);
        ++m.levels;
        entries = padded / 8;
    } while (entries > 1);
}

/// Cells wide enough that the neighbourhoods of discs in cells that do not touch never overlap:
/// |X_i − X_k| < 2 (largest radius + longest freedom) = the width. On average a cell's worth of
/// area holds three discs; a small dish is one cell, all pairs.
void Simulation::Storage::lay_grid(const InitialState& scene, double largest, int cells_per_side) {
    Machine& m = machine;
    double reach = scene.container_radius;
    for (const Leg& leg : legs)
        if (leg.turning != 0.0)
            reach = scene.container_radius + square_root(dot(leg.start, leg.start));
    const double side = 2.0 * reach;
    const double density = static_cast<double>(m.size) / (pi * reach * reach);
    double width = larger(2.6 * largest, square_root(3.0 / density));
    if (cells_per_side > 0) width = side / cells_per_side;
    width = larger(width, 2.1 * largest);
    m.cells_per_side = static_cast<std::uint32_t>(larger(1.0, smaller(side / width, 30000.0)));
    if (cells_per_side == 0 && m.size <= 100) m.cells_per_side = 1;
    width = side / m.cells_per_side;
    m.cells_per_length = 1.0 / width;
    m.cell_origin = -reach;
    // A hair less than the cells allow, for the rounding of positions into cells.
    m.longest_freedom = m.cells_per_side == 1 ? 4.0 * side : (0.5 * width - largest) * (1.0 - 1e-6);
    m.cell_heads = columns.add<std::uint32_t>(m.cells_per_side * m.cells_per_side);
}

/// Two cells more than the dish needs on each side, so that a disc in a cell always has eight
/// around.
void Simulation::Storage::lay_cells(const InitialState& scene) {
    Machine& m = machine;
    const double width = cell_width * m.smallest_radius;
    m.cells_per_side = static_cast<std::uint32_t>(2.0 * scene.container_radius / width) + 5;
    m.cells_per_length = 1.0 / width;
    m.cell_origin = -0.5 * width * m.cells_per_side;
    m.cells = columns.add<Cell>(static_cast<std::size_t>(m.cells_per_side) * m.cells_per_side);
}

void Simulation::Storage::place(const InitialState& scene) {
    Machine& m = machine;
    std::map<std::array<double, 3>, std::uint32_t> rows;
    for (std::uint32_t i = 0; i < m.size; ++i) {
        const Disc& d = scene.discs[i];
        const auto [row, is_new] = rows.try_emplace({d.radius, d.mass, d.inertia},
                                                    static_cast<std::uint32_t>(kinds.size()));
        if (is_new) kinds.push_back({d.radius, d.mass, d.inertia, 1.0 / d.mass, 1.0 / d.inertia});
        m.discs[i] = {d.position, d.velocity, d.time, d.radius, d.spin, 0, row->second & 0xffffffu,
                      0,          0};
        m.plan(i).angle = d.angle;
    }
    m.kinds = kinds.data();
    const double nowhere = std::numeric_limits<double>::quiet_NaN();
    m.discs[m.size] = {{nowhere, nowhere}, {0.0, 0.0}, 0.0, 0.0, 0.0, 0, 0, 0, 0};
    if (m.side_by_side == nullptr) return;
    for (std::uint32_t k = 0; k < SideBySide::most; ++k) {
        SideBySide& all = *m.side_by_side;
        const bool somebody = k < m.size;
        all.x[k] = all.y[k] = somebody ? 0.0 : nowhere;
        all.radius[k] = somebody ? m.discs[k].radius : 0.0;
        all.nobody[k] = somebody ? 0.0 : never;
        all.meeting[k] = all.wall[k] = never;
    }
}

Simulation::Simulation(const InitialState& scene, const Progress& progress, const Tuning& tuning)
    : storage_(std::make_unique<Storage>(scene, progress, tuning)) {
    if (!storage_->machine.discs_overlap) return;
    // The cells of a thin gas are made for discs that do not; lists take any.
    const Tuning lists{tuning.cells_per_side, tuning.width, Neighbours::lists};
    storage_ = std::make_unique<Storage>(scene, progress, lists);
}
Simulation::~Simulation() = default;
Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;

Event Simulation::step() { return storage_->loop->step(storage_->machine); }

void Simulation::run(std::uint64_t count) {
    storage_->loop->run(storage_->machine, count, std::numeric_limits<std::int64_t>::max(), never);
}

void Simulation::advance_to(std::int64_t swirls, double clock) {
    Machine& m = storage_->machine;
    storage_->loop->run(m, std::numeric_limits<std::uint64_t>::max(), swirls, clock);
    if (m.swirls == swirls && m.clock < clock) m.clock = clock;
}

std::int64_t Simulation::swirls() const { return storage_->machine.swirls; }
double Simulation::clock() const { return storage_->machine.clock; }
std::size_t Simulation::size() const { return storage_->machine.size; }
EventCounts Simulation::events() const {
    const Machine& m = storage_->machine;
    return {m.disc_disc, m.disc_wall, m.path_vertex, m.lasting};
}
Progress Simulation::progress() const {
    const Machine& m = storage_->machine;
    return {m.swirls, m.clock, m.leg, events()};
}
LoopCounts Simulation::loop_counts() const {
    const Machine& m = storage_->machine;
    return {m.stale,
            m.relists,
            m.crowded,
            m.overcrowded,
            storage_->columns.bytes(),
            storage_->loop->width};
}

Disc Simulation::disc(std::size_t i) const {
    const Machine& m = storage_->machine;
    const HotDisc& d = m.discs[i];
    const DiscKind& kind = m.kinds[d.kind];
    return {d.position, d.velocity,  m.plan(static_cast<std::uint32_t>(i)).angle,
            d.spin,     d.time,      kind.radius,
            kind.mass,  kind.inertia};
}

Snapshot Simulation::snapshot() const {
    Snapshot s;
    s.resize(size());
    s.period = storage_->machine.period;
    s.container_radius = storage_->machine.container_radius;
    for (std::size_t i = 0; i < s.size(); ++i) s.set(i, disc(i));
    refresh(s, Event{0, 0.0, EventKind::path_vertex, 0, 0, {}, {}, 0.0});
    return s;
}

void Simulation::refresh(Snapshot& s, const Event& event) const {
    const Machine& m = storage_->machine;
    const Leg& leg = m.legs[m.leg];
    s.swirls = m.swirls;
    s.clock = m.clock;
    s.container_centre = leg.position_at(m.clock);
    s.container_velocity = leg.velocity_at(m.clock);
    const auto hand_over = [&](std::uint32_t i) {
        const HotDisc& d = m.discs[i];
        s.set_motion(i, {d.position, d.velocity, d.time}, m.plan(i).angle, d.spin);
    };
    if (event.kind != EventKind::path_vertex) {
        hand_over(event.i);
        if (event.j != event.i) hand_over(event.j);
    } else if (m.leg == 0) {
        for (std::uint32_t i = 0; i < m.size; ++i) hand_over(i);
    }
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
    const Machine& m = storage_->machine;
    mix(static_cast<std::uint64_t>(m.swirls));
    mix(m.leg);
    mix(events().total());
    for (std::size_t i = 0; i < size(); ++i) {
        const Disc d = disc(i);
        for (const double x :
             {d.position.x, d.position.y, d.velocity.x, d.velocity.y, d.angle, d.spin, d.time})
            mix_double(x);
    }
    return hash;
}

}  // namespace swirl
