// Tracks of a camera as HDF5, with the layout of a trajectory (trajectory.hpp; H5MD 1.1):
//
//   /particles/tracks/position           step i64[T], the frame number; time f64[T];
//                                        value f64[T][N][3], pixels, y down, z = 0
//   /particles/tracks/id                 value i64[T][N]; step and time link to those of position.
//                                        −1 where a disc was not detected; its other values are NaN
//   /particles/tracks/NAME               value f64[T][N] for each further column of the CSV that
//                                        `swirl track` writes: radius, error, seen, spin …
//   /parameters                          texts: one dataset for each entry of the provenance
//
// Reading this file gives the same values, bitwise, as reading the CSV (tracks.hpp).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "swirl/io/tracks.hpp"
#include "swirl/io/trajectory.hpp"

namespace swirl {

/// One number for each disc of each frame, in the order of TrackFrame::id.
struct TrackColumn {
    std::string name;
    std::vector<std::vector<double>> values;
};

/// `times` has one entry per frame. Throws FileError.
void write_track_recording(const std::filesystem::path& path, const Tracks& tracks,
                           const std::vector<double>& times,
                           const std::vector<TrackColumn>& columns, const Provenance& provenance);

/// True if `path` is a readable HDF5 file with tracks.
bool is_track_recording(const std::filesystem::path& path);

/// Throws FileError.
Tracks read_track_recording(const std::filesystem::path& path);

}  // namespace swirl
