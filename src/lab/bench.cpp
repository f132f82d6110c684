#include "lab/bench.hpp"

#include <fmt/format.h>
#include <time.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "lab/failure.hpp"
#include "lab/table.hpp"
#include "lab/version.hpp"
#include "measure/cluster_rotation.hpp"
#include "simulation/packing.hpp"
#include "simulation/random.hpp"
#include "simulation/reference_loop.hpp"

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

enum class Kind { dish, gas, large_dish };

struct Plan {
    const char* name;
    Kind kind;
    std::int64_t discs;
    double packing;  // of the gas and the large dish
    std::optional<double> target, ratio_target;
    bool plain;
    bool only_full;
};

// The paper's dish at N = 48: 48 / 8.6².
constexpr double paper_packing = 48.0 / (paper_container_radius * paper_container_radius);

const std::vector<Plan>& plans() {
    static const std::vector<Plan> all = {
        {"dish, mu = 1", Kind::dish, 48, 0, 7e6, 13.0, true, false},
        {"dish, mu = 1", Kind::dish, 28, 0, 8e6, 6.5, true, false},
        {"dish, mu = 1", Kind::dish, 5, 0, 16e6, 2.0, true, false},
        {"gas, packing 0.7", Kind::gas, 1000, 0.70, 6e6, {}, true, false},
        {"gas, packing 0.7", Kind::gas, 10000, 0.70, 5e6, {}, false, false},
        {"gas, packing 0.7", Kind::gas, 100000, 0.70, 3e6, {}, false, false},
        {"gas, packing 0.7", Kind::gas, 1000000, 0.70, 2e6, {}, false, true},
        {"gas, packing 0.2", Kind::gas, 1000, 0.20, 2.5e6, {}, true, false},
        {"large dish, mu = 1", Kind::large_dish, 100000, paper_packing, 1.5e6, {}, false, false},
    };
    return all;
}

Scene scene_of(const Plan& plan) {
    const auto n = static_cast<double>(plan.discs);
    const double mu = plan.kind == Kind::gas ? 0.0 : 1.0;
    Scene scene{{}, {}, 0.0, {mu}, {mu}};
    scene.path = plan.kind == Kind::gas ? still_path(10.0)
                                        : polygon_path(paper_amplitude, paper_period, paper_sides);
    scene.container_radius =
        plan.kind == Kind::dish ? paper_container_radius : square_root(n / plan.packing);
    const std::vector<double> radii(static_cast<std::size_t>(plan.discs), 1.0);
    const auto centres = place_discs(radii, scene.container_radius, 1);
    if (!centres) throw Failure("The discs of a benchmark did not fit into their dish.");
    Random random(2);
    const Leg& leg = scene.path.legs.front();
    const double speed = plan.kind == Kind::gas ? 1.0 : 0.1;
    for (const Vec2& centre : *centres)
        scene.discs.push_back({leg.start + centre, leg.velocity + random.in_disc(speed), 0.0, 0.0,
                               0.0, 1.0, 1.0, paper_inertia});
    return scene;
}

/// How many events until the start is forgotten: ten collisions a disc, or a few swirls.
std::uint64_t settling(const Plan& plan) {
    if (plan.kind == Kind::dish) return plan.discs < 10 ? 5000 : 100000;
    return static_cast<std::uint64_t>(5 * plan.discs);
}

