#include "swirl/render/jpeg.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <string_view>

namespace swirl {

namespace {

constexpr std::size_t side = 8, block_size = side * side;

/// Position in a block, row by row, of the k-th coefficient.
constexpr std::array<std::uint8_t, block_size> zigzag{
    0,  1,  8,  16, 9,  2,  3,  10, 17, 24, 32, 25, 18, 11, 4,  5,  12, 19, 26, 33, 40, 48,
    41, 34, 27, 20, 13, 6,  7,  14, 21, 28, 35, 42, 49, 56, 57, 50, 43, 36, 29, 22, 15, 23,
    30, 37, 44, 51, 58, 59, 52, 45, 38, 31, 39, 46, 53, 60, 61, 54, 47, 55, 62, 63};

/// Table K.1 (luminance), row by row. It is used for colour as well.
constexpr std::array<std::uint8_t, block_size> quantization{
    16, 11, 10, 16, 24,  40,  51,  61,  12, 12, 14, 19, 26,  58,  60,  55,
    14, 13, 16, 24, 40,  57,  69,  56,  14, 17, 22, 29, 51,  87,  80,  62,
    18, 22, 37, 56, 68,  109, 103, 77,  24, 35, 55, 64, 81,  104, 113, 92,
    49, 64, 78, 87, 103, 121, 120, 101, 72, 92, 95, 98, 112, 100, 103, 99};

/// Tables K.3 and K.5: numbers of codes of 1 to 16 bits, and their symbols.
struct CodeTable {
    std::array<std::uint8_t, 16> counts;
    std::string_view symbols;
};
using namespace std::string_view_literals;
constexpr CodeTable dc_codes{{0, 1, 5, 1, 1, 1, 1, 1, 1, 0, 0, 0, 0, 0, 0, 0},
                             "\x00\x01\x02\x03\x04\x05\x06\x07\x08\x09\x0a\x0b"sv};
constexpr CodeTable ac_codes{
    {0, 2, 1, 3, 3, 2, 4, 3, 5, 5, 4, 4, 0, 0, 1, 0x7d},
    "\x01\x02\x03\x00\x04\x11\x05\x12\x21\x31\x41\x06\x13\x51\x61\x07\x22\x71\x14\x32\x81\x91\xa1"
    "\x08\x23\x42\xb1\xc1\x15\x52\xd1\xf0\x24\x33\x62\x72\x82\x09\x0a\x16\x17\x18\x19\x1a\x25\x26"
    "\x27\x28\x29\x2a\x34\x35\x36\x37\x38\x39\x3a\x43\x44\x45\x46\x47\x48\x49\x4a\x53\x54\x55\x56"
    "\x57\x58\x59\x5a\x63\x64\x65\x66\x67\x68\x69\x6a\x73\x74\x75\x76\x77\x78\x79\x7a\x83\x84\x85"
    "\x86\x87\x88\x89\x8a\x92\x93\x94\x95\x96\x97\x98\x99\x9a\xa2\xa3\xa4\xa5\xa6\xa7\xa8\xa9\xaa"
    "\xb2\xb3\xb4\xb5\xb6\xb7\xb8\xb9\xba\xc2\xc3\xc4\xc5\xc6\xc7\xc8\xc9\xca\xd2\xd3\xd4\xd5\xd6"
    "\xd7\xd8\xd9\xda\xe1\xe2\xe3\xe4\xe5\xe6\xe7\xe8\xe9\xea\xf1\xf2\xf3\xf4\xf5\xf6\xf7\xf8\xf9"
    "\xfa"sv};

struct Code {
    unsigned bits = 0;
    int length = 0;
};

/// The code of each symbol: codes of one length ascend, in the order of the table.
std::array<Code, 256> codes_of(const CodeTable& table) {
    std::array<Code, 256> codes{};
    unsigned bits = 0;
    std::size_t symbol = 0;
    for (int length = 1; length <= 16; ++length, bits <<= 1)
        for (int n = 0; n < table.counts[static_cast<std::size_t>(length - 1)]; ++n)
            codes[static_cast<std::uint8_t>(table.symbols[symbol++])] = {bits++, length};
    return codes;
}

/// cos((2x + 1) u π/16), scaled such that the transform of rows and columns is orthonormal.
std::array<float, block_size> cosine_table() {
    constexpr double sixteenth = 3.14159265358979 / 16.0;
    std::array<float, block_size> table{};
    for (std::size_t u = 0; u < side; ++u)
        for (std::size_t x = 0; x < side; ++x)
            table[side * u + x] = static_cast<float>((u == 0 ? std::sqrt(0.125) : 0.5) *
                                                     std::cos(double((2 * x + 1) * u) * sixteenth));
    return table;
}

class JpegWriter {
  public:
    JpegWriter(Size size, int quality) : size_(size) {
        const int percent = quality < 50 ? 5000 / std::max(1, quality) : 200 - 2 * quality;
        for (std::size_t k = 0; k < block_size; ++k)
            steps_[k] = static_cast<std::uint8_t>(
                std::clamp((quantization[k] * percent + 50) / 100, 1, 255));
        write_head();
    }

    std::string of(const std::uint8_t* rgb) {
        std::array<std::array<float, block_size>, 3> planes{};
        for (int top = 0; top < size_.height; top += int(side))
            for (int left = 0; left < size_.width; left += int(side)) {
                load(rgb, left, top, planes);
                for (std::size_t c = 0; c < planes.size(); ++c) write_block(planes[c], c);
            }
        put(0x7f, 7);  // fills the last byte
        out_ += "\xff\xd9";
        return std::move(out_);
    }

