#include "swirl/paper/results.hpp"

#include "swirl/run/report.hpp"

namespace swirl {

bool failed(const Json& result) { return result.is_object() && result.contains("failed"); }

const Json& at(const Json& result, std::initializer_list<std::string_view> path) {
    static const Json nothing;
    const Json* here = &result;
    for (const std::string_view name : path) {
        if (!here->is_object() || !here->contains(name)) return nothing;
        here = &here->at(std::string(name));
    }
    return *here;
}

double number(const Json& value) { return value.is_number() ? value.get<double>() : not_available; }

Table::Cell whole(const Json& value) {
    if (value.is_number_integer()) return value.get<std::int64_t>();
    return not_available;
}

std::string mean_in_words(const Json& average) {
    return with_error(number(at(average, {"mean"})), number(at(average, {"error"})));
}

void add_mean(std::vector<Table::Cell>& row, const Json& average) {
    for (const char* part : {"mean", "error"}) row.emplace_back(number(at(average, {part})));
}

std::vector<std::string> rotation_columns() {
    return joined(
        number_columns({"by_event", "by_time", "rigid_by_event", "rigid_by_time"}),
        {"effective_samples", "events", "periods", "warmup_periods", "steady_state", "point",
         "seeds", "averaged_runs", "steady_runs", "drifting_runs", "jumping_runs", "switching_runs",
         "too_short_to_average", "scatter", "seeds_disagree", "seed", "state_hash"});
}

void add_rotation(std::vector<Table::Cell>& row, const Json& r) {
    for (const char* average : {"by_event", "by_time", "rigid_by_event", "rigid_by_time"})
        add_mean(row, at(r, {"rotation", average}));
    row.emplace_back(number(at(r, {"rotation", "by_event", "effective_samples"})));
    row.push_back(whole(at(r, {"events", "total"})));
    row.emplace_back(number(at(r, {"periods"})));
    row.push_back(whole(at(r, {"warmup", "periods"})));
    row.emplace_back(steadiness(r));
    row.emplace_back(name_of_point(r));
    row.push_back(whole(at(r, {"seeds", "runs"})));
    row.push_back(averaged_runs(r));
    for (const char* count : {"steady", "drifting", "jumping", "switching", "too_short_to_average"})
        row.push_back(whole(at(r, {"seeds", count})));
    row.emplace_back(number(at(r, {"seeds", "scatter"})));
    row.emplace_back(std::int64_t{at(r, {"seeds", "disagree"}) == true});
    row.push_back(whole(at(r, {"config", "seed"})));
    const Json& hash = at(r, {"state_hash"});
    row.emplace_back(hash.is_string() ? hash.get<std::string>() : "");
}

Table::Cell averaged_runs(const Json& r) { return whole(at(r, {"seeds", "averaged"})); }

std::string name_of_point(const Json& result) {
    const Json& name = at(result, {"point"});
    return name.is_string() ? name.get<std::string>() : "";
}

std::string steadiness(const Json& result) {
    const Json& verdict = at(result, {"steady_state", "verdict"});
    return verdict.is_string() ? verdict.get<std::string>() : "failed";
}

void add_estimate(std::vector<Table::Cell>& row, const Estimate& estimate) {
    row.emplace_back(estimate.mean);
    row.emplace_back(estimate.error);
}

std::vector<std::string> number_columns(const std::vector<std::string>& quantities) {
    std::vector<std::string> columns;
    for (const std::string& quantity : quantities) {
        // Without "=" or ".", find() gives npos, and npos + 1 is 0: the whole name.
        const std::size_t renamed = quantity.find('=');
        const std::string column =
            quantity.substr((renamed == quantity.npos ? quantity.find('.') : renamed) + 1);
        columns.push_back(column);
        columns.push_back(column + "_error");
    }
    return columns;
}

void add_numbers(std::vector<Table::Cell>& row, const std::vector<std::string>& quantities,
                 const Json& result) {
    for (const std::string& quantity : quantities) {
        const std::size_t dot = quantity.find('.');
        const std::string measurement = quantity.substr(0, dot);
        const std::string name = quantity.substr(dot + 1, quantity.find('=') - dot - 1);
        const Json& value = at(result, {"measured", measurement, name});
        if (value.is_number()) {  // a number without an error
            row.emplace_back(number(value));
            row.emplace_back(0.0);
            continue;
        }
        add_mean(row, value);
    }
}

std::vector<std::string> joined(std::vector<std::string> front,
                                const std::vector<std::string>& back) {
    front.insert(front.end(), back.begin(), back.end());
    return front;
}

}  // namespace swirl
