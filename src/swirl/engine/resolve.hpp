// The effect of an event: a collision of two discs, a collision with the wall, a sphere that begins
// to roll, or the container's next path segment. The event loop (event_loop.hpp) finds out which
// event comes next. The collision law is in collision_law.hpp; its coefficients are those of
// EngineState::disc_surface and EngineState::wall_surface, or of a law of your own (own_law.hpp).
#pragma once

#include "swirl/engine/collision_checks.hpp"
#include "swirl/engine/neighbors/engine_state.hpp"
#include "swirl/math/lanes.hpp"
#include "swirl/physics/collision_law.hpp"
#include "swirl/physics/event.hpp"

namespace swirl {
inline namespace SWIRL_TARGET {

/// Two bodies that touch at time t, before their collision. For the wall, j is the wall, and both
/// positions are that of i.
template <class Body>
struct Contact {
    const Body &i, &j;
    const Vec2 &at_i, &at_j;
    const Vec2& separation;
    double t;
};

/// How events read and change discs. A disc moves uniformly between collisions; the floor has no
/// effect.
struct Discs {
    using Body = swirl::Body;
    static constexpr bool have_floor = false;

    SWIRL_INLINE static Vec2 position_at(const EngineState& state, std::uint32_t i, double t) {
        return state.discs[i].flight().position_at(t);
    }
    SWIRL_INLINE static Body body_at(const EngineState& state, std::uint32_t i, double) {
        const HotDisc& d = state.discs[i];
        const Species& species = state.species[d.species];
        return {.velocity = d.velocity,
                .spin = d.spin,
                .radius = d.radius,
                .inverse_mass = species.inverse_mass,
                .inverse_inertia = species.inverse_inertia};
    }
    SWIRL_INLINE static Body wall(const Vec2& velocity) { return wall_body(velocity); }
    SWIRL_INLINE static double last_collision(const EngineState& state, std::uint32_t i) {
        return state.discs[i].time;
    }
    SWIRL_INLINE static bool change_with_segment(const EngineState&) { return false; }

    /// The coefficients of this contact.
    SWIRL_INLINE static const Surface& surface_of(const EngineState&, const Surface& surface,
                                                  const Contact<Body>&) {
        return surface;
    }
    /// The same coefficients with the TC model.
    SWIRL_INLINE static Surface at_contact(const EngineState&, const Surface& surface,
                                           double since_last, const Vec2&, const Vec2&) {
        return swirl::at_contact(surface, since_last);
    }

    /// Moves disc i to the position of its collision at time t and stores its new velocities.
    SWIRL_INLINE static void write_back(EngineState& state, std::uint32_t i, const Vec2& position,
                                        double t, const Body& body) {
        HotDisc& disc = state.discs[i];
        state.cold(i).angle = state.cold(i).angle + (t - disc.time) * disc.spin;
        store_four(&disc.position.x, position.x, position.y, body.velocity.x, body.velocity.y);
        *reinterpret_cast<Double2*>(&disc.time) = Double2{t, disc.radius};
        disc.spin = body.spin;
        ++disc.collisions;
    }
    /// All clocks restart: moves disc i to its position now, which is time 0 of the next period.
    SWIRL_INLINE static void synchronise(EngineState& state, std::uint32_t i, bool) {
        HotDisc& disc = state.discs[i];
        state.cold(i).angle = state.cold(i).angle + (state.clock - disc.time) * disc.spin;
        disc.position = disc.flight().position_at(state.clock);
        disc.time = 0.0;
        ++disc.collisions;
    }
};

/// How events read and change spheres. A sphere may slide, so its parabola follows from its state
/// and the floor's velocity.
struct Spheres {
    using Body = SphereBody;
    static constexpr bool have_floor = true;

    SWIRL_INLINE static Disc load(const EngineState& state, std::uint32_t i) {
        const HotDisc& d = state.discs[i];
        const Species& species = state.species[d.species];
        const SphereState& sphere = state.spheres[i];
        return {.position = d.position,
                .velocity = d.velocity,
                .angle = state.cold(i).angle,
                .spin = d.spin,
                .time = d.time,
                .radius = d.radius,
                .mass = species.mass,
                .inertia = species.inertia,
                .rolling_spin = sphere.rolling_spin,
                .last_collision = sphere.last_collision,
                .can_spin = species.can_spin};
    }
    /// Stores the state, and the motion that follows from it.
    SWIRL_INLINE static void store(EngineState& state, std::uint32_t i, const Disc& sphere) {
        HotDisc& d = state.discs[i];
        d.position = sphere.position;
        d.velocity = sphere.velocity;
        d.time = sphere.time;
        d.spin = sphere.spin;
        ++d.collisions;
        state.cold(i).angle = sphere.angle;
        state.spheres[i] = {
            floor_motion(sphere, state.floor, state.segments[state.segment].velocity),
            sphere.rolling_spin, sphere.last_collision};
    }
    SWIRL_INLINE static Parabola<double> flight(const EngineState& state, std::uint32_t i) {
        const HotDisc& d = state.discs[i];
        return {d.position, d.velocity, state.spheres[i].motion.acceleration, d.time};
    }

    SWIRL_INLINE static Vec2 position_at(const EngineState& state, std::uint32_t i, double t) {
        return flight(state, i).position_at(t);
    }
    SWIRL_INLINE static Body body_at(const EngineState& state, std::uint32_t i, double t) {
        const Disc d = moved_to(load(state, i), state.spheres[i].motion, t);
        const Species& species = state.species[state.discs[i].species];
        const swirl::Body planar{.velocity = d.velocity,
                                 .spin = d.spin,
                                 .radius = d.radius,
                                 .inverse_mass = species.inverse_mass,
                                 .inverse_inertia = species.inverse_inertia};
        return {planar, d.rolling_spin, species.can_spin};
    }
    SWIRL_INLINE static Body wall(const Vec2& velocity) { return wall_for_spheres(velocity); }
    SWIRL_INLINE static double last_collision(const EngineState& state, std::uint32_t i) {
        return state.spheres[i].last_collision;
    }
    SWIRL_INLINE static const Surface& surface_of(const EngineState&, const Surface& surface,
                                                  const Contact<Body>&) {
        return surface;
    }
    SWIRL_INLINE static Surface at_contact(const EngineState& state, const Surface& surface,
                                           double since_last, const Vec2& separation,
                                           const Vec2& relative_velocity) {
        return at_contact_on_floor(surface, since_last, state.floor, separation, relative_velocity);
    }
    /// True if a new segment changes the spheres' motion: the floor has another velocity.
    SWIRL_INLINE static bool change_with_segment(const EngineState& state) {
        return state.floor.deceleration != 0.0;
    }

    SWIRL_INLINE static void write_back(EngineState& state, std::uint32_t i, const Vec2& position,
                                        double t, const Body& body) {
        Disc sphere = load(state, i);
        sphere.angle = sphere.angle + (t - sphere.time) * sphere.spin;
        sphere.position = position;
        sphere.velocity = body.velocity;
        sphere.spin = body.spin;
        sphere.rolling_spin = body.rolling_spin;
        sphere.time = sphere.last_collision = t;
        store(state, i, sphere);
    }
    SWIRL_INLINE static void synchronise(EngineState& state, std::uint32_t i, bool clocks_restart) {
        Disc sphere = moved_to(load(state, i), state.spheres[i].motion, state.clock);
        if (clocks_restart) sphere.time = sphere.last_collision = 0.0;
        store(state, i, sphere);
    }
    /// Executes the event: sphere i stops sliding at time t.
    SWIRL_INLINE static Event begin_to_roll(EngineState& state, std::uint32_t i, double t) {
        store(state, i,
              set_rolling(load(state, i), state.spheres[i].motion, state.floor,
                          state.segments[state.segment].velocity));
        ++state.begun_to_roll;
        return {.periods = state.periods,
                .clock = t,
                .kind = EventKind::begins_to_roll,
                .i = i,
                .j = i,
                .normal = {},
                .impulse = {},
                .overlap = 0.0};
    }
};

/// Executes the collision of discs i < j at time t.
template <class Bodies>
SWIRL_INLINE Event collide_discs(EngineState& state, std::uint32_t i, std::uint32_t j, double t) {
    using Body = typename Bodies::Body;
    const Vec2 at_i = Bodies::position_at(state, i, t);
    const Vec2 at_j = Bodies::position_at(state, j, t);
    const Body before_i = Bodies::body_at(state, i, t), before_j = Bodies::body_at(state, j, t);
    Body body_i = before_i, body_j = before_j;
    const Vec2 s = at_j - at_i;
    const double since_last =
        t - larger(Bodies::last_collision(state, i), Bodies::last_collision(state, j));
    const Surface& surfaces =
        Bodies::surface_of(state, state.disc_surface, {before_i, before_j, at_i, at_j, s, t});
    state.elastic_by_tc += is_elastic_by_tc_model(surfaces, since_last);
    const Surface surface =
        Bodies::at_contact(state, surfaces, since_last, s, body_j.velocity - body_i.velocity);
    const Impulse impulse = collide(body_i, body_j, s, surface);
    if constexpr (internal_checks && !Bodies::have_floor) {
        const double rounding = rounding_of_contact(
            state.discs[i].flight(), state.discs[j].flight(), body_i.radius + body_j.radius, t);
        state.largest_rounding = larger(state.largest_rounding, rounding);
        check_disc_collision({before_i, body_i, before_i.velocity},
                             {before_j, body_j, before_i.velocity}, s, surfaces, impulse,
                             state.largest_rounding, state.overlapped_at_start);
    }
    Bodies::write_back(state, i, at_i, t, body_i);
    Bodies::write_back(state, j, at_j, t, body_j);
    ++state.disc_disc;
    const double distance = square_root(dot(s, s));
    return {.periods = state.periods,
            .clock = t,
            .kind = EventKind::disc_disc,
            .i = i,
            .j = j,
            .normal = {s.x / distance, s.y / distance},
            .impulse = impulse,
            .overlap = body_i.radius + body_j.radius - distance};
}

/// Executes the collision of disc i with the wall at time t. The wall is a body of infinite mass
/// that moves with the container.
template <class Bodies>
SWIRL_INLINE Event collide_with_wall(EngineState& state, std::uint32_t i, double t) {
    using Body = typename Bodies::Body;
    const Flight<double> centre = state.segments[state.segment].flight_at(t);
    if (state.on_arc()) state.arc_centre = centre;
    const Vec2 at = Bodies::position_at(state, i, t);
    const Body before = Bodies::body_at(state, i, t);
    Body body = before, wall = Bodies::wall(centre.velocity);
    const Vec2 s = at - centre.position;
    const double since_last = t - Bodies::last_collision(state, i);
    const Surface& surfaces =
        Bodies::surface_of(state, state.wall_surface, {before, wall, at, at, s, t});
    state.elastic_by_tc += is_elastic_by_tc_model(surfaces, since_last);
    const Surface surface =
        Bodies::at_contact(state, surfaces, since_last, s, wall.velocity - body.velocity);
    const Impulse impulse = collide(body, wall, s, surface);
    if constexpr (internal_checks && !Bodies::have_floor) {
        const double clearance = state.container_radius - body.radius;
        const double rounding = rounding_of_wall_contact(
            state.discs[i].flight(), state.segments[state.segment], clearance, t);
        state.largest_rounding = larger(state.largest_rounding, rounding);
        check_wall_collision({before, body, wall.velocity}, {wall, wall, wall.velocity}, s,
                             clearance, surfaces, impulse, state.largest_rounding,
                             state.overlapped_at_start);
    }
    Bodies::write_back(state, i, at, t, body);
    ++state.disc_wall;
    const double distance = square_root(dot(s, s));
    return {.periods = state.periods,
            .clock = t,
            .kind = EventKind::disc_wall,
            .i = i,
            .j = i,
            .normal = {s.x / distance, s.y / distance},
            .impulse = impulse,
            .overlap = distance - (state.container_radius - body.radius)};
}

/// The container begins its next segment. At the end of a period all discs are synchronised and all
/// clocks restart with state.clock = 0, so times stay short and precise in a run of any length. If
/// friction against the floor acts, spheres are synchronised at every segment.
template <class Bodies>
SWIRL_INLINE Event start_next_segment(EngineState& state) {
    state.clock = state.segments[state.segment].end;
    ++state.path_vertex;
    const Event event{.periods = state.periods,
                      .clock = state.clock,
                      .kind = EventKind::path_vertex,
                      .i = 0,
                      .j = 0,
                      .normal = {},
                      .impulse = {},
                      .overlap = 0.0};
    const bool is_last = ++state.segment == state.segment_count;
    if (!is_last && !Bodies::change_with_segment(state)) return event;
    if (is_last) state.segment = 0;
    for (std::uint32_t i = 0; i < state.size; ++i) Bodies::synchronise(state, i, is_last);
    if (!is_last) return event;
    state.clock = 0.0;
    ++state.periods;
    return event;
}

}  // namespace SWIRL_TARGET
}  // namespace swirl
