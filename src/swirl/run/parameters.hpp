// The parameters of a run: what they are (RunConfig), and one row about each of them.
//
// Whoever offers, reads, checks, writes or explains a parameter goes by the rows: the command line,
// configuration files, JSON and with it the identity of a resumed run, the axes of a sweep and the
// seeds of its points, what --dry-run prints, messages, and docs/parameters.md. A new parameter is
// a member of RunConfig with its row, both here, and its home in the engine (config.cpp).
//
// The values where nothing is given are the paper's (Lee et al. 2019, SI "Simulation parameters").
// Units: length = disc radius, mass = disc mass, speed of the container = 1 (docs/physics.md).
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "swirl/physics/container_path.hpp"
#include "swirl/physics/disc.hpp"
#include "swirl/physics/floor.hpp"
#include "swirl/physics/limits.hpp"
#include "swirl/run/reading.hpp"

namespace swirl {

enum class PathShape { polygon, circle };

/// The paper's experiment in the units of its simulation: spheres of r = 3 mm in a dish of
/// R = 25.5 mm, swirled at A = 5.75 mm with Ω = 11.81 /s. Lengths in r, speeds in AΩ. The frictions
/// of plastic are not in the paper.
inline constexpr double experiment_container_radius = 25.5 / 3.0;
inline constexpr double experiment_amplitude = 5.75 / 3.0;
inline constexpr double experiment_period = 2.0 * pi * experiment_amplitude;
inline constexpr double experiment_gravity = 6.382;  // 9.81 m/s², in (AΩ)²/r
inline constexpr double experiment_floor_friction = 0.3;
inline constexpr double experiment_friction = 0.2, experiment_restitution = 0.9;

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
    double contact_duration = 1e-3;  // t_c; matters only for restitution < 1 or on a floor
    double mass = 1.0, radius = 1.0;
    double inertia = paper_inertia;  // of one disc, not divided by m r²
    Shape body = Shape::disc;
    bool floor = false;  // that spheres slide and roll on, and coins slide
    double floor_friction = experiment_floor_friction, gravity = experiment_gravity;
    double rolling_resistance = 0.0;                  // μ_r of spheres (floor.hpp)
    double vertical_disc = 1.0, vertical_wall = 1.0;  // κ of spheres (collision_law.hpp)
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
    /// (statistics/block_average.hpp), at the latest after half of the run; `warmup` is not set.
    bool warmup_found = false;

    std::uint64_t seed = 1;

    double omega() const { return 2.0 * pi / period; }
    /// Discs on a floor are coins.
    Shape shape() const { return body == Shape::disc && floor ? Shape::coin : body; }
    /// Nothing dissipates energy: no friction, elastic collisions, no floor.
    bool conserves_energy() const {
        return mu_disc == 0.0 && mu_wall == 0.0 && restitution == 1.0 && !floor;
    }
    /// Whether the contact duration has an effect (physics/collision_law.hpp).
    bool uses_contact_duration() const { return restitution != 1.0 || floor; }
};

/// From a random start, rotation and density forget their past within a few swirls when both
/// frictions act. With μ_d = 0 spins take of the order of 100 swirls; no default can serve both.
inline constexpr std::int64_t default_warmup = 20;

/// Name to text, as given by the user; what is not given takes the paper's value.
using ParameterTexts = std::map<std::string, std::string, std::less<>>;

/// What a parameter is in a configuration; monostate: it is not set.
using ParameterValue =
    std::variant<std::monostate, std::int64_t, std::uint64_t, double, std::string, Mixture>;

/// Readers throw WrongCall. `given` is all that was given, for what depends on it.
using ParameterReader = void(std::string_view text, const ParameterTexts& given, RunConfig& config);
using ParameterWriter = ParameterValue(const RunConfig& config);
using ParameterSpeller = std::string(const RunConfig& config);

/// Most parameters are a member of RunConfig and nothing else; the others have these of their own.
ParameterReader read_preset, read_mu, read_body, read_inertia, read_floor, read_mixture, read_speed,
    read_path, read_sides, read_periods, read_warmup;
ParameterWriter write_body, write_floor, write_floor_friction, write_gravity,
    write_rolling_resistance, write_vertical_disc, write_vertical_wall, write_mixture, write_speed,
    write_omega, write_path, write_sides, write_events, write_warmup;
ParameterSpeller spell_inertia, spell_mixture;

/// When a row is read: after those of earlier times, in terms of which it is.
enum class ReadingOrder { first, then, last };

/// From where to where a number is moved by somebody who plays with it, and in what steps.
struct UsualSpan {
    double from = 0.0, to = 0.0, step = 0.0;
};

