#include "swirl/measure/crossing.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "measure/snapshots.hpp"

namespace swirl {
namespace {

std::vector<RotationPoint> line(double zero, double slope, double error, int from = 24,
                                int to = 48) {
    std::vector<RotationPoint> points;
    for (int n = from; n <= to; ++n) points.push_back({double(n), slope * (n - zero), error});
    return points;
}

TEST(Crossing, OfAStraightLineIsItsZero) {
    const Crossing c = find_crossing(line(36.4, -0.01, 0.001));
    EXPECT_EQ(c.verdict, Crossing::Verdict::crosses);
    EXPECT_NEAR(c.discs, 36.4, 1e-12);
    EXPECT_NEAR(c.slope, -0.01, 1e-15);
    EXPECT_EQ(c.points_used, 6);
    // Six equal points 34…39, N̄ = 36.5: σ_a² = e²/6, σ_b² = e²/17.5.
    const double sigma = 0.1 * std::sqrt(1.0 / 6.0 + 0.01 / 17.5);
    EXPECT_NEAR(c.error, sigma, 1e-12);
    // Fieller's interval is a little wider than ±1.96 σ.
    EXPECT_NEAR(c.upper - c.lower, 2.0 * 1.96 * sigma, 0.01 * sigma);
    EXPECT_LT(c.lower, 36.4);
    EXPECT_GT(c.upper, 36.4);
}

TEST(Crossing, CoversTheTruthAsOftenAsItSays) {
    int covered = 0, found = 0;
    for (std::uint64_t seed = 1; seed <= 500; ++seed) {
        Noise noise(seed);
        std::vector<RotationPoint> points = line(35.7, -0.01, 0.01);
        for (RotationPoint& p : points) {
            double gauss = 0.0;  // twelve uniform numbers: variance 12/3/4 = 1
            for (int k = 0; k < 12; ++k) gauss += 0.5 * noise();
            p.mean += p.error * gauss;
        }
        const Crossing c = find_crossing(points);
        if (c.verdict != Crossing::Verdict::crosses) continue;
        ++found;
        covered += c.lower < 35.7 && 35.7 < c.upper ? 1 : 0;
    }
    EXPECT_GT(found, 450);
    // 95 % less a little, because the cut itself was found in the noise.
    EXPECT_GT(covered, 0.85 * found);
}

TEST(Crossing, IsNotClaimedWithoutEvidenceOnBothSides) {
    EXPECT_EQ(find_crossing(line(60.0, -0.01, 0.001)).verdict, Crossing::Verdict::always_rotates);
    EXPECT_EQ(find_crossing(line(10.0, -0.01, 0.001)).verdict,
              Crossing::Verdict::always_counterrotates);
    EXPECT_EQ(find_crossing(line(36.0, -0.01, 10.0)).verdict, Crossing::Verdict::undecided);
    // The wrong way round: counterrotation first.
    EXPECT_NE(find_crossing(line(36.0, 0.01, 0.001)).verdict, Crossing::Verdict::crosses);
    const Crossing c = find_crossing(line(60.0, -0.01, 0.001));
    EXPECT_TRUE(std::isnan(c.discs));
    EXPECT_NEAR(c.most_positive, 360.0, 1e-9);
}

TEST(Crossing, ACurveHasOneSignOnlyIfEveryPointCertainlyHas) {
    std::vector<RotationPoint> points = line(60.0, -0.01, 0.001);
    points.back() = {48.0, 0.0029, 0.001};  // 2.9 errors
    EXPECT_EQ(find_crossing(points).verdict, Crossing::Verdict::undecided);
    points.back().mean = -0.0029;
    EXPECT_EQ(find_crossing(points).verdict, Crossing::Verdict::undecided);
    points.back().mean = 0.0031;
    EXPECT_EQ(find_crossing(points).verdict, Crossing::Verdict::always_rotates);
    points.back().mean = -0.0031;
    EXPECT_EQ(find_crossing(points).verdict, Crossing::Verdict::crosses);
}

TEST(Crossing, IsBetweenTheNeighboursWhoseSignsAreCertain) {
    // Between 30 and 40 nothing is known: the line has hardly a slope, and its interval no end.
    const std::vector<RotationPoint> vague{
        {30.0, 0.1, 0.03}, {33.0, -0.2, 0.2}, {36.0, 0.2, 0.2}, {40.0, -0.1, 0.03}};
    const Crossing c = find_crossing(vague);
    EXPECT_EQ(c.verdict, Crossing::Verdict::crosses);
    EXPECT_GE(c.lower, 30.0);
    EXPECT_LE(c.upper, 40.0);
    EXPECT_LE(c.error, 10.0 / std::sqrt(12.0));
    // The line through a step is zero beyond it: it is no line, and the step is known.
    const std::vector<RotationPoint> step{{10.0, 1.0, 0.001},   {12.0, 1.0, 0.001},
                                          {14.0, 1.0, 0.001},   {16.0, -0.01, 0.003},
                                          {30.0, -0.02, 0.001}, {40.0, -0.03, 0.001}};
    const Crossing s = find_crossing(step);
    EXPECT_EQ(s.verdict, Crossing::Verdict::crosses);
    EXPECT_EQ(s.discs, 15.0);
    EXPECT_EQ(s.lower, 14.0);
    EXPECT_EQ(s.upper, 16.0);
    EXPECT_NEAR(s.error, 2.0 / std::sqrt(12.0), 1e-15);
}

TEST(Crossing, AFluctuationFarAwayDoesNotMoveIt) {
    std::vector<RotationPoint> points = line(36.0, -0.01, 0.002);
    points[1].mean = -0.001;  // N = 25, half an error below zero
    const Crossing c = find_crossing(points);
    EXPECT_EQ(c.verdict, Crossing::Verdict::crosses);
    EXPECT_NEAR(c.discs, 36.0, 1e-9);
}

TEST(Crossing, ScatterBeyondTheErrorsWidensTheInterval) {
    std::vector<RotationPoint> points = line(36.2, -0.01, 0.0005);
    for (std::size_t k = 0; k < points.size(); ++k) points[k].mean += k % 2 == 0 ? 0.004 : -0.004;
    EXPECT_GT(find_crossing(points).error, 4.0 * find_crossing(line(36.2, -0.01, 0.0005)).error);
}

TEST(Crossing, NonsenseIsLeftOut) {
    EXPECT_EQ(find_crossing({}).verdict, Crossing::Verdict::undecided);
    std::vector<RotationPoint> points = line(36.0, -0.01, 0.001);
    points.push_back({30.0, not_known, 0.1});
    points.push_back({30.0, 5.0, not_known});
    points.push_back({30.0, 5.0, -1.0});
    std::swap(points[3], points[20]);
    EXPECT_NEAR(find_crossing(points).discs, 36.0, 1e-9);
    const std::vector<RotationPoint> one{{30.0, 0.1, 0.01}};
    EXPECT_EQ(find_crossing(one).verdict, Crossing::Verdict::undecided);
    const std::vector<RotationPoint> two{{30.0, 0.1, 0.01}, {40.0, -0.1, 0.01}};
    EXPECT_NEAR(find_crossing(two).discs, 35.0, 1e-12);
}

// Of a curve that comes back.
TEST(SignChanges, AllOfThemAreFoundInOrder) {
    const std::vector<RotationPoint> points{
        {16, 0.06, 0.002},  {24, -0.02, 0.002}, {28, 0.03, 0.002},  {30, 0.05, 0.002},
        {34, 0.001, 0.002}, {36, -0.04, 0.002}, {40, -0.02, 0.002}, {48, -0.05, 0.002}};
    const auto changes = find_sign_changes(points);
    ASSERT_EQ(changes.size(), 3u);
    EXPECT_TRUE(changes[0].to_counterrotation);
    EXPECT_FALSE(changes[1].to_counterrotation);
    EXPECT_TRUE(changes[2].to_counterrotation);
    // Between two points, the zero of the chord, 16 + 8 · 6/8, and its error: that of the weights,
    // √((¼ σ)² + (¾ σ)²) / slope, the slope being 0.08/8.
    EXPECT_NEAR(changes[0].discs, 22.0, 1e-9);
    EXPECT_NEAR(changes[0].error, 0.002 * std::hypot(0.25, 0.75) / 0.01, 1e-9);
    EXPECT_NEAR(changes[1].discs, 25.6, 1e-9);
    // The uncertain one between 30 and 36 takes part in the line.
    EXPECT_EQ(changes[2].before, 30.0);
    EXPECT_EQ(changes[2].after, 36.0);
    EXPECT_GT(changes[2].discs, 32.5);
    EXPECT_LT(changes[2].discs, 34.5);
}

TEST(SignChanges, WhatIsNotCertainIsNone) {
    EXPECT_TRUE(find_sign_changes(
                    std::vector<RotationPoint>{{20, 0.1, 0.01}, {30, -0.02, 0.01}, {40, 0.1, 0.01}})
                    .empty());
    EXPECT_TRUE(find_sign_changes(std::vector<RotationPoint>{}).empty());
}

}  // namespace
}  // namespace swirl
