#include "swirl/run/measurements.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "swirl/files/table.hpp"
#include "swirl/measure/angular_profile.hpp"
#include "swirl/measure/collision_rates.hpp"
#include "swirl/measure/density_map.hpp"
#include "swirl/measure/diffusion.hpp"
#include "swirl/measure/energy_budget.hpp"
#include "swirl/measure/flow_map.hpp"
#include "swirl/measure/granular_temperature.hpp"
#include "swirl/measure/hexatic_order.hpp"
#include "swirl/measure/local_packing.hpp"
#include "swirl/measure/m_frame.hpp"
#include "swirl/measure/radial_density.hpp"
#include "swirl/measure/slip.hpp"
#include "swirl/measure/spin_frustration.hpp"
#include "swirl/measure/wall_stress.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/json.hpp"

namespace swirl {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

constexpr double degrees = 180.0 / pi;

/// Looks by event at every 32nd event: that changes the error, hardly, and not the mean.
constexpr int events_per_sample = 32;

/// Cells are found at every hundredth look: they cost as much as twenty others, and the structure
/// changes slowly. 100 and 511 have no common divisor, so every phase of the swirl is met.
constexpr int samples_per_structure = 100;

/// Displacements within a swirl are taken at every seventh look, 73 times per swirl.
constexpr int samples_per_position = 7;

/// Columns that grow together.
class Columns {
  public:
    explicit Columns(std::vector<std::string> names)
        : names_(std::move(names)), json_(Json::object()) {
        for (const std::string& name : names_) json_[name] = Json::array();
    }
    void add(const std::vector<double>& row) {
        for (std::size_t k = 0; k < names_.size(); ++k) json_[names_[k]].push_back(row[k]);
    }
    const Json& json() const { return json_; }

  private:
    std::vector<std::string> names_;
    Json json_;
};

/// What looks at an MFrameView, closes blocks, and becomes JSON by a function of its own.
template <class Observer, Json (*to_json)(const Observer&)>
class OfTheView : public Kept<OfTheView<Observer, to_json>> {
  public:
    explicit OfTheView(Observer observer = Observer()) : observer_(std::move(observer)) {}
    void sample(const Look& look) override { observer_.sample(look.view); }
    void close_block() override { observer_.close_block(); }
    Json result() const override { return to_json(observer_); }
    template <class Visitor>
    void fields(Visitor&& visit) {
        visit(observer_);
    }

  private:
    Observer observer_;
};

// --- density --------------------------------------------------------------------------------

/// Both averages of one map: by time, and by event as in the paper.
class Density : public Kept<Density> {
  public:
    explicit Density(double container_radius)
        : by_time_(container_radius), by_event_(container_radius) {}
    void sample(const Look& look) override { by_time_.sample(look.view); }
    void after_event(const Snapshot& lab, const Event&) override {
        if (++events_ % events_per_sample != 0) return;
        view_.update(lab);
        by_event_.sample(view_);
    }
    void close_block() override {
        by_time_.close_block();
        by_event_.close_block();
    }
    Json result() const override {
        Columns table({"x", "y", "by_time", "by_time_error", "by_event", "by_event_error"});
        for (std::size_t c = 0; c < by_time_.grid().cells(); ++c) {
            const Vec2 p = by_time_.grid().centre_of(c);
            const Estimate time = by_time_.density(c), event = by_event_.density(c);
            table.add({p.x, p.y, time.mean, time.error, event.mean, event.error});
        }
        return table.json();
    }
    template <class Visitor>
    void fields(Visitor&& visit) {
        visit(by_time_, by_event_, events_);
    }

