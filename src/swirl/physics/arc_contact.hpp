// When a disc reaches the wall while the container moves along an arc, that is, with constant speed
// and constant turn rate. The equation is not a polynomial, so it is solved by iteration. The
// result depends on the disc's stored state and on the arc only, as everything in contact_time.hpp.
//
// Let the centre of the container have velocity V, and seen from it let the disc be at s with
// velocity u. The velocity V turns by φ = Ω τ in a time τ. With W = V^⊥ the disc is then at
//
//     s + d,   d = u τ + ((φ − sin φ) V − (1 − cos φ) W)/Ω.
//
// The contact is at the root of f(τ) = |s|² − clearance² + (2s + d)·d, which is negative inside.
// The terms added to f(0) vanish with d. So a short flight along the wall keeps its digits, however
// fast the container is.
//
// Near any time f is c + 2b δ + q δ² + k δ³ + l δ⁴ + m δ⁵ + n δ⁶ + o δ⁷ + p δ⁸ and so on. Let g and
// j be acceleration and jerk of the disc as seen from the centre. With j' = −Ω² g, the derivatives
// of f/2 are
//
//     s·u,  u² + s·g,  3 u·g + s·j,  3 g² + 4 u·j − Ω² s·g,  −Ω² (5 u·g + s·j),
//     −Ω² (5 g² + 6 u·j − Ω² s·g),  Ω⁴ (7 u·g + s·j),  Ω⁴ (7 g² + 8 u·j − Ω² s·g).
//
// The fast way: a first estimate of the root, then Newton's method with all eight terms, then a
// proof that no earlier root exists (arc_contact_by_newton). If that fails, the slow way approaches
// the first root by parabolas that never pass it (arc_contact_by_parabolas).
#pragma once

#include "swirl/math/real.hpp"
#include "swirl/math/unit_circle.hpp"
#include "swirl/physics/container_path.hpp"
#include "swirl/physics/disc.hpp"

namespace swirl {

/// The function f above, for a disc and the container's centre at the time `centre.time`.
class ArcWall {
  public:
    /// The coefficients of f at one time.
    struct Expansion {
        double c, b, q, k, l, m, n, o, p;
    };

    SWIRL_INLINE ArcWall(const Flight<double>& disc, const Flight<double>& centre, double turn_rate,
                         double clearance)
        : s_(disc.position_at(centre.time) - centre.position),
          u_(disc.velocity - centre.velocity),
          V_(centre.velocity),
          turn_rate_(turn_rate),
          inverse_turn_rate_(1.0 / turn_rate),
          square_(clearance * clearance),
          outside_(dot(s_, s_) - square_),
          V2_(dot(V_, V_)),
          v2_(dot(disc.velocity, disc.velocity)) {}

    SWIRL_INLINE double square() const { return square_; }
    SWIRL_INLINE double turn_rate() const { return turn_rate_; }
    /// Bound of the fourth order: without the terms after k δ³ the error of f is at most L δ⁴. Here
    /// f⁗/24 = (3 g² + 4 u·j − Ω² s·g)/12 with |g| = Ω|V| and |j| = Ω²|V|. With v the disc's own
    /// velocity, |u| ≤ |v| + |V|. And |s| ≤ √2 clearance: inside, and as far outside as a contact
    /// could have been overlooked. Twice a product is at most the sum of squares.
    SWIRL_INLINE double L() const {
        const double O2 = turn_rate_ * turn_rate_;
        return O2 * (1.0 / 12.0) * (2.0 * v2_ + 10.0 * V2_ + 0.5 * O2 * square_);
    }
    /// Bound of the second order: |f″/2| = |u² + s·g| ≤ K, in the same way.
    SWIRL_INLINE double K() const {
        return 2.0 * v2_ + 2.5 * V2_ + turn_rate_ * turn_rate_ * square_;
    }
    SWIRL_INLINE Expansion at_start() const { return expand({0.0, 0.0}, u_, V_); }
    SWIRL_INLINE Expansion at(double tau) const {
        const Turn turn = turn_by(turn_rate_ * tau);
        const Vec2 W = perpendicular(V_);
        const Vec2 d = tau * u_ + inverse_turn_rate_ * (turn.lag * V_ - turn.versine * W);
        const Vec2 turned = turn.sine * W - turn.versine * V_;
        return expand(d, u_ - turned, V_ + turned);
    }
    /// How far inside: −f. For a disc that is not approaching, the result is at least
    /// 2⁻⁵² clearance², as in time_to_leave.
    SWIRL_INLINE double gap(const Expansion& f) const {
        return larger(-f.c, f.b > 0.0 ? 0.0 : 0x1p-52 * square_);
    }
    /// M of the steepest parabola: for δ ≤ h, f is at most c + 2b δ + M δ².
    SWIRL_INLINE double steepest(const Expansion& f, double h) const {
        return f.q + h * (larger(f.k, 0.0) + h * L());
    }
    /// A bound of how far f is below that parabola at δ ≤ h.
    SWIRL_INLINE double below_steepest(const Expansion& f, double M, double delta) const {
        return ((M - f.q) - delta * (f.k - L() * delta)) * (delta * delta);
    }

