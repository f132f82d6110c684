#include "scene_rates.hpp"

#include <fmt/format.h>
#include <time.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <memory>
#include <set>
#include <string>

#include "baselines/all_pairs.hpp"
#include "baselines/neighbor_lists.hpp"
#include "scenes.hpp"
#include "swirl/run/config.hpp"
#include "swirl/run/core_run.hpp"
#include "swirl/run/failure.hpp"

namespace swirl {
namespace {

using Kind = BenchScene::Kind;

/// Processor time of this thread in seconds. The time of other processes does not count.
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

void check(const std::atomic<bool>* stop) {
    if (stop && stop->load()) throw Interrupted("stopped before the benchmark was complete");
}

constexpr int turns = 7;

/// A program that is timed: the engine or a baseline.
class Contender {
  public:
    virtual ~Contender() = default;

    /// Counts per second of processor time, measured over at least `seconds` of processor time.
    double rate_over(double seconds) {
        double counted = 0.0, elapsed = 0.0;
        do {
            begin_again();
            const double begin = now();
            counted += run();
            elapsed += now() - begin;
        } while (elapsed < seconds);
        return counted / elapsed;
    }
    void run_turn(double seconds) { rates_.push_back(rate_over(seconds)); }
    const std::vector<double>& rates() const { return rates_; }

  protected:
    /// Not timed.
    virtual void begin_again() {}
    /// Executes some events; returns what they count.
    virtual double run() = 0;

  private:
    std::vector<double> rates_;
};

/// Continues without end if `replayed_periods` is 0; otherwise restarts after that many periods.
class Engine : public Contender {
  public:
    Engine(const BenchScene& scene, const InitialState& settled, const Tuning& tuning)
        : collisions_only_(scene.kind == Kind::gas),
          periods_(scene.replayed_periods),
          settled_(settled),
          tuning_(tuning),
          simulation_(settled_, {}, tuning_) {}

    Simulation& simulation() { return simulation_; }

  private:
    double counted() const {
        const EventCounts e = simulation_.events();
        return static_cast<double>(collisions_only_ ? e.disc_disc + e.disc_wall : e.total());
    }
    void begin_again() override {
        if (periods_ > 0) simulation_ = Simulation(settled_, {}, tuning_);
    }
    double run() override {
        const double before = counted();
        if (periods_ > 0)
            simulation_.advance_to(periods_, 0.0);
        else
            simulation_.run(2000);
        return counted() - before;
    }

    bool collisions_only_;
    std::int64_t periods_;
    InitialState settled_;
    Tuning tuning_;
    Simulation simulation_;
};

/// Counts whole periods.
class PeriodCounter : public Contender {
  public:
    explicit PeriodCounter(const InitialState& settled)
        : simulation_(settled), at_once_(settled.discs.size() < 10 ? 100 : 1) {}

  private:
    double run() override {
        simulation_.advance_to(simulation_.periods() + at_once_, 0.0);
        return static_cast<double>(at_once_);
    }

    Simulation simulation_;
    int at_once_;  // periods between two readings of the clock, which cost time too
};

class Baseline : public Contender {
  public:
    explicit Baseline(std::string name) : name_(std::move(name)) {}

    const std::string& name() const { return name_; }

  private:
    std::string name_;
};

template <class Loop>
class BaselineLoop : public Baseline {
  public:
    BaselineLoop(std::string name, const BenchScene& scene, std::function<Loop()> make)
        : Baseline(std::move(name)),
          collisions_only_(scene.kind == Kind::gas),
          periods_(scene.replayed_periods),
          batch_(scene.kind == Kind::spheres && scene.discs > 100 ? 1 : 500),
          make_(std::move(make)),
          loop_(std::make_unique<Loop>(make_())) {}

  private:
    void begin_again() override {
        if (periods_ > 0) loop_ = std::make_unique<Loop>(make_());
    }
    double run() override {
        double counted = 0.0;
        const auto step = [&] {
            const Event event = loop_->step();
            const bool vertex = event.kind == EventKind::path_vertex;
            counted += vertex && collisions_only_ ? 0.0 : 1.0;
            return vertex;
        };
        if (periods_ > 0)
            for (std::size_t left = static_cast<std::size_t>(periods_) * paper_sides; left > 0;)
                left -= step() ? 1 : 0;
        else
            for (int k = 0; k < batch_; ++k) step();
        return counted;
    }

