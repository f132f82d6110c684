// Snapshots with known answers, for the tests of measure/.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "swirl/measure/measurement_report.hpp"
#include "swirl/physics/container_path.hpp"
#include "swirl/physics/snapshot.hpp"

namespace swirl {

inline constexpr double R = paper_container_radius;
inline const double Omega = 2.0 * pi / paper_period;

/// A row of the report of a measurement.
template <class Measurement>
Estimate row_of(const Measurement& measurement, std::string_view name) {
    Report report;
    measurement.report(report);
    for (const ReportRow& row : report.rows)
        if (row.name == name) return row.estimate;
    ADD_FAILURE() << "no row " << name;
    return {};
}

/// Numbers in (−1, 1), the same everywhere (xorshift64*).
class Noise {
  public:
    explicit Noise(std::uint64_t seed) : state_(seed * 0x9E3779B97F4A7C15u + 1) {}
    double operator()() {
        state_ ^= state_ >> 12;
        state_ ^= state_ << 25;
        state_ ^= state_ >> 27;
        return static_cast<double>((state_ * 0x2545F4914F6CDD1Du) >> 11) * 0x1p-52 - 1.0;
    }

  private:
    std::uint64_t state_;
};

/// The paper's container at the angle 2πu on its circle.
inline Snapshot empty_container(double u = 0.0) {
    Snapshot s;
    s.period = paper_period;
    s.container_centre = paper_amplitude * unit_circle(u);
    s.container_velocity = Omega * perpendicular(s.container_centre);
    s.container_radius = paper_container_radius;
    s.clock = u * s.period;
    return s;
}

/// Adds a disc whose state holds now.
inline void add_disc(Snapshot& s, const Vec2& position, const Vec2& velocity, double spin = 0.0,
                     double radius = 1.0, double mass = 1.0) {
    const std::size_t i = s.size();
    s.resize(i + 1);
    s.set(i, {position, velocity, 0.0, spin, s.clock, radius, mass, 10.0 * mass});
}

/// The same system with each disc's state stored at another time. No sample may depend on it.
inline Snapshot held_earlier(const Snapshot& s, std::uint64_t seed = 1) {
    Snapshot t = s;
    Noise noise(seed);
    for (std::size_t i = 0; i < t.size(); ++i) {
        const double earlier = s.clock - 0.1 * (1.0 + noise());
        t.set(i, s.disc(i).at(earlier));
    }
    return t;
}

/// Random positions and velocities in the whole container.
inline Snapshot random_discs(std::size_t n, std::uint64_t seed, double u = 0.0) {
    Snapshot s = empty_container(u);
    Noise noise(seed);
    while (s.size() < n) {
        const Vec2 p{7.6 * noise(), 7.6 * noise()};
        if (dot(p, p) > 7.6 * 7.6) continue;
        add_disc(s, s.container_centre + p, {noise(), noise()}, noise());
    }
    return s;
}

/// A triangular lattice of touching discs, `rings` rings about C.
inline Snapshot triangular_lattice(int rings) {
    Snapshot s = empty_container(0.15);
    s.container_radius = 2.0 * rings + 1.0;
    for (int a = -rings; a <= rings; ++a)
        for (int b = -rings; b <= rings; ++b) {
            if (a + b < -rings || a + b > rings) continue;
            add_disc(s, s.container_centre + Vec2{2.0 * a + b, std::sqrt(3.0) * b}, {0.0, 0.0});
        }
    return s;
}

}  // namespace swirl
