// A simulation as bytes, for files and pickle. A simulation read from them continues bitwise
// identically.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "swirl/engine/simulation.hpp"
#include "swirl/physics/initial_state.hpp"
#include "swirl/run/config.hpp"

namespace swirl::python {

struct ArchivedSimulation {
    RunConfig config;
    bool is_custom = false;  // discs or path were given as arrays
    InitialState scene{};
    Progress progress{};
};

std::string archive_bytes(ArchivedSimulation simulation);

/// Throws FileError for bytes that are damaged, of another version, or forged so that the
/// simulation could not exist.
ArchivedSimulation read_archive(std::string_view bytes);

}  // namespace swirl::python
