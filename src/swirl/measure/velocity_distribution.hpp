// How the speeds and the spins of the discs are distributed.
//
//   speed           s = √⟨|δu|²⟩, δu the velocity relative to the centre of mass of the discs
//   p(c)            density of c = |δu|/s; Maxwell's is 2c exp(−c²)
//   spin            w = √⟨(ω − ω̄)²⟩, ω̄ the mean spin of the discs in the lab
//   p(z)            density of z = (ω − ω̄)/w; the normal distribution is exp(−z²/2)/√(2π)
//   kurtosis        of the velocity  ⟨δu_x⁴ + δu_y⁴⟩/2 / (s²/2)² × N/(N − 1)
//                   of the spin      ⟨(ω − ω̄)⁴⟩/w⁴ × (N + 1)/(N − 1)
//
// s, w and ω̄ are those of one sample, so a temperature that varies in time does not widen the
// distribution. N independent normal velocities have the moments of a point on a sphere in 2N − 2
// dimensions (N − 1 for spins), since their sum of squares is given. The last factors correct for
// this: both kurtoses are 3 for normal distributions at every N. Higher values mean longer tails.
//
// By default only every 8th sample is used. Units: v for speed, Ω for spin, none for the rest.
// Normalisation: Σ p × (width of the bin) is the share of the discs within the table. Errors: from
// blocks of periods. Limits: a sample with fewer than two discs (three for spins), or without any
// motion, is omitted; so are spins if one of them is missing (NaN).
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <tuple>

#include "swirl/measure/cell_averages.hpp"
#include "swirl/measure/m_frame.hpp"
#include "swirl/measure/measurement_report.hpp"
#include "swirl/measure/quantities.hpp"
#include "swirl/measure/strided.hpp"

namespace swirl {

class VelocityDistribution : public BlockAverages<VelocityDistribution>, public Strided {
  public:
    static auto averages(auto& s) {
        return std::tie(s.square_, s.kurtosis_, s.spin_square_, s.spin_kurtosis_, s.speeds_,
                        s.spins_);
    }
    static constexpr double width = 0.1, largest = 4.0;  // size of the tables; units: s and w
    static constexpr std::size_t speed_bins = 40, spin_bins = 80;

    explicit VelocityDistribution(int every = 8) : Strided(every) {}

    void sample(const MFrameView& view) {
        if (skips_next()) return;
        if (view.size() > 1) add_velocities(view);
        if (view.size() > 2) add_spins(view);
    }

    static double speed_of(std::size_t bin) { return width * (static_cast<double>(bin) + 0.5); }
    static double spin_of(std::size_t bin) { return speed_of(bin) - largest; }
    Estimate speed_density(std::size_t bin) const {
        return scaled(speeds_.estimate(bin), 1.0 / width);
    }
    Estimate spin_density(std::size_t bin) const {
        return scaled(spins_.estimate(bin), 1.0 / width);
    }

    template <class Visitor>
    void report(Visitor&& visit) const {
        visit(ReportRow{quantity("velocity_distribution.speed"), root_of(square_.estimate())});
        visit(ReportRow{quantity("velocity_distribution.kurtosis"), kurtosis_.estimate()});
        visit(ReportRow{quantity("velocity_distribution.spin"), root_of(spin_square_.estimate())});
        visit(
            ReportRow{quantity("velocity_distribution.spin_kurtosis"), spin_kurtosis_.estimate()});
        ReportTable speeds{"speeds",
                           "density of the speed, in units of its root mean square",
                           {{quantity("velocity_distribution.speeds.speed")},
                            {quantity("velocity_distribution.speeds.density"), with_error_column}}};
        for (std::size_t bin = 0; bin < speed_bins; ++bin)
            speeds.add(speed_of(bin), speed_density(bin));
        visit(std::move(speeds));
        ReportTable spins{"spins",
                          "density of the spin less its mean, in units of its standard deviation",
                          {{quantity("velocity_distribution.spins.spin")},
                           {quantity("velocity_distribution.spins.density"), with_error_column}}};
        for (std::size_t bin = 0; bin < spin_bins; ++bin)
            spins.add(spin_of(bin), spin_density(bin));
        visit(std::move(spins));
    }
    template <class Visitor>
    void fields(Visitor&& visit) {
        visit(samples_);
        this->visit_averages(visit);
    }

  private:
    static Estimate root_of(Estimate square) {
        square.mean = square_root(square.mean);
        square.error /= 2.0 * square.mean;
        return square;
    }
    /// Bins are numbered from 0; a value outside the table is in the last cell.
    static void add_to(CellRates& bins, std::size_t count, double value) {
        const double bin = value / width;
        bins.add(bin >= 0.0 && bin < static_cast<double>(count) ? static_cast<std::size_t>(bin)
                                                                : count);
    }

    void add_velocities(const MFrameView& view) {
        const Vec2 mean = view.centre_of_mass().velocity;
        const auto n = static_cast<double>(view.size());
        double squares = 0.0, fourths = 0.0;
        for (std::size_t i = 0; i < view.size(); ++i) {
            const Vec2 u = view.relative_velocity(i) - mean;
            const double x = u.x * u.x, y = u.y * u.y;
            squares += x + y;
            fourths += x * x + y * y;
        }
        square_.add(squares / n);
        if (!(squares > 0.0)) return;
        kurtosis_.add(2.0 * fourths * n / (squares * squares) * n / (n - 1.0));
        const double scale = square_root(n / squares);
        speeds_.add_weight(n);
        for (std::size_t i = 0; i < view.size(); ++i) {
            const Vec2 u = view.relative_velocity(i) - mean;
            add_to(speeds_, speed_bins, scale * square_root(dot(u, u)));
        }
    }

    void add_spins(const MFrameView& view) {
        const auto n = static_cast<double>(view.size());
        double mean = 0.0, squares = 0.0, fourths = 0.0;
        for (const double spin : view.spin) mean += spin / n;
        for (const double spin : view.spin) {
            const double square = (spin - mean) * (spin - mean);
            squares += square;
            fourths += square * square;
        }
        spin_square_.add(squares / n / (view.frame.omega * view.frame.omega));
        // The rounding of the mean of equal spins is no motion.
        if (!(squares > 1e-24 * n * mean * mean)) return;
        spin_kurtosis_.add(fourths * n / (squares * squares) * (n + 1.0) / (n - 1.0));
        const double scale = square_root(n / squares);
        spins_.add_weight(n);
        for (const double spin : view.spin)
            add_to(spins_, spin_bins, scale * (spin - mean) + largest);
    }

    BlockMean square_, kurtosis_, spin_square_, spin_kurtosis_;
    CellRates speeds_{speed_bins + 1}, spins_{spin_bins + 1};
};

}  // namespace swirl
