// Snapshots from tracks that a camera or another program recorded.
//
//   CSV table     Of any tracker, with a header line. Without other names, the columns are frame,
//                 particle, x and y as of trackpy, or the names of ImageJ's TrackMate and MOSAIC.
//                 Columns may have any order; other columns are ignored. x points right and y
//                 down, in pixels. A row without particle, x or y has no position. A table with
//                 the column `seen`, as `swirl track` writes it, may also give `radius` and `spin`
//                 (counter-clockwise in the image, per unit of time).
//   LAMMPS dump   Text with id, x and y (or xu, yu), and optionally vx, vy, radius, mass, omegaz.
//
// Velocities that are not given are central differences over the frame before and the frame after,
// one-sided at the ends of a track. They miss a fraction (ΩΔt)²/6 of a circular motion. A disc that
// is in neither neighbouring frame gets velocity 0. track_smoothing.hpp gives better velocities.
//
// Units of the result: length in disc radii, speed AΩ of the container = 1
// (docs/explanation/physics.md), so the period is 2πA. For a container at rest (amplitude 0), time
// keeps the unit of `frames_per_time`. Masses are as given, otherwise 1. Amplitude, period and
// phase give the position of the container; the centre of its path is the origin. Tracks have no
// orientation (NaN) and, unless the file gives it, no spin (NaN).
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "swirl/io/series.hpp"
#include "swirl/physics/snapshot.hpp"

namespace swirl {

/// The discs of one frame, in camera coordinates.
struct TrackFrame {
    std::int64_t number = 0;
    std::vector<std::int64_t> id;  // ascending
    std::vector<Vec2> position;
    std::vector<Vec2> velocity;  // empty if not given, like the vectors below
    std::vector<double> radius, mass, spin;
    std::vector<double> velocity_error;  // standard error per coordinate, set by smooth()
    /// In the camera's unit of time; given if frames are not equally spaced in time
    /// (equal_steps.hpp).
    std::optional<double> time = {};
};

struct Tracks {
    std::vector<TrackFrame> frames;  // sorted by time
    bool y_down = false;
    struct {
        std::uint64_t filled = 0;      // positions interpolated in short gaps
        std::uint64_t relabelled = 0;  // pieces of tracks that got the ID of an earlier piece
        std::uint64_t dropped = 0;     // positions without a neighbour in time
    } repaired;                        // counted by repair() (track_repair.hpp)
};

/// Longer gaps are not filled, and no velocity is computed across them.
inline constexpr std::int64_t longest_gap = 5;  // frames

/// Conversion from camera coordinates. The paper's camera takes 960 frames per second.
struct TrackScale {
    double frames_per_time = 960.0;
    double pixels_per_radius = 1.0;
    Vec2 swirl_centre{0.0, 0.0};    // unit: pixels
    double period = 1.0;            // T, in time units
    double amplitude = 0.0;         // unit: disc radii
    double phase = 0.0;             // container's phase at frame 0, as seen in the image, rad,
                                    // counter-clockwise from +x
    double container_radius = 0.0;  // unit: disc radii
    bool clockwise = false;         // the container moves clockwise in the image: mirror x
    bool calibrated = false;        // `swirl track` set it, not the user

    /// T, and the camera's unit of time, in units of the result.
    double our_period() const;
    double camera_time() const { return our_period() / period; }
};

/// The columns of a table by another program; the names of known trackers if empty.
struct TableLayout {
    std::string frame{}, particle{}, x{}, y{};
    bool y_up = false;
    bool has_names() const { return !(frame + particle + x + y).empty(); }
};

/// Throw FileError with the line number.
Tracks read_track_table(const std::filesystem::path& path, const TableLayout& layout = {});
Tracks read_lammps_dump(const std::filesystem::path& path);

/// Throws FileError unless each frame has a later number, and a later time if times are given, than
/// the frame before it. Every reader ends with this check.
void require_ascending_frames(const Tracks& tracks, const std::filesystem::path& path);

SnapshotSeries series_of(Tracks tracks, const TrackScale& scale);

}  // namespace swirl
