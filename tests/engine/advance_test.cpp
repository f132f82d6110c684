// advance_to() with a limit on the number of events gives the same results.
#include <gtest/gtest.h>

#include "swirl/engine/placement.hpp"
#include "swirl/engine/simulation.hpp"

namespace swirl {
namespace {

InitialState container(double radius) {
    InitialState scene{.path = polygon_path(1.892, 11.866071, 30), .container_radius = 8.6};
    const auto centres = place_discs(std::vector<double>(30, radius), 8.6, 1);
    for (const Vec2& centre : *centres)
        scene.discs.push_back({scene.path.segments.front().start + centre,
                               scene.path.segments.front().velocity, 0.0, 0.0, 0.0, radius, 1.0,
                               10.0});
    return scene;
}

TEST(AdvanceInParts, GivesTheSameState) {
    Simulation at_once(container(1.0)), in_parts(container(1.0));
    for (const auto& [periods, clock] :
         {std::pair<std::int64_t, double>{0, 5.0}, {0, 5.0}, {3, 1.25}}) {
        at_once.advance_to(periods, clock);
        std::uint64_t before = in_parts.events().total();
        while (!in_parts.advance_to(periods, clock, 7)) {
            // The time was not reached, so all seven events were executed.
            EXPECT_EQ(in_parts.events().total(), before + 7);
            before = in_parts.events().total();
        }
        EXPECT_EQ(in_parts.periods(), periods);
        EXPECT_EQ(in_parts.clock(), clock);
        EXPECT_EQ(in_parts.state_hash(), at_once.state_hash());
    }
    EXPECT_GT(in_parts.events().total(), 1000u);
}

TEST(AdvanceInParts, WithoutEventsTheClockDoesNotAdvance) {
    Simulation simulation(container(1.0));
    EXPECT_FALSE(simulation.advance_to(1, 0.0, 0));
    EXPECT_EQ(simulation.events().total(), 0u);
    EXPECT_EQ(simulation.clock(), 0.0);
}

}  // namespace
}  // namespace swirl
