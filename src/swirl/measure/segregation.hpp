// How far particles of different sizes have separated.
//
// Two classes. The size of a particle is its radius, or its mass if all radii are equal. With s the
// median size, the large particles are those above s; if there are none, those of size s are large
// and the others small. Two species are therefore the two classes.
//
//   radial       G = (P − Q)/(P + Q) over all pairs of unequal size and unequal distance from the
//                container's centre C: P pairs in which the larger particle is farther from C, Q
//                pairs in which it is nearer (Goodman and Kruskal 1954,
//                doi:10.1080/01621459.1954.10501231). It uses every size, not the classes
//   neighbours   S = 1 − f/p with f the share of the neighbouring pairs (Voronoi cells) of unlike
//                class, and p = 2 a (1 − a) N/(N − 1) its value in a random mixture, with a the
//                share of the ends of these pairs at large particles (the assortativity of Newman
//                2003, doi:10.1103/PhysRevE.67.026126, for a finite number of particles)
//   distances    mean distance from C of the small and of the large particles
//
// Experiments. Aumaître, Kruelle and Rehberg observed segregation in swirled mixtures of two sizes
// (2001, doi:10.1103/PhysRevE.64.041305). The definitions above are not taken from there.
//
// Ideal answers. Sizes distributed at random over the positions: 0 on average, for both G and S.
// All large particles outside all small ones: G = 1, and −1 the other way round. No unlike
// neighbours: S = 1; each particle surrounded by unlike ones: S below 0. Two half discs of the two
// classes: G = 0 and S near 1, so G alone does not show every separation.
//
// Units: length, otherwise none. Errors: from blocks of periods. Limits: equal particles have no
// classes (NaN). In a random mixture of very unequal sizes, neither G nor S is exactly 0: large
// particles cannot come as near to the wall, and they have more neighbours than their share. Every
// path of the container is possible, because the definitions contain no direction.
#pragma once

#include <cstdint>
#include <vector>

#include "swirl/measure/m_frame.hpp"
#include "swirl/measure/measurement_report.hpp"
#include "swirl/measure/pinned_loose.hpp"
#include "swirl/measure/quantities.hpp"
#include "swirl/measure/voronoi.hpp"
#include "swirl/statistics/block_average.hpp"

namespace swirl {

/// G of these sizes at these distances; NaN if no pair has unequal sizes and distances. O(n log n).
class RadialSegregation {
  public:
    double operator()(const std::vector<double>& size, const std::vector<double>& distance);

  private:
    std::vector<double> sizes_;
    std::vector<std::uint32_t> order_, rank_;
    std::vector<std::int64_t> tree_;  // number of particles up to each rank (Fenwick 1994)
};

/// True for the large particles; empty if all sizes are equal.
std::vector<bool> large_class(const std::vector<double>& size);

class Segregation : public ReportedAverages<Segregation> {
  public:
    static constexpr bool any_path = true;

    static auto rows(auto& s) {
        return std::tuple{AverageRow{quantity("segregation.radial"), s.radial_},
                          AverageRow{quantity("segregation.neighbours"), s.neighbours_},
                          AverageRow{quantity("segregation.small_distance"), s.small_},
                          AverageRow{quantity("segregation.large_distance"), s.large_}};
    }

    void sample(const MFrameView& view, const Voronoi& cells, PinnedFlags pinned = {});

    template <class Visitor>
    void fields(Visitor&& visit) {
        visit(radial_, neighbours_, small_, large_);
    }

  private:
    void set_sizes(const MFrameView& view);

    BlockMean radial_, neighbours_, small_, large_;
    // Of the last sample.
    RadialSegregation radial_of_;
    std::vector<double> size_, distance_;
    std::vector<bool> is_large_;
};

}  // namespace swirl
