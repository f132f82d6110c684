#include "swirl/study/sweep_plan.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>

#include "swirl/io/atomic_file.hpp"
#include "swirl/io/checksum.hpp"
#include "swirl/io/file_error.hpp"
#include "swirl/io/optional_file.hpp"
#include "swirl/math/random.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/json.hpp"
#include "swirl/run/measurements.hpp"
#include "swirl/run/parse_json.hpp"
#include "swirl/run/ramp.hpp"
#include "swirl/study/crossing.hpp"
#include "swirl/study/map_plan.hpp"
#include "swirl/study/point_table.hpp"
#include "swirl/study/sweep_folder.hpp"

namespace swirl {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::size_t max_points = 10'000'000;

/// Calls visit(index) in order for the product indices, in the whole plan, of the points that a
/// stage adds to the stage before it.
void for_each_new_index(const SweepPlan& plan, const SweepStage& stage, const SweepStage* before,
                        const auto& visit) {
    if (plan.is_table()) {
        for (std::size_t row = 0; row < stage.row_replicas.size(); ++row) {
            const bool existed = before && row < before->row_replicas.size();
            for (std::int64_t r = existed ? before->row_replicas[row] : 0;
                 r < stage.row_replicas[row]; ++r)
                visit(row * std::size_t(plan.replicas) + std::size_t(r));
        }
        return;
    }
    std::vector<std::size_t> value(stage.values.size(), 0);  // index of the value on each axis
    for (;;) {
        std::size_t combination = 0;
        bool existed = before != nullptr;
        for (std::size_t a = 0; a < value.size(); ++a) {
            combination = combination * plan.axes[a].values.size() + value[a];
            existed = existed && value[a] < before->values[a];
        }
        const auto replicas = static_cast<std::size_t>(plan.replicas);
        for (std::size_t r = existed ? std::size_t(before->replicas) : 0;
             r < std::size_t(stage.replicas); ++r)
            visit(combination * replicas + r);
        std::size_t a = value.size();
        while (a > 0 && ++value[a - 1] == stage.values[a - 1]) value[--a] = 0;
        if (a == 0) return;
    }
}

SweepStage size_of(const SweepPlan& plan) {
    SweepStage stage{{}, plan.replicas, plan.row_replicas};
    if (plan.is_table()) return stage;
    for (const SweepAxis& axis : plan.axes) stage.values.push_back(axis.values.size());
    return stage;
}

std::vector<std::size_t> product_indices_of(const SweepPlan& plan) {
    std::vector<std::size_t> indices;
    if (plan.before.empty() && !plan.is_table()) return indices;
    const SweepStage now = size_of(plan);
    const SweepStage* before = nullptr;
    const auto add = [&](const SweepStage& stage) {
        for_each_new_index(plan, stage, before,
                           [&](std::size_t index) { indices.push_back(index); });
        before = &stage;
    };
    for (const SweepStage& stage : plan.before) add(stage);
    add(now);
    return indices;
}

std::string with_digits(double value) { return fmt::format("{:.12g}", value); }

bool takes_whole_numbers(std::string_view name) {
    const Parameter* const row = find_parameter(name);
    return row && row->member.index() != 0 &&
           !std::holds_alternative<double RunConfig::*>(row->member);
}

std::vector<std::string> range(std::string_view name, std::string_view text) {
    const auto reject = [&](const char* why) {
        throw UsageError(fmt::format(
            "{} is '{}', but {}.\nhint: a range is FROM:STEP:TO, or FROM:TO for whole numbers, for "
            "example 0:0.25:1 or 5:48.",
            option_name(name), text, why));
    };
    std::vector<double> parts;
    for (const std::string_view text_of_part : split(text, ":")) {
        const auto part = read_number(text_of_part);
        if (!part) reject("a part of it is not a number");
        parts.push_back(*part);
    }
    if (parts.size() > 3) reject("it has more than three parts");
    const double from = parts.front(), to = parts.back();
    const double step = parts.size() == 3 ? parts[1] : 1.0;
    if (parts.size() == 3 && parts[1] > from && to > 0.0 && step > to - from &&
        to <= parts[1] - from)
        throw UsageError(fmt::format(
            "{} is '{}', but the step is in the middle: FROM:STEP:TO.\nhint: write {}:{}:{}.",
            option_name(name), text, with_digits(from), with_digits(to), with_digits(step)));
    if (!(step > 0.0) || to < from) reject("it is not ascending");
    if (parts.size() == 2 && !takes_whole_numbers(name))
        throw UsageError(fmt::format(
            "{} is '{}', a range without a step.\nhint: give the step, {}:{:g}:{}, or a list.",
            option_name(name), text, with_digits(from), (to - from) / 4.0, with_digits(to)));
    const double count = std::floor((to - from) / step + 1e-9) + 1.0;
    if (count > 1e6) reject("it has more than a million values");
    std::vector<std::string> values;
    for (double k = 0.0; k < count; k += 1.0) values.push_back(with_digits(from + k * step));
    return values;
}

/// The number of runs, as a double: the counts in a damaged file may overflow an integer.
double number_of_runs(const SweepPlan& plan) {
    if (plan.is_table())
        return std::accumulate(plan.row_replicas.begin(), plan.row_replicas.end(), 0.0);
    double count = double(plan.replicas) * double(plan.directions());
    for (const SweepAxis& axis : plan.axes) count *= double(axis.values.size());
    return count;
}

/// True if two values of an axis give different runs for some value of another axis.
bool differ_elsewhere(const SweepPlan& plan, const SweepAxis& axis, const std::string& one,
                      const std::string& two) {
    for (const SweepAxis& other : plan.axes) {
        if (other.name == axis.name) continue;
        for (const std::string& value : other.values) {
            ParameterTexts a = plan.parameters(0), b = a;
            a[other.name] = b[other.name] = value;
            a[axis.name] = one;
            b[axis.name] = two;
            try {
                if (identity_of(resolve(a)) != identity_of(resolve(b))) return true;
            } catch (const UsageError&) {  // reported when the point runs
            }
        }
    }
    return false;
}

/// Each value of an axis must give a different run; repetitions are replicas.
void reject_repeated_runs(const SweepPlan& plan, const SweepAxis& axis) {
    ParameterTexts texts = plan.parameters(0);
    std::map<std::uint64_t, std::string> seen;
    for (const std::string& value : axis.values) {
        texts[axis.name] = value;
        const auto [before, is_new] = seen.emplace(identity_of(resolve(texts)), value);
        if (!is_new && !differ_elsewhere(plan, axis, before->second, value))
            throw UsageError(
                fmt::format("{0} {1} and {0} {2} are the same run here.\nhint: omit one of them, "
                            "or the parameter that overrides it. For several runs of each, use "
                            "--replicates.",
                            option_name(axis.name), before->second, value));
    }
}

/// Each stage must contain the one before it.
void reject_shrinking(const fs::path& file, const SweepPlan& plan) {
    std::vector<SweepStage> stages = plan.before;
    stages.push_back(size_of(plan));
    for (std::size_t k = 0; k + 1 < stages.size(); ++k) {
        const SweepStage &stage = stages[k], &next = stages[k + 1];
        bool valid = stage.values.size() == next.values.size() && stage.replicas >= 1 &&
                     stage.replicas <= next.replicas &&
                     stage.row_replicas.size() <= next.row_replicas.size() &&
                     stage.row_replicas.empty() == next.row_replicas.empty();
        for (std::size_t row = 0; valid && row < stage.row_replicas.size(); ++row)
            valid =
                stage.row_replicas[row] >= 1 && stage.row_replicas[row] <= next.row_replicas[row];
        for (std::size_t a = 0; valid && a < stage.values.size(); ++a)
            valid = stage.values[a] >= 1 && stage.values[a] <= next.values[a];
        if (!valid)
            throw FileError(fmt::format(
                "'{}' is damaged: the plan before it grew is not a part of the present plan.",
                file.string()));
    }
}

Json plan_json(const SweepPlan& plan) {
    Json axes = Json::object();
    for (const SweepAxis& axis : plan.axes) axes[axis.name] = axis.values;
    Json json{{"format", sweep_format},
              {plan.is_table() ? "columns" : "axes", axes},
              {"replicates", plan.is_table() ? Json(plan.row_replicas) : Json(plan.replicas)}};
    if (!plan.common.empty()) json["common"] = plan.common;
    if (!plan.measure.empty()) json["measure"] = plan.measure;
    if (plan.frames > 0) json["frames"] = plan.frames;
    if (plan.series) json["series"] = true;
    if (!plan.chain.empty()) json["chain"] = plan.chain;
    if (plan.generation > 1) json["generation"] = plan.generation;
    for (const SweepStage& stage : plan.before)
        json["before"].push_back(
            plan.is_table() ? Json{{"replicates", stage.row_replicas}}
                            : Json{{"values", stage.values}, {"replicates", stage.replicas}});
    if (plan.search) json["search"] = true;
    if (plan.map) {
        const MapTarget& m = *plan.map;
        json["map"] = {
            {"x", m.x},         {"y", m.y},           {"quantity", m.of},        {"rate", m.rate},
            {"level", m.level}, {"change", m.change}, {"tolerance", m.tolerance}};
    }
    return json;
}

/// Throws the exception of the JSON library for a missing part.
MapTarget map_target_of(const Json& json) {
    return {.x = json.at("x"),
            .y = json.at("y"),
            .of = json.at("quantity"),
            .rate = json.at("rate"),
            .level = json.at("level"),
            .change = json.at("change"),
            .tolerance = json.at("tolerance")};
}

}  // namespace

