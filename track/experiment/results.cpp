#include "track/experiment/results.hpp"

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

void add_mean(std::vector<Table::Cell>& row, const Json& average) {
    for (const char* part : {"mean", "error"}) row.emplace_back(number(at(average, {part})));
}

std::string steadiness(const Json& result) {
    const Json& verdict = at(result, {"steady_state", "verdict"});
    return verdict.is_string() ? verdict.get<std::string>() : "failed";
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