    bool collisions_only_;
    std::int64_t periods_;
    int batch_;  // events between two readings of the clock
    std::function<Loop()> make_;
    std::unique_ptr<Loop> loop_;
};

/// Skin of the baseline's lists in a gas: such that a list has about eight discs, which fill one
/// vector. In a container the discs gather, so a constant is used.
double best_skin(const BenchScene& scene, const InitialState& settled) {
    if (scene.kind == Kind::container) return 0.75;
    double radii = 0.0;
    for (const Disc& disc : settled.discs) radii += disc.radius;
    const auto discs = static_cast<double>(settled.discs.size());
    return std::max(0.2, settled.container_radius * square_root(2.0 / discs) - radii / discs);
}

/// The baseline that is fastest in a trial; null if the scene has none.
std::unique_ptr<Baseline> best_baseline(const BenchScene& scene, const InitialState& settled,
                                        double seconds) {
    std::vector<std::unique_ptr<Baseline>> baselines;
    if (!scene.has_baseline) return nullptr;
    if (scene.kind == Kind::spheres)
        return std::make_unique<BaselineLoop<SphereBaseline>>(
            "loop", scene, [&settled] { return SphereBaseline(settled); });
    baselines.push_back(std::make_unique<BaselineLoop<NeighborListBaseline>>(
        "lists", scene, [settled, skin = best_skin(scene, settled)] {
            return NeighborListBaseline(settled, skin);
        }));
    if (scene.discs > 48) return std::move(baselines.front());
    for (const auto& [name, of_loop] : {std::pair{"loop, baseline", Width::baseline},
                                        {"loop, avx2", Width::avx2},
                                        {"loop, avx512", Width::avx512}})
        if (has_width(of_loop))
            baselines.push_back(std::make_unique<BaselineLoop<AllPairsBaseline>>(
                name, scene,
                [settled, width = of_loop] { return AllPairsBaseline(settled, width); }));
    std::vector<double> rates;
    for (const auto& baseline : baselines) rates.push_back(baseline->rate_over(0.1 * seconds));
    return std::move(baselines[static_cast<std::size_t>(
        std::max_element(rates.begin(), rates.end()) - rates.begin())]);
}

/// Number of events after which a gas or a sphere scene has forgotten its initial state: ten
/// collisions per disc in a gas.
std::uint64_t settling(const BenchScene& scene) {
    if (scene.kind == Kind::gas) return static_cast<std::uint64_t>(5 * scene.discs);
    return static_cast<std::uint64_t>((scene.discs > 1000 ? 20 : 1000) * scene.discs);
}

/// The state at the start of a period, where all clocks are at 0: the baselines cannot resume from
/// another state.
InitialState settled_state(const BenchScene& scene, const BenchSettings& settings) {
    InitialState state = state_of(scene, settings.stop);
    Simulation engine(state, {}, stopped_by(settings.stop));
    constexpr std::uint64_t at_once = 100'000;
    if (scene.kind == Kind::container) {
        while (!engine.advance_to(scene.periods, 0.0, at_once)) check(settings.stop);
    } else {
        const std::uint64_t events = settling(scene);
        for (std::uint64_t done = 0; done < events; done += at_once) {
            check(settings.stop);
            engine.run(std::min(at_once, events - done));
        }
        Event last = engine.step();
        while (last.kind != EventKind::path_vertex || engine.progress().segment != 0)
            last = engine.step();
    }
    for (std::size_t i = 0; i < state.discs.size(); ++i) state.discs[i] = engine.disc(i);
    return state;
}

/// Share of the processor time of one period that path vertices take. A whole period is timed: the
/// last vertex, where all clocks restart, takes as long as all others together, and the collision
/// rate changes along the path.
double vertex_share(Simulation& engine, const ContainerPath& path, const BenchSettings& settings) {
    double at_vertices = 0.0;
    const double begin = now();
    for (std::size_t vertex = 0; vertex < path.segments.size(); ++vertex) {
        check(settings.stop);
        const double end = path.segment_at(engine.clock()).end;
        engine.advance_to(engine.periods(), std::nextafter(end, 0.0));
        const double start = now();
        engine.step();
        at_vertices += now() - start;
    }
    return at_vertices / (now() - begin);
}

/// Another scene of the engine, and how the two are compared.
struct Comparison {
    std::unique_ptr<Contender> other;
    // The scene itself in other units; null: its rate is used.
    std::unique_ptr<Contender> own;
    const char* name = "";
    BenchTarget::Bound bound = BenchTarget::Bound::at_least;

