// When two bodies touch. Everything here depends only on the states the partners hold (position,
// velocity, and the time at which they held), never on when somebody asks; so any order of asking,
// any neighbour structure, and a run resumed from a file give the same bits.
//
// Both bodies move uniformly, so with s their separation and v its rate of change at the later of
// the two times held, |s + v τ|² = σ² is the quadratic
//
//     a τ² + 2 b τ + c = 0,     a = v·v,   b = s·v,   c = s·s − σ².
//
// The paper discards roots below 10⁻¹³ to be rid of the pair that has just collided. Asking whether
// the two are approaching does the same without a tolerance (Bannerman, Strobl, Formella, Pöschel
// 2014, arXiv:1211.6718): separating means never; touching, or overlapping by a rounding error, and
// approaching means now. The roots are taken in the form in which nothing cancels.
//
// Spheres that slide on the floor fly parabolas (floor.hpp). If their accelerations are the same,
// as when both roll, that quadratic holds for them, too. If not, with g half the difference,
// |s + v τ + g τ²|² = σ² is a quartic, and the first time at which it comes down to zero is asked
// of quartic.hpp: the same rules, and again the states alone decide. Nobody slides for ever, and
// when one begins to roll its flight is another, so the quartic need not be followed beyond.
#pragma once

#include "swirl/math/quartic.hpp"
#include "swirl/math/real.hpp"
#include "swirl/physics/container_path.hpp"
#include "swirl/physics/disc.hpp"
#include "swirl/physics/floor.hpp"

namespace swirl {

/// Two discs, from outside: the smaller root, c / (√(b² − ac) − b), with b < 0. Gives the time to
/// wait from the moment at which s and v hold.
template <class Real>
SWIRL_INLINE Real time_until_contact(const BasicVec2<Real>& s, const BasicVec2<Real>& v,
                                     const Real& sum_of_radii) {
    const Real a = dot(v, v);
    const Real b = dot(s, v);
    const Real c = dot(s, s) - sum_of_radii * sum_of_radii;
    const Real discriminant = b * b - a * c;
    const auto meet = (b < Real(0.0)) & (discriminant >= Real(0.0));
    const Real wait = larger(c, Real(0.0)) / (square_root(discriminant) - b);
    return select(meet, wait, Real(never));
}

template <class Real>
SWIRL_INLINE Real time_of_contact(const Flight<Real>& i, const Flight<Real>& j,
                                  const Real& sum_of_radii) {
    const Real now = larger(i.time, j.time);
    const BasicVec2<Real> s = j.position_at(now) - i.position_at(now);
    return now + time_until_contact(s, j.velocity - i.velocity, sum_of_radii);
}

/// A disc inside a circle that moves with it uniformly: the larger root. `s` is the disc's position
/// and `v` its velocity seen from the centre of the circle, `clearance` the distance from the
/// centre at which it touches (R − r for the wall). Gives the time to wait.
///
/// A circle seen from inside curves towards the disc, so after a contact there is always another:
/// also a disc that leaves has its turn, at the root that is not now. A disc at the wall counts as
/// 2⁻⁵² clearance² inside when it is not approaching: a disc that slides along the wall so evenly
/// that b = 0 would otherwise collide with it for ever at one instant.
template <class Real>
SWIRL_INLINE Real time_to_leave(const BasicVec2<Real>& s, const BasicVec2<Real>& v,
                                const Real& clearance) {
    const Real a = dot(v, v);
    const Real b = dot(s, v);
    const Real square = clearance * clearance;
    const Real c = dot(s, s) - square;
    const Real inside = smaller(c, Real(-0x1p-52) * square);
    const auto approaching = b > Real(0.0);
    const Real root = square_root(b * b - a * select(approaching, smaller(c, Real(0.0)), inside));
    const Real wait =
        select(approaching, larger(-c, Real(0.0)), root - b) / select(approaching, root + b, a);
    return select(a > Real(0.0), wait, Real(never));
}

/// Disc and wall on a straight leg.
template <class Real>
SWIRL_INLINE Real time_of_wall_contact(const Flight<Real>& disc,
                                       const Flight<Real>& container_centre,
                                       const Real& clearance) {
    const Real now = larger(disc.time, container_centre.time);
    const BasicVec2<Real> s = disc.position_at(now) - container_centre.position_at(now);
    const BasicVec2<Real> v = disc.velocity - container_centre.velocity;
    return now + time_to_leave(s, v, clearance);
}

/// A disc inside a circle on a turning leg, from the moment on at which `centre` holds. It is seen
/// at s from the centre, with velocity u; the centre has V and turns by φ = Ω τ. With W = V^⊥, the
/// disc is then at
///
///     s + d,   d = u τ + ((φ − sin φ) V − (1 − cos φ) W)/Ω,
///
/// and what is below zero inside is f(τ) = |s|² − clearance² + (2s + d)·d, which is no polynomial.
/// What is added to f(0) vanishes with d, so that a short hop along the wall keeps its digits,
/// however fast the container.
///
/// Near any moment it is c + 2b δ + q δ² + k δ³ + l δ⁴ + m δ⁵ + n δ⁶ + o δ⁷ + p δ⁸ and so on. With
/// acceleration g and jerk j of the disc as seen from the centre, and as j' = −Ω² g, the
/// derivatives of f/2 are
///
///     s·u,  u² + s·g,  3 u·g + s·j,  3 g² + 4 u·j − Ω² s·g,  −Ω² (5 u·g + s·j),
///     −Ω² (5 g² + 6 u·j − Ω² s·g),  Ω⁴ (7 u·g + s·j),  Ω⁴ (7 g² + 8 u·j − Ω² s·g).
class TurningWall {
  public:
    struct Near {
        double c, b, q, k, l, m, n, o, p;
    };

