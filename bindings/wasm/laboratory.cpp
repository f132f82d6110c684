// The laboratory behind functions of plain numbers, as a page in a browser calls them: one dish,
// its parameters read as the command line reads them, its averages, its events one by one.
//
// Texts go through one buffer: the page writes its own there before a call, and finds ours there
// after it; a function that answers with a text returns its length. Where the command line would
// end with a sentence, the page's `refuse` gets it. That function throws, on the page's side, so
// what stands on our stack is lost: after it the page takes a new instance.
//
// Only this file knows about the page; engine, measurements and parameters are the same files as
// everywhere.
#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "swirl/measure/cluster_rotation.hpp"
#include "swirl/measure/m_frame.hpp"
#include "swirl/measure/observation.hpp"
#include "swirl/measure/sample_times.hpp"
#include "swirl/run/config.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/parameters.hpp"
#include "swirl/simulation/simulation.hpp"

#define EXPORTED(name) extern "C" __attribute__((export_name(#name)))

extern "C" {
[[noreturn]] __attribute__((import_module("page"), import_name("refuse"))) void page_refuse(
    const char* text, std::size_t size);
}

namespace swirl {

void throw_wrong_call(const std::string& sentence) {
    page_refuse(sentence.data(), sentence.size());
}
void throw_interrupted(const std::string& sentence) { throw_wrong_call(sentence); }

namespace {

std::string buffer;

std::uint32_t answer(std::string text) {
    buffer = std::move(text);
    return static_cast<std::uint32_t>(buffer.size());
}

/// As JSON has it; what is not known is null.
std::string number(double x) { return std::isfinite(x) ? fmt::format("{}", x) : "null"; }

std::string quoted(std::string_view text) {
    std::string json = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') json += '\\';
        json += c;
    }
    return json + '"';
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

/// One dish under observation. An event is found first, by executing it: until then the state of
/// the snapshot holds, and can be looked at in between; then it is passed.
class Dish {
  public:
    Dish(const RunConfig& config, std::vector<std::string> measured)
        : config_(config),
          path_(make_path(config)),
          simulation_(make_initial_state(config)),
          snapshot_(simulation_.snapshot()),
          seen_(snapshot_),
          rotation_times_(rotation_samples, config.period),
          observation_times_(samples_per_period, config.period),
          observation_(config.container_radius, config.period, std::move(measured)) {}

    const Event& event() const { return event_; }
    const Simulation& simulation() const { return simulation_; }
    const RunConfig& config() const { return config_; }
    const ClusterRotation& in_warmup() const { return in_warmup_; }
    const ClusterRotation& rotation() const { return rotation_; }
    const Observation& observation() const { return observation_; }
    std::int64_t warmup() const { return config_.warmup.value_or(default_warmup); }

    void step() {
        if (!found_) find();
        pass();
    }

    /// All events up to a moment, but no more than `most`; says whether it has come to that moment.
    bool advance_to(double time, std::uint32_t most) {
        for (;;) {
            if (!found_) find();
            if (time_of(event_) > time) return true;
            if (most-- == 0) return false;
            pass();
        }
    }

    /// The dish at a moment between the last event and the next.
    const Snapshot& seen_at(double time) {
        seen_ = snapshot_;
        const double clock = time - static_cast<double>(seen_.swirls) * config_.period;
        seen_.clock = std::fmin(std::fmax(seen_.clock, clock), config_.period);
        const Leg& leg = path_.leg_at(seen_.clock);
        seen_.container_centre = leg.position_at(seen_.clock);
        seen_.container_velocity = leg.velocity_at(seen_.clock);
        return seen_;
    }
    /// Of the last event that was passed.
    double time() const { return snapshot_.time(); }

  private:
    static constexpr int rotation_samples = 64;  // per swirl, as in every run

    double time_of(const Event& event) const {
        return static_cast<double>(event.swirls) * config_.period + event.clock;
    }
    bool counts() const { return snapshot_.swirls >= warmup(); }
    ClusterRotation& rotation_now() { return counts() ? rotation_ : in_warmup_; }

    void find() {
        event_ = simulation_.step();
        found_ = true;
        while (rotation_times_.next(snapshot_, path_, event_.clock))
            rotation_now().sample_by_time(snapshot_);
        if (!observes()) return;
        while (observation_times_.next(snapshot_, path_, event_.clock))
            observation_.sample(snapshot_);
    }
    void pass() {
        found_ = false;
        ClusterRotation& rotation = rotation_now();
        const bool observed = observes();
        simulation_.refresh(snapshot_, event_);
        rotation.follow(snapshot_, event_);
        rotation.sample(snapshot_);
        if (observed) observation_.sample(event_, snapshot_);
        if (snapshot_.swirls == event_.swirls) return;
        rotation.close_block();
        if (observed) observation_.close_block();
    }
    bool observes() const { return counts() && !observation_.empty(); }

