#include "swirl/draw/canvas.hpp"

#include <cairo-pdf.h>
#include <cairo-svg.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
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

std::string written_aside(const std::string& path) { return path + ".partial"; }

cairo_status_t append_to_file(void* file, const unsigned char* bytes, unsigned int count) {
    return std::fwrite(bytes, 1, count, static_cast<std::FILE*>(file)) == count
               ? CAIRO_STATUS_SUCCESS
               : CAIRO_STATUS_WRITE_ERROR;
}

[[noreturn]] void fail_to_write(const std::string& path, const char* reason) {
    std::remove(written_aside(path).c_str());
    throw DrawFailure("The picture " + path + " could not be written: " + reason + ".");
}

void move_into_place(const std::string& path) {
    if (std::rename(written_aside(path).c_str(), path.c_str()) != 0)
        fail_to_write(path, std::strerror(errno));
}

}  // namespace

Canvas::Canvas(Size size)
    : size_(size),
      surface_(cairo_image_surface_create(CAIRO_FORMAT_RGB24, size.width, size.height)),
      cairo_(cairo_create(surface_)) {
    set_up_text(cairo_);
    if (cairo_status(cairo_) == CAIRO_STATUS_SUCCESS) return;
    const std::string reason = cairo_status_to_string(cairo_status(cairo_));
    cairo_destroy(cairo_);
    cairo_surface_destroy(surface_);
    throw DrawFailure("A picture of " + std::to_string(size.width) + "x" +
                      std::to_string(size.height) + " pixels could not be made: " + reason + ".");
}

Canvas::Canvas(Size size, PictureFormat format, const std::string& path)
    : size_(size), path_(path), format_(format) {
    // 96 pixels per inch, as browsers have it; PDF counts in points of 1/72 inch.
    constexpr double points_per_pixel = 72.0 / 96.0;
    const std::string aside = written_aside(path);
    switch (format) {
        case PictureFormat::png:
            surface_ = cairo_image_surface_create(CAIRO_FORMAT_RGB24, size.width, size.height);
            break;
        case PictureFormat::svg:
            surface_ = cairo_svg_surface_create(aside.c_str(), size.width, size.height);
            cairo_svg_surface_set_document_unit(surface_, CAIRO_SVG_UNIT_PX);
            break;
        case PictureFormat::pdf:
            surface_ = cairo_pdf_surface_create(aside.c_str(), points_per_pixel * size.width,
                                                points_per_pixel * size.height);
            // Without this the file holds the moment it was made, and no two are equal.
            cairo_pdf_surface_set_metadata(surface_, CAIRO_PDF_METADATA_CREATE_DATE,
                                           "1970-01-01T00:00:00Z");
            break;
    }
    cairo_ = cairo_create(surface_);
    set_up_text(cairo_);
    if (cairo_status(cairo_) != CAIRO_STATUS_SUCCESS) {
        const std::string reason = cairo_status_to_string(cairo_status(cairo_));
        cairo_destroy(cairo_);
        cairo_surface_destroy(surface_);
        fail_to_write(path, reason.c_str());
    }
    if (format == PictureFormat::pdf) cairo_scale(cairo_, points_per_pixel, points_per_pixel);
}

Canvas::~Canvas() {
    cairo_destroy(cairo_);
    cairo_surface_destroy(surface_);
    // A vector file that was not finished is not left lying about.
    if (!path_.empty()) std::remove(written_aside(path_).c_str());
}

void Canvas::finish() {
    if (format_ == PictureFormat::png) {
        write_png(path_);
        path_.clear();
        return;
    }
    cairo_surface_finish(surface_);
    const cairo_status_t status = cairo_surface_status(surface_);
    const std::string path = std::exchange(path_, std::string());
    if (status != CAIRO_STATUS_SUCCESS) fail_to_write(path, cairo_status_to_string(status));
    move_into_place(path);
}

std::span<std::uint8_t> Canvas::pixels() {
    cairo_surface_flush(surface_);
    // For this format cairo's rows are exactly four bytes per pixel: no gap.
    return {cairo_image_surface_get_data(surface_),
            static_cast<std::size_t>(size_.width) * static_cast<std::size_t>(size_.height) * 4};
}

void Canvas::write_png(const std::string& path) {
    std::FILE* file = std::fopen(written_aside(path).c_str(), "wb");
    if (file == nullptr) fail_to_write(path, std::strerror(errno));
    errno = 0;
    const cairo_status_t status = cairo_surface_write_to_png_stream(surface_, append_to_file, file);
    const int write_error = errno;
    const bool closed = std::fclose(file) == 0;
    if (status != CAIRO_STATUS_SUCCESS)
        fail_to_write(
            path, write_error != 0 ? std::strerror(write_error) : cairo_status_to_string(status));
    if (!closed) fail_to_write(path, std::strerror(errno));
    move_into_place(path);
}

void Canvas::fill_page(const Color& color) const {
    set(color);
    cairo_paint(cairo_);
}

}  // namespace swirl
