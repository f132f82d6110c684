// Ctrl-C, SIGTERM and SIGHUP end the work cleanly: they set a flag that the work looks at. A second
// one ends the program at once, unless it comes so soon that it must be the same keystroke.
#pragma once

#include <atomic>

namespace swirl {

/// From the first call on, the signals set the flag instead of killing.
const std::atomic<bool>& stop_signal();

}  // namespace swirl
