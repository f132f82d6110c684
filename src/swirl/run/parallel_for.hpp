// Independent tasks on all cores. Results must not depend on which thread runs a task: each task
// has its own seed and its own place in the output.
#pragma once

#include <cstddef>
#include <functional>

namespace swirl {

/// The number of cores available to this process (at least 1).
unsigned available_cores();

/// Calls work(0) … work(count − 1) from `threads` threads (0: one per core). Calls start in this
/// order. If one throws, no further call starts; the first exception is rethrown when the running
/// calls have ended.
void parallel_for(std::size_t count, const std::function<void(std::size_t)>& work,
                  unsigned threads = 0);

}  // namespace swirl
