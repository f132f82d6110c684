// The parameter --sizes: a distribution of radii instead of one radius, and the particles that
// follow from a configuration.
//
//     uniform:MIN:MAX       density 1/(MAX − MIN)
//     normal:MEAN:SD        Gaussian within 3 standard deviations of the mean
//     lognormal:MEDIAN:S    ln r is Gaussian with standard deviation S, within 3 S of its mean
//     power:A:MIN:MAX       density ~ r^−A
//     list R[:M] R[:M] …    one entry per particle: radius, and mass if it is given
//
// A file name is replaced by the list in the file (parameter_files.hpp) before the text is read.
// Particles without a given mass consist of the same material as one of --radius and --mass:
// m ~ r² for discs, r³ for spheres. Moments of inertia are the same multiple of m r² for all.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "swirl/run/parameters.hpp"

namespace swirl {

inline constexpr std::size_t max_listed_sizes = 100'000;

struct ParticleProperties {
    double radius, mass, inertia;
    double can_spin = 1.0;  // Disc::can_spin
};

/// All particles, in order of their numbers. Radii of a distribution follow from the seed.
std::vector<ParticleProperties> particles_of(const RunConfig& config);

/// Disc::can_spin of n particles: 0 for the share --cannot-spin of them, rounded to whole
/// particles. The seed determines which. A larger share includes the particles of a smaller one.
std::vector<double> which_can_spin(const RunConfig& config, std::size_t n);

/// Mass of a particle of this radius that consists of the material of --radius and --mass.
double mass_of_same_material(double radius, const RunConfig& config);

/// The radii are within these bounds.
struct RadiusBounds {
    double smallest, largest;
};
RadiusBounds radius_bounds(const RunConfig& config);

/// True if the particles have more than one radius by definition.
inline bool has_unequal_sizes(const RunConfig& c) { return c.mixture || c.sizes; }

/// "radius 1", "radii 1 and 1.4", "radii of uniform:0.8:1.2": for messages.
Message radii_text(const RunConfig& config);

/// Why the sizes are not possible; nothing if they are.
std::optional<Message> problem_with_sizes(const RunConfig& config);

}  // namespace swirl
