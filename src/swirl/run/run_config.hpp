// The values of the parameters of a run. parameter_table.cpp describes each of them.
//
// The defaults are the values of the paper (Lee et al. 2019, SI "Simulation parameters").
// Units: length = disc radius, mass = disc mass, speed of the container = 1
// (docs/explanation/physics.md).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "swirl/physics/container_path.hpp"
#include "swirl/physics/disc.hpp"
#include "swirl/physics/floor.hpp"
#include "swirl/physics/frictionless.hpp"
#include "swirl/physics/limits.hpp"

namespace swirl {

/// All but the circle consist of straight segments.
enum class PathShape { polygon, circle, line, ellipse, lissajous, points };

/// The properties of a path other than its shape, amplitude, period and number of sides.
struct PathCurve {
    double axis_ratio = 1.0;                  // ellipse: y axis over x axis
    std::int64_t x_cycles = 1, y_cycles = 1;  // Lissajous figure: cycles per period
    double y_lead = 0.0;                      // Lissajous figure: degrees
    std::vector<PathPoint> points;            // not yet scaled to amplitude and period

    /// True if the points go round clockwise: their polygon has a negative area.
    bool turns_clockwise() const {
        double twice_area = 0.0;
        for (std::size_t k = 0; k + 1 < points.size(); ++k)
            twice_area += cross(points[k].at, points[k + 1].at);
        return twice_area < 0.0;
    }
};

/// The paper's experiment: spheres of r = 3 mm in a container of R = 25.5 mm, with Ω = 11.81 /s.
/// Lengths are in units of r, speeds in units of AΩ.
///
/// The main text states an "amplitude" of 1.15 cm. Read as the radius A of the circle, the spheres
/// reproduce the experiment; read as its diameter, which the SI's A/R = 0.22 implies, they do not
/// (docs/explanation/spheres.md). The paper states neither friction nor restitution. One friction
/// coefficient for all contacts, floor included, is determined by the N_c of the experiment.
struct ExperimentPreset {
    std::string_view name;
    double amplitude;  // unit: mm
    double friction;   // one for sphere, wall and floor
};
inline constexpr double smooth_friction = 0.33, rough_friction = 0.69;
inline constexpr ExperimentPreset experiment_presets[] = {
    {"experiment", 11.5, smooth_friction},       // smooth spheres: N_c = 36
    {"experiment-rough", 11.5, rough_friction},  // roughened spheres: N_c = 28
    {"experiment-half", 5.75, smooth_friction},  // 1.15 cm as the diameter of the circle
};
inline constexpr double sphere_radius_mm = 3.0, container_radius_mm = 25.5;
inline constexpr double experiment_omega = 11.81;  // 1/s
inline constexpr double experiment_container_radius = container_radius_mm / sphere_radius_mm;
inline constexpr double experiment_restitution = 0.9;
/// Default length of runs with a preset. The paper's 10⁶ events are 12 periods of eight spheres.
inline constexpr std::int64_t experiment_periods = 300;
/// 9.81 m/s², in (AΩ)²/r.
constexpr double experiment_gravity(double amplitude_mm) {
    return 6.382 * (5.75 / amplitude_mm) * (5.75 / amplitude_mm);
}

/// A second species: `count` of the discs have this radius and mass. The seed determines their
/// initial positions. Their moment of inertia is the same multiple of m r² as that of the others.
struct Mixture {
    std::int64_t count;
    double radius, mass;
    std::optional<double> percent = {};  // if given: `count` is this share, rounded (with_discs())
    bool operator==(const Mixture&) const = default;
};

/// Laws of the radii (particle_sizes.hpp).
enum class SizeLaw { uniform, normal, lognormal, power, listed };
/// State of one disc at the start of a run, in the lab frame (initial_parameter.hpp).
struct InitialMotion {
    Vec2 position, velocity;
    double spin;
};
struct ListedSize {
    double radius;
    std::optional<double> mass;  // default: mass of the same material
};
struct Sizes {
    SizeLaw law;
    std::array<double, 3> numbers;   // numbers of the law, in the order of its text
    std::vector<ListedSize> listed;  // one per particle
};

/// A parameter that changes during the run. It has one value in each period: `values` are at equal
/// distances from period `begin` to period `end`, counted from 0, and the periods between two of
/// them are interpolated. The first value holds before, the last one after.
struct Ramp {
    std::string name;  // name in the table: "mu"
    std::vector<double> values;
    std::int64_t begin = 0, end = 0;

