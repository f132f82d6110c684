// Lays out the page of an image or movie for any size: title, one or more containers, captions,
// legend, running plot, list of parameters. On a wide page the text is a column at the side,
// otherwise it is above and below. Text that would be too small to read is omitted.
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
    bool shows_turns = false;  // reserves space for the arc of SceneContent::turns and its number
};

struct SheetSpec {
    Size size{1920, 1080};
    SceneStyle style;
    std::string title;
    std::vector<std::string> parameters;  // "$N$ = 48", …
    std::vector<Panel> panels;
    std::optional<PlotStyle> plot;  // the layout sets its `em`
    bool clock = true;              // the running number of periods
    int clock_decimals = 2;
    std::optional<double> turns_since = {};  // the period that is written next to the turns
    bool has_large_captions = false;         // legible where the page is shown on a phone
};

class Sheet {
  public:
    explicit Sheet(const SheetSpec& spec);

    const SheetSpec& spec() const { return spec_; }
    const View& view(std::size_t panel) const { return views_[panel]; }

    /// Draws the parts that are the same in every frame.
    void draw_static(const Canvas& canvas) const;
    /// Draws the parts that change. `contents` has one entry per panel, `curves` belong to the
    /// plot, and `periods` is the time shown.
    void draw_frame(const Canvas& canvas, std::span<const SceneContent> contents,
                    std::span<const Curve> curves, double periods) const;

  private:
    struct Text {
        std::string text;
        Vec2 position;
        LabelStyle style;
    };
    struct LegendEntry {
        enum class Kind { text, dot, arrow, diverging_bar, sequential_bar } kind;
        Color color;
        std::string text, low = {}, high = {};  // `low` and `high` end a colour bar
    };

    void lay_out(const Canvas& canvas);
    void lay_out_column(const Canvas& canvas, const Rectangle& column);
    void lay_out_bands(const Canvas& canvas);
    void lay_out_panels(const Canvas& canvas, const Rectangle& area, double side, double gap);
    void lay_out_caption(const Canvas& canvas, const Panel& panel, const Rectangle& square,
                         double gap);
    double caption_height() const;
    bool title_shares_line(const Canvas& canvas, double inner) const;
    std::vector<LegendEntry> legend() const;
    void draw_legend(const Canvas& canvas) const;
    void draw_panel(const Canvas& canvas, std::size_t k, const SceneContent& content) const;
    double column_width(const Canvas& canvas) const;
    double clock_width() const { return (6.3 + 0.6 * spec_.clock_decimals) * em_; }

    SheetSpec spec_;
    double em_ = 0.0;  // size of the ordinary font, in pixels
    double margin_ = 0.0;
    double caption_line_ = 0.0;                               // baseline of the captions
    double scale_ = std::numeric_limits<double>::infinity();  // pixels per unit of length
    std::vector<View> views_;
    std::vector<Text> texts_;
    std::optional<Rectangle> plot_area_;
    std::optional<Vec2> clock_position_;
    Align clock_align_ = Align::left;
    std::optional<Rectangle> legend_area_;
};

}  // namespace swirl
