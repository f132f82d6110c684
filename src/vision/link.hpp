// Which disc in this picture is which in the last.
//
// The whole field turns by Ω between two pictures, so the nearest disc is the wrong one where they
// are few. A disc is expected where the best of three ways of going straight on would have it: in
// the lab (a disc in flight), relative to the dish (pinned to its wall), and in the co-rotating
// M-frame (a cluster that goes round with the swirl); each way counts by how well it has done so
// far. A disc seen once moves as its neighbours do. For the very first step that all turn about
// the middle of the dish by one angle, the one that fits best.
//
// Expected places and circles found are then joined so that the sum of squared distances is least
// (assignment problem; Kuhn 1955, in the form of Jonker & Volgenant 1987), within a gate of about
// one radius. There are only so many discs: nobody is born beyond their number, and one that was
// lost is taken up again by the circle that nobody else explains.
//
// Pixels, y down.
#pragma once

#include <cstdint>
#include <vector>

#include "swirl/math/vec2.hpp"
#include "swirl/vision/dish_path.hpp"

namespace swirl {

struct SeenDisc {
    Vec2 place{0.0, 0.0};
    std::size_t kind = 0;
    bool sure = true;
};

struct LinkSettings {
    std::vector<double> radii;         // of the kinds
    std::vector<std::size_t> numbers;  // of discs of each kind; empty: not known
    double gate = 0.95;                // of a radius
};

struct Links {
    /// For each picture and each disc seen in it, the track it belongs to, or −1.
    std::vector<std::vector<int>> track;
    std::vector<std::size_t> kind;  // of each track
    std::uint64_t refused = 0;      // sure discs that would have been one too many
};

Links link_discs(const std::vector<std::vector<SeenDisc>>& pictures,
                 const std::vector<double>& times, const DishPath& path,
                 const LinkSettings& settings);

/// The columns assigned to the rows so that the sum is least; −1 where there are fewer columns.
/// cost[r][c] finite, any shape.
std::vector<int> best_assignment(const std::vector<std::vector<double>>& cost);

}  // namespace swirl
