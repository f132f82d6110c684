// How strong the random motion of the discs is: the motion that is left when the mean flow is
// subtracted.
//
//   of a cell    T = ½ (⟨m u²⟩ − ⟨m u⟩²/⟨m⟩) over the discs found in it, u the velocity relative
//                to the container in the M-frame: twice the energy per degree of freedom (a disc
//                has two), the kT of a gas
//   granular     the average of T over all discs
//   of the spin  ⟨I ω²⟩ − ⟨I ω⟩²/⟨I⟩ over all discs (one degree of freedom; for spheres, the spin
//                about the vertical)
//
// In equilibrium the last two are equal; friction at the wall drives the spins and makes them
// differ. Units: disc mass × (container's speed)². Source: Goldhirsch 2003,
// doi:10.1146/annurev.fluid.35.101101.161114. Errors: from blocks of periods, those of ½⟨m u²⟩ and
// ⟨I ω²⟩, since the mean flow is known better than the motion about it.
//
// By default only every 8th sample is used. Smoothed velocities miss a part of ½⟨m u²⟩, which
// add_energy() adds.
//
// Limits: a cell never visited has no temperature (NaN), one visited once has 0. Structure of the
// flow inside a cell counts as temperature. Missing spins (NaN) make that of the spin NaN.
#pragma once

#include <cstdint>
#include <tuple>

#include "swirl/measure/cell_averages.hpp"
#include "swirl/measure/m_frame.hpp"
#include "swirl/measure/measurement_report.hpp"
#include "swirl/measure/quantities.hpp"
#include "swirl/measure/square_grid.hpp"
#include "swirl/measure/strided.hpp"

namespace swirl {

class GranularTemperature : public BlockAverages<GranularTemperature>, public Strided {
  public:
    static auto averages(auto& s) { return std::tie(s.cells_, s.spins_, s.energies_); }

    explicit GranularTemperature(double container_radius, std::size_t side = 20, int every = 8)
        : Strided(every), grid_{side, container_radius}, cells_(grid_.cells()), spins_(1) {}

    void sample(const MFrameView& view) {
        if (skips_next()) return;
        for (std::size_t i = 0; i < view.size(); ++i) {
            const double m = view.mass[i], I = view.inertia[i], spin = view.spin[i];
            spins_.add(0, {I, I * spin, I * spin * spin});
            const std::size_t cell = grid_.cell_at(view.x[i], view.y[i]);
            if (cell == SquareGrid::outside) continue;
            const double ux = view.ux[i], uy = view.uy[i], energy = m * (ux * ux + uy * uy);
            cells_.add(cell, {m, m * ux, m * uy, energy});
            energies_.add(energy);
        }
    }

    /// ½⟨u²⟩ of a disc is larger by `missing` than its velocities give; all discs have the mass 1.
    void add_energy(double missing) { missing_ = missing; }

    const SquareGrid& grid() const { return grid_; }
    double temperature(std::size_t cell) const {
        const double x = cells_.mean(cell, 1), y = cells_.mean(cell, 2);
        return larger(0.5 * (cells_.mean(cell, 3) - (x * x + y * y) / cells_.mean(cell, 0)), 0.0);
    }
    Estimate granular() const {
        Estimate e = scaled(energies_.estimate(), 0.5);
        double sum = 0.0, visits = 0.0;
        for (std::size_t c = 0; c < cells_.size(); ++c) {
            if (cells_.visits(c) == 0.0) continue;
            sum += cells_.visits(c) * temperature(c);
            visits += cells_.visits(c);
        }
        e.mean = visits > 0.0 ? sum / visits + missing_ : not_available;
        return e;
    }
    Estimate of_the_spin() const {
        Estimate e = spins_.estimate(0, 2);
        e.mean -= spins_.mean(0, 1) * spins_.mean(0, 1) / spins_.mean(0, 0);
        return e;
    }

    template <class Visitor>
    void report(Visitor&& visit) const {
        visit(ReportRow{quantity("temperature.granular"), granular()});
        visit(ReportRow{quantity("temperature.of_the_spin"), of_the_spin()});
    }
    template <class Visitor>
    void fields(Visitor&& visit) {
        visit(samples_, cells_, spins_, energies_);
    }

  private:
    SquareGrid grid_;
    double missing_ = 0.0;
    CellMeans<4> cells_;
    CellMeans<3> spins_;
    BlockMean energies_;
};

}  // namespace swirl