  private:
    DensityMap by_time_, by_event_;
    MFrameView view_;
    std::uint64_t events_ = 0;
};

Json flow_json(const FlowMap& map) {
    Columns table({"x", "y", "visits", "u_x", "u_x_error", "u_y", "u_y_error"});
    for (std::size_t c = 0; c < map.grid().cells(); ++c) {
        const Vec2 p = map.grid().centre_of(c);
        const Estimate x = map.flow_x(c), y = map.flow_y(c);
        table.add({p.x, p.y, map.visits(c), x.mean, x.error, y.mean, y.error});
    }
    return table.json();
}

Json profile_json(const AngularProfile& profile) {
    Columns table(
        {"theta", "visits", "varpi_m", "varpi_m_error", "wall", "normalised", "normalised_error"});
    for (std::size_t s = 0; s < profile.slices(); ++s) {
        const Estimate plain = profile.plain(s), normalised = profile.normalised(s);
        table.add({profile.theta(s) * degrees, profile.visits(s), plain.mean, plain.error,
                   profile.wall(s).mean, normalised.mean, normalised.error});
    }
    return table.json();
}

Json radial_json(const RadialDensity& density) {
    Columns table({"inner_radius", "outer_radius", "density", "density_error"});
    for (std::size_t r = 0; r < density.rings(); ++r) {
        const Estimate e = density.density(r);
        table.add({density.inner_radius(r), density.outer_radius(r), e.mean, e.error});
    }
    return table.json();
}

Json temperature_json(const GranularTemperature& temperature) {
    return {{"granular", estimate_json(temperature.granular())},
            {"of_the_spin", estimate_json(temperature.of_the_spin())}};
}

// --- pinned and loose -----------------------------------------------------------------------

Json angle_json(const CircularMean& mean) {
    Json json = estimate_json(scaled(mean.angle(), degrees));
    json["concentration"] = mean.concentration();
    json["count"] = mean.count();
    return json;
}

/// By the paper's two criteria on trajectories, and from the collisions themselves.
class Pinned : public Kept<Pinned> {
  public:
    void share(const PinnedLoose& pinned_loose) override { by_tracks_ = &pinned_loose; }
    void after_event(const Snapshot& lab, const Event& event) override {
        by_collisions_.sample(event, lab);
    }
    void close_block() override { by_collisions_.close_block(); }
    Json result() const override {
        const PinnedLoose& tracks = *by_tracks_;
        return {{"becoming_pinned", angle_json(tracks.becoming_pinned())},
                {"becoming_free", angle_json(tracks.becoming_free())},
                {"becoming_pinned_by_collisions", angle_json(by_collisions_.becoming_pinned())},
                {"becoming_free_by_collisions", angle_json(by_collisions_.becoming_free())},
                {"share", estimate_json(tracks.share())}};
    }
    template <class Visitor>
    void fields(Visitor&& visit) {
        visit(by_collisions_);
    }

  private:
    const PinnedLoose* by_tracks_ = nullptr;  // shared by all that need it
    PinnedByCollisions by_collisions_;
};

class OfSlip : public Kept<OfSlip> {
  public:
    void sample(const Look& look) override {
        if (look.earlier) slip_.sample(*look.earlier, look.pinned_loose.pinned());
    }
    void close_block() override { slip_.close_block(); }
    Json result() const override {
        return {{"cluster", estimate_json(slip_.cluster())},
                {"pinned_region", estimate_json(slip_.pinned_region())},
                {"cluster_perimeter", estimate_json(slip_.cluster_perimeter())},
                {"pancake", estimate_json(slip_.pancake())}};
    }
    template <class Visitor>
    void fields(Visitor&& visit) {
        visit(slip_);
    }

  private:
    Slip slip_;
};

class OfFrustration : public Kept<OfFrustration> {
  public:
    void sample(const Look& look) override {
        if (look.earlier) spins_.sample(*look.earlier, look.pinned_loose.pinned());
    }
    void after_event(const Snapshot&, const Event& event) override { spins_.sample(event); }
    void close_block() override { spins_.close_block(); }
    Json result() const override {
        return {{"wall_spin", estimate_json(spins_.wall_spin())},
                {"pinned_wall_spin", estimate_json(spins_.pinned_wall_spin())},
                {"spin_correlation", estimate_json(spins_.correlation())},
                {"triangles", estimate_json(spins_.triangles())},
                {"coordination", estimate_json(spins_.coordination())},
                {"disc_sticking", estimate_json(spins_.disc_sticking())},
                {"wall_sticking", estimate_json(spins_.wall_sticking())}};
    }
    template <class Visitor>
    void fields(Visitor&& visit) {
        visit(spins_);
    }

  private:
    SpinFrustration spins_;
};

// --- order and packing ----------------------------------------------------------------------

/// HexaticOrder or LocalPacking.
template <class Observer>
class OfTheCells : public Kept<OfTheCells<Observer>> {
  public:
    void sample(const Look& look) override {
        if (look.cells) observer_.sample(*look.structure, *look.cells, look.pinned);
    }
    void close_block() override { observer_.close_block(); }
    Json result() const override {
        return {{"all", estimate_json(observer_.all())},
                {"pinned", estimate_json(observer_.pinned())}};
    }
    template <class Visitor>
    void fields(Visitor&& visit) {
        visit(observer_);
    }

