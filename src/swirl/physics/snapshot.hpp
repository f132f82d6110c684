// The system at one instant, as an observer sees it: from the engine, from a file, or from a
// camera's tracks. Everything in measure/ and render/ takes a Snapshot and nothing else.
//
// Data is stored in columns, with one entry per disc. Each disc's state is that at its own time
// `held_at`, and it moves uniformly from there; position(i) is evaluated at `clock`. So an observer
// of every event receives two changed discs, not N. In recorded data held_at = clock.
//
// Spheres on a floor may be accelerated. Code that reads the columns directly uses up_to_date(),
// where all states are those at the current time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "swirl/math/vec2.hpp"
#include "swirl/physics/disc.hpp"
#include "swirl/physics/floor.hpp"
#include "swirl/physics/orientation.hpp"

namespace swirl {

struct Snapshot {
    std::int64_t periods = 0;  // whole periods since the beginning
    double clock = 0.0;        // time since the start of the current period
    double period = 0.0;       // T; Ω = 2π/T
    // If T changes during the run: the last change, after this many periods and at this time.
    std::int64_t periods_at_change = 0;
    double time_at_change = 0.0;
    Vec2 container_centre{0.0, 0.0}, container_velocity{0.0, 0.0};
    double container_radius = 0.0;

    // spin and angle are NaN if unknown (a camera's tracks).
    std::vector<double> x, y, vx, vy, angle, spin, held_at;
    std::vector<double> radius, mass, inertia;
    // For spheres (empty for discs): the other two spins, and the acceleration by the floor.
    std::vector<double> spin_x, spin_y, ax, ay;
    // The orientation of each sphere at its time `held_at`. To follow orientations, an observer
    // starts with one quaternion per sphere; otherwise the column is empty.
    std::vector<Quaternion> turned;
    std::vector<double> can_spin;  // Disc::can_spin; empty if all particles can
    bool on_floor = false;         // friction against the floor acts on the centre of mass
    bool lie_flat = false;         // coins: they have the columns of spheres, but only one spin

    /// Spheres or coins.
    bool are_spheres() const { return !ax.empty(); }
    bool are_balls() const { return are_spheres() && !lie_flat; }
    std::size_t size() const { return x.size(); }
    double time() const { return period_start() + clock; }
    double period_start() const {
        return time_at_change + static_cast<double>(periods - periods_at_change) * period;
    }
    /// Whole periods and the fraction of the present one.
    double periods_passed() const {
        if (periods_at_change == 0) return time() / period;
        return static_cast<double>(periods) + clock / period;
    }

    Vec2 position(std::size_t i) const {
        const double elapsed = clock - held_at[i];
        const Vec2 p{x[i] + elapsed * vx[i], y[i] + elapsed * vy[i]};
        if (!are_spheres()) return p;
        const double half_square = 0.5 * elapsed * elapsed;
        return {p.x + half_square * ax[i], p.y + half_square * ay[i]};
    }
    Vec2 velocity(std::size_t i) const {
        if (!are_spheres()) return {vx[i], vy[i]};
        const double elapsed = clock - held_at[i];
        return {vx[i] + elapsed * ax[i], vy[i] + elapsed * ay[i]};
    }
    /// Orientation of sphere i, if orientations are followed: now, or at another time of the clock
    /// without an event of the sphere in between.
    Quaternion quaternion(std::size_t i) const { return quaternion(i, clock); }
    Quaternion quaternion(std::size_t i, double t) const {
        return turned_for(turned[i], t - held_at[i], {spin_x[i], spin_y[i]}, spin[i], spin_rate(i));
    }
    /// True if the sphere rolls or rests on the floor: its spins are then exactly those of rolling.
    bool rolls(std::size_t i) const {
        const Vec2 over_floor = Vec2{vx[i], vy[i]} - container_velocity;
        const Vec2 rolling = spin_of_rolling(over_floor, radius[i]);
        return rolling.x == spin_x[i] && rolling.y == spin_y[i];
    }
    /// (dω_x/dt, dω_y/dt) of a sphere. Only rolling resistance accelerates one that rolls.
    Vec2 spin_rate(std::size_t i) const {
        if (lie_flat) return {0.0, 0.0};
        if (rolls(i)) return spin_of_rolling({ax[i], ay[i]}, radius[i]);
        return rolling_spin_rate({ax[i], ay[i]}, mass[i], radius[i], inertia[i]);
    }
    double orientation(std::size_t i) const { return angle[i] + (clock - held_at[i]) * spin[i]; }

