// The functions that the browser page calls; their arguments and results are plain numbers. They
// simulate one container: its parameters (read as the command line reads them), its averages, and
// its events one by one.
//
// Texts go through one buffer. The page writes a text there before a call, and reads the answer
// there after it. A function that answers with a text returns its length. If the command line would
// end with an error message, the page's `reject` gets it as JSON: its text in English, and the
// codes and values of its sentences. That function throws in JavaScript, so the stack of this
// module is lost: after it the page creates a new instance.
//
// Only this folder depends on the page. The engine, measurements and parameters are the same files
// as in all other programs.
#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "container.hpp"
#include "fitting.hpp"
#include "json.hpp"
#include "swirl/measure/m_frame.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/parameters.hpp"
#include "swirl/run/particle_sizes.hpp"
#include "swirl/run/path_parameter.hpp"
#include "swirl/run/report.hpp"
#include "swirl/run/shell_word.hpp"
#include "swirl/run/version.hpp"
#include "swirl/statistics/crossing_search.hpp"
#include "swirl/statistics/replicates.hpp"
#include "swirl/statistics/zero_crossing.hpp"

#define EXPORTED(name) extern "C" __attribute__((export_name(#name)))
// The first page shows a dish and needs none of these functions, so its module is smaller.
#ifdef SWIRL_ONLY_THE_DISH
#define LABORATORY(name) [[maybe_unused]] static
#else
#define LABORATORY(name) EXPORTED(name)
#endif

extern "C" {
[[noreturn]] __attribute__((import_module("page"), import_name("reject"))) void page_reject(
    const char* text, std::size_t size);
}

