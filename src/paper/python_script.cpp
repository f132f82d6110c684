#include "swirl/paper/python_script.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
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
    int patience = -1;  // none is needed yet
    for (;;) {
        constexpr int look = 50;  // ms
        const int ready = poll(&waited, 1, look);
        if (ready > 0 && !listen(ends[0], ended.said)) break;
        if (patience < 0 && stop != nullptr && stop->load()) {
            patience = grace / look;
            kill(-child, SIGINT);
        }
        if (ready == 0 && patience > 0 && --patience == 0) kill(-child, SIGKILL);
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

}  // namespace

fs::path figures_folder() {
    if (const char* const given = std::getenv("SWIRL_FIGURES"); given && *given) return given;
    std::error_code ignored;
    const fs::path beside = fs::read_symlink("/proc/self/exe", ignored).parent_path();
    if (fs::path installed = beside / "../share/swirl/figures";
        fs::exists(installed / "style.py", ignored))
        return fs::canonical(installed, ignored);
    for (fs::path folder = beside; folder.has_relative_path(); folder = folder.parent_path())
        if (fs::exists(folder / "figures" / "style.py", ignored)) return folder / "figures";
    throw Failure(
        "The folder with the scripts that draw is not where this program is installed; set "
        "SWIRL_FIGURES to where it is.");
}

void run_python_script(const std::string& script, const std::vector<std::string>& arguments,
                       const std::atomic<bool>* stop) {
    std::vector<std::string> words{interpreter, "-B", (figures_folder() / script).string()};
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
