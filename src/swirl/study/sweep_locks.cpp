#include "swirl/study/sweep_locks.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

#include "swirl/io/atomic_file.hpp"
#include "swirl/io/file_error.hpp"

namespace swirl {
namespace {

namespace fs = std::filesystem;

struct flock bytes(std::size_t point, std::size_t count, int type) {
    struct flock lock {};
    lock.l_type = static_cast<short>(type);
    lock.l_whence = SEEK_SET;
    lock.l_start = static_cast<off_t>(point);
    lock.l_len = static_cast<off_t>(count);
    return lock;
}

}  // namespace

SweepLocks::SweepLocks(const fs::path& folder)
    : handle_(::open((folder / "claims").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666)) {
    if (handle_ < 0)
        throw FileError(fmt::format("'{}' could not be written: {}.", (folder / "claims").string(),
                                    system_reason()));
}

SweepLocks::~SweepLocks() { ::close(handle_); }

bool SweepLocks::take(std::size_t point) {
    struct flock lock = bytes(point, 1, F_WRLCK);
    return ::fcntl(handle_, F_OFD_SETLK, &lock) == 0 || (errno != EAGAIN && errno != EACCES);
}

void SweepLocks::give_back(std::size_t point) {
    struct flock lock = bytes(point, 1, F_UNLCK);
    ::fcntl(handle_, F_OFD_SETLK, &lock);
}

std::vector<bool> SweepLocks::taken(const fs::path& folder, std::size_t points) {
    std::vector<bool> taken(points, false);
    const int handle = ::open((folder / "claims").c_str(), O_RDWR | O_CLOEXEC);
    for (std::size_t from = 0; handle >= 0 && from < points;) {
        struct flock lock = bytes(from, points - from, F_WRLCK);
        if (::fcntl(handle, F_OFD_GETLK, &lock) != 0 || lock.l_type == F_UNLCK) break;
        const auto first = static_cast<std::size_t>(lock.l_start);
        const std::size_t end = lock.l_len > 0
                                    ? std::min(points, first + static_cast<std::size_t>(lock.l_len))
                                    : points;
        std::fill(taken.begin() + std::ptrdiff_t(std::min(first, points)),
                  taken.begin() + std::ptrdiff_t(end), true);
        from = std::max(end, from + 1);
    }
    if (handle >= 0) ::close(handle);
    return taken;
}

std::shared_ptr<SweepLock> SweepLock::on(const std::shared_ptr<SweepLocks>& claims,
                                         std::size_t point) {
    if (!claims->take(point)) return nullptr;
    return std::make_shared<SweepLock>(claims, point);
}

}  // namespace swirl
