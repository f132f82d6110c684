// Compares the gas of elastic hard discs with the literature: Kolafa, Rottner 2006
// (doi:10.1080/00268970600967963) give Z = p/(ρkT) to seven digits, and with it the collision rate
// of a disc, ν = 4 (Z − 1)/√π in units of √(kT/m)/σ.
//
// Our gas is not periodic. It is in a container with a hard wall, near which its density is higher.
// So we measure rate and density in the core, farther than seven diameters from the wall. The rate
// of the literature is extrapolated to that density, one or two per cent away, with the slope of
// Henderson's equation of state, Z = (1 + η²/8)/(1 − η)² (Mol. Phys. 30, 971, 1975), which is exact
// to 2.5 % here.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <vector>

#include "engine/scenes.hpp"

namespace swirl {
namespace {

double henderson(double eta) { return (1.0 + eta * eta / 8.0) / ((1.0 - eta) * (1.0 - eta)); }

struct Core {
    double packing;  // mean packing fraction
    double rate;     // collisions per disc and unit of time, σ = m = kT = 1
    double error;    // relative standard error of the rate, from blocks
};

Core measure_core(std::size_t n, double container_radius, std::uint64_t equilibration, int blocks,
                  int samples_per_block) {
    const double core_radius = container_radius - 14.0;
    InitialState scene =
        gas_at_rest(n, static_cast<double>(n) / (container_radius * container_radius));
    Simulation simulation(scene);
    simulation.run(equilibration);

    double energy = 0.0;
    for (std::size_t i = 0; i < n; ++i) energy += kinetic_energy(simulation.disc(i));
    // Two degrees of freedom per disc, minus one: a container at rest conserves angular momentum.
    const double kT = 2.0 * energy / (2.0 * static_cast<double>(n) - 1.0);
    const double diameter = 2.0;

    const auto in_core = [&](const Vec2& p) { return dot(p, p) < core_radius * core_radius; };
    std::vector<double> rates;
    double inside_sum = 0.0;
    for (int block = 0; block < blocks; ++block) {
        const double from = simulation.snapshot().time();
        double inside = 0.0;
        std::uint64_t collisions = 0;
        for (int sample = 0; sample < samples_per_block; ++sample) {
            const Snapshot s = simulation.snapshot();
            for (std::size_t i = 0; i < n; ++i) inside += in_core(s.position(i)) ? 1.0 : 0.0;
            for (std::size_t k = 0; k < n; ++k) {
                const Event event = simulation.step();
                if (event.kind != EventKind::disc_disc) continue;
                const Disc i = simulation.disc(event.i);
                collisions += in_core(i.position + i.radius * event.normal) ? 1 : 0;
            }
        }
        inside /= samples_per_block;
        inside_sum += inside;
        const double time = simulation.snapshot().time() - from;
        // A collision counts for each of the two discs.
        rates.push_back(2.0 * static_cast<double>(collisions) / (inside * time) * diameter /
                        std::sqrt(kT));
    }
    double mean = 0.0, square = 0.0;
    for (const double r : rates) mean += r / blocks;
    for (const double r : rates) square += (r - mean) * (r - mean);
    const double packing = inside_sum / blocks / (core_radius * core_radius);
    return {packing, mean, std::sqrt(square / (blocks * (blocks - 1.0))) / mean};
}

void expect_literature(double packing, double Z, std::size_t n, double container_radius) {
    if (sanitized) GTEST_SKIP() << "ten million events";
    const double literature = 4.0 * (Z - 1.0) / std::sqrt(pi);
    const Core core = measure_core(n, container_radius, 200 * n, 30, 20);
    EXPECT_NEAR(core.packing, packing, 0.02 * packing);  // the slope is valid nearby only
    const double there = literature * (henderson(core.packing) - 1.0) / (henderson(packing) - 1.0);
    EXPECT_LT(core.error, 0.0025);  // so that 1 % is four standard errors
    EXPECT_NEAR(core.rate / there, 1.0, 0.01) << core.packing << ", error " << core.error;
}

TEST(HardDiscGas, CollisionRateAtPacking030) { expect_literature(0.30, 2.063261, 3000, 100.55); }
TEST(HardDiscGas, CollisionRateAtPacking050) { expect_literature(0.50, 4.106358, 4000, 89.95); }
TEST(HardDiscGas, CollisionRateAtPacking065) { expect_literature(0.65, 8.408049, 4000, 78.5); }

}  // namespace
}  // namespace swirl
