// Who works on what. As long as a process does a point, it has the point's byte of one file locked:
// one file for all, because a file system may take its time for files that come and go. Only a
// courtesy: work done twice does no harm.
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

    /// False if another process works on the point.
    bool take(std::size_t point);
    void give_back(std::size_t point);

    /// The points that somebody works on.
    static std::vector<bool> taken(const std::filesystem::path& folder, std::size_t points);

  private:
    int handle_;
};

/// One point's claim, given back in the end.
class SweepLock {
  public:
    /// Null if another process works on the point.
    static std::shared_ptr<SweepLock> on(const std::shared_ptr<SweepLocks>& claims,
                                         std::size_t point);
    SweepLock(std::shared_ptr<SweepLocks> claims, std::size_t point)
        : claims_(std::move(claims)), point_(point) {}
    ~SweepLock() { claims_->give_back(point_); }
    SweepLock(const SweepLock&) = delete;
    SweepLock& operator=(const SweepLock&) = delete;

  private:
    std::shared_ptr<SweepLocks> claims_;
    std::size_t point_;
};

}  // namespace swirl