    const RunConfig config_;
    const ContainerPath path_;
    Simulation simulation_;
    Snapshot snapshot_, seen_;
    Event event_{};
    bool found_ = false;
    SampleTimes rotation_times_, observation_times_;
    ClusterRotation in_warmup_, rotation_;
    Observation observation_;
};

std::unique_ptr<Dish> dish;
std::vector<double> numbers;

std::string row_json(const Parameter& p) {
    return fmt::format(
        R"({{"name":{},"symbol":{},"unit":{},"form":{},"description":{},"group":{},"default":{},)"
        R"("lowest":{},"highest":{},"given":{}}})",
        quoted(p.name), quoted(p.symbol), quoted(p.unit), quoted(p.form), quoted(p.description),
        quoted(p.group), quoted(default_of(p)), number(p.lowest), number(p.highest),
        p.can_be_given());
}

std::string estimate_json(const Estimate& e) {
    return fmt::format(R"({{"mean":{},"error":{},"blocks":{}}})", number(e.mean), number(e.error),
                       e.blocks);
}

std::string table_json(const ReportTable& table) {
    std::string json;
    for (std::size_t c = 0; c < table.columns.size(); ++c) {
        json += fmt::format("{}{}:[", c ? "," : "{", quoted(table.columns[c].name));
        for (std::size_t r = 0; r < table.rows(); ++r)
            json += (r ? "," : "") + number(table.at(r, c));
        json += ']';
    }
    return json + '}';
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
    for (const Parameter& p : run_parameters) json += (json.size() > 1 ? "," : "") + row_json(p);
    return answer(json + "]");
}

/// A new dish, at rest: "name=value" on every line, as on the command line, and "measure=a,b,c".
EXPORTED(begin) void begin() {
    ParameterTexts given = texts_in(buffer);
    std::vector<std::string> measured;
    if (const auto found = given.find("measure"); found != given.end()) {
        measured = names_in(found->second);
        given.erase(found);
    }
    const RunConfig config = resolve(given);
    dish.reset();
    dish = std::make_unique<Dish>(config, std::move(measured));
}

/// What the dish is, "name=value" on every line: what was not given is there, too.
EXPORTED(configuration) std::uint32_t configuration() {
    std::string lines;
    for (const auto& [name, value] : texts_of(dish->config()))
        lines += fmt::format("{}={}\n", name, value);
    return answer(lines);
}

EXPORTED(run_events) void run_events(std::uint32_t count) {
    for (std::uint32_t k = 0; k < count; ++k) dish->step();
}

/// 1: it has come there; 0: there are more events before.
EXPORTED(advance_to) std::uint32_t advance_to(double time, std::uint32_t most) {
    return dish->advance_to(time, most);
}

/// The dish at a moment (between the last event and the next): time, swirls, clock, container's
/// centre and velocity (4), its radius, the direction from S to C (2), N; then of every disc x, y,
/// angle, spin, vx, vy, radius. In the lab frame.
EXPORTED(frame) const double* frame(double time) {
    const Snapshot& s = dish->seen_at(time);
    const MFrame m = m_frame(s);
    numbers.assign({s.time(), double(s.swirls), s.clock, s.container_centre.x, s.container_centre.y,
                    s.container_velocity.x, s.container_velocity.y, s.container_radius, m.down.x,
                    m.down.y, double(s.size())});
    for (std::size_t i = 0; i < s.size(); ++i) {
        const Vec2 at = s.position(i);
        numbers.insert(numbers.end(),
                       {at.x, at.y, s.orientation(i), s.spin[i], s.vx[i], s.vy[i], s.radius[i]});
    }
    return numbers.data();
}

/// Of the last event passed: time, kind (0 disc and disc, 1 disc and wall, 2 corner of the path),
/// i, j, normal (2), impulse along it and along the tangent, sticks.
EXPORTED(event) const double* event() {
    const Event& e = dish->event();
    const double kind = e.kind == EventKind::disc_disc   ? 0.0
                        : e.kind == EventKind::disc_wall ? 1.0
                                                         : 2.0;
    numbers.assign({double(e.swirls) * dish->config().period + e.clock, kind, double(e.i),
                    double(e.j), e.normal.x, e.normal.y, e.impulse.normal, e.impulse.tangential,
                    double(e.impulse.sticks)});
    return numbers.data();
}

EXPORTED(time) double passed_time() { return dish->time(); }
EXPORTED(events) double events() {
    return static_cast<double>(dish->simulation().events().total());
}
EXPORTED(state_hash) std::uint64_t state_hash() { return dish->simulation().state_hash(); }

/// ϖ/Ω so far, by event and by time, without the warm-up; by time swirl for swirl, with it: JSON.
EXPORTED(rotation) std::uint32_t rotation() {
    const RotationEstimates e = dish->rotation().estimates();
    std::string blocks;
    for (const ClusterRotation* part : {&dish->in_warmup(), &dish->rotation()})
        for (const double mean : part->by_time().block_means())
            blocks += (blocks.empty() ? "" : ",") + number(mean);
    return answer(fmt::format(R"({{"by_event":{},"by_time":{},"warmup":{},"blocks":[{}]}})",
                              estimate_json(e.by_event), estimate_json(e.by_time), dish->warmup(),
                              blocks));
}

/// What was asked for with "measure", as `swirl run --json` has it under "measured".
EXPORTED(measured) std::uint32_t measured() {
    std::string json;
    for (const auto& [name, report] : dish->observation().report()) {
        json += fmt::format("{}{}:{{\"rows\":{{", json.empty() ? "{" : ",", quoted(name));
        bool first = true;
        for (const ReportRow& row : report.rows) {
            json += fmt::format("{}{}:{}", first ? "" : ",", quoted(row.name),
                                estimate_json(row.estimate));
            first = false;
        }
        json += "},\"tables\":{";
        first = true;
        for (const ReportTable& table : report.tables) {
            json += fmt::format("{}{}:{}", first ? "" : ",", quoted(table.name), table_json(table));
            first = false;
        }
        json += "}}";
    }
    return answer(json.empty() ? "{}" : json + '}');
}
