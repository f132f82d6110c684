// The paper's method (SI, "Finding the next event"), as plainly as it can be said: all times, the
// soonest (reference_scan.hpp), apply. The engine must agree with it bit for bit.
#pragma once

#include <cstddef>
#include <vector>

#include "swirl/physics/collision_law.hpp"
#include "swirl/simulation/reference_scan.hpp"
#include "swirl/simulation/simulation.hpp"

namespace swirl {

/// Of the width asked for, which the processor must have.
SoonestMeeting soonest_meeting(Width width);

class ReferenceLoop {
  public:
    explicit ReferenceLoop(const InitialState& scene, Width width = Width::baseline)
        : scene_(scene), soonest_meeting_(soonest_meeting(width)) {
        for (auto* column : {&x_, &y_, &vx_, &vy_, &time_, &radius_, &wall_times_, &times_})
            column->resize(scene.discs.size());
        for (std::size_t k = 0; k < scene.discs.size(); ++k) show(k);
    }

    Event step() {
        const Leg leg = scene_.path.legs[leg_];
        const FlightColumns discs{x_.data(),    y_.data(),      vx_.data(),         vy_.data(),
                                  time_.data(), radius_.data(), scene_.discs.size()};
        const auto [time, i, j] = soonest_meeting_(discs, leg, scene_.container_radius,
                                                   wall_times_.data(), times_.data());
        if (leg.end <= time) return end_leg();
        return i == j ? hit_wall(i, leg, time) : hit_disc(i, j, time);
    }

    const Disc& disc(std::size_t i) const { return scene_.discs[i]; }

  private:
    /// Disc k has changed.
    void show(std::size_t k) {
        const Disc& d = scene_.discs[k];
        x_[k] = d.position.x, y_[k] = d.position.y;
        vx_[k] = d.velocity.x, vy_[k] = d.velocity.y;
        time_[k] = d.time, radius_[k] = d.radius;
    }
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
        show(i);
        show(j);
        return event(EventKind::disc_disc, t, i, j, J);
    }
    Event hit_wall(std::size_t i, const Leg& leg, double t) {
        Disc& a = scene_.discs[i];
        const Surface surface = at_contact(scene_.wall_surface, t - a.time);
        a = a.at(t);
        Body left = body(a), wall = wall_body(leg.velocity_at(t));
        const Impulse J = collide(left, wall, a.position - leg.position_at(t), surface);
        a.velocity = left.velocity, a.spin = left.spin;
        show(i);
        return event(EventKind::disc_wall, t, i, i, J);
    }
    Event end_leg() {
        const Event e = event(EventKind::path_vertex, scene_.path.legs[leg_].end, 0, 0, Impulse{});
        if (++leg_ < scene_.path.legs.size()) return e;
        for (Disc& d : scene_.discs) {
            d = d.at(e.clock);
            d.time = 0.0;
        }
        for (std::size_t k = 0; k < scene_.discs.size(); ++k) show(k);
        leg_ = 0;
        ++swirls_;
        return e;
    }
    Event event(EventKind kind, double t, std::size_t i, std::size_t j, const Impulse& J) const {
        return {swirls_, t, kind, static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j),
                {},      J, 0.0};
    }

    InitialState scene_;
    SoonestMeeting soonest_meeting_;
    std::vector<double> x_, y_, vx_, vy_, time_, radius_, wall_times_, times_;
    std::size_t leg_ = 0;
    std::int64_t swirls_ = 0;
};

}  // namespace swirl
