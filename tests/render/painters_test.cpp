#include "swirl/render/painters.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <stdexcept>

namespace swirl {
namespace {

TEST(Painters, FramesComeOutInTheOrderTheyWentIn) {
    for (unsigned count : {1u, 2u, 5u}) {
        std::vector<int> order;
        Painters painters(count, [&](const Painters::Bytes& bytes) { order.push_back(bytes[0]); });
        for (int k = 0; k < 100; ++k)
            painters.submit([k](unsigned, Painters::Bytes& bytes) {
                // Early ones take longer, so that later ones overtake them.
                std::this_thread::sleep_for(std::chrono::microseconds(k % 7 == 0 ? 900 : 10));
                bytes.assign(1, static_cast<std::uint8_t>(k));
            });
        painters.finish();
        ASSERT_EQ(order.size(), 100u);
        for (int k = 0; k < 100; ++k) EXPECT_EQ(order[k], k);
        EXPECT_EQ(painters.delivered(), 100u);
    }
}

TEST(Painters, OnlyAFewFramesAreUnderWay) {
    std::atomic<int> under_way = 0, maximum = 0;
    Painters painters(2, [&](const Painters::Bytes&) {
        std::this_thread::sleep_for(std::chrono::microseconds(200));
        --under_way;
    });
    for (int k = 0; k < 60; ++k) {
        painters.submit([](unsigned, Painters::Bytes& bytes) { bytes.assign(1, 0); });
        maximum = std::max(maximum.load(), ++under_way);
    }
    painters.finish();
    EXPECT_LE(maximum, 2 * 2 + 2 + 1);
}

TEST(Painters, WhatAPainterThrowsArrivesAtTheCaller) {
    Painters painters(2, [](const Painters::Bytes&) {});
    const auto all = [&] {
        for (int k = 0; k < 50; ++k)
            painters.submit([k](unsigned, Painters::Bytes&) {
                if (k == 10) throw std::runtime_error("no more blue");
            });
        painters.finish();
    };
    EXPECT_THROW(all(), std::runtime_error);
}

TEST(Painters, WhatTheDeliveryThrowsArrivesAtTheCaller) {
    Painters painters(2, [](const Painters::Bytes&) { throw std::runtime_error("full"); });
    const auto all = [&] {
        for (int k = 0; k < 50; ++k) painters.submit([](unsigned, Painters::Bytes&) {});
        painters.finish();
    };
    EXPECT_THROW(all(), std::runtime_error);
}

TEST(Painters, AbandonedFramesDoNotHang) {
    Painters painters(2, [](const Painters::Bytes&) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    });
    for (int k = 0; k < 5; ++k) painters.submit([](unsigned, Painters::Bytes&) {});
}

}  // namespace
}  // namespace swirl
