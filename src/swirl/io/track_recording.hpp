// A camera's tracks as HDF5, laid out as our trajectories are (trajectory.hpp; H5MD 1.1):
//
//   /particles/tracks/position           step i64[T], the number of the picture; time f64[T];
//                                        value f64[T][N][3], pixels, y down, z = 0
//   /particles/tracks/id                 value i64[T][N], step and time are links to position's;
//                                        −1 where a disc was not seen, and its other values NaN
//   /particles/tracks/NAME               value f64[T][N], each further column of the table that
//                                        `swirl track` writes as CSV: radius, error, seen, spin …
//   /parameters                          texts: one dataset for each entry of the provenance
//
// What is read is what is read of the CSV (tracks.hpp), to the bit.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "swirl/io/tracks.hpp"
#include "swirl/io/trajectory.hpp"

namespace swirl {

/// A number for each disc of each frame, in the order of TrackFrame::id.
struct TrackColumn {
    std::string name;
    std::vector<std::vector<double>> values;
};

/// `times`: of every frame. Throws FileError.
void write_track_recording(const std::filesystem::path& path, const Tracks& tracks,
                           const std::vector<double>& times,
                           const std::vector<TrackColumn>& columns, const Provenance& provenance);

/// Whether a file is one of these; one that cannot be read is not.
bool is_track_recording(const std::filesystem::path& path);

/// Throws FileError.
Tracks read_track_recording(const std::filesystem::path& path);

}  // namespace swirl
