#include "swirl/paper/swirled_state.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "swirl/paper/hypocycloid.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/json.hpp"

namespace swirl {

SwirledState::SwirledState(double container_radius, double carried)
    : container_radius_(container_radius),
      carried_(carried),
      about_centre_of_mass_(std::size_t(2.0 * container_radius * rings_per_radius) + 1),
      about_container_(about_centre_of_mass_.size()) {}

/// Of the core, about the centre of mass, and of the layer at the wall, about C: Σ r × u / Σ r².
void SwirledState::add_rotation(const Snapshot& snapshot, const Vec2& centre,
                                const Vec2& velocity) {
    double core = 0.0, core_square = 0.0, wall = 0.0, wall_square = 0.0;
    for (std::size_t i = 0; i < snapshot.size(); ++i) {
        const Vec2 p = snapshot.position(i) - snapshot.container_centre,
                   u = snapshot.velocity(i) - snapshot.container_velocity;
        const Vec2 r = p - centre;
        if (dot(r, r) < 0.25 * container_radius_ * container_radius_) {
            core += cross(r, u - velocity);
            core_square += dot(r, r);
        }
        const double inside = container_radius_ - layer;
        if (dot(p, p) > inside * inside) {
            wall += cross(p, u);
            wall_square += dot(p, p);
        }
    }
    if (core_square > 0.0) core_.add(core / core_square);
    if (wall_square > 0.0) layer_.add(wall / wall_square, wall_square);
}

void SwirledState::add_paths(const Snapshot& snapshot) {
    paths_.resize(snapshot.size());
    for (std::size_t i = 0; i < snapshot.size(); ++i) {
        const Vec2 p = snapshot.position(i) - snapshot.container_centre;
        paths_[i].emplace_back(p.x, p.y);
    }
    if (paths_.front().size() < std::size_t(periods_of_a_path) * samples_per_period) return;
    const HypocycloidFit fit = fit_hypocycloids(paths_, samples_per_period);
    path_rotation_.add(fit.rotation);
    path_square_.add(fit.distance * fit.distance);
    paths_.clear();
}

void SwirledState::sample(const Snapshot& snapshot) {
    Vec2 centre{0.0, 0.0}, velocity{0.0, 0.0};
    const auto n = static_cast<double>(snapshot.size());
    for (std::size_t i = 0; i < snapshot.size(); ++i) {
        const Vec2 v = snapshot.velocity(i);
        centre = centre + (1.0 / n) * (snapshot.position(i) - snapshot.container_centre);
        velocity = velocity + (1.0 / n) * (v - snapshot.container_velocity);
        square_.add(dot(v, v));
        double spins = snapshot.spin[i] * snapshot.spin[i];
        if (snapshot.are_balls())
            spins +=
                snapshot.spin_x[i] * snapshot.spin_x[i] + snapshot.spin_y[i] * snapshot.spin_y[i];
        spin_square_.add(snapshot.inertia[i] / snapshot.mass[i] * spins);
    }
    for (std::size_t i = 0; i < snapshot.size(); ++i) {
        const Vec2 p = snapshot.position(i) - snapshot.container_centre, r = p - centre;
        about_centre_of_mass_[std::size_t(std::sqrt(dot(r, r)) * rings_per_radius)] += 1.0;
        about_container_[std::size_t(std::sqrt(dot(p, p)) * rings_per_radius)] += 1.0;
    }
    const Vec2 q = centre + (1.0 - carried_) * snapshot.container_centre;
    distance_.add(std::sqrt(dot(q, q)));
    const double phase = 2.0 * pi * snapshot.periods_passed();
    const Vec2 axis{std::cos(phase), std::sin(phase)};
    steady_ = steady_ + Vec2{dot(q, axis), cross(axis, q)};
    const double angle = std::atan2(q.y, q.x);
    if (samples_ > 0.0) advance_ += std::remainder(angle - last_angle_, 2.0 * pi);
    if (samples_ == 0.0) first_time_ = snapshot.time();
    last_angle_ = angle;
    last_time_ = snapshot.time();
    samples_ += 1.0;
    discs_ = n;
    omega_ = 2.0 * pi / snapshot.period;
    add_rotation(snapshot, centre, velocity);
    add_paths(snapshot);
}

Json SwirledState::json() const {
    const auto densities = [&](const std::vector<double>& counts) {
        std::vector<double> values;
        for (std::size_t k = 0; k < counts.size(); ++k) {
            const double inner = double(k) / rings_per_radius, width = 1.0 / rings_per_radius;
            values.push_back(counts[k] / (samples_ * pi * width * (2.0 * inner + width)));
        }
        return values;
    };
    return {{"square", square_.value()},
            {"spin_square", spin_square_.value()},
            {"distance", distance_.value() / container_radius_},
            {"steady", std::sqrt(dot(steady_, steady_)) / (samples_ * container_radius_)},
            {"advance", advance_ / (omega_ * (last_time_ - first_time_))},
            {"core", core_.value() / omega_},
            {"layer", layer_.value() / omega_},
            {"path_rotation", path_rotation_.value()},
            {"path_distance", std::sqrt(path_square_.value())},
            {"about_centre_of_mass", densities(about_centre_of_mass_)},
            {"about_container", densities(about_container_)}};
}

double carried_share(const RunConfig& config) {
    if (!config.floor) return 0.0;
    return 1.0 / (1.0 + config.mass * config.radius * config.radius / config.inertia);
}

Json swirled_run(const RunConfig& config, const RunControl& control) {
    Run run(config, control);
    SwirledState state(config.container_radius, carried_share(config));
    SampleTimes times = run.sample_times(SwirledState::samples_per_period);
    while (run.next_event()) {
        while (run.next_sample(times))
            if (run.is_warm()) state.sample(run.snapshot());
        run.pass_event();
    }
    if (!run.complete()) throw Interrupted("Stopped.");
    Json json = state.json();
    json["rotation"] = run.result().rotation.by_time.mean;
    return json;
}

}  // namespace swirl
