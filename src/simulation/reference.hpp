// The paper's method (SI, "Finding the next event") as one would tell it: find the times of all
// events that may come, take the first, apply it. One disc after the other and nothing remembered;
// the engine must agree with it bit for bit.
#pragma once

#include <cstddef>
#include <cstdint>

#include "swirl/physics/collision_law.hpp"
#include "swirl/physics/contact_time.hpp"
#include "swirl/physics/event.hpp"
#include "swirl/physics/initial_state.hpp"
#include "swirl/simulation/pending_event.hpp"

namespace swirl {

class Reference {
  public:
    explicit Reference(const InitialState& initial)
        : state_(initial), size_(static_cast<std::uint32_t>(initial.discs.size())) {}

    /// Says of the event what decides it; the normal and the overlap are left empty.
    Event step() { return apply(first_of_all()); }

    PendingEvent first_of_all() const {
        PendingEvent first{never, size_, size_};
        const auto consider = [&](const PendingEvent& event) {
            if (precedes(event, first)) first = event;
        };
        for (std::uint32_t i = 0; i < size_; ++i) {
            consider({time_of_wall_contact(disc(i), leg(), state_.container_radius), i, i});
            for (std::uint32_t j = i + 1; j < size_; ++j)
                consider({time_of_contact(disc(i), disc(j)), i, j});
        }
        return leg().end <= first.time ? PendingEvent{leg().end, size_, size_} : first;
    }

    Event apply(const PendingEvent& event) {
        if (event.disc == size_) return end_leg();
        return event.is_with_wall() ? hit_wall(event.disc, event.time)
                                    : hit_disc(event.disc, event.partner, event.time);
    }

    const Disc& disc(std::size_t i) const { return state_.discs[i]; }
    const Leg& leg() const { return state_.path.legs[leg_]; }

  private:
    static Body body(const Disc& d) {
        return {d.velocity, d.spin, d.radius, 1.0 / d.mass, 1.0 / d.inertia};
    }
    static void move_on(Disc& d, const Body& after) {
        d.velocity = after.velocity;
        d.spin = after.spin;
    }

    Event hit_disc(std::uint32_t i, std::uint32_t j, double t) {
        Disc &a = state_.discs[i], &b = state_.discs[j];
        const Surface surface = at_contact(state_.disc_surface, t - larger(a.time, b.time));
        a = a.at(t);
        b = b.at(t);
        Body body_a = body(a), body_b = body(b);
        const Impulse J = collide(body_a, body_b, b.position - a.position, surface);
        move_on(a, body_a);
        move_on(b, body_b);
        return {swirls_, t, EventKind::disc_disc, i, j, {}, J, 0.0};
    }

    Event hit_wall(std::uint32_t i, double t) {
        Disc& a = state_.discs[i];
        const Surface surface = at_contact(state_.wall_surface, t - a.time);
        a = a.at(t);
        Body body_a = body(a), wall = wall_body(leg().velocity_at(t));
        const Impulse J = collide(body_a, wall, a.position - leg().position_at(t), surface);
        move_on(a, body_a);
        return {swirls_, t, EventKind::disc_wall, i, i, {}, J, 0.0};
    }

    /// With the last leg of a swirl everybody is brought up to date and all clocks restart.
    Event end_leg() {
        const Event event{swirls_, leg().end, EventKind::path_vertex, 0, 0, {}, {}, 0.0};
        if (++leg_ < state_.path.legs.size()) return event;
        for (Disc& d : state_.discs) {
            d = d.at(event.clock);
            d.time = 0.0;
        }
        leg_ = 0;
        ++swirls_;
        return event;
    }

    InitialState state_;
    std::uint32_t size_;
    std::size_t leg_ = 0;
    std::int64_t swirls_ = 0;
};

}  // namespace swirl
