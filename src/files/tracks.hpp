// Tracks recorded by a camera, or by another program, as snapshots.
//
//   trackpy CSV   a header line with at least frame, particle, x, y (any order, further columns
//                 ignored); x to the right and y downwards, in pixels. A particle missing for up
//                 to five frames is put back on the straight line between its neighbours.
//   LAMMPS dump   text; id, x and y (or xu, yu), and where given vx, vy, radius, mass, omegaz
//
// Velocities that are not given are central differences over the frame before and the frame after
// (one-sided at the ends of a track): they miss a fraction (ΩΔt)²/6 of a circular motion.
//
// Units of the result: length in disc radii, time in the unit of `frames_per_time`. The container
// is where a swirl of the given amplitude, period and phase puts it; the swirl centre is the
// origin. Orientation and spin of a tracked disc are not known (NaN).
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "swirl/files/series.hpp"
#include "swirl/physics/snapshot.hpp"

namespace swirl {

/// What a camera saw, in its own coordinates.
struct TrackFrame {
    std::int64_t number = 0;
    std::vector<std::int64_t> id;  // ascending
    std::vector<Vec2> position;
    std::vector<Vec2> velocity;  // empty where not given, like those below
    std::vector<double> radius, mass, spin;
};

struct Tracks {
    std::vector<TrackFrame> frames;  // in order of time
    bool y_down = false;
    std::uint64_t filled = 0;  // positions put back into short gaps
};

/// How the camera's coordinates translate. The paper's camera: 960 frames per second.
struct TrackScale {
    double frames_per_time = 960.0;
    double pixels_per_radius = 1.0;
    Vec2 swirl_centre{0.0, 0.0};    // in pixels
    double period = 1.0;            // T, in time units
    double amplitude = 0.0;         // of the swirl, in disc radii
    double phase = 0.0;             // of the container at frame 0, rad, counter-clockwise from +x
    double container_radius = 0.0;  // in disc radii
    bool clockwise = false;         // the camera saw the swirl run clockwise: mirror x
};

/// Both throw FileError with the number of the line.
Tracks read_trackpy_csv(const std::filesystem::path& path);
Tracks read_lammps_dump(const std::filesystem::path& path);

SnapshotSeries series_of(Tracks tracks, const TrackScale& scale);

}  // namespace swirl
