// The paper's numerical videos (SI "Video"), named as there, and movies.html, which plays them side
// by side with a line on what to see.
//
//     numerical · lab frame, M-frame · all friction, no disc friction, no wall friction ·
//         rotating (N = 28), counterrotating (N = 48)
//     minimal model · lab frame, M-frame · no slip, slip
//
// The SI calls N = 48 counterrotating also where one friction is missing; what the cluster really
// does there is measured over the swirls shown and stands on the page.
//
// A movie that an earlier call has finished is kept if it would come out the same: same program,
// same settings, and the file as long as it was (paper/parts.hpp).
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
    std::size_t remembered = 0;                // made by an earlier call
};

/// Throws Failure, Interrupted.
PaperMovies make_paper_movies(const PaperMoviesSettings& settings,
                              const PaperMoviesControl& control = {});

}  // namespace swirl
