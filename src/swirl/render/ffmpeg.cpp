#include "swirl/render/ffmpeg.hpp"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>

#include "swirl/render/canvas.hpp"

extern char** environ;

namespace swirl {

Ffmpeg::Ffmpeg(std::vector<std::string> arguments, Side side, const std::string& missing,
               const std::string& output) {
    // A socket and not a pipe: writing to a dead reader then gives an error instead of a signal.
    std::array<int, 2> ends{};
    problems_ = ::memfd_create("ffmpeg-stderr", MFD_CLOEXEC);
    if (problems_ < 0 || ::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) {
        const std::string reason = std::strerror(errno);
        if (problems_ >= 0) ::close(problems_);
        throw DrawFailure("ffmpeg could not be started: " + reason + ".");
    }
    socket_ = ends[0];
    const int roomy = 1 << 20;
    ::setsockopt(ends[side == Side::input ? 0 : 1], SOL_SOCKET, SO_SNDBUF, &roomy, sizeof roomy);

    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    const auto nothing = [&](int descriptor, int how) {
        posix_spawn_file_actions_addopen(&files, descriptor, "/dev/null", how, 0);
    };
    if (side == Side::input) {
        posix_spawn_file_actions_adddup2(&files, ends[1], STDIN_FILENO);
        nothing(STDOUT_FILENO, O_WRONLY);
    } else {
        nothing(STDIN_FILENO, O_RDONLY);
        posix_spawn_file_actions_adddup2(&files, ends[1], STDOUT_FILENO);
    }
    posix_spawn_file_actions_adddup2(&files, problems_, STDERR_FILENO);
    if (!output.empty())
        posix_spawn_file_actions_addopen(&files, output_number, output.c_str(), O_RDWR | O_NOFOLLOW,
                                         0);
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
    std::string name = "ffmpeg";
    std::vector<char*> pointers{name.data()};
    for (std::string& argument : arguments) pointers.push_back(argument.data());
    pointers.push_back(nullptr);
    const int error =
        ::posix_spawnp(&process_, "ffmpeg", &files, &attributes, pointers.data(), environ);
    posix_spawn_file_actions_destroy(&files);
    posix_spawnattr_destroy(&attributes);
    ::close(ends[1]);
    if (error == 0) return;
    ::close(socket_);
    ::close(problems_);
    if (error == ENOENT) throw DrawFailure(missing);
    throw DrawFailure(std::string("ffmpeg could not be started: ") + std::strerror(error) + ".");
}

Ffmpeg::~Ffmpeg() {
    if (process_ > 0) {
        ::kill(process_, SIGKILL);
        end();
    }
    ::close(problems_);
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

std::string Ffmpeg::said() const {
    std::array<char, 4096> text{};
    const ssize_t count = ::pread(problems_, text.data(), text.size(), 0);
    return std::string(text.data(), count > 0 ? static_cast<std::size_t>(count) : 0);
}

std::string Ffmpeg::problem() const {
    std::string line = said();
    line.resize(std::min(line.find_first_of("\r\n"), line.size()));
    // "[libx264 @ 0x5581…] " tells nobody anything.
    const std::size_t end = line.find("] ");
    if (line.starts_with('[') && line.find(" @ 0x") < end && end != line.npos)
        line.erase(0, end + 2);
    return line;
}

std::string Ffmpeg::how_it_ended(int status) const {
    const std::string how = WIFSIGNALED(status)
                                ? "was killed by signal " + std::to_string(WTERMSIG(status))
                                : "ended with code " + std::to_string(WEXITSTATUS(status));
    const std::string words = problem();
    return words.empty() ? how + "." : how + " and said: " + words;
}

}  // namespace swirl
