// The commands, as `swirl --help` lists them. cmake/program.cmake makes a program swirl-NAME of
// each row, from command_<name>.cpp; ./swirl builds it when it is first called. Both read this
// file, so a row is one line of five texts:
//
//     name, group in the help, libraries, packages, description
//
// `libraries` are those that the program links in addition to swirl_cli: "drawing" is
// swirl_cli_drawing, and so on. Those of this name in the file `packages` are installed to build
// it. `packages` are the sections of that file that its calls need. "script" is a script of the
// source folder and no program. Commands of the group "hidden" serve tests and other commands: no
// help, manual page or completion names them.
#pragma once

#include <string_view>

namespace swirl {

struct CommandRow {
    std::string_view name, group, libraries, packages, description;
    constexpr bool is_script() const { return libraries == "script"; }
    /// Has a program, which help, manual pages and completions name.
    constexpr bool is_listed() const { return !is_script() && group != "hidden"; }
};

inline constexpr std::string_view help_before_commands = R"(
Exact event-driven simulation of granular discs and spheres in a swirled container,
after Lee et al., Phys. Rev. E 100, 012903 (2019).
Usage: swirl COMMAND [OPTIONS]
)";

// clang-format off
inline constexpr CommandRow command_list[] = {
    {"lab", "See it", "script", "", "Interactive simulation in a browser"},
    {"movie", "See it", "drawing", "movies", "Make a movie in the lab frame or the M-frame"},
    {"image", "See it", "drawing", "images", "Draw the container at one instant"},
    {"run", "Simulate", "", "", "Simulate one system and report its averages"},
    {"dish", "Simulate", "study", "", "Options and N_c for a dish in millimetres and rpm"},
    {"crossing", "Simulate", "study", "", "Find the number of discs at which the rotation changes sign"},
    {"sweep", "Simulate", "study", "", "Simulate all combinations of lists of parameters"},
    {"collect", "Simulate", "study", "", "Write the table of a sweep"},
    {"map", "Simulate", "study", "figures", "Map a quantity over one or two parameters"},
    {"track", "Your video", "drawing camera", "movies", "Track the discs in a video of a swirled container"},
    {"measure", "Your video", "", "", "Apply the measurements to recorded frames or tracks"},
    {"camera", "Your video", "", "movies", "Expected error of a camera, before you record"},
    {"experiment", "Your video", "experiment", "movies figures", "Compare videos with simulations in the paper's figures"},
    {"paper", "The paper", "", "figures python paper", "Make the paper's figures from simulation"},
    {"export", "Files", "", "", "Convert a trajectory for OVITO, ParaView, MDAnalysis, trackpy, HOOMD or pandas"},
    {"verify", "Files", "", "", "Repeat the run of a result or recording and compare bitwise"},
    {"synthetic-video", "hidden", "drawing", "movies", "Make a video of a run with known ground truth"},
    {"site", "For developers", "script", "", "Documentation and browser page as a web site"},
    {"python", "For developers", "script", "", "Python with the module swirl"},
};
// clang-format on

inline constexpr std::string_view help_after_commands = R"(
Options:
  --version                       Version and commit
  -h,--help                       This list; after a command: its main options, or all of them

Examples:
  swirl run --discs 48
  swirl paper --figure 5b --quick
  swirl run --help
)";

/// Nothing if there is no such command.
constexpr const CommandRow* command_named(std::string_view name) {
    for (const CommandRow& row : command_list)
        if (row.name == name) return &row;
    return nullptr;
}

}  // namespace swirl
