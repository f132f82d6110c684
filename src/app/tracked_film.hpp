// What is written of a film that was tracked: the tracks, and beside them all that was found.
#pragma once

#include <nlohmann/json.hpp>

#include <filesystem>
#include <optional>
#include <string>

namespace swirl {

struct TrackedFilm;
struct FilmSpins;

/// Where the pictures are from, and what is known of them.
struct FilmSource {
    std::string film;
    std::optional<double> dish_diameter, disc_diameter;  // millimetres
};

/// Throws Failure: this build has no OpenCV.
[[noreturn]] void throw_no_eyes();

/// The dish at the first picture, as one reads it off: from 0 to 360 degrees.
double phase_of(const TrackedFilm& film);

/// Both files, each whole or not at all; returns what stands in the second (camera_file()).
nlohmann::ordered_json write_tracks(const TrackedFilm& film, const FilmSource& source,
                                    const std::filesystem::path& out,
                                    const FilmSpins* spins = nullptr);

}  // namespace swirl
