// Independent pieces of work, spread over all cores. Which core does which piece never shows in a
// result: every piece has its own seed and its own place in the answer.
#pragma once

#include <cstddef>
#include <functional>

namespace swirl {

/// How many cores there are for us (at least 1).
unsigned available_cores();

/// Calls work(0) … work(count − 1), in this order of beginning, from `threads` threads at once
/// (0: one for each core). If one throws, no further piece is begun, and when those under way have
/// ended its exception is thrown here.
void parallel_for(std::size_t count, const std::function<void(std::size_t)>& work,
                  unsigned threads = 0);

}  // namespace swirl
