// The laboratory behind functions of plain numbers, as a page in a browser calls them: one dish,
// its parameters read as the command line reads them, its averages, its events one by one.
//
// Texts go through one buffer: the page writes its own there before a call, and finds ours there
// after it; a function that answers with a text returns its length. Where the command line would
// end with a sentence, the page's `refuse` gets it. That function throws, on the page's side, so
// what stands on our stack is lost: after it the page takes a new instance.
//
// Only this folder knows about the page; engine, measurements and parameters are the same files as
// everywhere.
#include <fmt/format.h>

#include <cstdint>
#include <cstring>
#include <memory>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "dish.hpp"
#include "json.hpp"
#include "swirl/measure/m_frame.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/parameters.hpp"
#include "swirl/run/report.hpp"
#include "swirl/run/shell_word.hpp"
#include "swirl/run/version.hpp"
#include "swirl/statistics/zero_crossing.hpp"

#define EXPORTED(name) extern "C" __attribute__((export_name(#name)))

extern "C" {
[[noreturn]] __attribute__((import_module("page"), import_name("refuse"))) void page_reject(
    const char* text, std::size_t size);
}

namespace swirl {

void throw_usage_error(const std::string& sentence) {
    page_reject(sentence.data(), sentence.size());
}
void throw_interrupted(const std::string& sentence) { throw_usage_error(sentence); }

namespace {

std::string buffer;

std::uint32_t answer(std::string text) {
    buffer = std::move(text);
    return static_cast<std::uint32_t>(buffer.size());
}

/// "name=value" on every line.
ParameterTexts texts_in(std::string_view lines) {
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

std::vector<std::string> names_in(std::string_view list) {
    std::vector<std::string> names;
    while (!list.empty()) {
        const std::size_t comma = std::min(list.find(','), list.size());
        if (find_measurement(list.substr(0, comma))) names.emplace_back(list.substr(0, comma));
        list.remove_prefix(std::min(comma + 1, list.size()));
    }
    return names;
}

struct Asked {
    RunConfig config;
    std::vector<std::string> measured;
    ParameterTexts given;
};
Asked asked_for(std::string_view lines) {
    ParameterTexts given = texts_in(lines);
    std::vector<std::string> measured;
    if (const auto found = given.find("measure"); found != given.end()) {
        measured = names_in(found->second);
        given.erase(found);
    }
    RunConfig config = resolve(given);
    return {std::move(config), std::move(measured), std::move(given)};
}

std::unique_ptr<Container> simulated;
ParameterTexts given_to_container;  // at its beginning
std::vector<double> numbers;
std::vector<MeasurementReport> reports;

/// The parameters that change at contacts, and where the container goes: discs go on with others of
/// these; with any other parameter it is another dish.
bool only_contacts_and_path_differ(const RunConfig& a, RunConfig b) {
    b.mu_disc = a.mu_disc;
    b.mu_wall = a.mu_wall;
    b.restitution = a.restitution;
    b.tangential_restitution = a.tangential_restitution;
    b.contact_duration = a.contact_duration;
    b.vertical_disc = a.vertical_disc;
    b.vertical_wall = a.vertical_wall;
    b.floor_friction = a.floor_friction;
    b.gravity = a.gravity;
    b.rolling_resistance = a.rolling_resistance;
    b.amplitude = a.amplitude;
    b.period = a.period;
    b.sides = a.sides;
    b.path = a.path;
    b.warmup = a.warmup;
    return texts_of(a) == texts_of(b);
}

/// Of a parameter.
struct ValueJson {
    std::string operator()(std::monostate) const { return "null"; }
    std::string operator()(const Mixture& m) const {
        return JsonObject()
            .add("count", double(m.count))
            .add("radius", m.radius)
            .add("mass", m.mass)
            .text();
    }
    std::string operator()(const std::string& word) const { return quoted(word); }
    std::string operator()(const auto& value) const { return fmt::format("{}", value); }
};

/// Of the points between disc i and this one, the farthest to which the disc can be moved, others
/// and the wall in the way; the point itself if there is room for the disc.
Vec2 nearest_with_room(const InitialState& state, std::size_t i, const Vec2& point) {
    constexpr double gap = 1e-9;  // the rounding of a contact that is worked out
    const Disc& disc = state.discs[i];
    const Vec2 from = disc.position, way = point - from;
    const Vec2 centre = state.path.segments.front().start;
    const double room = (state.container_radius - disc.radius) * (1.0 - gap);
    const auto fits = [&](const Vec2& p) {
        if (dot(p - centre, p - centre) > room * room) return false;
        for (std::size_t j = 0; j < state.discs.size(); ++j) {
            const Vec2 d = p - state.discs[j].position;
            const double reach = (disc.radius + state.discs[j].radius) * (1.0 + gap);
            if (j != i && dot(d, d) < reach * reach) return false;
        }
        return true;
    };
    if (fits(point)) return point;
    // Halving finds one of the places where it is stopped, which is all that is wanted.
    double there = 0.0, blocked = 1.0;
    for (int step = 0; step < 40; ++step) {
        const double middle = 0.5 * (there + blocked);
        (fits(from + middle * way) ? there : blocked) = middle;
    }
    return from + there * way;
}

/// From, to, step.
std::string slider_json(const SliderRange& slider) {
    if (slider.step == 0.0) return "null";
    return fmt::format("[{},{},{}]", slider.from, slider.to, slider.step);
}

std::string parameter_json(const Parameter& p) {
    return fmt::format(
        R"({{"name":{},"symbol":{},"unit":{},"form":{},"description":{},"group":{},"default":{},)"
        R"("lowest":{},"highest":{},"usual":{},"given":{}}})",
        quoted(p.name), quoted(p.symbol), quoted(p.unit), quoted(p.form), quoted(p.description),
        quoted(p.group), quoted(default_of(p)), number(p.range.lowest), number(p.range.highest),
        slider_json(p.slider), p.is_settable());
}

}  // namespace
}  // namespace swirl

using namespace swirl;

/// Room for a text of the page's.
EXPORTED(room) char* room(std::uint32_t size) {
    buffer.resize(size);
    return buffer.data();
}
EXPORTED(text) const char* text() { return buffer.data(); }

/// The table of parameters, JSON.
EXPORTED(parameters) std::uint32_t parameters() {
    std::string json = "[";
    for (const Parameter& p : run_parameters)
        json += (json.size() > 1 ? "," : "") + parameter_json(p);
    return answer(json + "]");
}

/// A new dish, at rest: "name=value" on every line, as on the command line, and "measure=a,b,c".
EXPORTED(begin) void begin() {
    auto [config, measured, given] = asked_for(buffer);
    simulated.reset();
    simulated = std::make_unique<Container>(config, make_initial_state(config), measured);
    given_to_container = std::move(given);
}

/// 1: change() would keep the discs; 0: it would be another dish.
EXPORTED(keeps) std::uint32_t keeps() {
    return only_contacts_and_path_differ(simulated->config(), asked_for(buffer).config);
}

/// The same discs, at this moment and from the container's first leg on, with other frictions,
/// restitutions or another path; the averages begin anew. 0: it would be another dish.
EXPORTED(change) std::uint32_t change(double time) {
    const auto [config, measured, given] = asked_for(buffer);
    if (!only_contacts_and_path_differ(simulated->config(), config)) return 0;
    const InitialState state = simulated->going_on(time, config, make_path(config));
    simulated = std::make_unique<Container>(config, state, measured);
    return 1;
}

/// Time runs backwards from this moment on: all velocities and spins turned round, and the path,
/// too. 0: not without loss, since the dish has friction, a floor, or discs that do not bounce back
/// fully.
EXPORTED(reverse) std::uint32_t reverse(double time) {
    const RunConfig& config = simulated->config();
    if (!config.conserves_energy()) return 0;
    const double clock = simulated->seen_at(time).clock;
    const ContainerPath back =
        path_from(backwards(simulated->path()), simulated->path().period - clock);
    InitialState state = simulated->going_on(time, config, back);
    for (Disc& disc : state.discs) {
        disc.velocity = -1.0 * disc.velocity;
        disc.spin = -disc.spin;
    }
    simulated = std::make_unique<Container>(config, state, simulated->measured());
    return 1;
}

/// Disc i is put as near to (x, y) as there is room on the way, and moves with the dish there; all
/// others go on as they are.
EXPORTED(drag) void drag(double time, std::uint32_t i, double x, double y) {
    const ContainerPath later = path_from(simulated->path(), simulated->seen_at(time).clock);
    InitialState state = simulated->going_on(time, simulated->config(), later);
    if (i >= state.discs.size()) return;
    Disc& disc = state.discs[i];
    disc.position = nearest_with_room(state, i, {x, y});
    disc.velocity = later.segments.front().velocity;
    disc.spin = 0.0;
    simulated = std::make_unique<Container>(simulated->config(), state, simulated->measured());
}

/// By hand: from this moment on the container goes straight to (x, y), which takes the duration
/// (above 0), and stays there. Times begin anew, and so do averages, which have no swirl to go by.
EXPORTED(steer) void steer(double time, double x, double y, double duration) {
    RunConfig config = simulated->config();
    const Vec2 from = simulated->seen_at(time).container_centre;
    const InitialState state =
        simulated->going_on(time, config, path_by_hand(from, {x, y}, duration));
    config.period = state.path.period;
    simulated = std::make_unique<Container>(config, state, std::vector<std::string>{});
}

/// What the dish is, "name=value" on every line: what was not given is there, too.
EXPORTED(configuration) std::uint32_t configuration() {
    std::string lines;
    for (const auto& [name, value] : texts_of(simulated->config()))
        lines += fmt::format("{}={}\n", name, value);
    return answer(lines);
}

/// The command line that comes to the last event that was passed, for a dish that nobody has
/// changed since its beginning. Without a warm-up that was given it would choose one by the length
/// of the run; it gets the page's, unless the run ends within it and would be refused.
EXPORTED(command) std::uint32_t command() {
    ParameterTexts texts = given_to_container;
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

/// None where there is trouble, and none after it.
EXPORTED(run_events) void run_events(std::uint32_t count) {
    for (std::uint32_t k = 0; k < count; ++k) simulated->step();
}

/// 1: it has come there; 0: there are more events before, or trouble.
EXPORTED(advance_to) std::uint32_t advance_to(double time, std::uint32_t maximum) {
    return simulated->advance_to(time, maximum);
}

/// The sentence with which a run of the command line would have ended here, if it is the end (1) or
/// not (0); nothing for a sound run.
EXPORTED(problem) std::uint32_t problem(std::uint32_t at_the_end) {
    return answer(
        (at_the_end ? simulated->problem_at_the_end() : simulated->problem()).value_or(""));
}

/// The dish at a moment (between the last event and the next): time, swirls, clock, container's
/// centre and velocity (4), its radius, the direction from S to C (2), N; then of every disc x, y,
/// angle, spin, vx, vy, radius, 1 if it is pinned; then of every sphere the quaternion that takes
/// its own axes to the lab's. In the lab frame.
EXPORTED(frame) const double* frame(double time) {
    const Snapshot& s = simulated->seen_at(time);
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
/// How many numbers that frame has.
EXPORTED(frame_size) std::uint32_t frame_size() {
    return static_cast<std::uint32_t>(numbers.size());
}

namespace {
/// Time, kind (0 disc and disc, 1 disc and wall, 2 corner of the path, 3 begins to roll), i, j,
/// normal (2), impulse along it and along the tangent, sticks.
const double* numbers_of(const Event& e) {
    numbers.assign({double(e.periods) * simulated->config().period + e.clock,
                    double(static_cast<int>(e.kind)), double(e.i), double(e.j), e.normal.x,
                    e.normal.y, e.impulse.normal, e.impulse.tangential, double(e.impulse.sticks)});
    return numbers.data();
}
}  // namespace

/// The last one that was passed.
EXPORTED(event) const double* event() { return numbers_of(simulated->event()); }
/// The one to come.
EXPORTED(next_event) const double* next_event() { return numbers_of(simulated->next_event()); }

EXPORTED(time) double passed_time() { return simulated->time(); }
EXPORTED(events) double events() {
    return static_cast<double>(simulated->simulation().events().total());
}
EXPORTED(state_hash) std::uint64_t state_hash() { return simulated->simulation().state_hash(); }

/// ϖ/Ω so far by each of the rotation rates, without the warm-up. For the plot, the rigid-body rate
/// by time block for block, with the warm-up: a disc near the centre of mass makes peaks in the
/// other. How many of the blocks are the warm-up's and how many swirls a block has, there and after
/// it: JSON.
EXPORTED(rotation) std::uint32_t rotation() {
    const RotationEstimates e = simulated->rotation().estimates();
    std::string blocks;
    for (const ClusterRotation* part : {&simulated->rotation_in_warmup(), &simulated->rotation()})
        for (const double mean : part->rigid_by_time().block_means())
            blocks += (blocks.empty() ? "" : ",") + number(mean);
    const BlockSeries &before = simulated->rotation_in_warmup().rigid_by_time(),
                      &after = simulated->rotation().rigid_by_time();
    return answer(fmt::format(
        R"({{"by_event":{},"by_time":{},"rigid_by_event":{},"rigid_by_time":{},"warmup":{},)"
        R"("warmup_blocks":{},"swirls_per_block":[{},{}],"blocks":[{}]}})",
        estimate_json(e.by_event), estimate_json(e.by_time), estimate_json(e.rigid_by_event),
        estimate_json(e.rigid_by_time), simulated->warmup(), before.size(),
        before.periods_per_block(), after.periods_per_block(), blocks));
}

/// What is measured, as it is now: for the columns to come.
EXPORTED(report) void report() { reports = simulated->observation().report(); }

/// A column of a table of the last report: "density//by_time". How many values there are; 0 if
/// there is no such column.
EXPORTED(column) std::uint32_t column() {
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
EXPORTED(values) const double* values() { return numbers.data(); }

/// N_c of a curve ϖ(N): so many points of three numbers, N, mean and error, from values() on. JSON;
/// null without a crossing; N_c and its error are null where only the bracket is known.
EXPORTED(points) double* points(std::uint32_t count) {
    numbers.resize(3 * std::size_t{count});
    return numbers.data();
}
EXPORTED(crossing) std::uint32_t crossing() {
    std::vector<RotationPoint> curve;
    for (std::size_t k = 0; k + 2 < numbers.size(); k += 3)
        curve.push_back({numbers[k], numbers[k + 1], numbers[k + 2]});
    const Crossing c = find_crossing(curve);
    if (c.verdict != Crossing::Verdict::crosses) return answer("null");
    return answer(fmt::format(R"({{"discs":{},"error":{},"lower":{},"upper":{}}})", number(c.discs),
                              number(c.error), number(c.lower), number(c.upper)));
}

/// The result as `swirl run --json` writes it, as far as a page knows it: not which build of the
/// program it was, how it was called, and how long it took (docs/how-to/browser_page.md).
EXPORTED(result) std::uint32_t result() {
    simulated->settle();
    const RunResult r = simulated->result();
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
    steady.add("verdict", quoted(verdict(r.steady_state())))
        .add("found", quoted(steady_state_found(r)));
    r.report([&](std::string_view group, const ReportRow& row) {
        JsonObject& into = group == "rotation"       ? rotation
                           : group == "steady_state" ? steady
                                                     : others;
        into.add(row.name, row_json(row));
    });
    for (const auto& [name, report] : simulated->observation().report())
        measured.add(name, report_json(report));
    std::string said;
    for (const std::string& warning : warnings(r))
        said += (said.empty() ? "" : ",") + quoted(warning);
    return answer(JsonObject()
                      .add("format", fmt::format("{}", result_format))
                      .add("config", given.text())
                      .add("complete", "true")
                      .add("events", events.text())
                      .add("periods", r.periods)
                      .add("warmup", warmup.text())
                      .add("rotation", rotation.text())
                      .add("steady_state", steady.text())
                      .add(others)
                      .add("state_hash", quoted(fmt::format("{:016x}", r.state_hash)))
                      .add("warnings", '[' + said + ']')
                      .add("generator", quoted(random_generator))
                      .add("measured", measured.text())
                      .text());
}