const SweepAxis* SweepPlan::axis(std::string_view name) const {
    const auto found = std::find_if(axes.begin(), axes.end(),
                                    [&](const SweepAxis& axis) { return axis.name == name; });
    return found == axes.end() ? nullptr : &*found;
}

std::size_t SweepPlan::points() const {
    return is_table() ? product_indices.size()
                      : rows() * directions() * static_cast<std::size_t>(replicas);
}

std::size_t SweepPlan::rows() const {
    if (is_table()) return row_replicas.size();
    std::size_t count = 1;
    for (const SweepAxis& axis : axes) count *= axis.values.size();
    return count;
}

std::int64_t SweepPlan::replica(std::size_t point) const {
    return static_cast<std::int64_t>(product_index(point) % static_cast<std::size_t>(replicas));
}

const char* SweepPlan::direction(std::size_t point) const {
    if (chain.empty()) return "";
    const std::size_t index = product_index(point) / static_cast<std::size_t>(replicas);
    return index % directions() == 0 ? "up" : "down";
}

ParameterTexts SweepPlan::parameters(std::size_t point) const {
    return parameters_of_row(product_index(point) /
                             (static_cast<std::size_t>(replicas) * directions()));
}

ParameterTexts SweepPlan::parameters_of_row(std::size_t row) const {
    ParameterTexts texts;
    for (auto axis = axes.rbegin(); axis != axes.rend(); ++axis) {
        const std::string& value = axis->values[row % axis->values.size()];
        if (!is_table()) row /= axis->values.size();
        if (!value.empty()) texts[axis->name] = value;
    }
    return texts;
}