void check(const std::atomic<bool>* stop) {
    if (stop && stop->load()) throw Interrupted("Stopped before the benchmark was complete.");
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

/// A pass over the scene, with as many events as come in about a millisecond at least.
BenchRow bench_row(const Plan& plan, Width width, const BenchSettings& settings) {
    const Scene scene = scene_of(plan);
    Simulation engine(scene, {}, {0, width});
    engine.run(settling(plan));
    const bool collisions_only = plan.kind == Kind::gas;
    const auto counted = [&] {
        const EventCounts e = engine.events();
        return static_cast<double>(collisions_only ? e.disc_disc + e.disc_wall : e.total());
    };

    std::optional<ReferenceLoop> plain;
    double plain_events = 0.0;
    if (plan.plain) {
        // From the same state: the plain loop has no way to save and resume, so it runs from the
        // discs of the moment, at the beginning of a swirl, where everybody's clock stands at 0.
        Event last = engine.step();
        while (last.kind != EventKind::path_vertex || engine.progress().leg != 0)
            last = engine.step();
        Scene settled = scene;
        for (std::size_t i = 0; i < settled.discs.size(); ++i) settled.discs[i] = engine.disc(i);
        plain.emplace(settled);
    }

    const EventCounts before = engine.events();
    const LoopCounts loop_before = engine.loop_counts();
    constexpr int turns = 7;
    std::vector<double> rates, plain_rates;
    for (int turn = 0; turn < turns; ++turn) {
        check(settings.stop);
        const double seconds = settings.seconds / turns;
        rates.push_back(rate_over(
            seconds, [&] { engine.run(2000); }, counted));
        if (!plain) continue;
        const int batch = plan.discs > 100 ? 1 : 500;
        plain_rates.push_back(rate_over(
            seconds,
            [&] {
                for (int k = 0; k < batch; ++k)
                    plain_events +=
                        plain->step().kind == EventKind::path_vertex && collisions_only ? 0.0 : 1.0;
            },
            [&] { return plain_events; }));
    }

    const EventCounts after = engine.events();
    const LoopCounts loop = engine.loop_counts();
    const auto events = static_cast<double>(after.total() - before.total());
    BenchRow row{};
    row.scene = plan.name;
    row.discs = plan.discs;
    row.width = loop.width;
    row.counts = collisions_only ? "collisions" : "events";
    row.rate = median(rates);
    row.target = plan.target;
    if (plain) {
        row.plain_rate = median(plain_rates);
        row.ratio_target = plan.ratio_target;
    }
    row.bytes_per_disc = static_cast<double>(loop.bytes) / static_cast<double>(plan.discs);
    row.stale = static_cast<double>(loop.stale - loop_before.stale) / events;
    row.relists = static_cast<double>(loop.relists - loop_before.relists) / events;
    row.path_vertices = static_cast<double>(after.path_vertex - before.path_vertex) / events;

    if (plan.kind == Kind::large_dish) {
        // The time at the path vertices of one swirl, against the time of the swirl: from the
        // clock around the first event of each leg, the corner itself.
        const auto legs = static_cast<std::uint64_t>(scene.path.legs.size());
        double at_vertices = 0.0;
        std::uint64_t vertices = 0;
        const double begin = now();
        while (vertices < std::min<std::uint64_t>(legs, 4)) {
            check(settings.stop);
            const double clock = scene.path.leg_at(engine.clock()).end;
            engine.advance_to(engine.swirls(), std::nextafter(clock, 0.0));
            const double start = now();
            engine.step();
            at_vertices += now() - start;
            ++vertices;
        }
        row.vertex_share = at_vertices / (now() - begin);
    }
    return row;
}

/// What it costs to look after every event at N = 48: time of step, refresh and look, over that of
/// the run alone, less one.
double by_event_cost(const BenchSettings& settings) {
    const Scene scene = scene_of(plans().front());
    Simulation alone(scene), watched(scene);
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
            watched.refresh(snapshot, watched.step());
            rotation.look(snapshot);
        }
        ratios.push_back((now() - middle) / (middle - start));
    }
    return median(ratios) - 1.0;
}

std::string processor() {
    std::ifstream info("/proc/cpuinfo");
    for (std::string line; std::getline(info, line);)
        if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
    return "unknown processor";
}

std::string verdict(double found, const std::optional<double>& target) {
    return !target ? "" : found >= *target ? "met" : "missed";
}
std::string millions(const std::optional<double>& rate) {
    return rate ? fmt::format("{:.3g}", *rate / 1e6) : "-";
}

}  // namespace

BenchResult bench(const BenchSettings& settings) {
    BenchResult result;
    result.machine = processor();
    std::vector<Plan> chosen;
    for (const Plan& plan : plans())
        if (settings.full || !plan.only_full) chosen.push_back(plan);
    const double pieces = static_cast<double>(chosen.size() * settings.widths.size() + 1);
    double done = 0.0;
    for (const Plan& plan : chosen) {
        for (const Width width : settings.widths) {
            check(settings.stop);
            if (settings.progress)
                settings.progress(done / pieces, fmt::format("{}, N = {}", plan.name, plan.discs));
            result.rows.push_back(bench_row(plan, width, settings));
            done += 1.0;
        }
    }
    if (settings.progress) settings.progress(done / pieces, "averages by event");
    result.by_event_cost = by_event_cost(settings);
    return result;
}