    std::optional<BenchTarget> found(const std::vector<double>& rates,
                                     const std::optional<double>& target) const {
        if (!other) return {};
        std::vector<double> ratios;
        for (std::size_t turn = 0; turn < rates.size(); ++turn)
            ratios.push_back(own ? other->rates()[turn] / own->rates()[turn]
                                 : rates[turn] / other->rates()[turn]);
        return BenchTarget{name, "", median(ratios), bound, target};
    }
};

Comparison comparison(const BenchScene& scene, const InitialState& settled,
                      const BenchSettings& settings, const Tuning& tuning) {
    BenchScene other = bench_scenes().front();
    if (scene.compared_with == ComparedWith::paper_container)
        return {std::make_unique<Engine>(other, settled_state(other, settings), tuning), nullptr,
                "rate / rate at N = 48", BenchTarget::Bound::at_least};
    if (scene.compared_with == ComparedWith::polygon) {
        other = scene;
        other.sides = paper_sides;
        return {std::make_unique<PeriodCounter>(settled_state(other, settings)),
                std::make_unique<PeriodCounter>(settled), "time per period / time on the polygon",
                BenchTarget::Bound::at_most};
    }
    return {};
}

/// Events executed so far, and the counts of the event loop.
struct Counted {
    EventCounts events;
    LoopCounts loop;

    static Counted by(const Simulation& simulation) {
        return {simulation.events(), simulation.loop_counts()};
    }
};
void count(BenchRow& row, const Simulation& simulation, const Counted& before) {
    const Counted after = Counted::by(simulation);
    const auto per_event = [events = after.events.total() - before.events.total()](
                               std::uint64_t then, std::uint64_t now) {
        return static_cast<double>(now - then) / static_cast<double>(events);
    };
    row.width = after.loop.width;
    row.bytes_per_disc = static_cast<double>(after.loop.bytes) / static_cast<double>(row.discs);
    row.invalidated = per_event(before.loop.invalidated, after.loop.invalidated);
    row.list_rebuilds = per_event(before.loop.list_rebuilds, after.loop.list_rebuilds);
    row.path_vertices = per_event(before.events.path_vertex, after.events.path_vertex);
}

BenchRow bench_row(const BenchScene& scene, Width width, const BenchSettings& settings) {
    const InitialState settled = settled_state(scene, settings);
    Tuning tuning = stopped_by(settings.stop);
    tuning.width = width;
    Engine engine(scene, settled, tuning);
    const Comparison compared = comparison(scene, settled, settings, tuning);
    const double seconds = settings.seconds / turns;
    const std::unique_ptr<Baseline> baseline = best_baseline(scene, settled, settings.seconds);

    engine.rate_over(0.0);  // warms up; a replay starts to count here
    const bool goes_on = scene.replayed_periods == 0;
    const Counted before = goes_on ? Counted::by(engine.simulation()) : Counted{};
    for (int turn = 0; turn < turns; ++turn) {
        check(settings.stop);
        engine.run_turn(seconds);
        if (baseline) baseline->run_turn(seconds);
        if (compared.other) compared.other->run_turn(seconds);
        if (compared.own) compared.own->run_turn(seconds);
    }

    BenchRow row{};
    row.scene = scene.name;
    row.discs = scene.discs;
    row.counts = scene.kind == Kind::gas ? "collisions" : "events";
    row.rate = median(engine.rates());
    if (baseline) {
        row.baseline_rate = median(baseline->rates());
        row.baseline = baseline->name();
        row.ratio_target = scene.ratio_target;
    }
    row.comparison = compared.found(engine.rates(), scene.comparison_target);
    count(row, engine.simulation(), before);
    if (scene.kind == Kind::container && scene.discs == 100000)
        row.vertex_share = vertex_share(engine.simulation(), settled.path, settings);
    return row;
}

/// A run with its averages, without an observation.
class WithAverages : public Contender {
  public:
    WithAverages(const InitialState& settled, const Tuning& tuning)
        : run_(config_of(settled), settled, nullptr, {}, tuning) {
        // The first period has a sample after every event (cluster_rotation.hpp).
        while (settled.discs.size() <= 128 && run_.periods() < 1.0) run();
    }

    const Simulation& simulation() const { return run_.simulation(); }

  private:
    static RunConfig config_of(const InitialState& settled) {
        RunConfig config;
        config.discs = static_cast<std::int64_t>(settled.discs.size());
        config.period = settled.path.period;
        config.container_radius = settled.container_radius;
        config.events = std::numeric_limits<std::int64_t>::max();
        config.warmup = 1;
        return config;
    }
    double run() override {
        constexpr std::uint64_t batch = 2000;
        std::uint64_t done = 0;
        while (done < batch) {
            if (run_.is_check_due() && run_.problem()) throw Failure(*run_.problem());
            done += run_.execute_events();
        }
        return static_cast<double>(done);
    }