namespace swirl {

void throw_usage_error(const Message& message) {
    const std::string json = message_json(message);
    page_reject(json.data(), json.size());
}
// Never called, because nothing stops the page's engine.
void throw_interrupted(const std::string&) { __builtin_trap(); }

namespace {

std::string buffer;

std::uint32_t answer(std::string text) {
    buffer = std::move(text);
    return static_cast<std::uint32_t>(buffer.size());
}

/// Reads lines "name=value".
ParameterTexts parse_lines(std::string_view lines) {
    ParameterTexts texts;
    while (!lines.empty()) {
        const std::size_t end = std::min(lines.find('\n'), lines.size());
        const std::string_view line = lines.substr(0, end);
        const std::size_t equals = line.find('=');
        if (equals != line.npos)
            texts[std::string(line.substr(0, equals))] = line.substr(equals + 1);
        lines.remove_prefix(std::min(end + 1, lines.size()));
    }
    return texts;
}

/// The names of known measurements in a list "a,b,c".
std::vector<std::string> measurements_in(std::string_view list) {
    std::vector<std::string> names;
    while (!list.empty()) {
        const std::size_t comma = std::min(list.find(','), list.size());
        if (PageObservation::has(list.substr(0, comma))) names.emplace_back(list.substr(0, comma));
        list.remove_prefix(std::min(comma + 1, list.size()));
    }
    return names;
}

struct Request {
    RunConfig config;
    std::vector<std::string> measured;
    ParameterTexts given;
};
Request parse_request(std::string_view lines) {
    ParameterTexts given = parse_lines(lines);
    std::vector<std::string> measured;
    if (const auto found = given.find("measure"); found != given.end()) {
        measured = measurements_in(found->second);
        given.erase(found);
    }
    // The page has no length of a run. Presets have one in periods, which would limit the warm-up.
    ParameterTexts without_length = given;
    if (!given.contains("periods")) without_length.try_emplace("events", "1e6");
    RunConfig config = resolve(without_length);
    // The page shows maps in the M-frame.
    if (!has_m_frame(config) || config.turns_clockwise())
        throw_usage_error(Message("page_needs_circle"));
    if (config.frictionless == Frictionless::boundary || config.frictionless == Frictionless::bulk)
        throw_usage_error(Message("page_without_frictionless"));
    return {std::move(config), std::move(measured), std::move(given)};
}

std::unique_ptr<Container> simulated;
bool maps_are_shown = false;
void simulate(const RunConfig& config, const InitialState& state,
              const std::vector<std::string>& measured) {
    auto container = std::make_unique<Container>(config, state, measured);
    container->show_maps(maps_are_shown);
    simulated = std::move(container);
}
ParameterTexts given_at_start;
RotationSample turns_by_hand{0.0, 0.0};
std::vector<double> numbers;
std::vector<MeasurementReport> reports;

/// A copy of `b` with the path of `a`.
RunConfig with_path_of(const RunConfig& a, RunConfig b) {
    b.amplitude = a.amplitude;
    b.period = a.period;
    b.sides = a.sides;
    b.path = a.path;
    return b;
}

/// How the discs can continue with other values.
enum class Change { needs_new_simulation, at_once, at_the_start_of_a_period };

/// All discs can spin, or none can.
bool can_spin_alike(const RunConfig& c) { return c.cannot_spin == 0.0 || c.cannot_spin == 1.0; }

/// Stops the spins of all discs, or frees them.
void let_spin(InitialState& state, bool can_spin) {
    for (Disc& disc : state.discs) {
        disc.can_spin = can_spin ? 1.0 : 0.0;
        if (!can_spin) disc.spin = 0.0;
    }
}

/// Parameters that may change (Changes), the spins of all discs, and the number of discs of one
/// size, do so at once; the path at the start of a period. Any other difference needs a new
/// simulation.
Change change_between(const RunConfig& a, const RunConfig& b) {
    constexpr std::int64_t most = 400;  // more discs are not added one by one
    RunConfig like = with_path_of(a, b);
    for (const Parameter& p : run_parameters)
        if (p.changes != Changes::new_run && p.number()) like.*p.number() = a.*p.number();
    like.warmup = a.warmup;
    const std::int64_t discs = b.discs;
    const bool are_equal = !has_unequal_sizes(a) && can_spin_alike(a);
    if (can_spin_alike(a) && can_spin_alike(b)) like.cannot_spin = a.cannot_spin;
    if (are_equal && a.discs > 0 && discs > 0 && a.discs <= most && discs <= most)
        like.discs = a.discs;
    if (texts_of(a) != texts_of(like)) return Change::needs_new_simulation;
    return texts_of(b) == texts_of(with_path_of(a, b)) ? Change::at_once
                                                       : Change::at_the_start_of_a_period;
}

/// The JSON of a parameter's value.
struct ValueJson {
    std::string operator()(std::monostate) const { return "null"; }
    std::string operator()(const Mixture& m) const {
        return JsonObject()
            .add("count", double(m.count))
            .add("radius", m.radius)
            .add("mass", m.mass)
            .text();
    }
    std::string operator()(const std::string& word) const { return json_text(word); }
    std::string operator()(const auto& value) const { return fmt::format("{}", value); }
};

constexpr std::size_t runs_width = 5;

/// The points of the curve ϖ(N) from the runs in `numbers`. Runs with the same N are replicates.
std::vector<RotationPoint> curve_of_runs() {
    std::map<double, std::pair<std::vector<Estimate>, std::vector<double>>> by_number;
    for (std::size_t k = 0; k + runs_width <= numbers.size(); k += runs_width) {
        auto& [estimates, periods] = by_number[numbers[k]];
        Estimate e;
        e.mean = numbers[k + 1];
        e.error = numbers[k + 2];
        e.effective_samples = numbers[k + 4];
        estimates.push_back(e);
        periods.push_back(numbers[k + 3]);
    }
    std::vector<RotationPoint> curve;
    for (const auto& [discs, replicates] : by_number) {
        const Estimate e = ensemble(replicates.first, replicates.second).estimate;
        curve.push_back({discs, e.mean, e.error});
    }
    return curve;
}

/// A run of a search: N, the periods after the warm-up, and for each rotation rate mean, error and
/// effective number of samples, NaN if it failed. The first rate controls the search.
constexpr std::size_t search_width = 2 + 3 * rotation_rates.size();

/// A search whose runs so far are those in `numbers`, in ascending order of the replicas at each N.
/// Proposes its next runs.
std::vector<ProposedRun> repeat(CrossingSearch& search) {
    std::map<std::int64_t, std::vector<const double*>> made;
    for (std::size_t k = 0; k + search_width <= numbers.size(); k += search_width)
        made[std::int64_t(numbers[k])].push_back(&numbers[k]);
    for (;;) {
        std::vector<ProposedRun> next = search.next();
        if (next.empty() || made[next.front().discs].size() <= std::size_t(next.front().replica))
            return next;
        for (const ProposedRun& proposed : next) {
            const double* const given = made[proposed.discs][std::size_t(proposed.replica)];
            SearchedRun run{{}, given[1]};
            for (std::size_t at = 2; at < search_width; at += 3) {
                Estimate e{.mean = given[at], .error = given[at + 1]};
                e.effective_samples = given[at + 2];
                run.rates.push_back(e);
            }
            search.take(proposed, std::isnan(run.rates.front().mean) ? nullptr : &run);
        }
    }
}

std::string_view name_of(Crossing::Verdict verdict) {
    switch (verdict) {
        case Crossing::Verdict::crosses:
            return "crosses";
        case Crossing::Verdict::always_rotates:
            return "always_rotates";
        case Crossing::Verdict::always_counterrotates:
            return "always_counterrotates";
        case Crossing::Verdict::undecided:
            break;
    }
    return "undecided";
}

/// [from, to, step], or null.
std::string slider_json(const Slider& slider) {
    if (slider.step == 0.0) return "null";
    return fmt::format("[{},{},{}]", slider.from, slider.to, slider.step);
}

std::string_view name_of(AppliesTo runs) {
    switch (runs) {
        case AppliesTo::every_run:
            break;
        case AppliesTo::floor:
            return "floor";
        case AppliesTo::spheres:
            return "spheres";
        case AppliesTo::rolling_spheres:
            return "rolling_spheres";
        case AppliesTo::dissipation:
            return "dissipation";
        case AppliesTo::polygons:
            return "polygons";
    }
    return "every_run";
}

std::string parameter_json(const Parameter& p) {
    return fmt::format(
        R"({{"name":{},"symbol":{},"unit":{},"form":{},"description":{},"group":{},"default":{},)"
        R"("lowest":{},"highest":{},"slider":{},"settable":{},"page_group":{},"label":{},)"
        R"("applies_to":{}}})",
        json_text(p.name), json_text(p.symbol), json_text(p.unit), json_text(p.form),
        json_text(p.description), json_text(p.group), json_text(default_of(p)),
        number(p.range.lowest), number(p.range.highest), slider_json(p.page.slider),
        p.is_settable(), p.page.group ? json_text(p.page.group) : "null", json_text(p.page.label),
        json_text(name_of(p.applies_to)));
}

}  // namespace
}  // namespace swirl

