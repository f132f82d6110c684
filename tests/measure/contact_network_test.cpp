#include "swirl/measure/contact_network.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>

#include "measure/snapshots.hpp"

namespace swirl {
namespace {

using Numbers = std::map<std::string, double>;

/// The network of discs of radius 1 at these positions relative to C.
ContactNetwork network_of(const std::vector<Vec2>& positions) {
    ContactNetwork network(0.1, 1);
    Snapshot s = empty_container(0.3);
    for (const Vec2& p : positions) add_disc(s, s.container_centre + p, {0.0, 0.0});
    network.sample(s);
    network.close_block();
    return network;
}

void expect_rows(const ContactNetwork& network, const Numbers& expected) {
    for (const auto& [name, value] : expected)
        EXPECT_NEAR(row_of(network, name).mean, value, 1e-14) << name;
}

TEST(ContactNetwork, Triangle) {
    const ContactNetwork triangle = network_of({{-1.0, 0.0}, {1.0, 0.0}, {0.0, std::sqrt(3.0)}});
    expect_rows(triangle, {{"coordination", 2.0},
                           {"wall", 0.0},
                           {"isolated", 0.0},
                           {"rattlers", 0.0},
                           {"groups", 1.0 / 3.0},
                           {"largest", 1.0},
                           {"loops", 1.0 / 3.0}});
    EXPECT_EQ(triangle.share(2).mean, 1.0);
}

TEST(ContactNetwork, ChainHasTwoRattlersAndNoLoop) {
    const ContactNetwork chain =
        network_of({{-4.0, 0.0}, {-2.0, 0.0}, {0.0, 0.0}, {2.0, 0.0}, {4.0, 0.0}});
    expect_rows(chain, {{"coordination", 8.0 / 5.0},
                        {"isolated", 0.0},
                        {"rattlers", 2.0 / 5.0},
                        {"groups", 1.0 / 5.0},
                        {"largest", 1.0},
                        {"loops", 0.0}});
    EXPECT_EQ(chain.share(1).mean, 2.0 / 5.0);
    EXPECT_EQ(chain.share(2).mean, 3.0 / 5.0);
}

std::vector<Vec2> hexagon() {
    std::vector<Vec2> positions;
    for (int k = 0; k < 6; ++k) positions.push_back(2.0 * unit_circle(k / 6.0));
    return positions;
}

TEST(ContactNetwork, HexagonHasOneLoopAndItsCentreAddsFive) {
    std::vector<Vec2> positions = hexagon();
    expect_rows(network_of(positions), {{"coordination", 2.0}, {"loops", 1.0 / 6.0}});
    positions.push_back({0.0, 0.0});
    const ContactNetwork flower = network_of(positions);
    expect_rows(flower, {{"coordination", 24.0 / 7.0},
                         {"groups", 1.0 / 7.0},
                         {"largest", 1.0},
                         {"loops", 6.0 / 7.0}});
    EXPECT_EQ(flower.share(3).mean, 6.0 / 7.0);
    EXPECT_EQ(flower.share(6).mean, 1.0 / 7.0);
}

TEST(ContactNetwork, CountsGroupsAndTheWall) {
    // A pair; a disc alone; one at the wall (gap 0.05); one at the wall that touches another disc.
    const double wall = paper_container_radius - 1.0;
    const ContactNetwork network = network_of({{-1.0, 0.0},
                                               {1.05, 0.0},
                                               {0.0, 4.0},
                                               {0.0, -(wall - 0.05)},
                                               {wall, 0.0},
                                               {wall - 2.0, 0.0}});
    expect_rows(network, {{"coordination", 4.0 / 6.0},
                          {"wall", 2.0 / 6.0},
                          {"isolated", 1.0 / 6.0},
                          {"rattlers", 5.0 / 6.0},  // all but the one between wall and disc
                          {"groups", 4.0 / 6.0},
                          {"largest", 2.0 / 6.0},
                          {"loops", 0.0}});
}

TEST(ContactNetwork, DependsOnTheGapThatCounts) {
    Snapshot s = empty_container();
    for (const double x : {-1.06, 1.06}) add_disc(s, s.container_centre + Vec2{x, 0.0}, {0.0, 0.0});
    for (const double gap : {0.1, 0.13}) {
        ContactNetwork network(gap, 1);
        network.sample(s);
        network.close_block();
        EXPECT_EQ(row_of(network, "coordination").mean, gap > 0.12 ? 1.0 : 0.0);
    }
}

TEST(ContactNetwork, IsNaNWithoutDiscs) {
    EXPECT_TRUE(std::isnan(row_of(network_of({}), "coordination").mean));
    EXPECT_TRUE(std::isnan(network_of({}).share(0).mean));
}

}  // namespace
}  // namespace swirl
