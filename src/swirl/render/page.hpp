// The page of an image or a movie: which containers it shows, how, and with which scales.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "swirl/render/frame_source.hpp"
#include "swirl/render/scene.hpp"
#include "swirl/render/sheet.hpp"
#include "swirl/render/source_player.hpp"

namespace swirl {

/// The appearance of images and movies: the style of the scene and the parts around it. `full_spin`
/// is always fitted to the data.
struct Appearance : SceneStyle {
    std::vector<Frame> frames{Frame::lab};
    std::optional<double> full_speed = {};  // default: fitted to the data
    bool trails = false;
    double trail_length = 0.3;  // periods
    bool clock = true;
    bool plot = false;
    bool turned = false;  // an arc that shows the turns of the cluster, lab frame
    std::optional<double> turns_since = {};  // the period that an image names next to the turns
    bool texts = true;
    bool captions_only = false;  // large, without title, clock and parameters
    std::string title;
    Size size{1920, 1080};
};

/// An error message if these sources cannot be shown in this way.
std::optional<std::string> problem(const std::vector<FrameSource>& sources,
                                   const Appearance& appearance);

class Page {
  public:
    /// Reads the sources once to fit colour scales and plot to the periods from `start` to `end`.
    /// Keeps references to `sources` and `appearance`.
    Page(const std::vector<FrameSource>& sources, const Appearance& appearance, double start,
         double end);

    const Sheet& sheet() const { return *sheet_; }
    /// Draws one instant over sheet().draw_static(). `moments` has one entry per source. Several
    /// threads may draw at a time, each on its own canvas.
    void draw(const Canvas& canvas, std::span<const Moment> moments, double periods) const;
    /// A player of the source with what this page needs.
    SourcePlayer player(std::size_t source, double start) const;

  private:
    const std::vector<FrameSource>& sources_;
    const Appearance& appearance_;
    double start_;
    std::vector<Curve> curves_;  // one per source, for plot and arcs; empty if not needed
    /// One per source: the sectors of its discs, by ID or index, at the start.
    std::vector<std::map<std::int64_t, std::uint8_t>> sectors_;
    std::optional<Sheet> sheet_;
};

/// Turns of the cluster from `start` to `now`: the integral of ϖ/Ω over the periods.
double turns_until(const Curve& curve, double start, double now);

}  // namespace swirl