using namespace swirl;

/// Memory for a text of `size` bytes that the page writes.
EXPORTED(buffer_for) char* buffer_for(std::uint32_t size) {
    buffer.resize(size);
    return buffer.data();
}
EXPORTED(text) const char* text() { return buffer.data(); }

/// The table of parameters as JSON.
EXPORTED(parameters) std::uint32_t parameters() {
    std::string json = "[";
    for (const Parameter& p : run_parameters)
        json += (json.size() > 1 ? "," : "") + parameter_json(p);
    return answer(json + "]");
}

/// Starts a new simulation at rest. The buffer holds lines "name=value" as on the command line, and
/// "measure=a,b,c".
EXPORTED(begin) void begin() {
    auto [config, measured, given] = parse_request(buffer);
    simulated.reset();
    simulate(config, make_initial_state(config), measured);
    given_at_start = std::move(given);
}

/// 0: change() needs a new simulation; 1: it keeps the discs at once; 2: it keeps them at the start
/// of a period.
EXPORTED(keeps_discs) std::uint32_t keeps_discs() {
    return static_cast<std::uint32_t>(
        change_between(simulated->config(), parse_request(buffer).config));
}

/// Continues with the same discs from `time`, with other friction coefficients or restitutions,
/// with all spins stopped or freed, or another number of discs. Another path begins at its start,
/// at the start of a period. Averages are reset. 0: the change needs a new simulation, and nothing
/// was done; else 1 + the number of discs for which there is no room at this moment.
EXPORTED(change) std::uint32_t change(double time) {
    auto [config, measured, given] = parse_request(buffer);
    const Change kind = change_between(simulated->config(), config);
    if (kind == Change::needs_new_simulation) return 0;
    InitialState state = simulated->continued_from(
        time, config,
        kind == Change::at_once ? path_from(simulated->path(), simulated->snapshot_at(time).clock)
                                : make_path(config));
    const auto wanted = static_cast<std::size_t>(config.discs);
    fit_discs(state, wanted);
    config.discs = static_cast<std::int64_t>(state.discs.size());
    if (can_spin_alike(config)) let_spin(state, config.cannot_spin == 0.0);
    simulate(config, state, measured);
    return static_cast<std::uint32_t>(1 + wanted - state.discs.size());
}

