// Repairs tracking errors that the tracks themselves reveal.
//
//   swaps     Centres of hard discs are two radii apart. A disc that moves by less than one radius
//             per frame cannot be confused with another. A larger jump within a track is an
//             identity swap, and the track is cut there.
//   joins     A track that ends, by a cut or because the disc was lost, continues as a track that
//             begins within one radius of its end, at most six frames later. The earliest and then
//             the nearest beginning is chosen. If there is none, the pieces of one ID are rejoined.
//   gaps      Gaps of up to five frames are filled by linear interpolation.
//   drops     A position without another one of its disc in the six frames before and after has no
//             velocity and is removed.
//
// One frame is the most common difference between two frame numbers, so a table of every second
// frame has no gaps. Limits: all discs have one size. If more than one move in ten exceeds half a
// radius per frame, positions cannot identify discs, and the given IDs are kept.
#pragma once

#include <cstdint>
#include <vector>

#include "swirl/io/tracks.hpp"

namespace swirl {

/// Repairs tracks of discs with the given radius in pixels, and counts the changes in
/// tracks.repaired. Only tracks of positions alone are changed.
void repair(Tracks& tracks, double radius);

/// A link of one disc from one frame to a later one, which may be wrong.
struct UncertainLink {
    std::int64_t id = 0, from = 0, to = 0;  // ID and frame numbers
};

/// Cuts tracks at these links: positions between the two frames are removed, and the disc has
/// another ID from the later one on.
void cut(Tracks& tracks, std::vector<UncertainLink> links);

/// The most common difference between consecutive frame numbers; 1 for fewer than two frames.
std::int64_t commonest_step(const Tracks& tracks);

}  // namespace swirl
