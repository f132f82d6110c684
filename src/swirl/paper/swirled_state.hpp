// The quantities that published experiments with swirled spheres report: kinetic energy, rings,
// paths of single particles, the position of the dense region, and the rotation of core and wall
// layer. All are averages over the samples of one run after its warm-up.
#pragma once

#include <complex>
#include <cstdint>
#include <vector>

#include "swirl/paper/paper.hpp"
#include "swirl/physics/snapshot.hpp"
#include "swirl/run/run.hpp"

namespace swirl {

class SwirledState {
  public:
    static constexpr int samples_per_period = 60;
    /// Periods of a path that is compared with a hypotrochoid.
    static constexpr int periods_of_a_path = 4;
    /// Particles whose centres are within this many radii of the wall are its layer. This includes
    /// the first layer, and half of the way to the next one.
    static constexpr double layer = 2.0;
    /// Rings of the radial density, per radius of a particle.
    static constexpr int rings_per_radius = 5;

    /// `carried`: the share of the container's motion that the floor passes on to a free particle
    /// (carried_share).
    SwirledState(double container_radius, double carried);
    void sample(const Snapshot& snapshot);
    /// The averages, and the densities in rings about the cluster's and the container's centre.
    Json json() const;

  private:
    struct Mean {
        double sum = 0.0, weight = 0.0;
        void add(double value, double count = 1.0) {
            sum += count * value;
            weight += count;
        }
        double value() const { return sum / weight; }
    };
    void add_rotation(const Snapshot& snapshot, const Vec2& centre, const Vec2& velocity);
    void add_paths(const Snapshot& snapshot);

    double container_radius_, carried_;
    // ⟨v²⟩; ⟨I ω²⟩/m; |q|; ϖ of the core, and of the layer at the wall. q is the position of the
    // centre of mass relative to that of a uniform layer that moves freely, `carried` times C.
    Mean square_, spin_square_, distance_, core_, layer_;
    Vec2 steady_{0.0, 0.0};  // sum of q in axes that turn with Ω
    double samples_ = 0.0;
    double advance_ = 0.0, last_angle_ = 0.0, first_time_ = 0.0, last_time_ = 0.0;  // of q
    std::vector<double> about_centre_of_mass_, about_container_;
    std::vector<std::vector<std::complex<double>>> paths_;
    Mean path_rotation_, path_square_;
    double discs_ = 0.0, omega_ = 0.0;
};

/// A solid sphere that rolls on a floor gains 1/(1 + m r²/I) = 2/7 of each change of the floor's
/// velocity. Discs without a floor gain nothing.
double carried_share(const RunConfig& config);

/// Runs to the end; json() and the mean rotation of the discs, "rotation". Throws Interrupted.
Json swirled_run(const RunConfig& config, const RunControl& control);

}  // namespace swirl