RunConfig SweepPlan::config(std::size_t point) const {
    const ParameterTexts texts = parameters(point);
    RunConfig config = resolve(texts);
    if (is_table() && texts.contains("seed")) {
        config.seed += static_cast<std::uint64_t>(replica(point));
        return config;
    }
    if (search) {
        config.seed = search_seed(config, replica(point));
        return config;
    }
    std::string identity = fmt::format("{} replica {}", config_text(config), replica(point));
    if (!chain.empty()) identity += fmt::format(" chain {} {}", chain, direction(point));
    config.seed = Random(checksum(identity)).bits() >> 11;  // exact in every JSON reader
    return config;
}

std::string SweepPlan::text() const { return plan_json(*this).dump(); }

std::vector<std::string> list_of_values(std::string_view name, std::string_view text) {
    std::vector<std::string> values;
    for (const std::string_view part : split(text, ",")) {
        if (part.empty())
            throw UsageError(fmt::format("{} is '{}', but a value in the list is empty.",
                                         option_name(name), text));
        const Parameter* const row = find_parameter(name);
        const bool has_colons = row && row->has_colons;
        if (part.find(':') != part.npos && !has_colons) {
            const auto more = range(name, part);
            values.insert(values.end(), more.begin(), more.end());
        } else {
            values.emplace_back(part);
        }
    }
    return values;
}