    Disc disc(std::size_t i) const {
        Disc d{.position = {x[i], y[i]},
               .velocity = {vx[i], vy[i]},
               .angle = angle[i],
               .spin = spin[i],
               .time = held_at[i],
               .radius = radius[i],
               .mass = mass[i],
               .inertia = inertia[i]};
        if (are_spheres()) d.rolling_spin = {spin_x[i], spin_y[i]};
        if (!can_spin.empty()) d.can_spin = can_spin[i];
        return d;
    }
    /// 1/I for the spin of particle i about the vertical axis.
    double inverse_inertia(std::size_t i) const {
        return (can_spin.empty() ? 1.0 : can_spin[i]) / inertia[i];
    }
    /// Writes a snapshot with all states at the current time to `now`, whose memory is reused.
    void up_to_date(Snapshot& now) const {
        now = *this;
        for (std::size_t i = 0; i < size(); ++i) {
            if (!turned.empty()) now.turned[i] = quaternion(i);
            FloorMotion motion;
            if (are_spheres())
                motion = {{ax[i], ay[i]}, spin_rate(i), never, rolls(i), container_velocity};
            now.set(i, moved_to(disc(i), motion, clock));
        }
    }
    Snapshot up_to_date() const {
        Snapshot now;
        up_to_date(now);
        return now;
    }
    /// Sets the flight and the spin of disc i after an event of a simulation.
    void set_flight(std::size_t i, const Flight<double>& flight, double new_spin) {
        x[i] = flight.position.x;
        y[i] = flight.position.y;
        vx[i] = flight.velocity.x;
        vy[i] = flight.velocity.y;
        spin[i] = new_spin;
        held_at[i] = flight.time;
    }
    /// The same and the angle.
    void set_motion(std::size_t i, const Flight<double>& flight, double new_angle,
                    double new_spin) {
        set_flight(i, flight, new_spin);
        angle[i] = new_angle;
    }
    void set_floor_motion(std::size_t i, const Vec2& rolling_spin, const Vec2& acceleration) {
        spin_x[i] = rolling_spin.x;
        spin_y[i] = rolling_spin.y;
        ax[i] = acceleration.x;
        ay[i] = acceleration.y;
    }
    void set(std::size_t i, const Disc& d) {
        set_motion(i, d.flight(), d.angle, d.spin);
        if (are_spheres()) set_floor_motion(i, d.rolling_spin, {0.0, 0.0});
        radius[i] = d.radius;
        mass[i] = d.mass;
        inertia[i] = d.inertia;
        if (d.can_spin != 1.0 && can_spin.empty()) can_spin.resize(size(), 1.0);
        if (!can_spin.empty()) can_spin[i] = d.can_spin;
    }
    /// A snapshot of spheres remains one, unless n is 0.
    void resize(std::size_t n) {
        if (are_spheres())
            for (auto* column : {&spin_x, &spin_y, &ax, &ay}) column->resize(n);
        if (!turned.empty()) turned.resize(n);
        if (!can_spin.empty()) can_spin.resize(n, 1.0);
        for (auto* column : {&x, &y, &vx, &vy, &angle, &spin, &held_at, &radius, &mass, &inertia})
            column->resize(n);
    }
    void resize_for_spheres(std::size_t n) {
        for (auto* column : {&spin_x, &spin_y, &ax, &ay}) column->resize(n);
        resize(n);
    }
};

}  // namespace swirl
