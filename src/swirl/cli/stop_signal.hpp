// Ctrl-C, SIGTERM and SIGHUP end the work cleanly: they set a flag that the work tests regularly. A
// second signal ends the program at once, unless it follows so soon that it has the same cause.
#pragma once

#include <atomic>

namespace swirl {

/// The flag. The first call installs the signal handlers.
const std::atomic<bool>& stop_signal();

}  // namespace swirl
