// The paper's method (SI, "Finding the next event"), as plainly as it can be said: all times, the
// soonest, apply. The engine must agree with it bit for bit.
#pragma once

#include <cstddef>

#include "physics/collision_law.hpp"
#include "physics/contact_time.hpp"
#include "simulation/simulation.hpp"

namespace swirl {

class ReferenceLoop {
  public:
    explicit ReferenceLoop(const Scene& scene) : scene_(scene) {}

    Event step() {
        const Leg leg = scene_.path.legs[leg_];
        double time = never;
        std::size_t i = 0, j = 0;
        for (std::size_t a = 0; a < scene_.discs.size(); ++a) {
            for (std::size_t b = a; b < scene_.discs.size(); ++b) {
                const double t =
                    a == b ? time_of_wall_contact(scene_.discs[a], leg, scene_.container_radius)
                           : time_of_contact(scene_.discs[a], scene_.discs[b]);
                if (t < time) {
                    time = t;
                    i = a;
                    j = b;
                }
            }
        }
        if (leg.end <= time) return end_leg();
        return i == j ? hit_wall(i, leg, time) : hit_disc(i, j, time);
    }

    const Disc& disc(std::size_t i) const { return scene_.discs[i]; }

  private:
    static Body body(const Disc& d) {
        return {d.velocity, d.spin, d.radius, 1.0 / d.mass, 1.0 / d.inertia};
    }
    Event hit_disc(std::size_t i, std::size_t j, double t) {
        Disc &a = scene_.discs[i], &b = scene_.discs[j];
        const Surface surface = at_contact(scene_.disc_surface, t - larger(a.time, b.time));
        a = a.at(t);
        b = b.at(t);
        Body left = body(a), right = body(b);
        const Impulse J = collide(left, right, b.position - a.position, surface);
        a.velocity = left.velocity, a.spin = left.spin;
        b.velocity = right.velocity, b.spin = right.spin;
        return event(EventKind::disc_disc, t, i, j, J);
    }
    Event hit_wall(std::size_t i, const Leg& leg, double t) {
        Disc& a = scene_.discs[i];
        const Surface surface = at_contact(scene_.wall_surface, t - a.time);
        a = a.at(t);
        Body left = body(a), wall = wall_body(leg.velocity_at(t));
        const Impulse J = collide(left, wall, a.position - leg.position_at(t), surface);
        a.velocity = left.velocity, a.spin = left.spin;
        return event(EventKind::disc_wall, t, i, i, J);
    }
    Event end_leg() {
        const Event e = event(EventKind::path_vertex, scene_.path.legs[leg_].end, 0, 0, Impulse{});
        if (++leg_ < scene_.path.legs.size()) return e;
        for (Disc& d : scene_.discs) {
            d = d.at(e.clock);
            d.time = 0.0;
        }
        leg_ = 0;
        ++swirls_;
        return e;
    }
    Event event(EventKind kind, double t, std::size_t i, std::size_t j, const Impulse& J) const {
        return {swirls_, t, kind, static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j),
                {},      J, 0.0};
    }

    Scene scene_;
    std::size_t leg_ = 0;
    std::int64_t swirls_ = 0;
};

}  // namespace swirl
