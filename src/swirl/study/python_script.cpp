#include "swirl/study/python_script.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <system_error>

#include "swirl/io/system_calls.hpp"
#include "swirl/run/failure.hpp"

namespace swirl {
namespace {

namespace fs = std::filesystem;

/// The environment variable SWIRL_PYTHON names the Python that draws, for example one in a virtual
/// environment.
std::string interpreter() {
    const char* chosen = std::getenv("SWIRL_PYTHON");
    return chosen != nullptr && *chosen != '\0' ? chosen : "/usr/bin/python3";
}

/// Python is isolated (-I): neither PYTHONPATH, where an empty entry is the current folder, nor
/// packages of the user can replace a module. The scripts import each other, so their folder comes
/// first.
constexpr const char* runner =
    "import os, runpy, sys; del sys.argv[0]; sys.path.insert(0, os.path.dirname(sys.argv[0])); "
    "runpy.run_path(sys.argv[0], run_name='__main__')";

/// Time for a script to remove its temporary files when it is interrupted.
constexpr int grace = 500;         // ms
constexpr int poll_interval = 50;  // ms

struct ProcessResult {
    int status;
    std::string output;  // text of stdout and stderr
};

/// The words as execv() takes them.
std::vector<char*> pointers_to(const std::vector<std::string>& words) {
    std::vector<char*> argv;
    for (const std::string& word : words) argv.push_back(const_cast<char*>(word.c_str()));
    argv.push_back(nullptr);
    return argv;
}

/// Starts a child in its own process group: Ctrl-C reaches only this program, which then ends the
/// child.
pid_t start(const std::vector<std::string>& words, int output) {
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_adddup2(&actions, output, STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, output, STDERR_FILENO);
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    sigset_t all;
    sigfillset(&all);
    posix_spawnattr_setpgroup(&attributes, 0);
    posix_spawnattr_setsigdefault(&attributes, &all);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGDEF);
    std::vector<char*> argv = pointers_to(words);
    pid_t child = 0;
    const int error =
        posix_spawn(&child, argv[0], &actions, &attributes, argv.data(), system::environment());
    posix_spawn_file_actions_destroy(&actions);
    posix_spawnattr_destroy(&attributes);
    if (error == 0) return child;
    throw Failure(
        fmt::format("'{}' cannot be started: {}; the tables are written.\n"
                    "hint: install the Debian package python3-matplotlib.",
                    words.front(), std::generic_category().message(error)));
}

/// Appends available output; false at its end.
bool read_output(int end, std::string& output) {
    std::array<char, 4096> block;
    const ssize_t got = read(end, block.data(), block.size());
    if (got < 0) return errno == EINTR;
    output.append(block.data(), static_cast<std::size_t>(got));
    return got > 0;
}

/// Runs a program to its end. If `stop` is set, the program is interrupted, and killed after
/// `grace`.
ProcessResult run_program(const std::vector<std::string>& words, const std::atomic<bool>* stop) {
    int ends[2];
    if (!system::open_pipe(ends))
        throw Failure(
            fmt::format("a pipe cannot be opened: {}.", std::generic_category().message(errno)));
    ProcessResult result{0, ""};
    pid_t child = 0;
    try {
        child = start(words, ends[1]);
    } catch (const Failure&) {
        close(ends[0]);
        close(ends[1]);
        throw;
    }
    close(ends[1]);
    pollfd waited{ends[0], POLLIN, 0};
    int polls_left = -1;  // polls until the program is killed; -1: not interrupted
    for (;;) {
        const int ready = poll(&waited, 1, poll_interval);
        if (ready > 0 && !read_output(ends[0], result.output)) break;
        if (polls_left < 0 && stop != nullptr && stop->load()) {
            polls_left = grace / poll_interval;
            kill(-child, SIGINT);
        }
        if (ready == 0 && polls_left > 0 && --polls_left == 0) kill(-child, SIGKILL);
    }
    close(ends[0]);
    while (waitpid(child, &result.status, 0) < 0 && errno == EINTR) {
    }
    return result;
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

/// True if a folder has the scripts, and its owner is root or that of the program. Scripts that
/// another user has put next to a copied program are not run.
bool has_scripts_of_owner(const fs::path& folder, const fs::path& program) {
    struct stat of_program {
    }, of_folder{}, of_script{};
    if (stat(program.c_str(), &of_program) != 0 || stat(folder.c_str(), &of_folder) != 0 ||
        stat((folder / "style.py").c_str(), &of_script) != 0)
        return false;
    const auto is_trusted = [&](uid_t owner) { return owner == 0 || owner == of_program.st_uid; };
    return is_trusted(of_folder.st_uid) && is_trusted(of_script.st_uid);
}

}  // namespace

fs::path figures_folder() {
    if (const char* const given = std::getenv("SWIRL_FIGURES"); given && *given)
        return fs::absolute(given);
    const fs::path program = system::program_file();
    for (const char* const where : {"../share/swirl/paper", "share/swirl/paper"})
        if (const fs::path folder = (program.parent_path() / where).lexically_normal();
            has_scripts_of_owner(folder, program))
            return folder;
    throw Failure(fmt::format(
        "the scripts of the figures are not in '{}', where an installed program has them.\n"
        "hint: set SWIRL_FIGURES to their folder.",
        (program.parent_path() / "../share/swirl/paper").lexically_normal().string()));
}

/// The command line of a script.
static std::vector<std::string> command_of(const std::string& script,
                                           const std::vector<std::string>& arguments) {
    std::vector<std::string> words{interpreter(), "-I",   "-B",
                                   "-c",          runner, (figures_folder() / script).string()};
    words.insert(words.end(), arguments.begin(), arguments.end());
    return words;
}

void run_python_script(const std::string& script, const std::vector<std::string>& arguments,
                       const std::atomic<bool>* stop) {
    const ProcessResult result = run_program(command_of(script, arguments), stop);
    if (stop != nullptr && stop->load())
        throw Interrupted("stopped while figures were drawn; the tables are written.");
    if (WIFEXITED(result.status) && WEXITSTATUS(result.status) == 0) return;
    if (result.output.find("No module named 'matplotlib'") != result.output.npos)
        throw Failure(
            "the figures need matplotlib; the tables are written.\n"
            "hint: install the Debian package python3-matplotlib.");
    throw Failure(
        fmt::format("paper/{} failed; the tables are written: {}", script,
                    result.output.empty() ? "no reason given." : last_message(result.output)));
}

ScriptOutput output_of_python_script(const std::string& script,
                                     const std::vector<std::string>& arguments) {
    try {
        const ProcessResult result = run_program(command_of(script, arguments), nullptr);
        return {WIFEXITED(result.status) ? WEXITSTATUS(result.status) : -1, result.output};
    } catch (const Failure& failure) {
        return {-1, failure.what()};
    }
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
