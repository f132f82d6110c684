#include "swirl/paper/python_script.hpp"

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
#include <cstdlib>
#include <system_error>

#include "swirl/run/failure.hpp"

extern char** environ;

namespace swirl {
namespace {

namespace fs = std::filesystem;

constexpr const char* interpreter = "/usr/bin/python3";

/// Python is started isolated (-I): neither PYTHONPATH, of which an empty entry is the current
/// folder, nor the user's own packages can replace a module. The scripts import each other, so
/// their folder comes first.
constexpr const char* runner =
    "import os, runpy, sys; del sys.argv[0]; "
    "sys.path.insert(0, os.path.dirname(sys.argv[0])); "
    "runpy.run_path(sys.argv[0], run_name='__main__')";

/// How long a script that is to stop may take to remove what it has begun.
constexpr int grace = 500;  // ms

/// What it wrote to stdout and stderr, and how it ended.
struct Ended {
    int status;
    std::string said;
};

/// In a process group of its own: Ctrl-C reaches us alone, and we end it.
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
    std::vector<char*> argv;
    for (const std::string& word : words) argv.push_back(const_cast<char*>(word.c_str()));
    argv.push_back(nullptr);
    pid_t child = 0;
    const int error = posix_spawn(&child, argv[0], &actions, &attributes, argv.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    posix_spawnattr_destroy(&attributes);
    if (error == 0) return child;
    throw Failure(
        fmt::format("'{}' could not be started: {}. The figures need the Debian package "
                    "python3-matplotlib; the tables are written.",
                    words.front(), std::generic_category().message(error)));
}

/// Adds to what was said; false when there will be no more.
bool listen(int end, std::string& said) {
    std::array<char, 4096> block;
    const ssize_t got = read(end, block.data(), block.size());
    if (got < 0) return errno == EINTR;
    said.append(block.data(), static_cast<std::size_t>(got));
    return got > 0;
}

/// Runs it to its end, or until it is to stop; then it gets Ctrl-C, and a moment later is killed.
Ended run_program(const std::vector<std::string>& words, const std::atomic<bool>* stop) {
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0)
        throw Failure(
            fmt::format("No pipe could be made: {}.", std::generic_category().message(errno)));
    Ended ended{0, ""};
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
    int deadline = -1;  // none is needed yet
    for (;;) {
        constexpr int look = 50;  // ms
        const int ready = poll(&waited, 1, look);
        if (ready > 0 && !listen(ends[0], ended.said)) break;
        if (deadline < 0 && stop != nullptr && stop->load()) {
            deadline = grace / look;
            kill(-child, SIGINT);
        }
        if (ready == 0 && deadline > 0 && --deadline == 0) kill(-child, SIGKILL);
    }
    close(ends[0]);
    while (waitpid(child, &ended.status, 0) < 0 && errno == EINTR) {
    }
    return ended;
}

std::string last_line(std::string text) {
    while (!text.empty() && text.back() == '\n') text.pop_back();
    return text.substr(text.rfind('\n') + 1);
}

/// Whether a folder holds the scripts, and belongs to the owner of the program or to root: what
/// another user has put next to a copied program is not run.
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
    std::error_code ignored;
    const fs::path program = fs::read_symlink("/proc/self/exe", ignored);
    for (const char* const where : {"../share/swirl/figures", "share/swirl/figures"})
        if (const fs::path folder = (program.parent_path() / where).lexically_normal();
            has_scripts_of_owner(folder, program))
            return folder;
    throw Failure(fmt::format(
        "The scripts that draw are not in '{}', where an installed program has them; set "
        "SWIRL_FIGURES to the folder that holds them.",
        (program.parent_path() / "../share/swirl/figures").lexically_normal().string()));
}

void run_python_script(const std::string& script, const std::vector<std::string>& arguments,
                       const std::atomic<bool>* stop) {
    std::vector<std::string> words{interpreter, "-I",   "-B",
                                   "-c",        runner, (figures_folder() / script).string()};
    words.insert(words.end(), arguments.begin(), arguments.end());
    const Ended ended = run_program(words, stop);
    if (stop != nullptr && stop->load())
        throw Interrupted("Stopped while drawings were made; the tables are written.");
    if (WIFEXITED(ended.status) && WEXITSTATUS(ended.status) == 0) return;
    if (ended.said.find("No module named 'matplotlib'") != ended.said.npos)
        throw Failure(
            "The tables are written, but the figures need matplotlib: install the Debian package "
            "python3-matplotlib.");
    throw Failure(fmt::format("The tables are written, but figures/{} failed: {}", script,
                              ended.said.empty() ? "no reason given." : last_line(ended.said)));
}

}  // namespace swirl
