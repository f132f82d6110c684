// Everything measure/ can say of one run, by name: what `swirl run --measure LIST` prints and what
// the figures of the paper are made of.
//
// A result is JSON of two kinds: numbers, each with its error ({"mean", "error", …}), and tables,
// objects of columns of one length. Frames: M-frame unless a name says otherwise. Units: disc
// radius, container's speed; angular velocities in Ω, angles in degrees.
#pragma once

#include <nlohmann/json.hpp>

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "swirl/files/state_archive.hpp"
#include "swirl/measure/m_frame.hpp"
#include "swirl/measure/pinned_loose.hpp"
#include "swirl/measure/voronoi.hpp"
#include "swirl/run/recorded_run.hpp"
#include "swirl/run/run.hpp"

namespace swirl {

/// Looks per swirl: the paper's camera took 960 frames per second of a table turning at
/// 11.81 rad/s.
inline constexpr int samples_per_period = 511;

/// What a measurement gets to see at a look. Which discs are pinned is known seven frames late
/// (measure/pinned_loose.hpp), so there is a view of that moment beside the one of now.
struct Look {
    const Snapshot& lab;
    const MFrameView& view;
    const PinnedLoose& pinned_loose;
    const MFrameView* earlier;  // seven frames ago; null in the first frames
    /// At every hundredth look: the frame whose discs have these cells, and which of them are
    /// pinned. Null, null, and empty at all others.
    const MFrameView* structure;
    const Voronoi* cells;
    std::span<const std::uint8_t> pinned;
};

/// One measurement while the run goes on. Those that look at a run derive from Kept, below, and say
/// in fields() what they have gathered, so that a run that is resumed has all of it.
class Measurement {
  public:
    virtual ~Measurement() = default;
    /// Called once, before anything else: the observer that all measurements share.
    virtual void share(const PinnedLoose& /*pinned_loose*/) {}
    /// Called at equal time steps, `samples_per_period` per swirl.
    virtual void sample(const Look& /*look*/) {}
    /// Called after every event.
    virtual void after_event(const Snapshot& /*lab*/, const Event& /*event*/) {}
    /// Called at the end of every swirl.
    virtual void close_block() {}
    virtual nlohmann::ordered_json result() const = 0;
    /// Everything gathered, to the last bit, and back.
    virtual void keep(StateWriter& state) = 0;
    virtual void resume(StateReader& state) = 0;
};

/// A measurement that says in one line what it consists of (state_archive.hpp):
///
///     class OfSomething : public Kept<OfSomething> {
///         …
///         template <class Visitor> void fields(Visitor&& visit) { visit(sum_); visit(weight_); }
template <class Kind>
class Kept : public Measurement {
  public:
    void keep(StateWriter& state) final { static_cast<Kind&>(*this).fields(state); }
    void resume(StateReader& state) final { static_cast<Kind&>(*this).fields(state); }
};

struct MeasurementKind {
    const char* name;
    const char* description;  // one line
    std::unique_ptr<Measurement> (*make)(const RunConfig& config);
    bool needs_pinned = false;  // has nothing to say if it is not known who is pinned
    bool needs_tracks = false;  // the same discs in every frame
    bool needs_cells = false;   // Voronoi's
    bool needs_events = false;  // collision by collision: frames are not enough
};

/// In the order of the help text.
const std::vector<MeasurementKind>& measurement_kinds();
/// A line for each.
std::string measurement_list_text();

/// "density,flow" or "all"; throws WrongCall, naming those there are, if one is unknown.
std::vector<std::string> read_measurement_list(std::string_view list);

/// The measurements of one run. They look after the warm-up, and change nothing.
class RunMeasurements {
  public:
    /// The names are those of read_measurement_list(). Without tracks nobody watches which discs
    /// are pinned.
    RunMeasurements(const RunConfig& config, const std::vector<std::string>& names,
                    bool tracks = true);
    ~RunMeasurements();

    /// Puts them into the control of the run, beside what is there. They must outlive the run.
    void attach_to(RunControl& control);
    /// What a checkpoint of that run keeps of them, for run_recorded(); nothing if there are none.
    std::vector<Gatherer> gatherers();

    /// Name of the measurement: its result.
    nlohmann::ordered_json results() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

struct MeasuredRun {
    RunResult run;
    nlohmann::ordered_json measured;
};

/// run() and RunMeasurements in one.
MeasuredRun measured_run(const RunConfig& config, const std::vector<std::string>& names,
                         const RunControl& control = {});

/// "slip.cluster" and its value, for every number in there.
std::vector<std::pair<std::string, Estimate>> measured_numbers(
    const nlohmann::ordered_json& measured);
/// "density", or "pinned.angles", and its columns, for every table in there.
std::vector<std::pair<std::string, nlohmann::ordered_json>> measured_tables(
    const nlohmann::ordered_json& measured);

/// Writes every table as FOLDER/NAME.csv and all numbers as FOLDER/numbers.csv; returns the files.
std::vector<std::filesystem::path> write_measured_tables(const nlohmann::ordered_json& measured,
                                                         const std::filesystem::path& folder);

}  // namespace swirl
