// An independent simulation of spheres on a floor, with small time steps. Velocities, three spins,
// friction against the floor and at contacts are written in three dimensions, without events,
// parabolas or roots. The error of time stepping decreases with the step; the rest would be a
// disagreement between the two.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/scenes.hpp"

namespace swirl {
namespace {

struct Vec3 {
    double x = 0.0, y = 0.0, z = 0.0;
};
Vec3 operator+(const Vec3& a, const Vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Vec3 operator-(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Vec3 operator*(double k, const Vec3& a) { return {k * a.x, k * a.y, k * a.z}; }
double inner(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
double norm(const Vec3& a) { return std::sqrt(inner(a, a)); }
Vec3 outer(const Vec3& a, const Vec3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// m = 1, R = 1, solid: I = 2/5.
struct Sphere {
    Vec3 position, velocity, spin;
};
constexpr double inertia = 0.4;
constexpr Vec3 up{0.0, 0.0, 1.0};

struct Container {
    ContainerPath path;
    double radius, mu, restitution, floor_deceleration, rolling_resistance;
    std::vector<Sphere> spheres;
};

/// Friction against the floor reduces the slip by at most μ_f g dt in the velocity, at most to 0.
/// If there is no slip, a torque μ_r g dt acts against the spin, at most until the spin is 0.
void apply_floor_friction(Sphere& s, const Vec3& floor, double deceleration, double resistance,
                          double dt) {
    const auto slip_of = [&] { return s.velocity - floor + outer(s.spin, -1.0 * up); };
    if (const Vec3 level{s.spin.x, s.spin.y, 0.0}; norm(slip_of()) < 1e-9 && norm(level) > 0.0)
        s.spin = s.spin - (std::min(resistance * dt / inertia, norm(level)) / norm(level)) * level;
    const Vec3 slip = slip_of();
    const double size = norm(slip);
    if (size == 0.0) return;
    const double impulse = std::min(deceleration * dt, size / (1.0 + 1.0 / inertia));
    const Vec3 J = (-impulse / size) * slip;
    s.velocity = s.velocity + J;
    s.spin = s.spin + (1.0 / inertia) * outer(-1.0 * up, J);
}

/// A collision between spheres i and j, or of sphere i with the wall (j is null). The normal points
/// from i to j. The floor prevents vertical motion, so vertical impulses change only the spins.
void collide_spheres(Sphere& i, Sphere* j, const Vec3& wall, const Vec3& n, double mu, double e) {
    const Vec3 other = j ? j->velocity + outer(j->spin, -1.0 * n) : wall;
    const Vec3 slip_and_approach = other - (i.velocity + outer(i.spin, n));
    const double approach = -inner(slip_and_approach, n);
    const double bodies = j ? 2.0 : 1.0;
    const double normal = (1.0 + e) * approach / bodies;
    const Vec3 tangent = outer(n, up);
    const double s_t = inner(slip_and_approach, tangent), s_z = slip_and_approach.z;
    // The lifted sphere responds with its mass; the wall does not move.
    const double lifted = j || s_z > 0.0 ? 1.0 : 0.0;
    const double m_t = 1.0 / (bodies * (1.0 + 1.0 / inertia));
    const double m_z = 1.0 / (lifted + bodies / inertia);
    double J_t = -m_t * s_t, J_z = -m_z * s_z;
    const double coulomb = mu * normal, stick = std::hypot(J_t, J_z), k = coulomb / stick;
    if (k < 1.0) {
        const double slip = std::hypot(s_t, s_z);
        const double stops = slip * slip * slip / (s_t * s_t / m_t + s_z * s_z / m_z);
        const double first = (1.0 - k * k) * std::min(coulomb, stops) / slip;
        J_t = k * k * k * J_t - first * s_t;
        J_z = k * k * k * J_z - first * s_z;
    }
    const Vec3 along_floor = normal * n + J_t * tangent;  // impulse on j
    const Vec3 friction = J_t * tangent + J_z * up;
    i.velocity = i.velocity - along_floor;
    i.spin = i.spin - (1.0 / inertia) * outer(n, friction);
    if (!j) return;
    j->velocity = j->velocity + along_floor;
    j->spin = j->spin + (1.0 / inertia) * outer(-1.0 * n, friction);
}

/// Collides all pairs that overlap and approach after a step. Returns the number of collisions.
int collide_all(Container& container, const Vec3& centre, const Vec3& wall) {
    int collisions = 0;
    for (std::size_t i = 0; i < container.spheres.size(); ++i) {
        Sphere& s = container.spheres[i];
        const Vec3 out = s.position - centre;
        if (norm(out) > container.radius - 1.0 && inner(s.velocity - wall, out) > 0.0) {
            collide_spheres(s, nullptr, wall, (1.0 / norm(out)) * out, container.mu,
                            container.restitution);
            ++collisions;
        }
        for (std::size_t j = i + 1; j < container.spheres.size(); ++j) {
            Sphere& t = container.spheres[j];
            const Vec3 apart = t.position - s.position;
            if (inner(apart, apart) > 4.0 || inner(t.velocity - s.velocity, apart) >= 0.0) continue;
            collide_spheres(s, &t, {}, (1.0 / norm(apart)) * apart, container.mu,
                            container.restitution);
            ++collisions;
        }
    }
    return collisions;
}

int step_to(Container& container, double end, double dt) {
    int collisions = 0;
    const auto steps = std::int64_t(std::llround(end / dt));
    for (std::int64_t k = 0; k < steps; ++k) {
        const double t = end * (double(k) + 0.5) / double(steps);
        const Segment& segment = container.path.segment_at(t);
        const Vec2 c = segment.position_at(t + 0.5 * dt), u = segment.velocity_at(t);
        const Vec3 floor{u.x, u.y, 0.0};
        for (Sphere& s : container.spheres) {
            apply_floor_friction(s, floor, container.floor_deceleration,
                                 container.rolling_resistance, dt);
            s.position = s.position + dt * s.velocity;
        }
        collisions += collide_all(container, {c.x, c.y, 0.0}, floor);
    }
    return collisions;
}

InitialState five_spheres() {
    InitialState scene =
        state_of({unit_disc(inertia)}, 5, paper_container_radius,
                 polygon_path(paper_amplitude, paper_period, paper_sides), 0.2, 0.2);
    scene.disc_surface = scene.wall_surface = {.mu = 0.2, .restitution = 0.9};
    scene.shape = Shape::sphere;
    scene.floor.deceleration = 0.6;
    for (std::size_t i = 0; i < scene.discs.size(); ++i) {
        Disc& d = scene.discs[i];
        const double k = double(i);
        d.velocity = {2.0 * std::cos(1.7 * k), 2.0 * std::sin(2.3 * k + 1.0)};
        d.spin = 0.4 * std::sin(k);
        d.rolling_spin = {0.5 * std::cos(3.0 * k), -0.3 * std::sin(k)};
    }
    return scene;
}

Container container_of(const InitialState& scene) {
    Container container{scene.path,
                        scene.container_radius,
                        scene.disc_surface.mu,
                        scene.disc_surface.restitution,
                        scene.floor.deceleration,
                        scene.floor.rolling_resistance,
                        {}};
    for (const Disc& d : scene.discs)
        container.spheres.push_back({{d.position.x, d.position.y, 0.0},
                                     {d.velocity.x, d.velocity.y, 0.0},
                                     {d.rolling_spin.x, d.rolling_spin.y, d.spin}});
    return container;
}

/// The largest difference of a coordinate, a velocity or a spin.
double difference(const Container& container, const Simulation& simulation, double time) {
    double maximum = 0.0;
    const Snapshot now = simulation.snapshot();
    Snapshot at = now;
    at.clock = time;
    at = at.up_to_date();
    for (std::size_t i = 0; i < at.size(); ++i) {
        const Sphere& s = container.spheres[i];
        for (const double d :
             {s.position.x - at.x[i], s.position.y - at.y[i], s.velocity.x - at.vx[i],
              s.velocity.y - at.vy[i], s.spin.x - at.spin_x[i], s.spin.y - at.spin_y[i],
              s.spin.z - at.spin[i]})
            maximum = std::max(maximum, std::abs(d));
    }
    return maximum;
}

void expect_time_steps_converge_to_events(const InitialState& scene) {
    if (sanitized)
        GTEST_SKIP() << "the engine has ten events here, the time steps of this file millions";
    constexpr double end = 5.0;
    Simulation simulation(scene);
    simulation.advance_to(0, end);
    // The comparison must include all kinds of events.
    ASSERT_GE(simulation.events().disc_disc, 2u);
    ASSERT_GE(simulation.events().disc_wall, 3u);
    ASSERT_GE(simulation.events().begins_to_roll, 3u);
    std::vector<double> errors;
    for (const double dt : {1e-3, 1e-4, 1e-5, 1e-6}) {
        Container container = container_of(scene);
        const int collisions = step_to(container, end, dt);
        errors.push_back(difference(container, simulation, end));
        EXPECT_EQ(collisions, int(simulation.events().disc_disc + simulation.events().disc_wall))
            << dt;
    }
    // The time of a contact is wrong by up to dt, so the error is roughly proportional to dt. Over
    // a factor of 1000 it must decrease by at least 100.
    EXPECT_LT(errors.back(), errors.front() / 100.0);
    // A contact that is late by dt at a relative speed of 4, amplified fivefold at each of two
    // more.
    EXPECT_LT(errors.back(), 1e-4);
    for (std::size_t k = 0; k < errors.size(); ++k)
        testing::Test::RecordProperty("error at 1e-" + std::to_string(k + 3),
                                      std::to_string(errors[k]));
}
TEST(TimeStepping, ConvergesToTheEventDrivenResult) {
    expect_time_steps_converge_to_events(five_spheres());
}
TEST(TimeStepping, ConvergesWithRollingResistance) {
    InitialState scene = five_spheres();
    scene.floor.rolling_resistance = 0.2;
    expect_time_steps_converge_to_events(scene);
}

}  // namespace
}  // namespace swirl
