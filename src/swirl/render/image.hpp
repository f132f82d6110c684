// A picture that was taken, to be drawn beneath what is known of the discs.
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
    /// Black pixels.
    explicit Image(Size size);
    /// Of any depth, grey or in colour. Throws DrawFailure.
    static std::shared_ptr<const Image> from_png(const std::string& path);
    ~Image() { cairo_surface_destroy(surface_); }
    Image(const Image&) = delete;
    Image& operator=(const Image&) = delete;

    Size size() const;
    /// May be read by several threads at a time.
    cairo_surface_t* surface() const { return surface_; }
    /// To fill it: red, green and blue of each pixel, rows from the top.
    void fill(const std::uint8_t* rgb);

  private:
    explicit Image(cairo_surface_t* surface) : surface_(surface) {}
    cairo_surface_t* surface_;
};

/// A picture laid into the plane of the discs: the middle of its pixel in column x and row y lies
/// at origin + x along_x + y along_y.
struct Backdrop {
    std::shared_ptr<const Image> image;
    Vec2 origin{0.0, 0.0}, along_x{1.0, 0.0}, along_y{0.0, -1.0};
};

}  // namespace swirl
