#include "swirl/run/version.hpp"

#include "version.inc"

namespace swirl {

std::string version() { return SWIRL_VERSION " (" SWIRL_COMMIT ")"; }
std::string build_description() { return SWIRL_BUILD; }

}  // namespace swirl