/// Moves disc i to the free position nearest to (x, y) on the way there. It then moves with the
/// container; all other discs keep their state.
LABORATORY(drag) void drag(double time, std::uint32_t i, double x, double y) {
    const ContainerPath later = path_from(simulated->path(), simulated->snapshot_at(time).clock);
    InitialState state = simulated->continued_from(time, simulated->config(), later);
    if (i >= state.discs.size()) return;
    Disc& disc = state.discs[i];
    disc.position = nearest_free_position(state, i, {x, y});
    disc.velocity = later.segments.front().velocity;
    disc.spin = 0.0;
    simulate(simulated->config(), state, simulated->measured());
}

/// By hand: from `time` on the container moves straight to (x, y) within `duration` (above 0) and
/// stops there. Time restarts at 0. Nothing is averaged, since the path has no period.
EXPORTED(steer) void steer(double time, double x, double y, double duration) {
    RunConfig config = simulated->config();
    const Snapshot& now = simulated->snapshot_at(time);
    const Vec2 from = now.container_centre;
    if (!is_by_hand(simulated->path())) turns_by_hand = {0.0, 0.0};
    const RotationSample rate = rotation_of(now.up_to_date());
    turns_by_hand.individual += duration * rate.individual / (2.0 * pi);
    turns_by_hand.rigid += duration * rate.rigid / (2.0 * pi);
    const InitialState state =
        simulated->continued_from(time, config, path_by_hand(from, {x, y}, duration));
    config.period = state.path.period;
    simulated = std::make_unique<Container>(config, state, std::vector<std::string>{});
}

/// All parameters as lines "name=value", including those that were not given.
EXPORTED(configuration) std::uint32_t configuration() {
    std::string lines;
    for (const auto& [name, value] : texts_of(simulated->config()))
        lines += fmt::format("{}={}\n", name, value);
    return answer(lines);
}

/// The command line that reaches the last passed event. It is valid if the simulation was not
/// changed since its start. If no warm-up was given, the command would choose one by the length of
/// the run, so the page's is added, unless the run ends within it (an error).
EXPORTED(command) std::uint32_t command() {
    ParameterTexts texts = given_at_start;
    const auto warmup = texts.find("warmup");
    if ((warmup == texts.end() || warmup->second == "auto") && simulated->is_warm())
        texts["warmup"] = fmt::format("{}", simulated->warmup());
    std::string line = "./swirl run";
    for (const Parameter& p : run_parameters)
        if (const auto given = texts.find(p.name); given != texts.end())
            line += fmt::format(" {} {}", option_name(p.name), shell_word(given->second));
    const std::uint64_t events = simulated->simulation().events().total();
    return answer(line + fmt::format(" --events {}", std::max(events, std::uint64_t{1})));
}

/// Executes `count` events; stops at a problem and does nothing after it.
EXPORTED(run_events) void run_events(std::uint32_t count) {
    for (std::uint32_t k = 0; k < count; ++k) simulated->step();
}