struct Parameter {
    const char* name;         // "mu_disc": the key in every file; the option is --mu-disc
    const char* symbol = "";  // as in docs/physics.md
    const char* unit = "";    // "length", "time", …; of a pure number nothing
    const char* form = "";    // what stands after the option: "NUMBER"
    const char* description;
    const char* group;
    /// Where it lives, and from where to where it may go.
    std::variant<std::monostate, double RunConfig::*, std::int64_t RunConfig::*, int RunConfig::*,
                 std::uint64_t RunConfig::*, std::optional<std::int64_t> RunConfig::*>
        member = {};
    double lowest = 0.0, highest = 0.0;
    /// What a slider offers (the laboratory's); step 0: none. What is given may be outside.
    UsualSpan usual = {};
    /// Only if it is not the member as a number.
    ParameterReader* read = nullptr;
    ParameterWriter* write = nullptr;
    ParameterSpeller* spell = nullptr;  // the text that reads back as it, if not the value's
    const char* by_default = nullptr;   // what holds if nothing is given
    ReadingOrder order = ReadingOrder::first;
    bool follows = false;           // written, but it follows from others: not read back
    bool said_only_if_set = false;  // of spheres alone: results of discs say nothing of it
    /// Given by hand, it takes the place of these in a file.
    std::array<const char*, 2> instead_of = {};

    /// Whether it can be given; if not, it is only written.
    bool can_be_given() const { return read != nullptr || member.index() != 0; }
    /// Whether it stands in the configuration; if not, it only sets others.
    bool is_written() const { return write != nullptr || member.index() != 0; }
};

namespace parameter_group {
inline constexpr const char *discs = "The discs", *container = "The container", *run = "The run";
}

