#include "swirl/measure/fields.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string_view>

#include "measure/snapshots.hpp"

namespace swirl {
namespace {

std::size_t index_of(std::string_view name) {
    for (std::size_t k = 0; k < field_quantities.size(); ++k)
        if (name == field_quantities[k]->key()) return k;
    ADD_FAILURE() << "no field " << name;
    return 0;
}
double field(const FieldGrid& grid, std::size_t cell, std::string_view name) {
    return grid.estimates(cell)[index_of(name)].mean;
}

/// Discs on a lattice much finer than the kernel, so that sums over discs are integrals. The grid
/// has one point, the origin.
constexpr double spacing = 0.05, width = 2.0;
template <class Velocity>
FieldGrid lattice(const Velocity& velocity, double spin) {
    FieldGrid grid({1, 1.0}, {width});
    for (int row = -50; row <= 50; ++row)
        for (int column = -50; column <= 50; ++column) {
            const Vec2 p{spacing * column, spacing * row};
            grid.add(FieldDisc{p, velocity(p), {0.0, 0.0}, spin, 1.5, 0.4, 0.01});
        }
    grid.add_sample(true);
    grid.close_period();
    return grid;
}
// The lattice sum differs from the integral of a kernel with continuous slope by (spacing/width)³.
constexpr double lattice_error = 1e-4;
constexpr double number_density = 1.0 / (spacing * spacing);

TEST(Fields, OfARigidRotationAreItsRates) {
    constexpr double rate = 0.7;
    const FieldGrid grid = lattice([&](const Vec2& p) { return rate * perpendicular(p); }, rate);
    EXPECT_NEAR(field(grid, 0, "density"), 1.5 * number_density, lattice_error * number_density);
    EXPECT_NEAR(field(grid, 0, "packing"), number_density * pi * 1e-4, lattice_error);
    EXPECT_NEAR(field(grid, 0, "vorticity"), 2.0 * rate, lattice_error);
    EXPECT_NEAR(field(grid, 0, "spin"), rate, 1e-13);
    EXPECT_NEAR(field(grid, 0, "spin_temperature"), 0.0, 1e-13);
    EXPECT_NEAR(field(grid, 0, "divergence"), 0.0, 1e-12);
    EXPECT_NEAR(field(grid, 0, "strain_xx"), 0.0, 1e-12);
    EXPECT_NEAR(field(grid, 0, "strain_xy"), 0.0, 1e-12);
    EXPECT_NEAR(field(grid, 0, "u_x"), 0.0, 1e-12);
    EXPECT_NEAR(field(grid, 0, "kinetic_couple_x"), 0.0, 1e-10);
}

TEST(Fields, OfAShearFlowAreItsRates) {
    constexpr double rate = 0.6;
    const FieldGrid grid = lattice(
        [&](const Vec2& p) {
            return Vec2{1.0 + rate * p.y, -0.5};
        },
        -0.2);
    EXPECT_NEAR(field(grid, 0, "u_x"), 1.0, 1e-12);
    EXPECT_NEAR(field(grid, 0, "u_y"), -0.5, 1e-12);
    const double density = field(grid, 0, "density");
    EXPECT_NEAR(field(grid, 0, "momentum_x"), density, 1e-9);
    EXPECT_NEAR(field(grid, 0, "momentum_y"), -0.5 * density, 1e-9);
    EXPECT_NEAR(field(grid, 0, "vorticity"), -rate, lattice_error);
    EXPECT_NEAR(field(grid, 0, "strain_xy"), 0.5 * rate, lattice_error);
    EXPECT_NEAR(field(grid, 0, "strain_xx"), 0.0, 1e-12);
    // The kernel has ⟨y²⟩ = w²/8: the gradient within it counts as fluctuation.
    const double square = 1.5 * rate * rate * width * width / 8.0;
    EXPECT_NEAR(field(grid, 0, "temperature"), 0.5 * square, lattice_error);
    EXPECT_NEAR(field(grid, 0, "kinetic_xx"), -number_density * square,
                lattice_error * number_density);
    EXPECT_NEAR(field(grid, 0, "kinetic_xy"), 0.0, 1e-9);
    EXPECT_NEAR(field(grid, 0, "kinetic_yy"), 0.0, 1e-9);
    EXPECT_NEAR(field(grid, 0, "spin_density"), -0.2 * 0.4 * number_density,
                lattice_error * number_density);
    // All discs have the same spin, so none is carried relative to the flow.
    EXPECT_NEAR(field(grid, 0, "kinetic_couple_x"), 0.0, 1e-9);
    EXPECT_NEAR(field(grid, 0, "kinetic_couple_y"), 0.0, 1e-9);
    EXPECT_TRUE(std::isnan(field(grid, 0, "pressure")));  // no collisions are known
    EXPECT_TRUE(grid.is_consistent());
}

// ∫B dA = 1 and ∫B₁ dA = ½: the sum over a fine grid gives what a collision transfers.
TEST(Fields, OfOneCollisionAddUpToItsTransfer) {
    for (const bool wall : {false, true}) {
        FieldGrid grid({120, 6.0}, {2.0});
        const Transfer t{{0.4, -0.3}, {1.1, 0.9}, {0.8, -1.7}, 0.5, 0.3, wall, 0.25};
        grid.add(t);
        grid.add_sample(true);
        grid.close_period();
        grid.close_events(4.0);
        const double area = grid.grid().cell_area() * 4.0;
        std::array<double, std::tuple_size_v<FieldValues>> sums{};
        for (std::size_t cell = 0; cell < grid.grid().cells(); ++cell)
            for (std::size_t k = 0; k < sums.size(); ++k)
                sums[k] += area * grid.estimates(cell)[k].mean;
        const auto sum = [&](std::string_view name) { return sums[index_of(name)]; };
        constexpr double error = 1e-4;  // (cell width / kernel width)³
        EXPECT_NEAR(sum("collisional_xx"), -0.8 * 1.1, error);
        EXPECT_NEAR(sum("collisional_yy"), 1.7 * 0.9, error);
        // The first index is that of the impulse (0.8, −1.7), the second that of the line (1.1,
        // 0.9).
        EXPECT_NEAR(sum("collisional_xy"), -0.8 * 0.9, error);
        EXPECT_NEAR(sum("collisional_yx"), 1.7 * 1.1, error);
        EXPECT_NEAR(sum("torque"), 1.7 * 1.1 + 0.8 * 0.9, error);
        EXPECT_NEAR(sum("collisional_couple_x"), 1.1 * 0.5 * (0.5 - 0.3), error);
        EXPECT_NEAR(sum("collisional_couple_y"), 0.9 * 0.5 * (0.5 - 0.3), error);
        EXPECT_NEAR(sum("dissipation"), 0.25, error);
        EXPECT_NEAR(sum("wall_force_x"), wall ? -0.8 : 0.0, error);
        EXPECT_NEAR(sum("wall_force_y"), wall ? 1.7 : 0.0, error);
    }
}

// The grid computes these averages for rows of points at once. The tests of coarse_graining.hpp
// compare line_average() with sums along the line. The line enters and leaves some of the kernels.
TEST(Fields, OfOneCollisionAreTheLineAveragesAtEveryPoint) {
    for (const double kernel_width : {0.5, 2.0}) {
        FieldGrid grid({60, 3.5}, {kernel_width});
        const Transfer t{{0.4, -0.3}, {1.1, 0.9}, {0.8, -1.7}, 0.5, 0.3, false, 0.25};
        constexpr double duration = 4.0;
        grid.add(t);
        grid.add_sample(true);
        grid.close_period();
        grid.close_events(duration);
        std::size_t crossed = 0;  // points whose kernel the line enters and leaves
        for (std::size_t cell = 0; cell < grid.grid().cells(); ++cell) {
            const Vec2 q = grid.grid().centre_of(cell) - t.begin;
            const LineAverage average = line_average(grid.kernel(), q, t.line);
            const Stretch stretch = stretch_inside(grid.kernel(), q, t.line);
            crossed += !stretch.empty() && stretch.begin > 0.0 && stretch.end < 1.0;
            const auto sum = [&](std::string_view name) {
                return duration * field(grid, cell, name);
            };
            constexpr double rounding = 1e-12;
            EXPECT_NEAR(sum("collisional_xy"), -0.8 * 0.9 * average.whole, rounding);
            EXPECT_NEAR(sum("dissipation"), 0.25 * average.whole, rounding);
            const double couple = 0.5 * (average.whole - average.weighted) - 0.3 * average.weighted;
            EXPECT_NEAR(sum("collisional_couple_x"), 1.1 * couple, rounding);
        }
        EXPECT_GT(crossed, 0U);
    }
}

TEST(Fields, AreThoseAtAPointOfTheMFrameRelativeToTheContainer) {
    Fields fields(paper_container_radius);
    for (int k = 0; k < 70; ++k) {
        Snapshot s = empty_container(k / 70.0);
        const MFrame frame = m_frame(s);
        add_disc(s, frame.lab_position({3.0, 0.0}),
                 s.container_velocity + frame.rotate_back({0.3, -0.1}), 0.5);
        fields.sample_in_lab(s);
    }
    fields.close_block();
    const FieldGrid& grid = fields.grids()[0];
    const std::size_t cell = grid.grid().cell_at(3.0, 0.1);
    EXPECT_NEAR(field(grid, cell, "u_x"), 0.3, 1e-13);
    EXPECT_NEAR(field(grid, cell, "u_y"), -0.1, 1e-13);
    EXPECT_NEAR(field(grid, cell, "temperature"), 0.0, 1e-13);
    EXPECT_NEAR(field(grid, cell, "spin"), 0.5, 1e-13);
    EXPECT_NEAR(field(fields.grids()[2], fields.grids()[2].grid().cell_at(3.0, 0.0), "spin"), 0.5,
                1e-13);
}

// For groups of equal weight the jackknife of a mean is its standard error.
TEST(Fields, HaveTheStandardErrorOfPeriods) {
    FieldGrid grid({1, 1.0}, {width});
    const double peak = CoarseKernel{width}.value({0.0, 0.0});
    double sum = 0.0, squares = 0.0;
    for (int k = 0; k < 10; ++k) {
        const int discs = 1 + (k * k) % 7;
        for (int i = 0; i < discs; ++i)
            grid.add(FieldDisc{{0.0, 0.0}, {0.0, 0.0}, {0.0, 0.0}, 0.0, 1.0, 1.0, 1.0});
        grid.add_sample(true);
        grid.close_period();
        sum += discs * peak;
        squares += discs * peak * discs * peak;
    }
    const double mean = sum / 10.0, error = std::sqrt((squares / 10.0 - mean * mean) / 9.0);
    const Estimate density = grid.estimates(0)[index_of("density")];
    EXPECT_NEAR(density.mean, mean, 1e-15);
    EXPECT_NEAR(density.error, error, 1e-14);
}

void add_period(FieldGrid& grid, std::uint64_t seed) {
    Noise noise(seed);
    for (int sample = 0; sample < 5; ++sample) {
        for (int i = 0; i < 20; ++i)
            grid.add(FieldDisc{{2.0 * noise(), 2.0 * noise()},
                               {noise(), noise()},
                               {noise(), noise()},
                               noise(),
                               1.0,
                               0.5,
                               1.0});
        grid.add_sample(true);
        grid.add(Transfer{{noise(), noise()},
                          {2.0 * noise(), noise()},
                          {noise(), noise()},
                          noise(),
                          noise(),
                          sample == 0,
                          noise()});
    }
    grid.close_period();
    grid.close_events(3.0);
}

TEST(Fields, MergedEqualOneLongRunAndManyPeriodsAreGrouped) {
    const FieldGrid empty({3, 2.0}, {1.5});
    FieldGrid whole = empty, first = empty, second = empty;
    for (std::uint64_t k = 0; k < 40; ++k) {
        add_period(whole, k);
        add_period(k < 15 ? first : second, k);
    }
    first.merge(second);
    double log_ratio = 0.0;
    int ratios = 0;
    for (std::size_t cell = 0; cell < 9; ++cell) {
        const auto a = whole.estimates(cell), b = first.estimates(cell);
        EXPECT_LT(a[0].blocks, FieldGrid::max_groups);
        EXPECT_GE(a[0].blocks, FieldGrid::max_groups / 2);
        for (std::size_t k = 0; k < a.size(); ++k) {
            EXPECT_NEAR(a[k].mean, b[k].mean, 1e-13) << field_quantities[k]->key();
            // The error of about ten groups scatters by a fifth; that of few collisions scatters
            // more.
            if (a[k].error > 0.0) {
                log_ratio += std::log(b[k].error / a[k].error);
                ++ratios;
            }
        }
    }
    EXPECT_GT(ratios, 200);
    EXPECT_NEAR(log_ratio / ratios, 0.0, 0.2);
}

TEST(Fields, ReportTheSameTablesWithoutData) {
    Report empty, filled;
    Fields fields(paper_container_radius);
    fields.report(empty);
    for (int k = 0; k < 7; ++k) fields.sample_in_lab(random_discs(20, 1));
    fields.close_block();
    fields.report(filled);
    ASSERT_EQ(empty.tables.size(), 3u);
    for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_EQ(empty.tables[k].rows(), 400u);
        EXPECT_EQ(empty.tables[k].columns.size(), filled.tables[k].columns.size());
        EXPECT_TRUE(std::isnan(empty.tables[k].at(0, 2)));
    }
}

// A checkpoint with grids of another size is rejected (is_consistent), one of the same size is not.
TEST(Fields, AreConsistentBeforeAndAfterTheFirstState) {
    Fields fields(paper_container_radius);
    EXPECT_TRUE(fields.is_consistent());
    fields.sample_in_lab(random_discs(5, 1));
    EXPECT_TRUE(fields.is_consistent());
}

}  // namespace
}  // namespace swirl