std::string bench_report(const BenchResult& result) {
    std::string text = fmt::format(
        "swirl {} on {}\nOne thread, processor time; the plain loop looks at all pairs "
        "for every event.\n\n",
        version(), result.machine);
    text += fmt::format("{:<19}{:>8}  {:<9}{:>7}{:>8} {:<7}{:>9}{:>8}{:>8} {:<7}{:>7}{:>7}{:>7}\n",
                        "scene", "N", "width", "M/s", "target", "", "plain", "ratio", "target", "",
                        "B/disc", "stale", "relist");
    for (const BenchRow& row : result.rows) {
        std::optional<double> ratio;
        if (row.plain_rate) ratio = row.rate / *row.plain_rate;
        const auto times = [](const std::optional<double>& x) {
            return x ? fmt::format("{:.{}f}", *x, *x < 100.0 ? 1 : 0) : "-";
        };
        text += fmt::format(
            "{:<19}{:>8}  {:<9}{:>7}{:>8} {:<7}{:>9}{:>8}{:>8} {:<7}{:>7.0f}{:>7.3f}{:>7.3f}\n",
            row.scene, row.discs, row.width, millions(row.rate), millions(row.target),
            verdict(row.rate, row.target), millions(row.plain_rate), times(ratio),
            times(row.ratio_target), verdict(ratio.value_or(0.0), row.ratio_target),
            row.bytes_per_disc, row.stale, row.relists);
        if (row.vertex_share)
            text += fmt::format("    of its time at path vertices: {:.2f} % (target below 5 %)\n",
                                100.0 * *row.vertex_share);
    }
    text += fmt::format("\nAverages by event at N = 48 add {:.0f} % (target below 30 %).\n",
                        100.0 * result.by_event_cost);
    text +=
        "M/s: million events a second in a dish, million collisions in a gas; plain: the plain "
        "loop's; "
        "stale,\nrelist: predictions made again and neighbour lists renewed, per event.\n";
    return text;
}

std::string bench_json(const BenchResult& result, const std::string& command) {
    const auto or_null = [](const std::optional<double>& x) {
        return x ? nlohmann::ordered_json(*x) : nlohmann::ordered_json(nullptr);
    };
    nlohmann::ordered_json json;
    json["machine"] = result.machine;
    json["version"] = version();
    json["build"] = build_description();
    json["command"] = command;
    json["by_event_cost"] = result.by_event_cost;
    json["rows"] = nlohmann::ordered_json::array();
    for (const BenchRow& row : result.rows) {
        nlohmann::ordered_json r;
        r["scene"] = row.scene;
        r["discs"] = row.discs;
        r["width"] = row.width;
        r["counts"] = row.counts;
        r["rate"] = row.rate;
        r["target"] = or_null(row.target);
        r["plain_rate"] = or_null(row.plain_rate);
        r["ratio"] = row.plain_rate ? nlohmann::ordered_json(row.rate / *row.plain_rate)
                                    : nlohmann::ordered_json(nullptr);
        r["ratio_target"] = or_null(row.ratio_target);
        r["bytes_per_disc"] = row.bytes_per_disc;
        r["stale_per_event"] = row.stale;
        r["relists_per_event"] = row.relists;
        r["path_vertices_per_event"] = row.path_vertices;
        r["vertex_share"] = or_null(row.vertex_share);
        json["rows"].push_back(std::move(r));
    }
    return json.dump(2) + "\n";
}

std::string bench_csv(const BenchResult& result, const std::string& command) {
    Table table({"machine", "version", "command", "scene", "discs", "width", "counts", "rate",
                 "plain_rate", "bytes_per_disc", "stale_per_event", "relists_per_event"});
    for (const BenchRow& row : result.rows)
        table.add({result.machine, version(), command, row.scene, row.discs, row.width, row.counts,
                   row.rate, row.plain_rate.value_or(std::nan("")), row.bytes_per_disc, row.stale,
                   row.relists});
    return table.csv();
}

}  // namespace swirl
