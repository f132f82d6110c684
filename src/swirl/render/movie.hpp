// A movie of one dish or of several side by side, in the lab frame, the M-frame or both: which
// moments are shown, what is drawn at each, and where it goes.
#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "swirl/measure/m_frame.hpp"
#include "swirl/measure/pinned_loose.hpp"
#include "swirl/render/frame_source.hpp"
#include "swirl/render/scene.hpp"
#include "swirl/render/sheet.hpp"

namespace swirl {

/// How things are shown, in movies and in pictures.
struct Appearance {
    std::vector<Frame> frames{Frame::lab};
    Coloring coloring = Coloring::none;
    std::optional<double> full_speed = {};  // end of the colour scale; else what is seen decides
    bool trails = false;
    double trail_length = 0.3;  // swirls
    bool forces = false;
    bool points = true;
    bool path = true;
    bool angles = false;               // θ at the wall, M-frame
    std::optional<double> slice = {};  // θ of a highlighted slice (paper, Fig. 2a)
    bool clock = true;
    bool plot = false;
    bool turned = false;  // an arc: how far the cluster has turned, lab frame
    bool texts = true;
    std::string title;
    Theme theme = dark_theme();
    Size size{1920, 1080};
};

struct MovieConfig {
    std::vector<FrameSource> sources;  // side by side
    Appearance appearance;
    double start = 0.0;  // swirls
    double pace = 0.5;   // swirls per second
    int frames_per_second = 60;
    int frames = 1200;
    std::string out;            // movie file; empty: none
    std::string frames_folder;  // PNG files; empty: none
};

struct MovieControl {
    const std::atomic<bool>* stop = nullptr;
    /// Called now and then with the number of frames done.
    std::function<void(int done, int of)> progress;
};

struct MovieResult {
    int frames = 0;  // in the file
    bool complete = false;
};

/// Why these dishes cannot be shown so, as a full sentence; nothing if they can.
std::optional<std::string> problem(const std::vector<FrameSource>& sources,
                                   const Appearance& appearance);
/// Why this cannot be filmed, as a full sentence; nothing if it can.
std::optional<std::string> problem(const MovieConfig& config);

/// A frame in MovieConfig::frames_folder; the first has the number 1.
std::string frame_name(const std::string& folder, int number);

/// Stopped early, it leaves a movie of what was filmed. Throws Failure.
MovieResult make_movie(const MovieConfig& config, const MovieControl& control = {});

/// Which discs are pinned, moment after moment. The criterion looks seven frames ahead
/// (measure/pinned_loose.hpp), so this runs a reel of its own, ahead of what is shown.
class PinnedWatch {
  public:
    /// `first`: the first moment that will be asked for.
    PinnedWatch(const FrameSource& source, double first);
    /// At moments that do not decrease.
    const std::vector<std::uint8_t>& at(double periods);

  private:
    static constexpr int frames_per_swirl = 511;  // the paper's camera

    Reel reel_;
    std::optional<double> to_;
    PinnedLoose pinned_;
    MFrameView view_;
    std::int64_t next_;
};

/// The page for these dishes, with scales and plot fitted to the swirls from `start` to `end`.
/// `curves` receives, per dish, what plot and arcs show.
Sheet make_sheet(const std::vector<FrameSource>& sources, const Appearance& appearance,
                 double start, double end, std::vector<Curve>& curves);

/// Turns of the cluster from `start` to `now`: the integral of ϖ/Ω over the swirls.
double turns_until(const Curve& curve, double start, double now);

}  // namespace swirl
