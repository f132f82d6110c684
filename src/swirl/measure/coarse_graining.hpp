// How exact events become continuous fields: the kernel, and what a flight and a collision
// contribute to the balances of mass, momentum and spin (Goldhirsch 2010,
// doi:10.1007/s10035-010-0181-z).
//
//   W(d) = 3/(π w²) (1 − d²/w²)²   for d < w, 0 beyond; w is the width, ∫W = 1
//
//   mass ρ = Σ m W     momentum ρu = Σ m v W     spin S = Σ I ω W       (W at x − r of each disc)
//
// Every change of these three at a point x is the divergence of a flux or a source:
//
//   flight     a disc moves from r to r + ∫v dt. ∂W/∂t = −v·∇W, so each density changes by minus
//              the divergence of its flux Σ m v W, Σ m v v W or Σ I ω v W. On a floor the force
//              m a adds m a W to the momentum
//   collision  the impulse J acts on body j and −J on i, and the torques T_i and T_j on their
//              spins. With the branch vector ℓ = r_j − r_i and, along it,
//
//                  B = ∫₀¹ W(x − r_i − s ℓ) ds,   B₁ = ∫₀¹ s W(x − r_i − s ℓ) ds,
//
//              J (W_j − W_i) = ∇·σ         with  σ_ab = −J_a ℓ_b B            (stress)
//              T_i W_i + T_j W_j = σ_yx − σ_xy + ∇·C
//                                          with  C = ℓ (T_i (B − B₁) − T_j B₁)   (couple stress)
//
//              since the two torques add up to −ℓ × J: they are R_i J_t and R_j J_t
//   wall       body j is a point at the contact, without spin and with ℓ = R_i n. The formulas
//              hold, and −J W at the contact is the force of the boundary (Weinhart, Thornton,
//              Luding, Bokhove 2012, doi:10.1007/s10035-012-0317-4)
//
// So with the sums over all flights and collisions in any interval of time,
//
//   Δρ    = −∇·∫Σ m v W
//   Δ(ρu) = ∇·(−∫Σ m v v W + Σσ) + (wall) + (floor)
//   ΔS    = ∇·(−∫Σ I ω v W + ΣC) + Σ (σ_yx − σ_xy)
//
// hold exactly at every point, width and time. The first index of σ is that of the force.
//
// Integrals along a line are exact: within the kernel W is a polynomial in s of degree 4, and
// three Gauss–Legendre nodes integrate degree 5. The ends of the line are cut where |x − r| = w.
// Only + − × ÷ √ occur, so results are bitwise identical on all platforms.
//
// Units: those of the snapshot. Limits: none.
#pragma once

#include <array>
#include <cstddef>

#include "swirl/math/real.hpp"
#include "swirl/math/unit_circle.hpp"
#include "swirl/math/vec2.hpp"
#include "swirl/measure/m_frame.hpp"
#include "swirl/physics/event.hpp"
#include "swirl/physics/snapshot.hpp"

namespace swirl {

struct CoarseKernel {
    double width = 1.0;