  private:
    void byte(int value) { out_ += static_cast<char>(value); }
    void word(int value) { byte(value >> 8), byte(value & 0xff); }
    void segment(int marker, int content) { byte(0xff), byte(marker), word(content + 2); }

    void write_codes(int id, const CodeTable& table) {
        segment(0xc4, int(17 + table.symbols.size()));
        byte(id);
        for (const std::uint8_t count : table.counts) byte(count);
        out_ += table.symbols;
    }

    void write_head() {
        out_ = "\xff\xd8";
        segment(0xe0, 14);
        out_ += "JFIF\0\x01\x02\0\0\x01\0\x01\0\0"sv;
        segment(0xdb, 65);
        byte(0);
        for (const std::uint8_t at : zigzag) byte(steps_[at]);
        segment(0xc0, 15);
        byte(8), word(size_.height), word(size_.width), byte(3);
        for (int component = 1; component <= 3; ++component)
            byte(component), byte(0x11), byte(0);  // not subsampled; table 0
        write_codes(0x00, dc_codes);
        write_codes(0x10, ac_codes);
        segment(0xda, 10);
        byte(3);
        for (int component = 1; component <= 3; ++component) byte(component), byte(0);
        byte(0), byte(63), byte(0);
    }

    /// A block of the image in Y, Cb and Cr around 0. Beyond the edge, the last pixels repeat.
    void load(const std::uint8_t* rgb, int left, int top,
              std::array<std::array<float, block_size>, 3>& planes) const {
        for (std::size_t k = 0; k < block_size; ++k) {
            const int x = std::min(left + int(k % side), size_.width - 1);
            const int y = std::min(top + int(k / side), size_.height - 1);
            const std::uint8_t* p =
                rgb + 3 * (std::size_t(y) * std::size_t(size_.width) + std::size_t(x));
            const float r = p[0], g = p[1], b = p[2];
            planes[0][k] = 0.299F * r + 0.587F * g + 0.114F * b - 128.0F;
            planes[1][k] = -0.168736F * r - 0.331264F * g + 0.5F * b;
            planes[2][k] = 0.5F * r - 0.418688F * g - 0.081312F * b;
        }
    }

    /// Cosine transform along rows and columns, quantised, in zigzag order.
    std::array<int, block_size> coefficients(const std::array<float, block_size>& pixels) const {
        std::array<float, block_size> half{};
        for (std::size_t y = 0; y < side; ++y)
            for (std::size_t u = 0; u < side; ++u)
                for (std::size_t x = 0; x < side; ++x)
                    half[side * y + u] += cosines_[side * u + x] * pixels[side * y + x];
        std::array<int, block_size> result{};
        for (std::size_t k = 0; k < block_size; ++k) {
            const std::size_t v = zigzag[k] / side, u = zigzag[k] % side;
            float sum = 0.0F;
            for (std::size_t y = 0; y < side; ++y)
                sum += cosines_[side * v + y] * half[side * y + u];
            result[k] = static_cast<int>(std::lround(sum / float(steps_[zigzag[k]])));
        }
        return result;
    }

    void put(unsigned bits, int length) {
        buffer_ = (buffer_ << length) | bits;
        for (filled_ += length; filled_ >= 8; filled_ -= 8) {
            const int next = int((buffer_ >> (filled_ - 8)) & 0xff);
            byte(next);
            if (next == 0xff) byte(0);  // no marker
        }
    }

    /// A code, whose low four bits give the number of bits of `value`, and these bits.
    void put_value(const std::array<Code, 256>& codes, int run, int value) {
        int length = 0;
        while (std::abs(value) >> length) ++length;
        const Code& code = codes[static_cast<std::size_t>(16 * run + length)];
        put(code.bits, code.length);
        if (length > 0)
            put(static_cast<unsigned>(value < 0 ? value + (1 << length) - 1 : value), length);
    }

    void write_block(const std::array<float, block_size>& pixels, std::size_t component) {
        constexpr int longest_run = 15;
        const std::array<int, block_size> values = coefficients(pixels);
        put_value(dc_, 0, values[0] - last_dc_[component]);
        last_dc_[component] = values[0];
        int run = 0;
        for (std::size_t k = 1; k < block_size; ++k) {
            if (values[k] == 0) {
                ++run;
                continue;
            }
            for (; run > longest_run; run -= longest_run + 1) put(ac_[0xf0].bits, ac_[0xf0].length);
            put_value(ac_, run, values[k]);
            run = 0;
        }
        if (run > 0) put(ac_[0].bits, ac_[0].length);  // the rest is 0
    }

    Size size_;
    std::array<std::uint8_t, block_size> steps_{};
    const std::array<float, block_size> cosines_ = cosine_table();
    const std::array<Code, 256> dc_ = codes_of(dc_codes), ac_ = codes_of(ac_codes);
    std::array<int, 3> last_dc_{};
    std::uint64_t buffer_ = 0;
    int filled_ = 0;  // bits of `buffer_`
    std::string out_;
};

}  // namespace

std::string jpeg_of(const std::uint8_t* rgb, Size size, int quality) {
    return JpegWriter(size, quality).of(rgb);
}

}  // namespace swirl
