// The page of a picture or movie: title, one or more dishes side by side, captions, what the
// colours mean, the running plot, the line of parameters; laid out for any size. Where there is
// room to spare at the side, the text stands there as a column; else above and below. What would be
// too small to read is left out.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "swirl/render/canvas.hpp"
#include "swirl/render/label.hpp"
#include "swirl/render/plot.hpp"
#include "swirl/render/scene.hpp"
#include "swirl/render/theme.hpp"
#include "swirl/render/view.hpp"

namespace swirl {

struct Panel {
    Frame frame = Frame::lab;
    std::string caption;
    double container_radius = 1.0, amplitude = 0.0;
    bool turned = false;  // room for the arc of SceneContent::turned, and its number
};

struct SheetSpec {
    Size size{1920, 1080};
    SceneStyle style;
    std::string title;
    std::vector<std::string> parameters;  // "$N$ = 48", …
    std::vector<Panel> panels;
    std::optional<PlotStyle> plot;  // its `type` is set by the layout
    bool clock = true;              // the running count of swirls
    int clock_decimals = 2;
};

class Sheet {
  public:
    explicit Sheet(const SheetSpec& spec);

    const SheetSpec& spec() const { return spec_; }
    const View& view(std::size_t panel) const { return views_[panel]; }

    /// What is the same in every frame.
    void draw_still(const Canvas& canvas) const;
    /// What changes: `contents` has one entry per panel; `curves` belong to the plot; `swirls` is
    /// the time shown.
    void draw_moving(const Canvas& canvas, std::span<const SceneContent> contents,
                     std::span<const Curve> curves, double periods) const;

  private:
    struct Text {
        std::string text;
        Vec2 place;
        LabelStyle style;
    };

    void lay_out(const Canvas& canvas);
    void lay_out_column(const Canvas& canvas, const Rectangle& column);
    void lay_out_bands(const Canvas& canvas);
    void lay_out_panels(const Canvas& canvas, const Rectangle& area, double side, double gap);
    void lay_out_caption(const Canvas& canvas, const Panel& panel, const Rectangle& square,
                         double gap);
    bool title_shares_line(const Canvas& canvas, double inner) const;
    double legend_width(const Canvas& canvas, const LabelStyle& label) const;
    void draw_legend(const Canvas& canvas) const;
    void draw_panel(const Canvas& canvas, std::size_t k, const SceneContent& content) const;
    double legend_height() const;
    double column_width(const Canvas& canvas) const;
    double clock_width() const { return (6.3 + 0.6 * spec_.clock_decimals) * type_; }

    SheetSpec spec_;
    double type_ = 0.0;  // size of the ordinary type
    double margin_ = 0.0;
    double number_line_ = 0.0;                                // baseline of the captions
    double scale_ = std::numeric_limits<double>::infinity();  // pixels per unit of length
    std::vector<View> views_;
    std::vector<Text> texts_;
    std::optional<Rectangle> plot_area_;
    std::optional<Vec2> clock_place_;
    Align clock_align_ = Align::left;
    std::optional<Rectangle> legend_area_;
};

}  // namespace swirl
