#include "swirl/study/bench.hpp"

#include <fmt/format.h>
#include <time.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>

#include "swirl/files/table.hpp"
#include "swirl/math/random.hpp"
#include "swirl/measure/cluster_rotation.hpp"
#include "swirl/run/config.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/version.hpp"
#include "swirl/simulation/placement.hpp"
#include "swirl/study/rival/plain_lists.hpp"
#include "swirl/study/rival/plain_loop.hpp"

namespace swirl {
namespace {

/// Processor time of this thread in seconds: what else runs here does not count.
double now() {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    const std::size_t n = values.size();
    return n % 2 == 1 ? values[n / 2] : 0.5 * (values[n / 2 - 1] + values[n / 2]);
}

enum class Kind { dish, gas, large_dish, spheres };

struct BenchScene {
    const char* name;
    Kind kind;
    std::int64_t discs;
    double packing;  // of what is not in the paper's dish
    std::optional<double> target, ratio_target;
    bool plain;
    bool only_full;
};

// The paper's dish at N = 48: 48 / 8.6².
constexpr double paper_packing = 48.0 / (paper_container_radius * paper_container_radius);

// The experiment's at N = 48.
constexpr double spheres_packing =
    48.0 / (experiment_container_radius * experiment_container_radius);

constexpr const char* dense_gas = "gas, packing 0.7";
constexpr const char* spheres = "spheres, mu = 0.2";

const std::vector<BenchScene>& bench_scenes() {
    static const std::vector<BenchScene> all = {
        {"dish, mu = 1", Kind::dish, 48, 0, 7e6, 13.0, true, false},
        {"dish, mu = 1", Kind::dish, 28, 0, 8e6, 6.5, true, false},
        {"dish, mu = 1", Kind::dish, 5, 0, 16e6, 2.0, true, false},
        {dense_gas, Kind::gas, 1000, 0.70, 6e6, {}, true, false},
        {dense_gas, Kind::gas, 10000, 0.70, 5e6, {}, true, false},
        {dense_gas, Kind::gas, 100000, 0.70, 3e6, {}, true, false},
        {dense_gas, Kind::gas, 1000000, 0.70, 2e6, {}, true, true},
        {"gas, packing 0.2", Kind::gas, 1000, 0.20, 2.5e6, {}, true, false},
        {"gas, packing 0.2", Kind::gas, 100000, 0.20, {}, {}, true, true},
        {"gas, packing 0.01", Kind::gas, 1000, 0.01, {}, {}, true, false},
        {"large dish, mu = 1", Kind::large_dish, 100000, paper_packing, 1.5e6, {}, false, false},
        {spheres, Kind::spheres, 48, spheres_packing, 1.5e6, 10.0, true, false},
        {spheres, Kind::spheres, 500, spheres_packing, {}, {}, true, false},
        {spheres, Kind::spheres, 100000, spheres_packing, {}, {}, false, true},
    };
    return all;
}

void check(const std::atomic<bool>* stop) {
    if (stop && stop->load()) throw Interrupted("Stopped before the benchmark was complete.");
}

InitialState state_of(const BenchScene& scene, const std::atomic<bool>* stop) {
    const auto n = static_cast<double>(scene.discs);
    const bool rolls = scene.kind == Kind::spheres;
    const double mu = scene.kind == Kind::gas ? 0.0 : rolls ? experiment_friction : 1.0;
    InitialState initial{{}, {}, 0.0, {mu}, {mu}};
    initial.path = scene.kind == Kind::gas
                       ? still_path(10.0)
                       : polygon_path(paper_amplitude, paper_period, paper_sides);
    if (rolls) {
        initial.path = polygon_path(experiment_amplitude, experiment_period, paper_sides);
        for (Surface* surface : {&initial.disc_surface, &initial.wall_surface})
            *surface = {mu, experiment_restitution, 0.0, RunConfig{}.contact_duration};
        initial.shape = Shape::sphere;
        initial.floor.deceleration = experiment_floor_friction * experiment_gravity;
    }
    initial.container_radius =
        scene.kind == Kind::dish ? paper_container_radius : square_root(n / scene.packing);
    const std::vector<double> radii(static_cast<std::size_t>(scene.discs), 1.0);
    const auto centres =
        place_discs(radii, initial.container_radius, 1, stopped_by(stop).is_stopped);
    check(stop);
    if (!centres) throw Failure("The discs of a benchmark did not fit into their dish.");
    Random random(2);
    const Leg& leg = initial.path.legs.front();
    const double speed = scene.kind == Kind::gas ? 1.0 : 0.1;
    for (const Vec2& centre : *centres)
        initial.discs.push_back({leg.start + centre, leg.velocity + random.in_disc(speed), 0.0, 0.0,
                                 0.0, 1.0, 1.0,
                                 rolls ? solid_sphere_inertia(1.0, 1.0) : paper_inertia});
    return initial;
}

/// How many events until the start is forgotten: ten collisions a disc, or a few swirls.
std::uint64_t settling(const BenchScene& scene) {
    if (scene.kind == Kind::dish) return scene.discs < 10 ? 5000 : 100000;
    if (scene.kind == Kind::spheres)
        return static_cast<std::uint64_t>((scene.discs > 1000 ? 20 : 1000) * scene.discs);
    return static_cast<std::uint64_t>(5 * scene.discs);
}

/// Counts per second of the processor over at least `seconds` of it.
template <class Run, class Count>
double rate_over(double seconds, const Run& run, const Count& count) {
    const double begin = now();
    const double before = count();
    double elapsed = 0.0;
    do {
        run();
        elapsed = now() - begin;
    } while (elapsed < seconds);
    return (count() - before) / elapsed;
}

/// A rival: the plain loop with vectors of one width, or lists.
struct PlainRunner {
    std::string name;  // of the width, or "lists"
    std::function<Event()> step;
    bool collisions_only;
    int batch;  // events between two looks at the clock
    double events = 0.0;
    std::vector<double> rates = {};