  private:
    Observer observer_;
};

// --- collision by collision -----------------------------------------------------------------

/// Without events there is nothing to be known, not even that nothing happened.
class OfCollisions : public Kept<OfCollisions> {
  public:
    explicit OfCollisions(const RunConfig& config) : period_(config.period) {}
    void after_event(const Snapshot& lab, const Event& event) override {
        rates_.sample(event);
        discs_ = lab.size();
    }
    void close_block() override {
        if (discs_ > 0) rates_.close_block(period_, discs_);
    }
    Json result() const override {
        return {{"disc_disc_rate", estimate_json(rates_.disc_disc())},
                {"disc_wall_rate", estimate_json(rates_.disc_wall())},
                {"mean_free_time", estimate_json(rates_.mean_free_time())}};
    }
    template <class Visitor>
    void fields(Visitor&& visit) {
        visit(rates_);
        visit(discs_);
    }

  private:
    double period_;
    CollisionRates rates_;
    std::size_t discs_ = 0;
};

class OfTheWall : public Kept<OfTheWall> {
  public:
    explicit OfTheWall(const RunConfig& config)
        : period_(config.period), stress_(config.container_radius) {}
    void after_event(const Snapshot& lab, const Event& event) override {
        stress_.sample(event, lab);
        seen_ = true;
    }
    void close_block() override {
        if (seen_) stress_.close_block(period_);
    }
    Json result() const override {
        Columns table({"theta", "pressure", "pressure_error", "traction", "traction_error"});
        for (std::size_t s = 0; s < stress_.slices(); ++s) {
            const Estimate p = stress_.pressure(s), t = stress_.traction(s);
            table.add({stress_.theta(s) * degrees, p.mean, p.error, t.mean, t.error});
        }
        return {{"pressure", estimate_json(stress_.mean_pressure())},
                {"traction", estimate_json(stress_.mean_traction())},
                {"profile", table.json()}};
    }
    template <class Visitor>
    void fields(Visitor&& visit) {
        visit(stress_);
        visit(seen_);
    }

  private:
    double period_;
    WallStress stress_;
    bool seen_ = false;
};

/// Besides the powers, how well the budget closes: the change of the kinetic energy that the
/// snapshots show between the first event of a swirl and that of the next, against the change that
/// the collisions account for.
class OfTheEnergy : public Kept<OfTheEnergy> {
  public:
    explicit OfTheEnergy(const RunConfig& config) : period_(config.period) {}
    void after_event(const Snapshot& lab, const Event& event) override {
        budget_.sample(event, lab);
        if (compared_) return;
        compared_ = true;
        const double difference = kinetic_energy(lab) - budget_.accounted();
        if (!begun_) beginning_ = difference;
        begun_ = true;
        worst_ = std::fmax(worst_, std::fabs(difference - beginning_));
    }
    void close_block() override {
        compared_ = false;
        if (begun_) budget_.close_block(period_);
    }
    Json result() const override {
        const double turned_over =
            std::fmax(std::fabs(budget_.total_work()), std::fabs(budget_.total_loss()));
        return {{"wall_power", estimate_json(budget_.wall_power())},
                {"disc_friction_power", estimate_json(budget_.disc_friction_power())},
                {"wall_friction_power", estimate_json(budget_.wall_friction_power())},
                {"inelastic_power", estimate_json(budget_.inelastic_power())},
                {"unaccounted_share", begun_ ? worst_ / turned_over : not_known}};
    }
    template <class Visitor>
    void fields(Visitor&& visit) {
        visit(budget_);
        for (bool* flag : {&begun_, &compared_}) visit(*flag);
        for (double* value : {&beginning_, &worst_}) visit(*value);
    }

