#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>  // jpeglib.h does not include it
#include <cstdlib>
#include <opencv2/imgproc.hpp>

// After <cstdio>.
#include <jpeglib.h>

#include "swirl/tracking/live_tracking.hpp"

namespace swirl {

namespace {

constexpr int fraction_bits = 4;  // of the coordinates that OpenCV draws

void draw_circle(cv::Mat& image, const Vec2& centre, double radius, const cv::Scalar& color,
                 int width) {
    constexpr double unit = 1 << fraction_bits;
    cv::circle(image, {cvRound(unit * centre.x), cvRound(unit * centre.y)}, cvRound(unit * radius),
               color, width, cv::LINE_AA, fraction_bits);
}

/// A colour for each track; neighbouring numbers differ clearly.
cv::Scalar track_color(int track) {
    if (track < 0) return {255.0, 255.0, 255.0};
    constexpr double golden_turn = 0.61803398875, third = 1.0 / 3.0;
    const auto channel = [&](double offset) {
        const double hue = golden_turn * track + offset;
        return 127.5 * (1.0 + std::cos(6.28318530718 * hue));
    };
    return {channel(0.0), channel(third), channel(2.0 * third)};
}

/// Lines of text, in the letters that OpenCV draws.
std::vector<std::string> status_lines(const LiveFrame& frame) {
    if (!frame.surveyed) return {fmt::format("frame {}: survey", frame.number)};
    std::vector<std::string> lines{fmt::format("frame {}: {} of {} discs", frame.number,
                                               frame.discs.size(), frame.number_of_discs)};
    const LiveRotation& r = frame.rotation;
    if (r.periods == 1)
        lines.push_back(fmt::format("rotation/Omega {:+.3f} in 1 period", r.mean.mean));
    if (r.periods > 1)
        lines.push_back(fmt::format("rotation/Omega {:+.3f} +- {:.3f} in {} periods, last {:+.3f}",
                                    r.mean.mean, r.mean.error, r.periods, r.last_period));
    return lines;
}

/// The frame in colour (red, green, blue) with the discs, the rim and the results drawn.
cv::Mat draw_live_frame(const LiveFrame& frame) {
    cv::Mat image;
    cv::cvtColor(frame.grey, image, cv::COLOR_GRAY2RGB);
    if (frame.rim_centre)
        draw_circle(image, *frame.rim_centre, frame.rim_radius, {255.0, 200.0, 0.0}, 1);
    for (const LiveDisc& disc : frame.discs)
        draw_circle(image, disc.position, disc.radius, track_color(disc.track), 2);
    const double size = std::clamp(image.cols / 1280.0, 0.35, 1.0);
    cv::Point at(6, 2);
    for (const std::string& text : status_lines(frame)) {
        at.y += cvRound(34.0 * size);
        for (const auto& [color, width] : {std::pair(0.0, 3), std::pair(255.0, 1)})
            cv::putText(image, text, at, cv::FONT_HERSHEY_SIMPLEX, size, cv::Scalar::all(color),
                        width, cv::LINE_AA);
    }
    return image;
}

}  // namespace

std::string live_jpeg(const LiveFrame& frame) {
    constexpr int quality = 85;
    cv::Mat image = draw_live_frame(frame);
    jpeg_error_mgr errors{};
    jpeg_compress_struct jpeg{};
    jpeg.err = jpeg_std_error(&errors);  // ends the program; only a lack of memory can occur
    jpeg_create_compress(&jpeg);
    unsigned char* bytes = nullptr;
    unsigned long count = 0;
    jpeg_mem_dest(&jpeg, &bytes, &count);
    jpeg.image_width = static_cast<JDIMENSION>(image.cols);
    jpeg.image_height = static_cast<JDIMENSION>(image.rows);
    jpeg.input_components = image.channels();
    jpeg.in_color_space = JCS_RGB;
    jpeg_set_defaults(&jpeg);
    jpeg_set_quality(&jpeg, quality, TRUE);
    jpeg_start_compress(&jpeg, TRUE);
    for (int row = 0; row < image.rows; ++row) {
        JSAMPROW pixels = image.ptr(row);
        jpeg_write_scanlines(&jpeg, &pixels, 1);
    }
    jpeg_finish_compress(&jpeg);
    std::string file(reinterpret_cast<const char*>(bytes), count);
    jpeg_destroy_compress(&jpeg);
    std::free(bytes);
    return file;
}

}  // namespace swirl
