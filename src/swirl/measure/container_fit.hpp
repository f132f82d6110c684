// Whether discs lie where a dish of hard discs lets them: inside the wall, and not in each other.
// So shows what is wrong with the scale, the radius, the centre or the phase that a camera's tracks
// were given.
//
//   wall gap       R − max_i (|r_i − C| + r_i)                     below 0: a disc sticks out
//   closest pair   min_{i<j} |r_i − r_j| / (r_i + r_j)             below 1: two discs overlap
//   fitting phase  the angle of C at the beginning at which discs stick out least, by the sum over
//                  samples of the squared protrusion; in steps of one degree
//
// Units: those of the snapshots. No discs: the gap is R, no pair: infinity.
#pragma once

#include <vector>

#include "swirl/math/vec2.hpp"
#include "swirl/physics/snapshot.hpp"

namespace swirl {

double wall_gap(const Snapshot& s);
double closest_pair(const Snapshot& s);

class FittingPhase {
  public:
    /// Snapshots of a container that runs round a circle; any of them, in any order.
    void sample(const Snapshot& s);

    struct Fit {
        double phase = 0.0;       // of C at time 0, rad, 0 ≤ phase < 2π
        double protrusion = 0.0;  // sum over samples, with that phase
    };
    /// With the circle run through counter-clockwise, or clockwise.
    Fit best(bool clockwise = false) const;
    /// With the phase the snapshots were given.
    double protrusion() const;

  private:
    struct Sample {
        double turns;  // of the swirl since time 0
        double container_radius;
        Vec2 centre;  // as given
        std::vector<Vec2> positions;
        std::vector<double> radii;
    };
    static double protrusion(const Sample& sample, const Vec2& centre);

    double amplitude_ = 0.0;
    std::vector<Sample> samples_;
};

}  // namespace swirl
