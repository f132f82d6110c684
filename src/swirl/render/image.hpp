// A camera image, drawn beneath the discs.
#pragma once

#include <cairo.h>

#include <cstdint>
#include <memory>
#include <string>

#include "swirl/math/vec2.hpp"
#include "swirl/render/canvas.hpp"

namespace swirl {

class Image {
  public:
    /// Black pixels. Throws DrawFailure.
    explicit Image(Size size);
    /// Reads a PNG file of any bit depth, grey or in colour. Throws DrawFailure.
    static std::shared_ptr<const Image> from_png(const std::string& path);
    ~Image() { cairo_surface_destroy(surface_); }
    Image(const Image&) = delete;
    Image& operator=(const Image&) = delete;

    Size size() const;
    /// Several threads may read it at a time.
    cairo_surface_t* surface() const { return surface_; }
    /// Sets all pixels from red, green and blue of each, rows from the top.
    void fill(const std::uint8_t* rgb);

  private:
    explicit Image(cairo_surface_t* surface) : surface_(surface) {}
    cairo_surface_t* surface_;
};

/// An image in the plane of the discs: the centre of the pixel in column x and row y is at
/// origin + x along_x + y along_y.
struct Backdrop {
    std::shared_ptr<const Image> image;
    Vec2 origin{0.0, 0.0}, along_x{1.0, 0.0}, along_y{0.0, -1.0};
};

}  // namespace swirl
