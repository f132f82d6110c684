#include "swirl/io/child_process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>

#include "swirl/io/system_calls.hpp"

namespace swirl {
namespace {

/// Time for a program to remove its temporary files when it is interrupted.
constexpr int grace = 500;         // ms
constexpr int poll_interval = 50;  // ms

/// Appends available output; false at its end.
bool read_output(int end, std::string& output) {
    std::array<char, 4096> block;
    const ssize_t got = ::read(end, block.data(), block.size());
    if (got < 0) return errno == EINTR;
    output.append(block.data(), static_cast<std::size_t>(got));
    return got > 0;
}

}  // namespace

int start_child(std::vector<std::string> words, const ChildFiles& files, int& process) {
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    const std::array streams{files.input, files.output, files.errors};
    for (int k = 0; k < 3; ++k)
        if (streams[k] >= 0)
            posix_spawn_file_actions_adddup2(&actions, streams[k], k);
        else
            posix_spawn_file_actions_addopen(&actions, k, "/dev/null", k == 0 ? O_RDONLY : O_WRONLY,
                                             0);
    if (!files.third.empty())
        posix_spawn_file_actions_addopen(&actions, 3, files.third.c_str(), O_RDWR | O_NOFOLLOW, 0);
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    sigset_t none, all;
    sigemptyset(&none);
    sigfillset(&all);
    posix_spawnattr_setpgroup(&attributes, 0);
    posix_spawnattr_setsigmask(&attributes, &none);
    posix_spawnattr_setsigdefault(&attributes, &all);
    posix_spawnattr_setflags(
        &attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
    std::vector<char*> pointers;
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    const int error = ::posix_spawnp(&process, pointers[0], &actions, &attributes, pointers.data(),
                                     system::environment());
    posix_spawn_file_actions_destroy(&actions);
    posix_spawnattr_destroy(&attributes);
    return error;
}

int wait_for_child(int process) {
    int status = 0;
    while (::waitpid(process, &status, 0) < 0 && errno == EINTR) {
    }
    return status;
}

ProgramOutput run_program(const std::vector<std::string>& words, const std::atomic<bool>* stop) {
    ProgramOutput result;
    int ends[2], child = 0;
    if (!system::open_pipe(ends)) return {.error = errno};
    result.error = start_child(words, {.output = ends[1], .errors = ends[1]}, child);
    ::close(ends[1]);
    pollfd waited{ends[0], POLLIN, 0};
    int polls_left = -1;  // polls until the program is killed; -1: not interrupted
    while (result.error == 0) {
        const int ready = ::poll(&waited, 1, poll_interval);
        if (ready > 0 && !read_output(ends[0], result.text)) break;
        if (polls_left < 0 && stop != nullptr && stop->load()) {
            polls_left = grace / poll_interval;
            ::kill(-child, SIGINT);
        }
        if (ready == 0 && polls_left > 0 && --polls_left == 0) ::kill(-child, SIGKILL);
    }
    ::close(ends[0]);
    if (result.error != 0) return result;
    const int status = wait_for_child(child);
    if (WIFEXITED(status)) result.exit_code = WEXITSTATUS(status);
    return result;
}

}  // namespace swirl
