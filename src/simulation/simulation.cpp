#include "simulation/simulation.hpp"

#include <cstring>

#include "physics/contact_time.hpp"

namespace swirl {

struct Simulation::Machine {
    Scene scene;
    std::int64_t swirls = 0;
    double clock = 0.0;
    std::size_t leg = 0;
    EventCounts events;

    struct Next {
        double time;
        std::size_t i, j;
    };
    Next next() const {
        Next soonest{never, 0, 0};
        const auto& d = scene.discs;
        for (std::size_t i = 0; i < d.size(); ++i) {
            const double wall =
                time_of_wall_contact(d[i], scene.path.legs[leg], scene.container_radius);
            if (wall < soonest.time) soonest = {wall, i, i};
            for (std::size_t j = i + 1; j < d.size(); ++j) {
                const double t = time_of_contact(d[i], d[j]);
                if (t < soonest.time) soonest = {t, i, j};
            }
        }
        return soonest;
    }
    static Body body(const Disc& d) {
        return {d.velocity, d.spin, d.radius, 1.0 / d.mass, 1.0 / d.inertia};
    }
    Event execute(const Next& n) {
        const Leg& now = scene.path.legs[leg];
        if (now.end <= n.time) {
            clock = now.end;
            const Event event{swirls, clock, EventKind::path_vertex, 0, 0, {}, {}, 0.0};
            ++events.path_vertex;
            if (++leg == scene.path.legs.size()) {
                for (Disc& d : scene.discs) {
                    d = d.at(clock);
                    d.time = 0.0;
                }
                leg = 0;
                clock = 0.0;
                ++swirls;
            }
            return event;
        }
        clock = n.time;
        const bool wall = n.i == n.j;
        Disc& i = scene.discs[n.i];
        Disc& j = scene.discs[n.j];
        i = i.at(clock);
        if (!wall) j = j.at(clock);
        Body a = body(i), b = wall ? wall_body(now.velocity_at(clock)) : body(j);
        const Vec2 s = wall ? i.position - now.position_at(clock) : j.position - i.position;
        const Impulse impulse = collide(a, b, s, wall ? scene.wall_surface : scene.disc_surface);
        i.velocity = a.velocity;
        i.spin = a.spin;
        if (!wall) {
            j.velocity = b.velocity;
            j.spin = b.spin;
        }
        const double distance = square_root(dot(s, s));
        ++(wall ? events.disc_wall : events.disc_disc);
        return {
            swirls,
            clock,
            wall ? EventKind::disc_wall : EventKind::disc_disc,
            static_cast<std::uint32_t>(n.i),
            static_cast<std::uint32_t>(n.j),
            (1.0 / distance) * s,
            impulse,
            wall ? distance - (scene.container_radius - i.radius) : i.radius + j.radius - distance};
    }
};

Simulation::Simulation(const Scene& scene) : machine_(new Machine{scene, 0, 0.0, 0, {}}) {}
Simulation::~Simulation() = default;
Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;

Event Simulation::step() { return machine_->execute(machine_->next()); }

void Simulation::advance_to(std::int64_t swirls, double clock) {
    Machine& m = *machine_;
    for (;;) {
        const auto next = m.next();
        const double leg_end = m.scene.path.legs[m.leg].end;
        const double time = next.time < leg_end ? next.time : leg_end;
        if (m.swirls > swirls || (m.swirls == swirls && time > clock)) break;
        m.execute(next);
    }
    if (m.swirls == swirls && m.clock < clock) m.clock = clock;
}

std::int64_t Simulation::swirls() const { return machine_->swirls; }
double Simulation::clock() const { return machine_->clock; }
const EventCounts& Simulation::events() const { return machine_->events; }

Snapshot Simulation::snapshot() const {
    Snapshot s;
    s.resize(machine_->scene.discs.size());
    s.period = machine_->scene.path.period;
    s.container_radius = machine_->scene.container_radius;
    for (std::size_t i = 0; i < s.size(); ++i) s.set(i, machine_->scene.discs[i]);
    refresh(s, Event{0, 0, EventKind::path_vertex, 0, 0, {}, {}, 0.0});
    return s;
}

void Simulation::refresh(Snapshot& s, const Event& event) const {
    const Machine& m = *machine_;
    const Leg& leg = m.scene.path.legs[m.leg];
    s.swirls = m.swirls;
    s.clock = m.clock;
    s.container_centre = leg.position_at(m.clock);
    s.container_velocity = leg.velocity_at(m.clock);
    if (event.kind != EventKind::path_vertex) {
        s.set(event.i, m.scene.discs[event.i]);
        s.set(event.j, m.scene.discs[event.j]);
    } else if (m.leg == 0) {
        for (std::size_t i = 0; i < s.size(); ++i) s.set(i, m.scene.discs[i]);
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
    const Machine& m = *machine_;
    mix(static_cast<std::uint64_t>(m.swirls));
    mix(m.leg);
    mix(m.events.total());
    for (const Disc& d : m.scene.discs)
        for (const double x :
             {d.position.x, d.position.y, d.velocity.x, d.velocity.y, d.angle, d.spin, d.time})
            mix_double(x);
    return hash;
}

}  // namespace swirl
