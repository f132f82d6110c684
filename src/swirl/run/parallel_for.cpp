#include "swirl/run/parallel_for.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#include "swirl/io/system_calls.hpp"

namespace swirl {

unsigned available_cores() {
    // Not hardware_concurrency(): a batch system may grant fewer cores than the machine has.
    const unsigned granted = system::granted_cores();
    return std::max(1u, granted > 0 ? granted : std::thread::hardware_concurrency());
}

void parallel_for(std::size_t count, const std::function<void(std::size_t)>& work,
                  unsigned threads) {
    std::atomic<std::size_t> next = 0;
    std::exception_ptr failure;
    std::mutex failure_mutex;
    const auto loop = [&] {
        for (std::size_t k; (k = next.fetch_add(1)) < count;) {
            try {
                work(k);
            } catch (...) {
                const std::lock_guard lock(failure_mutex);
                if (!failure) failure = std::current_exception();
                next = count;
            }
        }
    };
    const std::size_t max_threads = threads > 0 ? threads : available_cores();
    std::vector<std::thread> team;
    try {
        for (std::size_t t = 1; t < std::min(max_threads, count); ++t) team.emplace_back(loop);
    } catch (const std::exception&) {
        // No memory or permission for more threads: continue with those that started.
    }
    loop();
    for (std::thread& thread : team) thread.join();
    if (failure) std::rethrow_exception(failure);
}

}  // namespace swirl
