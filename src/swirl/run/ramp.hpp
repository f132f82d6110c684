// Ramps: parameters that change during a run, one value per period (parameters.hpp).
//
// A change happens at the start of a period, when all discs are synchronised and the container is
// at the first vertex of its path. The state is kept: positions relative to the container, all
// velocities and spins. The surfaces, the floor and the path are those of the new values from then
// on. The engine continues as a resumed run does (Simulation::change_surroundings), so the bits of
// a trajectory depend on the values only.
//
// Amplitude. The container cannot jump, so the swirl centre S does: by A − A' along x, from which
// the container at the first vertex is at a distance A' from S. Positions count from S; in these
// coordinates the container and all discs are shifted by A' − A. No disc moves relative to another
// or to the wall, so no overlap arises.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "swirl/physics/initial_state.hpp"
#include "swirl/run/parameters.hpp"

namespace swirl {

/// Reads "mu=0.1:1@20..220"; several ramps are separated by semicolons. Throws UsageError.
std::vector<Ramp> read_ramps(std::string_view text);
/// A text that read_ramps() accepts.
std::string ramps_text(const std::vector<Ramp>& ramps);

/// The parameters whose values a text with ramps, or a list of such texts, replaces. Accepts any
/// text.
std::vector<std::string> parameters_set_by_ramps(std::string_view text);

/// The names of the parameters that can have a ramp.
std::vector<std::string> ramp_parameter_names();

/// The members that a ramp with this name changes: both friction coefficients for mu.
std::vector<double RunConfig::*> members_of(const std::string& name);

/// The configuration in one period, without ramps.
RunConfig in_period(const RunConfig& config, std::int64_t period);
/// True if a parameter has another value than in the period before.
bool changes_in_period(const RunConfig& config, std::int64_t period);
/// The container, its surfaces and its floor in one period, without discs.
InitialState surroundings_in(const RunConfig& config, std::int64_t period);

/// Why a value of a ramp cannot be run; nothing if all can.
std::optional<Message> problem_with_ramps(const RunConfig& config);

/// The last change of the period T up to a time: whole periods and time at that moment.
struct PeriodChange {
    std::int64_t periods = 0;
    double time = 0.0;
};
PeriodChange last_period_change(const RunConfig& config, std::int64_t periods);

/// The first period in which all ramps have their last value; 0 without ramps.
std::int64_t end_of_ramps(const RunConfig& config);

}  // namespace swirl
