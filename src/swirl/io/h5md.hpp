// Where things stand in the HDF5 files of this program: frames as H5MD has them (trajectory.hpp,
// track_recording.hpp), and beside them what belongs to no frame.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "swirl/io/hdf5.hpp"

namespace swirl::h5md {

inline const std::string particles = "/particles/trajectory";
inline const std::string tracks = "/particles/tracks";  // of a camera
inline const std::string observables = "/observables";
inline const std::string parameters = "/parameters";

/// Of trajectories, event logs and tracks: attribute `format` of /parameters. Files without it were
/// written before there was one, and are in format 1.
inline constexpr std::int64_t recording_format = 1;
void write_format(Hdf5File& file);
/// Throws FileError if the file is in another format, with what wrote it.
void require_known_format(const Hdf5File& file, const std::filesystem::path& path);

/// What every H5MD file begins with, and one group of particles without a box.
void create_head(Hdf5File& file, const std::string& group);
/// The texts of the provenance, each a dataset; "version" is the creator's, too.
void create_parameters(Hdf5File& file,
                       const std::vector<std::pair<std::string, std::string>>& provenance);
/// Discs of one radius and mass are of one species; species are counted as they first appear.
std::vector<std::int64_t> species_of(const std::vector<double>& radius,
                                     const std::vector<double>& mass);
/// Every time series of H5MD has a step and a time of its own: links to those of `from`.
void link_times(Hdf5File& file, const std::string& from, const std::string& group);

}  // namespace swirl::h5md