    void take_a_turn(double seconds) {
        const auto run = [this] {
            for (int k = 0; k < batch; ++k) {
                const bool vertex = step().kind == EventKind::path_vertex;
                events += vertex && collisions_only ? 0.0 : 1.0;
            }
        };
        rates.push_back(rate_over(seconds, run, [this] { return events; }));
    }
};

/// Of the rival's lists, in diameters: so many discs on each as it is fastest with, of 2 to 24
/// tried; some 2 in a thin gas and 8 in a dense one.
double best_reach(double packing) {
    const double listed = 2.0 + 8.0 * packing;
    return std::max(1.2, square_root(listed / (4.0 * packing)));
}

/// With every width that the processor has, from the engine's state. The plain loop has no way to
/// save and resume, so it starts from the discs of the moment, at the beginning of a swirl, where
/// everybody's clock stands at 0.
std::vector<PlainRunner> plain_runners(const InitialState& initial, Simulation& engine,
                                       const BenchScene& scene) {
    Event last = engine.step();
    while (last.kind != EventKind::path_vertex || engine.progress().leg != 0) last = engine.step();
    InitialState settled = initial;
    for (std::size_t i = 0; i < settled.discs.size(); ++i) settled.discs[i] = engine.disc(i);
    if (scene.kind == Kind::gas)
        return {{"lists",
                 [lists = PlainLists(settled, best_reach(scene.packing))]() mutable {
                     return lists.step();
                 },
                 true, 500}};
    const int batch = scene.discs > 100 ? 1 : 500;
    if (scene.kind == Kind::spheres)
        return {{"scalar", [loop = Reference(settled)]() mutable { return loop.step(); }, false,
                 batch}};
    std::vector<PlainRunner> runners;
    for (const auto& [name, width] :
         {std::pair{"baseline", Width::baseline}, {"avx2", Width::avx2}, {"avx512", Width::avx512}})
        if (has_width(width))
            runners.push_back({name,
                               [loop = PlainLoop(settled, width)]() mutable { return loop.step(); },
                               false, batch});
    return runners;
}

/// The time of the corners of one swirl, against that of the swirl. A whole one, as the last
/// corner, after which all clocks restart, takes as long as all others together, and the discs do
/// not collide equally often all the way round.
double vertex_share(Simulation& engine, const ContainerPath& path, const BenchSettings& settings) {
    double at_vertices = 0.0;
    const double begin = now();
    for (std::size_t vertex = 0; vertex < path.legs.size(); ++vertex) {
        check(settings.stop);
        const double end = path.leg_at(engine.clock()).end;
        engine.advance_to(engine.swirls(), std::nextafter(end, 0.0));
        const double start = now();
        engine.step();
        at_vertices += now() - start;
    }
    return at_vertices / (now() - begin);
}

BenchRow bench_row(const BenchScene& scene, Width width, const BenchSettings& settings) {
    const InitialState initial = state_of(scene, settings.stop);
    Tuning tuning = stopped_by(settings.stop);
    tuning.width = width;
    Simulation engine(initial, {}, tuning);
    constexpr std::uint64_t at_once = 100'000;
    for (std::uint64_t done = 0, all = settling(scene); done < all; done += at_once) {
        check(settings.stop);
        engine.run(std::min(at_once, all - done));
    }
    const bool collisions_only = scene.kind == Kind::gas;
    const auto counted = [&] {
        const EventCounts e = engine.events();
        return static_cast<double>(collisions_only ? e.disc_disc + e.disc_wall : e.total());
    };

    std::vector<PlainRunner> plain;
    if (scene.plain) plain = plain_runners(initial, engine, scene);

    const EventCounts before = engine.events();
    const LoopCounts loop_before = engine.loop_counts();
    constexpr int turns = 7;
    std::vector<double> rates;
    for (int turn = 0; turn < turns; ++turn) {
        check(settings.stop);
        const double seconds = settings.seconds / turns;
        rates.push_back(rate_over(
            seconds, [&] { engine.run(2000); }, counted));
        for (PlainRunner& runner : plain) runner.take_a_turn(seconds);
    }

    const EventCounts after = engine.events();
    const LoopCounts loop = engine.loop_counts();
    const auto events = static_cast<double>(after.total() - before.total());
    BenchRow row{};
    row.scene = scene.name;
    row.discs = scene.discs;
    row.width = loop.width;
    row.counts = collisions_only ? "collisions" : "events";
    row.rate = median(rates);
    row.target = scene.target;
    for (const PlainRunner& runner : plain) {
        const double rate = median(runner.rates);
        if (rate <= row.plain_rate.value_or(0.0)) continue;
        row.plain_rate = rate;
        row.plain_width = runner.name;
        row.ratio_target = scene.ratio_target;
    }
    row.bytes_per_disc = static_cast<double>(loop.bytes) / static_cast<double>(scene.discs);
    row.invalidated = static_cast<double>(loop.invalidated - loop_before.invalidated) / events;
    row.list_rebuilds =
        static_cast<double>(loop.list_rebuilds - loop_before.list_rebuilds) / events;
    row.path_vertices = static_cast<double>(after.path_vertex - before.path_vertex) / events;

    if (scene.kind == Kind::large_dish && settings.full)
        row.vertex_share = vertex_share(engine, initial.path, settings);
    return row;
}

/// What it costs to look after every event at N = 48: time of step, refresh and look, over that of
/// the run alone, less one.
double by_event_cost(const BenchSettings& settings) {
    const InitialState initial = state_of(bench_scenes().front(), settings.stop);
    Simulation alone(initial), watched(initial);
    alone.run(100000);
    watched.run(100000);
    Snapshot snapshot = watched.snapshot();
    ClusterRotation rotation;
    std::vector<double> ratios;
    for (int turn = 0; turn < 9; ++turn) {
        check(settings.stop);
        const auto batches = static_cast<int>(std::max(1.0, 200.0 * settings.seconds));
        const double start = now();
        alone.run(1000 * static_cast<std::uint64_t>(batches));
        const double middle = now();
        for (int k = 0; k < 1000 * batches; ++k) {
            const Event event = watched.step();
            rotation.sample(snapshot);
            watched.refresh(snapshot, event);
            rotation.follow(snapshot, event);
        }
        ratios.push_back((now() - middle) / (middle - start));
    }
    return median(ratios) - 1.0;
}

/// Both settle, then take turns of whole swirls.
CircleRow circle_row(std::int64_t discs, const BenchSettings& settings) {
    const BenchScene scene{
        "",   discs > 100 ? Kind::large_dish : Kind::dish, discs, paper_packing, {}, {}, false,
        false};
    const InitialState on_polygon = state_of(scene, settings.stop);
    InitialState on_circle = on_polygon;
    on_circle.path = circular_path(paper_amplitude, paper_period);
    Simulation polygon(on_polygon), circle(on_circle);
    for (Simulation* dish : {&polygon, &circle}) dish->run(discs < 10 ? 5000 : 200000);
    const int at_once = discs < 10 ? 100 : 1;  // a look at the clock takes time, too
    constexpr int turns = 7;
    const auto time_per_swirl = [&](Simulation& dish) {
        const auto begin = static_cast<double>(dish.swirls());
        const auto swirl = [&] { dish.advance_to(dish.swirls() + at_once, 0.0); };
        const auto done = [&] { return static_cast<double>(dish.swirls()) - begin; };
        swirl();
        return 1.0 / rate_over(settings.seconds / turns, swirl, done);
    };
    std::vector<double> ratios;
    for (int turn = 0; turn < turns; ++turn) {
        check(settings.stop);
        const double reference = time_per_swirl(polygon);
        ratios.push_back(time_per_swirl(circle) / reference);
    }
    return {discs, median(ratios)};
}

std::string processor() {
    std::ifstream info("/proc/cpuinfo");
    for (std::string line; std::getline(info, line);)
        if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
    return "unknown processor";
}

std::string millions(const std::optional<double>& rate) {
    return rate ? fmt::format("{:.3g}", *rate / 1e6) : "-";
}
std::string times(const std::optional<double>& ratio) {
    if (!ratio) return "-";
    return *ratio < 100.0 ? fmt::format("{:.3g}", *ratio) : fmt::format("{:.0f}", *ratio);
}
std::optional<double> ratio(const BenchRow& row) {
    if (!row.plain_rate) return {};
    return row.rate / *row.plain_rate;
}
std::string verdict(const std::optional<double>& found, const std::optional<double>& target) {
    return !found || !target ? "" : *found >= *target ? "met" : "missed";
}
const char* words(BenchTarget::Sense sense) {
    return sense == BenchTarget::Sense::at_least  ? "at least"
           : sense == BenchTarget::Sense::at_most ? "at most"
                                                  : "below";
}

std::string row_line(const BenchRow& row) {
    return fmt::format(
        "{:<19}{:>8}  {:<9}{:>7}{:>8} {:<7}{:>7} {:<9}{:>7}{:>8} {:<7}{:>6.0f}{:>7.3f}{:>8.3f}\n",
        row.scene, row.discs, row.width, millions(row.rate), millions(row.target),
        verdict(row.rate, row.target), millions(row.plain_rate), row.plain_width, times(ratio(row)),
        times(row.ratio_target), verdict(ratio(row), row.ratio_target), row.bytes_per_disc,
        row.invalidated, row.list_rebuilds);
}

std::string target_line(const BenchTarget& target) {
    return fmt::format("{:<62}{:>8} {:<7}{:<9}{:<4}{}\n", target.name,
                       fmt::format("{:.3g}", target.value), target.unit, words(target.sense),
                       fmt::format("{:g}", target.target), target.met() ? "met" : "missed");
}

/// The row of the gas that is as dense and has the same width, with so many discs.
const BenchRow* gas_of(const BenchResult& result, std::int64_t discs, const std::string& width) {
    for (const BenchRow& row : result.rows)
        if (row.scene == dense_gas && row.discs == discs && row.width == width) return &row;
    return nullptr;
}

nlohmann::ordered_json or_null(const std::optional<double>& x) {
    return x ? nlohmann::ordered_json(*x) : nlohmann::ordered_json(nullptr);
}

nlohmann::ordered_json row_json(const BenchRow& row) {
    nlohmann::ordered_json r;
    r["scene"] = row.scene;
    r["discs"] = row.discs;
    r["width"] = row.width;
    r["counts"] = row.counts;
    r["rate"] = row.rate;
    r["target"] = or_null(row.target);
    r["plain_rate"] = or_null(row.plain_rate);
    r["plain_width"] =
        row.plain_rate ? nlohmann::ordered_json(row.plain_width) : nlohmann::ordered_json(nullptr);
    r["ratio"] = or_null(ratio(row));
    r["ratio_target"] = or_null(row.ratio_target);
    r["bytes_per_disc"] = row.bytes_per_disc;
    r["invalidated_per_event"] = row.invalidated;
    r["list_rebuilds_per_event"] = row.list_rebuilds;
    r["path_vertices_per_event"] = row.path_vertices;
    r["vertex_share"] = or_null(row.vertex_share);
    return r;
}

nlohmann::ordered_json target_json(const BenchTarget& target) {
    return {{"name", target.name},     {"value", target.value},
            {"unit", target.unit},     {"must_be", words(target.sense)},
            {"target", target.target}, {"met", target.met()}};
}

}  // namespace

BenchResult bench(const BenchSettings& settings) {
    BenchResult result;
    result.machine = processor();
    std::vector<BenchScene> chosen;
    for (const BenchScene& scene : bench_scenes())
        if (settings.full || !scene.only_full) chosen.push_back(scene);
    constexpr std::int64_t on_circle[] = {5, 28, 48, 500};
    const double pieces =
        static_cast<double>(chosen.size() * settings.widths.size() + std::size(on_circle) + 1);
    double done = 0.0;
    for (const BenchScene& scene : chosen) {
        for (const Width width : settings.widths) {
            check(settings.stop);
            if (settings.progress)
                settings.progress(done / pieces,
                                  fmt::format("{}, N = {}", scene.name, scene.discs));
            result.rows.push_back(bench_row(scene, width, settings));
            done += 1.0;
        }
    }
    for (const std::int64_t discs : on_circle) {
        check(settings.stop);
        if (settings.progress)
            settings.progress(done / pieces, fmt::format("circle, N = {}", discs));
        result.circles.push_back(circle_row(discs, settings));
        done += 1.0;
    }
    if (settings.progress) settings.progress(done / pieces, "averages by event");
    result.by_event_cost = by_event_cost(settings);
    return result;
}

std::vector<BenchTarget> targets_of_rows(const BenchResult& result) {
    using enum BenchTarget::Sense;
    std::vector<BenchTarget> targets;
    for (const BenchRow& row : result.rows) {
        const std::string where = fmt::format("{}, N = {}, {}", row.scene, row.discs, row.width);
        if (row.target)
            targets.push_back({fmt::format("{} per second: {}", row.counts, where), "1/s", row.rate,
                               at_least, *row.target});
        if (row.ratio_target)
            targets.push_back({fmt::format("rate over the plain loop's: {}", where), "",
                               *ratio(row), at_least, *row.ratio_target});
    }
    return targets;
}

std::vector<BenchTarget> targets_beyond_rates(const BenchResult& result) {
    using enum BenchTarget::Sense;
    std::vector<BenchTarget> targets;
    for (const BenchRow& large : result.rows) {
        const BenchRow* const small = gas_of(result, 1000, large.width);
        if (large.scene != dense_gas || large.discs != 1000000 || !small) continue;
        targets.push_back({fmt::format("memory per disc at N = 10^6, {}", large.width), "bytes",
                           large.bytes_per_disc, at_most, 160.0});
        targets.push_back(
            {fmt::format("time per collision at N = 10^6 over that at 10^3, {}", large.width), "",
             small->rate / large.rate, below, 3.0});
    }
    for (const BenchRow& row : result.rows)
        if (row.vertex_share)
            targets.push_back(
                {fmt::format("share of the large dish's time at path vertices, {}", row.width), "%",
                 100.0 * *row.vertex_share, below, 5.0});
    for (const CircleRow& circle : result.circles)
        targets.push_back(
            {fmt::format("time per swirl on the circle over the polygon's, N = {}", circle.discs),
             "", circle.over_polygon, at_most, 1.3});
    targets.push_back({"time added by averages by event at N = 48", "%",
                       100.0 * result.by_event_cost, below, 30.0});
    return targets;
}

std::string bench_report(const BenchResult& result) {
    std::string text = fmt::format(
        "swirl {} on {}\nOne thread, processor time. The rival in the same run: in a dish the "
        "plain loop, "
        "which looks at all\npairs for every event; in a gas lists of neighbours and a calendar of "
        "events, as hard-sphere codes have them.\n\n",
        version(), result.machine);
    text += fmt::format(
        "{:<19}{:>8}  {:<9}{:>7}{:>8} {:<7}{:>7} {:<9}{:>7}{:>8} {:<7}{:>6}{:>7}{:>8}\n", "scene",
        "N", "width", "M/s", "target", "", "rival", "", "ratio", "target", "", "B/disc", "inval.",
        "rebuilt");
    for (const BenchRow& row : result.rows) text += row_line(row);
    text += fmt::format("\n{:<62}{:>8} {:<7}{}\n", "besides rates", "value", "", "target");
    for (const BenchTarget& target : targets_beyond_rates(result)) text += target_line(target);
    text +=
        "\nM/s: million events a second in a dish, million collisions in a gas; rival: its rate, "
        "with the\nvectors that suit it best; ratio: how many times as fast the engine is; "
        "inval.,\nrebuilt: pending events that were invalidated and neighbour lists rebuilt, per "
        "event.\n";
    return text;
}

std::string bench_json(const BenchResult& result, const std::string& command) {
    nlohmann::ordered_json json;
    json["machine"] = result.machine;
    json["version"] = version();
    json["build"] = build_description();
    json["command"] = command;
    json["by_event_cost"] = result.by_event_cost;
    json["targets"] = nlohmann::ordered_json::array();
    for (const auto& targets : {targets_of_rows(result), targets_beyond_rates(result)})
        for (const BenchTarget& target : targets) json["targets"].push_back(target_json(target));
    json["rows"] = nlohmann::ordered_json::array();
    for (const BenchRow& row : result.rows) json["rows"].push_back(row_json(row));
    return json.dump(2) + "\n";
}

std::string bench_csv(const BenchResult& result, const std::string& command) {
    Table table({"machine", "version", "command", "scene", "discs", "width", "counts", "rate",
                 "plain_rate", "plain_width", "bytes_per_disc", "invalidated_per_event",
                 "list_rebuilds_per_event"});
    for (const BenchRow& row : result.rows)
        table.add({result.machine, version(), command, row.scene, row.discs, row.width, row.counts,
                   row.rate, row.plain_rate.value_or(std::nan("")), row.plain_width,
                   row.bytes_per_disc, row.invalidated, row.list_rebuilds});
    return table.csv();
}

}  // namespace swirl
