// The part of the dish that belongs to each disc, and who its neighbours are.
//
// A disc's cell is where its power |x − r_i|² − R_i² is the smallest of all, cut off at the
// container's wall: for equal discs the Voronoi diagram, for several sizes the radical one, whose
// borders never cut a disc (Gellatly and Finney 1982, doi:10.1016/0022-3093(82)90093-X). The border
// between i and j is the line across r_j − r_i = d at the distance t = (d² + R_i² − R_j²)/2d from
// r_i.
//
//              ______
//            /   |    \           each cell starts as an octagon around the container and is
//           |  i | j   |          clipped by the border with one neighbour after the other; what
//            \___|____/           counts is inside the circle, exactly (no polygon for the wall)
//
// It costs some 20 µs for 48 discs, much more than a sample; the structure changes slowly, and a
// few times per swirl is enough.
//
// Σ areas = πR², if every disc lies in the container. Neighbours are those with a common border
// inside. Units: those of the view. Limits: discs on one point have no border with each other and
// share a cell; one disc has the whole dish; a position that is not a number makes an empty cell
// (area 0).
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "swirl/measure/m_frame.hpp"

namespace swirl {

class Voronoi {
  public:
    struct Border {
        std::uint32_t neighbour;
        double length;  // inside the container
    };

    void find(const MFrameView& view);

    std::size_t size() const { return areas_.size(); }
    double area(std::size_t disc) const { return areas_[disc]; }
    const Border* begin(std::size_t disc) const { return borders_.data() + first_[disc]; }
    const Border* end(std::size_t disc) const { return borders_.data() + first_[disc + 1]; }

  private:
    struct Corner {
        Vec2 at;               // from the container's centre
        std::uint32_t beyond;  // who is behind the side that begins here
    };
    /// Cuts off what lies beyond the border; false if nothing does.
    bool clip(const Vec2& centre, const Vec2& towards, double distance, std::uint32_t neighbour);
    double farthest(const Vec2& centre) const;

    std::vector<double> areas_;
    std::vector<std::size_t> first_;
    std::vector<Border> borders_;
    std::vector<std::uint32_t> order_;
    std::vector<Corner> cell_, next_;
    std::vector<double> depth_;
    std::vector<std::pair<double, std::uint32_t>> near_;  // distance squared, and who
};

}  // namespace swirl
