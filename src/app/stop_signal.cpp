#include "app/stop_signal.hpp"

#include <unistd.h>
#include <csignal>

namespace swirl {
namespace {

std::atomic<bool> stop = false;
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may not lock");

extern "C" void note_signal(int) {
    if (stop.exchange(true)) _exit(130);
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
        return true;
    }();
    (void)installed;
    return stop;
}

}  // namespace swirl
