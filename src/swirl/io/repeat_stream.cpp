#include "swirl/io/repeat_stream.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

#include "swirl/math/wide.hpp"

namespace swirl {
namespace {

static_assert(std::endian::native == std::endian::little, "bits go out lowest byte first");

/// Bits as they stand in the stream, the first one lowest.
struct Code {
    std::uint64_t bits = 0;
    unsigned length = 0;
};

/// Huffman codes go out from their highest bit.
constexpr std::uint64_t reversed(std::uint64_t bits, unsigned length) {
    std::uint64_t r = 0;
    for (unsigned k = 0; k < length; ++k) r |= ((bits >> k) & 1) << (length - 1 - k);
    return r;
}

constexpr Code joined(const Code& first, const Code& second) {
    return {first.bits | second.bits << first.length, first.length + second.length};
}

/// The fixed code of RFC 1951, 3.2.6.
constexpr Code symbol(unsigned s) {
    if (s < 144) return {reversed(0x30 + s, 8), 8};
    if (s < 256) return {reversed(0x190 + s - 144, 9), 9};
    if (s < 280) return {reversed(s - 256, 7), 7};
    return {reversed(0xC0 + s - 280, 8), 8};
}
constexpr unsigned end_of_block = 256;

/// A number among those of lengths (first symbol 257, numbers from 3, four symbols to each number
/// of extra bits) or of distances (0, 1, two): symbol and extra bits.
struct Ranged {
    unsigned symbol;
    Code extra;
};
constexpr Ranged ranged(unsigned number, unsigned symbols_each, unsigned smallest) {
    unsigned first = smallest, s = 0;
    for (unsigned extra = 0;; ++extra)
        for (unsigned k = 0; k < (extra == 0 ? 2 : 1) * symbols_each; ++k, ++s) {
            if (number < first + (1u << extra)) return {s, {number - first, extra}};
            first += 1u << extra;
        }
}

constexpr unsigned longest_match = 32;  // words; 256 of the 258 bytes that there are
constexpr std::size_t farthest = 32768;

/// Matches of 1 … 32 words at one distance.
std::array<Code, longest_match + 1> match_codes(std::size_t distance) {
    const Ranged d = ranged(unsigned(distance), 2, 1);
    const Code back = joined({reversed(d.symbol, 5), 5}, d.extra);
    std::array<Code, longest_match + 1> codes{};
    for (unsigned words = 1; words <= longest_match; ++words) {
        const Ranged l = ranged(8 * words, 4, 3);
        codes[words] = joined(joined(symbol(257 + l.symbol), l.extra), back);
    }
    return codes;
}

constexpr auto literal_codes = [] {
    std::array<Code, 256> codes{};
    for (unsigned byte = 0; byte < 256; ++byte) codes[byte] = symbol(byte);
    return codes;
}();

class BitWriter {
  public:
    explicit BitWriter(unsigned char* to) : to_(to) {}
    /// At most 56 bits between two calls of drain().
    void put(const Code& code) {
        hold_ |= code.bits << held_;
        held_ += code.length;
    }
    void drain() {
        std::memcpy(to_, &hold_, sizeof hold_);
        to_ += held_ / 8;
        hold_ >>= held_ / 8 * 8;
        held_ %= 8;
    }
    void put_word(std::uint64_t word) {
        for (int half = 0; half < 2; ++half, word >>= 32) {
            for (int byte = 0; byte < 32; byte += 8) put(literal_codes[(word >> byte) & 255]);
            drain();
        }
    }
    unsigned char* end() {
        drain();
        if (held_ > 0) *to_++ = static_cast<unsigned char>(hold_);
        return to_;
    }

  private:
    unsigned char* to_;
    std::uint64_t hold_ = 0;
    unsigned held_ = 0;
};

SWIRL_WIDE std::size_t count_repeats(const std::uint64_t* __restrict above,
                                     const std::uint64_t* __restrict here, std::size_t n) {
    std::uint64_t repeats = 0;
    for (std::size_t k = 0; k < n; ++k) repeats += above[k] == here[k];
    return repeats;
}

/// Σ byte and Σ (n − k) byte_k; n at most 5552, so that both fit.
SWIRL_WIDE void weigh(const unsigned char* bytes, std::uint32_t n, std::uint32_t& plain,
                      std::uint32_t& weighted) {
    std::uint32_t p = 0, w = 0;
    for (std::uint32_t k = 0; k < n; ++k) {
        p += bytes[k];
        w += (n - k) * bytes[k];
    }
    plain = p;
    weighted = w;
}

}  // namespace

std::uint32_t adler32(std::span<const unsigned char> bytes) {
    constexpr std::uint64_t prime = 65521;
    std::uint64_t a = 1, b = 0;
    while (!bytes.empty()) {
        const std::size_t n = std::min<std::size_t>(bytes.size(), 5552);
        std::uint32_t plain, weighted;
        weigh(bytes.data(), std::uint32_t(n), plain, weighted);
        b = (b + n * a + weighted) % prime;
        a = (a + plain) % prime;
        bytes = bytes.subspan(n);
    }
    return std::uint32_t(b << 16 | a);
}

std::size_t make_repeat_stream(std::span<const std::uint64_t> words, std::size_t row,
                               std::vector<unsigned char>& stream) {
    const std::size_t n = words.size(), distance = 8 * row;
    if (n <= row || distance > farthest) return 0;
    // A literal word takes 68 bits on average, one that repeats at most 33: fewer than one in four
    // that repeat is not worth it.
    if (4 * count_repeats(words.data(), words.data() + row, n - row) < n) return 0;

    if (stream.size() < n * 9 + 64) stream.resize(n * 9 + 64);
    stream[0] = 0x78;  // deflate with a window of 32 KiB
    stream[1] = 0x01;  // the check bits of that
    BitWriter bits(stream.data() + 2);
    bits.put({0b011, 3});  // the last block, with the fixed code
    const auto matches = match_codes(distance);
    const std::uint64_t* const w = words.data();
    for (std::size_t k = 0; k < row; ++k) bits.put_word(w[k]);
    for (std::size_t k = row; k < n;) {
        if (w[k] != w[k - row]) {
            bits.put_word(w[k++]);
            continue;
        }
        const std::size_t begin = k, end = std::min(n, begin + longest_match);
        while (k < end && w[k] == w[k - row]) ++k;
        bits.put(matches[k - begin]);
        bits.drain();
    }
    bits.put(symbol(end_of_block));
    unsigned char* end = bits.end();
    const std::uint32_t sum = adler32({reinterpret_cast<const unsigned char*>(w), 8 * n});
    for (const unsigned shift : {24u, 16u, 8u, 0u}) *end++ = (sum >> shift) & 255;
    const auto size = std::size_t(end - stream.data());
    return size <= 7 * n ? size : 0;
}

}  // namespace swirl
