#include "swirl/render/image.hpp"

#include <cstddef>

namespace swirl {

Image::Image(Size size)
    : surface_(cairo_image_surface_create(CAIRO_FORMAT_RGB24, size.width, size.height)) {
    if (cairo_surface_status(surface_) == CAIRO_STATUS_SUCCESS) return;
    cairo_surface_destroy(surface_);
    throw DrawFailure("not enough memory for an image of " + std::to_string(size.width) + "x" +
                      std::to_string(size.height) + " pixels.");
}

std::shared_ptr<const Image> Image::from_png(const std::string& path) {
    cairo_surface_t* const surface = cairo_image_surface_create_from_png(path.c_str());
    const cairo_status_t status = cairo_surface_status(surface);
    if (status == CAIRO_STATUS_SUCCESS) return std::shared_ptr<const Image>(new Image(surface));
    cairo_surface_destroy(surface);
    const std::string reason = status == CAIRO_STATUS_FILE_NOT_FOUND ? "no such file"
                               : status == CAIRO_STATUS_READ_ERROR ? "it is not a complete PNG file"
                                                                   : cairo_status_to_string(status);
    throw DrawFailure("cannot read the image '" + path + "': " + reason + ".");
}

Size Image::size() const {
    return {cairo_image_surface_get_width(surface_), cairo_image_surface_get_height(surface_)};
}

void Image::fill(const std::uint8_t* rgb) {
    cairo_surface_flush(surface_);
    const Size extent = size();
    const int stride = cairo_image_surface_get_stride(surface_);
    std::uint8_t* row = cairo_image_surface_get_data(surface_);
    for (int y = 0; y < extent.height; ++y, row += stride)
        for (int x = 0; x < extent.width; ++x, rgb += 3) {
            row[4 * x] = rgb[2];
            row[4 * x + 1] = rgb[1];
            row[4 * x + 2] = rgb[0];
        }
    cairo_surface_mark_dirty(surface_);
}

}  // namespace swirl
