#include "swirl/measure/flow_map.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "measure/snapshots.hpp"

namespace swirl {
namespace {

TEST(FlowMap, DiscsCarriedByTheContainerHaveNoFlow) {
    FlowMap map(R);
    for (int k = 0; k < 6; ++k) {
        Snapshot s = random_discs(40, k, k / 6.0);
        for (std::size_t i = 0; i < s.size(); ++i) {
            s.vx[i] = s.container_velocity.x;
            s.vy[i] = s.container_velocity.y;
        }
        map.sample(s);
    }
    map.close_block();
    for (std::size_t c = 0; c < map.grid().cells(); ++c) {
        if (map.visits(c) == 0.0) continue;
        EXPECT_NEAR(map.flow_x(c).mean, 0.0, 1e-15);
        EXPECT_NEAR(map.flow_y(c).mean, 0.0, 1e-15);
    }
}

TEST(FlowMap, RigidRotationAboutCGivesOmegaTimesThePosition) {
    const double rate = 0.3;
    FlowMap map(R, 20);
    for (int k = 0; k < 40; ++k) {
        Snapshot s = empty_container(k / 40.0);
        const MFrame f = m_frame(s);
        for (std::size_t cell = 0; cell < map.grid().cells(); ++cell) {
            const Vec2 p = map.grid().centre_of(cell);
            add_disc(s, f.lab_position(p),
                     s.container_velocity + f.rotate_back(rate * perpendicular(p)));
        }
        map.sample(s);
        map.close_block();
    }
    for (std::size_t c = 0; c < map.grid().cells(); ++c) {
        const Vec2 p = map.grid().centre_of(c);
        EXPECT_NEAR(map.flow_x(c).mean, -rate * p.y, 1e-14);
        EXPECT_NEAR(map.flow_y(c).mean, rate * p.x, 1e-14);
        EXPECT_EQ(map.visits(c), 40.0);
        EXPECT_NEAR(map.flow_x(c).error, 0.0, 1e-7);
    }
}

TEST(FlowMap, AnUnvisitedCellHasNoFlow) {
    FlowMap map(R);
    map.sample(random_discs(30, 1));
    map.close_block();
    EXPECT_TRUE(std::isnan(map.flow_x(0).mean));
}

}  // namespace
}  // namespace swirl
