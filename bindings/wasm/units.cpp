// The page has no values with units: "My dish" converts millimetres and turns per minute itself, and the complete
// reader would make the page larger by five kilobytes.
#include "swirl/run/units.hpp"

#include "swirl/run/failure.hpp"

namespace swirl {

ParameterTexts without_units(ParameterTexts texts) { return texts; }

void read_length_unit(std::string_view, const ParameterTexts&, RunConfig&) {
    throw_usage_error("the page has no --length-unit.\nhint: use the program swirl.");
}
void read_time_unit(std::string_view, const ParameterTexts&, RunConfig&) {
    throw_usage_error("the page has no --time-unit.\nhint: use the program swirl.");
}

ParameterValue write_length_unit(const RunConfig&) { return {}; }
ParameterValue write_time_unit(const RunConfig&) { return {}; }

}  // namespace swirl
