// The running plot beneath a movie: a quantity against time, drawn up to the present moment.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "swirl/render/canvas.hpp"
#include "swirl/render/theme.hpp"

namespace swirl {

/// One curve: samples in order of time. `smooth` is what is read off (the mean over the last
/// swirl), `raw` the instantaneous value behind it, drawn faintly.
struct Curve {
    std::vector<double> time, raw, smooth;
    std::string label;
    Color color;
};

struct PlotStyle {
    double from, to;         // of the time axis, in swirls
    double lowest, highest;  // of the vertical axis
    std::string vertical_label = "$ϖ$/$Ω$";
    std::string time_label = "swirls";
    double type;  // size of the type in pixels
};

/// A range that holds zero, every smooth value between `from` and `to`, and the middle 95 % of the
/// raw values there, with some air. Rare spikes of the raw curve are cut at the edges; with room
/// for them, the sign of the smooth curve could not be read.
void fit_range(PlotStyle& style, std::span<const Curve> curves);

/// Axes, grid, zero line: what does not change.
void draw_plot_frame(const Canvas& canvas, const Rectangle& area, const Theme& theme,
                     const PlotStyle& style);
/// The curves up to `now`, each with a dot at its end.
void draw_plot_curves(const Canvas& canvas, const Rectangle& area, const Theme& theme,
                      const PlotStyle& style, std::span<const Curve> curves, double now);

/// A step of 1, 2 or 5 times a power of ten that divides `span` into at most `count` parts.
double round_step(double span, int count);

}  // namespace swirl
