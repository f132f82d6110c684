#include "swirl/measure/field_balance.hpp"

#include <cmath>

#include "swirl/math/quartic.hpp"

namespace swirl {
namespace {

double norm(const Vec2& v) { return square_root(dot(v, v)); }

/// At most two roots of the curvature, three of the slope, four of the quartic, and both ends.
struct Cuts {
    std::array<double, 12> at{};
    std::size_t count = 0;
    void add(double t) { at[count++] = t; }
};

/// The cuts and the roots of `value`, which must be monotonic between neighbouring cuts.
template <class Value, class Slope>
Cuts with_roots(const Cuts& cuts, const Value& value, const Slope& slope) {
    Cuts more;
    for (std::size_t k = 0; k + 1 < cuts.count; ++k) {
        const double low = cuts.at[k], high = cuts.at[k + 1];
        more.add(low);
        const double a = value(low), b = value(high);
        if ((a < 0.0 && b > 0.0) || (a > 0.0 && b < 0.0))
            more.add(quartic::root_between(value, slope, low, high, b > a, 0.5 * (low + high)));
    }
    more.add(cuts.at[cuts.count - 1]);
    return more;
}

/// Calls visit(stretch) for all times in [0, end] with f < 0.
template <class Visit>
void for_each_stretch_below_zero(const Quartic& f, double end, const Visit& visit) {
    const auto value = [&](double t) { return f.value(t); };
    const auto slope = [&](double t) { return f.slope(t); };
    const auto curvature = [&](double t) { return f.curvature(t); };
    Cuts cuts;
    cuts.add(0.0);
    // Roots of 12 c4 t² + 6 c3 t + 2 c2; c4 > 0, as the disc is accelerated.
    const double square = 9.0 * f.c3 * f.c3 - 24.0 * f.c4 * f.c2;
    if (square > 0.0) {
        const double root = square_root(square);
        for (const double t :
             {(-3.0 * f.c3 - root) / (12.0 * f.c4), (-3.0 * f.c3 + root) / (12.0 * f.c4)})
            if (t > 0.0 && t < end) cuts.add(t);
    }
    cuts.add(end);
    cuts = with_roots(with_roots(cuts, slope, curvature), value, slope);
    for (std::size_t k = 0; k + 1 < cuts.count; ++k) {
        const Stretch stretch{cuts.at[k], cuts.at[k + 1]};
        if (!stretch.empty() && value(0.5 * (stretch.begin + stretch.end)) < 0.0) visit(stretch);
    }
}

}  // namespace

void FieldBalance::begin(const Snapshot& state) {
    held_.clear();
    terms_ = {};
    begun_ = true;
    start_periods_ = state.periods;
    take_time(state);
    for (std::size_t i = 0; i < state.size(); ++i) held_.push_back({field_disc(state, i), now_});
    at_begin_ = densities();
    for (const Held& held : held_) {
        const Vec2 q = point_ - held.disc.position;
        if (dot(q, q) < kernel_.width * kernel_.width) count(held.disc);
    }
}

/// Of a flight, or of a disc at the beginning.
void FieldBalance::count(const FieldDisc& disc) {
    const double mass = disc.mass * kernel_.height();
    terms_.scale_of_mass += mass;
    terms_.scale_of_momentum += mass * norm(disc.velocity);
    terms_.scale_of_spin += std::fabs(disc.inertia * disc.spin) * kernel_.height();
}

FieldDensities FieldBalance::densities() const {
    FieldDensities sum;
    for (const Held& held : held_) {
        const double w = kernel_.value(point_ - held.disc.position);
        sum = sum + FieldDensities{held.disc.mass * w, (held.disc.mass * w) * held.disc.velocity,
                                   held.disc.inertia * held.disc.spin * w};
    }
    return sum;
}

/// Adds the fluxes of one disc at the time held.time + from, times `weight`, a length of time.
void FieldBalance::carry(const Held& held, double from, double weight) {
    const FieldDisc& disc = held.disc;
    const Vec2 a = (1.0 / disc.mass) * disc.force;
    const Vec2 v = disc.velocity + from * a;
    const Vec2 q = point_ - disc.position - from * disc.velocity - (0.5 * from * from) * a;
    const double change = -weight * dot(v, kernel_.gradient(q));
    const FieldDensities carried{disc.mass * change, (disc.mass * change) * v,
                                 disc.inertia * disc.spin * change};
    const Vec2 push = (weight * kernel_.value(q)) * disc.force;
    terms_.transport = terms_.transport + carried;
    terms_.floor = terms_.floor + push;
}

void FieldBalance::fly(Held& held, double until) {
    FieldDisc& disc = held.disc;
    const double duration = until - held.time;
    const Vec2 a = (1.0 / disc.mass) * disc.force;
    const Vec2 q = point_ - disc.position, way = duration * disc.velocity;
    const double half_square = 0.5 * duration * duration;
    const double reach = kernel_.width + norm(way) + half_square * norm(a);
    if (duration > 0.0 && dot(q, q) < reach * reach) {
        if (a.x == 0.0 && a.y == 0.0) {
            const Stretch inside = stretch_inside(kernel_, q, way);
            if (!inside.empty()) {
                count(disc);
                for_each_node(gauss_3, inside, [&](double s, double weight) {
                    carry(held, s * duration, weight * duration);
                });
            }
        } else {
            const Vec2& v = disc.velocity;
            const Quartic f{dot(q, q) - kernel_.width * kernel_.width, -2.0 * dot(q, v),
                            dot(v, v) - dot(q, a), dot(v, a), 0.25 * dot(a, a)};
            for_each_stretch_below_zero(f, duration, [&](const Stretch& inside) {
                count(disc);
                terms_.scale_of_momentum += duration * norm(disc.force) * kernel_.height();
                for_each_node(gauss_5, inside,
                              [&](double t, double weight) { carry(held, t, weight); });
            });
        }
    }
    disc.position = disc.position + way + half_square * a;
    disc.velocity = disc.velocity + duration * a;
    held.time = until;
}

void FieldBalance::add(const Event& event, const Snapshot& after) {
    // If the number of discs has changed, a new interval begins.
    if (held_.size() != after.size()) return begin(after);
    take_time(after);
    const bool collides = is_collision(event);
    const Transfer t = collides ? transfer_of(event, after) : Transfer{};
    if (after.on_floor) {
        for (std::size_t i = 0; i < held_.size(); ++i) {
            Vec2 push{0.0, 0.0};
            if (collides && i == event.i) push = -1.0 * t.impulse;
            if (event.kind == EventKind::disc_disc && i == event.j) push = t.impulse;
            Held& held = held_[i];
            const double duration = now_ - held.time;
            const Vec2 change = after.mass[i] * (after.velocity(i) - held.disc.velocity) - push;
            held.disc.force = duration > 0.0 ? (1.0 / duration) * change : Vec2{0.0, 0.0};
        }
    }
    for (std::size_t i = 0; i < held_.size(); ++i) {
        const bool changed = collides && (i == event.i || i == event.j);
        if (!changed && !after.on_floor) continue;
        fly(held_[i], now_);
        held_[i].disc = field_disc(after, i);
    }
    if (collides) add(t);
}

void FieldBalance::add(const Transfer& t) {
    const Vec2 q = point_ - t.begin;
    const double reach = kernel_.width + norm(t.line);
    if (!(dot(q, q) < reach * reach)) return;
    const LineAverage average = line_average(kernel_, q, t.line);
    const LineGradient gradient = line_gradient(kernel_, q, t.line);
    const Vec2 stress = -dot(t.line, gradient.whole) * t.impulse;
    const double couple = t.torque_i * dot(t.line, gradient.whole - gradient.weighted) -
                          t.torque_j * dot(t.line, gradient.weighted);
    const double torque = (-cross(t.line, t.impulse) - t.taken_up) * average.whole;
    terms_.stress = terms_.stress + stress;
    terms_.couple_stress += couple;
    terms_.torque += torque;
    terms_.scale_of_momentum += norm(t.impulse) * kernel_.height();
    terms_.scale_of_spin += (std::fabs(t.torque_i) + std::fabs(t.torque_j)) * kernel_.height();
    if (!t.at_wall) return;
    const Vec2 wall = -kernel_.value(point_ - t.end()) * t.impulse;
    terms_.wall = terms_.wall + wall;
}

void FieldBalance::finish() {
    for (Held& held : held_) fly(held, now_);
    begun_ = false;
    // Times count from the last period, since T may change in the next one.
    for (Held& held : held_) held.time = last_clock_;
    start_periods_ = last_periods_;
    now_ = last_clock_;
}

Vec2 FieldBalance::floor_force(const Snapshot& s, std::size_t i) const {
    if (i >= held_.size()) return {not_available, not_available};
    const double duration = time_of(s) - held_[i].time;
    if (!(duration > 0.0)) return {not_available, not_available};
    return (s.mass[i] / duration) * (s.velocity(i) - held_[i].disc.velocity);
}

std::array<double, 3> FieldBalance::relative_residuals() const {
    const FieldDensities r = residual();
    const auto relative = [](double residual, double scale) {
        return scale > 0.0 ? std::fabs(residual) / scale : 0.0;
    };
    return {relative(r.mass, terms_.scale_of_mass),
            relative(norm(r.momentum), terms_.scale_of_momentum),
            relative(r.spin, terms_.scale_of_spin)};
}

}  // namespace swirl
