#include "swirl/math/lanes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <vector>

#include "random_cases.hpp"

// These tests use the width of the compiler's default target. The engine's tests compare all widths
// bitwise.
namespace swirl {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

template <int W>
struct Numbers {
    alignas(64) double value[W];
    Lanes<W> lanes() const { return Lanes<W>::load(value); }
};

template <int W>
Numbers<W> stored(const Lanes<W>& lanes) {
    Numbers<W> n;
    lanes.store(n.value);
    return n;
}

template <int W>
Numbers<W> draw_numbers() {
    Numbers<W> n;
    for (double& x : n.value) {
        const int kind = *rc::gen::inRange(0, 12);
        x = kind == 0 ? infinity : kind == 1 ? 0.0 : draw(-3.0, 3.0);
    }
    return n;
}

bool same_bits(double a, double b) {
    return std::memcmp(&a, &b, sizeof a) == 0 || (std::isnan(a) && std::isnan(b));
}

template <int W>
void expect_each_lane_is_the_scalar() {
    const Numbers<W> a = draw_numbers<W>(), b = draw_numbers<W>();
    const Lanes<W> A = a.lanes(), B = b.lanes();
    const Numbers<W> sum = stored(A + B), difference = stored(A - B), product = stored(A * B),
                     quotient = stored(A / B), negative = stored(-A), root = stored(square_root(A)),
                     minimum = stored(smaller(A, B)), maximum = stored(larger(A, B)),
                     chosen = stored(select((A < B) & (A >= Lanes<W>(0.0)), A, B)),
                     equal = stored(select(A == B, A, Lanes<W>(-1.0)));
    for (int k = 0; k < W; ++k) {
        const double x = a.value[k], y = b.value[k];
        RC_ASSERT(same_bits(sum.value[k], x + y));
        RC_ASSERT(same_bits(difference.value[k], x - y));
        RC_ASSERT(same_bits(product.value[k], x * y));
        RC_ASSERT(same_bits(quotient.value[k], x / y));
        RC_ASSERT(same_bits(negative.value[k], -x));
        RC_ASSERT(same_bits(root.value[k], square_root(x)));
        RC_ASSERT(same_bits(minimum.value[k], smaller(x, y)));
        RC_ASSERT(same_bits(maximum.value[k], larger(x, y)));
        RC_ASSERT(same_bits(chosen.value[k], x < y && x >= 0.0 ? x : y));
        RC_ASSERT(same_bits(equal.value[k], x == y ? x : -1.0));
    }
}

RC_GTEST_PROP(Lanes, EachLaneEqualsTheScalar, ()) {
    expect_each_lane_is_the_scalar<2>();
    expect_each_lane_is_the_scalar<4>();
    expect_each_lane_is_the_scalar<8>();
}

RC_GTEST_PROP(Lanes, FindsTheSmallestLane, ()) {
    const Numbers<8> a = draw_numbers<8>();
    double minimum = infinity;
    for (const double x : a.value) minimum = x < minimum ? x : minimum;
    RC_ASSERT(smallest(a.lanes()) == minimum);
    unsigned where = 0;
    for (unsigned k = 0; k < 8; ++k) where |= a.value[k] == minimum ? 1u << k : 0u;
    RC_ASSERT(lanes_equal(a.lanes(), minimum) == where);
}

RC_GTEST_PROP(Lanes, ReplacesOneLaneOnly, ()) {
    const Numbers<8> a = draw_numbers<8>();
    const auto k = *rc::gen::inRange(0u, 8u);
    const Numbers<8> changed = stored(with_lane(a.lanes(), k, 7.25));
    for (unsigned l = 0; l < 8; ++l)
        RC_ASSERT(same_bits(changed.value[l], l == k ? 7.25 : a.value[l]));
}

template <int W>
void expect_pairs_become_columns() {
    alignas(16) double pairs[W][2];
    const double* rows[W];
    for (int k = 0; k < W; ++k) {
        pairs[k][0] = k + 1.0;
        pairs[k][1] = -k - 0.5;
        rows[k] = pairs[k];
    }
    Lanes<W> first, second;
    load_pairs<W>(rows, first, second);
    for (int k = 0; k < W; ++k) {
        EXPECT_EQ(stored(first).value[k], k + 1.0);
        EXPECT_EQ(stored(second).value[k], -k - 0.5);
    }
}

TEST(Lanes, LoadsPairsAsColumns) {
    expect_pairs_become_columns<4>();
    expect_pairs_become_columns<8>();
}

TEST(Lanes, LoadsFoursAsColumns) {
    alignas(64) double fours[8][4];
    const double* rows[8];
    for (int k = 0; k < 8; ++k) {
        for (int column = 0; column < 4; ++column) fours[k][column] = 10.0 * column + k;
        rows[k] = fours[k];
    }
    Lanes<8> columns[4];
    load_fours<8>(rows, columns);
    for (int column = 0; column < 4; ++column)
        for (int k = 0; k < 8; ++k) EXPECT_EQ(stored(columns[column]).value[k], 10.0 * column + k);
}

// The fourth number of each row may be any bits.
TEST(Lanes, LoadsThreeOfFourFloatsAsColumns) {
    alignas(16) float fours[8][4];
    const float* rows[8];
    for (int k = 0; k < 8; ++k) {
        const auto number = static_cast<float>(k);
        const float four[] = {number + 1.0f, -number - 0.5f, 0x1p-30f * number, __builtin_nanf("")};
        std::copy(four, four + 4, fours[k]);
        rows[k] = fours[k];
    }
    Lanes<8> first, second, third;
    load_three(rows, first, second, third);
    for (int k = 0; k < 8; ++k) {
        EXPECT_EQ(stored(first).value[k], k + 1.0);
        EXPECT_EQ(stored(second).value[k], -k - 0.5);
        EXPECT_EQ(stored(third).value[k], 0x1p-30 * k);
    }
}

// Long lists are searched in pieces of 64.
TEST(Lanes, FindsADiscAnywhereInAList) {
    for (const std::uint32_t capacity : {4u, 12u, 64u, 68u, 124u}) {
        std::vector<std::uint32_t> list(capacity);
        for (std::uint32_t slot = 0; slot < capacity; ++slot) list[slot] = 1000 + slot;
        for (std::uint32_t slot = 0; slot < capacity; ++slot)
            EXPECT_EQ(index_in_list(list.data(), capacity, 1000 + slot), slot) << "of " << capacity;
    }
}

TEST(Lanes, TwoLanesKeepTheirOrder) {
    const Numbers<2> n = stored(two_lanes(1.5, -2.5));
    EXPECT_EQ(n.value[0], 1.5);
    EXPECT_EQ(n.value[1], -2.5);
}

}  // namespace
}  // namespace swirl
