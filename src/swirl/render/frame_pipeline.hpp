// Draws frames on all cores and delivers them in order.
//
//     producer ──▶ workers, each with its own canvas ──▶ one writer, in the order of submission
//
// Only a few frames are in progress at a time, so memory does not grow with the length of a movie.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <exception>
#include <functional>
#include <map>
#include <mutex>
#include <thread>
#include <vector>

namespace swirl {

class FramePipeline {
  public:
    using Bytes = std::vector<std::uint8_t>;
    /// Computes the bytes of a frame in the thread of the given worker.
    using Draw = std::function<void(unsigned worker, Bytes& bytes)>;

    /// `deliver` is called with one frame after the other, in one thread.
    FramePipeline(unsigned workers, std::function<void(const Bytes&)> deliver);
    ~FramePipeline();

    /// Adds the next frame. Waits while too many are in progress. Rethrows an exception of a worker
    /// or of the delivery.
    void submit(Draw draw);
    /// Waits until every frame is delivered. Rethrows like submit().
    void finish();
    /// Number of frames delivered so far.
    std::size_t delivered() const;

  private:
    struct Task {
        std::size_t number;
        Draw draw;
    };

    void work(unsigned worker);
    void write();
    void stop();
    void fail(std::exception_ptr error);

    std::function<void(const Bytes&)> deliver_;
    const std::size_t max_in_progress_;
    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<Task> waiting_;
    std::map<std::size_t, Bytes> drawn_;
    std::vector<Bytes> spare_;
    std::size_t submitted_ = 0, delivered_ = 0;
    bool closed_ = false;
    std::exception_ptr error_;
    std::vector<std::thread> threads_;
};

}  // namespace swirl