  private:
    /// The disc has moved by d and has velocity u seen from the centre, whose velocity is V.
    SWIRL_INLINE Expansion expand(const Vec2& d, const Vec2& u, const Vec2& V) const {
        const double O2 = turn_rate_ * turn_rate_, O4 = O2 * O2;
        const Vec2 s = s_ + d, g = -turn_rate_ * perpendicular(V);
        const double ug = dot(u, g), sj = O2 * dot(s, V);
        const double sg = dot(s, g), uj = O2 * dot(u, V);
        const double g2 = O2 * V2_, Osg = O2 * sg;
        return {outside_ + dot(s_ + s, d),
                dot(s, u),
                dot(u, u) + sg,
                (1.0 / 3.0) * (3.0 * ug + sj),
                (1.0 / 12.0) * (3.0 * g2 + (4.0 * uj - Osg)),
                -O2 * (1.0 / 60.0) * (5.0 * ug + sj),
                -O2 * (1.0 / 360.0) * (5.0 * g2 + (6.0 * uj - Osg)),
                O4 * (1.0 / 2520.0) * (7.0 * ug + sj),
                O4 * (1.0 / 20160.0) * (7.0 * g2 + (8.0 * uj - Osg))};
    }

    Vec2 s_, u_, V_;
    double turn_rate_, inverse_turn_rate_;
    double square_, outside_, V2_, v2_;
};

/// When a disc reaches the wall. If that is later than requested, `time` is only a lower bound.
struct WallContact {
    double time;
    bool is_later;
};

/// True if the disc stays inside from the start until τ = h, where it is at the wall and f rises
/// with slope `slope`. Let x = τ/h. The cubic with f's values and slopes at both ends is
///
///     (1 − x) (f(0) (1 − x) (1 + 2x) + f'(0) h x (1 − x) − f'(h) h x²),
///
/// and f differs from it by at most L h⁴ x² (1 − x)². Let A = −3 f(0) − f'(0) h, B = f'(h) h and
/// C = L h⁴. Then f is negative all the way if neither A nor B is negative and
/// A (1 − x) + B x > C x (1 − x), that is, √A + √B > √C.
SWIRL_INLINE bool is_first_contact(const ArcWall& wall, const ArcWall::Expansion& start, double gap,
                                   double h, double slope) {
    const double A = 3.0 * gap - 2.0 * start.b * h, B = slope * h;
    const double C = wall.L() * ((h * h) * (h * h)), more = C - (A + B);
    return h > 0.0 && A >= 0.0 && B > 0.0 && (more < 0.0 || 4.0 * A * B > more * more);
}

/// Up to this angle in radians, eight terms give all digits.
inline constexpr double short_turn = 0.0625;

/// A first estimate of the contact from the terms at the start: the root of the parabola, then a
/// step of Halley's method with all terms up to the sixth. Returns 0 if the parabola has no root.
SWIRL_INLINE double estimate_arc_contact(const ArcWall::Expansion& f, double gap) {
    const bool approaching = f.b > 0.0;
    const double discriminant = f.b * f.b + f.q * gap;
    if (!(discriminant > 0.0 && (approaching || f.q > 0.0))) return 0.0;
    const double root = square_root(discriminant);
    const double p = (approaching ? gap : root - f.b) / (approaching ? f.b + root : f.q);
    const double p2 = p * p, p3 = p2 * p;
    const double P =
        ((2.0 * f.b * p - gap) + p2 * f.q) + p3 * ((f.k + f.l * p) + p2 * (f.m + f.n * p));
    const double P1 = (2.0 * f.b + 2.0 * f.q * p) +
                      p2 * ((3.0 * f.k + 4.0 * f.l * p) + p2 * (5.0 * f.m + 6.0 * f.n * p));
    const double P2 =
        (f.q + 3.0 * f.k * p) + p2 * ((6.0 * f.l + 10.0 * f.m * p) + p2 * (15.0 * f.n));
    return p - P * P1 / (P1 * P1 - P * P2);
}

/// Estimate of the root near the time of the expansion `f`, if the value of f there counts as c.
/// With y = −c/2b it is y (1 − e + 2e² − g − 5e³ + 5eg − i …).
SWIRL_INLINE double root_nearby(const ArcWall::Expansion& f, double c) {
    const double r = 0.5 / f.b, y = -c * r, y2 = y * y;
    const double e = r * f.q * y, g = r * f.k * y2, i = r * f.l * (y2 * y), e2 = e * e;
    return y * ((1.0 - e) + ((2.0 * e2 - g) + (5.0 * e * (g - e2) - i)));
}

/// A step of Newton's method from δ = x, with all terms up to the eighth. `error` bounds the value
/// of f afterwards: K times the square of the step, plus the omitted terms. As f⁽⁹⁾/2 = −Ω⁶ (9 u·g
/// + s·j) is at most 5.6 K Ω⁷ (ArcWall::K), these are 3·10⁻⁵ K (Ωδ)⁷ δ².
struct NewtonStep {
    double delta, slope, error;

