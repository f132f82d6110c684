// When two bodies touch. Everything here depends only on the stored states of the two (position,
// velocity, and the time at which they hold), never on the time of the call. So the order of
// predictions, the neighbour search, and a run resumed from a file cannot change a result.
//
// Both bodies move uniformly. Let s be their separation and v its rate of change, at the later of
// the two stored times. Then |s + v τ|² = σ² is the quadratic
//
//     a τ² + 2 b τ + c = 0,     a = v·v,   b = s·v,   c = s·s − σ².
//
// The paper discards roots below 10⁻¹³, so that the pair that has just collided is not found again.
// Testing whether the two approach does the same without a tolerance (Bannerman, Strobl, Formella,
// Pöschel 2014, arXiv:1211.6718). Separating means never. Touching, or overlapping by a rounding
// error, and approaching means now. The roots are computed in the form in which nothing cancels.
//
// Spheres that slide on the floor move along parabolas (floor.hpp). If their accelerations are
// equal, as when both roll, the same quadratic holds. If not, let g be half the difference: then |s
// + v τ + g τ²|² = σ² is a quartic. quartic.hpp finds the first time at which it falls to zero, by
// the same rules. No sphere slides for ever, and when one begins to roll its parabola ends. So the
// quartic need not be followed beyond that.
//
// The wall of a container that moves along an arc has its own header, arc_contact.hpp.
#pragma once

#include "swirl/math/quartic.hpp"
#include "swirl/math/real.hpp"
#include "swirl/physics/arc_contact.hpp"
#include "swirl/physics/container_path.hpp"
#include "swirl/physics/disc.hpp"
#include "swirl/physics/floor.hpp"

namespace swirl {

// ---- Discs

/// Two discs, from outside: the smaller root, c / (√(b² − ac) − b), with b < 0. Returns the time to
/// wait from the time at which s and v hold.
template <class Real>
SWIRL_INLINE Real time_until_contact(const BasicVec2<Real>& s, const BasicVec2<Real>& v,
                                     const Real& sum_of_radii) {
    const Real a = dot(v, v);
    const Real b = dot(s, v);
    const Real c = dot(s, s) - sum_of_radii * sum_of_radii;
    const Real discriminant = b * b - a * c;
    const auto touch = (b < Real(0.0)) & (discriminant >= Real(0.0));
    const Real wait = larger(c, Real(0.0)) / (square_root(discriminant) - b);
    return select(touch, wait, Real(never));
}

template <class Real>
SWIRL_INLINE Real time_of_contact(const Flight<Real>& i, const Flight<Real>& j,
                                  const Real& sum_of_radii) {
    const Real now = larger(i.time, j.time);
    const BasicVec2<Real> s = j.position_at(now) - i.position_at(now);
    return now + time_until_contact(s, j.velocity - i.velocity, sum_of_radii);
}

/// A disc inside a circle that moves uniformly: the larger root. `s` and `v` are the disc's
/// position and velocity seen from the centre of the circle. `clearance` is the distance from the
/// centre at which the disc touches (R − r for the wall). Returns the time to wait.
///
/// Seen from inside, a circle curves towards the disc, so after a contact there is always another
/// one. A disc that leaves the wall has its next contact at the root that is not now. A disc that
/// is at the wall and not approaching counts as 2⁻⁵² clearance² inside. Otherwise a disc that
/// slides along the wall so evenly that b = 0 would collide with it for ever at one instant.
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

/// Disc and wall on a straight segment.
template <class Real>
SWIRL_INLINE Real time_of_wall_contact(const Flight<Real>& disc,
                                       const Flight<Real>& container_centre,
                                       const Real& clearance) {
    const Real now = larger(disc.time, container_centre.time);
    const BasicVec2<Real> s = disc.position_at(now) - container_centre.position_at(now);
    const BasicVec2<Real> v = disc.velocity - container_centre.velocity;
    return now + time_to_leave(s, v, clearance);
}

/// Disc and wall on any segment. On a straight one the time may be after the segment's end, which
/// then comes first.
SWIRL_INLINE double time_of_wall_contact(const Flight<double>& disc, const Segment& segment,
                                         double clearance) {
    if (segment.turn_rate != 0.0) [[unlikely]]
        return time_of_arc_contact(disc, segment, clearance);
    return time_of_wall_contact(
        disc, Flight<double>{segment.start, segment.velocity, segment.begin}, clearance);
}

inline double time_of_contact(const Disc& i, const Disc& j) {
    return time_of_contact(i.flight(), j.flight(), i.radius + j.radius);
}
inline double time_of_wall_contact(const Disc& disc, const Segment& segment,
                                   double container_radius) {
    return time_of_wall_contact(disc.flight(), segment, container_radius - disc.radius);
}

// ---- Spheres

/// The result of contact_or_quartic if the contact needs the quartic.
inline constexpr double needs_quartic = -1.0;

/// The coefficients of |s + v τ + g τ²|² − σ².
template <class Real>
struct GapPolynomial {
    Real c0, c1, c2, c3, c4;

