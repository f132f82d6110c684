// What a tracker of particles gets wrong, put right where the tracks themselves say how.
//
//   exchanged    hard discs keep their centres two radii apart, so a disc that moves by less than
//                one radius from a frame to the next cannot be taken for another. Where a track
//                jumps farther it is cut: there the names were exchanged
//   joined       a track that ends, by a cut or because the disc was lost, goes on as the track
//                that begins within one radius of its end, at most six frames later; the nearest in
//                time come first; if there is none, as the track of its own name
//   filled       a disc missing for up to five frames is put back on the straight line between
//   dropped      a disc seen in a single frame, nowhere in the six before and after, has no
//                velocity, and is left out
//
// A frame is a step of the commonest length between the numbers of two frames, so a table of every
// second picture is no table of gaps. Limits: discs of equal size; where discs move by more than
// half a radius from frame to frame in over one case of ten, names cannot be judged by places
// and are believed.
#pragma once

#include "swirl/io/tracks.hpp"

namespace swirl {

/// Discs of the given radius, in pixels. Only frames of positions alone, as a camera has them, are
/// mended; what was done is counted in tracks.mended.
void mend(Tracks& tracks, double radius);

/// The commonest difference between the numbers of two frames that follow each other; 1 for fewer
/// than two frames.
std::int64_t commonest_step(const Tracks& tracks);

}  // namespace swirl
