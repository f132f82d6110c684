#include "swirl/io/result_writer.hpp"

#include <algorithm>
#include <chrono>
#include <memory>
#include <utility>

#include "swirl/io/atomic_file.hpp"

namespace swirl {
namespace {

/// How long the thread waits for more files before it writes a batch.
constexpr std::chrono::milliseconds collection_time(200);
/// Each file of a batch has an open descriptor; a process may have about a thousand.
constexpr std::size_t max_batch = 128;

}  // namespace

ResultWriter::ResultWriter(const std::filesystem::path& folder)
    : folder_(folder), thread_([this] { work(); }) {}

ResultWriter::~ResultWriter() {
    try {
        finish();
    } catch (...) {
        // finish() reports errors.
    }
}

void ResultWriter::write(std::string name, std::string bytes, std::function<void()> written) {
    const std::lock_guard lock(mutex_);
    if (failure_) std::rethrow_exception(failure_);
    queue_.push_back({std::move(name), std::move(bytes), std::move(written)});
    if (queue_.size() == 1) wake_.notify_all();  // later files do not wake the thread
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
        wake_.wait(lock, [this] { return closing_ || !queue_.empty(); });
        if (!closing_) wake_.wait_for(lock, collection_time, [this] { return closing_; });
        if (queue_.empty() && closing_) return;
        std::vector<Item> items = std::exchange(queue_, {});
        lock.unlock();
        std::exception_ptr failure;
        try {
            for (std::size_t k = 0; k < items.size(); k += max_batch)
                write_batch({items.data() + k, std::min(max_batch, items.size() - k)});
        } catch (...) {
            failure = std::current_exception();
        }
        lock.lock();
        if (failure && !failure_) failure_ = failure;
    }
}

void ResultWriter::write_batch(std::span<Item> items) {
    FilesystemSync filesystem(folder_);
    // After an exception, their destructors remove the temporary files.
    std::vector<std::unique_ptr<AtomicFile>> files;
    for (const Item& item : items) {
        files.push_back(std::make_unique<AtomicFile>(folder_ / item.name));
        files.back()->append(item.bytes);
        files.back()->flush_buffer();
    }
    filesystem.sync();
    for (const auto& file : files) file->publish();
    sync_folder_of(folder_ / items.front().name);
    for (const Item& item : items)
        if (item.written) item.written();
}

}  // namespace swirl
