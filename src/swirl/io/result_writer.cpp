#include "swirl/io/result_writer.hpp"

#include <algorithm>
#include <chrono>
#include <memory>
#include <utility>

#include "swirl/io/atomic_file.hpp"

namespace swirl {
namespace {

constexpr std::chrono::milliseconds gathering(200);
/// Each has a descriptor until it has its name, and a process may have a thousand or so.
constexpr std::size_t max_at_once = 128;

}  // namespace

ResultWriter::ResultWriter(const std::filesystem::path& folder)
    : folder_(folder), thread_([this] { work(); }) {}

ResultWriter::~ResultWriter() {
    try {
        finish();
    } catch (...) {
        // Who wants to know has called finish().
    }
}

void ResultWriter::write(std::string name, std::string bytes, std::function<void()> written) {
    const std::lock_guard lock(mutex_);
    if (failure_) std::rethrow_exception(failure_);
    waiting_.push_back({std::move(name), std::move(bytes), std::move(written)});
    wake_.notify_all();
}

void ResultWriter::finish() {
    {
        const std::lock_guard lock(mutex_);
        closing_ = true;
        wake_.notify_all();
    }
    if (thread_.joinable()) thread_.join();
    if (failure_) std::rethrow_exception(failure_);
}

void ResultWriter::work() {
    std::unique_lock lock(mutex_);
    for (;;) {
        wake_.wait(lock, [this] { return closing_ || !waiting_.empty(); });
        if (!closing_) wake_.wait_for(lock, gathering, [this] { return closing_; });
        if (waiting_.empty() && closing_) return;
        std::vector<Item> items = std::exchange(waiting_, {});
        lock.unlock();
        std::exception_ptr failure;
        try {
            for (std::size_t k = 0; k < items.size(); k += max_at_once)
                write_together({items.data() + k, std::min(max_at_once, items.size() - k)});
        } catch (...) {
            failure = std::current_exception();
        }
        lock.lock();
        if (failure && !failure_) failure_ = failure;
    }
}

void ResultWriter::write_together(std::span<Item> items) {
    SyncTogether together(folder_);
    // Unfinished ones remove themselves.
    std::vector<std::unique_ptr<AtomicFile>> files;
    for (const Item& item : items) {
        files.push_back(std::make_unique<AtomicFile>(folder_ / item.name));
        files.back()->append(item.bytes);
        files.back()->empty_buffer();
    }
    together.sync();
    for (const auto& file : files) file->give_name();
    sync_folder_of(folder_ / items.front().name);
    for (const Item& item : items)
        if (item.written) item.written();
}

}  // namespace swirl