/// 1: `time` was reached; 0: there are more events before it, or a problem.
EXPORTED(advance_to) std::uint32_t advance_to(double time, std::uint32_t maximum) {
    return simulated->advance_to(time, maximum);
}

/// JSON of the error message with which a run of the command line would end here (message_json).
/// `at_the_end` is 1 if this is the last event. Empty if there is no problem.
EXPORTED(problem) std::uint32_t problem(std::uint32_t at_the_end) {
    const auto found = at_the_end ? simulated->problem_at_the_end() : simulated->problem();
    return answer(found ? message_json(*found) : "");
}

/// The state at `time`, between the last event and the next, in the lab frame. Head: time, periods,
/// clock, container's centre and velocity (4 numbers), its radius, the direction from S to C (2),
/// N. Each disc: x, y, angle, spin, vx, vy, radius, 1 if it is pinned. Then for each sphere the
/// quaternion that takes its own axes to those of the lab.
EXPORTED(frame) const double* frame(double time) {
    const Snapshot& s = simulated->snapshot_at(time);
    const MFrame m = m_frame(s);
    numbers.assign({s.time(), double(s.periods), s.clock, s.container_centre.x,
                    s.container_centre.y, s.container_velocity.x, s.container_velocity.y,
                    s.container_radius, m.down.x, m.down.y, double(s.size())});
    for (std::size_t i = 0; i < s.size(); ++i) {
        const Vec2 at = s.position(i);
        numbers.insert(numbers.end(), {at.x, at.y, s.orientation(i), s.spin[i], s.vx[i], s.vy[i],
                                       s.radius[i], simulated->is_pinned(i) ? 1.0 : 0.0});
    }
    if (!s.are_balls()) return numbers.data();
    for (std::size_t i = 0; i < s.size(); ++i) {
        const Quaternion q = s.quaternion(i);
        numbers.insert(numbers.end(), {q.w, q.x, q.y, q.z});
    }
    return numbers.data();
}
/// The number of values in that frame.
EXPORTED(frame_size) std::uint32_t frame_size() {
    return static_cast<std::uint32_t>(numbers.size());
}

EXPORTED(time) double passed_time() { return simulated->time(); }
EXPORTED(events) double events() {
    return static_cast<double>(simulated->simulation().events().total());
}
EXPORTED(state_hash) std::uint64_t state_hash() { return simulated->simulation().state_hash(); }

/// JSON: ϖ/Ω so far by each rotation rate, without the warm-up. For the plot: the mean over the
/// discs and the rigid-body rate by time in blocks, with the warm-up; the number of blocks in the
/// warm-up; the periods per block in the warm-up and after it.
EXPORTED(rotation) std::uint32_t rotation() {
    const RotationEstimates e = corrected(simulated->rotation().estimates());
    std::string blocks, rigid_blocks;
    const auto add = [](std::string& list, const BlockSeries& series) {
        for (const double mean : series.block_means())
            list += (list.empty() ? "" : ",") + number(mean);
    };
    for (const ClusterRotation* part : {&simulated->rotation_in_warmup(), &simulated->rotation()}) {
        add(blocks, part->mean_by_time());
        add(rigid_blocks, part->rigid_by_time());
    }
    const BlockSeries &before = simulated->rotation_in_warmup().rigid_by_time(),
                      &after = simulated->rotation().rigid_by_time();
    return answer(fmt::format(
        R"({{"mean_by_event":{},"mean_by_time":{},"rigid_by_event":{},"rigid_by_time":{},"warmup":{},)"
        R"("warmup_blocks":{},"periods_per_block":[{},{}],"blocks":[{}],"rigid_blocks":[{}]}})",
        estimate_json(e.mean_by_event), estimate_json(e.mean_by_time),
        estimate_json(e.rigid_by_event), estimate_json(e.rigid_by_time), simulated->warmup(),
        before.size(), before.periods_per_block(), after.periods_per_block(), blocks,
        rigid_blocks));
}

