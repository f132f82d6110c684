// The paper's numerical videos (SI "Video"), with its names, and movies.html, which plays them next
// to each other with a line on what they show.
//
//     numerical · lab frame, M-frame · all friction, no disc friction, no wall friction ·
//         rotating (N = 28), counterrotating (N = 48)
//     minimal model · lab frame, M-frame · no slip, slip
//
// The SI calls N = 48 counterrotating even if the friction between discs or at the wall is absent.
// movies.html gives the rotation that was measured over the periods shown.
//
// A movie from an earlier call is reused if it would be the same: same program, same settings, and
// the file has its size (result_store.hpp).
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace swirl {

struct PaperMoviesSettings {
    std::filesystem::path out = "out";
    bool quick = false;  // small and short
    std::uint64_t seed = 1;
};

struct PaperMoviesControl {
    const std::atomic<bool>* stop = nullptr;
    std::function<void(double fraction, const std::string& name)> progress;
};

struct PaperMovies {
    std::vector<std::filesystem::path> files;  // movies.html last
    std::size_t reused = 0;                    // from an earlier call
};

/// Throws Failure, Interrupted.
PaperMovies make_paper_movies(const PaperMoviesSettings& settings,
                              const PaperMoviesControl& control = {});

}  // namespace swirl
