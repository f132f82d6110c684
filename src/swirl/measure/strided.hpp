// Which samples an expensive measurement uses: every k-th of 511 per period, because the structure
// changes little between two of them. Frames that are fewer than that are all used.
#pragma once

#include <cstdint>

namespace swirl {

/// The paper's camera took 960 frames per second of a table rotating at 11.81 rad/s.
inline constexpr int samples_per_period = 511;

/// Base of a measurement that uses every k-th sample.
class Strided {
  public:
    explicit Strided(int every) : every_(every) {}
    /// Call it before the first sample.
    void use_every_sample() { every_ = 1; }

  protected:
    /// Call it once per sample.
    bool skips_next() { return samples_++ % every_ != 0; }

    std::int64_t samples_ = 0;  // also those that were skipped

  private:
    int every_;
};

}  // namespace swirl
