// The textbook event-driven method for many discs (Alder, Wainwright 1959, doi:10.1063/1.1730376;
// Rapaport 1980, doi:10.1016/0021-9991(80)90104-7). Cells are fixed. Every predicted contact goes
// into one ordered queue, and an invalidated one is dropped when its time comes. A disc that
// crosses into another cell is predicted with its new neighbours. It is slow and simple. The engine
// must agree with it bitwise where a test of all pairs would take too long.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <queue>
#include <vector>

#include "swirl/engine/simulation.hpp"
#include "swirl/physics/collision_law.hpp"
#include "swirl/physics/contact_time.hpp"

namespace swirl {

class GridReference {
  public:
    explicit GridReference(const InitialState& scene)
        : scene_(scene), changes_(scene.discs.size(), 0) {
        double largest = 0.0;
        for (const Disc& d : scene.discs) largest = larger(largest, d.radius);
        reach_ = scene.container_radius;
        for (const Segment& segment : scene.path.segments)
            reach_ = larger(reach_, scene.container_radius +
                                        1.1 * square_root(dot(segment.start, segment.start)));
        // A tenth wider than two radii, so that rounding cannot hide a contact.
        side_ = static_cast<std::int64_t>(2.0 * reach_ / (2.2 * largest));
        width_ = 2.0 * reach_ / static_cast<double>(side_);
        cell_of_.resize(scene.discs.size());
        start();
    }

    Event step() {
        const Segment& segment = scene_.path.segments[segment_];
        for (;;) {
            if (queue_.empty() || queue_.top().time >= segment.end) return end_segment();
            const Entry e = queue_.top();
            queue_.pop();
            if (e.changes_i != changes_[e.i] || e.changes_j != changes_[e.j]) continue;
            if (e.kind == crossing) {
                cross(e.i, e.time);
                continue;
            }
            if (e.kind == wall && e.segment != segment_) continue;
            return e.kind == wall ? collide_with_wall(e.i, e.time)
                                  : collide_discs(e.i, e.j, e.time);
        }
    }

    const Disc& disc(std::size_t i) const { return scene_.discs[i]; }

  private:
    enum Kind : std::uint8_t { crossing, contact, wall };
    struct Entry {
        double time;
        std::uint32_t i, j;  // i < j, or i = j: the wall, or a new cell
        std::uint32_t changes_i, changes_j;
        std::uint32_t segment;
        Kind kind;
        // At one instant a disc enters its new cell first; then the smaller i and the smaller j
        // decide.
        bool operator<(const Entry& o) const {
            if (time != o.time) return time > o.time;
            if ((kind == crossing) != (o.kind == crossing)) return o.kind == crossing;
            return i != o.i ? i > o.i : j > o.j;
        }
    };

