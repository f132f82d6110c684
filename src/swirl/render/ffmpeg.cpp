#include "swirl/render/ffmpeg.hpp"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>

#include "swirl/io/system_calls.hpp"
#include "swirl/render/canvas.hpp"

namespace swirl {

namespace {

[[noreturn]] void throw_cannot_start(int error) {
    throw DrawFailure(std::string("cannot start ffmpeg: ") + std::strerror(error) + ".");
}

/// A child in its own process group, with default handling of signals and none blocked.
void set_up_process(posix_spawnattr_t& attributes) {
    sigset_t none, all;
    sigemptyset(&none);
    sigfillset(&all);
    posix_spawnattr_setpgroup(&attributes, 0);
    posix_spawnattr_setsigmask(&attributes, &none);
    posix_spawnattr_setsigdefault(&attributes, &all);
    posix_spawnattr_setflags(
        &attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
}

}  // namespace

Ffmpeg::Ffmpeg(std::vector<std::string> arguments, Side side, const std::string& missing,
               const std::string& output) {
    // A socket instead of a pipe: writing to a dead reader gives an error instead of a signal.
    int ends[2];
    errors_ = system::open_unnamed_file();
    if (errors_ < 0 || !system::open_socket_pair(ends)) {
        const int error = errno;
        if (errors_ >= 0) ::close(errors_);
        throw_cannot_start(error);
    }
    socket_ = ends[0];
    const int buffer_size = 1 << 20;
    for (const Side from : {Side::input, Side::output})
        if (side == from || side == Side::both)
            ::setsockopt(ends[from == Side::input ? 0 : 1], SOL_SOCKET, SO_SNDBUF, &buffer_size,
                         sizeof buffer_size);

    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    const auto open_null = [&](int descriptor, int mode) {
        posix_spawn_file_actions_addopen(&files, descriptor, "/dev/null", mode, 0);
    };
    if (side == Side::output)
        open_null(STDIN_FILENO, O_RDONLY);
    else
        posix_spawn_file_actions_adddup2(&files, ends[1], STDIN_FILENO);
    if (side == Side::input)
        open_null(STDOUT_FILENO, O_WRONLY);
    else
        posix_spawn_file_actions_adddup2(&files, ends[1], STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&files, errors_, STDERR_FILENO);
    if (!output.empty())
        posix_spawn_file_actions_addopen(&files, output_number, output.c_str(), O_RDWR | O_NOFOLLOW,
                                         0);
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    set_up_process(attributes);
    std::string name = "ffmpeg";
    std::vector<char*> pointers{name.data()};
    for (std::string& argument : arguments) pointers.push_back(argument.data());
    pointers.push_back(nullptr);
    const int error = ::posix_spawnp(&process_, "ffmpeg", &files, &attributes, pointers.data(),
                                     system::environment());
    posix_spawn_file_actions_destroy(&files);
    posix_spawnattr_destroy(&attributes);
    ::close(ends[1]);
    if (error == 0) return;
    ::close(socket_);
    ::close(errors_);
    if (error == ENOENT) throw DrawFailure(missing);
    throw_cannot_start(error);
}

Ffmpeg::~Ffmpeg() {
    if (process_ > 0) {
        ::kill(process_, SIGKILL);
        end();
    }
    ::close(errors_);
}

int Ffmpeg::end() {
    if (socket_ >= 0) ::close(socket_);
    socket_ = -1;
    int status = 0;
    while (::waitpid(process_, &status, 0) < 0 && errno == EINTR) {
    }
    process_ = -1;
    return status;
}

std::string Ffmpeg::error_output() const {
    std::array<char, 4096> text{};
    const ssize_t count = ::pread(errors_, text.data(), text.size(), 0);
    return std::string(text.data(), count > 0 ? static_cast<std::size_t>(count) : 0);
}

std::string Ffmpeg::problem() const {
    std::string line = error_output();
    line.resize(std::min(line.find_first_of("\r\n"), line.size()));
    // The prefix "[libx264 @ 0x5581…] " is no information for the user.
    const std::size_t end = line.find("] ");
    if (line.starts_with('[') && line.find(" @ 0x") < end && end != line.npos)
        line.erase(0, end + 2);
    return line;
}

std::string Ffmpeg::describe_end(int status) const {
    const std::string how = WIFSIGNALED(status)
                                ? "was killed by signal " + std::to_string(WTERMSIG(status))
                                : "ended with code " + std::to_string(WEXITSTATUS(status));
    const std::string cause = problem();
    return cause.empty() ? how + "." : how + " and printed: " + cause;
}

}  // namespace swirl
