#include "swirl/run/parallel_for.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
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

TEST(ParallelFor, AcceptsZeroTasks) {
    parallel_for(0, [](std::size_t) { FAIL(); });
}

TEST(ParallelFor, RethrowsAnExceptionAndStartsNoFurtherTask) {
    std::atomic<int> begun = 0;
    const auto work = [&](std::size_t k) {
        ++begun;
        if (k == 3) throw std::runtime_error("three");
    };
    EXPECT_THROW(parallel_for(100'000, work, 2), std::runtime_error);
    EXPECT_LT(begun, 100'000);
}

}  // namespace
}  // namespace swirl