    SWIRL_INLINE TurningWall(const Flight<double>& disc, const Flight<double>& centre,
                             double turning, double clearance)
        : s_(disc.position_at(centre.time) - centre.position),
          u_(disc.velocity - centre.velocity),
          V_(centre.velocity),
          turning_(turning),
          per_turning_(1.0 / turning),
          square_(clearance * clearance),
          outside_(dot(s_, s_) - square_),
          V2_(dot(V_, V_)),
          v2_(dot(disc.velocity, disc.velocity)) {}

    SWIRL_INLINE double square() const { return square_; }
    SWIRL_INLINE double turning() const { return turning_; }
    /// Without the terms behind k δ³ it is wrong by at most L δ⁴. f⁗/24 = (3 g² + 4 u·j −
    /// Ω² s·g)/12, where g is Ω|V| and j Ω²|V|. With v the disc's own velocity u is |v| + |V| at
    /// most, and s no longer than √2 clearances: inside, and as far outside as a contact could be
    /// overlooked. Twice a product is at most the sum of squares.
    SWIRL_INLINE double L() const {
        const double O2 = turning_ * turning_;
        return O2 * (1.0 / 12.0) * (2.0 * v2_ + 10.0 * V2_ + 0.5 * O2 * square_);
    }
    /// No more than K is |f″/2| = |u² + s·g|, in the same way.
    SWIRL_INLINE double K() const { return 2.0 * v2_ + 2.5 * V2_ + turning_ * turning_ * square_; }
    SWIRL_INLINE Near first() const { return near({0.0, 0.0}, u_, V_); }
    /// At the time τ.
    SWIRL_INLINE Near at(double tau) const {
        const Turn turn = turn_by(turning_ * tau);
        const Vec2 W = perpendicular(V_);
        const Vec2 d = tau * u_ + per_turning_ * (turn.lag * V_ - turn.versine * W);
        const Vec2 turned = turn.sine * W - turn.versine * V_;
        return near(d, u_ - turned, V_ + turned);
    }
    /// How far inside, and at the least, as in time_to_leave, if the disc is not approaching.
    SWIRL_INLINE double room(const Near& f) const {
        return larger(-f.c, f.b > 0.0 ? 0.0 : 0x1p-52 * square_);
    }
    /// Up to δ = h, f is at most c + 2b δ + M δ².
    SWIRL_INLINE double steepest(const Near& f, double h) const {
        return f.q + h * (larger(f.k, 0.0) + h * L());
    }
    /// And by no more than so much less at δ ≤ h.
    SWIRL_INLINE double below_steepest(const Near& f, double M, double delta) const {
        return ((M - f.q) - delta * (f.k - L() * delta)) * (delta * delta);
    }

