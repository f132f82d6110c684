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
#include "swirl/measure/crossing.hpp"
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

struct Asked {
    RunConfig config;
    std::vector<std::string> measured;
};
Asked asked_for(std::string_view lines) {
    ParameterTexts given = texts_in(lines);
    std::vector<std::string> measured;
    if (const auto found = given.find("measure"); found != given.end()) {
        measured = names_in(found->second);
        given.erase(found);
    }
    return {resolve(given), std::move(measured)};
}

/// One dish under observation. An event is found first, by executing it: until then the state of
/// the snapshot holds, and can be looked at in between; then it is passed.
class Dish {
  public:
    Dish(const RunConfig& config, const InitialState& begin, std::vector<std::string> measured)
        : config_(config),
          path_(begin.path),
          simulation_(begin),
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
        // The samples may have moved the snapshot on towards the next event.
        seen_.clock = std::fmin(std::fmax(passed_clock_, clock), config_.period);
        const Leg& leg = path_.leg_at(seen_.clock);
        seen_.container_centre = leg.position_at(seen_.clock);
        seen_.container_velocity = leg.velocity_at(seen_.clock);
        return seen_;
    }
    /// Of the last event that was passed.
    double time() const {
        return static_cast<double>(snapshot_.swirls) * config_.period + passed_clock_;
    }

    /// What another dish begins with whose discs are where they are at this moment, as seen from
    /// the container, which is put where that dish's path begins. Velocities stay as they are: to
    /// the discs it is a corner.
    InitialState going_on(double time, const RunConfig& config, const ContainerPath& path) {
        InitialState state = without_discs(config, path);
        const Snapshot now = seen_at(time).up_to_date();
        const Leg& leg = path.legs.front();
        for (std::size_t i = 0; i < now.size(); ++i) {
            Disc disc = now.disc(i);
            disc.position = disc.position + (leg.start - now.container_centre);
            disc.time = 0.0;
            state.discs.push_back(disc);
        }
        return state;
    }

  private:
    static constexpr int rotation_samples = 64;  // per swirl, as in every run

    double time_of(const Event& event) const {
        return static_cast<double>(event.swirls) * config_.period + event.clock;
    }
    /// Spheres brought up to date, as a run shows them: an observer takes it that nobody is
    /// accelerated.
    const Snapshot& observed() {
        if (!snapshot_.are_spheres()) return snapshot_;
        snapshot_.up_to_date(dated_);
        return dated_;
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
            observation_.sample(observed());
    }
    void pass() {
        found_ = false;
        ClusterRotation& rotation = rotation_now();
        const bool watched = observes();
        simulation_.refresh(snapshot_, event_);
        passed_clock_ = snapshot_.clock;
        rotation.follow(snapshot_, event_);
        rotation.sample(snapshot_);
        if (watched) observation_.sample(event_, observed());
        if (snapshot_.swirls == event_.swirls) return;
        rotation.close_block();
        if (watched) observation_.close_block();
    }
    bool observes() const { return counts() && !observation_.empty(); }

    const RunConfig config_;
    const ContainerPath path_;
    Simulation simulation_;
    Snapshot snapshot_, seen_, dated_;
    Event event_{};
    bool found_ = false;
    double passed_clock_ = 0.0;  // of the last event that was passed
    SampleTimes rotation_times_, observation_times_;
    ClusterRotation in_warmup_, rotation_;
    Observation observation_;
};

std::unique_ptr<Dish> dish;
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
    b.amplitude = a.amplitude;
    b.period = a.period;
    b.sides = a.sides;
    b.path = a.path;
    b.warmup = a.warmup;
    return texts_of(a) == texts_of(b);
}

/// Straight to a point, and there it waits to be told where next. At rest at once: that is a
/// corner, as all others.
ContainerPath path_by_hand(const Vec2& from, const Vec2& to, double duration) {
    constexpr double long_enough = 1e6;  // periods of a container without any
    return {long_enough,
            {{0.0, duration, from, (1.0 / duration) * (to - from), 0.0},
             {duration, long_enough, to, {0.0, 0.0}, 0.0}}};
}

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
    const auto [config, measured] = asked_for(buffer);
    dish.reset();
    dish = std::make_unique<Dish>(config, make_initial_state(config), measured);
}

/// The same discs, at this moment and from the container's first leg on, with other frictions,
/// restitutions or another path; the averages begin anew. 0: it would be another dish.
EXPORTED(change) std::uint32_t change(double time) {
    const auto [config, measured] = asked_for(buffer);
    if (!only_contacts_and_path_differ(dish->config(), config)) return 0;
    const InitialState state = dish->going_on(time, config, make_path(config));
    dish = std::make_unique<Dish>(config, state, measured);
    return 1;
}

/// By hand: from this moment on the container goes straight to (x, y), which takes the duration
/// (above 0), and stays there. Times begin anew, and so do averages, which have no swirl to go by.
EXPORTED(steer) void steer(double time, double x, double y, double duration) {
    RunConfig config = dish->config();
    const Vec2 from = dish->seen_at(time).container_centre;
    const InitialState state = dish->going_on(time, config, path_by_hand(from, {x, y}, duration));
    config.period = state.path.period;
    dish = std::make_unique<Dish>(config, state, std::vector<std::string>{});
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

/// What is measured, as it is now: for the columns to come.
EXPORTED(report) void report() { reports = dish->observation().report(); }

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
/// null without a crossing.
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
