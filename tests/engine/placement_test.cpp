#include "swirl/engine/placement.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/scenes.hpp"
#include "swirl/math/real.hpp"
#include "swirl/math/unit_circle.hpp"

namespace swirl {
namespace {

// Discs that touch may overlap by the rounding of their positions, which is 10⁻¹⁶ R.
constexpr double rounding = 1e-12;

/// The deepest overlap of a pair or of a disc with the wall; negative if there is none. Discs are
/// sorted into cells as wide as the largest disc, which is fast enough for a million.
double deepest_overlap(const std::vector<Vec2>& centres, const std::vector<double>& radii,
                       double container_radius) {
    const double width = 2.0 * *std::max_element(radii.begin(), radii.end());
    const auto side = static_cast<std::size_t>(2.0 * container_radius / width) + 3;
    const auto row = [&](double x) {
        return static_cast<std::size_t>((x + container_radius) / width) + 1;
    };
    std::vector<std::vector<std::uint32_t>> cells(side * side);
    double deepest = -container_radius;
    for (std::uint32_t i = 0; i < centres.size(); ++i) {
        const Vec2& p = centres[i];
        const double beyond = std::hypot(p.x, p.y) + radii[i] - container_radius;
        if (beyond > rounding) return beyond;
        deepest = std::max(deepest, beyond);
        for (std::size_t y = row(p.y) - 1; y <= row(p.y) + 1; ++y)
            for (std::size_t x = row(p.x) - 1; x <= row(p.x) + 1; ++x)
                for (const std::uint32_t j : cells[y * side + x])
                    deepest =
                        std::max(deepest, radii[i] + radii[j] -
                                              std::hypot(p.x - centres[j].x, p.y - centres[j].y));
        cells[row(p.y) * side + row(p.x)].push_back(i);
    }
    return deepest;
}

void expect_placed(const std::vector<double>& radii, double container_radius, std::uint64_t seed) {
    const auto centres = place_discs(radii, container_radius, seed);
    ASSERT_TRUE(centres) << radii.size() << " discs, seed " << seed;
    ASSERT_EQ(centres->size(), radii.size());
    EXPECT_LT(deepest_overlap(*centres, radii, container_radius), rounding)
        << radii.size() << " discs, seed " << seed;
}

TEST(Placement, PaperContainerHoldsUpTo55Discs) {
    for (std::size_t n = 1; n <= 55; ++n)
        for (std::uint64_t seed = 0; seed < 20; ++seed)
            expect_placed(std::vector<double>(n, 1.0), 8.6, seed);
}

TEST(Placement, PaperContainerHoldsMoreThanTheLattice) {
    for (std::size_t n = 56; n <= 58; ++n)
        for (std::uint64_t seed = 0; seed < 3; ++seed)
            expect_placed(std::vector<double>(n, 1.0), 8.6, seed);
    expect_placed(std::vector<double>(7, 1.0), 3.0001, 1);  // seven discs need R = 3
}

TEST(Placement, Slow_PaperContainerHolds59DiscsButNot61) {
    for (std::uint64_t seed = 0; seed < 5; ++seed)
        expect_placed(std::vector<double>(59, 1.0), 8.6, seed);
    // The smallest circle known around 61 unit circles has radius 8.6613 (the curved hexagonal
    // packing, Lubachevsky and Graham 1997).
    EXPECT_FALSE(place_discs(std::vector<double>(61, 1.0), 8.6, 1));
}

TEST(Placement, OneDiscOfAnySizeIsPlaced) {
    for (const double radius : {1.0, 2.0, 6.0, 8.0, 8.599, 8.6}) expect_placed({radius}, 8.6, 1);
}

TEST(Placement, FewDiscsInAVeryLargeContainerArePlaced) {
    expect_placed(std::vector<double>(48, 1.0), 1e3, 1);
    const auto centres = place_discs(std::vector<double>(48, 1e-6), 1e6, 1);
    ASSERT_TRUE(centres);
    EXPECT_EQ(centres->size(), 48u);
}

TEST(Placement, OlersBoundIsNotBelowKnownPackings) {
    // Seven in R = 3 r, nineteen in (1 + √2 + √6) r, 61 in 8.6613 r (Graham, Lubachevsky et al.
    // 1998, doi:10.1016/S0012-365X(97)00050-2).
    EXPECT_GE(max_discs_in_container(1.0, 3.0), 7.0);
    EXPECT_GE(max_discs_in_container(1.0, 4.8637), 19.0);
    EXPECT_GE(max_discs_in_container(1.0, 8.6613), 61.0);
    EXPECT_EQ(max_discs_in_container(1.0, 1.0), 1.0);
}

TEST(Placement, DensestKnownArrangements) {
    const auto known = discs_in_densest_known_arrangement;
    // Nineteen in (1 + √2 + √6) r. Eighteen need the same container.
    EXPECT_EQ(known(1.0, 1.0 + std::sqrt(2.0) + std::sqrt(6.0)), 19);
    EXPECT_EQ(known(0.5, 4.83 / 2.0), 17);
    EXPECT_EQ(known(1.0, 8.6), 59);
    EXPECT_EQ(known(1.0, 8.6613), 61);
    EXPECT_EQ(known(1.0, 3.0), std::nullopt);
    EXPECT_EQ(known(1.0, 9.1), std::nullopt);
    // All of these numbers can be placed in a container wider by 0.45 %.
    for (double R = 3.9; R < 9.05; R += sanitized ? 0.8 : 0.1) {
        const auto n = known(1.0, R / 1.0045);
        if (n) expect_placed(std::vector<double>(static_cast<std::size_t>(*n), 1.0), R, 1);
    }
}

TEST(Placement, Slow_NoArrangementDenserThanTheKnownOnesIsFound) {
    // The known arrangement has one disc fewer than the call requests.
    for (const double R : {4.6, 6.1, 8.6}) {
        const auto n = discs_in_densest_known_arrangement(1.0, R);
        ASSERT_TRUE(n);
        EXPECT_FALSE(place_discs(std::vector<double>(static_cast<std::size_t>(*n) + 1, 1.0), R, 1));
    }
}

TEST(Placement, LargeContainersHoldTheSamePackingFraction) {
    for (const double radius : {17.2, 86.0, 300.0}) {
        const auto n = static_cast<std::size_t>(48.0 / (8.6 * 8.6) * radius * radius);
        expect_placed(std::vector<double>(n, 1.0), radius, 7);
    }
}

TEST(Placement, MixturesArePlaced) {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        std::vector<double> radii;
        for (int i = 0; i < 40; ++i) radii.push_back(i % 3 == 0 ? 1.0 : i % 3 == 1 ? 0.6 : 1.4);
        expect_placed(radii, 10.0, seed);
    }
    std::vector<double> many;
    for (int i = 0; i < 5000; ++i) many.push_back(i % 2 == 0 ? 1.0 : 0.5);
    expect_placed(many, std::sqrt(2500.0 * 1.25 / 0.65), 1);
}

TEST(Placement, SmallDiscsFillTheGapsBetweenLargeOnes) {
    for (std::uint64_t seed = 0; seed < (sanitized ? 1u : 3u); ++seed) {
        // The small discs cover six tenths of the area that the two large ones leave.
        std::vector<double> radii(2, 1.0);
        radii.resize(2 + 6000, 0.01);
        expect_placed(radii, 1.42 * std::sqrt(2.0 + 0.6 / 0.6), seed);
        // Three very different sizes, in mixed order.
        std::vector<double> three;
        for (int i = 0; i < 3000; ++i) three.push_back(i % 300 == 0 ? 1.0 : i % 10 ? 0.002 : 0.04);
        expect_placed(three, 4.2, seed);
    }
}

TEST(Placement, EndsWhenTheCallerStopsIt) {
    for (const std::size_t discs : {std::size_t{60}, std::size_t{1000000}}) {
        int polls = 0;
        const auto is_stopped = [&] { return ++polls >= 3; };
        const double R = discs == 60 ? 8.6 : std::sqrt(1e6 / 0.7);
        EXPECT_FALSE(place_discs(std::vector<double>(discs, 1.0), R, 1, is_stopped));
        EXPECT_EQ(polls, 3);
    }
}

// So that the caller can stop at any time: choosing sites and displacing discs poll once per disc.
TEST(Placement, PollsOftenWithManyDiscs) {
    long polls = 0;
    const auto is_stopped = [&] { return ++polls < 0; };
    constexpr std::size_t discs = sanitized ? 200000 : 1000000;
    ASSERT_TRUE(
        place_discs(std::vector<double>(discs, 1.0), std::sqrt(discs / 0.7), 1, is_stopped));
    EXPECT_GT(polls, static_cast<long>(discs));
}

TEST(Placement, AMillionDiscsAtPackingFraction070ArePlaced) {
    const std::vector<double> radii(1000000, 1.0);
    const auto centres = place_discs(radii, std::sqrt(1e6 / 0.70), 1);
    ASSERT_TRUE(centres);
    EXPECT_LT(deepest_overlap(*centres, radii, std::sqrt(1e6 / 0.70)), rounding);
}

/// The fraction of the discs begin to end − 1, in a container of radius R, that have one of the
/// next eight discs nearby: within two sides of a square that holds one such disc on average.
double neighbours_of_near_number(const std::vector<Vec2>& centres, std::size_t begin,
                                 std::size_t end, double R) {
    const auto discs = static_cast<double>(end - begin);
    const double nearby = 2.0 * std::sqrt(3.14159 * R * R / discs);
    double found = 0.0;
    for (std::size_t i = begin; i < end; ++i)
        for (std::size_t k = i + 1; k < std::min(i + 9, end); ++k) {
            if (std::hypot(centres[i].x - centres[k].x, centres[i].y - centres[k].y) > nearby)
                continue;
            found += 1.0;
            break;
        }
    return found / discs;
}

// The curve leads from a square to an adjacent one in three of four cases. With random numbering,
// one of the next eight discs would rarely be within the area of 13 squares, of several thousand.
TEST(Placement, DiscsInALargeContainerAreNumberedByPosition) {
    std::vector<double> radii(20000, 1.0);
    radii.resize(30000, 0.5);
    const double R = std::sqrt((20000 + 10000 * 0.25) / 0.6);
    const auto centres = place_discs(radii, R, 1);
    ASSERT_TRUE(centres);
    EXPECT_LT(deepest_overlap(*centres, radii, R), rounding);
    EXPECT_GT(neighbours_of_near_number(*centres, 0, 20000, R), 0.9);
    EXPECT_GT(neighbours_of_near_number(*centres, 20000, 30000, R), 0.9);
    // A small number of discs is not renumbered.
    const double r = std::sqrt(4000 / 0.6);
    const auto few = place_discs(std::vector<double>(4000, 1.0), r, 1);
    ASSERT_TRUE(few);
    EXPECT_LT(neighbours_of_near_number(*few, 0, 4000, r), 0.1);
}

TEST(Placement, SeedDeterminesPositions) {
    const std::vector<double> radii(48, 1.0);
    const auto a = place_discs(radii, 8.6, 1), b = place_discs(radii, 8.6, 1),
               c = place_discs(radii, 8.6, 2);
    ASSERT_TRUE(a && b && c);
    for (std::size_t i = 0; i < 48; ++i) {
        EXPECT_EQ((*a)[i].x, (*b)[i].x);
        EXPECT_EQ((*a)[i].y, (*b)[i].y);
    }
    EXPECT_NE((*a)[0].x, (*c)[0].x);
}

/// The radius of the smallest container for up to nine unit discs (Pirl 1969): a ring, from seven
/// on with one disc in its middle.
double smallest_container(std::size_t n) {
    const double on_ring = n < 7 ? double(n) : double(n) - 1.0;
    return 1.0 + 1.0 / std::sin(pi / on_ring);
}

TEST(Placement, FewDiscsArePlacedInTheSmallestContainer) {
    for (std::size_t n = 2; n <= 9; ++n)
        for (const double slack : {1e-6, 1e-7, 1e-9, 1e-12})
            for (std::uint64_t seed = 0; seed < 5; ++seed)
                expect_placed(std::vector<double>(n, 1.0), smallest_container(n) + slack, seed);
    expect_placed({1.0, 1.0}, 2.0, 1);
    for (const double second : {0.1, 0.5, 3.0, 40.0}) expect_placed({1.0, second}, 1.0 + second, 1);
}

// Otherwise each of these would use the whole budget of the relaxation, 10⁸ steps.
TEST(Placement, FewDiscsInATooSmallContainerAreRejectedWithoutASearch) {
    long polls = 0;
    const auto count = [&] { return ++polls < 0; };
    for (std::size_t n = 3; n <= 9; ++n)
        EXPECT_FALSE(
            place_discs(std::vector<double>(n, 1.0), smallest_container(n) - 1e-9, 1, count));
    // The lattice polls once per row; a relaxation would poll in each of its steps.
    EXPECT_LT(polls, 20'000);
}

TEST(Placement, DiscsThatCannotFitAreRejected) {
    // Oler's bound for the paper's container is 65.
    EXPECT_FALSE(place_discs(std::vector<double>(66, 1.0), 8.6, 1));
    EXPECT_FALSE(place_discs({1.0}, 0.9, 1));
    EXPECT_FALSE(place_discs({1.0, 1.0}, 1.9, 1));
    EXPECT_FALSE(place_discs(std::vector<double>(1000, 1.0), 8.6, 1));
}

TEST(Placement, NoDiscsArePlaced) {
    const auto none = place_discs({}, 8.6, 1);
    ASSERT_TRUE(none);
    EXPECT_TRUE(none->empty());
}

}  // namespace
}  // namespace swirl
