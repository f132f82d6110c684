// The parameters of a run: their values (RunConfig) and a table with one row for each of them.
//
// The table is the only description of a parameter. The command line, configuration files, JSON,
// the identity of a resumed run, the axes and seeds of a sweep, --dry-run, error messages and
// docs/reference/parameters.md all use it. A new parameter needs a member of RunConfig and a row,
// both here, and its use in the engine (config.cpp).
//
// The defaults are the values of the paper (Lee et al. 2019, SI "Simulation parameters").
// Units: length = disc radius, mass = disc mass, speed of the container = 1
// (docs/explanation/physics.md).
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "swirl/physics/contact.hpp"
#include "swirl/physics/container_path.hpp"
#include "swirl/physics/disc.hpp"
#include "swirl/physics/floor.hpp"
#include "swirl/physics/limits.hpp"
#include "swirl/run/reading.hpp"

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

/// Name to text, as given by the user. Missing parameters have the value of the paper.
using ParameterTexts = std::map<std::string, std::string, std::less<>>;

/// The value of a parameter in a configuration; monostate: it is not set.
using ParameterValue =
    std::variant<std::monostate, std::int64_t, std::uint64_t, double, std::string, Mixture>;

/// Readers throw UsageError. `given` holds all parameters that the user gave, because some depend
/// on each other.
using ParameterReader = void(std::string_view text, const ParameterTexts& given, RunConfig& config);
using ParameterWriter = ParameterValue(const RunConfig& config);
using ParameterFormatter = std::string(const RunConfig& config);

/// Most parameters are a plain member of RunConfig; the others have their own functions.
ParameterReader read_preset, read_mu, read_frictionless, read_body, read_inertia, read_floor,
    read_initial, read_mixture, read_sizes, read_speed, read_path, read_direction, read_sides,
    read_periods, read_warmup, read_ramp, read_length_unit, read_time_unit;
ParameterWriter write_initial, write_frictionless, write_body, write_floor, write_mixture,
    write_sizes, write_speed, write_omega, write_path, write_direction, write_sides, write_events,
    write_warmup, write_ramp, write_length_unit, write_time_unit;
ParameterFormatter format_inertia, format_mixture;

/// The pass in which a row is read. A row may depend on rows of earlier passes.
enum class ReadingOrder { first, second, last };

/// True if a parameter is part of a written configuration.
enum class WrittenIf {
    always,       // null if it is not set
    set,          // omitted if it is not set
    not_default,  // omitted if it is the default
    floor         // omitted without a floor
};

struct ParameterRange {
    double lowest = 0.0, highest = 0.0;
};
namespace parameter_range {
inline constexpr ParameterRange positive{smallest_value, largest_value},
    nonnegative{0, largest_value}, fraction{0, 1};
}

struct Parameter {
    const char* name;             // "mu_disc": the key in every file; the option is --mu-disc
    const char* symbol = "";      // symbol in docs/explanation/physics.md
    const char* unit = "";        // "length", "time", …; empty for a pure number
    const char* form = "";        // the value after the option: "NUMBER"
    const char* description;      // --help shows it: at most 60 characters
    const char* details = "";     // further sentences for docs/reference/parameters.md
    const char* group = nullptr;  // the first row of a group names it
    /// The member of RunConfig and its allowed range.
    std::variant<std::monostate, double RunConfig::*, std::int64_t RunConfig::*, int RunConfig::*,
                 std::uint64_t RunConfig::*, std::optional<std::int64_t> RunConfig::*>
        member = {};
    ParameterRange range = {};
    /// Needed only if the parameter is not simply the member as a number.
    ParameterReader* read = nullptr;
    ParameterWriter* write = nullptr;
    ParameterFormatter* format = nullptr;  // text that `read` accepts, if the value's text is not
    const char* default_text = nullptr;    // needed if the default is not the member's value
    ReadingOrder order = ReadingOrder::first;
    WrittenIf written = WrittenIf::always;
    bool can_ramp = false;    // --ramp can change it during the run (ramp.hpp)
    bool is_derived = false;  // written, but not read back: it follows from others
    /// If this parameter is given on the command line, the file's values of these are ignored.
    std::array<const char*, 2> overrides = {};