  private:
    /// With the disc d away from where it was, seen with velocity u from the centre, which has V.
    SWIRL_INLINE Near near(const Vec2& d, const Vec2& u, const Vec2& V) const {
        const double O2 = turning_ * turning_, O4 = O2 * O2;
        const Vec2 s = s_ + d, g = -turning_ * perpendicular(V);
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
    double turning_, per_turning_;
    double square_, outside_, V2_, v2_;
};

/// When a disc reaches the wall; or, if not by the time asked for, a time before which it does not.
struct WallContact {
    double time;
    bool is_later;
};

/// Whether the disc stays inside from the start until τ = h, where it is at the wall and f rises
/// by `slope` per time. The cubic with f's values and slopes at both ends is, with x = τ/h,
///
///     (1 − x) (f(0) (1 − x) (1 + 2x) + f'(0) h x (1 − x) − f'(h) h x²),
///
/// and f differs from it by no more than L h⁴ x² (1 − x)². So with A = −3 f(0) − f'(0) h,
/// B = f'(h) h and C = L h⁴ it is below zero all the way if none of A and B is and
/// A (1 − x) + B x > C x (1 − x), that is, √A + √B > √C.
SWIRL_INLINE bool is_first_contact(const TurningWall& wall, const TurningWall::Near& start,
                                   double room, double h, double slope) {
    const double A = 3.0 * room - 2.0 * start.b * h, B = slope * h;
    const double C = wall.L() * ((h * h) * (h * h)), more = C - (A + B);
    return h > 0.0 && A >= 0.0 && B > 0.0 && (more < 0.0 || 4.0 * A * B > more * more);
}

/// As far as the terms to the eighth suffice for all digits.
inline constexpr double short_turn = 0.0625;

/// A guess from the terms at the start: the parabola's root, and from there a step of Halley's
/// towards that of all terms to the sixth. 0 where the parabola has none.
SWIRL_INLINE double guess_turning_wall_contact(const TurningWall::Near& f, double room) {
    const bool approaching = f.b > 0.0;
    const double discriminant = f.b * f.b + f.q * room;
    if (!(discriminant > 0.0 && (approaching || f.q > 0.0))) return 0.0;
    const double root = square_root(discriminant);
    const double p = (approaching ? room : root - f.b) / (approaching ? f.b + root : f.q);
    const double p2 = p * p, p3 = p2 * p;
    const double P =
        ((2.0 * f.b * p - room) + p2 * f.q) + p3 * ((f.k + f.l * p) + p2 * (f.m + f.n * p));
    const double P1 = (2.0 * f.b + 2.0 * f.q * p) +
                      p2 * ((3.0 * f.k + 4.0 * f.l * p) + p2 * (5.0 * f.m + 6.0 * f.n * p));
    const double P2 =
        (f.q + 3.0 * f.k * p) + p2 * ((6.0 * f.l + 10.0 * f.m * p) + p2 * (15.0 * f.n));
    return p - P * P1 / (P1 * P1 - P * P2);
}

/// Where the root is near a moment at which it is so far to it that it counts as c. With y = −c/2b
/// it is y (1 − e + 2e² − g − 5e³ + 5eg − i …).
SWIRL_INLINE double near_root(const TurningWall::Near& f, double c) {
    const double r = 0.5 / f.b, y = -c * r, y2 = y * y;
    const double e = r * f.q * y, g = r * f.k * y2, i = r * f.l * (y2 * y), e2 = e * e;
    return y * ((1.0 - e) + ((2.0 * e2 - g) + (5.0 * e * (g - e2) - i)));
}

/// A step of Newton's from δ = x, with all terms to the eighth. So much is left of f at most:
/// behind the step K times its square; and of the terms that were left out, as f⁽⁹⁾/2 = −Ω⁶ (9 u·g
/// + s·j) is no more than 5.6 K Ω⁷ (TurningWall::K), 3·10⁻⁵ K (Ωδ)⁷ δ².
struct NewtonStep {
    double delta, slope, left;

