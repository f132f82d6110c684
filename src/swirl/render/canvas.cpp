#include "swirl/render/canvas.hpp"

#include <cairo-pdf.h>
#include <cairo-svg.h>

#include <new>
#include <utility>

#include "swirl/math/unit_circle.hpp"

namespace swirl {

namespace {

/// Switches hinting off: glyphs are not moved to the pixel grid, so text scales smoothly and looks
/// the same in images and movies.
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

[[noreturn]] void throw_cannot_make(Size size, cairo_status_t status) {
    throw DrawFailure("cannot make an image of " + std::to_string(size.width) + "x" +
                      std::to_string(size.height) + " pixels: " + cairo_status_to_string(status) +
                      ".");
}

}  // namespace

Canvas::Canvas(Size size)
    : size_(size),
      surface_(cairo_image_surface_create(CAIRO_FORMAT_RGB24, size.width, size.height)),
      cairo_(cairo_create(surface_)) {
    set_up();
}

Canvas::Canvas(Size size, ImageFormat format) : size_(size), format_(format) {
    // As in browsers, there are 96 pixels per inch. PDF counts in points of 1/72 inch.
    constexpr double points_per_pixel = 72.0 / 96.0;
    switch (format) {
        case ImageFormat::png:
            surface_ = cairo_image_surface_create(CAIRO_FORMAT_RGB24, size.width, size.height);
            break;
        case ImageFormat::svg:
            surface_ = cairo_svg_surface_create_for_stream(append_to_bytes, &bytes_, size.width,
                                                           size.height);
            cairo_svg_surface_set_document_unit(surface_, CAIRO_SVG_UNIT_PX);
            break;
        case ImageFormat::pdf:
            surface_ = cairo_pdf_surface_create_for_stream(append_to_bytes, &bytes_,
                                                           points_per_pixel * size.width,
                                                           points_per_pixel * size.height);
            // A fixed date: with the current time, no two files would be equal.
            cairo_pdf_surface_set_metadata(surface_, CAIRO_PDF_METADATA_CREATE_DATE,
                                           "1970-01-01T00:00:00Z");
            break;
    }
    cairo_ = cairo_create(surface_);
    set_up();
    if (format == ImageFormat::pdf) cairo_scale(cairo_, points_per_pixel, points_per_pixel);
}

void Canvas::set_up() {
    set_up_text(cairo_);
    const cairo_status_t status = cairo_status(cairo_);
    if (status == CAIRO_STATUS_SUCCESS) return;
    cairo_destroy(cairo_);
    cairo_surface_destroy(surface_);
    throw_cannot_make(size_, status);
}

Canvas::~Canvas() {
    cairo_destroy(cairo_);
    cairo_surface_destroy(surface_);
}

std::string Canvas::finish() {
    if (format_ == ImageFormat::png) return png();
    cairo_surface_finish(surface_);
    const cairo_status_t status = cairo_surface_status(surface_);
    if (status != CAIRO_STATUS_SUCCESS) throw_cannot_make(size_, status);
    return std::move(bytes_);
}

std::span<std::uint8_t> Canvas::pixels() {
    cairo_surface_flush(surface_);
    // In this format cairo's rows have exactly four bytes per pixel, without a gap.
    return {cairo_image_surface_get_data(surface_),
            static_cast<std::size_t>(size_.width) * static_cast<std::size_t>(size_.height) * 4};
}

std::string Canvas::png() {
    std::string bytes;
    const cairo_status_t status =
        cairo_surface_write_to_png_stream(surface_, append_to_bytes, &bytes);
    if (status != CAIRO_STATUS_SUCCESS) throw_cannot_make(size_, status);
    return bytes;
}

void Canvas::fill_page(const Color& color) const {
    set(color);
    cairo_paint(cairo_);
}

void Canvas::add_circle(const Vec2& centre, double radius) const {
    cairo_new_sub_path(cairo_);
    cairo_arc(cairo_, centre.x, centre.y, radius, 0.0, 2.0 * pi);
}

void Canvas::add_line(const Vec2& from, const Vec2& to) const {
    cairo_move_to(cairo_, from.x, from.y);
    cairo_line_to(cairo_, to.x, to.y);
}

void Canvas::add_polygon(std::initializer_list<Vec2> vertices) const {
    cairo_new_sub_path(cairo_);
    for (const Vec2& v : vertices) cairo_line_to(cairo_, v.x, v.y);
    cairo_close_path(cairo_);
}

void Canvas::fill(const Color& color, double opacity, Path path) const {
    set(color, opacity);
    (path == Path::keep ? cairo_fill_preserve : cairo_fill)(cairo_);
}

void Canvas::stroke(double width, const Color& color, double opacity, Path path) const {
    set(color, opacity);
    cairo_set_line_width(cairo_, width);
    (path == Path::keep ? cairo_stroke_preserve : cairo_stroke)(cairo_);
}

}  // namespace swirl
