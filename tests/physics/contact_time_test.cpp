#include "swirl/physics/contact_time.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "random_cases.hpp"
#include "swirl/math/lanes.hpp"
#include "swirl/math/random.hpp"

namespace swirl {
namespace {

// Tolerance of |distance² − σ²| at the computed time. Positions are below 200 (10 + speed 4 × the
// longest wait allowed below), so their squares are below 4·10⁴ with relative errors of 2⁻⁵³. The
// bound allows a dozen roundings.
constexpr double longest_wait = 40.0;
constexpr double rounding_of_squares = 1e-10;

using Flyer = Flight<double>;

Flyer draw_flyer() {
    const Vec2 position = draw_vector(10.0), velocity = draw_vector(3.0);
    return {position, velocity, draw(0.0, 10.0)};
}

double distance2(const Flyer& i, const Flyer& j, double t) {
    const Vec2 s = j.position_at(t) - i.position_at(t);
    return dot(s, s);
}

bool same_bits(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0; }

/// Two discs that do not overlap at the later of their two times.
struct Pair {
    Flyer i, j;
    double sum;
    double from;
};
Pair draw_pair() {
    const Flyer i = draw_flyer(), j = draw_flyer();
    const Pair p{i, j, draw(0.5, 4.0), std::max(i.time, j.time)};
    RC_PRE(distance2(i, j, p.from) > p.sum * p.sum);
    return p;
}

/// The same, but disc j is aimed at a point of disc i, which it may graze.
Pair draw_meeting_pair() {
    Pair p = draw_pair();
    const Vec2 from = p.j.position_at(p.from), s = p.i.position_at(p.from) - from;
    const double distance = std::sqrt(dot(s, s));
    const Vec2 aim = s + draw(-0.999999, 0.999999) * p.sum / distance * perpendicular(s);
    const double speed = draw(0.3, 4.0) / std::sqrt(dot(aim, aim));
    p.j = {from, p.i.velocity + speed * aim, p.from};
    return p;
}

RC_GTEST_PROP(TimeOfContact, NoEarlierContactExists, ()) {
    const Pair p = *rc::gen::element(0, 1) ? draw_pair() : draw_meeting_pair();
    const double found = time_of_contact(p.i, p.j, p.sum);
    const double until = std::min(found, p.from + longest_wait);
    double closest = never;
    for (int k = 0; k <= 2000; ++k)
        closest = std::min(closest, distance2(p.i, p.j, p.from + (until - p.from) * k / 2000));
    RC_ASSERT(closest >= p.sum * p.sum - rounding_of_squares);
}

RC_GTEST_PROP(TimeOfContact, DiscsTouchAndApproach, ()) {
    const Pair p = draw_meeting_pair();
    const double t = time_of_contact(p.i, p.j, p.sum);
    RC_PRE(t < p.from + longest_wait);
    RC_ASSERT(t >= p.from);
    RC_ASSERT(std::abs(distance2(p.i, p.j, t) - p.sum * p.sum) < rounding_of_squares);
    const Vec2 s = p.j.position_at(t) - p.i.position_at(t);
    RC_ASSERT(dot(s, p.j.velocity - p.i.velocity) < rounding_of_squares);
}

RC_GTEST_PROP(TimeOfContact, IsNeverIfTheClosestApproachIsFarther, ()) {
    const Pair p = draw_pair();
    RC_PRE(time_of_contact(p.i, p.j, p.sum) == never);
    const Vec2 s = p.j.position_at(p.from) - p.i.position_at(p.from);
    const Vec2 v = p.j.velocity - p.i.velocity;
    const double closest = p.from + std::max(0.0, -dot(s, v) / dot(v, v));
    RC_ASSERT(distance2(p.i, p.j, closest) >= p.sum * p.sum - rounding_of_squares);
}

RC_GTEST_PROP(TimeOfContact, IsNeverForSeparatingDiscsEvenIfTheyOverlap, ()) {
    Pair p = draw_pair();
    const double overlap = draw(-1.0, 1.0);
    const Vec2 s = p.j.position_at(p.from) - p.i.position_at(p.from);
    RC_PRE(dot(s, p.j.velocity - p.i.velocity) >= 0.0);
    p.sum = std::sqrt(dot(s, s)) * (1.0 + overlap);
    RC_ASSERT(time_of_contact(p.i, p.j, p.sum) == never);
}

RC_GTEST_PROP(TimeOfContact, IsNowForTouchingAndApproachingDiscs, ()) {
    Pair p = draw_pair();
    const Vec2 s = p.j.position_at(p.from) - p.i.position_at(p.from);
    RC_PRE(dot(s, p.j.velocity - p.i.velocity) < 0.0);
    p.sum = std::sqrt(dot(s, s)) * (1.0 + draw(1e-15, 1e-9));
    RC_ASSERT(time_of_contact(p.i, p.j, p.sum) == p.from);
}

RC_GTEST_PROP(TimeOfContact, IsBitwiseSymmetric, ()) {
    const Pair p = draw_pair();
    RC_ASSERT(same_bits(time_of_contact(p.i, p.j, p.sum), time_of_contact(p.j, p.i, p.sum)));
}

RC_GTEST_PROP(TimeOfContact, EightLanesEqualEightScalars, ()) {
    const Flyer i = draw_flyer();
    alignas(64) double x[8], y[8], vx[8], vy[8], held[8], sum[8], found[8];
    for (int k = 0; k < 8; ++k) {
        const Flyer j = draw_flyer();
        x[k] = j.position.x, y[k] = j.position.y, vx[k] = j.velocity.x, vy[k] = j.velocity.y;
        held[k] = j.time, sum[k] = draw(0.5, 4.0);
    }
    using Eight = Lanes<8>;
    const Flight<Eight> mine{{Eight(i.position.x), Eight(i.position.y)},
                             {Eight(i.velocity.x), Eight(i.velocity.y)},
                             Eight(i.time)};
    const Flight<Eight> others{
        {Eight::load(x), Eight::load(y)}, {Eight::load(vx), Eight::load(vy)}, Eight::load(held)};
    time_of_contact(mine, others, Eight::load(sum)).store(found);
    for (int k = 0; k < 8; ++k)
        RC_ASSERT(same_bits(
            found[k], time_of_contact(i, Flyer{{x[k], y[k]}, {vx[k], vy[k]}, held[k]}, sum[k])));
}

TEST(TimeOfContact, IsNeverWithTheSentinel) {
    const double nan = std::nan("");
    EXPECT_EQ(time_of_contact(Flyer{{0, 0}, {1, 0}, 0}, Flyer{{nan, nan}, {0, 0}, 0}, 2.0), never);
}

TEST(TimeOfContact, HeadOnIsGapDividedBySpeed) {
    EXPECT_EQ(time_of_contact(Flyer{{0, 0}, {1, 0}, 0}, Flyer{{10, 0}, {-3, 0}, 0}, 2.0), 2.0);
}

TEST(TimeOfContact, TinyGapKeepsAllDigits) {
    // The gap is 2⁻⁴⁰, the speed 2⁻¹⁰. In the form (−b − √)/a, the rounding error of b would exceed
    // the gap.
    const Flyer i{{0, 0}, {0x1p-10, 0}, 0}, j{{2.0 + 0x1p-40, 0}, {0, 0}, 0};
    EXPECT_NEAR(time_of_contact(i, j, 2.0), 0x1p-30, 0x1p-30 * 1e-11);
}

TEST(TimeOfContact, IsNeverAtRelativeRest) {
    EXPECT_EQ(time_of_contact(Flyer{{0, 0}, {1, 1}, 0}, Flyer{{2, 0}, {1, 1}, 0}, 2.0), never);
}

/// A disc inside the container at the later of their two times.
struct Inside {
    Disc disc;
    double radius;
};
Inside draw_inside(const Segment& segment) {
    Disc d{{}, {}, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0};
    d.time = segment.begin + (segment.end - segment.begin) * draw(0.0, 0.9);
    const double container_radius = draw(3.0, 9.0);
    d.radius = draw(0.3, 1.5);
    const double out = (container_radius - d.radius) * draw(0.0, 0.999);
    d.position = segment.position_at(d.time) + out * unit_circle(draw(0.0, 1.0));
    d.velocity = draw_vector(2.0);
    return {d, container_radius};
}

double wall_distance(const Inside& in, const Segment& segment, double t) {
    const Vec2 s = in.disc.flight().position_at(t) - segment.position_at(t);
    return in.radius - in.disc.radius - std::hypot(s.x, s.y);
}

// Only waits within the segment are tested, since later ones are not used. A wait of up to 2·9/0.01
// would need a wider tolerance.
RC_GTEST_PROP(TimeOfWallContact, OnAStraightSegmentIsTheFirstContact, ()) {
    const ContainerPath path = polygon_path(1.892, 11.866071, *rc::gen::inRange(3, 31));
    const Segment& segment = path.segments[*rc::gen::inRange<std::size_t>(0, path.segments.size())];
    const Inside in = draw_inside(segment);
    const double t = time_of_wall_contact(in.disc, segment, in.radius);
    RC_ASSERT(t >= in.disc.time);
    const double until = std::min(t, segment.end + 20.0);
    for (int k = 0; k <= 1000; ++k)
        RC_ASSERT(wall_distance(in, segment, in.disc.time + (until - in.disc.time) * k / 1000) >
                  -1e-12);
    if (t < segment.end + 20.0) RC_ASSERT(std::abs(wall_distance(in, segment, t)) < 1e-12);
}

RC_GTEST_PROP(TimeOfWallContact, OnAnArcIsTheFirstContact, ()) {
    const ContainerPath path = circular_path(draw(0.1, 3.0), 11.866071);
    const Segment& segment = path.segments[0];
    const Inside in = draw_inside(segment);
    const double t = time_of_wall_contact(in.disc, segment, in.radius);
    RC_ASSERT(t >= in.disc.time);
    const double until = std::min(t, segment.end);
    for (int k = 0; k <= 2000; ++k)
        RC_ASSERT(wall_distance(in, segment, in.disc.time + (until - in.disc.time) * k / 2000) >
                  -1e-12);
    if (t < segment.end) RC_ASSERT(std::abs(wall_distance(in, segment, t)) < 1e-12);
}

// With a limit `latest` the result is bitwise the same, or a lower bound of the contact.
RC_GTEST_PROP(TimeOfWallContact, OnAnArcTheLimitDoesNotChangeTheResult, ()) {
    const ContainerPath path = circular_path(draw(0.1, 30.0), 11.866071);
    const Segment& segment = path.segments[0];
    const Inside in = draw_inside(segment);
    const double clearance = in.radius - in.disc.radius;
    const double t = time_of_wall_contact(in.disc, segment, in.radius);
    const double latest = in.disc.time + draw(0.0, 1.5) * (std::min(t, segment.end) - in.disc.time);
    const WallContact limited = arc_wall_contact(in.disc.flight(), segment.flight_at(in.disc.time),
                                                 segment, clearance, latest);
    if (t <= latest) {
        RC_ASSERT(limited.time == t);
        RC_ASSERT(!limited.is_later);
    }
    if (t > latest) {
        RC_ASSERT(limited.time > latest);
        const bool consistent = limited.is_later ? limited.time <= t : limited.time == t;
        RC_ASSERT(consistent);
    }
}

// The expansion at τ gives the value at τ + δ, up to terms beyond the eighth order.
RC_GTEST_PROP(TimeOfWallContact, OnAnArcTheExpansionIsCorrect, ()) {
    const Segment segment = circular_path(draw(0.1, 3.0), 11.866071).segments[0];
    const Inside in = draw_inside(segment);
    const ArcWall wall(in.disc.flight(), segment.flight_at(in.disc.time), segment.turn_rate,
                       in.radius - in.disc.radius);
    const double tau = draw(0.0, 1.0) / segment.turn_rate, phi = draw(-0.5, 0.5);
    const double x = phi / segment.turn_rate;
    const ArcWall::Expansion f = wall.at(tau);
    const double expected =
        f.c + x * (2.0 * f.b +
                   x * (f.q + x * (f.k + x * (f.l + x * (f.m + x * (f.n + x * (f.o + x * f.p)))))));
    // The bound L assumes |s|² ≤ 2 clearance².
    const ArcWall::Expansion there = wall.at(tau + x);
    RC_PRE(larger(f.c, there.c) < wall.square());
    const double tolerance = 3.1e-5 * wall.K() * std::pow(std::abs(phi), 7.0) * x * x;
    RC_ASSERT(std::abs(there.c - expected) <=
              tolerance + 1e-13 * (wall.square() + wall.K() * x * x));
}

// Newton's method returns a contact only if it is certainly the first. This is so in about two of
// five cases for random discs, and nearly always for discs in the paper's container.
TEST(TimeOfWallContact, OnAnArcNewtonAgreesWithParabolas) {
    Random random(5);
    const auto draw_in = [&random](double from, double to) {
        return from + (to - from) * random.uniform();
    };
    const Segment segment = circular_path(1.892, 11.866071).segments[0];
    const double clearance = 7.6, eighth = (0.25 * pi) / segment.turn_rate;
    int quick = 0;
    constexpr int cases = 20000;
    for (int k = 0; k < cases; ++k) {
        Disc d{{}, {}, 0.0, 0.0, draw_in(0.0, 6.0), 1.0, 1.0, 1.0, {}, 0.0};
        d.position = segment.position_at(d.time) +
                     draw_in(0.7, 0.999) * clearance * unit_circle(random.uniform());
        d.velocity =
            segment.velocity_at(d.time) + draw_in(0.0, 1.0) * unit_circle(random.uniform());
        const ArcWall wall(d.flight(), segment.flight_at(d.time), segment.turn_rate, clearance);
        const double wait = arc_contact_by_newton(wall, wall.at_start());
        if (wait == never) continue;
        ++quick;
        const double t = arc_contact_by_parabolas(wall, d.time, eighth, never, never).time;
        // If the disc grazes the wall, its distance is well defined, but the time is not.
        const Inside in{d, clearance + d.radius};
        EXPECT_LT(std::abs(wall_distance(in, segment, 0.5 * (d.time + wait + t))), 1e-12) << k;
        EXPECT_NEAR(d.time + wait, t, 1e-5) << k;
    }
    EXPECT_GT(quick, cases / 4);
}

// A disc that overlaps the wall slightly and leaves it counts as just inside. Newton's method then
// finds the time when it overlaps as much again.
TEST(TimeOfWallContact, OnAnArcNewtonKeepsASmallOverlap) {
    const Segment segment = circular_path(1.892, 11.866071).segments[0];
    constexpr double clearance = 7.6, overlap = 1e-8;
    int quick = 0;
    for (int k = 0; k < 64; ++k) {
        const Vec2 out = unit_circle(k / 64.0);
        const Flyer disc{segment.start + (clearance + overlap) * out,
                         segment.velocity - 0.3 * out + 0.5 * perpendicular(out), 0.0};
        const ArcWall wall(disc, segment.flight_at(0.0), segment.turn_rate, clearance);
        const ArcWall::Expansion start = wall.at_start();
        const double wait = arc_contact_by_newton(wall, start);
        if (wait == never) continue;
        ++quick;
        // A dozen roundings of squares of order 60; the overlap itself is 1.5·10⁻⁷.
        EXPECT_NEAR(wall.at(wait).c, start.c, 1e-12) << k;
    }
    EXPECT_GT(quick, 10);
}

// Short flights along the wall, during which the centre mainly accelerates. Each lasts as long as a
// parabola, except for the rotation of the acceleration.
TEST(TimeOfWallContact, OnAnArcShortFlightsKeepTheirDigits) {
    const double amplitude = 2.0, period = 12.0, omega = 2.0 * pi / period;
    const Segment segment = circular_path(amplitude, period).segments[0];
    const double push = amplitude * omega * omega;
    for (double speed = 1e-2; speed > 1e-9; speed *= 0.1) {
        // At the outermost point of the wall, leaving it radially.
        Disc d{segment.start, segment.velocity, 0, 0, 0, 1.0, 1.0, 10.0};
        d.position.x += 7.6;
        d.velocity.x -= speed;
        const double hop = time_of_wall_contact(d, segment, 8.6);
        EXPECT_NEAR(hop, 2.0 * speed / push, 1e-3 * hop * (speed / 1e-2) + 6e-8) << speed;
    }
}

/// The time when the disc touches a wall of radius `container_radius` on any segment of the
/// polygon.
double contact_on_polygon(const Disc& disc, const ContainerPath& path, double container_radius) {
    for (const Segment& segment : path.segments) {
        if (segment.end <= disc.time) continue;
        const double t = time_of_wall_contact(disc, segment, container_radius);
        if (t < segment.end) return t;
    }
    return never;
}

RC_GTEST_PROP(TimeOfWallContact, CircleIsTheLimitOfPolygons, ()) {
    static const int sides = 10000;
    static const ContainerPath circle = circular_path(1.892, 11.866071);
    static const ContainerPath polygon = polygon_path(1.892, 11.866071, sides);
    const Inside in = draw_inside(circle.segments[0]);
    // The distance between both centres is at most the sagitta. So the contact lies between those
    // with a polygon's wall that is nearer and farther by the sagitta.
    const double sagitta = 1.0001 * 1.892 * (pi / sides) * (pi / sides) / 2.0;
    RC_PRE(wall_distance(in, circle.segments[0], in.disc.time) > 2.0 * sagitta);
    const double t = time_of_wall_contact(in.disc, circle.segments[0], in.radius);
    RC_ASSERT(contact_on_polygon(in.disc, polygon, in.radius - sagitta) <= t);
    const double later = contact_on_polygon(in.disc, polygon, in.radius + sagitta);
    RC_ASSERT(later >= t);
}

TEST(TimeOfWallContact, AtRestIsChordDividedBySpeed) {
    const Segment segment = still_path(100.0).segments[0];
    const Disc d{{-7.6, 0}, {0.5, 0}, 0, 0, 0, 1.0, 1.0, 10.0};
    EXPECT_NEAR(time_of_wall_contact(d, segment, 8.6), 15.2 / 0.5, 1e-13);
}

TEST(TimeOfWallContact, IsNowAtTheWallAndApproaching) {
    const Segment still = still_path(100.0).segments[0];
    const Segment turning = circular_path(1.0, 10.0).segments[0];
    Disc d{{7.6, 0}, {0.5, 0.1}, 0, 0, 0, 1.0, 1.0, 10.0};
    EXPECT_EQ(time_of_wall_contact(d, still, 8.6), 0.0);
    d.position.x += 1.0;
    EXPECT_EQ(time_of_wall_contact(d, turning, 8.6), 0.0);
}

TEST(TimeOfWallContact, IsNeverForADiscThatMovesWithTheContainer) {
    const ContainerPath path = polygon_path(1.892, 11.866071, 30);
    const Segment& segment = path.segments[0];
    const Disc d{segment.start, segment.velocity, 0, 0, 0, 1.0, 1.0, 10.0};
    EXPECT_EQ(time_of_wall_contact(d, segment, 8.6), never);
}

TEST(TimeOfWallContact, IsLaterForADiscThatSlidesAlongTheWall) {
    // b = 0 exactly at the wall: it must not collide endlessly at one instant.
    const Segment segment = still_path(100.0).segments[0];
    const Disc d{{7.6, 0}, {0, 1}, 0, 0, 0, 1.0, 1.0, 10.0};
    const double t = time_of_wall_contact(d, segment, 8.6);
    EXPECT_GT(t, 0.0);
    EXPECT_LT(t, 1e-6);  // 2⁻²⁶ clearance/speed: within the rounding error of the wall
}

struct SlidingPair {
    Parabola<double> i, j;
    double i_rolls, j_rolls, sum;
    Encounter<double> encounter() const { return {i, j, i_rolls, j_rolls, sum}; }
    double distance2(double t) const {
        const Vec2 s = j.position_at(t) - i.position_at(t);
        return dot(s, s);
    }
};
SlidingPair draw_sliding_pair() {
    const Flyer a = draw_flyer();
    const Vec2 from = draw_vector(4.0);
    const Parabola<double> i{a.position, a.velocity, draw_vector(2.0), a.time};
    const Parabola<double> j{a.position + from, draw_vector(3.0), draw_vector(2.0),
                             a.time + draw(0.0, 0.3)};
    const SlidingPair p{i, j, j.time + draw(0.01, 2.0), j.time + draw(0.01, 2.0), draw(0.3, 2.0)};
    RC_PRE(p.distance2(j.time) > p.sum * p.sum);
    return p;
}

RC_GTEST_PROP(TimeOfContactOnParabolas, IsTheFirstContact, ()) {
    const SlidingPair p = draw_sliding_pair();
    const double found = time_of_contact(p.encounter());
    const double from = p.j.time, until = std::min(p.i_rolls, p.j_rolls);
    const double end = std::min(found, until);
    for (int k = 0; k < 1000; ++k)
        RC_ASSERT(p.distance2(from + (end - from) * k / 1000.0) >
                  p.sum * p.sum - rounding_of_squares);
    if (found == never) return;
    RC_ASSERT(found <= until + 1e-15);
    RC_ASSERT(std::abs(p.distance2(found) - p.sum * p.sum) < rounding_of_squares);
}

// Eight pairs at once give the results of eight single pairs, and the bound misses no contact.
RC_GTEST_PROP(TimeOfContactOnParabolas, EightLanesEqualEightScalars, ()) {
    const Parabola<double> i = draw_sliding_pair().i;
    alignas(64) double x[8], y[8], vx[8], vy[8], ax[8], ay[8], time[8], rolls[8], sum[8],
        together[8];
    Parabola<double> j[8];
    for (int k = 0; k < 8; ++k) {
        const SlidingPair p = draw_sliding_pair();
        j[k] = p.j;
        if (k % 3 == 0) j[k].acceleration = i.acceleration;
        x[k] = p.j.position.x, y[k] = p.j.position.y;
        vx[k] = p.j.velocity.x, vy[k] = p.j.velocity.y;
        ax[k] = j[k].acceleration.x, ay[k] = j[k].acceleration.y;
        time[k] = p.j.time, rolls[k] = std::max(p.j_rolls, i.time), sum[k] = p.sum;
    }
    using Eight = Lanes<8>;
    const auto all = [](double number) { return Eight(number); };
    const double i_rolls = i.time + 20.0;
    const Encounter<Eight> eight({{all(i.position.x), all(i.position.y)},
                                  {all(i.velocity.x), all(i.velocity.y)},
                                  {all(i.acceleration.x), all(i.acceleration.y)},
                                  all(i.time)},
                                 {{Eight::load(x), Eight::load(y)},
                                  {Eight::load(vx), Eight::load(vy)},
                                  {Eight::load(ax), Eight::load(ay)},
                                  Eight::load(time)},
                                 all(i_rolls), Eight::load(rolls), Eight::load(sum));
    eight.wait_or_quartic().store(together);
    for (int k = 0; k < 8; ++k) {
        const Encounter<double> one(i, j[k], i_rolls, rolls[k], sum[k]);
        RC_ASSERT(same_bits(one.wait_or_quartic(), together[k]));
        if (together[k] == never && k % 3 != 0)
            RC_ASSERT(contact_on_parabolas(one.s, one.v, one.g, one.sum_of_radii, one.horizon) ==
                      never);
    }
}

RC_GTEST_PROP(TimeOfContactOnParabolas, WithoutRelativeAccelerationEqualsThatOfDiscs, ()) {
    const Pair p = draw_meeting_pair();
    const Parabola<double> i{p.i.position, p.i.velocity, {0.0, 0.0}, p.i.time};
    const Parabola<double> j{p.j.position, p.j.velocity, {0.0, 0.0}, p.j.time};
    RC_ASSERT(same_bits(time_of_contact(Encounter<double>(i, j, never, never, p.sum)),
                        time_of_contact(p.i, p.j, p.sum)));
}

RC_GTEST_PROP(TimeOfWallContactOnParabolas, IsTheFirstContact, ()) {
    const Segment segment{0.0, 1000.0, draw_vector(1.0), draw_vector(1.0), 0.0};
    const double clearance = 7.6;
    const Vec2 inside = draw_vector(5.0);
    const Parabola<double> sphere{segment.position_at(1.5) + inside, draw_vector(3.0),
                                  draw_vector(2.0), 1.5};
    const double rolls = 1.5 + draw(0.01, 3.0);
    const double found = time_of_wall_contact(sphere, rolls, segment, clearance);
    const auto from_centre = [&](double t) {
        const Vec2 s = sphere.position_at(t) - segment.position_at(t);
        return dot(s, s);
    };
    const double end = std::min(found, rolls);
    for (int k = 0; k < 1000; ++k)
        RC_ASSERT(from_centre(1.5 + (end - 1.5) * k / 1000.0) <
                  clearance * clearance + rounding_of_squares);
    if (found == never) return;
    RC_ASSERT(found <= rolls + 1e-15);
    RC_ASSERT(std::abs(from_centre(found) - clearance * clearance) < rounding_of_squares);
}

}  // namespace
}  // namespace swirl
