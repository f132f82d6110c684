// The M-frame: the frame in which swirling is steady (paper, Fig. 1c and main text). Its origin is
// the container's centre C. It rotates with the swirl so that the direction from the swirl centre S
// to C points down, to −y. The point M, the wall's farthest from S, is at the bottom.
//
//     down d = (C − S)/|C − S|,  S = 0              x_M =  (r − C) · d^⊥
//     (a still container: d rotates with the clock) y_M = −(r − C) · d
//
// Velocities. With V the container's velocity and Ω = 2π/T the mean rate of the swirl (on a polygon
// too, where the direction of C advances unevenly),
//
//     relative   u   = (v − V), rotated           the "deviation from the container" of Figs 2, 5d
//     M-frame    v_M = u − Ω ẑ × r_M              so the wall moves with −Ω ẑ × p, clockwise
//     spin       ω_M = ω − Ω                      and ϖ_M = ϖ − Ω, for any motion (Eq. 1)
//
// θ is the angular position about C in the M-frame, counter-clockwise from +x; M is at 3π/2.
//
// Units: those of the snapshot; angles in radians, 0 ≤ θ < 2π. Limits: without a period Ω is NaN.
#pragma once

#include <cstddef>
#include <cstdint>
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

    /// Converts a lab vector to the directions of the M-frame, and back.
    Vec2 rotate(const Vec2& v) const { return {dot(v, perpendicular(down)), -dot(v, down)}; }
    Vec2 rotate_back(const Vec2& v) const { return v.x * perpendicular(down) - v.y * down; }

    Vec2 position(const Vec2& lab) const { return rotate(lab - centre); }
    Vec2 relative_velocity(const Vec2& lab) const { return rotate(lab - centre_velocity); }
    Vec2 velocity(const Vec2& lab_position, const Vec2& lab_velocity) const {
        return relative_velocity(lab_velocity) - omega * perpendicular(position(lab_position));
    }
    Vec2 lab_position(const Vec2& p) const { return centre + rotate_back(p); }
    Vec2 lab_velocity(const Vec2& p, const Vec2& v) const {
        return centre_velocity + rotate_back(v + omega * perpendicular(p));
    }
    double spin(double lab) const { return lab - omega; }
    double period() const { return 2.0 * pi / omega; }
    /// The angle from the lab to the M-frame, counter-clockwise.
    double angle() const { return 2.0 * pi * turns_of(perpendicular(down)); }
};

MFrame m_frame(const Snapshot& snapshot);

/// A whole snapshot in the M-frame; the container rests at the origin. The discs' states are
/// advanced to the clock.
Snapshot seen_from(const MFrame& frame, const Snapshot& lab);

/// The centre of mass of a view.
struct CentreOfMass {
    Vec2 position;          // M-frame
    Vec2 velocity;          // relative to the container, rotated into the M-frame
    double closest_square;  // a disc closer than this (squared) has no ϖ

    /// ϖ_i of cluster_rotation.hpp (lab) of a disc at p with the relative velocity u; NaN on the
    /// centre of mass. A fixed rotation of the axes does not change r × u, nor does the common V.
    SWIRL_INLINE double varpi(const Vec2& p, const Vec2& u) const {
        const Vec2 r = p - position;
        const double square = dot(r, r);
        const double rate = cross(r, u - velocity) / square;
        return square > closest_square ? rate : not_available;
    }
};

/// All discs in the M-frame, as columns: the input of most measurements. A snapshot converts to it;
/// a caller with many snapshots reuses one view.
class MFrameView {
  public:
    MFrameView() = default;
    MFrameView(const Snapshot& snapshot) { update(snapshot); }  // NOLINT: implicit on purpose
    void update(const Snapshot& snapshot);

    std::size_t size() const { return x.size(); }

    MFrame frame{};
    double time = 0.0;  // time since the beginning
    double container_radius = 0.0;

    std::vector<double> x, y;    // M-frame
    std::vector<double> ux, uy;  // velocity relative to the container, rotated
    std::vector<double> spin, radius, mass, inertia;

    Vec2 position(std::size_t i) const { return {x[i], y[i]}; }
    Vec2 relative_velocity(std::size_t i) const { return {ux[i], uy[i]}; }
    Vec2 velocity(std::size_t i) const {
        return relative_velocity(i) - frame.omega * perpendicular(position(i));
    }
    /// Computed by every call: most measurements do not need them.
    CentreOfMass centre_of_mass() const;
    double mean_radius() const {
        double mean = 0.0;
        for (const double r : radius) mean += r / static_cast<double>(size());
        return mean;
    }
    /// The discs with a finite position in ascending order of x; equal x in order of the index.
    void order_by_x(std::vector<std::uint32_t>& order) const;

    template <class Visitor>
    void fields(Visitor&& visit) {
        visit(frame, time, container_radius, x, y, ux, uy, spin, radius, mass, inertia);
    }
    bool is_consistent() const {
        for (const auto* column : {&y, &ux, &uy, &spin, &radius, &mass, &inertia})
            if (column->size() != x.size()) return false;
        return true;
    }
};

}  // namespace swirl
