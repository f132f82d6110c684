// What determines a run: every parameter of `swirl run`, with the paper's values as defaults
// (Lee et al. 2019, SI "Simulation parameters").
//
// Units: length = disc radius, mass = disc mass, speed of the container = 1 (docs/physics.md).
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "swirl/physics/container_path.hpp"
#include "swirl/physics/disc.hpp"
#include "swirl/simulation/simulation.hpp"

namespace swirl {

enum class PathShape { polygon, circle };

/// A second size of disc. `count` of the discs have this radius and mass; the seed decides which
/// places they get. Their moment of inertia is the same multiple of m r² as that of the others.
struct Mixture {
    std::int64_t count;
    double radius, mass;
};

struct RunConfig {
    std::int64_t discs = 48;  // of both sizes together
    double mu_disc = 1.0, mu_wall = 1.0;
    double restitution = 1.0;
    double tangential_restitution = 0.0;
    double contact_duration = 1e-3;  // t_c of the TC model; matters only for restitution < 1
    double mass = 1.0, radius = 1.0;
    double inertia = paper_inertia;  // of one disc, not divided by m r²
    double container_radius = paper_container_radius;
    double amplitude = paper_amplitude;  // 0: the dish stands still
    PathShape path = PathShape::polygon;
    int sides = paper_sides;  // of the polygon
    double period = paper_period;
    std::optional<Mixture> mixture;

    /// The run ends after this many events of all three kinds, as in the paper, or, if `periods` is
    /// set, after that many swirls. The warm-up is part of it.
    std::int64_t events = 1'000'000;
    std::optional<std::int64_t> periods;

    /// Whole swirls left out of every average. Not in the paper. Not set: `default_warmup` of them,
    /// or the first fifth of the run if that is shorter.
    std::optional<std::int64_t> warmup;
    /// The warm-up ends when rotation and mean spin have forgotten how they began
    /// (measure/statistics.hpp), at the latest after half of the run; `warmup` is not set.
    bool warmup_found = false;

    std::uint64_t seed = 1;

    double omega() const { return 2.0 * pi / period; }
};

/// From a random start, rotation and density forget their past within a few swirls when both
/// frictions act. With μ_d = 0 spins take of the order of 100 swirls; no default can serve both.
inline constexpr std::int64_t default_warmup = 20;

/// Why this cannot be run, as a full sentence; nothing if it can.
std::optional<std::string> problem(const RunConfig& config);

ContainerPath make_path(const RunConfig& config);

/// The initial state: discs placed without overlap, with small random velocities relative to the
/// container, all from the seed. Throws WrongCall if the discs do not fit.
InitialState make_initial_state(const RunConfig& config);

/// Speed of the container along its path: 2AM sin(π/M)/T on the polygon, AΩ on the circle.
double container_speed(const RunConfig& config);

}  // namespace swirl