  private:
    double period_;
    EnergyBudget budget_;
    bool begun_ = false, compared_ = false;
    double beginning_ = 0.0, worst_ = 0.0;
};

// --- diffusion ------------------------------------------------------------------------------

/// Lags below a swirl, and lags of whole swirls.
class OfDiffusion : public Kept<OfDiffusion> {
  public:
    void sample(const Look& look) override {
        if (samples_++ % samples_per_position == 0) within_.sample(look.lab);
        if (at_beginning_) across_.sample(look.lab);
        at_beginning_ = false;
    }
    void close_block() override {
        within_.close_block();
        across_.close_block();
        at_beginning_ = true;
    }
    Json result() const override {
        Columns table({"lag", "displacement", "displacement_error", "turn", "turn_error",
                       "turn_variance", "turn_variance_error"});
        for (const Diffusion* d : {&within_, &across_})
            for (std::size_t k = 0; k < d->lags(); ++k) {
                const Estimate moved = d->square_displacement(k), turn = d->mean_turn(k),
                               variance = d->turn_variance(k);
                if (moved.blocks == 0 || std::isnan(moved.mean)) continue;
                table.add({d->lag(k), moved.mean, moved.error, turn.mean, turn.error, variance.mean,
                           variance.error});
            }
        return table.json();
    }
    template <class Visitor>
    void fields(Visitor&& visit) {
        visit(samples_);
        visit(at_beginning_);
        visit(within_);
        visit(across_);
    }

  private:
    std::int64_t samples_ = 0;
    bool at_beginning_ = true;
    Diffusion within_{7};  // up to 64 of 73 parts of a swirl
    Diffusion across_{8};  // up to 128 swirls
};

/// The frames of the last moments, so that a disc found pinned can be seen where it was then.
class PinnedWatch {
  public:
    /// Where the next frame goes; then look() at it.
    MFrameView& next() { return recent_[frames_ % recent_.size()]; }
    void sample() { pinned_loose_.sample(recent_[frames_++ % recent_.size()]); }
    void close_block() { pinned_loose_.close_block(); }
    const PinnedLoose& pinned_loose() const { return pinned_loose_; }
    /// The frame that pinned() speaks of.
    const MFrameView* earlier() const {
        if (frames_ < PinnedLoose::width) return nullptr;
        return &recent_[(frames_ - 1 - PinnedLoose::half_width) % recent_.size()];
    }
    template <class Visitor>
    void fields(Visitor&& visit) {
        visit(pinned_loose_, recent_, frames_);
    }

  private:
    PinnedLoose pinned_loose_;
    std::array<MFrameView, PinnedLoose::half_width + 1> recent_;
    std::size_t frames_ = 0;
};

template <class Observer, Json (*to_json)(const Observer&)>
std::unique_ptr<Measurement> seen_in_the_dish(const RunConfig& config) {
    return std::make_unique<OfTheView<Observer, to_json>>(Observer(config.container_radius));
}
template <class Kind>
std::unique_ptr<Measurement> of_the_dish(const RunConfig& config) {
    return std::make_unique<Kind>(config.container_radius);
}
template <class Kind>
std::unique_ptr<Measurement> of_the_run(const RunConfig& config) {
    return std::make_unique<Kind>(config);
}
template <class Kind>
std::unique_ptr<Measurement> made(const RunConfig&) {
    return std::make_unique<Kind>();
}

const MeasurementKind& kind(std::string_view name) {
    std::string known;
    for (const MeasurementKind& k : measurement_kinds()) {
        if (name == k.name) return k;
        known += fmt::format("{}{}", known.empty() ? "" : ", ", k.name);
    }
    throw WrongCall(
        fmt::format("--measure has '{}' in its list, but each must be one of: {}; or "
                    "the list is 'all'.",
                    name, known));
}

/// NaN, which JSON cannot hold, was written as null.
double number(const Json& json) { return json.is_number() ? json.get<double>() : not_known; }

bool is_table(const Json& json) {
    return json.is_object() && !json.empty() && json.begin()->is_array();
}

}  // namespace