    SWIRL_INLINE NewtonStep(const TurningWall& wall, const TurningWall::Near& f, double c,
                            double x) {
        const double x2 = x * x, x4 = x2 * x2;
        const double P =
            (c + 2.0 * f.b * x) +
            x2 * ((f.q + f.k * x) + (x2 * (f.l + f.m * x) + x4 * ((f.n + f.o * x) + x2 * f.p)));
        slope = (2.0 * f.b + 2.0 * f.q * x) +
                x2 * ((3.0 * f.k + 4.0 * f.l * x) +
                      (x2 * (5.0 * f.m + 6.0 * f.n * x) + x4 * (7.0 * f.o + 8.0 * f.p * x)));
        const double step = P / slope;
        delta = x - step;
        const double phi = wall.turning() * delta, phi2 = phi * phi;
        const double rest = 3.1e-5 * magnitude(phi) * (phi2 * phi2 * phi2) * (delta * delta);
        left = wall.K() * (step * step + rest);
    }
};

/// The time until the contact, or `never` where it takes `slow_turning_wall_contact` to find it. A
/// guess is made from the first terms at the start. If it is not far, they lead to the contact;
/// else those where it leads.
SWIRL_INLINE double quick_turning_wall_contact(const TurningWall& wall,
                                               const TurningWall::Near& start) {
    const double room = wall.room(start), enough = 0x1p-52 * wall.square();
    double tau = guess_turning_wall_contact(start, room);
    if (!(tau > 0.0)) return never;
    if (magnitude(wall.turning()) * tau < short_turn) {
        const NewtonStep step(wall, start, -room, tau);
        if (step.left <= enough && is_first_contact(wall, start, room, step.delta, step.slope))
            return step.delta;
    }
    for (int steps = 0; steps < 4 && tau > 0.0; ++steps) {
        const TurningWall::Near f = wall.at(tau);
        const double c = f.c - (room + start.c);
        const NewtonStep step(wall, f, c, near_root(f, c));
        tau = tau + step.delta;
        if (step.left <= enough)
            return is_first_contact(wall, start, room, tau, step.slope) ? tau : never;
    }
    return never;
}

/// The slower way goes by parabolas. The root of the steepest one never oversteps the contact,
/// since f is below it up to h; and it comes as near as the square of the way times what h costs,
/// so h is made as short as what is left to go. Three parabolas are usual. A disc that creeps along
/// the wall takes more; after the limit it is at the wall to all digits that matter.
///
/// Once f is as close to zero as 2⁻⁵² clearance² it is as zero as its rounding lets it be.
[[maybe_unused, gnu::noinline]] static WallContact slow_turning_wall_contact(
    const TurningWall& wall, double now, double eighth, double end, double latest) {
    double tau = 0.0, h = eighth;
    TurningWall::Near f = wall.first();
    for (int parabolas = 0; parabolas < 1000; ++parabolas) {
        const bool approaching = f.b > 0.0;
        if (approaching && f.c >= 0.0) break;
        const double room = wall.room(f);
        const double M = wall.steepest(f, h);
        const double discriminant = f.b * f.b + M * room;
        const double root = square_root(larger(discriminant, 0.0));
        const double wait = (approaching ? room : root - f.b) / (approaching ? f.b + root : M);
        const bool touches = (approaching ? discriminant >= 0.0 : M > 0.0) && wait < h;
        const double next = tau + (touches ? wait : h), t = now + next;
        if (t >= end) return {never, false};
        if (t > latest) return {t, true};
        double next_h = eighth;
        if (touches) {
            const double left = wall.below_steepest(f, M, wait);
            if (left <= 0x1p-52 * wall.square() || !(t > now + tau)) return {t, false};
            next_h = smaller(2.0 * left / root, eighth);
        }
        h = next_h;
        tau = next;
        f = wall.at(tau);
    }
    return {now + tau, false};
}

/// When a disc reaches the wall on a turning leg, if by `latest`; `centre` holds when the disc
/// begins on the leg. Static: each width's event loop must have a copy of its own
/// (engine/event_loop.hpp).
///
/// At the wall and approaching means now. Otherwise a disc counts as 2⁻⁵² clearance² inside
/// (time_to_leave).
[[maybe_unused, gnu::noinline]] static WallContact turning_wall_contact(
    const Flight<double>& disc, const Flight<double>& centre, const Segment& segment,
    double clearance, double latest) {
    const double now = centre.time;
    const TurningWall wall(disc, centre, segment.turning, clearance);
    const TurningWall::Near start = wall.first();
    if (start.b > 0.0 && start.c >= 0.0) return {now, false};
    const double wait = quick_turning_wall_contact(wall, start), t = now + wait;
    if (wait == never) [[unlikely]]
        return slow_turning_wall_contact(wall, now, (0.25 * pi) / magnitude(segment.turning),
                                         segment.end, latest);
    if (t >= segment.end) return {never, false};
    return {t, false};
}
/// From when on the disc is on this leg.
SWIRL_INLINE double beginning_on(const Segment& segment, const Flight<double>& disc) {
    return larger(disc.time, segment.begin);
}
SWIRL_INLINE double time_of_turning_wall_contact(const Flight<double>& disc, const Segment& segment,
                                                 double clearance) {
    return turning_wall_contact(disc, segment.flight_at(beginning_on(segment, disc)), segment,
                                clearance, never)
        .time;
}

/// The answer of what can be told without solving a quartic: it cannot.
inline constexpr double ask_the_quartic = -1.0;

/// |s + v τ + g τ²|² − σ².
template <class Real>
struct Room {
    Real c0, c1, c2, c3, c4;

