// Options for the unit conversion of tracks from a camera or another program.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "swirl/cli/options.hpp"
#include "swirl/io/track_repair.hpp"
#include "swirl/io/tracks.hpp"

namespace swirl {

/// Options as given; empty if not given.
struct TrackTexts {
    std::string fps, scale, omega, centre, phase;
    std::string amplitude, container_radius;
    bool clockwise = false;
    std::string columns;
    bool y_up = false;
};

/// The number given with --name, or `otherwise` if `text` is empty. Throws UsageError for a number
/// below `from`.
double number_option(const std::string& name, const std::string& text, double otherwise,
                     double from);

/// Adds all options of TrackTexts except --amplitude and --container-radius, which some subcommands
/// define themselves.
void add_track_options(Subcommand& subcommand, TrackTexts& texts, const std::string& group);

/// Throws UsageError if one of these options is given for a trajectory of swirl, or for a run if
/// `file` is empty.
[[noreturn]] void throw_option_of_tracks(std::string_view name, const std::string& file);
void reject_track_options(const TrackTexts& given, const std::string& file);

/// True if the name ends with .csv or .h5.
bool is_named_as_tracks(const std::string& file);
/// True if the file is HDF5 or named so, but does not hold tracks. Throws Failure if unreadable.
bool is_trajectory(const std::string& file);
/// Reads tracks (HDF5, table of a tracker or LAMMPS dump, by their first bytes) and repairs them
/// (swirl/io/track_repair.hpp). Only a table may have another layout. Throws FileError.
Tracks read_tracks(const std::string& file, const TrackScale& scale, const TableLayout& layout);
/// The layout that --columns and --y-up give. Throws UsageError.
TableLayout table_layout(const TrackTexts& given);
/// Key `format` of a .camera.json; a file without it has format 1.
inline constexpr int camera_format = 1;
/// tracks.csv or tracks.h5 → tracks.camera.json: the calibration that `swirl track` found.
std::filesystem::path camera_file(std::filesystem::path tracks);
/// Options that are not given are read from camera_file(file), if it exists. Throws UsageError for
/// a missing or invalid option, Failure for an invalid file.
TrackScale track_scale(const TrackTexts& given, const std::string& file);

/// Further contents of camera_file(file); defaults if it does not exist.
struct CameraRecord {
    std::int64_t first_frame = 0;
    std::vector<std::array<double, 4>> poses;  // poses of the moving camera, from first_frame on
    std::optional<double> uneven_times;        // largest deviation of a step, relative to the mean
    std::vector<UncertainLink> uncertain;      // two for each of the likeliest swaps of IDs
};
CameraRecord camera_record(const std::string& file);

}  // namespace swirl
