#include "swirl/render/frame_pipeline.hpp"

#include <stdexcept>
#include <utility>

namespace swirl {

FramePipeline::FramePipeline(unsigned workers, std::function<void(const Bytes&)> deliver)
    : deliver_(std::move(deliver)), max_in_progress_(2 * workers + 2) {
    try {
        for (unsigned k = 0; k < workers; ++k) threads_.emplace_back([this, k] { work(k); });
        threads_.emplace_back([this] { write(); });
    } catch (...) {  // no further thread could be started: join the others
        stop();
        throw;
    }
}

FramePipeline::~FramePipeline() { stop(); }

void FramePipeline::stop() {
    {
        const std::lock_guard lock(mutex_);
        closed_ = true;
        waiting_.clear();
        if (!error_ && delivered_ < submitted_)
            error_ = std::make_exception_ptr(
                std::runtime_error("frames were submitted but not delivered."));
    }
    changed_.notify_all();
    for (std::thread& thread : threads_) thread.join();
}

void FramePipeline::submit(Draw draw) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return error_ || submitted_ - delivered_ < max_in_progress_; });
    if (error_) std::rethrow_exception(error_);
    waiting_.push_back({submitted_++, std::move(draw)});
    changed_.notify_all();
}

void FramePipeline::finish() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return error_ || delivered_ == submitted_; });
    if (error_) std::rethrow_exception(error_);
}

std::size_t FramePipeline::delivered() const {
    const std::lock_guard lock(mutex_);
    return delivered_;
}

void FramePipeline::fail(std::exception_ptr error) {
    {
        const std::lock_guard lock(mutex_);
        if (!error_) error_ = error;
    }
    changed_.notify_all();
}

void FramePipeline::work(unsigned worker) {
    while (true) {
        Task task;
        Bytes bytes;
        {
            std::unique_lock lock(mutex_);
            changed_.wait(lock, [&] { return closed_ || error_ || !waiting_.empty(); });
            if (error_ || waiting_.empty()) return;
            task = std::move(waiting_.front());
            waiting_.pop_front();
            if (!spare_.empty()) {
                bytes = std::move(spare_.back());
                spare_.pop_back();
            }
        }
        try {
            task.draw(worker, bytes);
        } catch (...) {
            fail(std::current_exception());
            return;
        }
        {
            const std::lock_guard lock(mutex_);
            drawn_.emplace(task.number, std::move(bytes));
        }
        changed_.notify_all();
    }
}

void FramePipeline::write() {
    while (true) {
        Bytes bytes;
        {
            std::unique_lock lock(mutex_);
            changed_.wait(lock, [&] {
                return error_ || drawn_.contains(delivered_) ||
                       (closed_ && delivered_ == submitted_);
            });
            if (error_ || !drawn_.contains(delivered_)) return;
            bytes = std::move(drawn_.extract(delivered_).mapped());
        }
        try {
            deliver_(bytes);
        } catch (...) {
            fail(std::current_exception());
            return;
        }
        {
            const std::lock_guard lock(mutex_);
            ++delivered_;
            spare_.push_back(std::move(bytes));
        }
        changed_.notify_all();
    }
}

}  // namespace swirl