    CoreRun run_;
};

/// A scene with its averages, compared with the same scene without them.
BenchRow row_with_averages(const BenchScene& scene, Width width, const BenchSettings& settings) {
    const InitialState settled = settled_state(scene, settings);
    Tuning tuning = stopped_by(settings.stop);
    tuning.width = width;
    Engine alone(scene, settled, tuning);
    WithAverages with_averages(settled, tuning);
    std::vector<double> ratios;
    for (int turn = 0; turn < turns; ++turn) {
        check(settings.stop);
        alone.run_turn(settings.seconds / turns);
        with_averages.run_turn(settings.seconds / turns);
        ratios.push_back(alone.rates().back() / with_averages.rates().back());
    }
    BenchRow row{};
    row.scene = scene.name + ", averages";
    row.discs = scene.discs;
    row.counts = "events";
    row.rate = median(with_averages.rates());
    row.comparison = BenchTarget{
        "time / time without averages", "", median(ratios), BenchTarget::Bound::at_most, {}};
    if (scene.discs == 48) row.comparison->target = 1.06;
    if (scene.discs > 48) row.comparison->target = 1.1;
    count(row, with_averages.simulation(), {});
    return row;
}

bool is_measured_with_averages(const BenchScene& scene) {
    const bool is_paper_container =
        scene.name == bench_scenes().front().name && scene.packing == 0.0;
    return is_paper_container || scene.kind == Kind::spheres ||
           (scene.kind == Kind::container && scene.discs >= 2000 && scene.replayed_periods == 0);
}

std::string processor() {
    std::ifstream info("/proc/cpuinfo");
    for (std::string line; std::getline(info, line);)
        if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
    return "unknown processor";
}

/// The row of the dense gas with that number of discs and the same vector width; null if none.
const BenchRow* gas_of(const BenchResult& result, std::int64_t discs, const std::string& width) {
    for (const BenchRow& row : result.rows)
        if (row.scene == dense_gas && row.discs == discs && row.width == width) return &row;
    return nullptr;
}

std::string no_scene(const BenchSettings& settings) {
    std::set<std::string> names;
    for (const BenchScene& scene : bench_scenes())
        if (settings.full || !scene.only_full) names.insert(scene.name);
    return fmt::format("no scene has '{}' in its name\nhint: the scenes are {}", settings.only,
                       fmt::join(names, "; "));
}

std::string where(const BenchRow& row) {
    return fmt::format("{}, N = {}, {}", row.scene, row.discs, row.width);
}

}  // namespace

BenchResult bench(const BenchSettings& settings) {
    BenchResult result;
    result.machine = processor();
    std::vector<BenchScene> chosen;
    for (const BenchScene& scene : bench_scenes())
        if ((settings.full || !scene.only_full) &&
            scene.name.find(settings.only) != std::string::npos)
            chosen.push_back(scene);
    if (chosen.empty()) throw Failure(no_scene(settings));
    std::vector<BenchScene> averaged;
    std::copy_if(chosen.begin(), chosen.end(), std::back_inserter(averaged),
                 is_measured_with_averages);
    const auto pieces =
        static_cast<double>((chosen.size() + averaged.size()) * settings.widths.size());
    const auto report = [&](const std::string& what) {
        check(settings.stop);
        if (settings.progress)
            settings.progress(static_cast<double>(result.rows.size()) / pieces, what);
    };
    for (const BenchScene& scene : chosen)
        for (const Width width : settings.widths) {
            report(fmt::format("{}, N = {}", scene.name, scene.discs));
            result.rows.push_back(bench_row(scene, width, settings));
        }
    for (const BenchScene& scene : averaged)
        for (const Width width : settings.widths) {
            report(fmt::format("{} with averages, N = {}", scene.name, scene.discs));
            result.rows.push_back(row_with_averages(scene, width, settings));
        }
    return result;
}

std::vector<BenchTarget> targets_of_ratios(const BenchResult& result) {
    std::vector<BenchTarget> targets;
    for (const BenchRow& row : result.rows)
        if (row.ratio_target)
            targets.push_back({fmt::format("rate / baseline: {}", where(row)), "", *row.ratio(),
                               BenchTarget::Bound::at_least, *row.ratio_target});
    return targets;
}

std::vector<BenchTarget> targets_beyond_baselines(const BenchResult& result) {
    using enum BenchTarget::Bound;
    std::vector<BenchTarget> targets;
    for (const BenchRow& row : result.rows)
        if (row.comparison) {
            targets.push_back(*row.comparison);
            targets.back().name += ": " + where(row);
        }
    for (const BenchRow& large : result.rows) {
        const BenchRow* const small = gas_of(result, 1000, large.width);
        if (large.scene != dense_gas || large.discs != 1000000 || !small) continue;
        targets.push_back({fmt::format("memory per disc: {}", where(large)), "bytes",
                           large.bytes_per_disc, at_most, 160.0});
        targets.push_back({fmt::format("time per collision / at 10^3: {}", where(large)), "",
                           small->rate / large.rate, below, 3.0});
    }
    for (const BenchRow& row : result.rows)
        if (row.vertex_share)
            targets.push_back({fmt::format("share of time at path vertices: {}", where(row)), "%",
                               100.0 * *row.vertex_share, below, 5.0});
    return targets;
}

}  // namespace swirl