// A contact duration has no effect without dissipation and floor.
std::uint64_t identity_of(RunConfig config) {
    if (!config.uses_contact_duration()) config.contact_duration = RunConfig{}.contact_duration;
    if (config.mixture) config.mixture->percent.reset();
    config.length_unit.clear();
    config.time_unit.clear();
    if (!config.initial.empty() && !config.sizes) config.seed = 0;
    return checksum(config_text(config));
}

void validate_whole_number(const char* option, std::int64_t value, std::int64_t least,
                           std::int64_t most) {
    if (value < least || value > most)
        throw UsageError(fmt::format("{} is {}, but it must be a whole number from {} to {}.",
                                     option, value, least, most));
}

// Finds errors of single values, and of the rows of a table. Errors of combinations of values
// appear when the point runs.
void validate(const SweepPlan& plan) {
    validate_whole_number("--replicates", plan.replicas, 1, max_replicas);
    for (const std::int64_t row : plan.row_replicas)
        validate_whole_number("--replicates", row, 1, max_replicas);
    if (const double count = number_of_runs(plan); count > double(max_points))
        throw UsageError(fmt::format("the call plans {:.3g} runs, but at most {} are possible.",
                                     count, max_points));
    const bool has_replicates =
        plan.is_table() ? std::ranges::any_of(plan.row_replicas, [](auto n) { return n > 1; })
                        : plan.replicas > 1;
    if (has_replicates && plan.axis("initial") && !plan.axis("sizes"))
        throw UsageError(
            "replicates of a point would be equal, because --initial gives their state.\nhint: use "
            "one replicate.");
    if (plan.is_table()) {
        if (plan.axes.empty() || plan.map || plan.search)
            throw UsageError("a table of points has columns, and is not that of a map or search.");
        return validate_rows(plan);
    }
    for (const SweepAxis& axis : plan.axes)
        if (!plan.searches_numbers() || axis.name != "discs") reject_repeated_runs(plan, axis);
}

SweepPlan plan_of_lists(const ParameterTexts& given, std::int64_t replicas) {
    SweepPlan plan;
    plan.replicas = replicas;
    ParameterTexts texts;
    for (const auto& [name, text] : given) texts[plain_name(name)] = text;
    for (const Parameter& p : run_parameters)
        if (const auto found = texts.find(p.name); found != texts.end() && p.is_settable()) {
            plan.axes.push_back({p.name, list_of_values(p.name, found->second)});
            texts.erase(found);
        }
    if (!texts.empty()) resolve(texts);  // throws for the unknown name
    return plan;
}

SweepPlan make_plan(const ParameterTexts& given, std::int64_t replicas) {
    SweepPlan plan = plan_of_lists(given, replicas);
    validate(plan);
    return plan;
}

