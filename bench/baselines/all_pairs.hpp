// The baseline for few discs: the paper's method. Every event searches all pairs for the earliest
// contact (engine/reference.hpp), with the widest vectors of the processor. For spheres the
// baseline is the reference itself.
#pragma once

#include <cstddef>

#include "baselines/all_pairs_search.hpp"
#include "baselines/huge_pages.hpp"
#include "swirl/engine/reference.hpp"
#include "swirl/math/cpu_width.hpp"

namespace swirl {

/// The search compiled for `width`, which the processor must have.
AllPairsSearch all_pairs_search(Width width);

class AllPairsBaseline {
  public:
    explicit AllPairsBaseline(const InitialState& initial, Width width = Width::best);

    Event step();

    const Disc& disc(std::size_t i) const { return discs_.disc(i); }

  private:
    void copy(std::size_t k);
    void copy_all();

    Reference discs_;
    double radius_of_container_;
    AllPairsSearch search_;
    std::size_t size_;
    OnHugePages<double> x_, y_, vx_, vy_, time_, radius_, wall_times_, times_;
};

/// The reference, compiled for speed.
class SphereBaseline {
  public:
    explicit SphereBaseline(const InitialState& initial) : spheres_(initial) {}

    Event step();

  private:
    Reference spheres_;
};

}  // namespace swirl
