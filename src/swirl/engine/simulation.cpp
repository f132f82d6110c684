#include "swirl/engine/simulation.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

#include "swirl/engine/simulation_storage.hpp"
#include "swirl/engine/validate.hpp"

namespace swirl {
namespace {

/// The part of validate.hpp whose sentences do not depend on values, for functions that are called
/// often.
SWIRL_INLINE void require(bool holds, const char* problem, const char* function) {
    if constexpr (preconditions_are_checked)
        if (!holds) [[unlikely]]
            stop(problem, function);
}

/// The largest double below this time; −1 if it is 0, since no event is earlier than 0.
double last_before(double time) {
    return time > 0.0 ? std::bit_cast<double>(std::bit_cast<std::uint64_t>(time) - 1) : -1.0;
}

/// The scene, if it and the other arguments are valid or the caller has stopped the construction.
const InitialState& required(const InitialState& scene, const Progress& progress,
                             const Tuning& tuning) {
    if constexpr (preconditions_are_checked) {
        stop_if(validate(tuning), "Simulation");
        const auto problem = validate(scene, progress);
        if (problem && !(tuning.is_stopped && tuning.is_stopped())) stop_if(problem, "Simulation");
    }
    return scene;
}

}  // namespace

Simulation::Simulation(const InitialState& scene, const Progress& progress, const Tuning& tuning)
    : storage_(std::make_unique<Storage>(required(scene, progress, tuning), progress, tuning)) {
    while (storage_->state->should_switch_search)
        storage_ = std::make_unique<Storage>(scene, progress, tuning, storage_.get());
}
Simulation::~Simulation() = default;
Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;

/// Lists replace cells, or cells replace lists or cells of another width (lists_or_cells.hpp).
void Simulation::switch_search() {
    const InitialState scene = storage_->current_scene();
    Tuning tuning;
    tuning.width = storage_->width;
    while (storage_->state->should_switch_search) {
        const LoopCounts before = loop_counts();
        storage_ = std::make_unique<Storage>(scene, progress(), tuning, storage_.get());
        EngineState& state = *storage_->state;
        state.invalidated = before.invalidated;
        state.list_rebuilds += before.list_rebuilds;
        state.full_rebuilds = before.full_rebuilds + 1;
        static_cast<ListsOrCellsState&>(state).rebuilds_at_test = state.list_rebuilds;
        if (auto* cells = std::get_if<LinkedCellsState>(&storage_->search))
            cells->cell_changes_before = state.list_rebuilds;
    }
}

Event Simulation::step() {
    Event event;
    EventSpan span;
    observe(nullptr, &event, span, 1, std::numeric_limits<std::int64_t>::max(), never);
    return event;
}

/// Until the span has `count` events.
void Simulation::run(EventSpan& span, std::uint64_t count, std::int64_t periods, double clock) {
    for (;;) {
        storage_->loop->run(*storage_->state, span, count, periods, clock);
        if (!storage_->state->should_switch_search) return;
        switch_search();
    }
}

/// The same, observed. Also returns if the sampling pauses, and then the search is not replaced.
void Simulation::observe(RotationSampling* sampling, Event* last, EventSpan& span,
                         std::uint64_t count, std::int64_t periods, double clock) {
    for (;;) {
        if (sampling != nullptr) storage_->add_copies();
        storage_->loop->observe(*storage_->state, sampling, last, span, count, periods, clock);
        if (!storage_->state->should_switch_search) [[likely]]
            return;
        switch_search();
    }
}

void Simulation::run(std::uint64_t count) {
    EventSpan span;
    run(span, count, std::numeric_limits<std::int64_t>::max(), never);
}

void Simulation::run_before(double clock, std::uint64_t maximum, EventSpan& span) {
    require(!std::isnan(clock), "the clock is nan.", "Simulation::run_before");
    const EngineState& state = *storage_->state;
    const double end = std::min(clock, state.segments[state.segment_count - 1].end);
    run(span, span.events + maximum, state.periods, last_before(end));
}

void Simulation::observe_before(double clock, std::uint64_t maximum, RotationSampling& sampling,
                                EventSpan& span, Event* last) {
    require(!std::isnan(clock), "the clock is nan.", "Simulation::observe_before");
    require(sampling.rotation.discs == static_cast<std::ptrdiff_t>(size()),
            "the rotation is one of another simulation.", "Simulation::observe_before");
    observe(&sampling, last, span, span.events + maximum, storage_->state->periods,
            last_before(clock));
}

void Simulation::advance_to(std::int64_t periods, double clock) {
    advance_to(periods, clock, std::numeric_limits<std::uint64_t>::max());
}

std::optional<std::string> Simulation::problem_with_time(std::int64_t periods, double clock) const {
    return swirl::problem_with_time(progress(), storage_->state->period, periods, clock);
}

bool Simulation::advance_to(std::int64_t periods, double clock, std::uint64_t maximum) {
    if constexpr (preconditions_are_checked)
        stop_if(problem_with_time(periods, clock), "Simulation::advance_to");
    EventSpan span;
    run(span, maximum, periods, clock);
    if (span.events == maximum) return false;
    EngineState& state = *storage_->state;
    if (state.periods == periods && state.clock < clock) state.clock = clock;
    return true;
}

void Simulation::change_surroundings(InitialState scene, const Tuning& tuning) {
    if constexpr (preconditions_are_checked)
        stop_if(problem_with_change(scene, storage_->segments.size(), progress()),
                "Simulation::change_surroundings");
    const Vec2 shift = scene.path.segments.front().start - storage_->state->segments[0].start;
    scene.discs = storage_->current_scene().discs;
    shift_discs(scene.discs, shift);
    // A request to stop would leave a simulation without discs.
    Tuning uninterrupted = tuning;
    uninterrupted.is_stopped = {};
    *this = Simulation(scene, progress(), uninterrupted);
}

std::int64_t Simulation::periods() const { return storage_->state->periods; }
double Simulation::clock() const { return storage_->state->clock; }
std::size_t Simulation::size() const { return storage_->state->size; }
EventCounts Simulation::events() const { return storage_->progress().events; }
Progress Simulation::progress() const { return storage_->progress(); }
LoopCounts Simulation::loop_counts() const {
    const EngineState& state = *storage_->state;
    return {.invalidated = state.invalidated,
            .list_rebuilds = state.list_rebuilds,
            .overflows = state.overflows,
            .full_rebuilds = state.full_rebuilds,
            .bytes = storage_->memory.bytes(),
            .width = storage_->loop->width};
}

Disc Simulation::disc(std::size_t i) const {
    require(i < size(), "there is no disc of this number.", "Simulation::disc");
    return storage_->disc(static_cast<std::uint32_t>(i));
}

/// In a snapshot of another simulation, the columns might be shorter.
SWIRL_INLINE void Simulation::require_same_discs(const Snapshot& s) const {
    const EngineState& state = *storage_->state;
    const bool same_bodies = s.size() == 0 || s.are_spheres() == (state.spheres != nullptr);
    require(s.size() == state.size && same_bodies, "the snapshot is one of another simulation.",
            "Simulation::refresh");
}

/// `clock` is the time of the event that changed disc i, up to which its orientation is followed.
SWIRL_INLINE void Simulation::copy_flight(Snapshot& s, std::uint32_t i, double clock) const {
    const EngineState& state = *storage_->state;
    const HotDisc& d = state.discs[i];
    if (state.spheres != nullptr) copy_sphere(s, i, clock);
    s.set_flight(i, {d.position, d.velocity, d.time}, d.spin);
}
SWIRL_INLINE void Simulation::copy(Snapshot& s, std::uint32_t i, double clock) const {
    copy_flight(s, i, clock);
    s.angle[i] = storage_->state->cold(i).angle;
}

[[gnu::noinline]] void Simulation::copy_sphere(Snapshot& s, std::uint32_t i, double clock) const {
    if (!s.turned.empty()) s.turned[i] = s.quaternion(i, clock);
    const SphereState& sphere = storage_->state->spheres[i];
    s.set_floor_motion(i, sphere.rolling_spin, sphere.motion.acceleration);
}

/// Last, because the orientation of spheres follows from the floor's velocity up to now.
SWIRL_INLINE void Simulation::set_time(Snapshot& s) const {
    const EngineState& state = *storage_->state;
    const Segment& segment = state.segments[state.segment];
    s.periods = state.periods;
    s.clock = state.clock;
    s.container_centre = segment.position_at(state.clock);
    s.container_velocity = segment.velocity_at(state.clock);
}

Snapshot Simulation::snapshot() const {
    Snapshot s;
    const EngineState& state = *storage_->state;
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
    refresh(s, Event{.periods = 0,
                     .clock = 0.0,
                     .kind = EventKind::path_vertex,
                     .i = 0,
                     .j = 0,
                     .normal = {},
                     .impulse = {},
                     .overlap = 0.0});
    return s;
}

void Simulation::refresh(Snapshot& s, const Event& event) const {
    const EngineState& state = *storage_->state;
    require_same_discs(s);
    const bool is_vertex = event.kind == EventKind::path_vertex;
    require(is_vertex || (event.i < state.size && event.j < state.size),
            "the event names a disc that does not exist.", "Simulation::refresh");
    if (!is_vertex) {
        copy(s, event.i, event.clock);
        if (event.j != event.i) copy(s, event.j, event.clock);
    } else if (state.segment == 0 || s.on_floor) {
        for (std::uint32_t i = 0; i < state.size; ++i) copy(s, i, event.clock);
    }
    set_time(s);
}

void Simulation::refresh(Snapshot& s, const EventSpan& span) const {
    require_same_discs(s);
    const std::uint32_t size = storage_->state->size;
    const auto is_vertex = [](const EventDiscs& pair) { return pair.i == 0 && pair.j == 0; };
    const EventDiscs* const end = span.discs + std::min(span.events, EventSpan::capacity);
    const bool all = s.periods != storage_->state->periods ||
                     span.events > std::min<std::uint64_t>(EventSpan::capacity, size) ||
                     (s.on_floor && std::any_of(span.discs, end, is_vertex));
    if (all) {
        for (std::uint32_t i = 0; i < size; ++i) copy_flight(s, i, s.clock);
    } else {
        for (const EventDiscs* pair = span.discs; pair < end; ++pair) {
            copy_flight(s, pair->i, s.clock);
            copy_flight(s, pair->j, s.clock);
        }
    }
    set_time(s);
}

void Simulation::refresh_angles(Snapshot& s) const {
    require_same_discs(s);
    for (std::uint32_t i = 0; i < storage_->state->size; ++i)
        s.angle[i] = storage_->state->cold(i).angle;
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
    const EngineState& state = *storage_->state;
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
