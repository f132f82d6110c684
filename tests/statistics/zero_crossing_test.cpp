#include "swirl/statistics/zero_crossing.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "measure/snapshots.hpp"
#include "swirl/statistics/replicates.hpp"

namespace swirl {
namespace {

constexpr double z = 1.959963984540054;

std::vector<RotationPoint> line(double zero, double slope, double error, int from = 24,
                                int to = 48) {
    std::vector<RotationPoint> points;
    for (int n = from; n <= to; ++n) points.push_back({double(n), slope * (n - zero), error});
    return points;
}

double gauss(Noise& noise) {  // twelve uniform numbers: variance 12/3/4 = 1
    double sum = 0.0;
    for (int k = 0; k < 12; ++k) sum += 0.5 * noise();
    return sum;
}

TEST(Crossing, IsTheZeroBetweenTwoNeighbours) {
    const Crossing c = find_crossing(line(36.4, -0.01, 0.001));
    EXPECT_EQ(c.verdict, Crossing::Verdict::crosses);
    EXPECT_NEAR(c.discs, 36.4, 1e-12);
    ASSERT_EQ(c.changes.size(), 1u);
    EXPECT_EQ(c.changes[0].before, 36.0);
    EXPECT_EQ(c.changes[0].after, 37.0);
    EXPECT_TRUE(c.undetermined.empty());
    // Fieller by hand, m = (0.004, −0.006), e = 0.001 both: (0.4 − f)² 10⁻⁴ = z² 10⁻⁶ (1 − 2f +
    // 2f²).
    const double w = z * z * 0.01, A = 1.0 - 2.0 * w, B = -0.4 + w, C = 0.16 - w;
    const double root = std::sqrt(B * B - A * C);
    EXPECT_NEAR(c.lower, 36.0 + (-B - root) / A, 1e-12);
    EXPECT_NEAR(c.upper, 36.0 + (-B + root) / A, 1e-12);
    EXPECT_NEAR(c.error, 0.5 * (c.upper - c.lower) / z, 1e-15);
    // Linear propagation of both errors; Fieller's interval is wider by about w, 4 %.
    EXPECT_NEAR(c.error, 0.1 * std::hypot(0.6, 0.4), 0.05 * c.error);
}

// A straight line through three points on each side would be biased by the curvature. Its zero and
// interval would depend on the range of the table: 47.85 and 47.6 to 48.0 for one range, 47.46 for
// another.
TEST(Crossing, DoesNotDependOnTheRangeOfTheTable) {
    // A curve that bends like that of μ = 0.3.
    std::vector<RotationPoint> points{
        {44, 0.0254, 0.0003},  {45, 0.0186, 0.0003},  {46, 0.0113, 0.0003},  {47, 0.0037, 0.0002},
        {48, -0.0034, 0.0005}, {49, -0.0081, 0.0004}, {50, -0.0130, 0.0004}, {51, -0.0170, 0.0005}};
    const Crossing whole = find_crossing(points);
    EXPECT_NEAR(whole.discs, 47.0 + 0.0037 / 0.0071, 1e-12);
    for (const int last : {48, 49, 50}) {
        for (const int first : {44, 46, 47}) {
            std::vector<RotationPoint> some;
            for (const RotationPoint& p : points)
                if (p.discs >= first && p.discs <= last) some.push_back(p);
            const Crossing c = find_crossing(some);
            EXPECT_EQ(c.discs, whole.discs) << first << " to " << last;
            EXPECT_EQ(c.lower, whole.lower);
            EXPECT_EQ(c.upper, whole.upper);
        }
    }
}

TEST(Crossing, IntervalContainsTheZeroAndLiesInTheBracket) {
    Noise noise(7);
    for (int k = 0; k < 20000; ++k) {
        // Certain signs at both ends, none to three undetermined points between.
        std::vector<RotationPoint> points{{30.0, 0.0, 0.001 + 0.01 * std::fabs(noise())}};
        points[0].mean = points[0].error * (3.001 + 10.0 * std::fabs(noise()));
        const int between = k % 4;
        for (int n = 1; n <= between; ++n) {
            const double error = 0.001 + 0.01 * std::fabs(noise());
            points.push_back({30.0 + n, 2.999 * error * noise(), error});
        }
        const double error = 0.001 + 0.01 * std::fabs(noise());
        points.push_back({31.0 + between, -error * (3.001 + 10.0 * std::fabs(noise())), error});
        const Crossing c = find_crossing(points);
        ASSERT_EQ(c.verdict, Crossing::Verdict::crosses);
        ASSERT_EQ(c.undetermined.size(), std::size_t(between));
        ASSERT_GE(c.lower, 30.0);
        ASSERT_LE(c.upper, 31.0 + between);
        ASSERT_LE(c.lower, c.discs);
        ASSERT_GE(c.upper, c.discs);
        ASSERT_GT(c.error, 0.0);
        for (std::size_t i = 0; i + 1 < points.size(); ++i) {
            const double a = points[i].mean, b = points[i + 1].mean;
            if (a * b > 0.0) continue;
            ASSERT_LE(c.lower, points[i].discs + a / (a - b) + 1e-9);
            ASSERT_GE(c.upper, points[i].discs + a / (a - b) - 1e-9);
        }
        // Just outside, the polyline is incompatible with zero.
        const double x = c.lower - 1e-6;
        const auto i = std::size_t(std::floor(x) - 30.0);
        const double f = x - std::floor(x);
        const double g = (1 - f) * points[i].mean + f * points[i + 1].mean;
        const double sigma = std::hypot((1 - f) * points[i].error, f * points[i + 1].error);
        ASSERT_GT(std::fabs(g), z * sigma);
    }
}

/// Share of the tables, with this error at every point, whose 95 % interval contains the zero.
double coverage(double zero, double bend, double error, int seeds = 0) {
    constexpr int tables = 4000;
    // The curve bends, but N is a whole number. Its zero is therefore that of the straight line
    // between neighbouring N.
    const auto curve = [&](double n) {
        return -0.01 * (n - 36.4 - zero) + bend * (n - 36.4) * (n - 36.4);
    };
    double truth = not_available;
    for (int n = 30; n < 44; ++n)
        if (curve(n) > 0.0 && curve(n + 1) <= 0.0) truth = n + curve(n) / (curve(n) - curve(n + 1));
    Noise noise(11);
    int covered = 0, found = 0;
    for (int k = 0; k < tables; ++k) {
        std::vector<RotationPoint> points;
        for (int n = 30; n <= 44; ++n) {
            if (seeds == 0) {
                points.push_back({double(n), curve(n) + error * gauss(noise), error});
                continue;
            }
            // The error follows from the scatter of `seeds` runs, by Student's t.
            std::vector<Estimate> runs;
            for (int s = 0; s < seeds; ++s)
                runs.push_back(
                    {.mean = curve(n) + error * std::sqrt(double(seeds)) * gauss(noise)});
            const Estimate e = ensemble(runs).estimate;
            points.push_back({double(n), e.mean, e.error});
        }
        const Crossing c = find_crossing(points);
        if (!c.last()) continue;
        ++found;
        covered += c.lower <= truth && truth <= c.upper;
    }
    EXPECT_GT(found, 0.95 * tables);
    return covered / double(found);
}

// 4000 tables: the standard deviation of a share of 0.95 is 0.0034. If an interval has gaps, its
// hull is wider and contains the true value more often. A wrong sign at three errors lowers it. The
// share is 0.94 to 0.985 in all cases.
TEST(Crossing, IntervalHasNominalCoverage) {
    for (const double zero : {-0.4, -0.2, 0.0, 0.3})
        for (const double bend : {0.0, 0.0004, -0.0004})
            for (const double error : {0.0003, 0.001, 0.003}) {
                const double share = coverage(zero, bend, error);
                EXPECT_GT(share, 0.94) << zero << " " << bend << " " << error;
                EXPECT_LT(share, 0.985) << zero << " " << bend << " " << error;
            }
}

// Errors from three runs are uncertain by themselves; their factor of Student makes the interval of
// each point exact, and that of two points wider than it need be.
TEST(Crossing, CoverageHoldsForErrorsFromThreeRuns) {
    for (const double zero : {-0.2, 0.0, 0.3}) {
        EXPECT_GT(coverage(zero, 0.0004, 0.0003, 3), 0.94) << zero;
        EXPECT_GT(coverage(zero, 0.0004, 0.0003, 8), 0.94) << zero;
    }
}

// Not 44 ± 2.3, the middle of 40 and 48.
TEST(Crossing, CoarseTableGivesABracket) {
    const std::vector<RotationPoint> coarse{
        {24, 0.05, 0.001}, {36, 0.01, 0.001}, {40, -0.01, 0.001}, {48, -0.04, 0.001}};
    const Crossing c = find_crossing(coarse);
    EXPECT_EQ(c.verdict, Crossing::Verdict::crosses);
    EXPECT_TRUE(std::isnan(c.discs));
    EXPECT_TRUE(std::isnan(c.error));
    EXPECT_EQ(c.lower, 36.0);
    EXPECT_EQ(c.upper, 40.0);
    EXPECT_FALSE(c.last()->resolved());
    // So is one with a gap next to an undetermined point.
    const std::vector<RotationPoint> gap{{37, 0.01, 0.001}, {38, 0.0, 0.001}, {40, -0.01, 0.001}};
    EXPECT_FALSE(find_crossing(gap).last()->resolved());
}

TEST(Crossing, IsNotClaimedWithoutEvidenceOnBothSides) {
    EXPECT_EQ(find_crossing(line(60.0, -0.01, 0.001)).verdict, Crossing::Verdict::always_rotates);
    EXPECT_EQ(find_crossing(line(10.0, -0.01, 0.001)).verdict,
              Crossing::Verdict::always_counterrotates);
    EXPECT_EQ(find_crossing(line(36.0, -0.01, 10.0)).verdict, Crossing::Verdict::undecided);
    // The opposite change: from counterrotation to rotation.
    const Crossing back = find_crossing(line(36.0, 0.01, 0.001));
    EXPECT_EQ(back.verdict, Crossing::Verdict::undecided);
    ASSERT_EQ(back.changes.size(), 1u);
    EXPECT_FALSE(back.changes[0].to_counterrotation);
    EXPECT_TRUE(std::isnan(find_crossing(line(60.0, -0.01, 0.001)).discs));
}

TEST(Crossing, ACurveHasOneSignOnlyIfEveryPointCertainlyHas) {
    std::vector<RotationPoint> points = line(60.0, -0.01, 0.001);
    points.back() = {48.0, 0.0029, 0.001};  // 2.9 errors
    EXPECT_EQ(find_crossing(points).verdict, Crossing::Verdict::undecided);
    EXPECT_EQ(find_crossing(points).undetermined, std::vector<double>{48.0});
    points.back().mean = -0.0029;
    EXPECT_EQ(find_crossing(points).verdict, Crossing::Verdict::undecided);
    points.back().mean = 0.0031;
    EXPECT_EQ(find_crossing(points).verdict, Crossing::Verdict::always_rotates);
    points.back().mean = -0.0031;
    EXPECT_EQ(find_crossing(points).verdict, Crossing::Verdict::crosses);
}

TEST(Crossing, UndeterminedPointsInTheBracketCount) {
    const std::vector<RotationPoint> points{
        {35, 0.010, 0.001}, {36, 0.001, 0.001}, {37, -0.001, 0.001}, {38, -0.010, 0.001}};
    const Crossing c = find_crossing(points);
    ASSERT_EQ(c.changes.size(), 1u);
    EXPECT_EQ(c.changes[0].between, (std::vector<double>{36, 37}));
    EXPECT_NEAR(c.discs, 36.5, 1e-12);
    // Both are compatible with zero, so the interval reaches beyond both, and is symmetric.
    EXPECT_LT(c.lower, 36.0);
    EXPECT_GT(c.upper, 37.0);
    EXPECT_NEAR(c.lower + c.upper, 73.0, 1e-9);
    // Three zeros: the middle one.
    const std::vector<RotationPoint> thrice{
        {35, 0.010, 0.001}, {36, -0.001, 0.001}, {37, 0.001, 0.001}, {38, -0.010, 0.001}};
    EXPECT_NEAR(find_crossing(thrice).discs, 36.5, 1e-12);
}

TEST(Crossing, ExactPointsHaveAnExactZero) {
    const std::vector<RotationPoint> exact{{30, 0.3, 0.0}, {31, -0.1, 0.0}};
    const Crossing c = find_crossing(exact);
    EXPECT_NEAR(c.discs, 30.75, 1e-12);
    EXPECT_NEAR(c.lower, 30.75, 1e-7);
    EXPECT_NEAR(c.upper, 30.75, 1e-7);
}

TEST(Crossing, DistantFluctuationDoesNotMoveIt) {
    std::vector<RotationPoint> points = line(36.0, -0.01, 0.002);
    points[12].mean = 0.001;
    const Crossing before = find_crossing(points);
    points[1].mean = -0.001;  // N = 25, half an error below zero
    const Crossing c = find_crossing(points);
    EXPECT_EQ(c.discs, before.discs);
    EXPECT_EQ(c.undetermined, (std::vector<double>{25, 36}));
    EXPECT_TRUE(c.undetermined_after().empty());
}

TEST(Crossing, InvalidPointsAreOmitted) {
    EXPECT_EQ(find_crossing({}).verdict, Crossing::Verdict::undecided);
    std::vector<RotationPoint> points = line(36.4, -0.01, 0.001);
    points.push_back({30.0, not_available, 0.1});
    points.push_back({30.0, 5.0, not_available});
    points.push_back({30.0, 5.0, -1.0});
    std::swap(points[3], points[20]);
    EXPECT_NEAR(find_crossing(points).discs, 36.4, 1e-9);
    EXPECT_EQ(find_crossing(points).points, 25u);
    const std::vector<RotationPoint> one{{30.0, 0.1, 0.01}};
    EXPECT_EQ(find_crossing(one).verdict, Crossing::Verdict::undecided);
}

// A curve that returns: 1, 2, 3 changes.
TEST(SignChanges, AllOfThemAreFoundInOrderAndTheLastIsNc) {
    const std::vector<RotationPoint> points{
        {21, 0.06, 0.002}, {22, -0.02, 0.002}, {28, -0.03, 0.002}, {29, 0.05, 0.002},
        {30, 0.04, 0.002}, {31, 0.001, 0.002}, {32, -0.04, 0.002}, {48, -0.05, 0.002}};
    const Crossing c = find_crossing(points);
    ASSERT_EQ(c.changes.size(), 3u);
    EXPECT_TRUE(c.changes[0].to_counterrotation);
    EXPECT_FALSE(c.changes[1].to_counterrotation);
    EXPECT_TRUE(c.changes[2].to_counterrotation);
    EXPECT_NEAR(c.changes[0].discs, 21.75, 1e-9);
    EXPECT_NEAR(c.changes[1].discs, 28.375, 1e-9);
    // The undetermined one between 30 and 32 counts.
    EXPECT_EQ(c.changes[2].before, 30.0);
    EXPECT_EQ(c.changes[2].after, 32.0);
    EXPECT_NEAR(c.changes[2].discs, 31.0 + 0.001 / 0.041, 1e-9);
    EXPECT_EQ(c.last(), &c.changes[2]);
    EXPECT_EQ(c.discs, c.changes[2].discs);
}

// A hump of one or two errors above zero is not a change, but it must be listed.
TEST(SignChanges, AnUndeterminedHumpBeyondNcIsListed) {
    std::vector<RotationPoint> points{{19, 0.02, 0.002},  {20, -0.02, 0.002}, {26, -0.03, 0.002},
                                      {28, 0.004, 0.002}, {30, 0.002, 0.002}, {32, -0.03, 0.002}};
    const Crossing c = find_crossing(points);
    EXPECT_NEAR(c.discs, 19.5, 1e-9);
    EXPECT_EQ(c.undetermined_after(), (std::vector<double>{28, 30}));
    points[3].mean = 0.007;  // more runs made the sign certain
    const Crossing more = find_crossing(points);
    EXPECT_EQ(more.changes.size(), 3u);
    EXPECT_EQ(more.last()->before, 28.0);
    EXPECT_EQ(more.last()->after, 32.0);
    EXPECT_TRUE(more.undetermined_after().empty());
}

TEST(SignChanges, UncertainChangesDoNotCount) {
    EXPECT_TRUE(find_crossing(
                    std::vector<RotationPoint>{{20, 0.1, 0.01}, {30, -0.02, 0.01}, {40, 0.1, 0.01}})
                    .changes.empty());
}

}  // namespace
}  // namespace swirl
