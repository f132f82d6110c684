// Frames drawn on all cores and handed over in order.
//
//     producer ──▶ painters, each with its own canvas ──▶ one writer, in the order of submission
//
// Never more than a few frames are under way, so memory does not grow with the length of a movie.
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

class Painters {
  public:
    using Bytes = std::vector<std::uint8_t>;
    /// Makes the bytes of a frame, on the thread of the painter of that number.
    using Paint = std::function<void(unsigned painter, Bytes& bytes)>;

    /// `deliver` is called with one frame after the other, on one thread.
    Painters(unsigned count, std::function<void(const Bytes&)> deliver);
    ~Painters();

    /// Hands in the next frame; waits while too many are under way. Throws what a painter or the
    /// delivery threw.
    void submit(Paint paint);
    /// Waits until everything is delivered. Throws as submit().
    void finish();
    /// Frames delivered so far.
    std::size_t delivered() const;

  private:
    struct Task {
        std::size_t number;
        Paint paint;
    };

    void work(unsigned painter);
    void write();
    void end();
    void fail(std::exception_ptr error);

    std::function<void(const Bytes&)> deliver_;
    const std::size_t max_under_way_;
    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<Task> waiting_;
    std::map<std::size_t, Bytes> painted_;
    std::vector<Bytes> spare_;
    std::size_t submitted_ = 0, delivered_ = 0;
    bool closed_ = false;
    std::exception_ptr error_;
    std::vector<std::thread> threads_;
};

}  // namespace swirl
