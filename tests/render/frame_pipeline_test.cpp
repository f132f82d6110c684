#include "swirl/render/frame_pipeline.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <stdexcept>

namespace swirl {
namespace {

TEST(FramePipeline, DeliversInOrderOfSubmission) {
    for (unsigned count : {1u, 2u, 5u}) {
        std::vector<int> order;
        FramePipeline pipeline(
            count, [&](const FramePipeline::Bytes& bytes) { order.push_back(bytes[0]); });
        for (int k = 0; k < 100; ++k)
            pipeline.submit([k](unsigned, FramePipeline::Bytes& bytes) {
                // Every seventh frame takes longer, so that later frames overtake it.
                std::this_thread::sleep_for(std::chrono::microseconds(k % 7 == 0 ? 900 : 10));
                bytes.assign(1, static_cast<std::uint8_t>(k));
            });
        pipeline.finish();
        ASSERT_EQ(order.size(), 100u);
        for (int k = 0; k < 100; ++k) EXPECT_EQ(order[k], k);
        EXPECT_EQ(pipeline.delivered(), 100u);
    }
}

TEST(FramePipeline, LimitsFramesInProgress) {
    std::atomic<int> in_progress = 0, maximum = 0;
    FramePipeline pipeline(2, [&](const FramePipeline::Bytes&) {
        std::this_thread::sleep_for(std::chrono::microseconds(200));
        --in_progress;
    });
    for (int k = 0; k < 60; ++k) {
        pipeline.submit([](unsigned, FramePipeline::Bytes& bytes) { bytes.assign(1, 0); });
        maximum = std::max(maximum.load(), ++in_progress);
    }
    pipeline.finish();
    EXPECT_LE(maximum, 2 * 2 + 2 + 1);
}

TEST(FramePipeline, RethrowsExceptionsOfWorkers) {
    FramePipeline pipeline(2, [](const FramePipeline::Bytes&) {});
    const auto all = [&] {
        for (int k = 0; k < 50; ++k)
            pipeline.submit([k](unsigned, FramePipeline::Bytes&) {
                if (k == 10) throw std::runtime_error("no more blue");
            });
        pipeline.finish();
    };
    EXPECT_THROW(all(), std::runtime_error);
}

TEST(FramePipeline, RethrowsExceptionsOfTheDelivery) {
    FramePipeline pipeline(2,
                           [](const FramePipeline::Bytes&) { throw std::runtime_error("full"); });
    const auto all = [&] {
        for (int k = 0; k < 50; ++k) pipeline.submit([](unsigned, FramePipeline::Bytes&) {});
        pipeline.finish();
    };
    EXPECT_THROW(all(), std::runtime_error);
}

TEST(FramePipeline, CanBeDestroyedWithFramesInProgress) {
    FramePipeline pipeline(2, [](const FramePipeline::Bytes&) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    });
    for (int k = 0; k < 5; ++k) pipeline.submit([](unsigned, FramePipeline::Bytes&) {});
}

}  // namespace
}  // namespace swirl
