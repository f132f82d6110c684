// The runs that the chapters about size and about criticality share: discs in dishes of any size,
// with the fluctuations of their rotation from period to period.
#pragma once

#include <string>
#include <vector>

#include "swirl/measure/rotation_crossings.hpp"
#include "swirl/paper/paper.hpp"
#include "swirl/run/parameters.hpp"
#include "swirl/run/period_series.hpp"

namespace swirl {

/// A dish and its swirl, in units of the disc radius r.
struct Dish {
    double radius;         // R/r
    double amplitude;      // A/R
    bool spheres = false;  // that roll on the floor of the experiment, with μ = 0.2; else discs

    /// The number of discs with this packing fraction φ = N r²/R².
    std::int64_t discs(double packing_fraction) const;
    bool operator==(const Dish&) const = default;
};

/// The spheres of the chapters: the experiment at half the amplitude, μ = 0.2, floor friction 0.3;
/// `more` overrides these.
RunConfig spheres_of_chapters(ParameterTexts more = {});

/// Discs with μ = 1 and the paper's inertia, or spheres. The container has the speed 1 in every
/// dish.
RunConfig dish_config(const PaperSettings& settings, const Dish& dish, std::int64_t discs);

/// Runs to the end with the series, and with the observation of `control`. Throws Interrupted.
RunResult run_with_series(const RunConfig& config, RunControl control, PeriodSeries& series);

/// A run with measurements, and with the rows of measured.fluctuations (fluctuations()).
Json fluctuating_run(const RunConfig& config, const std::vector<std::string>& measurements,
                     const RunControl& control);
/// The point of such runs; `name` identifies it.
PaperPoint fluctuating_point(const PaperSettings& settings, const std::string& name,
                             const RunConfig& config, int seeds,
                             const std::vector<std::string>& measurements);

/// Fluctuations, over the periods of one run, of a rate ϖ/Ω with mean m.
struct PeriodFluctuations {
    double variance;     // of the mean over a period
    double correlation;  // integrated autocorrelation time, in periods
    double
        susceptibility;  // N · variance · correlation: N times the variance of a long mean, times
                         // its periods
    double binder;  // 1 − ⟨(ϖ−m)⁴⟩ / 3⟨(ϖ−m)²⟩²: 0 for one normal state, 2/3 for two equal ones
};
/// `values`: one per period.
PeriodFluctuations period_fluctuations(const std::vector<double>& values, std::int64_t discs);

/// The points of a figure over dishes and packing fractions, in the order of its results.
struct DishPoints {
    struct Point {
        Dish dish;
        std::int64_t discs;

        double packing_fraction() const {
            return static_cast<double>(discs) / (dish.radius * dish.radius);
        }
    };
    std::vector<Point> points = {};

    /// Adds a point, unless there is one with the same number of discs.
    void add(const Dish& dish, double packing_fraction);
    /// The runs of all points. The length decreases with the size of the dish.
    void plan(FigurePlan& plan, const PaperSettings& settings) const;
    /// A row for each point.
    Table table(const std::vector<Json>& results) const;
};

/// A figure whose rows are the points, and whose second table lists the changes of direction.
FigurePlan plan_dishes(const PaperSettings& settings, const std::string& name,
                       const DishPoints& points);

/// The paper's swirl, A/R = 0.22, in dishes of different sizes: the runs of figure "size".
DishPoints dishes_of_sizes(const PaperSettings& settings);

/// One change of the direction of rotation with the packing fraction, by the rate rigid_by_time.
struct DirectionChange {
    Dish dish;
    bool to_counterrotation = false;
    double packing_fraction = not_available,
           error = not_available;                               // at the zero (coarse_zero.hpp)
    double interpolation_error = not_available;                 // its part in the error
    double slope = not_available, slope_error = not_available;  // dϖ/dφ there, in Ω
    double before = not_available, after = not_available;  // φ of the points with certain signs
    // At the zero, interpolated:
    double largest = not_available;     // share of the discs in the largest touching group
    double wall = not_available;        // share of the discs that touch the wall
    double occupied = not_available;    // share of the wall that they occupy, 1 for a full layer
    double elongation = not_available;  // of the cluster
    double reach = not_available;       // (radius of the hull + distance of its centre from C) / R
    Estimate susceptibility = {}, correlation = {}, binder = {};  // as of PeriodFluctuations
};

/// The geometry of a change to counterrotation: "elongated" if the elongation of the cluster is
/// above 1.2, otherwise "wall" if discs occupy a tenth of the wall or more, otherwise "free". A
/// change back to rotation: "back".
const char* kind_of(const DirectionChange& change);

/// The changes of the curve of each dish, in the order of the points.
std::vector<DirectionChange> direction_changes(const DishPoints& points,
                                               const std::vector<Json>& results);
Table change_table(const std::vector<DirectionChange>& changes);
/// A sentence for each dish: where its direction changes, and the state of the cluster there.
std::vector<std::string> change_sentences(const DishPoints& points,
                                          const std::vector<DirectionChange>& changes);

}  // namespace swirl