static void validate_chain(const SweepPlan& plan) {
    const std::string& name = plan.chain;
    const SweepAxis* const axis = plan.axis(name);
    if (plan.is_table())
        throw UsageError(
            "--chain and --points cannot be combined.\nhint: give lists of values instead.");
    const std::vector<std::string> names = ramp_parameter_names();
    if (std::find(names.begin(), names.end(), name) == names.end())
        throw UsageError(fmt::format("--chain is '{}', but it must be one of: {}.{}", name,
                                     fmt::join(names, ", "), nearest_value_hint(name, names)));
    if (!axis || axis->values.size() < 2)
        throw UsageError(fmt::format(
            "--chain is '{}', but the sweep has fewer than two values of it.\nhint: give "
            "{} with several values, for example {} 0.1:0.1:1.",
            name, option_name(name), option_name(name)));
    if (!plan.axis("periods"))
        throw UsageError(
            "a chain needs runs of whole periods.\nhint: give their length with --periods.");
    for (const char* other : {"ramp", "direction"})  // the table has its own column direction
        if (plan.axis(other))
            throw UsageError(fmt::format(
                "--chain and --{} cannot be combined.\nhint: omit one of them.", other));
    if (plan.frames > 0)
        throw UsageError(
            "--chain and --frames-per-period cannot be combined: a recording does not store the "
            "state in "
            "which its run starts.\nhint: use `swirl sweep --series`, or `swirl run --ramp`.");
}

void validate_extras(const SweepPlan& plan) {
    validate_whole_number("--frames-per-period", plan.frames, 0, max_frames);
    if (!plan.measure.empty())
        read_measurement_list(fmt::format("{}", fmt::join(plan.measure, ",")));
    if (!plan.chain.empty()) validate_chain(plan);
    if (number_of_runs(plan) > double(max_points)) validate(plan);  // a chain doubles the runs
    if (plan.map) validate_map(plan);
}

SweepPlan grown(const SweepPlan& plan, const ParameterTexts& more, std::int64_t replicas,
                const std::vector<std::string>& measure) {
    if (plan.map) throw UsageError("the folder holds a map.\nhint: use swirl map --grow.");
    if (plan.search)
        throw UsageError("the folder holds a search for N_c.\nhint: use another folder.");
    if (!plan.chain.empty())
        throw UsageError(
            "a sweep with a chain cannot grow: each run starts from the one before it.\nhint: use "
            "another folder.");
    if (plan.is_table() && !more.empty())
        throw UsageError(
            "the sweep in the folder has a table of points.\nhint: give further points with "
            "--points.");
    std::vector<SweepAxis> values;
    for (const auto& [given, text] : more) {
        const std::string name = plain_name(given);
        if (!plan.axis(name)) {
            resolve({{name, list_of_values(name, text).front()}});  // throws for an unknown name
            throw UsageError(
                fmt::format("{} is not a parameter of this sweep, whose points use its default."
                            "\nhint: use another folder for a sweep over it.",
                            option_name(name)));
        }
        values.push_back({name, list_of_values(name, text)});
    }
    return with_values(plan, values, replicas, measure);
}

SweepPlan with_values(const SweepPlan& plan, const std::vector<SweepAxis>& more,
                      std::int64_t replicas, const std::vector<std::string>& measure) {
    SweepPlan larger = plan;
    for (const SweepAxis& given : more) {
        const auto axis = std::find_if(larger.axes.begin(), larger.axes.end(),
                                       [&](const SweepAxis& a) { return a.name == given.name; });
        for (const std::string& value : given.values)
            if (std::find(axis->values.begin(), axis->values.end(), value) == axis->values.end())
                axis->values.push_back(value);
    }
    const std::int64_t existing =
        plan.is_table() ? *std::min_element(plan.row_replicas.begin(), plan.row_replicas.end())
                        : plan.replicas;
    if (replicas > 0 && replicas < existing)
        throw UsageError(
            fmt::format("--replicates is {}, but the {} already has {} and can only grow.",
                        replicas, plan.kind(), existing));
    larger.replicas = std::max(replicas, plan.replicas);
    for (std::int64_t& row : larger.row_replicas) row = std::max(replicas, row);
    return extended(plan, std::move(larger), measure);
}