    SWIRL_INLINE Room(const BasicVec2<Real>& s, const BasicVec2<Real>& v, const BasicVec2<Real>& g,
                      const Real& sigma)
        : c0(dot(s, s) - sigma * sigma),
          c1(Real(2.0) * dot(s, v)),
          c2(dot(v, v) + Real(2.0) * dot(s, g)),
          c3(Real(2.0) * dot(v, g)),
          c4(dot(g, g)) {}
};

/// Most spheres that are looked at do not meet within the horizon, and a bound tells: with what is
/// negative of the coefficients alone, τ = h makes f or f' as small as it can be. Where neither is
/// below zero they do not meet: f stays above it, or never falls. For a vector of spheres the
/// others are marked, and solved one by one.
template <class Real>
SWIRL_INLINE Real contact_or_quartic(const BasicVec2<Real>& s, const BasicVec2<Real>& v,
                                     const BasicVec2<Real>& g, const Real& sum_of_radii,
                                     const Real& horizon) {
    const Room<Real> f(s, v, g, sum_of_radii);
    const Real zero(0.0);
    const Real d1 = smaller(f.c1, zero), d2 = smaller(f.c2, zero), d3 = smaller(f.c3, zero);
    const Real lowest = f.c0 + horizon * (d1 + horizon * (d2 + horizon * d3));
    const Real slowest = f.c1 + horizon * (Real(2.0) * d2 + Real(3.0) * horizon * d3);
    // Written so that nobody, whose position is NaN, is met by nobody.
    const auto may_meet = (zero >= lowest) & (zero >= slowest);
    const auto uniform = (g.x == zero) & (g.y == zero);
    return select(uniform, time_until_contact(s, v, sum_of_radii),
                  select(may_meet, Real(ask_the_quartic), Real(never)));
}

/// With what is asked of `contact_or_quartic`: the answer of the quartic.
SWIRL_INLINE double contact_on_parabolas(const Vec2& s, const Vec2& v, const Vec2& g,
                                         double sum_of_radii, double horizon) {
    const Room<double> f(s, v, g, sum_of_radii);
    return first_fall({f.c0, f.c1, f.c2, f.c3, f.c4}, horizon,
                      0x1p-52 * sum_of_radii * sum_of_radii);
}

/// Two spheres as seen from each other, from the later of the times at which they are known until
/// the first of them begins to roll.
template <class Real>
struct Encounter {
    Real now;
    BasicVec2<Real> s, v, g;
    Real sum_of_radii, horizon;

