// The fields at the points of a square grid, averaged over time, with errors.
//
// Sums. At a sample, every disc adds to each point within its kernel W (coarse_graining.hpp)
//
//     W, m W, m v W, m v v W, I W, I ω W, I ω² W, I ω v W, π R² W, f W,
//     m ∇W, m v ∇W, I ∇W, I ω ∇W
// and every collision adds its stress, couple stress, loss of energy and, at the wall, the force of
// the boundary. The sums over samples are divided by the number of samples, and the sums over
// collisions by the time.
//
// Fields. With ⟨·⟩ these averages, n = ⟨W⟩ and M_ab = ⟨m v_a v_b W⟩,
//
//     density ρ = ⟨m W⟩                      velocity u = ⟨m v W⟩/ρ
//     spin density S = ⟨I ω W⟩               spin ω = S/⟨I W⟩
//     kinetic stress −(M_ab − ρ u_a u_b)     temperature T = (M_aa − ρ u²)/2n
//     kinetic couple stress −(⟨I ω v W⟩ − S u)
//     spin temperature (⟨I ω² W⟩ − S ω)/n
//     gradients ∂_b u_a = (∂_b⟨m v_a W⟩ − u_a ∂_b ρ)/ρ, and those of ω alike
//
// So the velocity fluctuates about its average over time and over the kernel. A gradient of u
// within the kernel counts as temperature: for a shear rate γ that is m γ² w²/16, since a kernel
// has ⟨x²⟩ = w²/8.
//
// Errors: the delete-one-group jackknife (Busing, Meijer, van der Leeden 1999,
// doi:10.1023/A:1008800423698, for groups of unequal weight) over up to 15 groups of periods in
// sequence. Fields are ratios of sums, so the errors of sums alone would not do. When a run has 16
// groups, neighbouring ones are joined. Errors have a relative uncertainty of 20 to 30 %.
//
// Limits: where no disc ever comes, ratios are NaN. Fewer than two groups have no error (NaN). The
// open period does not count.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "swirl/measure/coarse_graining.hpp"
#include "swirl/measure/quantities.hpp"
#include "swirl/measure/square_grid.hpp"
#include "swirl/statistics/block_average.hpp"

namespace swirl {

/// What a grid reports at each point, in this order.
inline constexpr std::array field_quantities{
    &quantity("fields.density"),
    &quantity("fields.packing"),
    &quantity("fields.momentum_x"),
    &quantity("fields.momentum_y"),
    &quantity("fields.u_x"),
    &quantity("fields.u_y"),
    &quantity("fields.temperature"),
    &quantity("fields.spin_density"),
    &quantity("fields.spin"),
    &quantity("fields.spin_temperature"),
    &quantity("fields.vorticity"),
    &quantity("fields.divergence"),
    &quantity("fields.strain_xx"),
    &quantity("fields.strain_xy"),
    &quantity("fields.spin_gradient_x"),
    &quantity("fields.spin_gradient_y"),
    &quantity("fields.pressure"),
    &quantity("fields.kinetic_xx"),
    &quantity("fields.kinetic_xy"),
    &quantity("fields.kinetic_yy"),
    &quantity("fields.collisional_xx"),
    &quantity("fields.collisional_xy"),
    &quantity("fields.collisional_yx"),
    &quantity("fields.collisional_yy"),
    &quantity("fields.torque"),
    &quantity("fields.kinetic_couple_x"),
    &quantity("fields.kinetic_couple_y"),
    &quantity("fields.collisional_couple_x"),
    &quantity("fields.collisional_couple_y"),
    &quantity("fields.dissipation"),
    &quantity("fields.wall_force_x"),
    &quantity("fields.wall_force_y"),
    &quantity("fields.floor_force_x"),
    &quantity("fields.floor_force_y"),
};
using FieldValues = std::array<double, field_quantities.size()>;

/// The sums at one point.
struct FieldPoint {
    // W times these, of every disc: 1, m, m v (2), m v v (xx, xy, yy), I, I ω, I ω², I ω v (2), π
    // R², floor force (2).
    static constexpr std::size_t disc_values = 15;
    // ∇W times these: m, m v (2), I, I ω.
    static constexpr std::size_t disc_slopes = 5;

    std::array<double, disc_values> values{};
    std::array<double, disc_slopes> slopes_x{}, slopes_y{};
    // Stress (xx, xy, yx, yy), couple stress (2), loss, wall force (2).
    std::array<double, 9> collisions{};

    void add(const FieldPoint& other, double factor = 1.0);
};

/// The numbers and the time by which the sums of a point are divided.
struct FieldWeights {
    double samples = 0.0;
    double forces = 0.0;    // samples with a known force of the floor
    double duration = 0.0;  // time covered by the collisions

    void add(const FieldWeights& other, double factor = 1.0) {
        samples += factor * other.samples;
        forces += factor * other.forces;
        duration += factor * other.duration;
    }
};

FieldValues field_values(const FieldPoint& sums, const FieldWeights& weights);

class FieldGrid {
  public:
    static constexpr std::size_t max_groups = 16;

    FieldGrid() = default;
    FieldGrid(const SquareGrid& grid, const CoarseKernel& kernel)
        : grid_(grid), kernel_(kernel), open_(grid.cells()) {}

    const SquareGrid& grid() const { return grid_; }
    const CoarseKernel& kernel() const { return kernel_; }

    /// One sample consists of all its discs and one add_sample(). If the force of the floor is not
    /// known, it must be 0 for all discs.
    void add(const FieldDisc& disc);
    void add_sample(bool force_is_known) {
        open_.weights.samples += 1.0;
        if (force_is_known) open_.weights.forces += 1.0;
    }
    void add(const Transfer& collision);

    /// Call this at the end of a period.
    void close_period();
    /// Call this after close_period(). `duration` is the time in which the collisions of that
    /// period happened; 0 if it is unknown.
    void close_events(double duration);

    /// All fields at one point.
    std::array<Estimate, std::tuple_size_v<FieldValues>> estimates(std::size_t cell) const;

    /// The other must have the same grid and kernel.
    void merge(const FieldGrid& other);
    template <class Visitor>
    void fields(Visitor&& visit) {
        visit(grid_.side, grid_.half_width, kernel_.width, open_, groups_, merged_);
        visit(periods_per_group_, periods_in_last_);
    }
    bool is_consistent() const {
        const auto fits = [&](const Sums& sums) { return sums.points.size() == grid_.cells(); };
        for (const auto* groups : {&groups_, &merged_})
            for (const Sums& sums : *groups)
                if (!fits(sums)) return false;
        return fits(open_) && grid_.side < 10000 && groups_.size() < max_groups;
    }

  private:
    struct Sums {
        Sums() = default;
        explicit Sums(std::size_t cells) : points(cells) {}
        void add(const Sums& other);
        template <class Visitor>
        void fields(Visitor&& visit) {
            visit(weights, points);
        }
        FieldWeights weights;
        std::vector<FieldPoint> points;
    };
    template <class Visit>
    void for_each_row(const Vec2& low, const Vec2& high, const Vec2& origin,
                      const Visit& visit) const;
    static void join_neighbours(std::vector<Sums>& groups);

    SquareGrid grid_;
    CoarseKernel kernel_;
    Sums open_;                 // the open period
    std::vector<Sums> groups_;  // this run's, in order of time
    std::vector<Sums> merged_;  // those of merged runs
    std::int64_t periods_per_group_ = 1, periods_in_last_ = 0;
};

}  // namespace swirl
