#include "swirl/render/canvas.hpp"

#include <cairo-pdf.h>
#include <cairo-svg.h>

#include <new>
#include <utility>

namespace swirl {

namespace {

/// Glyphs where they belong, not where the pixel grid would have them: text scales smoothly, and
/// looks the same in a picture and in a movie.
void set_up_text(cairo_t* cairo) {
    cairo_font_options_t* options = cairo_font_options_create();
    cairo_font_options_set_antialias(options, CAIRO_ANTIALIAS_GRAY);
    cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
    cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
    cairo_set_font_options(cairo, options);
    cairo_font_options_destroy(options);
}

cairo_status_t append_to_bytes(void* bytes, const unsigned char* more, unsigned int count) try {
    static_cast<std::string*>(bytes)->append(reinterpret_cast<const char*>(more), count);
    return CAIRO_STATUS_SUCCESS;
} catch (const std::bad_alloc&) {
    return CAIRO_STATUS_NO_MEMORY;
}

[[noreturn]] void fail_to_make(Size size, cairo_status_t status) {
    throw DrawFailure("A picture of " + std::to_string(size.width) + "x" +
                      std::to_string(size.height) +
                      " pixels could not be made: " + cairo_status_to_string(status) + ".");
}

}  // namespace

Canvas::Canvas(Size size)
    : size_(size),
      surface_(cairo_image_surface_create(CAIRO_FORMAT_RGB24, size.width, size.height)),
      cairo_(cairo_create(surface_)) {
    set_up();
}

Canvas::Canvas(Size size, PictureFormat format) : size_(size), format_(format) {
    // 96 pixels per inch, as browsers have it; PDF counts in points of 1/72 inch.
    constexpr double points_per_pixel = 72.0 / 96.0;
    switch (format) {
        case PictureFormat::png:
            surface_ = cairo_image_surface_create(CAIRO_FORMAT_RGB24, size.width, size.height);
            break;
        case PictureFormat::svg:
            surface_ = cairo_svg_surface_create_for_stream(append_to_bytes, &bytes_, size.width,
                                                           size.height);
            cairo_svg_surface_set_document_unit(surface_, CAIRO_SVG_UNIT_PX);
            break;
        case PictureFormat::pdf:
            surface_ = cairo_pdf_surface_create_for_stream(append_to_bytes, &bytes_,
                                                           points_per_pixel * size.width,
                                                           points_per_pixel * size.height);
            // Without this the file holds the moment it was made, and no two are equal.
            cairo_pdf_surface_set_metadata(surface_, CAIRO_PDF_METADATA_CREATE_DATE,
                                           "1970-01-01T00:00:00Z");
            break;
    }
    cairo_ = cairo_create(surface_);
    set_up();
    if (format == PictureFormat::pdf) cairo_scale(cairo_, points_per_pixel, points_per_pixel);
}

void Canvas::set_up() {
    set_up_text(cairo_);
    const cairo_status_t status = cairo_status(cairo_);
    if (status == CAIRO_STATUS_SUCCESS) return;
    cairo_destroy(cairo_);
    cairo_surface_destroy(surface_);
    fail_to_make(size_, status);
}

Canvas::~Canvas() {
    cairo_destroy(cairo_);
    cairo_surface_destroy(surface_);
}

std::string Canvas::finish() {
    if (format_ == PictureFormat::png) return png();
    cairo_surface_finish(surface_);
    const cairo_status_t status = cairo_surface_status(surface_);
    if (status != CAIRO_STATUS_SUCCESS) fail_to_make(size_, status);
    return std::move(bytes_);
}

std::span<std::uint8_t> Canvas::pixels() {
    cairo_surface_flush(surface_);
    // For this format cairo's rows are exactly four bytes per pixel: no gap.
    return {cairo_image_surface_get_data(surface_),
            static_cast<std::size_t>(size_.width) * static_cast<std::size_t>(size_.height) * 4};
}

std::string Canvas::png() {
    std::string bytes;
    const cairo_status_t status =
        cairo_surface_write_to_png_stream(surface_, append_to_bytes, &bytes);
    if (status != CAIRO_STATUS_SUCCESS) fail_to_make(size_, status);
    return bytes;
}

void Canvas::fill_page(const Color& color) const {
    set(color);
    cairo_paint(cairo_);
}

}  // namespace swirl