const std::vector<MeasurementKind>& measurement_kinds() {
    static const std::vector<MeasurementKind> all = {
        {.name = "density",
         .description = "density map, 100 × 100, by time and by event (Figs 2, 5c)",
         .make = of_the_dish<Density>},
        {.name = "flow",
         .description = "velocity relative to the container, 20 × 20 (Figs 2, 5d)",
         .make = seen_in_the_dish<FlowMap, flow_json>},
        {.name = "profile",
         .description = "angular velocity about the centre of mass against θ (Fig. 3)",
         .make = made<OfTheView<AngularProfile, profile_json>>},
        {.name = "pinned",
         .description = "where discs become pinned and free, by tracks and by collisions (Fig. 3)",
         .make = made<Pinned>,
         .needs_pinned = true,
         .needs_tracks = true},
        {.name = "slip",
         .description = "slip parameter, perimeter, pancake line (Figs 1b, 4a)",
         .make = made<OfSlip>,
         .needs_pinned = true,
         .needs_tracks = true},
        {.name = "frustration",
         .description = "spins at the wall and of neighbours, sticking contacts (Fig. 4b)",
         .make = made<OfFrustration>,
         .needs_pinned = true,
         .needs_tracks = true},
        {.name = "radial",
         .description = "density against the distance from the container's centre",
         .make = seen_in_the_dish<RadialDensity, radial_json>},
        {.name = "temperature",
         .description = "granular temperature, of the motion and of the spins",
         .make = seen_in_the_dish<GranularTemperature, temperature_json>},
        {.name = "order",
         .description = "hexatic order ψ6 from Voronoi neighbours, of all discs and of the pinned",
         .make = made<OfTheCells<HexaticOrder>>,
         .needs_cells = true},
        {.name = "packing",
         .description = "local packing fraction from Voronoi cells, of all discs and of the pinned",
         .make = made<OfTheCells<LocalPacking>>,
         .needs_cells = true},
        {.name = "collisions",
         .description = "collision rates of a disc, mean free time",
         .make = of_the_run<OfCollisions>,
         .needs_events = true},
        {.name = "wall",
         .description = "pressure on the wall and traction along it against θ",
         .make = of_the_run<OfTheWall>,
         .needs_events = true},
        {.name = "diffusion",
         .description = "squared displacement and turn of a disc against the time between",
         .make = made<OfDiffusion>,
         .needs_tracks = true},
        {.name = "energy",
         .description = "energy budget: work of the wall, losses in friction and collisions",
         .make = of_the_run<OfTheEnergy>,
         .needs_events = true},
    };
    return all;
}

std::string measurement_list_text() {
    std::string text;
    for (const MeasurementKind& kind : measurement_kinds())
        text += fmt::format("  {:<14}{}\n", kind.name, kind.description);
    return text;
}

std::vector<std::string> read_measurement_list(std::string_view list) {
    std::vector<std::string> names;
    if (list == "all") {
        for (const MeasurementKind& k : measurement_kinds()) names.push_back(k.name);
        return names;
    }
    while (true) {
        const std::size_t comma = list.find(',');
        const std::string name = kind(list.substr(0, comma)).name;
        if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
        if (comma == list.npos) return names;
        list.remove_prefix(comma + 1);
    }
}

struct RunMeasurements::State {
    std::vector<std::string> names;
    std::vector<std::unique_ptr<Measurement>> measurements;
    bool watches_pinned = false, needs_cells = false, counts = false;
    std::int64_t looks = 0;
    MFrameView view;
    PinnedWatch watch;
    Voronoi cells;

    void sample(const Snapshot& lab) {
        if (!counts) return;
        MFrameView& now = watches_pinned ? watch.next() : view;
        now.update(lab);
        if (watches_pinned) watch.sample();
        Look look{lab, now, watch.pinned_loose(), watch.earlier(), nullptr, nullptr, {}};
        if (needs_cells && ++looks % samples_per_structure == 0) look_at_the_structure(look);
        for (const auto& m : measurements) m->sample(look);
    }
    void look_at_the_structure(Look& look) {
        look.structure = watches_pinned ? look.earlier : &look.view;
        if (!look.structure) return;
        cells.find(*look.structure);
        look.cells = &cells;
        if (watches_pinned) look.pinned = look.pinned_loose.pinned();
    }
    void after_event(const Snapshot& lab, const Event& event) {
        if (!counts) return;
        for (const auto& m : measurements) m->after_event(lab, event);
    }
    void swirl_begins(bool warm) {
        if (counts) {
            watch.close_block();
            for (const auto& m : measurements) m->close_block();
        }
        counts = warm;
    }
    template <class Archive>
    void fields(Archive& archive) {
        archive(counts, looks, watch);
    }
};

