#include "swirl/render/painters.hpp"

#include <stdexcept>
#include <utility>

namespace swirl {

Painters::Painters(unsigned count, std::function<void(const Bytes&)> deliver)
    : deliver_(std::move(deliver)), max_under_way_(2 * count + 2) {
    try {
        for (unsigned k = 0; k < count; ++k) threads_.emplace_back([this, k] { work(k); });
        threads_.emplace_back([this] { write(); });
    } catch (...) {  // no memory or no right for another thread: those that run must end
        end();
        throw;
    }
}

Painters::~Painters() { end(); }

void Painters::end() {
    {
        const std::lock_guard lock(mutex_);
        closed_ = true;
        waiting_.clear();
        if (!error_ && delivered_ < submitted_)
            error_ = std::make_exception_ptr(std::runtime_error("The frames were abandoned."));
    }
    changed_.notify_all();
    for (std::thread& thread : threads_) thread.join();
}

void Painters::submit(Paint paint) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return error_ || submitted_ - delivered_ < max_under_way_; });
    if (error_) std::rethrow_exception(error_);
    waiting_.push_back({submitted_++, std::move(paint)});
    changed_.notify_all();
}

void Painters::finish() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return error_ || delivered_ == submitted_; });
    if (error_) std::rethrow_exception(error_);
}

std::size_t Painters::delivered() const {
    const std::lock_guard lock(mutex_);
    return delivered_;
}

void Painters::fail(std::exception_ptr error) {
    {
        const std::lock_guard lock(mutex_);
        if (!error_) error_ = error;
    }
    changed_.notify_all();
}

void Painters::work(unsigned painter) {
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
            task.paint(painter, bytes);
        } catch (...) {
            fail(std::current_exception());
            return;
        }
        {
            const std::lock_guard lock(mutex_);
            painted_.emplace(task.number, std::move(bytes));
        }
        changed_.notify_all();
    }
}

void Painters::write() {
    while (true) {
        Bytes bytes;
        {
            std::unique_lock lock(mutex_);
            changed_.wait(lock, [&] {
                return error_ || painted_.contains(delivered_) ||
                       (closed_ && delivered_ == submitted_);
            });
            if (error_ || !painted_.contains(delivered_)) return;
            bytes = std::move(painted_.extract(delivered_).mapped());
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
