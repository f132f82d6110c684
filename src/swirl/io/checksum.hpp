// CRC-64 with the reflected ECMA-182 polynomial, as in xz: the checksum of "123456789" is
// 995dc9bbdf1939fa. It detects damaged files. It does not protect against deliberate changes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace swirl {

namespace detail {

using CrcTables = std::array<std::array<std::uint64_t, 256>, 8>;
constexpr CrcTables make_crc_tables() {
    CrcTables t{};
    for (std::uint64_t byte = 0; byte < 256; ++byte) {
        std::uint64_t c = byte;
        for (int bit = 0; bit < 8; ++bit) c = (c >> 1) ^ ((c & 1) ? 0xC96C5795D7870F42ull : 0ull);
        t[0][byte] = c;
    }
    // t[k][b] is the checksum of byte b followed by k zero bytes. So eight bytes take one step.
    for (std::size_t k = 1; k < 8; ++k)
        for (std::size_t byte = 0; byte < 256; ++byte)
            t[k][byte] = t[0][t[k - 1][byte] & 255] ^ (t[k - 1][byte] >> 8);
    return t;
}
inline constexpr CrcTables crc_tables = make_crc_tables();

}  // namespace detail

class Checksum {
  public:
    void add(const void* bytes, std::size_t size) {
        const auto* p = static_cast<const unsigned char*>(bytes);
        std::uint64_t c = ~value_;
        for (; size >= 8; size -= 8, p += 8) {
            for (int k = 0; k < 8; ++k) c ^= std::uint64_t(p[k]) << (8 * k);
            std::uint64_t next = 0;
            for (int k = 0; k < 8; ++k) next ^= detail::crc_tables[7 - k][(c >> (8 * k)) & 255];
            c = next;
        }
        for (; size > 0; --size, ++p) c = detail::crc_tables[0][(c ^ *p) & 255] ^ (c >> 8);
        value_ = ~c;
    }
    std::uint64_t value() const { return value_; }

  private:
    std::uint64_t value_ = 0;
};

inline std::uint64_t checksum(std::string_view bytes) {
    Checksum c;
    c.add(bytes.data(), bytes.size());
    return c.value();
}

}  // namespace swirl
