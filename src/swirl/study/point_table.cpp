#include "swirl/study/point_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <map>

#include "swirl/io/file_error.hpp"
#include "swirl/io/number_table.hpp"
#include "swirl/io/read_number.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/parameter_files.hpp"
#include "swirl/run/reading.hpp"

namespace swirl {
namespace {

constexpr const char* replicas_column = "replicates";

[[noreturn]] void reject(const std::string& where, const std::string& problem) {
    throw UsageError(where + ": " + problem);
}

/// The parameters that the headers of a file name, and `replicates`.
std::vector<std::string> names_in_header(const TextLines& lines,
                                         const std::vector<std::string>& header) {
    std::vector<std::string> known = parameter_names();
    known.emplace_back(replicas_column);
    std::vector<std::string> names;
    for (const std::string& given : header) {
        if (given.empty()) lines.fail("a column has no name");
        const auto present = present_name(in_lower_case(given), known);
        if (!present) {
            const auto meant = nearest_name(in_lower_case(given), known);
            reject(lines.position(),
                   fmt::format("there is no parameter '{}'.\nhint: {}", given,
                               meant ? fmt::format("did you mean '{}'?", *meant)
                                     : "a column is a parameter of `swirl run`, or replicates."));
        }
        const std::string name = plain_name(*present);
        if (std::find(names.begin(), names.end(), name) != names.end())
            lines.fail(fmt::format("there are two columns '{}'", name));
        names.push_back(name);
    }
    return names;
}

std::vector<PointRow> rows_in_file(TextLines& lines, std::int64_t replicas) {
    NumberTable table(lines);
    const std::vector<std::string> names = names_in_header(lines, table.names());
    std::vector<PointRow> rows;
    while (table.next()) {
        ParameterTexts cells;
        for (std::size_t k = 0; k < names.size(); ++k) cells[names[k]] = table.text(k);
        rows.push_back(point_row(lines.position(), with_file_contents(std::move(cells)), replicas));
    }
    if (rows.empty()) lines.fail_without_rows();
    return rows;
}

/// The rows with the parameters that all have in common.
void add_common(std::vector<PointRow>& rows, const ParameterTexts& common) {
    for (const auto& [given, text] : common) {
        const std::string name = plain_name(given);
        if (list_of_values(name, text).size() > 1)
            throw UsageError(fmt::format(
                "{} is a list, but with --points it must be one value for all points.\nhint: make "
                "it a column of the table.",
                option_name(name)));
        for (PointRow& row : rows)
            if (!row.parameters.emplace(name, text).second)
                throw UsageError(
                    fmt::format("{} is given, and it is also a column of --points.\nhint: omit "
                                "one of them.",
                                option_name(name)));
    }
}

bool is_same_value(const std::string& a, const std::string& b) {
    if (a == b) return true;
    const auto x = read_number(a), y = read_number(b);
    return x && y && *x == *y;
}

/// Adds the parameters that the plan has for all of its rows. A row may repeat them.
void add_common_of_plan(std::vector<PointRow>& rows, const SweepPlan& plan) {
    for (PointRow& row : rows)
        for (const auto& [name, text] : plan.common)
            if (const auto [cell, is_new] = row.parameters.emplace(name, text);
                !is_new && !is_same_value(cell->second, text))
                reject(row.where, fmt::format("{0} is {1}, but all rows of the sweep in the folder "
                                              "have {0} {2}.\nhint: use another folder.",
                                              name, cell->second, text));
}

/// A call that extends a table may repeat its common parameters, but not change or add any.
void require_common_of_plan(const ParameterTexts& given, const SweepPlan& plan) {
    for (const auto& [given_name, text] : given) {
        const std::string name = plain_name(given_name);
        const auto known = plan.common.find(name);
        if (known != plan.common.end() && is_same_value(known->second, text)) continue;
        throw UsageError(
            known != plan.common.end()
                ? fmt::format("{0} is {1}, but all rows of the sweep in the folder have {0} {2}."
                              "\nhint: use another folder.",
                              option_name(name), text, known->second)
                : fmt::format("{} is {}, but the sweep in the folder has no common value of it."
                              "\nhint: make it a column of the further points.",
                              option_name(name), text));
    }
}

/// Adds a row to the columns of the plan.
void append(SweepPlan& plan, const PointRow& row) {
    const std::size_t before = plan.row_replicas.size();
    auto column = plan.axes.begin();
    for (const Parameter& p : run_parameters) {  // the columns are in this order
        const auto given = row.parameters.find(p.name);
        const bool exists = column != plan.axes.end() && column->name == p.name;
        if (!exists && given == row.parameters.end()) continue;
        if (!exists) column = plan.axes.insert(column, {p.name, std::vector<std::string>(before)});
        column->values.push_back(given == row.parameters.end() ? "" : given->second);
        ++column;
    }
    plan.row_replicas.push_back(row.replicas);
    plan.replicas = std::max(plan.replicas, row.replicas);
}

/// The row's runs have different identities. Without a seed, the replicas need only one.
std::vector<std::uint64_t> identities_of(const SweepPlan& plan, std::size_t row) {
    const ParameterTexts texts = plan.parameters_of_row(row);
    RunConfig config = resolve(texts);
    std::vector<std::uint64_t> all{identity_of(config)};
    if (!texts.contains("seed")) return all;
    const auto more = static_cast<std::uint64_t>(plan.row_replicas[row]) - 1;
    if (config.seed > UINT64_MAX - more)
        throw UsageError(
            fmt::format("--seed is {}, but the seeds of {} replicates must be below 2^64.",
                        config.seed, plan.row_replicas[row]));
    for (std::uint64_t k = 0; k < more; ++k) {
        ++config.seed;
        all.push_back(identity_of(config));
    }
    return all;
}

SweepPlan table_plan(std::vector<PointRow> rows, const ParameterTexts& common) {
    add_common(rows, common);
    SweepPlan plan;
    for (const auto& [given, text] : common) plan.common[plain_name(given)] = text;
    std::vector<std::string> where;
    for (const PointRow& row : rows) {
        append(plan, row);
        where.push_back(row.where);
    }
    if (plan.axes.empty()) throw UsageError("the table of points has no column of a parameter.");
    validate_rows(plan, where);
    return plan;
}

/// The first run of a row, by its identity.
std::map<std::uint64_t, std::size_t> index_of_rows(const SweepPlan& plan) {
    std::map<std::uint64_t, std::size_t> index;
    for (std::size_t row = 0; row < plan.rows(); ++row)
        index.emplace(identity_of(resolve(plan.parameters_of_row(row))), row);
    return index;
}

void require_table(const SweepPlan& plan) {
    if (!plan.is_table())
        throw UsageError(fmt::format(
            "--points is given, but the folder holds a {} of lists of values.\nhint: give further "
            "values, such as --discs 49:55, or use another folder.",
            plan.kind()));
}

}  // namespace

PointRow point_row(std::string where, const ParameterTexts& cells, std::int64_t replicas) {
    PointRow row{std::move(where), cells, replicas};
    for (const auto& [name, text] : cells)
        if (text.empty())
            reject(row.where, fmt::format("{} is empty.\nhint: give each cell a value.", name));
    if (const auto seeds = row.parameters.find(replicas_column); seeds != row.parameters.end()) {
        const auto number = read_whole_number(seeds->second);
        if (!number || *number < 1 || *number > max_replicas)
            reject(row.where,
                   fmt::format("replicates is '{}', but it must be a whole number from 1 to {}.",
                               seeds->second, max_replicas));
        row.replicas = *number;
        row.parameters.erase(seeds);
    }
    return row;
}

std::vector<PointRow> read_points(const std::string& file, std::int64_t replicas) {
    const std::string text = text_of_table_file("--points", file);
    try {
        TextLines lines(fmt::format("'{}'", file), text);
        return rows_in_file(lines, replicas);
    } catch (const FileError& error) {
        throw UsageError(error.what());
    }
}

void validate_rows(const SweepPlan& plan, const std::vector<std::string>& where) {
    const auto place = [&](std::size_t row) {
        return row < where.size() ? where[row] : fmt::format("row {} of the table", row + 1);
    };
    std::map<std::uint64_t, std::size_t> seen;
    for (std::size_t row = 0; row < plan.rows(); ++row) {
        std::vector<std::uint64_t> identities;
        try {
            identities = identities_of(plan, row);
        } catch (const UsageError& error) {
            reject(place(row), error.what());
        }
        for (const std::uint64_t identity : identities)
            if (const auto [before, is_new] = seen.emplace(identity, row); !is_new)
                reject(place(row),
                       fmt::format("the run is that of {}.\nhint: omit one of them. For "
                                   "several runs of a point, use a column seeds.",
                                   place(before->second)));
    }
}

SweepPlan make_plan(std::vector<PointRow> rows, const ParameterTexts& common) {
    SweepPlan plan = table_plan(std::move(rows), common);
    return extended(plan, plan, {});
}

SweepPlan grown(const SweepPlan& plan, std::vector<PointRow> rows, const ParameterTexts& common,
                const std::vector<std::string>& measure) {
    require_table(plan);
    require_common_of_plan(common, plan);
    add_common_of_plan(rows, plan);
    const SweepPlan more = table_plan(std::move(rows), {});
    const std::map<std::uint64_t, std::size_t> index = index_of_rows(plan);
    SweepPlan larger = plan;
    for (std::size_t row = 0; row < more.rows(); ++row) {
        PointRow given{"", more.parameters_of_row(row), more.row_replicas[row]};
        const auto found = index.find(identity_of(resolve(given.parameters)));
        if (found == index.end()) {
            append(larger, given);
            continue;
        }
        std::int64_t& replicas = larger.row_replicas[found->second];
        replicas = std::max(replicas, given.replicas);
        larger.replicas = std::max(larger.replicas, replicas);
    }
    return extended(plan, std::move(larger), measure);
}

std::vector<std::vector<std::size_t>> points_of_rows(const SweepPlan& plan,
                                                     std::vector<PointRow> rows) {
    require_table(plan);
    add_common_of_plan(rows, plan);
    const std::map<std::uint64_t, std::size_t> index = index_of_rows(plan);
    std::vector<std::vector<std::size_t>> points_of_plan(plan.rows()), points;
    for (std::size_t point = 0; point < plan.points(); ++point)
        points_of_plan[plan.product_index(point) / std::size_t(plan.replicas)].push_back(point);
    for (const PointRow& row : rows) {
        const auto found = index.find(identity_of(resolve(row.parameters)));
        points.emplace_back();
        if (found != index.end()) points.back() = points_of_plan[found->second];
        points.back().resize(std::min(points.back().size(), std::size_t(row.replicas)));
    }
    return points;
}

}  // namespace swirl
