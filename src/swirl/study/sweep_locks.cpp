#include "swirl/study/sweep_locks.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

#include "swirl/io/atomic_file.hpp"
#include "swirl/io/file_error.hpp"
#include "swirl/io/optional_file.hpp"

namespace swirl {
namespace {

namespace fs = std::filesystem;

fs::path lock_file(const fs::path& folder) { return folder / "locks"; }

struct flock byte_range(std::size_t point, std::size_t count, int type) {
    struct flock lock {};
    lock.l_type = static_cast<short>(type);
    lock.l_whence = SEEK_SET;
    lock.l_start = static_cast<off_t>(point);
    lock.l_len = static_cast<off_t>(count);
    return lock;
}

}  // namespace

SweepLocks::SweepLocks(const fs::path& folder)
    : handle_(::open(lock_file(folder).c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666)) {
    if (handle_ < 0)
        throw FileError(fmt::format("'{}' could not be written: {}.", lock_file(folder).string(),
                                    system_reason()));
}

SweepLocks::~SweepLocks() { ::close(handle_); }

/// Errors other than "locked by another process" count as success: the lock is not essential.
bool SweepLocks::lock(std::size_t point) {
    struct flock range = byte_range(point, 1, F_WRLCK);
    return ::fcntl(handle_, F_OFD_SETLK, &range) == 0 || (errno != EAGAIN && errno != EACCES);
}

void SweepLocks::unlock(std::size_t point) {
    struct flock range = byte_range(point, 1, F_UNLCK);
    ::fcntl(handle_, F_OFD_SETLK, &range);
}

std::vector<bool> SweepLocks::locked(const fs::path& folder, std::size_t points) {
    std::vector<bool> locked(points, false);
    if (!file_exists(lock_file(folder))) return locked;
    const int handle = ::open(lock_file(folder).c_str(), O_RDWR | O_CLOEXEC);
    for (std::size_t from = 0; handle >= 0 && from < points;) {
        struct flock range = byte_range(from, points - from, F_WRLCK);
        if (::fcntl(handle, F_OFD_GETLK, &range) != 0 || range.l_type == F_UNLCK) break;
        const auto first = static_cast<std::size_t>(range.l_start);
        const std::size_t end =
            range.l_len > 0 ? std::min(points, first + static_cast<std::size_t>(range.l_len))
                            : points;
        std::fill(locked.begin() + std::ptrdiff_t(std::min(first, points)),
                  locked.begin() + std::ptrdiff_t(end), true);
        from = std::max(end, from + 1);
    }
    if (handle >= 0) ::close(handle);
    return locked;
}

std::shared_ptr<SweepLock> SweepLock::try_lock(const std::shared_ptr<SweepLocks>& locks,
                                               std::size_t point) {
    if (!locks->lock(point)) return nullptr;
    return std::make_shared<SweepLock>(locks, point);
}

}  // namespace swirl
