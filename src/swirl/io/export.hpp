// Trajectories for other programs. Lengths and times keep the units of a run (disc radius = 1,
// speed of the container = 1), and z = 0. Numbers in text formats read back as the same double.
//
//   lammps  LAMMPS text dump: id type x y z vx vy vz radius mass omegaz (OVITO, MDAnalysis, VMD).
//           TIMESTEP is the number of the frame. The box contains the container at all times and is
//           not periodic.
//   xyz     extended XYZ: species pos velo omega radius id; the species are H, He, Li …, because
//           ASE accepts chemical symbols only, and X for the container; Time, container_x,
//           container_y and container_radius in the comment (OVITO: global attributes; ASE: info)
//   vtp     NAME.pvd, and for each frame NAME/NNNNNN.vtp (ParaView, VTK): points with velocity,
//           angle, spin, radius, mass, id; and NAME/NNNNNN_container.vtp, part 1 of the index: the
//           wall as a closed line. Uncompressed base64 with 64-bit headers
//   csv     the columns of trackpy: frame,particle,x,y in pixels; y is down, the origin top left
//   table   CSV for pandas, R or a spreadsheet; units in the header. One line per disc and frame,
//           with the time, the centre of the container, and all quantities of a frame
//   gsd     HOOMD's GSD 2.0 (float32): position, orientation, velocity, angular momentum (HOOMD's
//           quaternion), mass, diameter; the spin under log/particles/angular_velocity and the time
//           under log/time, both float64
//
// For spheres in addition: omegax omegay and quatw quati quatj quatk (lammps); three components of
// omega, and orientation:R:4 in the order x y z w (xyz); spin_x, spin_y, turned (vtp); their
// columns (table); log/particles/rolling_spin (gsd).
//
// If it is known which discs are pinned and resident at the wall (run/pinned_series.hpp), all
// formats but csv have this in addition: pinned and resident, 1 or 0. Unknown is -1 (lammps, xyz),
// an empty cell (table) or NaN (vtp, and gsd under log/particles/).
//
// With ExportOptions::container, lammps and xyz have the container as one more particle: the last
// one, of a type of its own, with the container's radius and velocity and without mass.
//
// If only some frames are exported, they keep their numbers and times.
//
// A new format is a function that writes it and a row in the list of formats, both in export.cpp.
// The command line takes name, ending and description from there.
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
    /// Exports frames first, first + stride, … up to and including `last`.
    std::uint64_t first = 0, last = std::numeric_limits<std::uint64_t>::max(), stride = 1;
    bool container = false;  // lammps and xyz only
    /// Called after each frame with the number of frames written so far. It may throw to stop.
    std::function<void(std::uint64_t)> on_frame = {};
    /// Called regularly within a frame, which may have millions of discs. It may throw to stop.
    std::function<void()> check_stop = {};
    void check_stop_at(std::size_t disc) const {
        constexpr std::size_t discs_between_checks = 4096;
        if (disc % discs_between_checks == 0 && check_stop) check_stop();
    }
};

struct ExportFormat {
    const char* name;
    const char* ending;
    const char* description;
    void (*write)(const SnapshotSeries&, const std::filesystem::path&, const ExportOptions&);
};

std::span<const ExportFormat> export_formats();
/// Returns nullptr if there is no such format.
const ExportFormat* export_format(std::string_view name);

/// How many of `frames` frames are exported.
std::uint64_t exported_frames(std::uint64_t frames, const ExportOptions& options);

/// Throws FileError, and then leaves the target as it was.
void export_series(const SnapshotSeries& series, const ExportFormat& format,
                   const std::filesystem::path& path, const ExportOptions& options = {});

}  // namespace swirl
