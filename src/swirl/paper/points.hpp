// The runs that the paper's figures share: one disc number at one pair of frictions, with the
// paper's parameters. Several figures ask for the same point; it is run once.
#pragma once

#include <cmath>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "swirl/io/table.hpp"
#include "swirl/measure/rotation_crossings.hpp"
#include "swirl/paper/paper.hpp"

namespace swirl {

/// A pair of frictions, as in Figure 5b.
struct Friction {
    const char* name;   // in tables and keys
    const char* words;  // in sentences
    double mu_disc, mu_wall;
};

// Caption of Figure 5: "When one friction is completely turned off, the other is set to 1.0."
inline constexpr Friction high_friction{"high", "high friction", 1.0, 1.0};
inline constexpr Friction medium_friction{"medium", "medium friction", 0.5, 0.5};
inline constexpr Friction low_friction{"low", "low friction", 0.1, 0.1};
inline constexpr Friction no_wall_friction{"no-wall", "no wall friction", 1.0, 0.0};
inline constexpr Friction no_disc_friction{"no-disc", "no disc friction", 0.0, 1.0};
inline constexpr Friction friction_coefficients_of_5b[] = {
    high_friction, medium_friction, low_friction, no_wall_friction, no_disc_friction};

/// N = 5 … 48; a choice of them when it must be quick.
std::vector<std::int64_t> numbers_of_discs(const PaperSettings& settings);
/// Fewer of them, for what the paper does not have.
std::vector<std::int64_t> sparse_numbers(const PaperSettings& settings);
/// N = 49 … 55: denser than the paper's. 59 discs can be placed, but from 56 on runs end in a
/// collapse by friction, after some swirls or at once.
std::vector<std::int64_t> numbers_beyond(const PaperSettings& settings);
/// N = 24 … 48, the numbers of the experiment.
std::vector<std::int64_t> numbers_of_the_experiment(const PaperSettings& settings);

/// The paper's 10^6 events, the first seed of the study, and nothing else but defaults.
RunConfig paper_config(const PaperSettings& settings, const Friction& friction, std::int64_t discs);

/// The rotation alone, for several seeds.
PaperPoint point(const PaperSettings& settings, const Friction& friction, std::int64_t discs);
/// The same runs with everything measured that the figures need; maps for the numbers of discs that
/// have some.
PaperPoint measured_point(const PaperSettings& settings, const Friction& friction,
                          std::int64_t discs);

/// More discs than the paper has: as many swirls as it takes, instead of its 10^6 events.
PaperPoint dense_point(const PaperSettings& settings, const Friction& friction, std::int64_t discs);

/// What the paper does not have, the steady state: a long warm-up is left out, and what is averaged
/// goes by swirls. With μ_d = 0 nothing but the wall changes a disc's spin, which takes of the
/// order of 100 swirls: 300 are left out, and 100 where there is disc friction (half as many when
/// quick).
RunConfig settled_config(const PaperSettings& settings, const Friction& friction,
                         std::int64_t discs);
/// Everything measured in it that the figures need.
PaperPoint settled_point(const PaperSettings& settings, const Friction& friction,
                         std::int64_t discs);

/// The same at other parameters than the paper's; `name` says which.
PaperPoint varied_point(const PaperSettings& settings, const std::string& name,
                        const RunConfig& config);

/// The numbers of discs of the maps (2b, 2c, 5c, 5d).
inline constexpr std::int64_t rotating = 28, counterrotating = 48;

// --- reading results ------------------------------------------------------------------------

/// Is it that of a run that failed?
bool failed(const nlohmann::ordered_json& result);

/// result["a"]["b"]…, or null if there is no such thing, as in the result of a run that failed.
const nlohmann::ordered_json& at(const nlohmann::ordered_json& result,
                                 std::initializer_list<std::string_view> path);

/// What JSON has as null is not known: NaN.
double number(const nlohmann::ordered_json& value);
/// The same for a cell of a table that holds a whole number.
Table::Cell whole(const nlohmann::ordered_json& value);

/// Columns of the rotation, in the order of add_rotation(); empty for a run that failed.
std::vector<std::string> rotation_columns();
void add_rotation(std::vector<Table::Cell>& row, const nlohmann::ordered_json& result);
/// How many runs its averages rest on. Their errors have one degree of freedom fewer
/// (figures/verdicts.py).
Table::Cell averaged_runs(const nlohmann::ordered_json& result);
/// The name of its point, for the claims that rest on it.
std::string name_of_point(const nlohmann::ordered_json& result);

/// "steady", "drifting", "jumping", "switching", "too short to tell", or "failed".
std::string steadiness(const nlohmann::ordered_json& result);

/// The numbers of these measurements, "slip.cluster" and so on, each with its error; the column is
/// called by what follows a "=", or else the point.
std::vector<std::string> number_columns(const std::vector<std::string>& names);
void add_numbers(std::vector<Table::Cell>& row, const std::vector<std::string>& names,
                 const nlohmann::ordered_json& result);

/// The point of a curve: "by_event" or "by_time". Not known for a run that failed, and then no
/// crossing looks at it.
RotationPoint rotation_point(double x, const nlohmann::ordered_json& result, const char* average);

/// Null, if no point has a mean.
const RotationPoint* lowest_of(std::span<const RotationPoint> curve);

/// ϖ(N) by each of rotation_rates, and which of them a figure shows.
struct NamedCurve {
    std::string name;
    std::size_t rate = default_rate;
    RotationCurves curves = {};

    void add(double discs, const nlohmann::ordered_json& result);
    const std::vector<RotationPoint>& points() const { return curves[rate]; }
};

/// "crosses zero at N = 36.4 ± 0.3 (95 %: 35.9 to 37.0; mean over the discs, by time)", "crosses
/// zero between N = 36 and 40 (…)", or "always rotates" with the lowest point; and the other rates.
/// A sentence, with its full stop.
std::string crossing_sentence(const NamedCurve& curve);

/// N_c by each of rotation_rates: "crossing_by_event", its error and its interval, and so on.
std::vector<std::string> rates_columns();

/// Where each of the curves crosses zero, or its lowest point if it does not.
void write_crossings(const std::vector<NamedCurve>& curves, const std::filesystem::path& file);

/// Columns of `front` before those of `back`.
std::vector<std::string> joined(std::vector<std::string> front,
                                const std::vector<std::string>& back);

}  // namespace swirl
