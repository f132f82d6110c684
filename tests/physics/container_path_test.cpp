#include "swirl/physics/container_path.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace swirl {
namespace {

// Positions of order 1 after a few roundings.
constexpr double path_rounding = 1e-14;

double length(const Vec2& v) { return std::hypot(v.x, v.y); }

TEST(ContainerPath, PaperContainerMovesAtSpeedOne) {
    const ContainerPath path = polygon_path(paper_amplitude, paper_period, paper_sides);
    ASSERT_EQ(path.segments.size(), 30u);
    // The SI's numbers are given to seven digits (T) and four (A): A = 1.892 gives 0.99999.
    for (const Segment& segment : path.segments) EXPECT_NEAR(length(segment.velocity), 1.0, 5e-4);
}

TEST(ContainerPath, SegmentsAreContiguousAndClosed) {
    for (const int sides : {3, 4, 30, 301}) {
        const ContainerPath path = polygon_path(1.892, 11.866071, sides);
        ASSERT_EQ(path.segments.size(), static_cast<std::size_t>(sides));
        EXPECT_EQ(path.segments.front().begin, 0.0);
        EXPECT_EQ(path.segments.back().end, path.period);
        for (std::size_t k = 0; k < path.segments.size(); ++k) {
            const Segment& segment = path.segments[k];
            const Segment& next = path.segments[(k + 1) % path.segments.size()];
            EXPECT_EQ(segment.end, k + 1 < path.segments.size() ? next.begin : path.period);
            EXPECT_LT(length(segment.position_at(segment.end) - next.start), path_rounding)
                << "side " << k;
        }
    }
}

TEST(ContainerPath, VerticesLieOnTheCircleCounterClockwiseFromPlusX) {
    const ContainerPath path = polygon_path(2.0, 10.0, 7);
    EXPECT_EQ(path.segments[0].start.x, 2.0);
    EXPECT_EQ(path.segments[0].start.y, 0.0);
    for (const Segment& segment : path.segments) {
        EXPECT_NEAR(length(segment.start), 2.0, path_rounding);
        EXPECT_GT(cross(segment.start, segment.velocity), 0.0);
    }
}

TEST(ContainerPath, SidesHaveTheirAnalyticSpeed) {
    for (const int sides : {3, 30, 300}) {
        const double speed = 2.0 * 1.5 * sides * std::sin(pi / sides) / 8.0;
        for (const Segment& segment : polygon_path(1.5, 8.0, sides).segments)
            EXPECT_NEAR(length(segment.velocity), speed,
                        1e-13 * sides);  // difference of two vertices
    }
}

TEST(ContainerPath, ExactCircleIsOneArc) {
    const ContainerPath path = circular_path(1.892, 11.866071);
    ASSERT_EQ(path.segments.size(), 1u);
    const Segment& segment = path.segments[0];
    EXPECT_EQ(segment.turn_rate, path.omega());
    for (int k = 0; k <= 100; ++k) {
        const double t = path.period * k / 100;
        const Vec2 C = segment.position_at(t), V = segment.velocity_at(t);
        EXPECT_NEAR(C.x, 1.892 * std::cos(path.omega() * t), path_rounding);
        EXPECT_NEAR(C.y, 1.892 * std::sin(path.omega() * t), path_rounding);
        const Vec2 expected = path.omega() * perpendicular(C);
        EXPECT_LT(length(V - expected), path_rounding);
    }
}

TEST(ContainerPath, PolygonsConvergeToTheCircle) {
    const ContainerPath circle = circular_path(1.892, 11.866071);
    const ContainerPath polygon = polygon_path(1.892, 11.866071, 3000);
    // The largest distance of a chord from its arc is the sagitta A (π/M)²/2.
    const double sagitta = 1.892 * (pi / 3000) * (pi / 3000) / 2.0;
    double farthest = 0.0;
    for (int k = 0; k < 10000; ++k) {
        const double t = circle.period * (k + 0.5) / 10000;
        farthest = std::max(farthest, length(circle.segments[0].position_at(t) -
                                             polygon.segment_at(t).position_at(t)));
    }
    EXPECT_LT(farthest, 1.001 * sagitta);
    EXPECT_GT(farthest, 0.9 * sagitta);
}

TEST(ContainerPath, SegmentAtAssignsAnEndToTheNextSegment) {
    const ContainerPath path = polygon_path(1.0, 6.0, 3);
    EXPECT_EQ(&path.segment_at(0.0), &path.segments[0]);
    EXPECT_EQ(&path.segment_at(path.segments[0].end), &path.segments[1]);
    EXPECT_EQ(&path.segment_at(5.999), &path.segments[2]);
    EXPECT_EQ(&path.segment_at(6.0), &path.segments[2]);
}

TEST(ContainerPath, ZeroAmplitudeIsAContainerAtRest) {
    for (const ContainerPath& path : {polygon_path(0.0, 7.0, 30), circular_path(0.0, 7.0)}) {
        ASSERT_EQ(path.segments.size(), 1u);
        EXPECT_EQ(length(path.segments[0].velocity), 0.0);
        EXPECT_EQ(length(path.segments[0].position_at(3.3)), 0.0);
        EXPECT_EQ(path.period, 7.0);
    }
}

}  // namespace
}  // namespace swirl
