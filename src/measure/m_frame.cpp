#include "measure/m_frame.hpp"

#include "measure/statistics.hpp"

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

Snapshot seen_from_lab(const MFrame& frame, const Snapshot& in_m_frame) {
    Snapshot s = in_m_frame;
    s.container_centre = frame.centre;
    s.container_velocity = frame.centre_velocity;
    for (std::size_t i = 0; i < s.size(); ++i) {
        Disc d = in_m_frame.disc(i);
        d.angle = in_m_frame.orientation(i) + frame.angle();
        d.velocity = frame.lab_velocity(in_m_frame.position(i), in_m_frame.velocity(i));
        d.position = frame.lab_position(in_m_frame.position(i));
        d.spin = frame.lab_spin(d.spin);
        d.time = s.clock;
        s.set(i, d);
    }
    return s;
}

void MFrameView::look(const Snapshot& s) {
    const std::size_t n = s.size();
    frame = m_frame(s);
    time = s.time();
    container_radius = s.container_radius;
    for (auto* column : {&x, &y, &ux, &uy, &theta, &varpi}) column->resize(n);
    spin = s.spin;
    radius = s.radius;
    mass = s.mass;
    inertia = s.inertia;

    // Copies of the pointers and of the frame, so that the loops vectorise.
    double *const X = x.data(), *const Y = y.data(), *const U = ux.data(), *const W = uy.data();
    const MFrame f = frame;
    const double clock = s.clock;
    double m = 0.0, mx = 0.0, my = 0.0, mu = 0.0, mw = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
        const double elapsed = clock - s.held_at[i];
        const Vec2 p = f.position({s.x[i] + elapsed * s.vx[i], s.y[i] + elapsed * s.vy[i]});
        const Vec2 u = f.relative_velocity({s.vx[i], s.vy[i]});
        X[i] = p.x;
        Y[i] = p.y;
        U[i] = u.x;
        W[i] = u.y;
        m += s.mass[i];
        mx += s.mass[i] * p.x;
        my += s.mass[i] * p.y;
        mu += s.mass[i] * u.x;
        mw += s.mass[i] * u.y;
    }
    centre_of_mass = {mx / m, my / m};
    centre_of_mass_velocity = {mu / m, mw / m};

    const Vec2 c = centre_of_mass, cu = centre_of_mass_velocity;
    const double closest = 0x1p-40 * container_radius, closest_square = closest * closest;
    double *const angle = theta.data(), *const rate = varpi.data();
    for (std::size_t i = 0; i < n; ++i) {
        angle[i] = 2.0 * pi * turns_of({X[i], Y[i]});
        // Turning a frame does not change r × u, nor does the common V: this is ϖ_i in the lab.
        const Vec2 r{X[i] - c.x, Y[i] - c.y};
        const double q = dot(r, r);
        rate[i] = q > closest_square ? cross(r, Vec2{U[i] - cu.x, W[i] - cu.y}) / q : not_known;
    }
}

}  // namespace swirl
