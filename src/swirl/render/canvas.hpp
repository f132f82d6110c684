// Where the picture goes: pixels in memory, or a vector file. A thin owner of a cairo surface; it
// belongs to the thread that uses it, and any number of them may live side by side.
#pragma once

#include <cairo.h>

#include <cstdint>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>

#include "swirl/math/vec2.hpp"
#include "swirl/render/color.hpp"

namespace swirl {

/// A picture or movie that could not be made, as a full sentence.
class DrawFailure : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// In pixels; in a vector file a pixel is 1/96 inch.
struct Size {
    int width, height;
};

struct Rectangle {
    double x, y, width, height;
};

enum class PictureFormat { png, svg, pdf };

class Canvas {
  public:
    /// Pixels, kept in memory.
    explicit Canvas(Size size);
    /// A file of the given kind, which finish() gives. PNG files have `size` pixels. No time
    /// stamps: same picture, same bytes.
    Canvas(Size size, PictureFormat format);
    ~Canvas();
    Canvas(const Canvas&) = delete;
    Canvas& operator=(const Canvas&) = delete;

    cairo_t* cairo() const { return cairo_; }
    Size size() const { return size_; }

    /// Completes the file: its bytes, for whoever brings them onto a disk. Throws DrawFailure.
    std::string finish();

    /// The pixels of a canvas in memory, rows from the top, four bytes each: blue, green, red,
    /// unused. Rows follow each other without gap.
    std::span<std::uint8_t> pixels();
    /// The pixels of a canvas in memory as a PNG file. Throws DrawFailure.
    std::string png();

    void set(const Color& color, double opacity = 1.0) const {
        cairo_set_source_rgba(cairo_, color.red, color.green, color.blue, opacity);
    }
    void fill_page(const Color& color) const;

  private:
    void set_up();

    Size size_;
    std::string bytes_;  // of a vector file, so far
    PictureFormat format_ = PictureFormat::png;
    cairo_surface_t* surface_;
    cairo_t* cairo_;
};

/// While it lives, line styles, fonts and the like may change; then they are as before. So what is
/// drawn never depends on what was drawn earlier, or by which of several canvases.
class StyleScope {
  public:
    explicit StyleScope(const Canvas& canvas) : cairo_(canvas.cairo()) { cairo_save(cairo_); }
    ~StyleScope() { cairo_restore(cairo_); }
    StyleScope(const StyleScope&) = delete;
    StyleScope& operator=(const StyleScope&) = delete;

  private:
    cairo_t* cairo_;
};

}  // namespace swirl
