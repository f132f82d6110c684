// The paper's numerical videos (SI "Video"), named as there, and movies.html, which plays them side
// by side with a line on what to see.
//
//     numerical · lab frame, M-frame · all friction, no disc friction, no wall friction ·
//         rotating (N = 28), counterrotating (N = 48)
//     minimal model · lab frame, M-frame · no slip, slip
//
// The SI calls N = 48 counterrotating also where one friction is missing; what the cluster really
// does there is measured over the swirls shown and stands on the page.
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

/// Returns the files, movies.html last. Throws Failure, Interrupted.
std::vector<std::filesystem::path> make_paper_movies(const PaperMoviesSettings& settings,
                                                     const PaperMoviesControl& control = {});

}  // namespace swirl
