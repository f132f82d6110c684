// A gas of smooth inelastic discs cools by Haff's law (P. K. Haff, J. Fluid Mech. 134, 401, 1983,
// doi:10.1017/S0022112083003419).
//
// A collision dissipates m (1 − e²) g²/4, where g is the speed of approach. With Maxwell's
// distribution, pairs that collide have ⟨g²⟩ = 4 kT/m. So a collision dissipates (1 − e²) kT of the
// N kT that a gas of N discs has:
//
//     dT/dC = −(1 − e²) T/N,                  C the number of collisions so far;
//     √(T₀/T) = 1 + (1 − e²) ω₀ t/4,          with N ω/2 collisions per unit of time, ω ~ √T,
//
// where ω is the collision rate of a disc. The distribution in a cooling gas differs slightly from
// Maxwell's. The next term of its expansion (van Noije, Ernst, Granular Matter 1, 57, 1998,
// doi:10.1007/s100350050009) is a₂ = −0.019 at e = 0.95. It lowers the cooling rate by the fraction
// 3 a₂/16, which is 0.35 %.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <vector>

#include "engine/scenes.hpp"

namespace swirl {
namespace {

double energy(const Simulation& simulation) {
    double sum = 0.0;
    for (std::size_t i = 0; i < simulation.size(); ++i) sum += kinetic_energy(simulation.disc(i));
    return sum;
}

TEST(InelasticGas, CoolsByHaffsLaw) {
    if (sanitized) GTEST_SKIP() << "half a million events";
    constexpr std::size_t N = 3000;
    constexpr double e = 0.95;
    InitialState scene = gas_at_rest(N, 0.3);
    Simulation warm(scene);
    warm.run(50 * N);  // Maxwell's distribution

    // ω₀ with e = 1, in this container with its wall.
    const double from = warm.snapshot().time();
    const std::uint64_t before = warm.events().disc_disc;
    warm.run(40 * N);
    const double omega = 2.0 * static_cast<double>(warm.events().disc_disc - before) /
                         (N * (warm.snapshot().time() - from));

    scene.disc_surface.restitution = e;
    for (std::size_t i = 0; i < N; ++i) scene.discs[i] = warm.disc(i);
    Simulation cooling(scene, warm.progress());
    const double E0 = energy(cooling), start = cooling.snapshot().time();
    const std::uint64_t collisions = cooling.events().disc_disc;
    while (energy(cooling) > E0 / 4.0) {
        cooling.run(N);
        const double C = static_cast<double>(cooling.events().disc_disc - collisions);
        const double t = cooling.snapshot().time() - start;
        const double E = energy(cooling);
        // The energy that C collisions dissipate has a relative standard deviation of 1/√C: 1.9 %
        // at first, 0.5 % at the end. The tolerance is four of these plus the 0.35 % from above.
        const double tolerance = 4.0 / std::sqrt(C) + 0.004;
        EXPECT_NEAR(std::log(E0 / E) / ((1.0 - e * e) * C / N), 1.0, tolerance) << C;
        EXPECT_NEAR((std::sqrt(E0 / E) - 1.0) / ((1.0 - e * e) * omega * t / 4.0), 1.0, tolerance)
            << t;
    }
}

// TC model (Luding, McNamara 1998): collisions within the duration of a contact are elastic.
TEST(InelasticGas, ConservesEnergyIfContactsLastForEver) {
    InitialState scene = gas_at_rest(300, 0.3);
    scene.disc_surface.restitution = scene.wall_surface.restitution = 0.5;
    scene.disc_surface.contact_duration = scene.wall_surface.contact_duration = 1e9;
    Simulation simulation(scene);
    const double E0 = energy(simulation);
    simulation.run(20000);
    // 20 000 rounding errors of relative size 10⁻¹⁶/300 add up to less than 10⁻¹².
    EXPECT_NEAR(energy(simulation) / E0, 1.0, 1e-12);
    EXPECT_EQ(simulation.events().elastic_by_tc,
              simulation.events().disc_disc + simulation.events().disc_wall);
}

}  // namespace
}  // namespace swirl
