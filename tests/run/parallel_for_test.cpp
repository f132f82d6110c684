#include "swirl/run/parallel_for.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <stdexcept>
#include <thread>
#include <vector>

namespace swirl {
namespace {

TEST(ParallelFor, RunsEveryTaskOnce) {
    for (const unsigned threads : {0u, 1u, 3u, 64u}) {
        std::vector<std::atomic<int>> done(1000);
        parallel_for(
            done.size(), [&](std::size_t k) { ++done[k]; }, threads);
        for (const auto& times : done) EXPECT_EQ(times, 1);
    }
}

TEST(ParallelFor, UsesSeveralThreadsByDefault) {
    if (available_cores() < 2) GTEST_SKIP() << "this machine has one core";
    // Each of two tasks waits until the other has begun. One thread alone gives up in the end.
    std::atomic<int> begun = 0, met = 0;
    parallel_for(2, [&](std::size_t) {
        ++begun;
        const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(20);
        while (begun < 2 && std::chrono::steady_clock::now() < give_up) std::this_thread::yield();
        met += begun == 2;
    });
    EXPECT_EQ(met, 2);
}

TEST(ParallelFor, AcceptsZeroTasks) {
    parallel_for(0, [](std::size_t) { FAIL(); });
}

TEST(ParallelFor, RethrowsAnExceptionAndStartsNoFurtherTask) {
    // One thread begins the tasks in their order. The tasks of the second call are so many that it
    // ends only if the exception of one thread stops both.
    std::atomic<int> begun = 0;
    const auto work = [&](std::size_t k) {
        ++begun;
        if (k == 3) throw std::runtime_error("three");
    };
    EXPECT_THROW(parallel_for(100'000, work, 1), std::runtime_error);
    EXPECT_EQ(begun, 4);
    const auto endless = [](std::size_t k) {
        if (k == 3) throw std::runtime_error("three");
    };
    EXPECT_THROW(parallel_for(std::size_t{1} << 62, endless, 2), std::runtime_error);
}

}  // namespace
}  // namespace swirl
