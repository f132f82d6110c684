#include "swirl/measure/m_frame.hpp"

#include <algorithm>
#include <numeric>

#include "swirl/math/wide.hpp"

namespace swirl {

MFrame m_frame(const Snapshot& s) {
    const Vec2 C = s.container_centre;
    const double distance = square_root(dot(C, C));
    const Vec2 down = distance > 0.0 ? (1.0 / distance) * C : unit_circle(s.clock / s.period);
    return {C, s.container_velocity, down, 2.0 * pi / s.period};
}

Snapshot seen_from(const MFrame& frame, const Snapshot& lab) {
    Snapshot s = lab;
    s.container_centre = s.container_velocity = {0.0, 0.0};
    for (std::size_t i = 0; i < s.size(); ++i) {
        Disc d = lab.disc(i);
        d.angle = lab.orientation(i) - frame.angle();
        d.velocity = frame.velocity(lab.position(i), lab.velocity(i));
        d.position = frame.position(lab.position(i));
        d.spin = frame.spin(d.spin);
        d.time = s.clock;
        s.set(i, d);
    }
    return s;
}

namespace {

/// Positions and velocities of all discs, rotated into the M-frame.
SWIRL_WIDE void rotate_all(std::size_t n, const MFrame& frame, double clock,
                           const double* __restrict x, const double* __restrict y,
                           const double* __restrict vx, const double* __restrict vy,
                           const double* __restrict held_at, double* __restrict X,
                           double* __restrict Y, double* __restrict U, double* __restrict W) {
    const MFrame f = frame;
    for (std::size_t i = 0; i < n; ++i) {
        const double elapsed = clock - held_at[i];
        const Vec2 p = f.position({x[i] + elapsed * vx[i], y[i] + elapsed * vy[i]});
        const Vec2 u = f.relative_velocity({vx[i], vy[i]});
        X[i] = p.x;
        Y[i] = p.y;
        U[i] = u.x;
        W[i] = u.y;
    }
}

}  // namespace

void MFrameView::update(const Snapshot& s) {
    const std::size_t n = s.size();
    frame = m_frame(s);
    time = s.time();
    container_radius = s.container_radius;
    for (auto* column : {&x, &y, &ux, &uy}) column->resize(n);
    spin = s.spin;
    radius = s.radius;
    mass = s.mass;
    inertia = s.inertia;

    rotate_all(n, frame, s.clock, s.x.data(), s.y.data(), s.vx.data(), s.vy.data(),
               s.held_at.data(), x.data(), y.data(), ux.data(), uy.data());
}

CentreOfMass MFrameView::centre_of_mass() const {
    double m = 0.0, mx = 0.0, my = 0.0, mu = 0.0, mw = 0.0;
    for (std::size_t i = 0; i < size(); ++i) {
        m += mass[i];
        mx += mass[i] * x[i];
        my += mass[i] * y[i];
        mu += mass[i] * ux[i];
        mw += mass[i] * uy[i];
    }
    const double closest = 0x1p-40 * container_radius;
    return {{mx / m, my / m}, {mu / m, mw / m}, closest * closest};
}

void MFrameView::order_by_x(std::vector<std::uint32_t>& order) const {
    order.resize(size());
    std::iota(order.begin(), order.end(), 0u);
    std::erase_if(order, [&](std::uint32_t i) { return !(dot(position(i), position(i)) < never); });
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        return x[a] < x[b] || (x[a] == x[b] && a < b);
    });
}

}  // namespace swirl
