#include "swirl/run/json.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "swirl/run/report.hpp"
#include "swirl/run/version.hpp"

namespace swirl {

using Json = nlohmann::ordered_json;

namespace {

Json counts_json(const EventCounts& counts) {
    return {{"total", counts.total()},
            {"disc_disc", counts.disc_disc},
            {"disc_wall", counts.disc_wall},
            {"path_vertex", counts.path_vertex},
            {"elastic_by_tc_model", counts.elastic_by_tc}};
}

const char* word(SteadyState::Verdict verdict) {
    switch (verdict) {
        case SteadyState::Verdict::steady:
            return "steady";
        case SteadyState::Verdict::drifting:
            return "drifting";
        case SteadyState::Verdict::too_short:
            break;
    }
    return "too short to tell";
}

}  // namespace

Json config_json(const RunConfig& c) {
    Json json{{"discs", c.discs},
              {"mu_disc", c.mu_disc},
              {"mu_wall", c.mu_wall},
              {"inertia", c.inertia},
              {"mass", c.mass},
              {"radius", c.radius},
              {"mixture", nullptr},
              {"restitution", c.restitution},
              {"tangential_restitution", c.tangential_restitution},
              {"contact_duration", c.contact_duration},
              {"container_radius", c.container_radius},
              {"amplitude", c.amplitude},
              {"period", c.period},
              {"speed", container_speed(c)},
              {"omega", c.omega()},
              {"path", c.path == PathShape::circle ? "circle" : "polygon"},
              {"sides", nullptr},
              {"events", nullptr},
              {"periods", nullptr},
              {"warmup", nullptr},
              {"seed", c.seed}};
    if (c.mixture)
        json["mixture"] = Json{
            {"count", c.mixture->count}, {"radius", c.mixture->radius}, {"mass", c.mixture->mass}};
    if (c.path == PathShape::polygon) json["sides"] = c.sides;
    if (c.periods)
        json["periods"] = *c.periods;
    else
        json["events"] = c.events;
    if (c.warmup) json["warmup"] = *c.warmup;
    if (c.warmup_found) json["warmup"] = "auto";
    return json;
}

ParameterTexts parameters_in(const Json& config) {
    ParameterTexts texts;
    for (const auto& [name, value] : config.items()) {
        if (value.is_null() || name == "omega" || name == "speed") continue;  // follow from others
        std::string option = name;
        std::replace(option.begin(), option.end(), '_', '-');
        if (value.is_object())
            texts[option] = fmt::format("{}:{}:{}", value.at("count").dump(),
                                        value.at("radius").dump(), value.at("mass").dump());
        else
            texts[option] = value.is_string() ? value.get<std::string>() : value.dump();
    }
    return texts;
}

Json estimate_json(const Estimate& e) {
    return {{"mean", e.mean},
            {"error", e.error},
            {"effective_samples", e.effective_samples},
            {"blocks", e.blocks}};
}

Json result_json(const RunResult& r) {
    return {{"config", config_json(r.config)},
            {"complete", r.complete},
            {"events", counts_json(r.events)},
            {"periods", r.periods},
            {"warmup", {{"periods", r.warmup}, {"events", r.warmup_events.total()}}},
            {"rotation",
             {{"by_event", estimate_json(r.rotation.by_event)},
              {"by_time", estimate_json(r.rotation.by_time)},
              {"rigid_by_event", estimate_json(r.rotation.rigid_by_event)},
              {"rigid_by_time", estimate_json(r.rotation.rigid_by_time)}}},
            {"steady_state",
             {{"verdict", word(r.steady_state())},
              {"drift", r.steady.drift},
              {"drift_of_the_spin", r.steady_spin.drift}}},
            {"max_overlap", r.max_overlap},
            {"energy", r.energy},
            {"energy_at_start", r.energy_at_start},
            {"invariant", r.invariant},
            {"invariant_at_start", r.invariant_at_start},
            {"state_hash", fmt::format("{:016x}", r.state_hash)},
            {"seconds", r.seconds},
            {"events_per_second", r.events_per_second()},
            {"warnings", warnings(r)},
            {"version", version()},
            {"build", build_description()},
            {"generator", random_generator}};
}

}  // namespace swirl
