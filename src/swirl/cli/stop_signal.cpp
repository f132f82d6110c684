#include "swirl/cli/stop_signal.hpp"

#include <unistd.h>

#include <csignal>
#include <ctime>

namespace swirl {
namespace {

std::atomic<bool> stop = false;
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may not lock");

/// A wrapper such as timeout(1) signals its child and then the whole process group, so one Ctrl-C
/// may arrive twice. A second signal within this time counts as the same one.
constexpr long same_signal_time = 300;  // ms

std::atomic<long> first_signal_time = 0;  // ms on the monotonic clock
static_assert(std::atomic<long>::is_always_lock_free);

extern "C" void handle_signal(int) {
    timespec now{};
    clock_gettime(CLOCK_MONOTONIC, &now);
    const long ms = now.tv_sec * 1000 + now.tv_nsec / 1000000;
    if (!stop.exchange(true)) {
        first_signal_time = ms;
        return;
    }
    if (ms - first_signal_time > same_signal_time) _exit(130);
}

}  // namespace

const std::atomic<bool>& stop_signal() {
    static const bool installed = [] {
        struct sigaction action {};
        action.sa_handler = handle_signal;
        sigemptyset(&action.sa_mask);
        action.sa_flags = SA_RESTART;
        sigaction(SIGINT, &action, nullptr);
        sigaction(SIGTERM, &action, nullptr);
        // SIGHUP: the terminal is closed. A program started by nohup(1) ignores it.
        struct sigaction inherited {};
        sigaction(SIGHUP, nullptr, &inherited);
        if (inherited.sa_handler != SIG_IGN) sigaction(SIGHUP, &action, nullptr);
        return true;
    }();
    (void)installed;
    return stop;
}

}  // namespace swirl