    SWIRL_INLINE NewtonStep(const ArcWall& wall, const ArcWall::Expansion& f, double c, double x) {
        const double x2 = x * x, x4 = x2 * x2;
        const double P =
            (c + 2.0 * f.b * x) +
            x2 * ((f.q + f.k * x) + (x2 * (f.l + f.m * x) + x4 * ((f.n + f.o * x) + x2 * f.p)));
        slope = (2.0 * f.b + 2.0 * f.q * x) +
                x2 * ((3.0 * f.k + 4.0 * f.l * x) +
                      (x2 * (5.0 * f.m + 6.0 * f.n * x) + x4 * (7.0 * f.o + 8.0 * f.p * x)));
        const double step = P / slope;
        delta = x - step;
        const double phi = wall.turn_rate() * delta, phi2 = phi * phi;
        const double omitted = 3.1e-5 * magnitude(phi) * (phi2 * phi2 * phi2) * (delta * delta);
        error = wall.K() * (step * step + omitted);
    }
};

/// The time until the contact; or `never`, if this method cannot find it. The terms at the start
/// give an estimate. If it is near they also give the contact; otherwise the terms there do.
SWIRL_INLINE double arc_contact_by_newton(const ArcWall& wall, const ArcWall::Expansion& start) {
    const double gap = wall.gap(start), tolerance = 0x1p-52 * wall.square();
    double tau = estimate_arc_contact(start, gap);
    if (!(tau > 0.0)) return never;
    if (magnitude(wall.turn_rate()) * tau < short_turn) {
        const NewtonStep step(wall, start, -gap, tau);
        if (step.error <= tolerance && is_first_contact(wall, start, gap, step.delta, step.slope))
            return step.delta;
    }
    constexpr int max_steps = 4;
    for (int steps = 0; steps < max_steps && tau > 0.0; ++steps) {
        const ArcWall::Expansion f = wall.at(tau);
        const double c = f.c - (gap + start.c);
        const NewtonStep step(wall, f, c, root_nearby(f, c));
        tau = tau + step.delta;
        if (step.error <= tolerance)
            return is_first_contact(wall, start, gap, tau, step.slope) ? tau : never;
    }
    return never;
}

/// The slow way. The root of the steepest parabola never passes the contact, since f is below it up
/// to h. How much it falls short grows with h, so h is made as short as the remaining way. Three
/// parabolas are usual. A disc that creeps along the wall takes more; after the limit it is at the
/// wall to all digits that matter.
///
/// Once f is within 2⁻⁵² clearance² of zero it is zero, as far as its rounding allows.
/// `eighth` is the time of an eighth of a turn, `end` the end of the segment.
[[maybe_unused, gnu::noinline]] static WallContact arc_contact_by_parabolas(
    const ArcWall& wall, double now, double eighth, double end, double latest) {
    constexpr int max_parabolas = 1000;
    double tau = 0.0, h = eighth;
    ArcWall::Expansion f = wall.at_start();
    for (int parabolas = 0; parabolas < max_parabolas; ++parabolas) {
        const bool approaching = f.b > 0.0;
        if (approaching && f.c >= 0.0) break;
        const double gap = wall.gap(f);
        const double M = wall.steepest(f, h);
        const double discriminant = f.b * f.b + M * gap;
        const double root = square_root(larger(discriminant, 0.0));
        const double wait = (approaching ? gap : root - f.b) / (approaching ? f.b + root : M);
        const bool touches = (approaching ? discriminant >= 0.0 : M > 0.0) && wait < h;
        const double next = tau + (touches ? wait : h), t = now + next;
        if (t >= end) return {never, false};
        if (t > latest) return {t, true};
        double next_h = eighth;
        if (touches) {
            const double below = wall.below_steepest(f, M, wait);
            if (below <= 0x1p-52 * wall.square() || !(t > now + tau)) return {t, false};
            next_h = smaller(2.0 * below / root, eighth);
        }
        h = next_h;
        tau = next;
        f = wall.at(tau);
    }
    return {now + tau, false};
}

/// When a disc reaches the wall on an arc, if that is by `latest`. `centre` is the container's
/// centre at the time from which on the disc is on this segment (beginning_on). Static: the event
/// loop of each vector width must have its own copy (engine/event_loop.hpp).
///
/// At the wall and approaching means now. Otherwise a disc counts as 2⁻⁵² clearance² inside
/// (time_to_leave).
[[maybe_unused, gnu::noinline]] static WallContact arc_wall_contact(const Flight<double>& disc,
                                                                    const Flight<double>& centre,
                                                                    const Segment& segment,
                                                                    double clearance,
                                                                    double latest) {
    const double now = centre.time;
    const ArcWall wall(disc, centre, segment.turn_rate, clearance);
    const ArcWall::Expansion start = wall.at_start();
    if (start.b > 0.0 && start.c >= 0.0) return {now, false};
    const double wait = arc_contact_by_newton(wall, start), t = now + wait;
    if (wait == never) [[unlikely]]
        return arc_contact_by_parabolas(wall, now, (0.25 * pi) / magnitude(segment.turn_rate),
                                        segment.end, latest);
    if (t >= segment.end) return {never, false};
    return {t, false};
}
/// The time from which on the disc's stored state and the segment are both valid.
SWIRL_INLINE double beginning_on(const Segment& segment, const Flight<double>& disc) {
    return larger(disc.time, segment.begin);
}
SWIRL_INLINE double time_of_arc_contact(const Flight<double>& disc, const Segment& segment,
                                        double clearance) {
    return arc_wall_contact(disc, segment.flight_at(beginning_on(segment, disc)), segment,
                            clearance, never)
        .time;
}

}  // namespace swirl