    /// False for parameters that are only written.
    bool is_settable() const { return read != nullptr || member.index() != 0; }
    /// True if a configuration with this value does not contain the parameter.
    bool is_omitted(const ParameterValue& value) const {
        return written != WrittenIf::always && std::holds_alternative<std::monostate>(value);
    }
    /// False for parameters that only set others.
    bool is_written() const { return write != nullptr || member.index() != 0; }
};

namespace parameter_group {
inline constexpr const char *particles = "Particles", *container = "Container", *run = "Run";
}

constexpr auto with_groups(auto rows) {
    const char* group = nullptr;
    for (Parameter& row : rows) {
        if (row.group) group = row.group;
        row.group = group;
    }
    return rows;
}

/// In the order of `swirl run --help`, of the JSON and of the axes of a sweep.
inline constexpr auto run_parameters = with_groups(std::to_array<Parameter>({
    {.name = "preset",
     .form = "experiment|experiment-rough|experiment-half",
     .description = "The paper's experiment as defaults: smooth spheres",
     .details =
         "Spheres of r = 3 mm on a floor, R = 25.5 mm, Ω = 11.81 /s, e = 0.9. experiment: A = "
         "11.5 mm, the amplitude that the paper states, and μ = 0.33 for all contacts, "
         "from its N_c = 36. experiment-rough: roughened spheres, μ = 0.69, from N_c = 28. "
         "experiment-half: A = 5.75 mm, which the SI's A/R = 0.22 implies. Other options "
         "override it; --mu does not change the floor's friction. Its units are r and AΩ. With "
         "another --radius, R and A follow; with another unit of time, t_c/T stays and --gravity "
         "is required. The default length is 300 periods.",
     .group = parameter_group::particles,
     .read = read_preset,
     .default_text = ""},
    {.name = "discs",
     .symbol = "N",
     .form = "N",
     .description = "Number of discs or spheres",
     .member = &RunConfig::discs,
     .range = {1, max_discs}},
    {.name = "mu",
     .symbol = "μ",
     .form = "NUMBER",
     .description = "Friction coefficient between particles and at the wall",
     .range = parameter_range::nonnegative,
     .read = read_mu,
     .default_text = "1",
     .can_ramp = true,
     .overrides = {"mu_disc", "mu_wall"}},
    {.name = "mu_disc",
     .symbol = "μ_d",
     .form = "NUMBER",
     .description = "Friction coefficient between particles [value of --mu]",
     .member = &RunConfig::mu_disc,
     .range = parameter_range::nonnegative,
     .default_text = "",
     .can_ramp = true},
    {.name = "mu_wall",
     .symbol = "μ_w",
     .form = "NUMBER",
     .description = "Friction coefficient at the wall [value of --mu]",
     .member = &RunConfig::mu_wall,
     .range = parameter_range::nonnegative,
     .default_text = "",
     .can_ramp = true},
    {.name = "frictionless",
     .form = "none|wall|boundary|bulk",
     .description = "Contacts of discs that have no friction",
     .details = "wall: with the wall. boundary: between two discs whose centres are both within "
                "1.5 radii of the wall. bulk: all other contacts between discs. Other contacts "
                "have the coefficients above (docs/results/beyond.md).",
     .read = read_frictionless,
     .write = write_frictionless,
     .default_text = "none",
     .written = WrittenIf::set},
    {.name = "body",
     .form = "disc|sphere",
     .description = "Type of particle",
     .details = "Spheres rotate about all three axes, and roll on a floor unless --floor none is "
                "given (docs/explanation/spheres.md).",
     .read = read_body,
     .write = write_body,
     .default_text = "disc",
     .written = WrittenIf::set},
    {.name = "inertia",
     .symbol = "I",
     .unit = "mass · length²",
     .form = "NUMBER|paper|ring|solid|sphere|shell",
     .description = "Moment of inertia of one particle, number or name",
     .details = "paper = 10 m r^2, ring = m r^2, solid (disc) = m r^2 / 2, sphere = 2/5 m r^2 "
                "(the default for spheres), shell = 2/3 m r^2.",
     .member = &RunConfig::inertia,
     .range = {1e-12, 1e18},
     .read = read_inertia,
     .format = format_inertia,
     .default_text = "paper",
     .order = ReadingOrder::second},
    {.name = "cannot_spin",
     .form = "0..1",
     .description = "Share of the particles that cannot spin",
     .details = "Friction changes their velocities only: the inverse moment of inertia is 0. Of a "
                "sphere, only the spin about the vertical axis is 0; it rolls as before. The seed "
                "determines which particles; their number is rounded "
                "(docs/explanation/physics.md).",
     .member = &RunConfig::cannot_spin,
     .range = parameter_range::fraction,
     .written = WrittenIf::not_default},
    {.name = "mass",
     .symbol = "m",
     .unit = "mass",
     .form = "NUMBER",
     .description = "Mass of one particle",
     .member = &RunConfig::mass,
     .range = parameter_range::positive},
    {.name = "radius",
     .symbol = "r",
     .unit = "length",
     .form = "NUMBER",
     .description = "Radius of one particle",
     .member = &RunConfig::radius,
     .range = parameter_range::positive},
    {.name = "mixture",
     .form = "N|P%:RADIUS[:MASS]",
     .description = "Second species: number, radius and mass of its particles",
     .details = "They are part of --discs. A share in percent, such as 50%, is rounded to whole "
                "particles. "
                "The default mass is that of the same material: m ~ r^2 for discs, r^3 for "
                "spheres.",
     .range = parameter_range::positive,
     .read = read_mixture,
     .write = write_mixture,
     .format = format_mixture,
     .order = ReadingOrder::second,
     .overrides = {"sizes"}},
    {.name = "sizes",
     .form = "LAW|file:FILE",
     .description = "Distribution of the radii, drawn from the seed",
     .details =
         "uniform:MIN:MAX, normal:MEAN:SD, lognormal:MEDIAN:SD (of ln r), "
         "power:EXPONENT:MIN:MAX (density ~ r^-EXPONENT), or a CSV file with a radius and, "
         "if wanted, a mass per particle. Other masses are those of the material of --radius "
         "and --mass: m ~ r^2 for discs, r^3 for spheres "
         "(docs/how-to/sizes.md).",
     .read = read_sizes,
     .write = write_sizes,
     .default_text = "",
     .written = WrittenIf::set,
     .overrides = {"mixture"}},
    {.name = "initial",
     .form = "FILE",
     .description = "CSV file with initial x, y, vx, vy, spin of the discs",
     .details = "In the lab frame (docs/how-to/sizes.md). Only for discs without a floor.",
     .read = read_initial,
     .write = write_initial,
     .default_text = "",
     .written = WrittenIf::set,
     .overrides = {"discs"}},
    {.name = "restitution",
     .symbol = "e",
     .form = "0..1",
     .description = "Normal coefficient of restitution; 1 is elastic",
     .member = &RunConfig::restitution,
     .range = parameter_range::fraction,
     .can_ramp = true},
    {.name = "tangential_restitution",
     .symbol = "β",
     .form = "0..1",
     .description = "Tangential restitution of a sticking contact",
     .details = "The fraction of the slip that the contact returns.",
     .member = &RunConfig::tangential_restitution,
     .range = parameter_range::fraction,
     .can_ramp = true},
    {.name = "contact_duration",
     .symbol = "t_c",
     .unit = "time",
     .form = "TIME",
     .description = "Contact duration of the TC model",
     .details = "A collision within this time of the last collision of a particle dissipates "
                "nothing. It matters with --restitution below 1 or on a floor.",
     .member = &RunConfig::contact_duration,
     .range = parameter_range::nonnegative},
    {.name = "floor",
     .form = "none|sliding",
     .description = "Floor under the particles; sliding for spheres",
     .details = "On a sliding floor, spheres slide and roll; discs (coins) slide. The default "
                "friction, 0.3, and gravity, 6.382, are those of 3 mm spheres at the SI's A/R.",
     .read = read_floor,
     .write = write_floor,
     .default_text = "none",
     .written = WrittenIf::set},
    {.name = "floor_friction",
     .symbol = "μ_f",
     .form = "NUMBER",
     .description = "Friction coefficient of the floor",
     .member = &RunConfig::floor_friction,
     .range = parameter_range::positive,
     .written = WrittenIf::floor,
     .can_ramp = true},
    {.name = "gravity",
     .symbol = "g",
     .unit = "length / time²",
     .form = "NUMBER",
     .description = "Gravitational acceleration; acts only with a floor",
     .member = &RunConfig::gravity,
     .range = parameter_range::positive,
     .written = WrittenIf::floor},
    {.name = "rolling_resistance",
     .symbol = "μ_r",
     .form = "NUMBER",
     .description = "Rolling resistance coefficient of spheres on a floor",
     .details = "At most --floor-friction.",
     .member = &RunConfig::rolling_resistance,
     .range = parameter_range::nonnegative,
     .written = WrittenIf::not_default},
    {.name = "vertical_disc",
     .symbol = "κ_d",
     .form = "0..1",
     .description = "Fraction of vertical slip that friction opposes, spheres",
     .details = "For contacts between two spheres; 0: friction acts as between discs.",
     .member = &RunConfig::vertical_disc,
     .range = parameter_range::fraction,
     .written = WrittenIf::not_default},
    {.name = "vertical_wall",
     .symbol = "κ_w",
     .form = "0..1",
     .description = "Fraction of vertical slip that friction opposes, wall",
     .details = "For contacts of a sphere with the wall; 0: friction acts as for discs.",
     .member = &RunConfig::vertical_wall,
     .range = parameter_range::fraction,
     .written = WrittenIf::not_default},
    {.name = "container_radius",
     .symbol = "R",
     .unit = "length",
     .form = "NUMBER",
     .description = "Radius of the container",
     .group = parameter_group::container,
     .member = &RunConfig::container_radius,
     .range = parameter_range::positive},
    {.name = "amplitude",
     .symbol = "A",
     .unit = "length",
     .form = "NUMBER",
     .description = "Radius of the path of the container centre",
     .details =
         "Of a polygon, the radius of its circumscribed circle. Of an ellipse or a line, the "
         "semi-axis along x; of a Lissajous figure, along x and y. Of a path from a file, "
         "the largest distance from the origin: another value scales the path.",
     .member = &RunConfig::amplitude,
     .range = parameter_range::nonnegative,
     .can_ramp = true},
    {.name = "period",
     .symbol = "T",
     .unit = "time",
     .form = "NUMBER",
     .description = "Duration of one turn of the path",
     .details = "A path from a file has its own period: another value scales its times.",
     .member = &RunConfig::period,
     .range = parameter_range::positive,
     .can_ramp = true},
    {.name = "speed",
     .symbol = "v",
     .unit = "length / time",
     .form = "NUMBER",
     .description = "Speed of the container; replaces --period or --amplitude",
     .range = parameter_range::nonnegative,
     .read = read_speed,
     .write = write_speed,
     .default_text = "",
     .order = ReadingOrder::last,
     .is_derived = true},
    {.name = "omega",
     .symbol = "Ω",
     .unit = "1 / time",
     .description = "Angular velocity of the container, 2 π / T",
     .write = write_omega,
     .default_text = "",
     .is_derived = true},
    {.name = "path",
     .form = "polygon|circle|line|SHAPE|FILE",
     .description = "Path of the container centre, a shape or a file",
     .details = "Other shapes: ellipse:RATIO, lissajous:P:Q[:DEGREES]. A CSV file "
                "holds a closed path of one period, with the columns t, x and y "
                "(docs/how-to/paths.md).",
     .read = read_path,
     .write = write_path},
    {.name = "direction",
     .form = "counter-clockwise|clockwise",
     .description = "Direction of the path",
     .read = read_direction,
     .write = write_direction,
     .default_text = "counter-clockwise",
     .written = WrittenIf::set},
    {.name = "path_phase",
     .unit = "°",
     .form = "DEG",
     .description = "Point of the path where a run starts, 360 for a period",
     .member = &RunConfig::path_phase,
     .range = {0, 360},
     .written = WrittenIf::not_default},
    {.name = "sides",
     .symbol = "M",
     .form = "M",
     .description = "Number of straight segments of the path",
     .details =
         "The default for a Lissajous figure is 30 times the larger of its two numbers of cycles.",
     .member = &RunConfig::sides,
     .range = {3, max_sides},
     .read = read_sides,
     .write = write_sides},
    {.name = "events",
     .unit = "events",
     .form = "NUMBER",
     .description = "Length of the run in events of all kinds",
     .group = parameter_group::run,
     .member = &RunConfig::events,
     .range = {1, max_events},
     .write = write_events,
     .overrides = {"periods"}},
    {.name = "periods",
     .unit = "periods",
     .form = "NUMBER",
     .description = "Length of the run in periods; replaces --events",
     .member = &RunConfig::periods,
     .range = {1, max_periods},
     .read = read_periods,
     .overrides = {"events"}},
    {.name = "warmup",
     .unit = "periods",
     .form = "PERIODS|auto",
     .description = "Initial periods to exclude, or auto",
     .details = "auto determines them by MSER-5 and Geweke's test of rotation and spins; at most "
                "half of the run.",
     .member = &RunConfig::warmup,
     .range = {0, max_periods},
     .read = read_warmup,
     .write = write_warmup,
     .default_text = "20, at most 1/5 of run"},
    {.name = "events_per_sample",
     .form = "NUMBER",
     .description = "Events per sample of averages by event; 0: automatic",
     .details =
         "1 takes a sample after every event. By default a period with many events has about "
         "128 samples. The mean is the same.",
     .member = &RunConfig::events_per_sample,
     .range = {0, max_events},
     .written = WrittenIf::not_default},
    {.name = "ramp",
     .form = "NAME=FROM:TO@P..Q",
     .description = "Change of a parameter between periods P and Q",
     .details = "FROM:TO:… are values at equal distances from period P to Q, counted from 0; "
                "each period has one value. Parameters: mu, mu_disc, mu_wall, restitution, "
                "tangential_restitution, floor_friction, amplitude, period. Several ramps: repeat "
                "the option, or separate them by semicolons. Without --events and --periods, the "
                "run ends after period Q.",
     .read = read_ramp,
     .write = write_ramp,
     .default_text = "",
     .order = ReadingOrder::last,
     .written = WrittenIf::set},
    {.name = "seed",
     .form = "NUMBER",
     .description = "Seed of the initial positions and velocities",
     .member = &RunConfig::seed},
    {.name = "length_unit",
     .form = "LENGTH",
     .description = "What the radius r is, such as 3mm, for reports",
     .details =
         "Values with units, such as --radius 3mm, set it (docs/how-to/units.md). It does not "
         "change the run.",
     .read = read_length_unit,
     .write = write_length_unit,
     .default_text = "",
     .written = WrittenIf::set},
    {.name = "time_unit",
     .form = "TIME",
     .description = "What r divided by the container's speed is, for reports",
     .details = "Such as 22ms; together with --length-unit.",
     .read = read_time_unit,
     .write = write_time_unit,
     .default_text = "",
     .written = WrittenIf::set},
}));

