#include "swirl/run/json.hpp"
#include "swirl/measure/rotation_fluctuations.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "swirl/run/config.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/parse_json.hpp"
#include "swirl/run/report.hpp"
#include "swirl/run/version.hpp"

namespace swirl {

using Json = nlohmann::ordered_json;

namespace {

/// An object with room for its entries. Otherwise they are copied whenever it grows.
Json object_of(std::size_t entries) {
    Json::object_t object;
    object.reserve(entries);
    return object;
}

Json counts_json(const EventCounts& counts) {
    Json json = {{"total", counts.total()},
                 {"disc_disc", counts.disc_disc},
                 {"disc_wall", counts.disc_wall},
                 {"path_vertex", counts.path_vertex},
                 {"elastic_by_tc_model", counts.elastic_by_tc}};
    if (counts.begins_to_roll > 0) json["begins_to_roll"] = counts.begins_to_roll;
    return json;
}

/// COUNT:RADIUS:MASS or SHARE%:RADIUS:MASS. The values are not checked here.
std::string mixture_text(const Json& mixture) {
    const auto part = [&](const char* name) { return mixture.value(name, Json()).dump(); };
    const std::string count = mixture.contains("percent") ? part("percent") + "%" : part("count");
    return fmt::format("{}:{}:{}", count, part("radius"), part("mass"));
}

struct ToJson {
    Json operator()(std::monostate) const { return nullptr; }
    Json operator()(const Mixture& m) const {
        Json json{{"count", m.count}, {"radius", m.radius}, {"mass", m.mass}};
        if (m.percent) json["percent"] = *m.percent;
        return json;
    }
    Json operator()(const auto& number_or_word) const { return number_or_word; }
};

}  // namespace

Json config_json(const RunConfig& config) {
    Json json = object_of(run_parameters.size());
    for (const Parameter& p : run_parameters) {
        if (!p.is_written()) continue;
        const ParameterValue value = value_of(p, config);
        if (p.is_omitted(value)) continue;
        json[p.name] = std::visit(ToJson(), value);
    }
    return json;
}

std::string config_text(const RunConfig& config) { return config_json(config).dump(); }

ParameterTexts parameters_in(const std::string& config) {
    const Json json = parse_json(config);
    if (!json.is_object()) throw UsageError("it does not contain the configuration of a run.");
    return parameters_in(json);
}

ParameterTexts parameters_in(const Json& config) {
    ParameterTexts texts;
    for (const auto& [name, value] : config.items()) {
        const Parameter* const p = find_parameter(name);
        if (value.is_null() || (p && p->is_derived)) continue;
        if (value.is_object())
            texts[name] = mixture_text(value);
        else
            texts[name] = value.is_string() ? value.get<std::string>() : value.dump();
    }
    // Configurations of 0.1.0 omit the floor where spheres have none.
    if (const auto body = texts.find("body"); body != texts.end() && body->second == "sphere")
        texts.try_emplace("floor", "none");
    return texts;
}

Json estimate_json(const Estimate& e) {
    Json json = object_of(8);  // callers add some
    json["mean"] = e.mean;
    json["error"] = e.error;
    json["effective_samples"] = e.effective_samples;
    json["blocks"] = e.blocks;
    return json;
}

Json row_json(const ReportRow& row) {
    if (!row.has_error) return row.estimate.mean;
    Json json = estimate_json(row.estimate);
    for (const ReportDetail& detail : row.details) json[detail.name] = detail.value;
    return json;
}

namespace {

/// {"n_variance": {"mean", "error"}, …}
Json fluctuations_json(const Fluctuations& fluctuations, double discs) {
    Json json = Json::object();
    for (const FluctuationRow& row : fluctuation_rows) {
        const bool is_variance = row.quantity == &Fluctuations::variance;
        const Estimate e = scaled(fluctuations.*row.quantity, is_variance ? discs : 1.0);
        json[row.rigid->key()] = {{"mean", e.mean}, {"error", e.error}};
    }
    return json;
}

}  // namespace

Json units_json(const MeasuredUnits& units) {
    return {{"r", units.r}, {"v", units.v}, {"m", units.m}};
}

Json series_json(const PeriodSeries& series) {
    Json averages = Json::object();
    for (const SeriesAverage& average : series.averages()) {
        Json& json = averages[average.name] = estimate_json(average.estimate);
        json["autocorrelation_time"] = average.autocorrelation_time;
        json["unit"] = average.unit;
        // During a ramp, the fluctuations would contain the changes of the parameter.
        if (!series.has_ramps())
            json["fluctuations"] = fluctuations_json(average.fluctuations, series.discs());
    }
    return {{"periods", series.periods()}, {"averages", averages}};
}

Json result_json(const RunResult& r) {
    Json json = object_of(32);
    json["format"] = result_format;
    json["config"] = config_json(r.config);
    json["units"] = units_json(units_of(r.config));
    json["complete"] = r.complete;
    json["events"] = counts_json(r.events);
    json["periods"] = r.periods;
    json["warmup"] = {{"periods", r.warmup}, {"events", r.warmup_events.total()}};
    json["rotation"] = object_of(rotation_rates.size());
    json["steady_state"] = {{"verdict", verdict(r.steady_state())},
                            {"found", steady_state_found(r)}};
    r.report([&](std::string_view group, const ReportRow& row) {
        (group.empty() ? json : json[std::string(group)])[row.name] = row_json(row);
    });
    json["state_hash"] = fmt::format("{:016x}", r.state_hash);
    json["seconds"] = r.seconds;
    json["events_per_second"] = r.events_per_second();
    json["simd"] = r.simd;
    json["warnings"] = warnings(r);
    json["version"] = version();
    json["build"] = build_description();
    json["generator"] = random_generator;
    return json;
}

}  // namespace swirl
