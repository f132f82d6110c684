// The M-frame: the frame in which swirling is steady (paper, Fig. 1c and main text). Its origin is
// the container's centre C, and it turns with the swirl so that the direction from the swirl centre
// S to C points down, to −y; the point M, the wall's farthest from S, is at the bottom.
//
//     down d = (C − S)/|C − S|,  S = 0              x_M =  (r − C) · d^⊥
//     (a still container: d turns with the clock)   y_M = −(r − C) · d
//
// Velocities. With V the container's velocity and Ω = 2π/T the mean rate of the swirl (on a polygon
// too, where the direction of C advances unevenly),
//
//     relative   u   = (v − V), turned            the "deviation from the container" of Figs 2, 5d
//     M-frame    v_M = u − Ω ẑ × r_M              so the wall moves with −Ω ẑ × p, clockwise
//     spin       ω_M = ω − Ω                      and ϖ_M = ϖ − Ω, for any motion (Eq. 1)
//
// θ is the angular position about C in the M-frame, counter-clockwise from +x; M is at 3π/2.
//
// Units: those of the snapshot; angles in radians, 0 ≤ θ < 2π. Limits: without a period Ω is NaN.
#pragma once

#include <cstddef>
#include <vector>

#include "swirl/math/real.hpp"
#include "swirl/math/unit_circle.hpp"
#include "swirl/math/vec2.hpp"
#include "swirl/physics/snapshot.hpp"
#include "swirl/statistics/block_average.hpp"

namespace swirl {

struct MFrame {
    Vec2 centre, centre_velocity;  // C and V, in the lab
    Vec2 down;                     // unit vector from S to C, in the lab
    double omega;

    Vec2 turn(const Vec2& v) const { return {dot(v, perpendicular(down)), -dot(v, down)}; }
    Vec2 turn_back(const Vec2& v) const { return v.x * perpendicular(down) - v.y * down; }

    Vec2 position(const Vec2& lab) const { return turn(lab - centre); }
    Vec2 relative_velocity(const Vec2& lab) const { return turn(lab - centre_velocity); }
    Vec2 velocity(const Vec2& lab_position, const Vec2& lab_velocity) const {
        return relative_velocity(lab_velocity) - omega * perpendicular(position(lab_position));
    }
    Vec2 lab_position(const Vec2& p) const { return centre + turn_back(p); }
    Vec2 lab_velocity(const Vec2& p, const Vec2& v) const {
        return centre_velocity + turn_back(v + omega * perpendicular(p));
    }
    /// Of the wall, where it is at p.
    Vec2 wall_velocity(const Vec2& p) const { return -omega * perpendicular(p); }
    double spin(double lab) const { return lab - omega; }
    double lab_spin(double spin) const { return spin + omega; }
    /// By this much the M-frame is turned against the lab, counter-clockwise.
    double angle() const { return 2.0 * pi * turns_of(perpendicular(down)); }
};

MFrame m_frame(const Snapshot& snapshot);

/// A whole snapshot as it looks from the M-frame; the container rests at the origin.
Snapshot seen_from(const MFrame& frame, const Snapshot& lab);
/// And back. The discs' states are brought up to the clock.
Snapshot seen_from_lab(const MFrame& frame, const Snapshot& in_m_frame);

/// Of a view.
struct CentreOfMass {
    Vec2 position;  // M-frame
    Vec2 velocity;  // relative to the container, turned
    double closest_square;

    /// ϖ_i of cluster_rotation.hpp, lab, of a disc at p with the relative velocity u; NaN on the
    /// centre of mass. Turning a frame does not change r × u, nor does the common V.
    SWIRL_INLINE double varpi(const Vec2& p, const Vec2& u) const {
        const Vec2 r = p - position;
        const double square = dot(r, r);
        const double rate = cross(r, u - velocity) / square;
        return square > closest_square ? rate : not_available;
    }
};

/// All discs in the M-frame, as columns: what most measurements start from. Made of a snapshot on
/// the spot where one is given instead; kept by who looks often.
class MFrameView {
  public:
    MFrameView() = default;
    MFrameView(const Snapshot& snapshot) { update(snapshot); }  // NOLINT: a view of it
    void update(const Snapshot& snapshot);

    std::size_t size() const { return x.size(); }

    MFrame frame{};
    double time = 0.0;  // since the beginning
    double container_radius = 0.0;

    std::vector<double> x, y;    // M-frame
    std::vector<double> ux, uy;  // velocity relative to the container, turned
    std::vector<double> spin, radius, mass, inertia;

    Vec2 position(std::size_t i) const { return {x[i], y[i]}; }
    Vec2 relative_velocity(std::size_t i) const { return {ux[i], uy[i]}; }
    Vec2 velocity(std::size_t i) const {
        return relative_velocity(i) - frame.omega * perpendicular(position(i));
    }
    /// Summed up when asked for: most measurements do without.
    CentreOfMass centre_of_mass() const;

    template <class Visitor>
    void fields(Visitor&& visit) {
        visit(frame);
        visit(time);
        visit(container_radius);
        for (auto* column : {&x, &y, &ux, &uy, &spin, &radius, &mass, &inertia}) visit(*column);
    }
    bool is_consistent() const {
        for (const auto* column : {&y, &ux, &uy, &spin, &radius, &mass, &inertia})
            if (column->size() != x.size()) return false;
        return true;
    }
};

}  // namespace swirl
