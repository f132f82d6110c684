// The options that say how the tracks of a camera, or of another program, translate.
#pragma once

#include <filesystem>
#include <string>

#include "swirl/cli/options.hpp"
#include "swirl/io/tracks.hpp"

namespace swirl {

/// As given, so that what was not given is known.
struct TrackTexts {
    std::string fps, scale, omega, centre, phase;
    std::string amplitude, container_radius;
    bool clockwise = false;
};

/// The number given with --name, at least `from`; `otherwise` if none was. Throws WrongCall.
double number_option(const std::string& name, const std::string& text, double otherwise,
                     double from);

/// --amplitude and --container-radius are left to the caller, who may have them already.
void add_track_options(Subcommand& subcommand, TrackTexts& texts, const std::string& group);

/// FILE.csv or FILE.h5; whether it is there or not.
bool is_named_as_tracks(const std::string& file);
/// Whether the file is one of ours (HDF5) and no tracks. Throws Failure if it cannot be read.
bool is_trajectory(const std::string& file);
/// Tracks of ours (HDF5), a table of trackpy or a LAMMPS dump, by what it begins with, mended
/// (io/track_repair.hpp). Throws FileError.
Tracks read_tracks(const std::string& file, const TrackScale& scale);
/// Of a .camera.json, its key `format`. Files without it are in format 1.
inline constexpr int camera_format = 1;
/// tracks.csv or tracks.h5 → tracks.camera.json: what `swirl track` found of the dish, beside the
/// tracks.
std::filesystem::path camera_file(std::filesystem::path tracks);
/// What is not given is taken from there, if there is such a file. Throws WrongCall for what is
/// missing or wrong.
TrackScale track_scale(const TrackTexts& given, const std::string& file);

}  // namespace swirl
