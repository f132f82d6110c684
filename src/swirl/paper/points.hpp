// The runs that the figures share: one number of discs with one pair of friction coefficients, at
// the paper's parameters. Several figures need the same point; it is run once.
#pragma once

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

#include "swirl/paper/paper.hpp"
#include "swirl/paper/paper_parameters.hpp"
#include "swirl/statistics/replicates.hpp"
#include "swirl/study/crossing.hpp"

namespace swirl {

/// N = 5 … 48; with settings.quick a selection.
std::vector<std::int64_t> numbers_of_discs(const PaperSettings& settings);
/// Fewer of them, for figures beyond the paper.
std::vector<std::int64_t> sparse_numbers(const PaperSettings& settings);
/// N = 49 … 55, more discs than in the paper.
std::vector<std::int64_t> numbers_beyond(const PaperSettings& settings);
/// N = 24 … 55 of spheres; with settings.quick a selection. 57 fit, but with 56 and 57 the initial
/// packing decides, not friction, and some runs collapse.
std::vector<std::int64_t> numbers_of_spheres(const PaperSettings& settings);
/// N = 24 … 48, the numbers of the experiment.
std::vector<std::int64_t> numbers_of_the_experiment(const PaperSettings& settings);

/// The paper's 10^6 events and the first seed of the study; all else has its default. Spheres get a
/// length in periods: a few dozen lose the memory of their initial state in about 50 periods.
RunConfig paper_config(const PaperSettings& settings, const Friction& friction, std::int64_t discs);

/// Rotation only.
PaperPoint point(const PaperSettings& settings, const Friction& friction, std::int64_t discs);
/// The same runs, with all measurements that the figures need. Only the two numbers of discs of
/// Figures 2 and 5 have maps.
PaperPoint measured_point(const PaperSettings& settings, const Friction& friction,
                          std::int64_t discs);

/// A point of a figure with several settings.
struct SettingPoint {
    std::size_t setting;
    std::int64_t discs;
};
/// Discs at the numbers of the experiment, spheres at numbers_of_spheres().
std::vector<SettingPoint> points_of(const PaperSettings& settings,
                                    const std::vector<Friction>& frictions);

/// Lengths in periods for more discs than in the paper, where states last longer and a period has
/// more events.
void set_dense_length(RunConfig& config, const PaperSettings& settings);
PaperPoint dense_point(const PaperSettings& settings, const Friction& friction, std::int64_t discs);

/// The steady state, which the paper does not show: averages over periods after a long warm-up.
/// With μ_d = 0 only the wall changes a disc's spin, which takes about 100 periods. So the warm-up
/// is 300 periods, and 100 with disc friction.
RunConfig settled_config(const PaperSettings& settings, const Friction& friction,
                         std::int64_t discs);
/// With all measurements that the figures need.
PaperPoint settled_point(const PaperSettings& settings, const Friction& friction,
                         std::int64_t discs);

/// A point at other parameters than the paper's; `name` identifies it.
PaperPoint varied_point(const PaperSettings& settings, const std::string& name,
                        const RunConfig& config, int seeds,
                        const std::vector<std::string>& measurements = {});

/// The effort of a search for N_c in a figure.
CrossingSettings search_for_crossing();
/// A task that searches for N_c, and the columns of its result.
PaperTask crossing_task(const std::string& key, const CrossingSettings& search);
std::vector<std::string> search_columns();
void add_search(std::vector<Table::Cell>& row, const Json& found);

/// A path with this many sides; 0: the circle.
void set_sides(RunConfig& config, int sides);

/// "20of80periods": warm-up and length of a run, for names.
std::string length_of(const RunConfig& config);

// --- Tasks of single runs -------------------------------------------------------------------

/// Adds one task for each seed: `work(config, control)` at consecutive seeds.
void add_seeds(FigurePlan& plan, const RunConfig& config, int seeds, const std::string& name,
               double cost, Json (*work)(const RunConfig&, const RunControl&));
/// The results of the k-th group of `seeds` tasks, without the failed ones.
std::vector<Json> results_of_seeds(const std::vector<Json>& results, std::size_t k, int seeds);

/// The mean over the runs of a number of each run. The error is that between the runs.
template <class NumberOf>
Estimate over_runs(const std::vector<Json>& runs, const NumberOf& number_of) {
    std::vector<Estimate> values;
    for (const Json& run : runs) values.push_back({.mean = number_of(run)});
    return ensemble(values).estimate;
}

}  // namespace swirl
