// How discs, coins and spheres move between events and what an event does to them, for the
// reference implementation (reference.hpp): one body at a time, straight from physics/.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "swirl/physics/collision_law.hpp"
#include "swirl/physics/contact_law.hpp"
#include "swirl/physics/contact_time.hpp"
#include "swirl/physics/initial_state.hpp"

namespace swirl {

class ReferenceBodies {
  public:
    explicit ReferenceBodies(const InitialState& initial)
        : state_(initial),
          motions_(initial.discs.size()),
          floor_velocity_(initial.path.segments.front().velocity) {
        for (std::uint32_t i = 0; i < size(); ++i) update_motion(i);
    }

    std::uint32_t size() const { return static_cast<std::uint32_t>(state_.discs.size()); }
    const std::vector<Disc>& discs() const { return state_.discs; }
    const Disc& disc(std::size_t i) const { return state_.discs[i]; }

    double contact_time(std::uint32_t i, std::uint32_t j) const {
        if (!are_spheres()) return time_of_contact(disc(i), disc(j));
        return time_of_contact(
            Encounter<double>(parabola(disc(i), motions_[i]), parabola(disc(j), motions_[j]),
                              motions_[i].begins_to_roll, motions_[j].begins_to_roll,
                              disc(i).radius + disc(j).radius));
    }
    double wall_time(std::uint32_t i, const Segment& segment) const {
        if (!are_spheres()) return time_of_wall_contact(disc(i), segment, state_.container_radius);
        return time_of_wall_contact(parabola(disc(i), motions_[i]), motions_[i].begins_to_roll,
                                    segment, state_.container_radius - disc(i).radius);
    }
    double begins_to_roll(std::uint32_t i) const { return motions_[i].begins_to_roll; }

    Impulse collide_pair(std::uint32_t i, std::uint32_t j, double t, const Segment& segment) {
        Disc &a = state_.discs[i], &b = state_.discs[j];
        const double since_last = t - larger(last_collision(i), last_collision(j));
        move_to(i, t);
        move_to(j, t);
        const Vec2 separation = b.position - a.position, centre = segment.position_at(t);
        const Surface of_discs =
            are_spheres() ? surface_by_law(state_.disc_surface, sphere_body(a), sphere_body(b),
                                           separation, a.position - centre, b.position - centre)
                          : surface_by_law(state_.disc_surface, body(a), body(b), separation,
                                           a.position - centre, b.position - centre);
        const Surface surface =
            surface_at_contact(of_discs, since_last, separation, b.velocity - a.velocity);
        const Impulse J = are_spheres()
                              ? collide_pair(a, b, sphere_body(a), sphere_body(b), surface)
                              : collide_pair(a, b, body(a), body(b), surface);
        update_motion(i);
        update_motion(j);
        return J;
    }
    Impulse collide_with_wall(std::uint32_t i, double t, const Segment& segment) {
        Disc& a = state_.discs[i];
        const double since_last = t - last_collision(i);
        move_to(i, t);
        const Vec2 from_centre = a.position - segment.position_at(t), u = segment.velocity_at(t);
        const Surface of_wall =
            are_spheres() ? surface_by_law(state_.wall_surface, sphere_body(a), wall_for_spheres(u),
                                           from_centre, from_centre, {0.0, 0.0})
                          : surface_by_law(state_.wall_surface, body(a), wall_body(u), from_centre,
                                           from_centre, {0.0, 0.0});
        const Surface surface =
            surface_at_contact(of_wall, since_last, from_centre, u - a.velocity);
        const Impulse J =
            are_spheres()
                ? collide_with_wall(a, sphere_body(a), wall_for_spheres(u), from_centre, surface)
                : collide_with_wall(a, body(a), wall_body(u), from_centre, surface);
        update_motion(i);
        return J;
    }
    /// Returns the time.
    double begin_to_roll(std::uint32_t i) {
        state_.discs[i] = set_rolling(disc(i), motions_[i], state_.floor, floor_velocity_);
        update_motion(i);
        return disc(i).time;
    }

