// The plan of an adaptive map: the plan of a sweep (sweep_plan.hpp) over one or two parameters, and
// over the number of discs if the quantity is N_c, with the quantity that decides where the map is
// refined.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "swirl/study/sweep_plan.hpp"

namespace swirl {

/// Default length of each run in periods, of which 20 are warm-up.
inline constexpr const char* default_map_periods = "120";

/// An axis of the map. `values` is FROM:TO, a range with `steps` values; or FROM:STEP:TO or a list,
/// as for a sweep.
struct MapAxisText {
    std::string name, values;
};

struct MapSettings {
    MapAxisText x, y = {};  // y without a name: a curve
    std::string of = "mean_by_time";
    std::string rate = "mean_by_time";  // used for N_c only
    double level = 0.0;                 // not for N_c
    std::optional<double> change = {};  // default: 2 for N_c, otherwise nowhere
    double tolerance = 0.5;             // target standard error of N_c
    std::int64_t steps = 16;            // values of a range FROM:TO
    std::int64_t max_runs = 16;         // most runs at one point
    std::int64_t from = 5, to = 48;     // numbers of discs in which N_c is searched
    ParameterTexts parameters = {};     // all others; one value each
};

/// "mu=0:1". Throws UsageError.
MapAxisText read_map_axis(const char* option, const std::string& text);

/// What a map gets in addition. Members with their default leave the map unchanged.
struct MapGrowth {
    std::vector<MapAxisText> axes = {};         // further values; an axis without a name adds none
    std::int64_t steps = 16;                    // values of a range FROM:TO
    std::optional<std::int64_t> max_runs = {};  // new maximum at one point
    std::optional<std::int64_t> from = {}, to = {};  // larger range of the searches for N_c
};

/// The plan with this growth. Throws UsageError for another axis, a smaller or invalid maximum of
/// runs, a smaller range, and a range without N_c.
SweepPlan grown_map(const SweepPlan& plan, const MapGrowth& growth);

/// Throws UsageError for an invalid range, a value that cannot be run, or an unknown quantity.
SweepPlan make_map_plan(const MapSettings& settings);

/// Throws UsageError if a plan with a MapTarget is not a map that make_map_plan() or grown_map()
/// could have made.
void validate_map(const SweepPlan& plan);

}  // namespace swirl
