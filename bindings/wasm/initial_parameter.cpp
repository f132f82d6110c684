// The page has no --initial: reading and validating states would make it larger by a sixth.
#include "swirl/run/initial_parameter.hpp"

#include "swirl/run/config.hpp"
#include "swirl/run/failure.hpp"

namespace swirl {

void read_initial(std::string_view, const ParameterTexts&, RunConfig&) {
    throw_usage_error("the page has no --initial.\nhint: use the program swirl.");
}

ParameterValue write_initial(const RunConfig&) { return {}; }

std::optional<std::string> problem_with_initial(const RunConfig&) { return {}; }

// Never called, since no configuration of the page has such states.
InitialState given_initial_state(const RunConfig&) { return {}; }

}  // namespace swirl
