// Running one of the scripts in figures/. Always with Debian's interpreter: another python3 may
// come first on the PATH and have no matplotlib.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace swirl {

/// The folder figures/ of the source tree: beside the build folder this program runs from, or
/// where SWIRL_FIGURES says. Throws Failure if it is not there.
std::filesystem::path figures_folder();

/// Throws Failure, with what the script had to say, if it does not succeed.
void run_python_script(const std::string& script, const std::vector<std::string>& arguments);

}  // namespace swirl
