// Trajectories for other programs. All lengths and times stay in our units (disc radius, speed of
// the container = 1), numbers in text are written so that reading them back gives the same double,
// z = 0.
//
//   lammps  LAMMPS text dump: id type x y z vx vy vz radius mass omegaz (OVITO, MDAnalysis, VMD).
//           TIMESTEP is the number of the frame. A box about the whole swirl, not periodic.
//   xyz     extended XYZ: species pos velo omega radius id; Time in the comment (OVITO, ASE)
//   vtp     NAME.pvd, and one NAME/NNNNNN.vtp per frame (ParaView, VTK): points with velocity,
//           angle, spin, radius, mass, id; uncompressed base64 with 64-bit headers
//   csv     as trackpy writes: frame,particle,x,y in pixels, y downwards, origin top left
//   table   CSV for pandas, R or a spreadsheet, everything in our units, which the header names: a
//           line for each disc and frame, with time, the container's centre and whatever a frame
//           tells
//   gsd     HOOMD's GSD 2.0 (float32): position, orientation, velocity, angular momentum (HOOMD's
//           quaternion), mass, diameter; the spin under log/particles/angular_velocity, the time
//           under log/time, both float64
//
// Of spheres besides: omegax omegay and quatw quati quatj quatk (lammps), three components of omega
// and orientation:R:4, x y z w (xyz), spin_x, spin_y, turned (vtp), their columns (table),
// log/particles/rolling_spin (gsd).
//
// Where some of the frames are left out, those that are there keep their numbers and times.
//
// A new format is a function that writes it and a row of the list, both in export.cpp; the command
// line has name, ending and description from there.
#pragma once

#include <filesystem>
#include <functional>
#include <limits>
#include <span>
#include <string_view>

#include "swirl/io/series.hpp"

namespace swirl {

struct ExportOptions {
    double pixels_per_radius = 20.0;  // csv only
    /// From the first to the last, every stride-th.
    std::uint64_t first = 0, last = std::numeric_limits<std::uint64_t>::max(), stride = 1;
    /// Called after each frame with how many there are so far; may throw to stop.
    std::function<void(std::uint64_t)> done = {};
    /// The same within a frame, of which there may be millions of lines: asked for some of them.
    std::function<void()> listen = {};
    void listen_at(std::size_t disc) const {
        if (disc % 4096 == 0 && listen) listen();
    }
};

struct ExportFormat {
    const char* name;
    const char* ending;
    const char* description;
    void (*write)(const SnapshotSeries&, const std::filesystem::path&, const ExportOptions&);
};

std::span<const ExportFormat> export_formats();
/// Null if there is no such format.
const ExportFormat* export_format(std::string_view name);

/// How many of the frames are written.
std::uint64_t exported_frames(const SnapshotSeries& series, const ExportOptions& options);

/// Throws FileError; then nothing new stands under the final name.
void export_series(const SnapshotSeries& series, const ExportFormat& format,
                   const std::filesystem::path& path, const ExportOptions& options = {});

}  // namespace swirl
