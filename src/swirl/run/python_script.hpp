// Runs the scripts in paper/, with the interpreter that SWIRL_PYTHON names, or else with Debian's:
// another python3 may come first on the PATH and have no matplotlib. A script is a module of the
// package `paper`, and has its name, such as "draw" (paper/__main__.py).
#pragma once

#include <atomic>
#include <filesystem>
#include <string>
#include <vector>

namespace swirl {

/// The folder in SWIRL_FIGURES, or share/swirl/paper above the program (installed) or next to it
/// (build tree), if its owner is root or that of the program. No other folder is searched. Throws
/// Failure if there is none.
std::filesystem::path figures_folder();

/// Throws Failure with the script's last message if it fails, Interrupted if it was stopped.
void run_python_script(const std::string& script, const std::vector<std::string>& arguments,
                       const std::atomic<bool>* stop = nullptr);

/// Throws Failure if a package that figures and reports need is missing.
void require_figure_packages();

/// The exit status of a script and what it prints; −1 and the reason if it cannot be started.
struct ScriptOutput {
    int status;
    std::string text;
};
ScriptOutput output_of_python_script(const std::string& script,
                                     const std::vector<std::string>& arguments = {});

/// Replaces this program by a script. Throws Failure if that is not possible.
[[noreturn]] void become_python_script(const std::string& script,
                                       const std::vector<std::string>& arguments);

}  // namespace swirl
