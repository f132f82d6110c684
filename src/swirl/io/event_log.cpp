#include "swirl/io/event_log.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <concepts>
#include <type_traits>

#include "swirl/io/file_error.hpp"
#include "swirl/io/h5md.hpp"
#include "swirl/io/range_checks.hpp"
#include "swirl/io/recording.hpp"

namespace swirl {
namespace {

using h5md::parameters;

constexpr std::uint64_t events_per_chunk = 16384;
constexpr std::chrono::milliseconds log_flush_interval(1000);

/// Calls visit(stored, name, field) for each column of /events, in a fixed order. The column's type
/// is std::decay_t<decltype(stored)>, and field(event) refers to the value in an Event.
void for_each_column(bool are_spheres, auto&& visit) {
    visit(
        std::int64_t{}, "swirls", [](auto& e) -> auto& { return e.periods; });
    visit(
        double{}, "clock", [](auto& e) -> auto& { return e.clock; });
    visit(
        std::uint8_t{}, "kind", [](auto& e) -> auto& { return e.kind; });
    visit(
        std::uint32_t{}, "i", [](auto& e) -> auto& { return e.i; });
    visit(
        std::uint32_t{}, "j", [](auto& e) -> auto& { return e.j; });
    visit(
        double{}, "normal_x", [](auto& e) -> auto& { return e.normal.x; });
    visit(
        double{}, "normal_y", [](auto& e) -> auto& { return e.normal.y; });
    visit(
        double{}, "normal_impulse", [](auto& e) -> auto& { return e.impulse.normal; });
    visit(
        double{}, "tangential_impulse", [](auto& e) -> auto& { return e.impulse.tangential; });
    visit(
        std::uint8_t{}, "sticks", [](auto& e) -> auto& { return e.impulse.sticks; });
    if (are_spheres)
        visit(
            double{}, "vertical_impulse", [](auto& e) -> auto& { return e.impulse.vertical; });
}

std::vector<Column> open_columns(const Hdf5File& file, bool are_spheres) {
    std::vector<Column> columns;
    for_each_column(are_spheres, [&](auto, const char* name, auto) {
        columns.push_back(file.column(std::string("/events/") + name));
    });
    return columns;
}

void create_columns(Hdf5File& file, bool are_spheres, int compression) {
    file.create_group("/events");
    for_each_column(are_spheres, [&](auto stored, const char* name, auto) {
        file.create_column<decltype(stored)>(std::string("/events/") + name, {}, {events_per_chunk},
                                             compression);
    });
}

std::vector<double> interleaved(const std::vector<double>& x, const std::vector<double>& y) {
    std::vector<double> pairs;
    for (std::size_t i = 0; i < x.size(); ++i) pairs.insert(pairs.end(), {x[i], y[i]});
    return pairs;
}

void write_initial_state(Hdf5File& file, const Snapshot& initial) {
    const std::uint64_t n = initial.size();
    file.create_group("/initial");
    file.write("/initial/position", interleaved(initial.x, initial.y), {n, 2});
    file.write("/initial/velocity", interleaved(initial.vx, initial.vy), {n, 2});
    file.write("/initial/angle", initial.angle, {n});
    file.write("/initial/spin", initial.spin, {n});
    file.write("/initial/radius", initial.radius, {n});
    file.write("/initial/mass", initial.mass, {n});
    file.write("/initial/moment_of_inertia", initial.inertia, {n});
    if (!initial.can_spin.empty()) file.write("/initial/can_spin", initial.can_spin, {n});
    if (initial.are_spheres())
        file.write("/initial/rolling_spin", interleaved(initial.spin_x, initial.spin_y), {n, 2});
}

void write_floor(Hdf5File& file, const MovingFloor& floor) {
    std::vector<double> velocity;
    for (const Vec2& v : floor.velocity) velocity.insert(velocity.end(), {v.x, v.y});
    file.create_group("/floor");
    file.write("/floor/velocity", velocity, {floor.velocity.size(), 2});
    file.set_attribute("/floor", "deceleration", floor.floor.deceleration);
    if (floor.floor.rolling_resistance != 0.0)
        file.set_attribute("/floor", "rolling_resistance", floor.floor.rolling_resistance);
    if (floor.floor.bodies_lie_flat)
        file.set_attribute("/floor", "lie_flat", std::vector<std::int64_t>{1});
}

}  // namespace

MovingFloor moving_floor(const Floor& floor, const ContainerPath& path) {
    MovingFloor moving{floor, {}};
    for (const Segment& segment : path.segments) moving.velocity.push_back(segment.velocity);
    return moving;
}

EventLogWriter::EventLogWriter(const std::filesystem::path& path, Hdf5File file)
    : path_(path),
      file_(std::make_unique<Hdf5File>(std::move(file))),
      last_flush_(std::chrono::steady_clock::now()) {}

EventLogWriter::EventLogWriter(const std::filesystem::path& path, const Snapshot& initial,
                               double period_end, const Provenance& provenance, int compression,
                               const MovingFloor& floor)
    : EventLogWriter(path, Hdf5File(partial_name(path), JournaledFile::Mode::create)) {
    are_spheres_ = initial.are_spheres();
    write_initial_state(*file_, initial);
    create_columns(*file_, are_spheres_, compression);
    if (are_spheres_) write_floor(*file_, floor);
    file_->create_group(parameters);
    h5md::write_format(*file_);
    for (const auto& [name, text] : provenance) file_->write(parameters + "/" + name, text);
    file_->set_attribute(parameters, "period", initial.period);
    file_->set_attribute(parameters, "swirl_end", period_end);
    file_->set_attribute(parameters, "container_radius", initial.container_radius);
    file_->set_attribute(parameters, "complete", std::vector<std::int64_t>{0});
    columns_ = open_columns(*file_, are_spheres_);
    flush();
}

EventLogWriter EventLogWriter::resume(const std::filesystem::path& path, std::uint64_t events,
                                      const std::string& run) {
    EventLogWriter writer(path, reopen_recording(path, run, "/events/clock"));
    writer.file_->set_attribute(parameters, "complete", std::vector<std::int64_t>{0});
    writer.are_spheres_ = writer.file_->has("/floor");
    writer.columns_ = open_columns(*writer.file_, writer.are_spheres_);
    for (Column& column : writer.columns_) {
        require_recorded(partial_name(path), "events", column.rows(), events);
        column.resize(events);
    }
    writer.events_ = events;
    return writer;
}

void EventLogWriter::write_buffer() {
    auto column = columns_.begin();
    for_each_column(are_spheres_, [&](auto stored, const char*, auto field) {
        std::vector<decltype(stored)> values;
        values.reserve(buffer_.size());
        for (const Event& e : buffer_) values.push_back(static_cast<decltype(stored)>(field(e)));
        (column++)->append(values.data(), values.size());
    });
    buffer_.clear();
    if (std::chrono::steady_clock::now() - last_flush_ >= log_flush_interval) flush_file();
}

void EventLogWriter::flush_file() {
    file_->flush();
    last_flush_ = std::chrono::steady_clock::now();
}

void EventLogWriter::flush() {
    write_buffer();
    flush_file();
}

void EventLogWriter::finish() {
    write_buffer();
    file_->set_attribute(parameters, "complete", std::vector<std::int64_t>{1});
    columns_.clear();
    file_->finish(path_);
    file_.reset();
}

bool is_event_log(const std::filesystem::path& path) {
    return Hdf5File(path, JournaledFile::Mode::read).has("/events/clock");
}

EventLogReader::EventLogReader(const std::filesystem::path& path)
    : path_(path), file_(std::make_unique<Hdf5File>(path, JournaledFile::Mode::read)) {
    if (!file_->has("/events/clock") || !file_->has("/initial/position"))
        throw FileError(fmt::format(
            "'{}' is an HDF5 file, but not an event log: it has no /events.", path.string()));
    h5md::require_known_format(*file_, path);
    complete_ = file_->integers_attribute(parameters, "complete").at(0) == 1;
    const bool are_spheres = file_->has("/floor");
    for (const char* of_spheres : {"/events/vertical_impulse", "/initial/rolling_spin"})
        if (file_->has(of_spheres) != are_spheres)
            throw_inconsistent(
                path, fmt::format("only logs of spheres have {} and /floor, and it has one of them",
                                  of_spheres));
    columns_ = open_columns(*file_, are_spheres);
    std::vector<std::uint64_t> lengths;
    for (const Column& column : columns_) {
        if (!column.row_shape().empty())
            throw_inconsistent(path, "each column of /events must have one value per event");
        lengths.push_back(column.rows());
    }
    events_ = common_length(path, complete_, lengths);
    if (are_spheres) read_floor();
    period_ = file_->number_attribute(parameters, "period");
    period_end_ = file_->number_attribute(parameters, "swirl_end");
    container_radius_ = file_->number_attribute(parameters, "container_radius");
    read_initial_state();
}

void EventLogReader::read_floor() {
    const bool has_resistance = file_->has_attribute("/floor", "rolling_resistance");
    floor_.emplace();
    floor_->floor = {
        .deceleration = file_->number_attribute("/floor", "deceleration"),
        .bodies_lie_flat = file_->has_attribute("/floor", "lie_flat"),
        .rolling_resistance =
            has_resistance ? file_->number_attribute("/floor", "rolling_resistance") : 0.0};
    const Column column = file_->column("/floor/velocity");
    if (column.row_shape() != Dimensions{2} || column.rows() == 0)
        throw_inconsistent(path_, "/floor/velocity must have an x and a y for each path segment");
    const auto velocity = column.read<double>();
    for (std::size_t k = 0; k < velocity.size(); k += 2)
        floor_->velocity.push_back({velocity[k], velocity[k + 1]});
}

void EventLogReader::read_initial_state() {
    const auto numbers = [&](const char* name) {
        return file_->column(std::string("/initial/") + name).read<double>();
    };
    const auto position = numbers("position"), velocity = numbers("velocity");
    const auto angle = numbers("angle"), spin = numbers("spin");
    const auto radius = numbers("radius"), mass = numbers("mass");
    const auto inertia = numbers("moment_of_inertia");
    const std::size_t n = angle.size();
    const auto rolling = floor_ ? numbers("rolling_spin") : std::vector<double>(2 * n, 0.0);
    const auto can_spin =
        file_->has("/initial/can_spin") ? numbers("can_spin") : std::vector<double>(n, 1.0);
    if (position.size() != 2 * n || rolling.size() != 2 * n || velocity.size() != 2 * n ||
        spin.size() != n || radius.size() != n || mass.size() != n || inertia.size() != n ||
        can_spin.size() != n)
        throw_inconsistent(path_, "the columns of /initial differ in length");
    Snapshot initial;
    initial.period = period_;
    initial.container_radius = container_radius_;
    floor_ ? initial.resize_for_spheres(n) : initial.resize(n);
    for (std::size_t i = 0; i < n; ++i) {
        initial_.push_back({{position[2 * i], position[2 * i + 1]},
                            {velocity[2 * i], velocity[2 * i + 1]},
                            angle[i],
                            spin[i],
                            0.0,
                            radius[i],
                            mass[i],
                            inertia[i],
                            {rolling[2 * i], rolling[2 * i + 1]},
                            0.0,
                            can_spin[i]});
        initial.set(i, initial_.back());
    }
    require_possible(initial, Spins::known, path_.string());
}

std::string EventLogReader::provenance(const std::string& name) const {
    const std::string path = parameters + "/" + name;
    return file_->has(path) ? file_->read_text(path) : "";
}

std::vector<Event> EventLogReader::read(std::uint64_t first, std::uint64_t count) const {
    std::vector<Event> events;
    const auto require = [&](bool valid, std::size_t k) {
        if (!valid)
            throw FileError(fmt::format("'{}': event {} is damaged.", path_.string(), first + k));
    };
    auto column = columns_.begin();
    for_each_column(floor_.has_value(), [&](auto stored, const char*, auto field) {
        const auto values = (column++)->template read<decltype(stored)>(first, count);
        events.resize(count);
        for (std::size_t k = 0; k < count; ++k) {
            using Field = std::decay_t<decltype(field(events[k]))>;
            if constexpr (std::same_as<Field, bool>) require(values[k] <= 1, k);
            field(events[k]) = static_cast<Field>(values[k]);
        }
    });
    const EventKind last = floor_ ? EventKind::begins_to_roll : EventKind::path_vertex;
    for (std::size_t k = 0; k < count; ++k)
        require(events[k].kind <= last && events[k].i < initial_.size() &&
                    events[k].j < initial_.size(),
                k);
    return events;
}

Replay::Replay(std::vector<Disc> initial, double period_end, std::optional<MovingFloor> floor)
    : discs_(std::move(initial)),
      period_end_(period_end),
      floor_(std::move(floor)),
      motions_(discs_.size()) {
    for (std::size_t i = 0; i < discs_.size(); ++i) update_motion(i);
}

/// Determines how a sphere moves from its stored state.
void Replay::update_motion(std::size_t i) {
    if (floor_) motions_[i] = floor_motion(discs_[i], floor_->floor, floor_->velocity.at(segment_));
}

void Replay::move_to(std::size_t i, double t) {
    discs_[i] = floor_ ? moved_to(discs_[i], motions_[i], t) : discs_[i].at(t);
}

void Replay::pass_vertex(const Event& event) {
    const bool is_period_end = event.clock == period_end_;
    if (floor_) segment_ = is_period_end ? 0 : segment_ + 1;
    if (floor_ && segment_ >= floor_->velocity.size())
        throw FileError(
            "the event log is inconsistent: a period has more path vertices than the floor has "
            "path segments.");
    const bool floor_acts = floor_ && floor_->floor.deceleration != 0.0;
    if (!is_period_end && !floor_acts) return;
    for (std::size_t i = 0; i < discs_.size(); ++i) {
        move_to(i, event.clock);
        if (is_period_end) discs_[i].time = 0.0;
        update_motion(i);
    }
    periods_ += is_period_end ? 1 : 0;
}

void Replay::apply(const Event& event) {
    if (event.kind == EventKind::path_vertex) return pass_vertex(event);
    if (event.kind == EventKind::begins_to_roll) {
        if (!floor_) return;
        discs_.at(event.i) = set_rolling(discs_[event.i], motions_[event.i], floor_->floor,
                                         floor_->velocity.at(segment_));
        return update_motion(event.i);
    }
    const Vec2 tangent{event.normal.y, -event.normal.x};
    const Vec2 kick = event.impulse.normal * event.normal + event.impulse.tangential * tangent;
    const auto push = [&](std::size_t i, double direction) {
        Disc& d = discs_.at(i);
        move_to(i, event.clock);
        const Vec2 change = (1.0 / d.mass) * kick;
        d.velocity = direction < 0.0 ? d.velocity - change : d.velocity + change;
        d.spin = d.spin + d.radius * event.impulse.tangential * d.inverse_inertia();
        d.rolling_spin =
            d.rolling_spin - (d.radius * event.impulse.vertical * (1.0 / d.inertia)) * tangent;
        update_motion(i);
    };
    push(event.i, -1.0);
    if (event.kind == EventKind::disc_disc) push(event.j, 1.0);
}

}  // namespace swirl
