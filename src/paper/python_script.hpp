// Running one of the scripts in figures/. Always with Debian's interpreter: another python3 may
// come first on the PATH and have no matplotlib.
#pragma once

#include <atomic>
#include <filesystem>
#include <string>
#include <vector>

namespace swirl {

/// Where SWIRL_FIGURES says; or ../share/swirl/figures from an installed program; or figures/ of
/// the source tree in which it was built. Throws Failure if it is not there.
std::filesystem::path figures_folder();

/// Throws Failure, with what the script had to say, if it does not succeed; Interrupted if it was
/// stopped.
void run_python_script(const std::string& script, const std::vector<std::string>& arguments,
                       const std::atomic<bool>* stop = nullptr);

}  // namespace swirl
