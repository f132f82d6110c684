// The rival that `swirl bench` holds the engine against where discs are few: the paper's method,
// all pairs and the soonest for every event (engine/reference.hpp), with the widest vectors the
// processor has; and of spheres, the reference itself.
#pragma once

#include <cstddef>

#include "swirl/engine/reference.hpp"
#include "swirl/math/cpu_width.hpp"
#include "swirl/study/rival/huge_pages.hpp"
#include "swirl/study/rival/plain_search.hpp"

namespace swirl {

/// Of the width asked for, which the processor must have.
PlainSearch plain_search(Width width);

class PlainLoop {
  public:
    explicit PlainLoop(const InitialState& initial, Width width = Width::best);

    Event step();

    const Disc& disc(std::size_t i) const { return discs_.disc(i); }

  private:
    void copy(std::size_t k);
    void copy_all();

    Reference discs_;
    double radius_of_container_;
    PlainSearch search_;
    std::size_t size_;
    OnHugePages<double> x_, y_, vx_, vy_, time_, radius_, wall_times_, times_;
};

/// Compiled for speed, as the loop above is.
class PlainSpheres {
  public:
    explicit PlainSpheres(const InitialState& initial) : spheres_(initial) {}

    Event step();

  private:
    Reference spheres_;
};

}  // namespace swirl