/// Turns of the cluster (Container::turns), by hand since its start: the mean over the discs, and
/// the rigid body.
EXPORTED(turns) const double* turns() {
    const RotationSample& counted =
        is_by_hand(simulated->path()) ? turns_by_hand : simulated->turns();
    numbers.assign({counted.individual, counted.rigid});
    return numbers.data();
}

/// What shows the cause, averaged since the warm-up: slip parameter and perimeter of the cluster,
/// spin correlation of touching discs, and the shares of the collisions between discs and with the
/// wall that stop the slip; each with its error.
EXPORTED(cause) const double* cause() {
    numbers.clear();
    const auto add = [](std::initializer_list<std::string_view> names) {
        return [names](const ReportRow& row) {
            for (const std::string_view name : names)
                if (name == row.name)
                    numbers.insert(numbers.end(), {row.estimate.mean, row.estimate.error});
        };
    };
    simulated->slip().report(add({"cluster", "cluster_perimeter"}));
    simulated->frustration().report(add({"spin_correlation", "disc_sticking", "wall_sticking"}));
    return numbers.data();
}

/// The collisions since the last call: time, the discs (equal for the wall), 1 if friction stopped
/// the slip. values() has them.
EXPORTED(contacts) std::uint32_t contacts() {
    numbers.clear();
    for (const ContactMark& c : simulated->take_contacts())
        numbers.insert(numbers.end(), {c.time, double(c.i), double(c.j), double(c.sticks)});
    return static_cast<std::uint32_t>(numbers.size());
}

/// Whether maps are measured from now on (Container::show_maps), also in later simulations.
LABORATORY(show_maps) void show_maps(std::uint32_t shown) {
    maps_are_shown = shown != 0;
    if (simulated) simulated->show_maps(maps_are_shown);
}

/// Stores the current report of the maps; column() reads it.
LABORATORY(report) void report() {
    reports.clear();
    if (const PageObservation* maps = simulated->maps()) reports = maps->report();
}

/// Selects a column of the stored report, e.g. "density//by_time". Returns its number of values; 0
/// if there is no such column. values() has them.
LABORATORY(column) std::uint32_t column() {
    const std::string_view path = buffer;
    const std::size_t first = path.find('/'), second = path.find('/', first + 1);
    if (second == path.npos) return 0;
    for (const auto& [name, report] : reports) {
        if (name != path.substr(0, first)) continue;
        for (const ReportTable& table : report.tables) {
            if (table.name != path.substr(first + 1, second - first - 1)) continue;
            for (std::size_t c = 0; c < table.columns.size(); ++c) {
                if (table.columns[c].name != path.substr(second + 1)) continue;
                numbers.clear();
                for (std::size_t r = 0; r < table.rows(); ++r) numbers.push_back(table.at(r, c));
                return static_cast<std::uint32_t>(numbers.size());
            }
        }
    }
    return 0;
}
/// Selects the map of the spins (spin_map.hpp). Returns its number of values; values() has them.
LABORATORY(spin_map) std::uint32_t spin_map() {
    numbers = simulated->spins().means();
    return static_cast<std::uint32_t>(numbers.size());
}
EXPORTED(values) const double* values() { return numbers.data(); }

/// Memory for `count` runs, five numbers each: N, ϖ/Ω, its error, the periods after the warm-up,
/// and the effective number of samples.
EXPORTED(runs) double* runs(std::uint32_t count) {
    numbers.resize(runs_width * std::size_t{count});
    return numbers.data();
}
/// JSON of these runs: the estimate at each N, N_c with its error, interval and bracket (null where
/// there is none), and the N whose sign is not certain.
EXPORTED(crossing) std::uint32_t crossing() {
    const std::vector<RotationPoint> curve = curve_of_runs();
    const Crossing c = find_crossing(curve);
    const SignChange* const change = c.last();
    std::string points, undetermined;
    for (const RotationPoint& p : curve)
        points += fmt::format("{}[{},{},{}]", points.empty() ? "" : ",", number(p.discs),
                              number(p.mean), number(p.error));
    for (const double n : c.undetermined)
        undetermined += fmt::format("{}{}", undetermined.empty() ? "" : ",", n);
    return answer(JsonObject()
                      .add("verdict", json_text(name_of(c.verdict)))
                      .add("discs", c.discs)
                      .add("error", c.error)
                      .add("lower", c.lower)
                      .add("upper", c.upper)
                      .add("before", change ? change->before : not_available)
                      .add("after", change ? change->after : not_available)
                      .add("undetermined", '[' + undetermined + ']')
                      .add("points", '[' + points + ']')
                      .text());
}

