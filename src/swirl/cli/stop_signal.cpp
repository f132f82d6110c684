#include "swirl/cli/stop_signal.hpp"

#include <unistd.h>

#include <csignal>
#include <ctime>

namespace swirl {
namespace {

std::atomic<bool> stop = false;
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may not lock");

/// A wrapper such as timeout(1) signals its child and then the whole group, so one Ctrl-C may
/// arrive twice: what comes this soon after the first is the same.
constexpr long same_moment = 300;  // ms

std::atomic<long> noted = 0;  // ms on the monotonic clock
static_assert(std::atomic<long>::is_always_lock_free);

extern "C" void note_signal(int) {
    timespec now{};
    clock_gettime(CLOCK_MONOTONIC, &now);
    const long ms = now.tv_sec * 1000 + now.tv_nsec / 1000000;
    if (!stop.exchange(true)) {
        noted = ms;
        return;
    }
    if (ms - noted > same_moment) _exit(130);
}

}  // namespace

const std::atomic<bool>& stop_signal() {
    static const bool installed = [] {
        struct sigaction action {};
        action.sa_handler = note_signal;
        sigemptyset(&action.sa_mask);
        action.sa_flags = SA_RESTART;
        sigaction(SIGINT, &action, nullptr);
        sigaction(SIGTERM, &action, nullptr);
        // The terminal is gone; but who was started by nohup(1) goes on.
        struct sigaction inherited {};
        sigaction(SIGHUP, nullptr, &inherited);
        if (inherited.sa_handler != SIG_IGN) sigaction(SIGHUP, &action, nullptr);
        return true;
    }();
    (void)installed;
    return stop;
}

}  // namespace swirl
