#include "swirl/measure/torque_budget.hpp"

#include <algorithm>
#include <cmath>

#include "swirl/measure/coarse_graining.hpp"
#include "swirl/measure/m_frame.hpp"

namespace swirl {
namespace {

struct Cluster {
    double mass = 0.0;
    Vec2 position{0.0, 0.0}, velocity{0.0, 0.0};
};

Cluster cluster_of(const Snapshot& s) {
    Cluster c;
    for (std::size_t i = 0; i < s.size(); ++i) {
        c.mass += s.mass[i];
        c.position = c.position + s.mass[i] * s.position(i);
        c.velocity = c.velocity + s.mass[i] * s.velocity(i);
    }
    c.position = (1.0 / c.mass) * c.position;
    c.velocity = (1.0 / c.mass) * c.velocity;
    return c;
}

double orbit_about_centre(const Cluster& c, const Snapshot& s) {
    return c.mass * cross(c.position - s.container_centre, c.velocity - s.container_velocity);
}

Vec2 tangent(const Event& event) { return {event.normal.y, -event.normal.x}; }

void grow(double& largest, double a, double b) { largest = std::fmax(largest, std::fabs(a - b)); }

/// The arm of friction on the spin. What holds a disc that cannot spin takes up its torque.
double arm_on_spin(const Snapshot& s, std::size_t i) {
    return s.inverse_inertia(i) == 0.0 ? 0.0 : s.radius[i];
}

/// The slice of θ in which the contact of the event lies.
std::size_t slice_of(const Event& event, const Snapshot& after, std::size_t slices) {
    Vec2 from_centre = event.normal;
    if (event.kind == EventKind::disc_disc)
        from_centre =
            0.5 * (after.position(event.i) + after.position(event.j)) - after.container_centre;
    const double u = turns_of(m_frame(after).rotate(from_centre));
    return std::min(static_cast<std::size_t>(u * static_cast<double>(slices)), slices - 1);
}

}  // namespace

AngularMomentum angular_momentum(const Snapshot& s) {
    const Cluster c = cluster_of(s);
    AngularMomentum sum;
    for (std::size_t i = 0; i < s.size(); ++i) {
        sum.orbital += s.mass[i] * cross(s.position(i) - c.position, s.velocity(i) - c.velocity);
        sum.spins += s.inertia[i] * s.spin[i];
    }
    sum.about_centre = sum.orbital + orbit_about_centre(c, s);
    return sum;
}

AngularImpulse angular_impulse(const Event& event, const Snapshot& after) {
    AngularImpulse change;
    if (!is_collision(event)) return change;
    const Impulse& J = event.impulse;
    const Vec2 at = after.position(event.i);
    if (event.kind == EventKind::disc_disc) {
        const Vec2 separation = after.position(event.j) - at;
        change.transfer = J.tangential * cross(separation, tangent(event));
        change.discs_on_spins =
            (arm_on_spin(after, event.i) + arm_on_spin(after, event.j)) * J.tangential;
        return change;
    }
    const Vec2 s = at - cluster_of(after).position;
    change.wall_normal = -J.normal * cross(s, event.normal);
    change.wall_tangential = -J.tangential * cross(s, tangent(event));
    change.wall_on_spins = arm_on_spin(after, event.i) * J.tangential;
    change.wall_about_centre = -J.tangential * cross(at - after.container_centre, tangent(event));
    return change;
}

void TorqueBudget::add(const Event& event, const Snapshot& after) {
    const AngularImpulse change = angular_impulse(event, after);
    const bool wall = event.kind == EventKind::disc_wall, sticks = event.impulse.sticks;
    open_[0] += change.wall_normal;
    open_[1] += change.wall_tangential;
    open_[2] += change.transfer;
    open_[3] += change.wall_on_spins;
    open_[4] += change.discs_on_spins;
    open_[7] += change.wall_about_centre;
    if (wall)
        open_[sticks ? 9 : 10] += change.wall_tangential;
    else
        open_[sticks ? 11 : 12] += change.transfer;

    const std::size_t slice = slice_of(event, after, wall_normal_.size());
    if (wall) {
        wall_normal_.add(slice, change.wall_normal);
        wall_tangential_.add(slice, change.wall_tangential);
    } else {
        transfer_.add(slice, change.transfer);
    }
    accounted_.orbital += change.wall_normal + change.wall_tangential + change.transfer;
    accounted_.spins += change.wall_on_spins + change.discs_on_spins;
    accounted_.about_centre += change.wall_about_centre + change.transfer;
    for (const double part : {change.wall_normal, change.wall_tangential, change.transfer})
        magnitude_ += std::fabs(part);
    pending_.push_back({after.time(), event.i, event.j, change.wall_normal, change.wall_tangential,
                        change.transfer});
}

/// r_cm moves uniformly between collisions with the wall, and collisions of discs change neither
/// r_cm nor v_cm. So it suffices to compute Q before and after each collision with the wall, at the
/// vertices, and where the budget is compared with the snapshot.
void TorqueBudget::follow_container(const Event& event, const Snapshot& after) {
    if (event.kind == EventKind::disc_disc && compared_) return;
    const Cluster now = cluster_of(after);
    Cluster before = now;
    if (event.kind == EventKind::disc_wall) {
        const Vec2 kick =
            event.impulse.normal * event.normal + event.impulse.tangential * tangent(event);
        before.velocity = now.velocity + (1.0 / now.mass) * kick;
    }
    if (!std::isnan(orbit_of_cluster_)) {
        const double change = orbit_about_centre(before, after) - orbit_of_cluster_;
        open_[8] += change;
        accounted_.about_centre += change;
        magnitude_ += std::fabs(change);
    }
    orbit_of_cluster_ = orbit_about_centre(now, after);
}

void TorqueBudget::sample_event(const Event& event, const Snapshot& after) {
    if (after.are_spheres()) return;
    follow_container(event, after);
    if (is_collision(event)) add(event, after);
    if (!compared_) compare(angular_momentum(after));
}

void TorqueBudget::compare(const AngularMomentum& now) {
    const AngularMomentum rest{now.orbital - accounted_.orbital, now.spins - accounted_.spins,
                               now.about_centre - accounted_.about_centre};
    if (!begun_) at_start_ = rest;
    begun_ = compared_ = true;
    grow(max_difference_.orbital, rest.orbital, at_start_.orbital);
    grow(max_difference_.spins, rest.spins, at_start_.spins);
    grow(max_difference_.about_centre, rest.about_centre, at_start_.about_centre);
}

void TorqueBudget::sample_residences(const LongResidences& residences) {
    std::size_t known = 0;
    for (; known < pending_.size(); ++known) {
        const Pending& c = pending_[known];
        if (c.time > residences.last_sample() || !residences.is_known(c.time)) break;
        if (std::isnan(known_until_)) known_since_ = c.time;
        if (c.time > known_since_) {
            const int pinned =
                (residences.resident(c.i, c.time) ? 1 : 0) +
                (residences.resident(c.j, c.time) ? 1 : 0);  // a wall contact counts 0 or 2
            zones_[pinned > 0 ? 0 : 1] += c.wall_normal;
            zones_[pinned > 0 ? 2 : 3] += c.wall_tangential;
            zones_[static_cast<std::size_t>(6 - pinned)] += c.transfer;
            zone_time_ += c.time - known_until_;
        }
        known_until_ = c.time;
    }
    pending_.erase(pending_.begin(), pending_.begin() + static_cast<std::ptrdiff_t>(known));
}

void TorqueBudget::begin_tracks() {
    begun_ = false;
    orbit_of_cluster_ = not_available;
    pending_.clear();
    known_since_ = known_until_ = not_available;
}

void TorqueBudget::close_event_block(double duration) {
    open_[5] = open_[0] + open_[1] + open_[2];
    open_[6] = open_[3] + open_[4];
    for (std::size_t k = 0; k < sums; ++k) series_[k].add(open_[k], begun_ ? duration : 0.0);
    for (std::size_t k = 0; k < zone_rows; ++k) series_[sums + k].add(zones_[k], zone_time_);
    for (CellRates* slices : {&wall_normal_, &wall_tangential_, &transfer_}) {
        slices->add_weight(begun_ ? duration : 0.0);
        slices->close_block();
    }
    open_ = {};
    zones_ = {};
    zone_time_ = 0.0;
    compared_ = false;
}

void TorqueBudget::merge(const TorqueBudget& other) {
    ReportedAverages::merge(other);
    wall_normal_.merge(other.wall_normal_);
    wall_tangential_.merge(other.wall_tangential_);
    transfer_.merge(other.transfer_);
    magnitude_ += other.magnitude_;
    grow(max_difference_.orbital, other.max_difference_.orbital, 0.0);
    grow(max_difference_.spins, other.max_difference_.spins, 0.0);
    grow(max_difference_.about_centre, other.max_difference_.about_centre, 0.0);
    begun_ = begun_ || other.begun_;
}

double TorqueBudget::unaccounted_share() const {
    if (!begun_) return not_available;
    return std::fmax(std::fmax(max_difference_.orbital, max_difference_.spins),
                     max_difference_.about_centre) /
           magnitude_;
}

}  // namespace swirl
