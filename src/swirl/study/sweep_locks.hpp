// Locks of sweep points. While a process works on a point, it holds a lock on the point's byte of
// the file DIR/locks. All points share one file because some file systems create and remove files
// slowly. The locks only save work: a point done twice does no harm.
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

namespace swirl {

class SweepLocks {
  public:
    /// Throws FileError if the folder cannot be written to.
    explicit SweepLocks(const std::filesystem::path& folder);
    ~SweepLocks();
    SweepLocks(const SweepLocks&) = delete;
    SweepLocks& operator=(const SweepLocks&) = delete;

    /// False if another process holds the lock of the point.
    bool lock(std::size_t point);
    void unlock(std::size_t point);

    /// The points whose locks some process holds.
    static std::vector<bool> locked(const std::filesystem::path& folder, std::size_t points);

  private:
    int handle_;
};

/// The lock of one point, released by the destructor.
class SweepLock {
  public:
    /// Null if another process holds the lock.
    static std::shared_ptr<SweepLock> try_lock(const std::shared_ptr<SweepLocks>& locks,
                                               std::size_t point);
    SweepLock(std::shared_ptr<SweepLocks> locks, std::size_t point)
        : locks_(std::move(locks)), point_(point) {}
    ~SweepLock() { locks_->unlock(point_); }
    SweepLock(const SweepLock&) = delete;
    SweepLock& operator=(const SweepLock&) = delete;

  private:
    std::shared_ptr<SweepLocks> locks_;
    std::size_t point_;
};

}  // namespace swirl
