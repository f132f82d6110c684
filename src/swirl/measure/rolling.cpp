#include "swirl/measure/rolling.hpp"

namespace swirl {
namespace {

Vec2 horizontal_spin(const Snapshot& s, std::size_t i) { return {s.spin_x[i], s.spin_y[i]}; }

/// a·b over ½ (a² + b²), as a ratio of sums.
void add_pair(BlockMean& correlation, double product, double square) {
    if (square > 0.0) correlation.add(product / square, square);
}

}  // namespace

void Rolling::sample_in_lab(const Snapshot& lab) {
    if (!lab.are_spheres() || lab.size() == 0 || skips_next()) return;
    for (std::size_t i = 0; i < lab.size(); ++i) {
        const Disc d = lab.disc(i);
        const bool rolls = lab.rolls(i);
        const Vec2 c = slip_on_floor(d, lab.container_velocity);
        rolls_.add(rolls ? 1.0 : 0.0);
        const Vec2 out = d.position - lab.container_centre;
        const double gap = lab.container_radius - d.radius - square_root(dot(out, out));
        if (gap < gap_ * d.radius) rolls_at_wall_.add(rolls ? 1.0 : 0.0);
        slip_.add(rolls ? 0.0 : square_root(dot(c, c)));
    }
    view_.update(lab);
    for (const Pair& pair : touching_.find(view_, gap_ * view_.mean_radius())) {
        const Vec2 a = horizontal_spin(lab, pair.i), b = horizontal_spin(lab, pair.j);
        const Vec2 s = lab.position(pair.j) - lab.position(pair.i);
        const double h_i = cross(a, s), h_j = cross(b, s);  // |s| cancels
        add_pair(axes_, dot(a, b), 0.5 * (dot(a, a) + dot(b, b)));
        add_pair(contacts_, h_i * h_j, 0.5 * (h_i * h_i + h_j * h_j));
    }
}

void Rolling::sample_event(const Event& event, const Snapshot& after) {
    const bool wall = event.kind == EventKind::disc_wall;
    if (!after.are_spheres() || (!wall && event.kind != EventKind::disc_disc)) return;
    double slip = 0.0;   // s_z after the collision
    double lever = 0.0;  // Σ R²/I
    const auto add = [&](std::size_t i) {
        slip -= after.radius[i] * cross(horizontal_spin(after, i), event.normal);
        lever += after.radius[i] * after.radius[i] / after.inertia[i];
    };
    add(event.i);
    if (!wall) add(event.j);
    // Before the collision the slip was s_z − J_z Σ R²/I.
    const double J = event.impulse.vertical;
    (wall ? at_wall_ : between_).add(event.impulse, -J * (slip - 0.5 * J * lever));
}

void Rolling::close_event_block(double duration, std::size_t spheres) {
    if (samples_ == 0) return;  // no spheres
    const double weight = duration * static_cast<double>(spheres);
    between_.close_block(weight);
    at_wall_.close_block(weight);
}

void Rolling::VerticalFriction::add(const Impulse& J, double vertical_loss) {
    vertical_square += J.vertical * J.vertical;
    square += J.vertical * J.vertical + J.tangential * J.tangential;
    vertical += std::abs(J.vertical);
    normal += J.normal;
    loss += vertical_loss;
}

void Rolling::VerticalFriction::close_block(double weight) {
    share.add(vertical_square, square);
    friction.add(vertical, normal);
    power.add(loss, weight);
    vertical_square = square = vertical = normal = loss = 0.0;
}

void Rolling::VerticalFriction::merge(const VerticalFriction& other) {
    share.merge(other.share);
    friction.merge(other.friction);
    power.merge(other.power);
}

}  // namespace swirl
