#include "swirl/study/search_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "swirl/io/atomic_file.hpp"
#include "swirl/run/parse_json.hpp"
#include "swirl/run/report.hpp"
#include "swirl/study/point_result.hpp"
#include "swirl/study/sweep_folder.hpp"

namespace swirl {

SweepPlan search_plan(ParameterTexts given, std::int64_t from, std::int64_t to) {
    given["discs"] = fmt::format("{}:{}", from, to);
    SweepPlan plan = plan_of_lists(given, max_search_runs);
    plan.search = true;
    validate(plan);
    return plan;
}

std::size_t SearchFolder::point_of(std::int64_t discs, std::int64_t replica) const {
    std::size_t index = 0;
    for (const SweepAxis& axis : plan_.axes) {
        const std::string value =
            axis.name == "discs" ? std::to_string(discs) : parameters_.at(axis.name);
        const auto found = std::find(axis.values.begin(), axis.values.end(), value);
        index = index * axis.values.size() + std::size_t(found - axis.values.begin());
    }
    return index * std::size_t(plan_.replicas) + std::size_t(replica);
}

std::optional<SearchRun> SearchFolder::find(std::int64_t discs, std::int64_t replica,
                                            const std::vector<std::string>& config_texts) {
    using Json = nlohmann::ordered_json;
    using namespace nlohmann::literals;
    const std::size_t point = point_of(discs, replica);
    const PointResult result = read_result(folder_, plan_, point);
    if (!result.exists) return {};
    const Json json = parse_json(read_regular_file(result_file(folder_, plan_, point)));
    const std::string text = json.value("config", Json()).dump();
    if (std::find(config_texts.begin(), config_texts.end(), text) == config_texts.end()) return {};
    const Json warmup = json.value("/warmup/periods"_json_pointer, Json()),
               events = json.value("/events/total"_json_pointer, Json());
    if (!warmup.is_number() || !events.is_number()) return {};
    SearchRun run{{},
                  result.periods - warmup.get<double>(),
                  SteadyState::Verdict::too_short,
                  events.get<std::uint64_t>()};
    for (std::size_t r = 0; r < run.rotation.size(); ++r)
        run.rotation[r] = result.quantities[r].estimate;
    for (const auto v : {SteadyState::Verdict::steady, SteadyState::Verdict::drifting,
                         SteadyState::Verdict::jumping, SteadyState::Verdict::switching})
        if (result.verdict == verdict(v)) run.verdict = v;
    return run;
}

void SearchFolder::store(std::int64_t discs, std::int64_t replica, const RunResult& result) {
    const std::size_t point = point_of(discs, replica);
    ParameterTexts texts = plan_.parameters(point);
    texts.erase(result.config.periods ? "events" : "periods");
    if (result.config.periods)
        texts["periods"] = std::to_string(*result.config.periods);
    else
        texts["events"] = std::to_string(result.config.events);
    const std::string command = command_of_run(texts, "", result.config.seed);
    write_file_atomically(result_file(folder_, plan_, point),
                          point_json(plan_, point, result, command).dump() + "\n");
}

}  // namespace swirl
