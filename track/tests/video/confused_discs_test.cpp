#include <gtest/gtest.h>

#include "swirl/math/unit_circle.hpp"
#include "swirl/run/failure.hpp"
#include "track/video/tracking_steps.hpp"

namespace swirl::tracking {
namespace confused_discs_tests {

/// Twenty discs in one period of 60 frames, with this many possible swaps for each disc. Each disc
/// was not seen in the frames between `frame` and `from`.
TrackedVideo with_swaps(std::size_t for_each_disc, std::size_t frame, std::size_t from) {
    TrackedVideo tracked;
    for (int k = 0; k <= 60; ++k) tracked.times.push_back(k);
    tracked.path.omega = 2.0 * pi / 60.0;
    tracked.number = 20;
    for (std::size_t k = 0; k < for_each_disc * tracked.number; ++k)
        tracked.swaps.push_back(
            {.frame = frame, .first = 0, .second = 1, .from = from, .chance = 0.5});
    return tracked;
}

TEST(ConfusedDiscs, AreRejectedIfTheyAreTooFastForTheFrameRate) {
    EXPECT_NO_THROW(reject_confused_discs(with_swaps(0, 30, 29)));
    EXPECT_THROW(reject_confused_discs(with_swaps(2, 30, 29)), Failure);
    EXPECT_THROW(reject_confused_discs(with_swaps(2, 30, 33)), Failure);
}

// A hand that covered half of a dish gave 8.5 possible swaps for each disc, and a hint to use a
// faster camera.
TEST(ConfusedDiscs, AreNotThoseThatAHandCovered) {
    EXPECT_NO_THROW(reject_confused_discs(with_swaps(8, 40, 25)));
    EXPECT_NO_THROW(reject_confused_discs(with_swaps(8, 25, 40)));
}

}  // namespace confused_discs_tests
}  // namespace swirl::tracking