    SWIRL_INLINE GapPolynomial(const BasicVec2<Real>& s, const BasicVec2<Real>& v,
                               const BasicVec2<Real>& g, const Real& sigma)
        : c0(dot(s, s) - sigma * sigma),
          c1(Real(2.0) * dot(s, v)),
          c2(dot(v, v) + Real(2.0) * dot(s, g)),
          c3(Real(2.0) * dot(v, g)),
          c4(dot(g, g)) {}
};

/// Most pairs of spheres do not collide within the horizon, and a bound shows this. Keeping only
/// the negative coefficients, f and f' are smallest at τ = h. If one of these values is positive
/// there is no contact: either f stays positive, or it never falls. Of a vector of pairs, the
/// others are marked with `needs_quartic`, to be solved one by one.
template <class Real>
SWIRL_INLINE Real contact_or_quartic(const BasicVec2<Real>& s, const BasicVec2<Real>& v,
                                     const BasicVec2<Real>& g, const Real& sum_of_radii,
                                     const Real& horizon) {
    const GapPolynomial<Real> f(s, v, g, sum_of_radii);
    const Real zero(0.0);
    const Real d1 = smaller(f.c1, zero), d2 = smaller(f.c2, zero), d3 = smaller(f.c3, zero);
    const Real lowest = f.c0 + horizon * (d1 + horizon * (d2 + horizon * d3));
    const Real slowest = f.c1 + horizon * (Real(2.0) * d2 + Real(3.0) * horizon * d3);
    // Written so that NaN, the position of the sentinel, gives no contact.
    const auto may_touch = (zero >= lowest) & (zero >= slowest);
    const auto uniform = (g.x == zero) & (g.y == zero);
    return select(uniform, time_until_contact(s, v, sum_of_radii),
                  select(may_touch, Real(needs_quartic), Real(never)));
}

/// The time to wait by the quartic, with the arguments of contact_or_quartic.
SWIRL_INLINE double contact_on_parabolas(const Vec2& s, const Vec2& v, const Vec2& g,
                                         double sum_of_radii, double horizon) {
    const GapPolynomial<double> f(s, v, g, sum_of_radii);
    return first_fall({f.c0, f.c1, f.c2, f.c3, f.c4}, horizon,
                      0x1p-52 * sum_of_radii * sum_of_radii);
}

/// The relative motion of two spheres, from the later of their stored times until the first of them
/// begins to roll.
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
    return e.now + (wait == needs_quartic
                        ? contact_on_parabolas(e.s, e.v, e.g, e.sum_of_radii, e.horizon)
                        : wait);
}

/// Sphere and wall, on a straight segment. The gap is clearance² − |s|².
SWIRL_INLINE double time_of_wall_contact(const Parabola<double>& sphere, double begins_to_roll,
                                         const Segment& segment, double clearance) {
    const Flight<double> container{segment.start, segment.velocity, segment.begin};
    if (sphere.acceleration.x == 0.0 && sphere.acceleration.y == 0.0)
        return time_of_wall_contact(Flight<double>{sphere.position, sphere.velocity, sphere.time},
                                    container, clearance);
    const double now = larger(sphere.time, segment.begin);
    const Vec2 s = sphere.position_at(now) - container.position_at(now);
    const Vec2 v = sphere.velocity_at(now) - container.velocity;
    const GapPolynomial<double> f(s, v, 0.5 * sphere.acceleration, clearance);
    return now + first_fall({-f.c0, -f.c1, -f.c2, -f.c3, -f.c4}, begins_to_roll - now,
                            0x1p-52 * clearance * clearance);
}

}  // namespace swirl
