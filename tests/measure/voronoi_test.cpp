#include "swirl/measure/voronoi.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "measure/snapshots.hpp"
#include "swirl/measure/hexatic_order.hpp"
#include "swirl/measure/local_packing.hpp"

namespace swirl {
namespace {

/// Index of the disc nearest to C.
std::size_t centre_of(const MFrameView& view) {
    std::size_t best = 0;
    for (std::size_t i = 0; i < view.size(); ++i)
        if (dot(view.position(i), view.position(i)) < dot(view.position(best), view.position(best)))
            best = i;
    return best;
}

TEST(Voronoi, CellsFillTheContainer) {
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
        Snapshot s = random_discs(1 + seed, seed, 0.02 * static_cast<double>(seed));
        if (seed % 2 == 0) {
            Noise noise(seed);
            for (double& r : s.radius) r = 0.5 + 0.3 * noise();
        }
        Voronoi cells;
        cells.find(s);
        double sum = 0.0;
        for (std::size_t i = 0; i < s.size(); ++i) sum += cells.area(i);
        EXPECT_NEAR(sum, pi * R * R, 1e-11) << seed;
    }
}

TEST(Voronoi, EveryPointBelongsToTheDiscOfSmallestPower) {
    // Areas compared with a fine lattice of points.
    Snapshot s = random_discs(9, 5, 0.3);
    Noise noise(5);
    for (double& r : s.radius) r = 1.0 + 0.5 * noise();
    const MFrameView view(s);
    Voronoi cells;
    cells.find(view);
    std::vector<double> counted(s.size(), 0.0);
    const int n = 600;
    const double step = 2.0 * R / n;
    for (int row = 0; row < n; ++row)
        for (int column = 0; column < n; ++column) {
            const Vec2 p{(column + 0.5) * step - R, (row + 0.5) * step - R};
            if (dot(p, p) > R * R) continue;
            std::size_t best = 0;
            double minimum = never;
            for (std::size_t i = 0; i < s.size(); ++i) {
                const Vec2 d = p - view.position(i);
                const double power = dot(d, d) - s.radius[i] * s.radius[i];
                if (power < minimum) {
                    minimum = power;
                    best = i;
                }
            }
            counted[best] += step * step;
        }
    // Error of the lattice: along a border of length ~10 it misses an area of about step × √length.
    for (std::size_t i = 0; i < s.size(); ++i) EXPECT_NEAR(cells.area(i), counted[i], 0.1);
}

TEST(Voronoi, NeighboursAreMutual) {
    const Snapshot s = random_discs(40, 12, 0.3);
    Voronoi cells;
    cells.find(s);
    for (std::size_t i = 0; i < s.size(); ++i)
        for (const Voronoi::Border* b = cells.begin(i); b != cells.end(i); ++b) {
            double back = 0.0;
            for (const Voronoi::Border* c = cells.begin(b->neighbour); c != cells.end(b->neighbour);
                 ++c)
                if (c->neighbour == i) back = c->length;
            EXPECT_NEAR(back, b->length, 1e-12);
        }
}

TEST(Voronoi, OneDiscHasTheWholeContainer) {
    Voronoi cells;
    cells.find(empty_container());
    EXPECT_EQ(cells.size(), 0u);
    Snapshot s = empty_container();
    add_disc(s, {1.0, 2.0}, {0.0, 0.0});
    cells.find(s);
    EXPECT_NEAR(cells.area(0), pi * R * R, 1e-12);
    EXPECT_EQ(cells.begin(0), cells.end(0));
    add_disc(s, {1.0, 2.0}, {0.0, 0.0});  // a second disc at this point
    add_disc(s, {not_available, 2.0}, {0.0, 0.0});
    cells.find(s);
    EXPECT_NEAR(cells.area(1), pi * R * R, 1e-12);
    EXPECT_EQ(cells.area(2), 0.0);
}

TEST(HexaticOrder, IsOneForAPerfectHexagon) {
    const Snapshot s = triangular_lattice(1);
    const MFrameView view(s);
    Voronoi cells;
    cells.find(view);
    const std::size_t centre = centre_of(view);
    EXPECT_EQ(cells.end(centre) - cells.begin(centre), 6);
    EXPECT_NEAR(hexatic_order(view, cells, centre), 1.0, 1e-14);
}

TEST(HexaticOrder, IsZeroForASquareLattice) {
    Snapshot s = empty_container(0.4);
    for (int row = -2; row <= 2; ++row)
        for (int column = -2; column <= 2; ++column)
            add_disc(s, s.container_centre + Vec2{2.0 * column, 2.0 * row}, {0.0, 0.0});
    const MFrameView view(s);
    Voronoi cells;
    cells.find(view);
    // exp(6 i θ) at 0°, 90°, 180°, 270° is 1, −1, 1, −1.
    EXPECT_NEAR(hexatic_order(view, cells, centre_of(view)), 0.0, 1e-12);
}

TEST(HexaticOrder, DoesNotDependOnTheDirectionOfTheCluster) {
    const Snapshot s = random_discs(30, 9, 0.2);
    const MFrameView view(s);
    Voronoi cells;
    cells.find(view);
    for (const double u : {0.01, 0.2, 0.7}) {
        Snapshot turned = s;
        for (std::size_t i = 0; i < s.size(); ++i) {
            const Vec2 d = s.position(i) - s.container_centre, e = unit_circle(u);
            const Vec2 p = s.container_centre + e.x * d + e.y * perpendicular(d);
            turned.x[i] = p.x;
            turned.y[i] = p.y;
        }
        const MFrameView turned_view(turned);
        Voronoi turned_cells;
        turned_cells.find(turned_view);
        for (std::size_t i = 0; i < s.size(); ++i)
            EXPECT_NEAR(hexatic_order(turned_view, turned_cells, i), hexatic_order(view, cells, i),
                        1e-11);
    }
}

TEST(HexaticOrder, SixNeighboursAreCountedAwayFromTheWallAlone) {
    // A hexagon of 19 discs whose outer ring touches the wall: the 7 within have six neighbours
    // each, the 12 at the wall cannot, and do not count.
    const auto share = [](const Snapshot& s, std::vector<std::uint8_t> pinned = {}) {
        const MFrameView view(s);
        Voronoi cells;
        cells.find(view);
        HexaticOrder order;
        order.sample(view, cells, pinned);
        order.close_block();
        return std::pair{order.six().mean, order.six_pinned().mean};
    };
    EXPECT_EQ(share(triangular_lattice(2)).first, 1.0);
    // A disc whose centre is within two radii of the wall is at the wall, however large it is.
    Snapshot wide = triangular_lattice(2);
    for (double& radius : wide.radius) radius = 1.5;
    EXPECT_EQ(share(wide).first, 1.0);
    for (double& radius : wide.radius) radius = 2.6;
    EXPECT_TRUE(std::isnan(share(wide).first));
    EXPECT_TRUE(std::isnan(share(triangular_lattice(2)).second));  // pinned flags are missing
    // In a ring of five, one disc has five neighbours and five have three.
    Snapshot five = empty_container(0.15);
    add_disc(five, five.container_centre, {0.0, 0.0});
    for (int k = 0; k < 5; ++k)
        add_disc(five, five.container_centre + 2.5 * unit_circle(k / 5.0), {0.0, 0.0});
    EXPECT_EQ(share(five).first, 0.0);
    // Pinned: the centre, and a disc at the wall, which does not count.
    std::vector<std::uint8_t> pinned(19, 0);
    pinned[centre_of(MFrameView(triangular_lattice(2)))] = pinned[0] = 1;
    EXPECT_EQ(share(triangular_lattice(2), pinned).second, 1.0);
}

TEST(LocalPacking, IsPiOverRootTwelveForTheTriangularLattice) {
    const Snapshot s = triangular_lattice(2);
    const MFrameView view(s);
    Voronoi cells;
    cells.find(view);
    EXPECT_NEAR(cells.area(centre_of(view)), 2.0 * std::sqrt(3.0), 1e-13);
    LocalPacking packing;
    std::vector<std::uint8_t> only_centre(s.size(), 0);
    only_centre[centre_of(view)] = 1;
    packing.sample(view, cells, only_centre);
    packing.close_block();
    EXPECT_NEAR(packing.pinned().mean, pi / std::sqrt(12.0), 1e-14);
    EXPECT_LT(packing.all().mean, pi / std::sqrt(12.0));
}

TEST(LocalStructure, ResidentValuesAreThoseAtTheTimeOfTheSample) {
    // The outer ring of a lattice is at the wall, and only the first sample has cells. Disc 0
    // begins outside its place, so that its values differ, and leaves before its residence is a
    // long one.
    HexaticOrder order;
    LocalPacking packing;
    LongResidences residences;
    const auto seen = [](double time) {
        Snapshot s = triangular_lattice(1);
        s.container_radius = 3.1;
        s.x[0] += time < 0.5 * long_residence ? -0.05 : 2.0;
        s.clock = time * s.period;
        s.held_at.assign(s.size(), s.clock);
        return s;
    };
    Voronoi cells;
    const MFrameView first(seen(0.0));
    cells.find(first);
    for (int k = 0; k <= 41; ++k) {
        residences.sample(MFrameView(seen(k / 511.0)));
        if (k == 0) order.sample(first, cells);
        if (k == 0) packing.sample(first, cells);
        order.sample_residences(residences);
        packing.sample_residences(residences);
    }
    order.close_block();
    packing.close_block();
    double psi6 = 0.0, phi = 0.0;
    for (std::size_t i = 0; i < first.size(); ++i) {
        if (i == 0 || i == centre_of(first)) continue;
        psi6 += hexatic_order(first, cells, i) / 5.0;
        phi += pi / cells.area(i) / 5.0;
    }
    EXPECT_NEAR(order.resident().mean, psi6, 1e-14);
    EXPECT_NEAR(packing.resident().mean, phi, 1e-14);
    EXPECT_GT(std::abs(packing.all().mean - phi), 1e-3);
}

}  // namespace
}  // namespace swirl
