// A zlib stream (RFC 1950 and 1951) in one quick pass, for tables of doubles of which many are, bit
// for bit, what stood one row above: velocities and spins, which change only when a disc collides.
// Every inflate reads it; HDF5's deflate filter takes it as its own.
//
// Words that repeat become matches at the distance of one row, all others literals, in one block
// with the fixed Huffman code. Nothing is searched for. So it is some twenty times as fast as
// zlib's level 1, as small where values repeat, and useless where they do not.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace swirl {

/// Writes the stream of `words`, in rows of `row` words, to the beginning of `stream`, which grows
/// if it has to; its length in bytes. 0 when it would not be at least an eighth smaller than the
/// words.
std::size_t make_repeat_stream(std::span<const std::uint64_t> words, std::size_t row,
                               std::vector<unsigned char>& stream);

/// Adler-32 (RFC 1950).
std::uint32_t adler32(std::span<const unsigned char> bytes);

}  // namespace swirl
