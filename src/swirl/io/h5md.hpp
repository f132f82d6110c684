// Paths and common parts of the HDF5 files of this program. Frames follow H5MD (trajectory.hpp,
// track_recording.hpp); all other data are in the group /parameters.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "swirl/io/hdf5.hpp"

namespace swirl::h5md {

inline const std::string particles = "/particles/trajectory";
inline const std::string tracks = "/particles/tracks";
inline const std::string observables = "/observables";
inline const std::string parameters = "/parameters";

/// The attribute `format` of /parameters in trajectories, event logs and tracks. Files without it
/// predate the attribute and have format 1.
inline constexpr std::int64_t recording_format = 1;
void write_format(Hdf5File& file);
/// Throws FileError if the file has another format; the message names the program that wrote it.
void require_known_format(const Hdf5File& file, const std::filesystem::path& path);

/// Creates /h5md and one group of particles without a box.
void create_head(Hdf5File& file, const std::string& group);
/// Creates /parameters with one text dataset for each provenance entry. The entry "version" also
/// becomes the creator's version.
void create_parameters(Hdf5File& file,
                       const std::vector<std::pair<std::string, std::string>>& provenance);
/// The species of each disc: discs with equal radius and mass have the same species. Species are
/// numbered from 0 in order of appearance.
std::vector<std::int64_t> species_of(const std::vector<double>& radius,
                                     const std::vector<double>& mass);
/// Links step and time of a series to those of `from`: H5MD demands both for every series.
void link_times(Hdf5File& file, const std::string& from, const std::string& group);

}  // namespace swirl::h5md
