#include "swirl/cli/trial_reading.hpp"

#include <fmt/format.h>

#include <fcntl.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstring>

#include "swirl/cli/stop_signal.hpp"
#include "swirl/io/atomic_file.hpp"
#include "swirl/io/child_process.hpp"
#include "swirl/io/event_log.hpp"
#include "swirl/io/system_calls.hpp"
#include "swirl/io/track_recording.hpp"
#include "swirl/io/trajectory.hpp"
#include "swirl/run/failure.hpp"

namespace swirl {
namespace {

void read_all_of_log(const std::string& file) {
    constexpr std::uint64_t events_per_read = 1 << 16;
    const EventLogReader log(file);
    for (const char* name : {"parameters", "version"}) log.provenance(name);
    for (std::uint64_t k = 0; k < log.events(); k += events_per_read)
        log.read(k, std::min(events_per_read, log.events() - k));
}

/// Runs in the child. Its exit status is 0 even if the file is rejected: only a crash matters.
[[noreturn]] void read_and_exit(const std::string& file) {
    system::end_with_parent();
    const rlimit no_core{0, 0};
    setrlimit(RLIMIT_CORE, &no_core);
    for (const int crash : {SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL}) std::signal(crash, SIG_DFL);
    try {
        if (is_event_log(file))
            read_all_of_log(file);
        else if (is_track_recording(file))
            read_track_recording(file);
        else
            TrajectoryReader(file).read_all();
    } catch (...) {
    }
    _exit(0);
}

/// Waits for the child, which holds the other end of the pipe. Kills it if a stop signal arrives.
int status_of(pid_t child, int read_end) {
    pollfd wait{read_end, POLLIN, 0};
    constexpr int milliseconds = 100;
    while (poll(&wait, 1, milliseconds) <= 0)
        if (stop_signal().load()) kill(child, SIGKILL);
    return wait_for_child(child);
}

}  // namespace

void try_reading(const std::string& file) {
    if (!file_signature(file).starts_with("\x89HDF")) return;
    stop_signal();
    // Only the child holds the write end, and never writes: poll() reports when the child ends.
    int ends[2];
    if (!system::open_pipe(ends))
        throw Failure(fmt::format(
            "no pipe could be created to read the file in a child process: {}.", system_reason()));
    const pid_t child = fork();
    if (child == 0) read_and_exit(file);
    const std::string reason = system_reason();
    close(ends[1]);
    const int status = child < 0 ? 0 : status_of(child, ends[0]);
    close(ends[0]);
    if (child < 0)
        throw Failure(
            fmt::format("no child process could be started to read the file: {}.", reason));
    if (stop_signal().load()) throw Interrupted("stopped while the file was read.");
    const int signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
    // SIGKILL means that memory ran out or that a user killed the child, not that the file is
    // damaged.
    if (status == 0 || signal == SIGKILL) return;
    throw Failure(fmt::format("'{}' is damaged: reading it crashes the HDF5 library ({}).", file,
                              signal != 0 ? strsignal(signal) : "its process ended"));
}

}  // namespace swirl
