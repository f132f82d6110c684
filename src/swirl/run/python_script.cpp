#include "swirl/run/python_script.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <system_error>

#include "swirl/io/child_process.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/programs.hpp"

namespace swirl {
namespace {

namespace fs = std::filesystem;

/// The environment variable SWIRL_PYTHON names the Python that draws, for example one in a virtual
/// environment.
std::string interpreter() {
    const char* chosen = std::getenv("SWIRL_PYTHON");
    return chosen != nullptr && *chosen != '\0' ? chosen : "/usr/bin/python3";
}

/// The words as execv() takes them.
std::vector<char*> pointers_to(std::vector<std::string>& words) {
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    return argv;
}

/// The last line of the output, with the line before it if it is a hint.
std::string last_message(std::string text) {
    while (!text.empty() && text.back() == '\n') text.pop_back();
    std::size_t begin = text.rfind('\n') + 1;
    if (begin > 1 && text.compare(begin, 5, "hint:") == 0) begin = text.rfind('\n', begin - 2) + 1;
    const std::string_view prefix = "error: ";  // the caller has its own
    if (text.compare(begin, prefix.size(), prefix) == 0) begin += prefix.size();
    return text.substr(begin);
}

/// True if a folder has the scripts, and its owner may run in place of the program.
bool has_trusted_scripts(const fs::path& folder, const fs::path& program) {
    return is_trusted(folder, program) && is_trusted(folder / "style.py", program);
}

}  // namespace

fs::path figures_folder() {
    if (const char* const given = std::getenv("SWIRL_FIGURES"); given && *given)
        return fs::absolute(given);
    const fs::path program = main_program();
    for (const char* const where : {"../share/swirl/paper", "share/swirl/paper"})
        if (const fs::path folder = (program.parent_path() / where).lexically_normal();
            has_trusted_scripts(folder, program))
            return folder;
    throw Failure(fmt::format(
        "the scripts of the figures are not in '{}', where an installed program has them.\n"
        "hint: set SWIRL_FIGURES to their folder.",
        (program.parent_path() / "../share/swirl/paper").lexically_normal().string()));
}

/// The command line of a module. Python is isolated (-I): neither PYTHONPATH, where an empty entry
/// is the current folder, nor packages of the user can replace a module.
static std::vector<std::string> command_of(const std::string& script,
                                           const std::vector<std::string>& arguments) {
    std::vector<std::string> words{interpreter(), "-I", "-B", figures_folder().string(), script};
    words.insert(words.end(), arguments.begin(), arguments.end());
    return words;
}

/// Throws Failure if the script cannot be started.
static ProgramOutput run_script(const std::string& script,
                                const std::vector<std::string>& arguments,
                                const std::atomic<bool>* stop) {
    const std::vector<std::string> words = command_of(script, arguments);
    ProgramOutput output = run_program(words, stop);
    if (output.error == 0) return output;
    throw Failure(
        fmt::format("'{}' cannot be started: {}.\n"
                    "hint: install the Debian package python3-matplotlib.",
                    words.front(), std::generic_category().message(output.error)));
}

void run_python_script(const std::string& script, const std::vector<std::string>& arguments,
                       const std::atomic<bool>* stop) {
    const ProgramOutput output = run_script(script, arguments, stop);
    if (stop != nullptr && stop->load())
        throw Interrupted("stopped while figures were drawn; the tables are written.");
    if (output.exit_code == 0) return;
    if (output.text.find("No module named 'matplotlib'") != output.text.npos)
        throw Failure(
            "the figures need matplotlib; the tables are written.\n"
            "hint: install the Debian package python3-matplotlib.");
    throw Failure(
        fmt::format("paper/{}.py failed; the tables are written: {}", script,
                    output.text.empty() ? "no reason given." : last_message(output.text)));
}

ScriptOutput output_of_python_script(const std::string& script,
                                     const std::vector<std::string>& arguments) {
    try {
        const ProgramOutput output = run_script(script, arguments, nullptr);
        return {output.exit_code, output.text};
    } catch (const Failure& failure) {
        return {-1, failure.what()};
    }
}

void require_figure_packages() {
    const ScriptOutput output = output_of_python_script("figure_packages");
    if (output.status != 0) throw Failure(last_message(output.text));
}

void become_python_script(const std::string& script, const std::vector<std::string>& arguments) {
    std::vector<std::string> words = command_of(script, arguments);
    std::fflush(nullptr);
    std::vector<char*> argv = pointers_to(words);
    execv(argv[0], argv.data());
    throw Failure(
        fmt::format("'{}' cannot be started: {}.\nhint: install the Debian package python3.",
                    words.front(), std::generic_category().message(errno)));
}

}  // namespace swirl
