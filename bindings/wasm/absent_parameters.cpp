// The parameters that the page does not have, in place of the files of src/swirl with the same
// functions. Reading and validating initial states would make the page larger by a sixth, values
// with units by five kilobytes: "My dish" converts millimetres and turns per minute itself. Moving
// a slider is a ramp. A law for contacts without friction has event loops of its own;
// laboratory.cpp rejects such runs.
#include "swirl/engine/partial_friction.hpp"
#include "swirl/run/config.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/initial_parameter.hpp"
#include "swirl/run/parameter_readers.hpp"
#include "swirl/run/ramp.hpp"
#include "swirl/run/units.hpp"

namespace swirl {
namespace {

[[noreturn]] void reject_parameter(const char* name) {
    throw_usage_error(Message("page_without_parameter", {{"name", name}}));
}

}  // namespace

void read_initial(std::string_view, const ParameterTexts&, RunConfig&) {
    reject_parameter("--initial");
}
ParameterValue write_initial(const RunConfig&) { return {}; }
std::optional<Message> problem_with_initial(const RunConfig&) { return {}; }
// Never called, since no configuration of the page has such states.
InitialState given_initial_state(const RunConfig&) { return {}; }

ParameterTexts without_units(ParameterTexts texts) { return texts; }
void read_length_unit(std::string_view, const ParameterTexts&, RunConfig&) {
    reject_parameter("--length-unit");
}
void read_time_unit(std::string_view, const ParameterTexts&, RunConfig&) {
    reject_parameter("--time-unit");
}
ParameterValue write_length_unit(const RunConfig&) { return {}; }
ParameterValue write_time_unit(const RunConfig&) { return {}; }

void read_ramp(std::string_view, const ParameterTexts&, RunConfig&) { reject_parameter("--ramp"); }
ParameterValue write_ramp(const RunConfig&) { return {}; }
std::optional<Message> problem_with_ramps(const RunConfig&) { return {}; }

OwnLaw without_friction_in(Frictionless) { return {}; }

}  // namespace swirl