    double value(const Vec2& d) const {
        const double part = 1.0 - dot(d, d) / (width * width);
        return part > 0.0 ? height() * part * part : 0.0;
    }
    Vec2 gradient(const Vec2& d) const {
        const double square = width * width, part = 1.0 - dot(d, d) / square;
        return part > 0.0 ? (-4.0 * height() * part / square) * d : Vec2{0.0, 0.0};
    }
    double height() const { return 3.0 / (pi * width * width); }
};

/// The part of a line or a flight that lies within the kernel; empty if begin ≥ end.
struct Stretch {
    double begin = 0.0, end = 0.0;
    bool empty() const { return !(begin < end); }
};

/// The values of s in [0, 1] with |q − s ℓ| < w.
inline Stretch stretch_inside(const CoarseKernel& kernel, const Vec2& q, const Vec2& line) {
    const double a = dot(line, line), b = dot(q, line);
    const double c = dot(q, q) - kernel.width * kernel.width;
    if (a == 0.0) return {0.0, c < 0.0 ? 1.0 : 0.0};
    const double square = b * b - a * c;
    if (!(square > 0.0)) return {};
    const double root = square_root(square);
    const double far = b >= 0.0 ? b + root : b - root;  // no cancellation
    const double one = far / a, other = c / far;
    return {larger(b >= 0.0 ? other : one, 0.0), smaller(b >= 0.0 ? one : other, 1.0)};
}

/// Nodes and weights of Gauss and Legendre on [−1, 1].
struct GaussNode {
    double at, weight;
};
inline constexpr std::array<GaussNode, 3> gauss_3{{{-0.774596669241483377035853079956, 5.0 / 9.0},
                                                   {0.0, 8.0 / 9.0},
                                                   {0.774596669241483377035853079956, 5.0 / 9.0}}};
inline constexpr std::array<GaussNode, 5> gauss_5{
    {{-0.906179845938663992797626878299, 0.236926885056189087514264040720},
     {-0.538469310105683091036314420700, 0.478628670499366468041291514836},
     {0.0, 128.0 / 225.0},
     {0.538469310105683091036314420700, 0.478628670499366468041291514836},
     {0.906179845938663992797626878299, 0.236926885056189087514264040720}}};

/// Calls visit(s, weight) for the nodes of a stretch. The weights add up to its length.
template <std::size_t n, class Visit>
void for_each_node(const std::array<GaussNode, n>& nodes, const Stretch& stretch,
                   const Visit& visit) {
    const double middle = 0.5 * (stretch.begin + stretch.end);
    const double half = 0.5 * (stretch.end - stretch.begin);
    for (const GaussNode& node : nodes) visit(middle + half * node.at, half * node.weight);
}

/// ∫₀¹ f ds and ∫₀¹ s f ds along a line, for a function f that is zero outside the kernel.
template <class Value>
struct LineIntegrals {
    Value whole{}, weighted{};
};
template <class Value, class Function>
LineIntegrals<Value> line_integrals(const CoarseKernel& kernel, const Vec2& q, const Vec2& line,
                                    const Function& f) {
    LineIntegrals<Value> sums;
    const Stretch stretch = stretch_inside(kernel, q, line);
    if (stretch.empty()) return sums;
    for_each_node(gauss_3, stretch, [&](double s, double weight) {
        const Value value = weight * f(q - s * line);
        sums.whole = sums.whole + value;
        sums.weighted = sums.weighted + s * value;
    });
    return sums;
}

/// B and B₁ of a line, for q = x − r_i.
using LineAverage = LineIntegrals<double>;
inline LineAverage line_average(const CoarseKernel& kernel, const Vec2& q, const Vec2& line) {
    return line_integrals<double>(kernel, q, line, [&](const Vec2& d) { return kernel.value(d); });
}
/// ∇B and ∇B₁. W and its gradient vanish at the edge of the kernel, so its edges add nothing.
using LineGradient = LineIntegrals<Vec2>;
inline LineGradient line_gradient(const CoarseKernel& kernel, const Vec2& q, const Vec2& line) {
    return line_integrals<Vec2>(kernel, q, line, [&](const Vec2& d) { return kernel.gradient(d); });
}

/// One disc, as the densities need it.
struct FieldDisc {
    Vec2 position, velocity, force;  // force of the floor
    double spin, mass, inertia, radius;
};
/// Of disc i at the time of the snapshot, in the lab frame, with this force of the floor.
inline FieldDisc field_disc(const Snapshot& s, std::size_t i, const Vec2& force = {0.0, 0.0}) {
    return {s.position(i), s.velocity(i), force, s.spin[i], s.mass[i], s.inertia[i], s.radius[i]};
}
/// At its position in the M-frame, with its velocity relative to the container, and its lab spin.
inline FieldDisc relative_to(const MFrame& frame, const FieldDisc& lab) {
    FieldDisc disc = lab;
    disc.position = frame.position(lab.position);
    disc.velocity = frame.relative_velocity(lab.velocity);
    disc.force = frame.rotate(lab.force);
    return disc;
}

/// The momentum and the torques that one collision transfers.
struct Transfer {
    Vec2 begin, line;  // r_i and ℓ
    Vec2 impulse;      // J, on body j
    double torque_i = 0.0, torque_j = 0.0;
    bool at_wall = false;
    double loss = 0.0;      // lost kinetic energy
    double taken_up = 0.0;  // torque on what holds particles that cannot spin (Disc::can_spin)

    Vec2 end() const { return begin + line; }
};
/// Of a collision of two discs, or of disc and wall, in the lab frame.
Transfer transfer_of(const Event& event, const Snapshot& after);

inline Transfer relative_to(const MFrame& frame, const Transfer& lab) {
    Transfer transfer = lab;
    transfer.begin = frame.position(lab.begin);
    transfer.line = frame.rotate(lab.line);
    transfer.impulse = frame.rotate(lab.impulse);
    return transfer;
}
inline bool is_collision(const Event& event) {
    return event.kind == EventKind::disc_disc || event.kind == EventKind::disc_wall;
}

}  // namespace swirl