/// Memory for `count` runs of a search (search_width).
LABORATORY(search_runs) double* search_runs(std::uint32_t count) {
    numbers.resize(search_width * std::size_t{count});
    return numbers.data();
}
/// JSON of the runs that the search makes next (N, replica, length in that of the first runs), and
/// whether N_c is within the tolerance. The rules are made for a page: one run at a time at each
/// number, and few of them.
LABORATORY(search) std::uint32_t search(double from, double to, double tolerance, double rounds) {
    CrossingRules rules{.from = std::int64_t(from),
                        .to = std::int64_t(to),
                        .tolerance = tolerance,
                        .curves = rotation_rates.size(),
                        .seeds = 1};
    rules.rounds = int(rounds);
    rules.sign_length = 8.0;
    rules.at_once = 3;
    CrossingSearch search(rules);
    std::string runs;
    for (const ProposedRun& run : repeat(search))
        runs += fmt::format("{}[{},{},{}]", runs.empty() ? "" : ",", run.discs, run.replica,
                            run.length);
    return answer(JsonObject()
                      .add("runs", '[' + runs + ']')
                      .add("within_tolerance", search.is_within_tolerance() ? "true" : "false")
                      .text());
}

/// The result as `swirl run --json` writes it, without the keys on the program's build, its command
/// line and its duration (docs/how-to/browser_page.md).
LABORATORY(result) std::uint32_t result() {
    simulated->pass_found_event();
    const RunResult r = simulated->result();
    const MeasuredUnits units = units_of(r.config);
    JsonObject given, events, warmup, rotation, steady, others, measured;
    for (const Parameter& p : run_parameters) {
        if (!p.is_written()) continue;
        const ParameterValue value = value_of(p, r.config);
        if (p.is_omitted(value)) continue;
        given.add(p.name, std::visit(ValueJson(), value));
    }
    events.add("total", double(r.events.total()))
        .add("disc_disc", double(r.events.disc_disc))
        .add("disc_wall", double(r.events.disc_wall))
        .add("path_vertex", double(r.events.path_vertex))
        .add("elastic_by_tc_model", double(r.events.elastic_by_tc));
    if (r.events.begins_to_roll > 0) events.add("begins_to_roll", double(r.events.begins_to_roll));
    warmup.add("periods", double(r.warmup)).add("events", double(r.warmup_events.total()));
    steady.add("verdict", json_text(verdict(r.steady_state())))
        .add("found", json_text(steady_state_found(r)));
    r.report([&](std::string_view group, const ReportRow& row) {
        JsonObject& into = group == "rotation"       ? rotation
                           : group == "steady_state" ? steady
                                                     : others;
        into.add(row.name, row_json(row));
    });
    for (const auto& [name, report] : simulated->observation().report())
        measured.add(name, report_json(report));
    std::string joined;
    for (const std::string& warning : warnings(r))
        joined += (joined.empty() ? "" : ",") + json_text(warning);
    return answer(
        JsonObject()
            .add("format", fmt::format("{}", result_format))
            .add("config", given.text())
            .add("units", JsonObject().add("r", units.r).add("v", units.v).add("m", units.m).text())
            .add("complete", "true")
            .add("events", events.text())
            .add("periods", r.periods)
            .add("warmup", warmup.text())
            .add("rotation", rotation.text())
            .add("steady_state", steady.text())
            .add(others)
            .add("state_hash", json_text(fmt::format("{:016x}", r.state_hash)))
            .add("warnings", '[' + joined + ']')
            .add("generator", json_text(random_generator))
            .add("measured", measured.text())
            .text());
}
