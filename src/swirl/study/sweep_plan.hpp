// What a sweep is to do: the product of lists of parameters, some replicas of each.
//
// Growing. A plan takes further values of its parameters, further replicas and further
// measurements. Points keep their numbers, and with them what is done: those that are new are
// counted on from the last. What a run measures must be looked at while it goes on, so with a
// further measurement all are done again, with the same seeds and bits, in DIR/results-2, -3, …;
// what was found before stays.
//
// Order. Points are numbered with the parameters in the order of `swirl run --help`, the last one
// and then the replica running fastest. The seed of a point comes from what the point is (its
// resolved parameters, the replica, and the seed of the plan), so it does not depend on the number,
// on threads or machines, or on what else is in the sweep.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "swirl/run/parameters.hpp"

namespace swirl {

struct SweepAxis {
    std::string name;
    std::vector<std::string> values;
    bool operator==(const SweepAxis&) const = default;
};

/// How large a plan was before it grew: so many values of each axis, so many replicas.
struct SweepStage {
    std::vector<std::size_t> values;
    std::int64_t replicas = 1;
    bool operator==(const SweepStage&) const = default;
};

struct SweepPlan {
    std::vector<SweepAxis> axes;  // every parameter that was given, in order
    std::int64_t replicas = 1;
    std::vector<std::string> measure;  // measurements of every run (measurements.hpp)
    int frames = 0;                    // per swirl, of the trajectory of every run; 0: none
    int generation = 1;                // one more whenever further measurements were added
    std::vector<SweepStage> before = {};
    /// The place of every point in the product of the axes, the replica running fastest; empty: the
    /// number is the place. Follows from the rest.
    std::vector<std::size_t> places = {};

    std::size_t points() const;
    std::size_t place(std::size_t point) const { return places.empty() ? point : places[point]; }
    /// The parameters of a point, without its seed.
    ParameterTexts parameters(std::size_t point) const;
    std::int64_t replica(std::size_t point) const;
    /// With its seed. Throws WrongCall.
    RunConfig config(std::size_t point) const;
    /// As it stands in plan.json, in one line.
    std::string text() const;
    bool operator==(const SweepPlan&) const = default;
};

/// "5:48", "0:0.25:1" (from : step : to), "0.1,0.5,1", or one value. Throws WrongCall.
std::vector<std::string> list_of_values(std::string_view name, std::string_view text);

/// Texts may be lists. Throws WrongCall, also for a point that cannot be run, and for two values
/// that are the same run.
SweepPlan make_plan(const ParameterTexts& given, std::int64_t replicas);

/// What a plan becomes when further values, replicas and measurements are added to it; 0 replicas
/// and no measurements are what it has. Throws WrongCall for parameters it does not have.
SweepPlan grown(const SweepPlan& plan, const ParameterTexts& more, std::int64_t replicas,
                const std::vector<std::string>& measure);

/// The plan of a folder; throws FileError if there is none.
SweepPlan read_plan(const std::filesystem::path& folder);
/// Makes the folder and writes the plan; throws Failure if it holds another one, unless that is the
/// one it was grown from.
void write_plan(const std::filesystem::path& folder, const SweepPlan& plan,
                const SweepPlan* grown_from = nullptr);

}  // namespace swirl
