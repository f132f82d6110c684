// Tracks recorded by a camera, or by another program, as snapshots.
//
//   trackpy CSV   a header line with at least frame, particle, x, y (any order, further columns
//                 ignored); x to the right and y downwards, in pixels. With the columns seen and
//                 radius, as `swirl track` writes them, the discs have these radii; with spin
//                 these spins, counter-clockwise in the picture, per unit of time
//   LAMMPS dump   text; id, x and y (or xu, yu), and where given vx, vy, radius, mass, omegaz
//
// Velocities that are not given are central differences over the frame before and the frame after
// (one-sided at the ends of a track): they miss a fraction (ΩΔt)²/6 of a circular motion. Of a disc
// that is in neither they are not known, and 0. Better ones are those of track_smoothing.hpp.
//
// Units of the result are those of everything here: length in disc radii, the speed AΩ of the
// container = 1 (docs/physics.md), so the period is 2πA. Of a container that stands still, with
// amplitude 0, time stays in the unit of `frames_per_time`. Masses are as given, 1 if they are not.
// The container is where a swirl of the given amplitude, period and phase puts it; the swirl centre
// is the origin. Orientation of a tracked disc is not known (NaN), and its spin
// is not unless the table has it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "swirl/io/series.hpp"
#include "swirl/physics/snapshot.hpp"

namespace swirl {

/// What a camera saw, in its own coordinates.
struct TrackFrame {
    std::int64_t number = 0;
    std::vector<std::int64_t> id;  // ascending
    std::vector<Vec2> position;
    std::vector<Vec2> velocity;  // empty where not given, like those below
    std::vector<double> radius, mass, spin;
    std::vector<double> velocity_error;  // standard error of a coordinate, of smoothed velocities
};

struct Tracks {
    std::vector<TrackFrame> frames;  // in order of time
    bool y_down = false;
    struct {
        std::uint64_t filled = 0;   // positions put back into short gaps
        std::uint64_t renamed = 0;  // tracks that went on under another name
        std::uint64_t dropped = 0;  // positions of discs seen in a single frame
    } repaired;                     // by track_repair.hpp
};

/// A disc missing for longer is not put back, and has no velocity across the gap.
inline constexpr std::int64_t longest_gap = 5;  // frames

/// How the camera's coordinates translate. The paper's camera: 960 frames per second.
struct TrackScale {
    double frames_per_time = 960.0;
    double pixels_per_radius = 1.0;
    Vec2 swirl_centre{0.0, 0.0};    // in pixels
    double period = 1.0;            // T, in time units
    double amplitude = 0.0;         // of the swirl, in disc radii
    double phase = 0.0;             // of the container at frame 0 as the camera sees it, rad,
                                    // counter-clockwise from the right
    double container_radius = 0.0;  // in disc radii
    bool clockwise = false;         // the camera saw the swirl run clockwise: mirror x

    /// T, and the camera's unit of time, in ours.
    double our_period() const;
    double camera_time() const { return our_period() / period; }
};

/// Both throw FileError with the number of the line.
Tracks read_trackpy_csv(const std::filesystem::path& path);
Tracks read_lammps_dump(const std::filesystem::path& path);

SnapshotSeries series_of(Tracks tracks, const TrackScale& scale);

}  // namespace swirl
