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
//   gsd     HOOMD's GSD 2.0 (float32): position, orientation, velocity, mass, diameter; the spin
//           under log/particles/angular_velocity, the time under log/time, both float64
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string_view>

#include "swirl/files/series.hpp"

namespace swirl {

enum class ExportFormat : std::uint8_t { lammps, xyz, vtp, csv, gsd };

/// Nothing if there is no such format.
std::optional<ExportFormat> export_format(std::string_view name);

struct ExportOptions {
    double pixels_per_radius = 20.0;          // csv only
    std::function<void(std::uint64_t)> done;  // called after each frame; may throw to stop
};

/// Throws FileError; then nothing new stands under the final name.
void export_series(const SnapshotSeries& series, ExportFormat format,
                   const std::filesystem::path& path, const ExportOptions& options = {});

}  // namespace swirl
