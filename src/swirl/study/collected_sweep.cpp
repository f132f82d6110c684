#include "swirl/study/collected_sweep.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "swirl/io/checksum.hpp"
#include "swirl/io/file_error.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/measurements.hpp"
#include "swirl/run/parallel_for.hpp"
#include "swirl/statistics/replicates.hpp"
#include "swirl/study/crossing.hpp"
#include "swirl/study/hysteresis.hpp"
#include "swirl/study/point_result.hpp"
#include "swirl/study/sweep_folder.hpp"

namespace swirl {
namespace {

namespace fs = std::filesystem;

/// Indices of the combinations of parameters in the order of the table: that of the values as
/// given. If the plan has grown, axes of numbers are sorted.
std::vector<std::size_t> rows_of(const SweepPlan& plan) {
    std::vector<std::size_t> rows{0};
    if (plan.is_table()) {
        rows.resize(plan.rows());
        std::iota(rows.begin(), rows.end(), std::size_t{0});
        return rows;
    }
    for (const SweepAxis& axis : plan.axes) {
        std::vector<std::size_t> order(axis.values.size());
        std::iota(order.begin(), order.end(), std::size_t{0});
        if (!plan.before.empty()) order = ascending_order(axis);
        std::vector<std::size_t> longer;
        longer.reserve(rows.size() * order.size());
        for (const std::size_t row : rows)
            for (const std::size_t k : order) longer.push_back(row * order.size() + k);
        rows = std::move(longer);
    }
    return rows;
}

/// Steady if all replicas are, otherwise the worst verdict.
std::string worst_verdict(const std::vector<const PointResult*>& replicas) {
    for (const char* candidate : {"drifting", "jumping", "switching", "too short to tell"})
        for (const PointResult* r : replicas)
            if (r->verdict == candidate) return candidate;
    return replicas.front()->verdict;
}

/// In the order of the points.
std::vector<PointResult> read_results(const fs::path& folder, const SweepPlan& plan) {
    const std::vector<bool> done =
        numbered_files(part_of_sweep(folder, "results", plan), ".json", plan.points());
    std::vector<PointResult> results(plan.points());
    constexpr std::size_t batch = 256;
    parallel_for((results.size() + batch - 1) / batch, [&](std::size_t b) {
        for (std::size_t p = b * batch; p < std::min(results.size(), (b + 1) * batch); ++p)
            if (done[p]) results[p] = read_result(folder, plan, p);
    });
    return results;
}

struct CollectedQuantity {
    std::string name;
    bool is_direction = false;
};

/// The quantities of the sweep: those of the first result.
std::vector<CollectedQuantity> quantities_of(const std::vector<PointResult>& results) {
    std::vector<CollectedQuantity> quantities;
    const auto first =
        std::find_if(results.begin(), results.end(), [](const PointResult& r) { return r.exists; });
    if (first == results.end()) {
        for (const auto& [name, words] : rotation_rates) quantities.push_back({name});
        return quantities;
    }
    for (const MeasuredNumber& number : first->quantities)
        quantities.push_back({number.name, number.direction});
    return quantities;
}

/// True if the length in periods is a parameter, so that it needs no further column.
bool gives_periods(const SweepPlan& plan) {
    return std::any_of(plan.axes.begin(), plan.axes.end(),
                       [](const SweepAxis& axis) { return axis.name == "periods"; });
}

std::vector<std::string> columns_of(const SweepPlan& plan,
                                    const std::vector<CollectedQuantity>& quantities) {
    std::vector<std::string> columns;
    for (const SweepAxis& axis : plan.axes) columns.push_back(axis.name);
    if (!plan.chain.empty()) columns.emplace_back("direction");
    columns.emplace_back("replicates");
    if (!gives_periods(plan)) columns.emplace_back("periods");
    columns.insert(columns.end(), {"short_runs", "energy", "steady_state", "scatter"});
    for (const CollectedQuantity& quantity : quantities) {
        columns.push_back(quantity.name);
        columns.push_back(quantity.name + "_error");
    }
    columns.push_back("state_hash");
    return columns;
}

/// Empty if a row of a table does not give the parameter.
std::string text_in(const ParameterTexts& texts, const std::string& name) {
    const auto found = texts.find(name);
    return found == texts.end() ? std::string() : found->second;
}

/// The state hash of a single replica, or a checksum of those of all replicas.
std::string combined_hash(const std::vector<const PointResult*>& replicas) {
    std::string hashes;
    for (const PointResult* r : replicas) hashes += r->state_hash;
    return replicas.size() == 1 ? hashes : fmt::format("{:016x}", checksum(hashes));
}

void add_row(CollectedSweep& collected, const SweepPlan& plan, const ParameterTexts& texts,
             const std::vector<CollectedQuantity>& quantities,
             const std::vector<const PointResult*>& replicas) {
    std::vector<Table::Cell> row;
    for (const SweepAxis& axis : plan.axes) row.push_back(cell_of(text_in(texts, axis.name)));
    if (!plan.chain.empty()) row.emplace_back(texts.at("direction"));
    const auto n = static_cast<double>(replicas.size());
    double periods = 0.0, energy = 0.0;
    std::vector<double> lengths;
    std::int64_t short_runs = 0;
    for (const PointResult* r : replicas) {
        periods += r->periods / n;
        energy += r->energy / n;
        lengths.push_back(r->averaged_periods);
        short_runs += r->averaged_periods < min_averaged_periods ? 1 : 0;
    }
    const std::vector<double> by_time = replicate_weights(lengths, true),
                              by_event = replicate_weights(lengths, false);
    if (short_runs > 0) ++collected.with_short_runs;
    const std::string verdict = worst_verdict(replicas);
    collected.not_steady += verdict == "steady" ? 0 : 1;
    row.emplace_back(std::int64_t(replicas.size()));
    if (!gives_periods(plan)) row.emplace_back(periods);
    row.emplace_back(short_runs);
    row.emplace_back(energy);
    row.emplace_back(verdict);
    const std::size_t scatter_column = row.size();
    row.emplace_back(not_available);
    collected.rows.push_back({texts});
    for (std::size_t k = 0; k < quantities.size(); ++k) {
        const auto& [name, is_direction] = quantities[k];
        std::vector<Estimate> estimates;
        for (const PointResult* r : replicas) estimates.push_back(r->quantity(k, name));
        const std::vector<double>& weights = name.ends_with("by_event") ? by_event : by_time;
        const Ensemble together =
            is_direction ? several_directions(estimates, weights) : ensemble(estimates, weights);
        row.emplace_back(together.estimate.mean);
        row.emplace_back(together.estimate.error);
        if (k < rotation_rates.size()) collected.rows.back().rotation[k] = together.estimate;
        if (name != rotation_rates[default_rate].name) continue;
        row[scatter_column] = together.scatter;
        collected.disagreeing += together.disagree ? 1 : 0;
    }
    row.emplace_back(combined_hash(replicas));
    collected.table.add(std::move(row));
}

}  // namespace

/// A path or sizes from a file are identified by a checksum.
Table::Cell cell_of(const std::string& text) {
    for (const std::string_view word : {"points", "list"})
        if (text.starts_with(std::string(word) + ' '))
            return fmt::format("{}-{:016x}", word, checksum(text));
    if (const auto whole = read_whole_number(text)) return *whole;
    if (const auto number = read_number(text)) return *number;
    return text;
}

CollectedSweep collect_sweep(const fs::path& folder, const SweepPlan& plan) {
    const std::vector<PointResult> results = read_results(folder, plan);
    const std::vector<CollectedQuantity> quantities = quantities_of(results);
    CollectedSweep collected{.table = Table(columns_of(plan, quantities))};
    for (const PointResult& result : results) {
        if (!result.exists) continue;
        if (!result.has_whole_period) ++collected.without_period;
        collected.versions.insert(result.version);
    }
    // The replicas of a combination and direction have ascending numbers.
    std::vector<std::vector<std::size_t>> points(plan.rows() * plan.directions());
    for (std::size_t p = 0; p < results.size(); ++p)
        points[plan.product_index(p) / std::size_t(plan.replicas)].push_back(p);
    for (const std::size_t row : rows_of(plan))
        for (std::size_t direction = 0; direction < plan.directions(); ++direction) {
            const std::vector<std::size_t>& here = points[row * plan.directions() + direction];
            std::vector<const PointResult*> replicas;
            for (const std::size_t p : here)
                if (results[p].exists) replicas.push_back(&results[p]);
            if (replicas.empty()) continue;
            ParameterTexts texts = plan.parameters(here.front());
            if (!plan.chain.empty()) texts["direction"] = plan.direction(here.front());
            add_row(collected, plan, texts, quantities, replicas);
        }
    if (plan.chain.empty()) return collected;
    for (const CollectedQuantity& quantity : quantities)
        if (!quantity.is_direction) collected.loop_quantities.push_back(quantity.name);
    collected.loops = loop_areas(plan, results, collected.loop_quantities);
    return collected;
}

std::string disagreement_warning(std::int64_t count, const std::string& of_what) {
    return fmt::format(
        "at {} of {}, the replicates scatter more than the errors within the runs explain; the "
        "errors given are those between the replicates.",
        count, of_what);
}

std::vector<std::string> warnings(const CollectedSweep& collected) {
    std::vector<std::string> all;
    if (collected.disagreeing > 0)
        all.push_back(
            disagreement_warning(std::int64_t(collected.disagreeing),
                                 fmt::format("{} rows (column scatter)", collected.rows.size())));
    if (collected.without_period > 0)
        all.push_back(
            fmt::format("{} of the runs completed no whole period after the warm-up and "
                        "{} no averages.\nhint: use more --events.",
                        collected.without_period, collected.without_period == 1 ? "has" : "have"));
    if (collected.with_short_runs > 0)
        all.push_back(fmt::format(
            "{} of {} rows have runs with fewer than {:.0f} periods after the warm-up (column "
            "short_runs), which count only where no run is longer.",
            collected.with_short_runs, collected.rows.size(), min_averaged_periods));
    if (collected.not_steady > 0)
        all.push_back(
            fmt::format("steady state not verified in {} of {} rows (column steady_state).",
                        collected.not_steady, collected.rows.size()));
    if (collected.versions.size() > 1)
        all.push_back(
            fmt::format("the runs were made by different versions of swirl ({}), whose "
                        "trajectories may differ.\nhint: see CHANGELOG.md.",
                        fmt::join(collected.versions, ", ")));
    return all;
}

Table crossings_in(const SweepPlan& plan, const CollectedSweep& collected) {
    std::vector<std::string> others;
    for (const SweepAxis& axis : plan.axes)
        if (axis.name != "discs") others.push_back(axis.name);
    const bool varies_discs = others.size() < plan.axes.size();
    if (!varies_discs)
        throw UsageError(
            "the crossings are sign changes with the number of discs, but --discs is not a "
            "parameter of this sweep.");
    if (!plan.chain.empty()) others.emplace_back("direction");
    const auto config_of = [&](const CollectedRow& row) {
        ParameterTexts texts = row.parameters;
        if (!plan.chain.empty()) texts.erase("direction");  // up or down
        return resolve(texts);
    };
    std::vector<ParameterTexts> groups;  // sorted like the rows
    std::map<ParameterTexts, RotationCurves> curves;
    for (const CollectedRow& row : collected.rows) {
        const RunConfig config = config_of(row);
        ParameterTexts group = row.parameters;
        group.erase("discs");
        RotationCurves& all = curves[group];
        if (all.front().empty()) {
            groups.push_back(group);
            require_crossing(config);
        }
        const double discs = double(config.discs);
        for (std::size_t r = 0; r < all.size(); ++r)
            all[r].push_back({discs, row.rotation[r].mean, row.rotation[r].error});
    }
    std::vector<std::string> columns = others;
    for (const std::string& name : crossing_columns()) columns.push_back(name);
    columns.emplace_back("points");
    Table table(columns);
    for (const ParameterTexts& group : groups) {
        std::vector<Table::Cell> row;
        for (const std::string& name : others) row.push_back(cell_of(text_in(group, name)));
        const RotationCurves& all = curves.at(group);
        add_crossings(row, find_crossings(all), default_rate);
        row.emplace_back(std::int64_t(all.front().size()));
        table.add(std::move(row));
    }
    return table;
}

}  // namespace swirl
