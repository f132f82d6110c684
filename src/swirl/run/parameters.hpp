// The table of the parameters of a run: one row for each (parameter_table.cpp).
//
// The row is the only description of a parameter. The command line, configuration files, JSON, the
// identity of a resumed run, the axes and seeds of a sweep, ramps, presets, --dry-run, error
// messages, the browser page and docs/reference/parameters.md all use it.
//
// A coefficient of the collision law needs four changes: its members (Surface in
// physics/contact.hpp and RunConfig in run_config.hpp), its row, its use in collision_law.hpp, and
// a test of that use. If one is forgotten, the program does not compile, or a test of
// parameters_test.cpp fails with a sentence. Another parameter takes effect in config.cpp.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "swirl/run/reading.hpp"
#include "swirl/run/run_config.hpp"

namespace swirl {

struct Surface;

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

/// The pass in which a row is read. A row may depend on rows of earlier passes.
enum class ReadingOrder { first, second, last };

/// Whether a parameter is part of a written configuration. A new one is `not_default`: results,
/// seeds of sweeps and checkpoints of runs without it then stay the same.
enum class WrittenIf {
    always,       // null if it is not set
    set,          // omitted if it is not set
    not_default,  // omitted if it is the default
    floor         // omitted without a floor
};

/// The runs in which a parameter has an effect. A value given for a run without a floor, or another
/// value than the default for one without spheres, is an error. The page hides what has no effect.
enum class AppliesTo {
    every_run,
    floor,            // spheres and coins on a floor
    spheres,          // spheres with or without a floor
    rolling_spheres,  // spheres on a floor
    dissipation,      // collisions that lose energy
    polygons,         // paths with sides
};
constexpr bool needs_floor(AppliesTo runs) {
    return runs == AppliesTo::floor || runs == AppliesTo::rolling_spheres;
}
constexpr bool needs_spheres(AppliesTo runs) {
    return runs == AppliesTo::spheres || runs == AppliesTo::rolling_spheres;
}

/// What a preset does to a parameter. If a file gives a parameter and the command line a preset,
/// the preset replaces the file's value, unless it leaves the parameter alone.
enum class InPreset {
    unchanged,
    set,
    length,   // set in units of the radius; follows another --radius
    duration  // follows another period
};

/// When a parameter may change with the same particles.
enum class Changes {
    new_run,    // another value is another run
    on_page,    // the browser page can change it while it runs
    in_periods  // ramps and sweeps with --chain can change it, too
};

/// The contacts whose coefficient a parameter is.
enum class Contacts { none, all, of_particles, with_wall };

struct ParameterRange {
    double lowest = 0.0, highest = 0.0;
};
namespace parameter_range {
inline constexpr ParameterRange positive{smallest_value, largest_value},
    nonnegative{0, largest_value}, fraction{0, 1};
}

/// Values outside a slider's range are allowed.
struct Slider {
    double from = 0.0, to = 0.0, step = 0.0;
};
/// The control on the browser page. A parameter without a group is not on the page.
struct PageControl {
    const char* group = nullptr;  // a name of page_group
    const char* label = "";       // everyday name in English; the page translates what it knows
    Slider slider = {};           // numbers only
};
namespace page_group {
inline constexpr const char *main = "main", *friction = "friction", *particles = "particles",
                            *collisions = "collisions", *floor = "floor", *container = "container",
                            *run = "run";
}

struct Parameter {
    const char* name;          // "mu_disc": the key in results; the option is --mu-disc (names.hpp)
    const char* symbol = "";   // symbol in docs/explanation/physics.md
    const char* unit = "";     // "length", "time", …; empty for a pure number
    const char* form = "";     // the value after the option: "NUMBER"
    const char* description;   // --help shows it: at most 60 characters
    const char* details = "";  // further sentences for docs/reference/parameters.md
    const char* group = nullptr;  // the first row of a group names it
    /// The member of RunConfig and its allowed range.
    std::variant<std::monostate, double RunConfig::*, std::int64_t RunConfig::*, int RunConfig::*,
                 std::uint64_t RunConfig::*, std::optional<std::int64_t> RunConfig::*>
        member = {};
    ParameterRange range = {};
    /// The collision law takes this coefficient of these contacts from the member.
    double Surface::*coefficient = nullptr;
    Contacts contacts = Contacts::none;
    /// Needed only if the parameter is not simply the member as a number.
    ParameterReader* read = nullptr;
    ParameterWriter* write = nullptr;
    ParameterFormatter* format = nullptr;  // text that `read` accepts, if the value's text is not
    const char* default_text = nullptr;    // needed if the default is not the member's value
    ReadingOrder order = ReadingOrder::first;
    WrittenIf written = WrittenIf::always;
    AppliesTo applies_to = AppliesTo::every_run;
    InPreset in_preset = InPreset::unchanged;
    Changes changes = Changes::new_run;
    bool has_colons = false;  // its values may have colons, so a:b is no range
    bool is_derived = false;  // written, but not read back: it follows from others
    /// If this parameter is given on the command line, the file's values of these are ignored.
    std::array<const char*, 2> overrides = {};
    PageControl page = {};

    /// False for parameters that are only written.
    bool is_settable() const { return read != nullptr || member.index() != 0; }
    /// True if a configuration with this value does not contain the parameter.
    bool is_omitted(const ParameterValue& value) const {
        return written != WrittenIf::always && std::holds_alternative<std::monostate>(value);
    }
    /// False for parameters that only set others.
    bool is_written() const { return write != nullptr || member.index() != 0; }
    bool can_ramp() const { return changes == Changes::in_periods; }
    /// The member of a parameter that is a real number; nullptr for others.
    double RunConfig::*number() const {
        const auto* found = std::get_if<double RunConfig::*>(&member);
        return found ? *found : nullptr;
    }
};

namespace parameter_group {
inline constexpr const char *particles = "Particles", *container = "Container", *run = "Run";
}

/// In the order of `swirl run --help`, of the JSON and of the axes of a sweep.
extern const std::span<const Parameter> run_parameters;

/// The row with this name, spelled with underscores or hyphens; nullptr if there is none.
const Parameter* find_parameter(std::string_view name);
/// The names of all settable parameters for users, in the order of the table.
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
std::optional<Message> out_of_range(const RunConfig& config);

}  // namespace swirl