    /// At the end of a period all discs are synchronised and all clocks restart. At the end of
    /// every segment the floor gets another velocity, so spheres on it are synchronised.
    void end_segment(double t, const Segment& next, bool ends_period) {
        floor_velocity_ = next.velocity;
        if (!ends_period && (!are_spheres() || state_.floor.deceleration == 0.0)) return;
        for (std::uint32_t i = 0; i < size(); ++i) {
            move_to(i, t);
            if (ends_period) state_.discs[i].time = state_.discs[i].last_collision = 0.0;
            update_motion(i);
        }
    }

  private:
    /// Spheres or coins.
    bool are_spheres() const { return state_.shape != Shape::disc; }
    /// Updates how the floor moves sphere i from now on.
    void update_motion(std::uint32_t i) {
        if (are_spheres()) motions_[i] = floor_motion(disc(i), state_.floor, floor_velocity_);
    }
    /// The last collision in the sense of the TC model.
    double last_collision(std::uint32_t i) const {
        return are_spheres() ? disc(i).last_collision : disc(i).time;
    }
    void move_to(std::uint32_t i, double t) {
        state_.discs[i] = are_spheres() ? moved_to(disc(i), motions_[i], t) : disc(i).at(t);
    }
    /// The coefficients by a law of your own, if the scene has one.
    template <class AnyBody>
    Surface surface_by_law(const Surface& surface, const AnyBody& i, const AnyBody& j,
                           const Vec2& separation, const Vec2& from_centre_i,
                           const Vec2& from_centre_j) const {
        if (!state_.law) return surface;
        Impact impact = impact_of(i, j, separation);
        impact.from_centre_i = from_centre_i;
        impact.from_centre_j = from_centre_j;
        impact.container_radius = state_.container_radius;
        return state_.law.surface_of(state_.law.law.get(), surface, impact);
    }
    static Body body(const Disc& d) {
        return {.velocity = d.velocity,
                .spin = d.spin,
                .radius = d.radius,
                .inverse_mass = 1.0 / d.mass,
                .inverse_inertia = d.inverse_inertia()};
    }
    static SphereBody sphere_body(const Disc& d) {
        const Body planar{.velocity = d.velocity,
                          .spin = d.spin,
                          .radius = d.radius,
                          .inverse_mass = 1.0 / d.mass,
                          .inverse_inertia = 1.0 / d.inertia};
        return {planar, d.rolling_spin, d.can_spin};
    }
    static void set_velocities(Disc& d, const Body& after) {
        d.velocity = after.velocity;
        d.spin = after.spin;
    }
    static void set_velocities(Disc& d, const SphereBody& after) {
        set_velocities(d, static_cast<const Body&>(after));
        d.rolling_spin = after.rolling_spin;
        d.last_collision = d.time;
    }
    Surface surface_at_contact(const Surface& surface, double since_last, const Vec2& separation,
                               const Vec2& relative_velocity) const {
        return are_spheres() ? at_contact_on_floor(surface, since_last, state_.floor, separation,
                                                   relative_velocity)
                             : at_contact(surface, since_last);
    }
    template <class AnyBody>
    static Impulse collide_pair(Disc& a, Disc& b, AnyBody body_a, AnyBody body_b,
                                const Surface& surface) {
        const Impulse J = collide(body_a, body_b, b.position - a.position, surface);
        set_velocities(a, body_a);
        set_velocities(b, body_b);
        return J;
    }
    template <class AnyBody>
    static Impulse collide_with_wall(Disc& a, AnyBody body_a, AnyBody wall, const Vec2& from_centre,
                                     const Surface& surface) {
        const Impulse J = collide(body_a, wall, from_centre, surface);
        set_velocities(a, body_a);
        return J;
    }

    InitialState state_;
    std::vector<FloorMotion> motions_;  // empty without spheres
    Vec2 floor_velocity_;
};

}  // namespace swirl
