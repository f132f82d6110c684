#include "swirl/measure/density_map.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "measure/snapshots.hpp"

namespace swirl {
namespace {

TEST(DensityMap, UniformPointsGiveAFlatMap) {
    DensityMap map(R, 10);
    // A lattice of points, 5 × 5 in every cell, sampled at many phases of the period.
    for (int k = 0; k < 8; ++k) {
        Snapshot s = empty_container(k / 8.0);
        const MFrame f = m_frame(s);
        for (int row = 0; row < 50; ++row)
            for (int column = 0; column < 50; ++column)
                add_disc(
                    s, f.lab_position({(column + 0.5) * R / 25.0 - R, (row + 0.5) * R / 25.0 - R}),
                    {0.0, 0.0});
        map.sample(s);
        map.close_block();
    }
    const double expected = 2500.0 / (4.0 * R * R);
    for (std::size_t c = 0; c < map.grid().cells(); ++c) {
        EXPECT_NEAR(map.density(c).mean, expected, 1e-13);
        EXPECT_NEAR(map.density(c).error, 0.0, 1e-7);  // √ of a rounding error
    }
}

TEST(DensityMap, ADiscIsInItsCellAndTheSumIsTheNumberOfDiscs) {
    DensityMap map(R);
    for (int k = 0; k < 10; ++k) map.sample(random_discs(17, k, 0.1 * k));
    map.close_block();
    double sum = 0.0;
    for (std::size_t c = 0; c < map.grid().cells(); ++c)
        sum += map.density(c).mean * map.grid().cell_area();
    EXPECT_NEAR(sum, 17.0, 1e-12);
    EXPECT_EQ(map.outside(), 0.0);

    DensityMap one(R, 20);
    Snapshot s = empty_container(0.7);
    add_disc(s, m_frame(s).lab_position({3.0, -5.0}), {0.0, 0.0});
    one.sample(s);
    one.close_block();
    const std::size_t cell = one.grid().cell_at(3.0, -5.0);
    EXPECT_EQ(one.count(cell), 1.0);
    EXPECT_NEAR(one.grid().centre_of(cell).x, 3.0, 0.5 * one.grid().cell_width());
    EXPECT_NEAR(one.grid().centre_of(cell).y, -5.0, 0.5 * one.grid().cell_width());
}

TEST(DensityMap, EdgesBelongToACellAndNaNToNone) {
    const SquareGrid grid{4, 2.0};
    EXPECT_EQ(grid.cell_at(-2.0, -2.0), 0u);
    EXPECT_EQ(grid.cell_at(1.999, 1.999), 15u);
    EXPECT_EQ(grid.cell_at(2.0, 0.0), SquareGrid::outside);
    EXPECT_EQ(grid.cell_at(not_available, 0.0), SquareGrid::outside);
    EXPECT_EQ(grid.cell_at(1e300, 0.0), SquareGrid::outside);
    const double x[] = {-2.0, 1.999, 2.0, not_available, 1e300, -1e300, 0.0};
    const double y[] = {-2.0, 1.999, 0.0, 0.0, 0.0, 0.0, not_available};
    std::int32_t cells[7];
    grid.locate(7, x, y, cells);
    for (int k = 0; k < 7; ++k) {
        const std::size_t cell = grid.cell_at(x[k], y[k]);
        EXPECT_EQ(cells[k], cell == SquareGrid::outside ? 16 : static_cast<int>(cell)) << k;
    }
    DensityMap map(R);
    EXPECT_TRUE(std::isnan(map.density(0).mean));
    Snapshot s = empty_container();
    add_disc(s, {100.0, 0.0}, {0.0, 0.0});
    map.sample(s);
    map.close_block();
    EXPECT_EQ(map.outside(), 1.0);
    EXPECT_EQ(map.density(0).mean, 0.0);
}

}  // namespace
}  // namespace swirl
