#include "swirl/render/planar.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace swirl {
namespace {

std::vector<std::uint8_t> planes_of(int blue, int green, int red) {
    const Size size{2, 2};
    std::vector<std::uint8_t> pixels, planes;
    for (int k = 0; k < 4; ++k)
        for (int v : {blue, green, red, 255}) pixels.push_back(static_cast<std::uint8_t>(v));
    to_planar(pixels, size, planes);
    return planes;
}

TEST(Planar, GreysHaveNeutralChroma) {
    for (int grey : {0, 1, 64, 128, 200, 255}) {
        const auto planes = planes_of(grey, grey, grey);
        ASSERT_EQ(planes.size(), 6u);
        EXPECT_EQ(planes[0], std::lround(16.0 + 219.0 * grey / 255.0)) << grey;
        EXPECT_EQ(planes[4], 128) << grey;
        EXPECT_EQ(planes[5], 128) << grey;
    }
}

TEST(Planar, AgreesWithBt709WithinRounding) {
    for (int r = 0; r < 256; r += 51)
        for (int g = 0; g < 256; g += 51)
            for (int b = 0; b < 256; b += 51) {
                const double luma = 0.2126 * r + 0.7152 * g + 0.0722 * b;
                const auto planes = planes_of(b, g, r);
                EXPECT_NEAR(planes[0], 16.0 + 219.0 / 255.0 * luma, 0.51);
                EXPECT_NEAR(planes[4], 128.0 + 224.0 / 255.0 * (b - luma) / 1.8556, 0.51);
                EXPECT_NEAR(planes[5], 128.0 + 224.0 / 255.0 * (r - luma) / 1.5748, 0.51);
            }
}

TEST(Planar, ChromaIsTheMeanOfFourPixels) {
    // 4 × 2 pixels: a red and a black column on the left, white on the right.
    const Size size{4, 2};
    std::vector<std::uint8_t> pixels(32, 255), planes;
    const auto set = [&](int x, int y, int b, int g, int r) {
        std::uint8_t* p = pixels.data() + 4 * (4 * y + x);
        p[0] = static_cast<std::uint8_t>(b);
        p[1] = static_cast<std::uint8_t>(g);
        p[2] = static_cast<std::uint8_t>(r);
    };
    set(0, 0, 0, 0, 255);
    set(1, 0, 0, 0, 0);
    set(0, 1, 0, 0, 255);
    set(1, 1, 0, 0, 0);
    to_planar(pixels, size, planes);
    ASSERT_EQ(planes.size(), planar_bytes(size));
    EXPECT_EQ(planes[0], 63);  // 16 + 219·0.2126
    EXPECT_EQ(planes[1], 16);
    EXPECT_EQ(planes[2], 235);
    EXPECT_EQ(planes[4], 63);
    EXPECT_EQ(planes[8], std::lround(128.0 - 224.0 / 255.0 * 0.2126 * 127.5 / 1.8556));
    EXPECT_EQ(planes[9], 128);
    EXPECT_EQ(planes[10], std::lround(128.0 + 224.0 / 255.0 * (1 - 0.2126) * 127.5 / 1.5748));
}

}  // namespace
}  // namespace swirl
