// The rotation of discs about their centre of mass, followed from event to event. What its numbers
// mean is in measure/cluster_rotation.hpp, which owns them; the event loop follows and samples them
// (engine/rotation_observer.hpp).
//
// Colliding discs push each other, so only the wall changes the velocity of the centre of mass, by
// −J/M. Between two such impulses it moves uniformly.
//
// Every function here is inlined and works on plain pointers, because the event loop includes this
// header once for each vector width (engine/event_loop.hpp).
#pragma once

#include <cstddef>
#include <cstdint>

#include "swirl/math/real.hpp"
#include "swirl/math/vec2.hpp"
#include "swirl/physics/event.hpp"

namespace swirl {

/// The discs, each in its state at its own time `held_at`, as in a snapshot (snapshot.hpp).
struct RotationColumns {
    const double *x, *y, *vx, *vy, *held_at;
    const double *ax = nullptr, *ay = nullptr;  // accelerations of spheres; null for discs

    /// Of a disc, which has no acceleration.
    SWIRL_INLINE Vec2 position(std::size_t i, double clock) const {
        const double elapsed = clock - held_at[i];
        return {x[i] + elapsed * vx[i], y[i] + elapsed * vy[i]};
    }
};

/// The centre of mass of `discs` discs, stored like a disc: its state at `held_at`.
struct RotationCentre {
    std::ptrdiff_t discs;
    double held_at, mass;
    Vec2 position, velocity;

    SWIRL_INLINE Vec2 at(double clock) const { return position + (clock - held_at) * velocity; }
    /// The change by an impulse of the wall.
    SWIRL_INLINE void apply_wall_impulse(const Event& event) {
        position = at(event.clock);
        held_at = event.clock;
        const Vec2 tangent{event.normal.y, -event.normal.x};
        const Vec2 impulse_on_wall =
            event.impulse.normal * event.normal + event.impulse.tangential * tangent;
        velocity = velocity - Vec2{impulse_on_wall.x / mass, impulse_on_wall.y / mass};
    }
};

/// (individual, rigid), in a register.
typedef double RotationRates __attribute__((vector_size(16)));

/// The sums over discs, compiled for one vector width (measure/cluster_rotation_kernel.hpp). Every
/// width gives bitwise the same.
struct RotationKernel {
    /// The centre of mass at `clock`.
    RotationCentre (*centre)(const RotationColumns& columns, const double* mass,
                             std::ptrdiff_t discs, double clock);
    /// The rotation about it. The individual mean omits discs with r² ≤ `closest_square`.
    RotationRates (*rates)(const RotationColumns& columns, const RotationCentre& centre,
                           double clock, double closest_square);
};

/// Sums over samples of the rotation.
struct RotationSums {
    double individual = 0.0, rigid = 0.0, samples = 0.0;

    SWIRL_INLINE void add(const RotationRates& rates, double weight = 1.0) {
        individual += weight * rates[0];
        rigid += weight * rates[1];
        samples += weight;
    }
};

/// Seen from a point that moves uniformly between events, the path of a disc is a polygon. Counts
/// the full turns: where a side crosses the ray at angle 0.
struct SweptSides {
    Vec2* from = nullptr;  // directions to the discs at their last corners; null: not followed
    double* turns = nullptr;

    /// A side of disc i ends at `to`, seen from the point.
    SWIRL_INLINE void end_side(std::size_t i, const Vec2& to) const {
        const Vec2 begin = from[i];
        from[i] = to;
        if ((begin.y < 0.0) == (to.y < 0.0)) return;
        const double side = cross(begin, to);
        if (begin.y < 0.0 && side > 0.0) *turns += 1.0;
        if (to.y < 0.0 && side < 0.0) *turns -= 1.0;
    }
};

/// A template, so that files which do not call it do not contain it.
template <class Columns>
[[gnu::noinline]] static void end_all_sides(const SweptSides& sides, const Columns& columns,
                                            std::ptrdiff_t discs, double clock, const Vec2& point) {
    for (std::ptrdiff_t k = 0; k < discs; ++k) {
        const auto i = static_cast<std::size_t>(k);
        sides.end_side(i, columns.position(i, clock) - point);
    }
}

/// Follows the rotation from event to event. A view: what it points to has an owner.
struct RotationFollower {
    const RotationKernel* kernel;
    RotationCentre* centre;
    RotationSums *by_event, *by_time;
    SweptSides angles;
    const double* mass;
    std::ptrdiff_t discs;
    double closest_square;
    bool on_floor;  // the floor accelerates spheres all the time

    /// After the event, at whose end the clock has this value: 0 if a period has ended.
    SWIRL_INLINE void follow(const RotationColumns& columns, const Event& event, double clock,
                             bool period_ended) const {
        if (event.kind == EventKind::disc_wall) {
            if (!on_floor) centre->apply_wall_impulse(event);
        } else if (event.kind != EventKind::disc_disc && !on_floor) {
            // Summed up again, which removes the accumulated rounding.
            if (period_ended || angles.from == nullptr) renew_centre(columns, clock);
        }
        if (angles.from != nullptr) end_sides(columns, event);
    }
    /// One sample by event, after the events passed to follow().
    SWIRL_INLINE RotationRates sample(const RotationColumns& columns, double clock) const {
        if (on_floor || centre->discs != discs) renew_centre(columns, clock);
        return sample_about_centre(columns, clock);
    }
    /// The same if follow() is not called after every event.
    SWIRL_INLINE RotationRates sample_alone(const RotationColumns& columns, double clock) const {
        renew_centre(columns, clock);
        return sample_about_centre(columns, clock);
    }
    SWIRL_INLINE RotationRates sample_by_time(const RotationColumns& columns, double clock,
                                              double weight = 1.0) const {
        const RotationCentre now = kernel->centre(columns, mass, discs, clock);
        const RotationRates rates = kernel->rates(columns, now, clock, closest_square);
        by_time->add(rates, weight);
        return rates;
    }

  private:
    SWIRL_INLINE void renew_centre(const RotationColumns& columns, double clock) const {
        *centre = kernel->centre(columns, mass, discs, clock);
    }
    SWIRL_INLINE RotationRates sample_about_centre(const RotationColumns& columns,
                                                   double clock) const {
        const RotationRates rates = kernel->rates(columns, *centre, clock, closest_square);
        by_event->add(rates);
        return rates;
    }
    /// Collisions end the flights of two discs. An impulse of the wall bends those of all discs,
    /// seen from the centre of mass.
    SWIRL_INLINE void end_sides(const RotationColumns& columns, const Event& event) const {
        if (event.kind == EventKind::path_vertex) return;
        const Vec2 point = centre->at(event.clock);
        if (event.kind == EventKind::disc_wall)
            return end_all_sides(angles, columns, discs, event.clock, point);
        angles.end_side(event.i, columns.position(event.i, event.clock) - point);
        angles.end_side(event.j, columns.position(event.j, event.clock) - point);
    }
};

/// When a run samples its rotation, and what else it adds up at the samples by time.
struct RotationSampling {
    RotationFollower rotation;
    // By event: after every `interval` events, of which `left` are left.
    std::uint64_t interval, *left;
    // By time: sample `index` of `per_period` is next, at `due`.
    std::int64_t index;
    int per_period;
    double due;
    bool pauses;           // the loop returns after each of them
    double *spin, *spins;  // sum and number of mean spins, in units of Ω
    double swirl_sign;
    double paused_at = never;  // the time of the sample at which the loop returned

    SWIRL_INLINE void set_due(double period) {
        due = index < per_period ? period * static_cast<double>(index) / per_period : never;
    }
};

}  // namespace swirl
