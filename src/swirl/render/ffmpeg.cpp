#include "swirl/render/ffmpeg.hpp"

#include <signal.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>

#include "swirl/io/child_process.hpp"
#include "swirl/io/system_calls.hpp"
#include "swirl/render/canvas.hpp"

namespace swirl {

namespace {

[[noreturn]] void throw_cannot_start(int error) {
    throw DrawFailure(std::string("cannot start ffmpeg: ") + std::strerror(error) + ".");
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

    ChildFiles files{.errors = errors_, .third = output};
    if (side != Side::output) files.input = ends[1];
    if (side != Side::input) files.output = ends[1];
    arguments.insert(arguments.begin(), "ffmpeg");
    const int error = start_child(std::move(arguments), files, process_);
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
    const int status = wait_for_child(process_);
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