    double value_in(std::int64_t period) const;
    bool operator==(const Ramp&) const = default;
};

struct RunConfig {
    std::int64_t discs = 48;  // both species together
    double mu_disc = 1.0, mu_wall = 1.0;
    Frictionless frictionless = Frictionless::none;  // these contacts of discs have no friction
    double restitution = 1.0;
    double tangential_restitution = 0.0;
    double contact_duration = 1e-3;  // t_c; matters only for restitution < 1 or on a floor
    double mass = 1.0, radius = 1.0;
    double inertia = paper_inertia;  // moment of one disc, not divided by m r²
    double cannot_spin = 0.0;        // share of the particles (Disc::can_spin)
    Shape body = Shape::disc;
    bool floor = false;  // spheres slide and roll on it, coins slide; default of spheres: true
    double floor_friction = 0.3, gravity = experiment_gravity(5.75);  // values at the SI's A/R
    double rolling_resistance = 0.0;                                  // μ_r of spheres (floor.hpp)
    double vertical_disc = 1.0, vertical_wall = 1.0;  // κ of spheres (collision_law.hpp)
    double container_radius = paper_container_radius;
    double amplitude = paper_amplitude;  // 0: the container is at rest
    PathShape path = PathShape::polygon;
    PathCurve curve;
    bool clockwise = false;   // the path is mirrored at the x axis
    double path_phase = 0.0;  // start on the path, in degrees of a period
    int sides = paper_sides;  // number of straight segments
    double period = paper_period;
    std::optional<Mixture> mixture;
    std::optional<Sizes> sizes;
    std::vector<InitialMotion> initial;  // one per disc; empty: random

    /// The run ends after this many events of all kinds, as in the paper. If `periods` is set, it
    /// ends after that many periods instead. Both include the warm-up.
    std::int64_t events = 1'000'000;
    std::optional<std::int64_t> periods;

    /// Whole periods excluded from every average (not in the paper). If it is not set:
    /// `default_warmup` periods, or the first fifth of the run if that is shorter.
    std::optional<std::int64_t> warmup;
    /// --warmup auto: the warm-up ends when rotation and mean spin no longer depend on the initial
    /// state (statistics/block_average.hpp), at the latest after half of the run. `warmup` is then
    /// not set.
    bool warmup_found = false;

    /// For the averages by event. 0: chosen from the events of the last period
    /// (cluster_rotation.hpp).
    std::int64_t events_per_sample = 0;

    std::uint64_t seed = 1;

    /// What r and r/v are in the user's units, such as "3mm" and "0.022s"; for reports (units.hpp).
    std::string length_unit, time_unit;

    /// The members above have the values of period 0 (in_period()).
    std::vector<Ramp> ramps;

    /// The ramp of this parameter, or null.
    const Ramp* ramp_of(std::string_view name) const {
        for (const Ramp& ramp : ramps)
            if (ramp.name == name) return &ramp;
        return nullptr;
    }
    double omega() const { return 2.0 * pi / period; }
    /// The direction in which the container goes round. A path without one counts as
    /// counter-clockwise, and its mirror image as clockwise.
    bool turns_clockwise() const { return clockwise != curve.turns_clockwise(); }
    /// The sign of a counter-clockwise rotation that is counted with the swirl.
    double swirl_sign() const { return turns_clockwise() ? -1.0 : 1.0; }
    /// Parameters of the floor get their defaults, since they must not be set without a floor.
    void remove_floor();
    /// Discs on a floor are coins.
    Shape shape() const { return body == Shape::disc && floor ? Shape::coin : body; }
    /// Nothing dissipates energy: no friction, elastic collisions, no floor.
    bool conserves_energy() const {
        const bool smooth_wall = mu_wall == 0.0 || frictionless == Frictionless::wall;
        return mu_disc == 0.0 && smooth_wall && restitution == 1.0 && !floor && ramps.empty();
    }
    /// True if the contact duration has an effect (physics/collision_law.hpp).
    bool uses_contact_duration() const {
        return restitution != 1.0 || floor || ramp_of("restitution");
    }
};

/// From a random initial state, rotation and density relax within a few periods if both friction
/// coefficients are above 0. With μ_d = 0 the spins need of the order of 100 periods; no default
/// can serve both.
inline constexpr std::int64_t default_warmup = 20;

}  // namespace swirl
