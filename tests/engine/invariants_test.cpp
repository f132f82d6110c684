// Conserved quantities and identities of trajectories.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>

#include "engine/scenes.hpp"

namespace swirl {
namespace {

double energy(const Snapshot& s) {
    double sum = 0.0;
    for (std::size_t i = 0; i < s.size(); ++i) sum += kinetic_energy(s.disc(i));
    return sum;
}
double energy_of_translation(const Snapshot& s) {
    double sum = 0.0;
    for (std::size_t i = 0; i < s.size(); ++i)
        sum += 0.5 * s.mass[i] * dot(s.velocity(i), s.velocity(i));
    return sum;
}
/// About the swirl centre S, spins included.
double angular_momentum(const Snapshot& s) {
    double sum = 0.0;
    for (std::size_t i = 0; i < s.size(); ++i)
        sum += s.mass[i] * cross(s.position(i), s.velocity(i)) + s.inertia[i] * s.spin[i];
    return sum;
}
/// Σ m r·v about the origin.
double virial(const Snapshot& s) {
    double sum = 0.0;
    for (std::size_t i = 0; i < s.size(); ++i) sum += s.mass[i] * dot(s.position(i), s.velocity(i));
    return sum;
}

InitialState circle_container(std::size_t n, double mu_disc, double mu_wall) {
    InitialState scene = paper_container(n, mu_disc, mu_wall);
    scene.path = circular_path(paper_amplitude, paper_period);
    const Segment& segment = scene.path.segments.front();
    for (Disc& d : scene.discs)
        d.velocity = d.velocity - paper_container(1).path.segments[0].velocity;
    for (Disc& d : scene.discs) d.velocity = d.velocity + segment.velocity;
    return scene;
}

// In the frame that turns about the swirl centre the container is at rest, and K − ΩL is the energy
// there. Without friction it is conserved.
TEST(ExactCircle, ConservesEnergyMinusOmegaLWithoutFriction) {
    const InitialState scene = circle_container(48, 0.0, 0.0);
    const double omega = scene.path.omega();
    Simulation simulation(scene);
    const auto invariant = [&] {
        const Snapshot s = simulation.snapshot();
        return energy(s) - omega * angular_momentum(s);
    };
    const double before = invariant();
    const int blocks = sanitized ? 2 : 100;
    for (int block = 0; block < blocks; ++block) {
        simulation.run(10000);
        // K and ΩL are of order 100. 10⁶ events with random relative errors of 10⁻¹⁶ add up to
        // 10⁻¹¹.
        ASSERT_NEAR(invariant(), before, 1e-10) << "after " << simulation.events().total();
    }
}

// Friction between discs dissipates energy in every frame, so K − ΩL can only decrease.
TEST(ExactCircle, EnergyMinusOmegaLDecreasesWithFrictionBetweenDiscs) {
    const InitialState scene = circle_container(40, 1.0, 0.0);
    const double omega = scene.path.omega();
    Simulation simulation(scene);
    Snapshot s = simulation.snapshot();
    const double first = energy(s) - omega * angular_momentum(s);
    double before = first;
    for (int k = 0; k < 50000; ++k) {
        simulation.refresh(s, simulation.step());
        const double after = energy(s) - omega * angular_momentum(s);
        ASSERT_LE(after, before + 1e-12) << "event " << k;  // rounding of a sum of order 100
        before = after;
    }
    EXPECT_LT(before, first - 1.0);
}

// With friction at the wall, each wall collision changes K − ΩL by −ΩR J_t − loss. The loss in the
// frame of the wall follows from the disc's velocities there.
TEST(ExactCircle, WallFrictionChangesEnergyMinusOmegaLByTorqueAndLoss) {
    const InitialState scene = circle_container(20, 0.0, 1.0);
    const double omega = scene.path.omega();
    Simulation simulation(scene);
    Snapshot s = simulation.snapshot();
    int hits = 0;
    for (int k = 0; k < 20000; ++k) {
        const double before = energy(s) - omega * angular_momentum(s);
        const Snapshot old = s;
        const Event event = simulation.step();
        simulation.refresh(s, event);
        const double change = energy(s) - omega * angular_momentum(s) - before;
        if (event.kind != EventKind::disc_wall) {
            ASSERT_NEAR(change, 0.0, 1e-11);
            continue;
        }
        ++hits;
        Disc then = old.disc(event.i), now = s.disc(event.i);
        then.velocity = then.velocity - s.container_velocity;
        now.velocity = now.velocity - s.container_velocity;
        const double loss = kinetic_energy(then) - kinetic_energy(now);
        ASSERT_GE(loss, -1e-12);
        // Friction acts on the disc by −J_t r at the wall, where r = −θ̂: the torque about C is +R
        // J_t, the sum of its orbital and spin parts.
        ASSERT_NEAR(change, -omega * scene.container_radius * event.impulse.tangential - loss,
                    1e-11);
    }
    EXPECT_GT(hits, 1000);
}

// Friction does not turn a disc that cannot spin: it acts at the contact, but its torque on the
// orbit has the lever arm of the disc's centre. So each collision changes K − ΩL by −loss plus Ω
// times the torque that what holds the spins takes up, r J_t for each disc. The loss follows from
// the impulse and the slip before and after it.
TEST(ExactCircle, HeldSpinsTakeUpTheTorqueOfFriction) {
    const InitialState scene = with_held_spins(circle_container(36, 0.7, 1.0), 2);
    const double omega = scene.path.omega();
    Simulation simulation(scene);
    Snapshot s = simulation.snapshot();
    const auto slip = [](const Snapshot& now, const Event& event) {
        const Vec2 n = event.normal, r{n.y, -n.x};
        const std::size_t i = event.i, j = event.j;
        if (event.kind == EventKind::disc_wall)
            return dot(now.container_velocity - now.velocity(i), r) + now.radius[i] * now.spin[i];
        return dot(now.velocity(j) - now.velocity(i), r) + now.radius[i] * now.spin[i] +
               now.radius[j] * now.spin[j];
    };
    int collisions[2] = {0, 0};
    for (int k = 0; k < 20000; ++k) {
        const double before = energy(s) - omega * angular_momentum(s);
        Snapshot old = s;
        const Event event = simulation.step();
        simulation.refresh(s, event);
        const double change = energy(s) - omega * angular_momentum(s) - before;
        const bool wall = event.kind == EventKind::disc_wall;
        if (!wall && event.kind != EventKind::disc_disc) {
            ASSERT_NEAR(change, 0.0, 1e-11);
            continue;
        }
        ++collisions[wall];
        old.container_velocity = s.container_velocity;
        old.container_centre = s.container_centre;
        const double J = event.impulse.tangential;
        const double loss = -0.5 * J * (slip(old, event) + slip(s, event));
        ASSERT_GE(loss, -1e-12);
        double taken_up = 0.0;
        for (const std::size_t i : {event.i, event.j})
            if (s.inverse_inertia(i) == 0.0) taken_up += s.radius[i] * J;
        if (wall) {
            taken_up *= 0.5;  // i and j are the same disc
            ASSERT_NEAR(change, -omega * (scene.container_radius * J - taken_up) - loss, 1e-11);
        } else {
            ASSERT_NEAR(change, omega * taken_up - loss, 1e-11);
        }
    }
    EXPECT_GT(collisions[0], 1000);
    EXPECT_GT(collisions[1], 1000);
    for (std::size_t i = 0; i < s.size(); i += 2) EXPECT_EQ(simulation.disc(i).spin, 0.0);
}

// A moment of inertia of 10¹⁸ responds to friction by 10⁻¹⁸ of a spin.
TEST(DiscsThatCannotSpin, AreTheLimitOfALargeMomentOfInertia) {
    InitialState heavy = paper_container(20);
    for (Disc& d : heavy.discs) d.inertia = 1e18;
    Simulation limit(heavy), held(with_held_spins(paper_container(20)));
    // Differences grow by a factor of about three per collision of a disc.
    for (int k = 0; k < 100; ++k) {
        const Event a = limit.step(), b = held.step();
        ASSERT_EQ(a.kind, b.kind);
        ASSERT_NEAR(a.clock, b.clock, 1e-9);
        ASSERT_NEAR(a.impulse.tangential, b.impulse.tangential, 1e-9);
    }
}

TEST(ContainerAtRest, SmoothDiscBouncesAtAConstantAngle) {
    InitialState scene = gas_at_rest(1, 0.02);
    scene.discs[0].position = {1.3, -2.1};
    scene.discs[0].velocity = {0.83, 0.41};
    scene.discs[0].spin = 0.7;
    Simulation simulation(scene);
    const auto next_hit = [&] {
        for (;;) {
            const Event e = simulation.step();
            if (e.kind == EventKind::disc_wall) return e;
        }
    };
    Event before = next_hit(), now = next_hit();
    const double impulse = before.impulse.normal;
    const double turn_cos = dot(before.normal, now.normal);
    const double turn_sin = cross(before.normal, now.normal);
    for (int hit = 0; hit < fewer_if_sanitized(100000); ++hit) {
        before = now;
        now = next_hit();
        // Each collision adds rounding errors of 10⁻¹⁵; 10⁵ random ones add up to 3·10⁻¹³.
        ASSERT_NEAR(now.impulse.normal, impulse, 1e-11) << "hit " << hit;
        ASSERT_NEAR(dot(before.normal, now.normal), turn_cos, 1e-11);
        ASSERT_NEAR(cross(before.normal, now.normal), turn_sin, 1e-11);
    }
    EXPECT_EQ(simulation.disc(0).spin, 0.7);
}

TEST(ContainerAtRest, SmoothDiscsConserveEnergy) {
    InitialState scene = paper_container(48, 0.0, 0.0);
    scene.path = still_path(10.0);
    Random random(4);
    for (Disc& d : scene.discs) {
        d.position = d.position - Vec2{paper_amplitude, 0.0};
        d.velocity = random.in_disc(1.0);
    }
    Simulation simulation(scene);
    const double before = energy(simulation.snapshot());
    simulation.run(sanitized ? 20000 : 1000000);
    // 10⁶ events, each with an error of 10⁻¹⁶ of the energy.
    EXPECT_NEAR(energy(simulation.snapshot()) / before, 1.0, 1e-11);
}

TEST(ContainerAtRest, SmoothDiscsConserveAngularMomentum) {
    Simulation simulation(gas_at_rest(200, 0.5));
    const double before = angular_momentum(simulation.snapshot());
    simulation.run(sanitized ? 20000 : 200000);
    EXPECT_NEAR(angular_momentum(simulation.snapshot()), before, 1e-9);  // Σ|r × v| = 10³
}

// Clausius: d/dt Σ m r·v = 2K + Σ over collisions of (impulse on j) · (r_j − r_i), so over any time
//     G(t) − G(0) = ∫ 2K dt + Σ σ J_n (pairs) − Σ (R − r) J_n (wall);
// friction acts across the line of centres and does not contribute.
TEST(ContainerAtRest, VirialIdentityHoldsWithAndWithoutFriction) {
    for (const double mu : {0.0, 0.8}) {
        InitialState scene = gas_at_rest(60, 0.6);
        scene.disc_surface.mu = scene.wall_surface.mu = mu;
        for (std::size_t i = 0; i < scene.discs.size(); i += 3) {
            scene.discs[i].radius = 0.7;
            scene.discs[i].mass = 0.4;
        }
        Simulation simulation(scene);
        Snapshot s = simulation.snapshot();
        const double before = virial(s);
        double expected = 0.0;
        for (int k = 0; k < 20000; ++k) {
            const double from = s.time(), twice_energy = 2.0 * energy_of_translation(s);
            const Event event = simulation.step();
            simulation.refresh(s, event);
            expected += twice_energy * (s.time() - from);
            if (event.kind == EventKind::disc_disc)
                expected += (s.radius[event.i] + s.radius[event.j]) * event.impulse.normal;
            if (event.kind == EventKind::disc_wall)
                expected -= (scene.container_radius - s.radius[event.i]) * event.impulse.normal;
        }
        // The sums of positive and of negative terms are of order 10⁵.
        EXPECT_NEAR(virial(s) - before, expected, 1e-7) << "mu = " << mu;
    }
}

}  // namespace
}  // namespace swirl
