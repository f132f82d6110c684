#include "swirl/render/planar.hpp"

#include "swirl/math/wide.hpp"

namespace swirl {

namespace {

// round(65536 · coefficient). The luma coefficients add up to 219/255, the chroma ones to zero.
constexpr int y_red = 11966, y_green = 40254, y_blue = 4064;
constexpr int cb_red = -6596, cb_green = -22189, cb_blue = 28785;
constexpr int cr_red = 28784, cr_green = -26145, cr_blue = -2639;
constexpr int half = 1 << 15;  // added before a shift by 16: rounds to nearest

SWIRL_WIDE void luma_row(const std::uint8_t* __restrict pixel, int width,
                         std::uint8_t* __restrict luma) {
    for (int x = 0; x < width; ++x) {
        const int b = pixel[4 * x], g = pixel[4 * x + 1], r = pixel[4 * x + 2];
        luma[x] =
            static_cast<std::uint8_t>(16 + ((y_red * r + y_green * g + y_blue * b + half) >> 16));
    }
}

SWIRL_WIDE void chroma_row(const std::uint8_t* __restrict upper,
                           const std::uint8_t* __restrict lower, int pairs,
                           std::uint8_t* __restrict cb, std::uint8_t* __restrict cr) {
    // Sums of four pixels, so the shift has two more bits.
    for (int x = 0; x < pairs; ++x) {
        const int b = upper[8 * x] + upper[8 * x + 4] + lower[8 * x] + lower[8 * x + 4];
        const int g = upper[8 * x + 1] + upper[8 * x + 5] + lower[8 * x + 1] + lower[8 * x + 5];
        const int r = upper[8 * x + 2] + upper[8 * x + 6] + lower[8 * x + 2] + lower[8 * x + 6];
        cb[x] = static_cast<std::uint8_t>(
            128 + ((cb_red * r + cb_green * g + cb_blue * b + 4 * half) >> 18));
        cr[x] = static_cast<std::uint8_t>(
            128 + ((cr_red * r + cr_green * g + cr_blue * b + 4 * half) >> 18));
    }
}

}  // namespace

std::size_t planar_bytes(Size size) {
    return static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height) * 3 / 2;
}

void to_planar(std::span<const std::uint8_t> pixels, Size size, std::vector<std::uint8_t>& planes) {
    planes.resize(planar_bytes(size));
    const auto width = static_cast<std::size_t>(size.width);
    const auto height = static_cast<std::size_t>(size.height);
    std::uint8_t* luma = planes.data();
    std::uint8_t* cb = luma + width * height;
    std::uint8_t* cr = cb + width * height / 4;
    for (std::size_t y = 0; y < height; y += 2) {
        const std::uint8_t* upper = pixels.data() + 4 * width * y;
        const std::uint8_t* lower = upper + 4 * width;
        luma_row(upper, size.width, luma + width * y);
        luma_row(lower, size.width, luma + width * (y + 1));
        chroma_row(upper, lower, size.width / 2, cb + width / 2 * (y / 2),
                   cr + width / 2 * (y / 2));
    }
}

}  // namespace swirl
