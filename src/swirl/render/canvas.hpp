// A drawing surface: pixels in memory, or a vector file. It owns one cairo surface and belongs to
// the thread that uses it; several canvases may exist at a time.
#pragma once

#include <cairo.h>

#include <cstdint>
#include <initializer_list>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>

#include "swirl/math/vec2.hpp"
#include "swirl/render/color.hpp"

namespace swirl {

/// An image or movie could not be made. The text is a message for the user.
class DrawFailure : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// In pixels. In a vector file a pixel is 1/96 inch.
struct Size {
    int width, height;
};

struct Rectangle {
    double x, y, width, height;
};

enum class ImageFormat { png, svg, pdf };

class Canvas {
  public:
    /// Pixels in memory.
    explicit Canvas(Size size);
    /// A file in the given format; finish() returns its bytes. A PNG file has `size` pixels. Files
    /// hold no time stamp, so equal drawings give equal bytes.
    Canvas(Size size, ImageFormat format);
    ~Canvas();
    Canvas(const Canvas&) = delete;
    Canvas& operator=(const Canvas&) = delete;

    cairo_t* cairo() const { return cairo_; }
    Size size() const { return size_; }

    /// Completes the file and returns its bytes. Throws DrawFailure.
    std::string finish();

    /// The pixels of a canvas in memory, rows from the top, four bytes each: blue, green, red,
    /// unused. There is no gap between rows.
    std::span<std::uint8_t> pixels();
    /// The pixels of a canvas in memory as a PNG file. Throws DrawFailure.
    std::string png();

    void set(const Color& color, double opacity = 1.0) const {
        cairo_set_source_rgba(cairo_, color.red, color.green, color.blue, opacity);
    }
    void fill_page(const Color& color) const;

    /// These three add to the current path; coordinates are in pixels, y downwards.
    void add_circle(const Vec2& centre, double radius) const;
    void add_line(const Vec2& from, const Vec2& to) const;
    void add_polygon(std::initializer_list<Vec2> vertices) const;

    enum class Path { clear, keep };
    /// These two draw the current path, and clear it unless `path` says otherwise.
    void fill(const Color& color, double opacity = 1.0, Path path = Path::clear) const;
    void stroke(double width, const Color& color, double opacity = 1.0,
                Path path = Path::clear) const;

  private:
    void set_up();

    Size size_;
    std::string bytes_;  // vector file so far
    ImageFormat format_ = ImageFormat::png;
    cairo_surface_t* surface_;
    cairo_t* cairo_;
};

/// Restores line styles, fonts and the clip region when it is destroyed. What is drawn then does
/// not depend on what was drawn earlier, or on which of several canvases drew it.
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