/// In the order of `swirl run --help`, of the JSON and of the axes of a sweep.
inline constexpr auto run_parameters = std::to_array<Parameter>({
    {.name = "preset",
     .form = "experiment",
     .description = "other values where nothing else is given: the paper's experiment with its "
                    "spheres (r = 3 mm, R = 25.5 mm, A = 5.75 mm, Ω = 11.81 /s) on a floor, "
                    "μ = 0.2, μ_f = 0.3, e = 0.9",
     .group = parameter_group::discs,
     .read = read_preset,
     .by_default = ""},
    {.name = "discs",
     .symbol = "N",
     .form = "N",
     .description = "number of discs",
     .group = parameter_group::discs,
     .member = &RunConfig::discs,
     .lowest = 1,
     .highest = max_discs,
     .usual = {1, 55, 1}},
    {.name = "mu",
     .symbol = "μ",
     .form = "NUMBER",
     .description = "friction of discs with discs and with the wall",
     .group = parameter_group::discs,
     .lowest = 0,
     .highest = largest_value,
     .usual = {0, 2, 0.05},
     .read = read_mu,
     .by_default = "1",
     .instead_of = {"mu_disc", "mu_wall"}},
    {.name = "mu_disc",
     .symbol = "μ_d",
     .form = "NUMBER",
     .description = "friction between discs, if it differs from --mu",
     .group = parameter_group::discs,
     .member = &RunConfig::mu_disc,
     .lowest = 0,
     .highest = largest_value,
     .usual = {0, 2, 0.05},
     .by_default = ""},
    {.name = "mu_wall",
     .symbol = "μ_w",
     .form = "NUMBER",
     .description = "friction with the wall, if it differs from --mu",
     .group = parameter_group::discs,
     .member = &RunConfig::mu_wall,
     .lowest = 0,
     .highest = largest_value,
     .usual = {0, 2, 0.05},
     .by_default = ""},
    {.name = "body",
     .form = "disc|sphere",
     .description = "discs, or spheres that turn in three dimensions (docs/spheres.md)",
     .group = parameter_group::discs,
     .read = read_body,
     .write = write_body,
     .by_default = "disc",
     .said_only_if_set = true},
    {.name = "inertia",
     .symbol = "I",
     .unit = "mass · length²",
     .form = "NUMBER|paper|ring|solid|sphere|shell",
     .description = "moment of inertia: paper = 10 m r^2, ring = m r^2, solid (disc) = m r^2 / 2, "
                    "sphere = 2/5 m r^2 (of spheres the default), shell = 2/3 m r^2",
     .group = parameter_group::discs,
     .member = &RunConfig::inertia,
     .lowest = 1e-12,
     .highest = 1e18,
     .usual = {0.25, 20, 0.25},
     .read = read_inertia,
     .spell = spell_inertia,
     .by_default = "paper",
     .order = ReadingOrder::then},
    {.name = "mass",
     .symbol = "m",
     .unit = "mass",
     .form = "NUMBER",
     .description = "mass of a disc",
     .group = parameter_group::discs,
     .member = &RunConfig::mass,
     .lowest = smallest_value,
     .highest = largest_value,
     .usual = {0.1, 10, 0.1}},
    {.name = "radius",
     .symbol = "r",
     .unit = "length",
     .form = "NUMBER",
     .description = "radius of a disc",
     .group = parameter_group::discs,
     .member = &RunConfig::radius,
     .lowest = smallest_value,
     .highest = largest_value,
     .usual = {0.1, 2, 0.05}},
    {.name = "mixture",
     .form = "COUNT:RADIUS[:MASS]",
     .description = "COUNT of the discs have this radius instead (and this mass; by default of the "
                    "same material, m ~ r^2, of spheres r^3)",
     .group = parameter_group::discs,
     .lowest = smallest_value,
     .highest = largest_value,
     .read = read_mixture,
     .write = write_mixture,
     .spell = spell_mixture,
     .order = ReadingOrder::then},
    {.name = "restitution",
     .symbol = "e",
     .form = "0..1",
     .description = "normal restitution e; 1 is elastic",
     .group = parameter_group::discs,
     .member = &RunConfig::restitution,
     .lowest = 0,
     .highest = 1,
     .usual = {0.5, 1, 0.01}},
    {.name = "tangential_restitution",
     .symbol = "β",
     .form = "0..1",
     .description = "the fraction of its slip that a sticking contact gives back",
     .group = parameter_group::discs,
     .member = &RunConfig::tangential_restitution,
     .lowest = 0,
     .highest = 1,
     .usual = {0, 1, 0.05}},
    {.name = "contact_duration",
     .symbol = "t_c",
     .unit = "time",
     .form = "TIME",
     .description =
         "with --restitution below 1, or on a floor: a collision this soon after a disc's "
         "last one loses nothing",
     .group = parameter_group::discs,
     .member = &RunConfig::contact_duration,
     .lowest = 0,
     .highest = largest_value,
     .usual = {0, 0.1, 0.001}},
    {.name = "floor",
     .form = "none|sliding",
     .description = "what they lie on: nothing that rubs, or a floor on which spheres slide and "
                    "roll and discs (coins) slide",
     .group = parameter_group::discs,
     .read = read_floor,
     .write = write_floor,
     .by_default = "none",
     .said_only_if_set = true},
    {.name = "floor_friction",
     .symbol = "μ_f",
     .form = "NUMBER",
     .description = "with --floor sliding: friction with the floor",
     .group = parameter_group::discs,
     .member = &RunConfig::floor_friction,
     .lowest = smallest_value,
     .highest = largest_value,
     .usual = {0.05, 1, 0.05},
     .write = write_floor_friction,
     .by_default = "0.3",
     .said_only_if_set = true},
    {.name = "gravity",
     .symbol = "g",
     .unit = "length / time²",
     .form = "NUMBER",
     .description = "with --floor sliding: what presses them on the floor",
     .group = parameter_group::discs,
     .member = &RunConfig::gravity,
     .lowest = smallest_value,
     .highest = largest_value,
     .usual = {0.5, 20, 0.5},
     .write = write_gravity,
     .by_default = "6.382",
     .said_only_if_set = true},
    {.name = "rolling_resistance",
     .symbol = "μ_r",
     .form = "NUMBER",
     .description = "with --floor sliding: coefficient of rolling resistance of spheres, at most "
                    "--floor-friction",
     .group = parameter_group::discs,
     .member = &RunConfig::rolling_resistance,
     .lowest = 0,
     .highest = largest_value,
     .usual = {0, 0.05, 0.001},
     .write = write_rolling_resistance,
     .by_default = "0",
     .said_only_if_set = true},
    {.name = "vertical_disc",
     .symbol = "κ_d",
     .form = "0..1",
     .description =
         "of the vertical slip between spheres, the share that friction acts against; 0: "
         "they rub as discs do",
     .group = parameter_group::discs,
     .member = &RunConfig::vertical_disc,
     .lowest = 0,
     .highest = 1,
     .usual = {0, 1, 0.05},
     .write = write_vertical_disc,
     .by_default = "1",
     .said_only_if_set = true},
    {.name = "vertical_wall",
     .symbol = "κ_w",
     .form = "0..1",
     .description = "the same of spheres and the wall",
     .group = parameter_group::discs,
     .member = &RunConfig::vertical_wall,
     .lowest = 0,
     .highest = 1,
     .usual = {0, 1, 0.05},
     .write = write_vertical_wall,
     .by_default = "1",
     .said_only_if_set = true},
    {.name = "container_radius",
     .symbol = "R",
     .unit = "length",
     .form = "NUMBER",
     .description = "radius of the container",
     .group = parameter_group::container,
     .member = &RunConfig::container_radius,
     .lowest = smallest_value,
     .highest = largest_value,
     .usual = {4, 20, 0.1}},
    {.name = "amplitude",
     .symbol = "A",
     .unit = "length",
     .form = "NUMBER",
     .description = "distance of its centre from the swirl centre",
     .group = parameter_group::container,
     .member = &RunConfig::amplitude,
     .lowest = 0,
     .highest = largest_value,
     .usual = {0, 5, 0.05}},
    {.name = "period",
     .symbol = "T",
     .unit = "time",
     .form = "NUMBER",
     .description = "time for one swirl",
     .group = parameter_group::container,
     .member = &RunConfig::period,
     .lowest = smallest_value,
     .highest = largest_value,
     .usual = {2, 40, 0.1}},
    {.name = "speed",
     .symbol = "v",
     .unit = "length / time",
     .form = "NUMBER",
     .description = "its speed: instead of --period (or of --amplitude)",
     .group = parameter_group::container,
     .lowest = 0,
     .highest = largest_value,
     .usual = {0.1, 5, 0.1},
     .read = read_speed,
     .write = write_speed,
     .by_default = "",
     .order = ReadingOrder::last,
     .follows = true},
    {.name = "omega",
     .symbol = "Ω",
     .unit = "1 / time",
     .description = "its angular velocity, 2 π / T",
     .group = parameter_group::container,
     .write = write_omega,
     .by_default = "",
     .follows = true},
    {.name = "path",
     .form = "polygon|circle",
     .description = "shape of its path",
     .group = parameter_group::container,
     .read = read_path,
     .write = write_path},
    {.name = "sides",
     .symbol = "M",
     .form = "M",
     .description = "sides of the polygon",
     .group = parameter_group::container,
     .member = &RunConfig::sides,
     .lowest = 3,
     .highest = max_sides,
     .usual = {3, 60, 1},
     .read = read_sides,
     .write = write_sides},
    {.name = "events",
     .unit = "events",
     .form = "NUMBER",
     .description = "length of the run in events of all kinds",
     .group = parameter_group::run,
     .member = &RunConfig::events,
     .lowest = 1,
     .highest = max_events,
     .usual = {20'000, 2'000'000, 20'000},
     .write = write_events,
     .instead_of = {"periods"}},
    {.name = "periods",
     .unit = "swirls",
     .form = "NUMBER",
     .description = "length of the run in swirls, instead of --events",
     .group = parameter_group::run,
     .member = &RunConfig::periods,
     .lowest = 1,
     .highest = max_periods,
     .usual = {20, 2000, 20},
     .read = read_periods,
     .instead_of = {"events"}},
    {.name = "warmup",
     .unit = "swirls",
     .form = "PERIODS|auto",
     .description = "swirls at the start that do not count; auto finds out how many it takes "
                    "(MSER-5 and Geweke's test of rotation and spins; at most half of the run)",
     .group = parameter_group::run,
     .member = &RunConfig::warmup,
     .lowest = 0,
     .highest = max_periods,
     .usual = {0, 200, 1},
     .read = read_warmup,
     .write = write_warmup,
     .by_default = "20, or a fifth of the run if that is shorter"},
    {.name = "seed",
     .form = "NUMBER",
     .description = "decides places and velocities at the start",
     .group = parameter_group::run,
     .member = &RunConfig::seed,
     .usual = {1, 100, 1}},
});

/// The row of that name in either spelling; nullptr if there is none.
const Parameter* find_parameter(std::string_view name);
/// The names of all that can be given, in order.
std::vector<std::string> parameter_names();

ParameterValue value_of(const Parameter& parameter, const RunConfig& config);
/// What holds if nothing is given, in as few characters as it takes; "" if nothing does.
std::string default_of(const Parameter& parameter);

/// Throws WrongCall, with one sentence that names the value, if a text cannot be read, a name is
/// unknown, two texts contradict each other, or the whole has a problem().
RunConfig resolve(const ParameterTexts& given);

/// Texts that resolve() to the configuration again.
ParameterTexts texts_of(const RunConfig& config);

/// What a file says, overridden by what was given by hand. What was given by hand also takes the
/// place of what the file says in other words: --mu that of mu_disc, --periods that of events.
ParameterTexts overridden(ParameterTexts file, const ParameterTexts& by_hand);

/// The first parameter that is outside its range, as a full sentence; nothing if all are inside.
std::optional<std::string> out_of_range(const RunConfig& config);

}  // namespace swirl
