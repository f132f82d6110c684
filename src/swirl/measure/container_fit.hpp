// Test whether the discs lie where hard discs in a container can: inside the wall and without
// overlap. This reveals errors of the scale, the radius, the centre or the phase given for a
// camera's tracks.
//
//   wall gap       R − max_i (|r_i − C| + r_i)              below 0: a disc protrudes
//   closest pair   min_{i<j} |r_i − r_j| / (r_i + r_j)      below 1: two discs overlap
//   fitting phase  the angle of C at time 0 at which discs protrude least, by the sum over samples
//                  of the squared protrusion; in steps of one degree
//
// Units: those of the snapshots. Limits: without discs the gap is R; without a pair the second is
// infinite.
#pragma once

#include <vector>

#include "swirl/math/vec2.hpp"
#include "swirl/physics/snapshot.hpp"

namespace swirl {

double wall_gap(const Snapshot& s);
double closest_pair(const Snapshot& s);

class FittingPhase {
  public:
    /// Snapshots of a container that moves on a circle, in any order.
    void sample(const Snapshot& s);

    struct Fit {
        double phase = 0.0;       // angle of C at time 0, rad, 0 ≤ phase < 2π
        double protrusion = 0.0;  // sum over samples, with that phase
    };
    /// For a container that moves on the circle counter-clockwise, or clockwise.
    Fit best(bool clockwise = false) const;
    /// With the phase that the snapshots have.
    double protrusion() const;

  private:
    struct Sample {
        double turns;  // container's turns since time 0
        double container_radius;
        Vec2 centre;  // unit and frame of the snapshot
        std::vector<Vec2> positions;
        std::vector<double> radii;
    };
    static double protrusion(const Sample& sample, const Vec2& centre);

    double amplitude_ = 0.0;
    std::vector<Sample> samples_;
};

}  // namespace swirl
