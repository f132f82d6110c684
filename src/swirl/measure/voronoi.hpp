// The part of the container that belongs to each disc, and the neighbours of each disc.
//
// A disc's cell is where its power |x − r_i|² − R_i² is the smallest of all, cut off at the
// container's wall. For equal discs this is the Voronoi diagram, for mixtures the radical one,
// whose borders never cut a disc (Gellatly and Finney 1982, doi:10.1016/0022-3093(82)90093-X). The
// border between i and j is the line across r_j − r_i = d at the distance t = (d² + R_i² − R_j²)/2d
// from r_i.
//
//              ______
//            /   |    \           each cell starts as an octagon around the container and is
//           |  i | j   |          clipped by the border with one neighbour after the other. Areas
//            \___|____/           and lengths are exact for the circle, not for a polygon
//
// It costs some 20 µs for 48 discs, much more than a sample. The structure changes slowly, so a
// few times per period are enough.
//
// Σ areas = πR² if every disc lies in the container. Neighbours are those with a common border
// inside. Units: those of the view. Limits: discs at one point have no border with each other and
// share a cell; a single disc has the whole container; a disc without a finite position has an
// empty cell (area 0).
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
        double length;  // part inside the container
    };

    void find(const MFrameView& view);

    std::size_t size() const { return areas_.size(); }
    double area(std::size_t disc) const { return areas_[disc]; }
    const Border* begin(std::size_t disc) const { return borders_.data() + first_[disc]; }
    const Border* end(std::size_t disc) const { return borders_.data() + first_[disc + 1]; }

  private:
    struct Corner {
        Vec2 at;               // position relative to the container's centre
        std::uint32_t beyond;  // the neighbour behind the side that begins here
    };
    struct Reach;
    /// Clips the cell of disc order_[rank] by the borders with all discs that can reach it.
    void clip_by_neighbours(const MFrameView& view, std::size_t rank, double max_radius);
    void clip_by(const MFrameView& view, std::uint32_t disc, std::uint32_t neighbour, Reach& reach);
    /// Cuts off what lies beyond the border; false if nothing does.
    bool clip(const Vec2& centre, const Vec2& towards, double distance, std::uint32_t neighbour);
    double farthest(const Vec2& centre) const;

    std::vector<double> areas_;
    std::vector<std::size_t> first_;
    std::vector<Border> borders_;
    std::vector<std::uint32_t> order_;  // discs sorted by x
    std::vector<Corner> cell_, next_;
    std::vector<double> depth_;
    std::vector<std::pair<double, std::uint32_t>> near_;  // squared distance and disc
};

}  // namespace swirl
