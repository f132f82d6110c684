// Who works on what. As long as a process does a point, it has the point's byte of one file locked:
// one file for all, because a file system may take its time for files that come and go. Only a
// courtesy: work done twice does no harm.
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

namespace swirl {

class SweepClaims {
  public:
    /// Throws FileError if the folder cannot be written to.
    explicit SweepClaims(const std::filesystem::path& folder);
    ~SweepClaims();
    SweepClaims(const SweepClaims&) = delete;
    SweepClaims& operator=(const SweepClaims&) = delete;

    /// False if another process works on the point.
    bool take(std::size_t point);
    void give_back(std::size_t point);

    /// The points that somebody works on.
    static std::vector<bool> taken(const std::filesystem::path& folder, std::size_t points);

  private:
    int handle_;
};

/// One point's claim, given back in the end.
class SweepClaim {
  public:
    /// Null if another process works on the point.
    static std::shared_ptr<SweepClaim> on(const std::shared_ptr<SweepClaims>& claims,
                                          std::size_t point);
    SweepClaim(std::shared_ptr<SweepClaims> claims, std::size_t point)
        : claims_(std::move(claims)), point_(point) {}
    ~SweepClaim() { claims_->give_back(point_); }
    SweepClaim(const SweepClaim&) = delete;
    SweepClaim& operator=(const SweepClaim&) = delete;

  private:
    std::shared_ptr<SweepClaims> claims_;
    std::size_t point_;
};

}  // namespace swirl
