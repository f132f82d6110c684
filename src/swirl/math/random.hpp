// Random numbers that are the same on every platform: SplitMix64 (Steele, Lea, Flood 2014,
// doi:10.1145/2660193.2660195). Doubles are made from its bits without the standard library's
// distributions, whose results differ between implementations.
#pragma once

#include <cstdint>

#include "swirl/math/vec2.hpp"

namespace swirl {

class Random {
  public:
    explicit constexpr Random(std::uint64_t seed) : state_(seed) {}

    constexpr std::uint64_t bits() {
        state_ += 0x9e3779b97f4a7c15u;
        std::uint64_t z = state_;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        return z ^ (z >> 31);
    }
    /// Uniform in [0, 1): a multiple of 2⁻⁵³.
    constexpr double uniform() { return static_cast<double>(bits() >> 11) * 0x1p-53; }
    /// Uniform in {0, …, n − 1}; the bias is below n/2⁶⁴.
    constexpr std::uint64_t below(std::uint64_t n) { return bits() % n; }
    /// Uniform in the disc of the given radius; by rejection, so without trigonometry.
    constexpr Vec2 in_disc(double radius) {
        for (;;) {
            const double x = 2.0 * uniform() - 1.0, y = 2.0 * uniform() - 1.0;
            if (x * x + y * y <= 1.0) return {radius * x, radius * y};
        }
    }

  private:
    std::uint64_t state_;
};

}  // namespace swirl
