// The plan of a sweep: the product of lists of parameters, with some replicas of each; or a table
// of points, each with its own number of replicas (point_table.hpp).
//
// Growth. A plan accepts further values of its parameters, further replicas and further
// measurements. Existing points keep their numbers and results; new points get the next numbers.
// Measurements need the running simulation. With further measurements, all points are therefore run
// again with the same seeds (bitwise identical) in DIR/results-2, -3, …; the old results stay.
//
// Chain. With a chain along a parameter, each combination of the other parameters and replica is
// one chain: its points in ascending order of the parameter, then in descending order. Each starts
// from the final state of the one before it. A point of a plan is then a combination, a direction
// and a replica, the last varying fastest.
//
// Order. Points are numbered with the parameters in the order of `swirl run --help`; the last one
// and then the replica vary fastest. The seed of a point is computed from its resolved parameters,
// its replica and the seed of the plan. It does not depend on the number of the point, on threads
// or machines, or on the other points of the sweep.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "swirl/run/parameters.hpp"

namespace swirl {

inline constexpr std::int64_t max_replicas = 1'000'000, max_frames = 1'000'000;

struct SweepAxis {
    std::string name;
    std::vector<std::string> values;
    bool operator==(const SweepAxis&) const = default;
};

/// The size of a plan before it grew: the number of values of each axis, and of replicas; or the
/// replicas of each row of a table.
struct SweepStage {
    std::vector<std::size_t> values;
    std::int64_t replicas = 1;
    std::vector<std::int64_t> row_replicas = {};
    bool operator==(const SweepStage&) const = default;
};

/// The target of an adaptive map. It needs only some points of the product of the axes
/// (map_search.hpp); `replicas` is the maximum at one point.
struct MapTarget {
    std::string x, y = {};              // axes; y is empty for a curve
    std::string of = "mean_by_time";    // a rotation rate, a measured number, or N_c
    std::string rate = "mean_by_time";  // rotation rate whose sign change is N_c
    double level = 0.0;                 // the map is refined where the quantity crosses it
    double change = 0.0;                // and where neighbours differ by more than this; 0: nowhere
    double tolerance = 0.5;             // target standard error of N_c
    bool operator==(const MapTarget&) const = default;
    bool is_of_crossing() const { return of == "N_c"; }
};

struct SweepPlan {
    std::vector<SweepAxis> axes;  // the given parameters, in the order of the table
    std::int64_t replicas = 1;    // the largest of row_replicas for a table
    /// For a table of points, the replicas of each row. The axes are then the columns of the table,
    /// and an empty value is a parameter that its row does not give.
    std::vector<std::int64_t> row_replicas = {};
    /// The parameters that a table was given for all of its rows. They are columns, too, and rows
    /// that are added later get them.
    ParameterTexts common = {};
    std::vector<std::string> measure;  // measurements of every run (measurements.hpp)
    int frames = 0;                    // frames per period of every trajectory; 0: none
    bool series = false;               // write the table of the periods of every run
    /// The parameter along which each run starts from the end of its neighbour; "" for none.
    std::string chain = {};
    int generation = 1;  // increases with every addition of measurements
    std::vector<SweepStage> before = {};
    std::optional<MapTarget> map = {};  // only for an adaptive map
    /// Only for a search for N_c (search_folder.hpp), which chooses points, seeds and lengths of
    /// runs.
    bool search = false;
    /// For each point, its index in the product of the axes (of a table: its row), with the replica
    /// varying fastest. Empty if the index is the number of the point. Follows from the other
    /// members.
    std::vector<std::size_t> product_indices = {};

    const char* kind() const { return map ? "map" : search ? "search for N_c" : "sweep"; }
    /// The command that works on the plan.
    const char* command() const { return map ? "map" : search ? "crossing" : "sweep"; }
    bool needs_all_points() const { return !map && !search; }
    /// True if the points are chosen among the numbers of discs: not all of them must be possible.
    bool searches_numbers() const { return search || (map && map->is_of_crossing()); }
    /// The axis of this name, or null.
    const SweepAxis* axis(std::string_view name) const;
    bool is_table() const { return !row_replicas.empty(); }
    /// The number of combinations of the axes, or of rows of the table.
    std::size_t rows() const;
    std::size_t points() const;
    std::size_t product_index(std::size_t point) const {
        return product_indices.empty() ? point : product_indices[point];
    }
    /// The parameters of a point, without its seed.
    ParameterTexts parameters(std::size_t point) const;
    ParameterTexts parameters_of_row(std::size_t row) const;
    std::int64_t replica(std::size_t point) const;
    /// A chain passes each point twice: first with rising, then with falling values.
    std::size_t directions() const { return chain.empty() ? 1 : 2; }
    /// "up" or "down"; "" without a chain.
    const char* direction(std::size_t point) const;
    /// The configuration with its seed. Throws UsageError.
    RunConfig config(std::size_t point) const;
    /// The contents of plan.json, in one line.
    std::string text() const;
    bool operator==(const SweepPlan&) const = default;
};

/// Reads "5:48", "0:0.25:1" (from : step : to), "0.1,0.5,1", or one value. Throws UsageError.
std::vector<std::string> list_of_values(std::string_view name, std::string_view text);

/// Each text may be a list. Throws UsageError, also for a value with which a point cannot be run,
/// and for two values that give the same run.
SweepPlan make_plan(const ParameterTexts& given, std::int64_t replicas);

/// The same before validate(), for a plan that is not complete yet.
SweepPlan plan_of_lists(const ParameterTexts& given, std::int64_t replicas);

/// The plan with further values, replicas and measurements; 0 replicas and no measurements leave
/// them unchanged. Throws UsageError for parameters that the plan does not have.
SweepPlan grown(const SweepPlan& plan, const ParameterTexts& more, std::int64_t replicas,
                const std::vector<std::string>& measure);

/// The same for values of axes that the plan has.
SweepPlan with_values(const SweepPlan& plan, const std::vector<SweepAxis>& more,
                      std::int64_t replicas, const std::vector<std::string>& measure);

/// A plan that was extended, with the measurements added and the earlier stage noted.
SweepPlan extended(const SweepPlan& plan, SweepPlan larger,
                   const std::vector<std::string>& measure);

/// Equal for equal runs: the seed has no effect if the initial state is given.
std::uint64_t identity_of(RunConfig config);

/// Throws UsageError for a value with which a point cannot be run, and for equal runs.
void validate(const SweepPlan& plan);

/// The same for everything else in a plan: measurements, recordings, chain and map. Plans of the
/// command line, of Python and of files are validated by these two functions.
void validate_extras(const SweepPlan& plan);

/// Throws UsageError if the value of the option ("--replicates") is outside the range.
void validate_whole_number(const char* option, std::int64_t value, std::int64_t least,
                           std::int64_t most);

/// The indices of an axis's values, the numbers ascending; as they are if a value is no number.
std::vector<std::size_t> ascending_order(const SweepAxis& axis);

/// "--mu 0.3" for each of these parameters that has several values in the plan.
std::vector<std::string> varied_options(const SweepPlan& plan, const ParameterTexts& parameters);

/// The plan of a folder; throws FileError if there is none.
SweepPlan read_plan(const std::filesystem::path& folder);
/// Creates the folder and writes the plan. Throws Failure if the folder holds a plan other than
/// this one and the one that it has grown from.
void write_plan(const std::filesystem::path& folder, const SweepPlan& plan,
                const SweepPlan* grown_from = nullptr);

}  // namespace swirl
