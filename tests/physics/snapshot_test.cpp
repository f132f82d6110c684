#include "swirl/physics/snapshot.hpp"

#include <gtest/gtest.h>

namespace swirl {
namespace {

TEST(Snapshot, SpheresOfAnotherNumberHaveAllTheirColumns) {
    Snapshot s;
    s.resize_for_spheres(2);
    s.turned.resize(2);
    s.resize(5);
    for (const auto* column : {&s.x, &s.held_at, &s.inertia, &s.spin_x, &s.spin_y, &s.ax, &s.ay})
        EXPECT_EQ(column->size(), 5u);
    EXPECT_EQ(s.turned.size(), 5u);
    Snapshot discs;
    discs.resize(5);
    EXPECT_FALSE(discs.are_spheres());
    EXPECT_TRUE(discs.spin_x.empty() && discs.turned.empty());
}

}  // namespace
}  // namespace swirl
