// How the discs collide: head-on or grazing, and in which direction.
//
//   b            (n × g)/|g| of a disc–disc collision: n the unit vector from i to j, g = v_j − v_i
//                before the collision. b is the impact parameter in units of the contact distance:
//                0 head-on, ±1 grazing. It is the sine of the angle between the line of centres and
//                the relative velocity. Positive: the discs orbit each other counter-clockwise
//   b_wall       the same for a disc and the wall: n points from C to the contact, g is the disc's
//                velocity relative to the container. Positive: along the wall counter-clockwise
//   direction    angle of the line of centres of disc–disc collisions in the M-frame, 0° … 180°
//
// In a gas without preferred direction and without correlations, the number of collisions in db is
// proportional to db. So b is uniform in (−1, 1), ⟨|b|⟩ = ½, and ⟨b⟩ = 0; the same at the wall. The
// direction is uniform. The velocities before the collision follow from those after it and the
// impulse.
//
// Units: none; ° for the direction. Normalisation: densities, Σ p × (width of the bin) = 1; each
// collision counts the same. Errors: from blocks of periods. Limits: without collisions NaN. For
// spheres, velocities and impulses are the horizontal ones.
#pragma once

#include <algorithm>
#include <cstddef>
#include <tuple>

#include "swirl/measure/cell_averages.hpp"
#include "swirl/measure/m_frame.hpp"
#include "swirl/measure/measurement_report.hpp"
#include "swirl/measure/quantities.hpp"
#include "swirl/physics/event.hpp"
#include "swirl/physics/snapshot.hpp"

namespace swirl {

/// b of a collision, from the state after it; NaN if nothing moved relative to the other.
inline double impact_parameter(const Event& event, const Snapshot& after) {
    const Vec2 n = event.normal;
    const Vec2 J = event.impulse.normal * n + event.impulse.tangential * Vec2{n.y, -n.x};
    const Vec2 before_i = after.velocity(event.i) + (1.0 / after.mass[event.i]) * J;
    Vec2 g = before_i - after.container_velocity;
    if (event.kind == EventKind::disc_disc)
        g = after.velocity(event.j) - (1.0 / after.mass[event.j]) * J - before_i;
    return cross(n, g) / square_root(dot(n, n) * dot(g, g));
}

class CollisionAngles : public MergedAverages<CollisionAngles> {
  public:
    static auto averages(auto& s) {
        return std::tie(s.discs_, s.wall_, s.directions_, s.b_, s.size_, s.wall_b_, s.wall_size_);
    }
    static constexpr bool reads_only_event = true;
    static constexpr std::size_t bins = 40, direction_bins = 36;

    void sample_event(const Event& event, const Snapshot& after) {
        if (event.kind != EventKind::disc_disc && event.kind != EventKind::disc_wall) return;
        const double b = impact_parameter(event, after);
        if (!(b == b)) return;
        const bool wall = event.kind == EventKind::disc_wall;
        add_to(wall ? wall_ : discs_, bins, 0.5 * (b + 1.0));
        (wall ? wall_b_ : b_).add(b);
        (wall ? wall_size_ : size_).add(b < 0.0 ? -b : b);
        if (wall) return;
        const double turns = turns_of(m_frame(after).rotate(event.normal));
        add_to(directions_, direction_bins, turns < 0.5 ? 2.0 * turns : 2.0 * turns - 1.0);
    }
    /// `duration` is not needed: everything is per collision.
    void close_event_block(double) {
        const auto close = [](auto&... average) { (average.close_block(), ...); };
        std::apply(close, averages(*this));
    }

    static double b_of(std::size_t bin) {
        return 2.0 * (static_cast<double>(bin) + 0.5) / static_cast<double>(bins) - 1.0;
    }
    static double direction_of(std::size_t bin) {
        return 180.0 * (static_cast<double>(bin) + 0.5) / static_cast<double>(direction_bins);
    }
    Estimate density(std::size_t bin) const { return scaled(discs_.estimate(bin), 0.5 * bins); }
    Estimate wall_density(std::size_t bin) const { return scaled(wall_.estimate(bin), 0.5 * bins); }
    /// 1 for every bin if no direction is preferred.
    Estimate direction_density(std::size_t bin) const {
        return scaled(directions_.estimate(bin), direction_bins);
    }

    template <class Visitor>
    void report(Visitor&& visit) const {
        visit(ReportRow{quantity("collision_angles.impact"), size_.estimate()});
        visit(ReportRow{quantity("collision_angles.orbit"), b_.estimate()});
        visit(ReportRow{quantity("collision_angles.wall_impact"), wall_size_.estimate()});
        visit(ReportRow{quantity("collision_angles.wall_orbit"), wall_b_.estimate()});
        ReportTable table{
            "impact_parameter",
            "density of the impact parameter b: ½ if no direction is preferred",
            {{quantity("collision_angles.impact_parameter.b")},
             {quantity("collision_angles.impact_parameter.discs"), with_error_column},
             {quantity("collision_angles.impact_parameter.wall"), with_error_column}}};
        for (std::size_t bin = 0; bin < bins; ++bin)
            table.add(b_of(bin), density(bin), wall_density(bin));
        visit(std::move(table));
        ReportTable directions{
            "directions",
            "density of the line of centres in the M-frame: 1 if no direction is preferred",
            {{quantity("collision_angles.directions.angle")},
             {quantity("collision_angles.directions.density"), with_error_column}}};
        for (std::size_t bin = 0; bin < direction_bins; ++bin)
            directions.add(direction_of(bin), direction_density(bin));
        visit(std::move(directions));
    }
    template <class Visitor>
    void fields(Visitor&& visit) {
        this->visit_averages(visit);
    }

  private:
    static void add_to(CellRates& histogram, std::size_t count, double share) {
        histogram.add_weight();
        histogram.add(
            std::min(static_cast<std::size_t>(share * static_cast<double>(count)), count - 1));
    }

    CellRates discs_{bins}, wall_{bins}, directions_{direction_bins};
    BlockMean b_, size_, wall_b_, wall_size_;
};

}  // namespace swirl
