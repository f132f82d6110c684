// How the velocities and the spins of two discs are correlated, as functions of their distance.
//
//   along    Σ a_i a_j / Σ ½ (a_i² + a_j²), a = δu · (direction from i to j)
//   across   the same for the component of δu across that direction
//   spin     Σ ω_i ω_j / Σ ½ (ω_i² + ω_j²)
//
// over the pairs with a distance in the bin. δu is the velocity relative to the centre of mass of
// the discs, ω the spin in the lab, where the container does not rotate. Each ratio is 1 for equal
// values, −1 for opposite ones (gears), and between them otherwise. A rigid rotation of the cluster
// is a correlation, too. Discs with independent velocities have −1/(N − 1) at every distance,
// because the sum of all δu is 0. Discs with independent spins have ⟨ω⟩²/⟨ω²⟩, which is 0 if the
// mean spin is 0.
//
// Neighbours: pairs with a gap below half the mean radius. By default only every 64th sample is
// used. Units: none. The ratios are of sums over samples. Errors: from blocks of periods. Limits: a
// bin without pairs, discs at rest, and missing spins give NaN. Distances are at most 20 r.
#pragma once

#include <cstddef>
#include <cstdint>
#include <tuple>
#include <vector>

#include "swirl/measure/cell_averages.hpp"
#include "swirl/measure/m_frame.hpp"
#include "swirl/measure/measurement_report.hpp"
#include "swirl/measure/pair_distances.hpp"
#include "swirl/measure/quantities.hpp"
#include "swirl/measure/strided.hpp"

namespace swirl {

class VelocityCorrelation : public BlockAverages<VelocityCorrelation>, public Strided {
  public:
    static constexpr bool any_path = true;  // no axis of the M-frame matters
    static auto averages(auto& s) {
        return std::tie(s.along_, s.across_, s.spin_, s.near_along_, s.near_across_, s.near_spin_);
    }

    explicit VelocityCorrelation(const ObservedDish& dish, int every = 64)
        : Strided(every),
          bins_(dish.container_radius, dish.units.r),
          along_(bins_.count),
          across_(bins_.count),
          spin_(bins_.count),
          near_along_(1),
          near_across_(1),
          near_spin_(1) {}

    void sample(const MFrameView& view) {
        if (skips_next() || view.size() < 2) return;
        const Vec2 mean = view.centre_of_mass().velocity;
        const double near = 0.5 * view.mean_radius();
        for_each_close_pair(
            view, bins_.reach, order_, [&](std::uint32_t i, std::uint32_t j, double distance) {
                const Vec2 direction = (1.0 / distance) * (view.position(j) - view.position(i));
                const Vec2 a = view.relative_velocity(i) - mean;
                const Vec2 b = view.relative_velocity(j) - mean;
                const bool neighbours = distance - view.radius[i] - view.radius[j] < near;
                const auto add = [&](CellMeans<1>& bins, CellMeans<1>& of_neighbours, double x,
                                     double y) {
                    const double square = 0.5 * (x * x + y * y);
                    bins.add(bins_.bin_of(distance), {x * y}, square);
                    if (neighbours) of_neighbours.add(0, {x * y}, square);
                };
                add(along_, near_along_, dot(a, direction), dot(b, direction));
                add(across_, near_across_, cross(a, direction), cross(b, direction));
                add(spin_, near_spin_, view.spin[i], view.spin[j]);
            });
    }

    const DistanceBins& bins() const { return bins_; }
    Estimate along(std::size_t bin) const { return along_.estimate(bin); }
    Estimate across(std::size_t bin) const { return across_.estimate(bin); }
    Estimate spin(std::size_t bin) const { return spin_.estimate(bin); }

    template <class Visitor>
    void report(Visitor&& visit) const {
        visit(ReportRow{quantity("velocity_correlation.near_along"), near_along_.estimate(0)});
        visit(ReportRow{quantity("velocity_correlation.near_across"), near_across_.estimate(0)});
        visit(ReportRow{quantity("velocity_correlation.near_spin"), near_spin_.estimate(0)});
        ReportTable table{"function",
                          "correlation of velocities and spins against the distance of two discs",
                          {{quantity("velocity_correlation.function.distance")},
                           {quantity("velocity_correlation.function.along"), with_error_column},
                           {quantity("velocity_correlation.function.across"), with_error_column},
                           {quantity("velocity_correlation.function.spin"), with_error_column}}};
        for (std::size_t bin = 0; bin < bins_.count; ++bin)
            table.add(bins_.middle(bin), along(bin), across(bin), spin(bin));
        visit(std::move(table));
    }
    template <class Visitor>
    void fields(Visitor&& visit) {
        visit(samples_);
        this->visit_averages(visit);
    }

  private:
    DistanceBins bins_;
    CellMeans<1> along_, across_, spin_, near_along_, near_across_, near_spin_;
    std::vector<std::uint32_t> order_;
};

}  // namespace swirl