SweepPlan extended(const SweepPlan& plan, SweepPlan larger,
                   const std::vector<std::string>& measure) {
    for (const std::string& name : measure)
        if (std::find(larger.measure.begin(), larger.measure.end(), name) == larger.measure.end())
            larger.measure.push_back(name);
    if (larger.measure != plan.measure) ++larger.generation;
    validate(larger);
    if (size_of(larger) != size_of(plan)) larger.before.push_back(size_of(plan));
    larger.product_indices = product_indices_of(larger);
    return larger;
}

std::vector<std::size_t> ascending_order(const SweepAxis& axis) {
    std::vector<std::size_t> order(axis.values.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::vector<double> numbers;
    for (const std::string& value : axis.values) {
        const auto number = read_number(value);
        if (!number) return order;
        numbers.push_back(*number);
    }
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return numbers[a] < numbers[b]; });
    return order;
}

std::vector<std::string> varied_options(const SweepPlan& plan, const ParameterTexts& parameters) {
    std::vector<std::string> options;
    for (const auto& [name, value] : parameters)
        if (plan.axis(name)->values.size() > 1)
            options.push_back(fmt::format("{} {}", option_name(name), value));
    return options;
}

SweepPlan read_plan(const fs::path& folder) {
    const fs::path file = folder / "plan.json";
    const std::optional<std::string> text = read_optional_file(file);
    if (!text)
        throw FileError(fmt::format(
            "'{}' is not the folder of a sweep or map: it holds no plan.json.", folder.string()));
    const Json json = parse_json(*text);
    SweepPlan plan;
    try {
        if (json.at("format") != sweep_format)
            throw FileError(fmt::format("'{}' is in format {}, but this program reads format {}.",
                                        file.string(), json.at("format").dump(), sweep_format));
        const bool is_table = json.contains("columns");
        for (const auto& [name, values] : json.at(is_table ? "columns" : "axes").items())
            plan.axes.push_back({plain_name(name), values.get<std::vector<std::string>>()});
        const auto read_replicas = [&](const Json& from, auto& size) {
            if (is_table) size.row_replicas = from.get<std::vector<std::int64_t>>();
            size.replicas =
                !is_table ? from.get<std::int64_t>()
                : size.row_replicas.empty()
                    ? 0
                    : *std::max_element(size.row_replicas.begin(), size.row_replicas.end());
        };
        read_replicas(json.at("replicates"), plan);
        plan.common = json.value("common", ParameterTexts());
        plan.measure = json.value("measure", std::vector<std::string>());
        plan.frames = json.value("frames", 0);
        plan.series = json.value("series", false);
        plan.chain = plain_name(json.value("chain", std::string()));
        plan.generation = json.value("generation", 1);
        plan.search = json.value("search", false);
        for (const Json& stage : json.value("before", Json::array())) {
            SweepStage& before = plan.before.emplace_back();
            if (!is_table) before.values = stage.at("values").get<std::vector<std::size_t>>();
            read_replicas(stage.at("replicates"), before);
        }
        if (const auto map = json.find("map"); map != json.end()) plan.map = map_target_of(*map);
    } catch (const nlohmann::json::exception&) {
        throw FileError(
            fmt::format("'{}' is damaged: it is not the plan of a sweep or map.\nhint: remove it "
                        "and repeat the "
                        "call that made it; finished runs are kept.",
                        file.string()));
    }
    if (plan.generation < 1)
        throw FileError(fmt::format("'{}' is damaged: it has the generation {}.", file.string(),
                                    plan.generation));
    for (const SweepAxis& axis : plan.axes) {
        if (axis.values.empty())
            throw FileError(fmt::format("'{}' is damaged: {} has no values, but it must have one.",
                                        file.string(), axis.name));
        if (plan.is_table() && axis.values.size() != plan.rows())
            throw FileError(
                fmt::format("'{}' is damaged: {} has {} values, but the table has {} rows.",
                            file.string(), axis.name, axis.values.size(), plan.rows()));
    }
    for (const auto& [name, value] : plan.common)
        if (!plan.is_table() || !plan.axis(name))
            throw FileError(fmt::format("'{}' is damaged: {} is common to all rows, but no column.",
                                        file.string(), name));
    if (const double count = number_of_runs(plan); !(count >= 1.0 && count <= double(max_points)))
        throw FileError(
            fmt::format("'{}' is damaged: it plans {:.3g} runs with {} replicates of "
                        "each point, but from 1 to {} runs are possible.",
                        file.string(), count, plan.replicas, max_points));
    reject_shrinking(file, plan);
    plan.product_indices = product_indices_of(plan);
    try {  // the functions that validate a call throw
        validate(plan);
        validate_extras(plan);
    } catch (const UsageError& error) {
        throw FileError(fmt::format("'{}' is damaged: {}", file.string(), error.what()));
    }
    return plan;
}

