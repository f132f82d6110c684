#include "swirl/io/repeat_stream.hpp"

#include <gtest/gtest.h>
#include <zlib.h>

#include <cstring>

#include "swirl/math/random.hpp"

namespace swirl {
namespace {

using Words = std::vector<std::uint64_t>;

/// What zlib makes of a stream of ours.
Words inflated(const std::vector<unsigned char>& stream, std::size_t size, std::size_t words) {
    Words back(words + 1);  // one more than should come
    uLongf bytes = 8 * back.size();
    const int result =
        uncompress(reinterpret_cast<unsigned char*>(back.data()), &bytes, stream.data(), size);
    EXPECT_EQ(result, Z_OK);
    EXPECT_EQ(bytes, 8 * words);
    back.resize(bytes / 8);
    return back;
}

/// A table of random bits in which a word repeats the one above with this probability.
Words table(std::size_t rows, std::size_t row, double repeating, std::uint64_t seed) {
    Random random(seed);
    Words words(rows * row);
    for (std::size_t k = 0; k < words.size(); ++k)
        words[k] = k >= row && random.uniform() < repeating ? words[k - row] : random.bits();
    return words;
}

TEST(RepeatStream, ZlibReadsBackEveryBit) {
    std::vector<unsigned char> stream;
    for (const std::size_t row : {1u, 2u, 3u, 4u, 7u, 8u, 48u, 1000u, 4096u})
        for (const double repeating : {0.3, 0.7, 0.97, 1.0}) {
            const Words words = table(4000 / row + 3, row, repeating, row);
            const std::size_t size = make_repeat_stream(words, row, stream);
            if (size == 0 && row >= 1000) continue;  // the first row, all literals, outweighs
            ASSERT_GT(size, 0u) << row << " " << repeating;
            EXPECT_LE(size, 7 * words.size());
            EXPECT_EQ(inflated(stream, size, words.size()), words) << row << " " << repeating;
        }
}

TEST(RepeatStream, EveryLengthOfARunOfRepeatsIsWritten) {
    std::vector<unsigned char> stream;
    Random random(3);
    Words words;
    for (std::size_t run = 1; run <= 100; ++run) {
        words.push_back(random.bits());
        words.insert(words.end(), run, words.back());
    }
    const std::size_t size = make_repeat_stream(words, 1, stream);
    EXPECT_EQ(inflated(stream, size, words.size()), words);
    EXPECT_LT(size, 2000u);  // 100 literals of 9 bytes, some 230 matches of 3
}

TEST(RepeatStream, SaysNoWhereNothingIsGained) {
    std::vector<unsigned char> stream;
    EXPECT_EQ(make_repeat_stream(table(100, 48, 0.0, 1), 48, stream), 0u);
    EXPECT_EQ(make_repeat_stream(table(100, 48, 0.15, 1), 48, stream), 0u);
    EXPECT_EQ(make_repeat_stream(table(3, 4097, 1.0, 1), 4097, stream), 0u);  // too far back
    EXPECT_EQ(make_repeat_stream(table(1, 48, 1.0, 1), 48, stream), 0u);
    EXPECT_EQ(make_repeat_stream({}, 1, stream), 0u);
}

TEST(RepeatStream, TheChecksumIsThatOfZlib) {
    Random random(4);
    std::vector<unsigned char> bytes(20'000, 255);  // the largest sums that there are
    for (const bool all_255 : {true, false}) {
        for (const std::size_t n : {0u, 1u, 15u, 5551u, 5552u, 5553u, 20'000u})
            EXPECT_EQ(adler32({bytes.data(), n}), ::adler32(1, bytes.data(), uInt(n))) << n;
        if (all_255)
            for (auto& byte : bytes) byte = static_cast<unsigned char>(random.bits() >> 56);
    }
}

}  // namespace
}  // namespace swirl