    std::int64_t row(double x) const {
        const auto k = static_cast<std::int64_t>(std::floor((x + reach_) / width_));
        return k < 0 ? 0 : k >= side_ ? side_ - 1 : k;
    }
    void push(Kind kind, double time, std::uint32_t i, std::uint32_t j) {
        if (time < scene_.path.segments[segment_].end ||
            (kind != wall && time < scene_.path.period))
            queue_.push({time, i, j, changes_[i], changes_[j], segment_, kind});
    }
    void push_wall(std::uint32_t i) {
        push(wall,
             time_of_wall_contact(scene_.discs[i], scene_.path.segments[segment_],
                                  scene_.container_radius),
             i, i);
    }
    /// Predicts when disc i, which is in its cell at time t, leaves it.
    void push_crossing(std::uint32_t i, double t) {
        const Disc& d = scene_.discs[i];
        const Vec2 at = d.at(t).position;
        const auto wait = [&](double x, double v, std::int64_t k) {
            const double low = static_cast<double>(k) * width_ - reach_, high = low + width_;
            if (v > 0.0) return k + 1 == side_ ? never : larger((high - x) / v, 0.0);
            if (v < 0.0) return k == 0 ? never : larger((low - x) / v, 0.0);
            return never;
        };
        const std::int64_t cx = cell_of_[i] % side_, cy = cell_of_[i] / side_;
        push(crossing, t + smaller(wait(at.x, d.velocity.x, cx), wait(at.y, d.velocity.y, cy)), i,
             i);
    }
    void push_contacts(std::uint32_t i) {
        const std::int64_t cx = cell_of_[i] % side_, cy = cell_of_[i] / side_;
        for (std::int64_t y = cy - 1; y <= cy + 1; ++y)
            for (std::int64_t x = cx - 1; x <= cx + 1; ++x) {
                if (x < 0 || y < 0 || x >= side_ || y >= side_) continue;
                for (const std::uint32_t k : cells_[static_cast<std::size_t>(y * side_ + x)])
                    if (k != i)
                        push(contact, time_of_contact(scene_.discs[i], scene_.discs[k]),
                             i < k ? i : k, i < k ? k : i);
            }
    }
    void start() {
        queue_ = {};
        cells_.assign(static_cast<std::size_t>(side_ * side_), {});
        for (std::uint32_t i = 0; i < scene_.discs.size(); ++i) {
            const Vec2 at = scene_.discs[i].position;
            cell_of_[i] = row(at.y) * side_ + row(at.x);
            cells_[static_cast<std::size_t>(cell_of_[i])].push_back(i);
        }
        for (std::uint32_t i = 0; i < scene_.discs.size(); ++i) {
            push_contacts(i);
            push_wall(i);
            push_crossing(i, scene_.discs[i].time);
        }
    }
    /// Moves disc i into the cell beyond the border that it has reached.
    void cross(std::uint32_t i, double t) {
        const Disc& d = scene_.discs[i];
        const Vec2 at = d.at(t).position;
        std::int64_t cx = cell_of_[i] % side_, cy = cell_of_[i] / side_;
        const auto beyond = [&](double x, double v, std::int64_t k) {
            const double border = static_cast<double>(v > 0.0 ? k + 1 : k) * width_ - reach_;
            const bool leaves = v > 0.0 ? k + 1 < side_ : v < 0.0 && k > 0;
            return leaves ? (border - x) / v : never;
        };
        if (beyond(at.x, d.velocity.x, cx) < beyond(at.y, d.velocity.y, cy))
            cx += d.velocity.x > 0.0 ? 1 : -1;
        else
            cy += d.velocity.y > 0.0 ? 1 : -1;
        auto& old = cells_[static_cast<std::size_t>(cell_of_[i])];
        for (std::uint32_t& k : old)
            if (k == i) {
                k = old.back();
                old.pop_back();
                break;
            }
        cell_of_[i] = cy * side_ + cx;
        cells_[static_cast<std::size_t>(cell_of_[i])].push_back(i);
        push_contacts(i);
        push_crossing(i, t);
    }
    static Body body(const Disc& d) {
        return {d.velocity, d.spin, d.radius, 1.0 / d.mass, 1.0 / d.inertia};
    }
    void changed(std::uint32_t i, double t) {
        ++changes_[i];
        push_wall(i);
        push_crossing(i, t);
    }
    Event collide_discs(std::uint32_t i, std::uint32_t j, double t) {
        Disc &a = scene_.discs[i], &b = scene_.discs[j];
        a = a.at(t);
        b = b.at(t);
        Body left = body(a), right = body(b);
        const Impulse J = collide(left, right, b.position - a.position, scene_.disc_surface);
        a.velocity = left.velocity, a.spin = left.spin;
        b.velocity = right.velocity, b.spin = right.spin;
        changed(i, t);
        changed(j, t);
        push_contacts(i);
        push_contacts(j);
        return {periods_, t, EventKind::disc_disc, i, j, {}, J, 0.0};
    }
    Event collide_with_wall(std::uint32_t i, double t) {
        const Segment& segment = scene_.path.segments[segment_];
        Disc& a = scene_.discs[i];
        a = a.at(t);
        Body left = body(a), container = wall_body(segment.velocity_at(t));
        const Impulse J =
            collide(left, container, a.position - segment.position_at(t), scene_.wall_surface);
        a.velocity = left.velocity, a.spin = left.spin;
        changed(i, t);
        push_contacts(i);
        return {periods_, t, EventKind::disc_wall, i, i, {}, J, 0.0};
    }
    Event end_segment() {
        const Event event{
            periods_, scene_.path.segments[segment_].end, EventKind::path_vertex, 0, 0, {}, {},
            0.0};
        if (++segment_ < scene_.path.segments.size()) {
            for (std::uint32_t i = 0; i < scene_.discs.size(); ++i) push_wall(i);
            return event;
        }
        for (std::uint32_t i = 0; i < scene_.discs.size(); ++i) {
            scene_.discs[i] = scene_.discs[i].at(event.clock);
            scene_.discs[i].time = 0.0;
            ++changes_[i];
        }
        segment_ = 0;
        ++periods_;
        start();
        return event;
    }

    InitialState scene_;
    std::vector<std::uint32_t> changes_;
    std::vector<std::int64_t> cell_of_;
    std::vector<std::vector<std::uint32_t>> cells_;
    std::priority_queue<Entry> queue_;
    double reach_, width_;
    std::int64_t side_;
    std::uint32_t segment_ = 0;
    std::int64_t periods_ = 0;
};

}  // namespace swirl