/// The row with this name, spelled with underscores or hyphens; nullptr if there is none.
const Parameter* find_parameter(std::string_view name);
/// The names of all settable parameters, in the order of the table.
std::vector<std::string> parameter_names();

ParameterValue value_of(const Parameter& parameter, const RunConfig& config);
/// The shortest text of the default; "" if there is none.
std::string default_of(const Parameter& parameter);

/// Throws UsageError if a text cannot be read, a name is unknown, two parameters contradict each
/// other, or the configuration has a problem(). The message names the value.
RunConfig resolve(const ParameterTexts& given);

/// Texts from which resolve() makes the same configuration.
ParameterTexts texts_of(const RunConfig& config);

/// The configuration with another number of discs, made by resolve(): a share of a mixture gets its
/// number of discs again, and a number that cannot be run is rejected. Throws UsageError.
RunConfig with_discs(const RunConfig& config, std::int64_t discs);

/// The parameters of a file, overridden by those of the command line. An option also removes the
/// file's parameters that it replaces: --mu removes mu_disc, --periods removes events.
ParameterTexts overridden(ParameterTexts file, const ParameterTexts& command_line);

/// Describes the first parameter that is outside its range; nothing if all are inside.
std::optional<std::string> out_of_range(const RunConfig& config);

}  // namespace swirl
