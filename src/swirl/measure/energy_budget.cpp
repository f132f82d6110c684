#include "swirl/measure/energy_budget.hpp"

#include <cmath>

#include "swirl/physics/body.hpp"

namespace swirl {
namespace {

Body body_of(const Snapshot& s, std::size_t i) {
    return {s.velocity(i), s.spin[i], s.radius[i], 1.0 / s.mass[i], s.inverse_inertia(i)};
}

/// R²/I of the rolling of the spheres of an event.
double rolling_lever(const Snapshot& s, const Event& event) {
    const auto of = [&](std::size_t i) { return s.radius[i] * s.radius[i] / s.inertia[i]; };
    return of(event.i) + (event.kind == EventKind::disc_wall ? 0.0 : of(event.j));
}

void add(EnergyChange& sum, const EnergyChange& change) {
    sum.work += change.work;
    sum.friction_loss += change.friction_loss;
    sum.inelastic_loss += change.inelastic_loss;
}

}  // namespace

EnergyChange energy_change(const Event& event, const Snapshot& after) {
    if (event.kind != EventKind::disc_disc && event.kind != EventKind::disc_wall) return {};
    const bool wall = event.kind == EventKind::disc_wall;
    const Vec2 n = event.normal, r{n.y, -n.x};
    const Impulse& J = event.impulse;
    const Body i = body_of(after, event.i);
    const Body j = wall ? wall_body(after.container_velocity) : body_of(after, event.j);

    // |n|² is 1 up to rounding. This rounding is not random, since all contacts of a pair have the
    // same distance to the last digits. The impulse acted along this very n, so |n|² belongs here.
    // Doubles above 1 are half as dense as those below it, so |n|² itself would be rounded to one
    // side, and the budget with it: by up to three rounding errors per event. |n|² − 1 has no
    // such bias.
    const double long_square = larger(n.x * n.x, n.y * n.y);
    const double excess = (long_square - 1.0) + smaller(n.x * n.x, n.y * n.y);
    const double inverse_masses = i.inverse_mass + j.inverse_mass;
    const double inverse_spins =
        i.radius * i.radius * i.inverse_inertia + j.radius * j.radius * j.inverse_inertia;
    const Vec2 g = j.velocity - i.velocity;
    const double normal_after = dot(g, n);
    const double slip_after = dot(g, r) + i.radius * i.spin + j.radius * j.spin;

    EnergyChange change;
    if (wall) {
        change.push = -1.0 * (J.normal * n + J.tangential * r);
        change.work = dot(change.push, after.container_velocity);
    }
    const double half_excess = 0.5 * inverse_masses * excess;
    change.inelastic_loss =
        -J.normal * (normal_after - 0.5 * J.normal * inverse_masses - J.normal * half_excess);
    // Two products: the sum of the inverse masses and spins would be rounded, too, and is a
    // constant.
    change.friction_loss = -J.tangential * (slip_after - 0.5 * J.tangential * inverse_masses -
                                            J.tangential * (0.5 * inverse_spins + half_excess));
    if (after.are_spheres()) {
        const auto rolls = [&](std::size_t k) {
            return after.radius[k] * cross(Vec2{after.spin_x[k], after.spin_y[k]}, n);
        };
        const double vertical_after = -(rolls(event.i) + (wall ? 0.0 : rolls(event.j)));
        change.friction_loss +=
            -J.vertical * (vertical_after - 0.5 * J.vertical * rolling_lever(after, event));
    }
    return change;
}

double kinetic_energy(const Snapshot& s) {
    double sum = 0.0;
    for (std::size_t i = 0; i < s.size(); ++i) sum += kinetic_energy(s.disc(i));
    return sum;
}

/// After the event. K is that of the stored states, which on a floor must be the present ones.
void EnergyBudget::follow_floor(const EnergyChange& collision, const Snapshot& after) {
    Totals now{true, kinetic_energy(after), {0.0, 0.0}, after.container_velocity};
    for (std::size_t i = 0; i < after.size(); ++i)
        now.momentum = now.momentum + after.mass[i] * after.velocity(i);
    if (last_.known) {
        const double by_collision =
            collision.work - collision.friction_loss - collision.inelastic_loss;
        const double work =
            dot(last_.floor_velocity, now.momentum - last_.momentum - collision.push);
        floor_.work += work;
        floor_.friction_loss += work - (now.energy - last_.energy - by_collision);
    }
    last_ = now;
}

void EnergyBudget::sample_event(const Event& event, const Snapshot& after) {
    const EnergyChange change = energy_change(event, after);
    if (event.kind == EventKind::disc_wall || event.kind == EventKind::disc_disc) {
        add(event.kind == EventKind::disc_wall ? wall_ : disc_, change);
        add(total_, change);
    }
    if (after.on_floor) return follow_floor(change, after);
    if (!compared_) compare(kinetic_energy(after));
}

void EnergyBudget::compare(double energy) {
    const double unaccounted = energy - accounted();
    if (!begun_) at_start_ = unaccounted;
    begun_ = compared_ = true;
    max_difference_ = std::fmax(max_difference_, std::fabs(unaccounted - at_start_));
}

double EnergyBudget::unaccounted_share() const {
    if (!begun_) return not_available;
    return max_difference_ / std::fmax(std::fabs(total_work()), std::fabs(total_loss()));
}

void EnergyBudget::close_event_block(double duration) {
    work_.add(wall_.work, duration);
    disc_friction_.add(disc_.friction_loss, duration);
    wall_friction_.add(wall_.friction_loss, duration);
    inelastic_.add(disc_.inelastic_loss + wall_.inelastic_loss, duration);
    if (last_.known) {
        floor_work_.add(floor_.work, duration);
        floor_friction_.add(floor_.friction_loss, duration);
    }
    disc_ = wall_ = floor_ = {};
    compared_ = false;
}

void EnergyBudget::merge(const EnergyBudget& other) {
    add(total_, other.total_);
    begun_ = begun_ || other.begun_;
    max_difference_ = std::fmax(max_difference_, other.max_difference_);
    ReportedAverages::merge(other);
}

}  // namespace swirl