    SWIRL_INLINE Encounter(const Parabola<Real>& i, const Parabola<Real>& j, const Real& i_rolls,
                           const Real& j_rolls, const Real& sum)
        : now(larger(i.time, j.time)),
          s(j.position_at(now) - i.position_at(now)),
          v(j.velocity_at(now) - i.velocity_at(now)),
          g(Real(0.5) * (j.acceleration - i.acceleration)),
          sum_of_radii(sum),
          horizon(smaller(i_rolls, j_rolls) - now) {}

    SWIRL_INLINE Real wait_or_quartic() const {
        return contact_or_quartic(s, v, g, sum_of_radii, horizon);
    }
};

SWIRL_INLINE double time_of_contact(const Encounter<double>& e) {
    const double wait = e.wait_or_quartic();
    return e.now + (wait == ask_the_quartic
                        ? contact_on_parabolas(e.s, e.v, e.g, e.sum_of_radii, e.horizon)
                        : wait);
}

/// Sphere and wall, on a straight leg. The room is clearance² − |s|².
SWIRL_INLINE double time_of_wall_contact(const Parabola<double>& sphere, double begins_to_roll,
                                         const Segment& segment, double clearance) {
    const Flight<double> container{segment.start, segment.velocity, segment.begin};
    if (sphere.acceleration.x == 0.0 && sphere.acceleration.y == 0.0)
        return time_of_wall_contact(Flight<double>{sphere.position, sphere.velocity, sphere.time},
                                    container, clearance);
    const double now = larger(sphere.time, segment.begin);
    const Vec2 s = sphere.position_at(now) - container.position_at(now);
    const Vec2 v = sphere.velocity_at(now) - container.velocity;
    const Room<double> f(s, v, 0.5 * sphere.acceleration, clearance);
    return now + first_fall({-f.c0, -f.c1, -f.c2, -f.c3, -f.c4}, begins_to_roll - now,
                            0x1p-52 * clearance * clearance);
}

inline double time_of_contact(const Disc& i, const Disc& j) {
    return time_of_contact(i.flight(), j.flight(), i.radius + j.radius);
}

/// On a straight leg the answer may lie beyond the end of the leg; the leg's end comes first.
SWIRL_INLINE double time_of_wall_contact(const Flight<double>& disc, const Segment& segment,
                                         double clearance) {
    if (segment.turning != 0.0) [[unlikely]]
        return time_of_turning_wall_contact(disc, segment, clearance);
    return time_of_wall_contact(
        disc, Flight<double>{segment.start, segment.velocity, segment.begin}, clearance);
}
inline double time_of_wall_contact(const Disc& disc, const Segment& segment,
                                   double container_radius) {
    return time_of_wall_contact(disc.flight(), segment, container_radius - disc.radius);
}

}  // namespace swirl