RunMeasurements::RunMeasurements(const RunConfig& config, const std::vector<std::string>& names,
                                 bool tracks)
    : state_(std::make_unique<State>()) {
    state_->names = names;
    for (const std::string& name : names) {
        const MeasurementKind& of = kind(name);
        state_->measurements.push_back(of.make(config));
        state_->measurements.back()->share(state_->watch.pinned_loose());
        state_->needs_cells |= of.needs_cells;
        state_->watches_pinned |= tracks && (of.needs_pinned || of.needs_cells);
    }
}
RunMeasurements::~RunMeasurements() = default;

void RunMeasurements::attach_to(RunControl& control) {
    State* const state = state_.get();
    if (state->measurements.empty()) return;
    control.samplers.push_back(
        {samples_per_period, [state](const Snapshot& lab) { state->sample(lab); }});
    const auto after_event = std::move(control.after_event);
    control.after_event = [state, after_event](const Snapshot& lab, const Event& event) {
        state->after_event(lab, event);
        if (after_event) after_event(lab, event);
    };
    const auto swirl_begins = std::move(control.swirl_begins);
    control.swirl_begins = [state, swirl_begins](bool warm) {
        state->swirl_begins(warm);
        if (swirl_begins) swirl_begins(warm);
    };
}

std::vector<Gatherer> RunMeasurements::gatherers() {
    State* const state = state_.get();
    if (state->measurements.empty()) return {};
    return {{fmt::format("{}", fmt::join(state->names, ",")),
             [state](StateWriter& to) {
                 state->fields(to);
                 for (const auto& m : state->measurements) m->keep(to);
             },
             [state](StateReader& from) {
                 state->fields(from);
                 for (const auto& m : state->measurements) m->resume(from);
             }}};
}

Json RunMeasurements::results() const {
    Json results = Json::object();
    for (std::size_t k = 0; k < state_->names.size(); ++k)
        results[state_->names[k]] = state_->measurements[k]->result();
    return results;
}

MeasuredRun measured_run(const RunConfig& config, const std::vector<std::string>& names,
                         const RunControl& control) {
    RunMeasurements measurements(config, names);
    RunControl inner = control;
    measurements.attach_to(inner);
    RunResult result = run(config, inner);
    return {std::move(result), measurements.results()};
}

std::vector<std::pair<std::string, Estimate>> measured_numbers(const Json& measured) {
    std::vector<std::pair<std::string, Estimate>> numbers;
    for (const auto& [name, result] : measured.items()) {
        if (is_table(result)) continue;
        for (const auto& [quantity, value] : result.items()) {
            if (is_table(value)) continue;
            Estimate e;
            e.mean = number(value.is_object() ? value.value("mean", Json()) : value);
            if (value.is_object()) {
                e.error = number(value.value("error", Json()));
                e.effective_samples = number(value.value("effective_samples", Json()));
                e.blocks = value.value("blocks", std::size_t{0});
            }
            numbers.emplace_back(name + "." + quantity, e);
        }
    }
    return numbers;
}

std::vector<std::pair<std::string, Json>> measured_tables(const Json& measured) {
    std::vector<std::pair<std::string, Json>> tables;
    for (const auto& [name, result] : measured.items()) {
        if (is_table(result)) {
            tables.emplace_back(name, result);
            continue;
        }
        for (const auto& [quantity, value] : result.items())
            if (is_table(value)) tables.emplace_back(name + "." + quantity, value);
    }
    return tables;
}

std::vector<fs::path> write_measured_tables(const Json& measured, const fs::path& folder) {
    std::vector<fs::path> files;
    for (const auto& [name, columns] : measured_tables(measured)) {
        std::vector<std::string> heads;
        for (const auto& [head, column] : columns.items()) heads.push_back(head);
        Table table(heads);
        for (std::size_t r = 0; r < columns.begin()->size(); ++r) {
            std::vector<Table::Cell> row;
            for (const std::string& head : heads) row.emplace_back(number(columns[head][r]));
            table.add(std::move(row));
        }
        files.push_back(folder / (name + ".csv"));
        table.write(files.back());
    }
    const auto numbers = measured_numbers(measured);
    if (numbers.empty()) return files;
    Table table({"quantity", "mean", "error", "effective_samples", "blocks"});
    for (const auto& [name, e] : numbers)
        table.add(
            {name, e.mean, e.error, e.effective_samples, static_cast<std::int64_t>(e.blocks)});
    files.push_back(folder / "numbers.csv");
    table.write(files.back());
    return files;
}

}  // namespace swirl
