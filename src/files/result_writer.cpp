#include "swirl/files/result_writer.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <memory>
#include <utility>

#include "swirl/files/file_error.hpp"
#include "swirl/files/whole_file.hpp"

namespace swirl {
namespace {

constexpr std::chrono::milliseconds gathering(200);

}  // namespace

ResultWriter::ResultWriter(const std::filesystem::path& folder)
    : folder_(folder), thread_([this] { work(); }) {}

ResultWriter::~ResultWriter() {
    try {
        finish();
    } catch (const FileError&) {
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
            write_together(items);
        } catch (const FileError&) {
            failure = std::current_exception();
        }
        lock.lock();
        if (failure && !failure_) failure_ = failure;
    }
}

void ResultWriter::write_together(std::vector<Item>& items) {
    // Unfinished ones remove themselves.
    std::vector<std::unique_ptr<WholeFile>> files;
    for (const Item& item : items) {
        files.push_back(std::make_unique<WholeFile>(folder_ / item.name));
        files.back()->append(item.bytes);
        files.back()->empty_buffer();
    }
    const int handle = ::open(folder_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (handle < 0 || ::syncfs(handle) != 0) {
        const std::string reason = system_reason();
        if (handle >= 0) ::close(handle);
        throw FileError(fmt::format("'{}' could not be written to: {}.", folder_.string(), reason));
    }
    for (std::size_t k = 0; k < items.size(); ++k) {
        files[k]->give_name();
        if (items[k].written) items[k].written();
    }
    ::fsync(handle);
    ::close(handle);
}

}  // namespace swirl
