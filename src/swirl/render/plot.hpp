// The running plot below a movie: one or more curves against time, drawn up to the present.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "swirl/render/canvas.hpp"
#include "swirl/render/theme.hpp"

namespace swirl {

/// `smooth` is the curve to read (the mean over the last period). `raw` is the instantaneous value
/// behind it, drawn faintly. Times are in periods.
struct Curve {
    std::vector<double> time, raw, smooth;
    std::string label;
    Color color;
};

struct PlotStyle {
    double from, to;         // limits of the time axis, in periods
    double lowest, highest;  // limits of the vertical axis
    std::string vertical_label = "$ϖ$/$Ω$";
    std::string time_label = "periods";
    double em;  // font size in pixels
};

/// Sets the vertical range: zero, every smooth value between `from` and `to`, and the middle 95 %
/// of the raw values there, with a margin. Rare spikes of the raw curve are cut at the edges:
/// with them the sign of the smooth curve could not be read.
void fit_range(PlotStyle& style, std::span<const Curve> curves);

/// Draws axes, grid and zero line.
void draw_plot_frame(const Canvas& canvas, const Rectangle& area, const Theme& theme,
                     const PlotStyle& style);
/// Draws the curves up to `now`, each with a dot at its end.
void draw_plot_curves(const Canvas& canvas, const Rectangle& area, const Theme& theme,
                      const PlotStyle& style, std::span<const Curve> curves, double now);

/// The smallest step of 1, 2 or 5 times a power of ten that divides `span` into at most `count`
/// parts.
double round_step(double span, int count);

}  // namespace swirl