namespace {

std::string plan_file_text(const SweepPlan& plan) { return plan_json(plan).dump(1) + "\n"; }

/// Held while a plan is replaced. The system releases it if the process is killed.
class PlanLock {
  public:
    explicit PlanLock(const fs::path& folder)
        : handle_(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
        while (handle_ >= 0 && ::flock(handle_, LOCK_EX) != 0 && errno == EINTR) {
        }
    }
    ~PlanLock() {
        if (handle_ >= 0) ::close(handle_);
    }
    PlanLock(const PlanLock&) = delete;
    PlanLock& operator=(const PlanLock&) = delete;

  private:
    int handle_;
};

/// Without the lock, two calls at the same time could give new points the same numbers.
void replace_plan(const fs::path& folder, const SweepPlan& plan, const SweepPlan& grown_from) {
    const PlanLock lock(folder);
    if (read_plan(folder) != grown_from)
        throw Failure(fmt::format(
            "another process has extended the {0} in '{1}' in the meantime.\nhint: repeat the "
            "command to add to the extended {0}.",
            plan.kind(), folder.string()));
    write_file_atomically(folder / "plan.json", plan_file_text(plan));
}

}  // namespace

void write_plan(const fs::path& folder, const SweepPlan& plan, const SweepPlan* grown_from) {
    std::error_code error;
    if (fs::is_regular_file(folder, error))
        throw Failure(fmt::format("'{}' is a file, but it must be a folder.", folder.string()));
    std::vector<fs::path> parts{part_of_sweep(folder, "results", plan), folder / "failures",
                                part_of_sweep(folder, "checkpoints", plan)};
    if (plan.frames > 0) parts.push_back(folder / "trajectories");
    if (plan.series) parts.push_back(part_of_sweep(folder, "series", plan));
    for (const fs::path& part : parts)
        if (fs::create_directories(part, error); error)
            throw Failure(
                fmt::format("folder '{}' cannot be created: {}.", part.string(), error.message()));
    if (grown_from != nullptr) return replace_plan(folder, plan, *grown_from);
    // If two sweeps start in this folder at the same time, the first one gets it.
    const fs::path file = folder / "plan.json";
    if (!file_exists(file) && write_new_file(file, plan_file_text(plan))) return;
    const SweepPlan existing = read_plan(folder);
    if (existing == plan) return;
    const bool same_kind = existing.kind() == std::string_view(plan.kind());
    throw Failure(fmt::format(
        "'{}' holds {} {} (see its plan.json).\nhint: choose another folder{}.", folder.string(),
        same_kind ? "another" : "a", existing.kind(),
        !same_kind || plan.search ? ""
        : plan.map                ? ", or continue that map by giving only --out"
                   : ", continue that sweep by giving only --out, or extend it with --grow"));
}

}  // namespace swirl
