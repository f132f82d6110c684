#include "swirl/io/event_log.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "swirl/io/file_error.hpp"
#include "swirl/io/h5md.hpp"
#include "swirl/io/range_checks.hpp"
#include "swirl/io/recording.hpp"

namespace swirl {
namespace {

constexpr std::uint64_t chunk = 16384;
constexpr std::chrono::milliseconds events_wait(1000);
using h5md::parameters;

std::vector<double> pairs(const std::vector<double>& x, const std::vector<double>& y) {
    std::vector<double> both;
    for (std::size_t i = 0; i < x.size(); ++i) both.insert(both.end(), {x[i], y[i]});
    return both;
}

template <class T, class Field>
void append(Column& column, const std::vector<Event>& events, Field&& field) {
    std::vector<T> values;
    values.reserve(events.size());
    for (const Event& e : events) values.push_back(static_cast<T>(field(e)));
    column.append(values.data(), values.size());
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
                               double swirl_end, const Provenance& provenance, int compression,
                               const MovingFloor& floor)
    : EventLogWriter(path, Hdf5File(partial_name(path), JournaledFile::Mode::create)) {
    Hdf5File& file = *file_;
    const std::uint64_t n = initial.size();
    file.create_group("/initial");
    file.write("/initial/position", pairs(initial.x, initial.y), {n, 2});
    file.write("/initial/velocity", pairs(initial.vx, initial.vy), {n, 2});
    file.write("/initial/angle", initial.angle, {n});
    file.write("/initial/spin", initial.spin, {n});
    file.write("/initial/radius", initial.radius, {n});
    file.write("/initial/mass", initial.mass, {n});
    file.write("/initial/moment_of_inertia", initial.inertia, {n});
    file.create_group("/events");
    const Packing packing = compression == 0 ? Packing::none : Packing::deflate;
    // Quick: hardly a bit of a normal or an impulse can be foreseen.
    const Packing of_numbers = compression > 0 ? Packing::deflate : Packing::none;
    const int level = std::max(compression, 1);
    file.create_column<std::int64_t>("/events/swirls", {}, {chunk}, packing, level);
    for (const char* name :
         {"clock", "normal_x", "normal_y", "normal_impulse", "tangential_impulse"})
        file.create_column<double>(std::string("/events/") + name, {}, {chunk}, of_numbers, level);
    for (const char* name : {"i", "j"})
        file.create_column<std::uint32_t>(std::string("/events/") + name, {}, {chunk}, packing,
                                          level);
    for (const char* name : {"kind", "sticks"})
        file.create_column<std::uint8_t>(std::string("/events/") + name, {}, {chunk}, packing,
                                         level);
    if (initial.are_spheres()) {
        file.write("/initial/rolling_spin", pairs(initial.spin_x, initial.spin_y), {n, 2});
        file.create_column<double>("/events/vertical_impulse", {}, {chunk}, of_numbers, level);
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
    file.create_group(parameters);
    h5md::write_format(file);
    for (const auto& [name, text] : provenance) file.write(parameters + "/" + name, text);
    file.set_attribute(parameters, "period", initial.period);
    file.set_attribute(parameters, "swirl_end", swirl_end);
    file.set_attribute(parameters, "container_radius", initial.container_radius);
    file.set_attribute(parameters, "complete", std::vector<std::int64_t>{0});
    open_columns();
    flush();
}

EventLogWriter EventLogWriter::resume(const std::filesystem::path& path, std::uint64_t events,
                                      const std::string& run) {
    EventLogWriter writer(path, reopen_recording(path, run));
    writer.file_->set_attribute(parameters, "complete", std::vector<std::int64_t>{0});
    writer.open_columns();
    Columns& c = writer.columns_;
    for (Column* column :
         {&c.periods, &c.clock, &c.kind, &c.i, &c.j, &c.normal_x, &c.normal_y, &c.normal_impulse,
          &c.tangential_impulse, &c.sticks, &c.vertical_impulse}) {
        if (column == &c.vertical_impulse && !writer.file_->has("/floor")) continue;
        if (column->rows() < events)
            throw FileError(fmt::format(
                "'{}' holds {} events, but the checkpoint was made when it held {}; it does not "
                "belong to the checkpoint, or has been changed since.",
                partial_name(path).string(), column->rows(), events));
        column->resize(events);
    }
    writer.events_ = events;
    return writer;
}

void EventLogWriter::open_columns() {
    const auto column = [&](const char* name) {
        return file_->column(std::string("/events/") + name);
    };
    columns_ = {column("swirls"),
                column("clock"),
                column("kind"),
                column("i"),
                column("j"),
                column("normal_x"),
                column("normal_y"),
                column("normal_impulse"),
                column("tangential_impulse"),
                column("sticks"),
                file_->has("/floor") ? column("vertical_impulse") : Column()};
}

void EventLogWriter::empty_buffer() {
    Columns& c = columns_;
    append<std::int64_t>(c.periods, buffer_, [](const Event& e) { return e.periods; });
    append<double>(c.clock, buffer_, [](const Event& e) { return e.clock; });
    append<std::uint8_t>(c.kind, buffer_, [](const Event& e) { return e.kind; });
    append<std::uint32_t>(c.i, buffer_, [](const Event& e) { return e.i; });
    append<std::uint32_t>(c.j, buffer_, [](const Event& e) { return e.j; });
    append<double>(c.normal_x, buffer_, [](const Event& e) { return e.normal.x; });
    append<double>(c.normal_y, buffer_, [](const Event& e) { return e.normal.y; });
    append<double>(c.normal_impulse, buffer_, [](const Event& e) { return e.impulse.normal; });
    append<double>(c.tangential_impulse, buffer_,
                   [](const Event& e) { return e.impulse.tangential; });
    append<std::uint8_t>(c.sticks, buffer_, [](const Event& e) { return e.impulse.sticks; });
    if (file_->has("/floor"))
        append<double>(c.vertical_impulse, buffer_,
                       [](const Event& e) { return e.impulse.vertical; });
    buffer_.clear();
    if (std::chrono::steady_clock::now() - last_flush_ < events_wait) return;
    file_->flush();
    last_flush_ = std::chrono::steady_clock::now();
}

void EventLogWriter::flush() {
    empty_buffer();
    file_->flush();
    last_flush_ = std::chrono::steady_clock::now();
}

void EventLogWriter::finish() {
    empty_buffer();
    file_->set_attribute(parameters, "complete", std::vector<std::int64_t>{1});
    columns_ = {};
    file_->finish(path_);
    file_.reset();
}

bool is_event_log(const std::filesystem::path& path) {
    return Hdf5File(path, JournaledFile::Mode::read).has("/events/clock");
}

EventLogReader::EventLogReader(const std::filesystem::path& path)
    : file_(std::make_unique<Hdf5File>(path, JournaledFile::Mode::read)) {
    if (!file_->has("/events/clock") || !file_->has("/initial/position"))
        throw FileError(fmt::format(
            "'{}' is an HDF5 file, but not an event log: it has no /events.", path.string()));
    h5md::require_known_format(*file_, path);
    const auto column = [&](const char* name) {
        return file_->column(std::string("/events/") + name);
    };
    periods_ = column("swirls");
    clock_ = column("clock");
    kind_ = column("kind");
    i_ = column("i");
    j_ = column("j");
    normal_x_ = column("normal_x");
    normal_y_ = column("normal_y");
    normal_impulse_ = column("normal_impulse");
    tangential_impulse_ = column("tangential_impulse");
    sticks_ = column("sticks");
    for (const Column* each : {&periods_, &clock_, &kind_, &i_, &j_, &normal_x_, &normal_y_,
                               &normal_impulse_, &tangential_impulse_, &sticks_})
        if (!each->row_shape().empty())
            throw FileError(
                fmt::format("'{}' contradicts itself: an event has one value in each "
                            "column, and it has a table in one.",
                            path.string()));
    const bool spheres = file_->has("/floor");
    for (const char* of_spheres : {"/events/vertical_impulse", "/initial/rolling_spin"})
        if (file_->has(of_spheres) != spheres)
            throw FileError(
                fmt::format("'{}' contradicts itself: {} and /floor are of spheres, and it has "
                            "only one of them.",
                            path.string(), of_spheres));
    if (spheres) {
        vertical_impulse_ = column("vertical_impulse");
        floor_.emplace();
        floor_->floor = {file_->number_attribute("/floor", "deceleration"),
                         file_->has_attribute("/floor", "lie_flat"),
                         file_->has_attribute("/floor", "rolling_resistance")
                             ? file_->number_attribute("/floor", "rolling_resistance")
                             : 0.0};
        const Column moves = file_->column("/floor/velocity");
        if (moves.row_shape() != Dimensions{2})
            throw FileError(
                fmt::format("'{}' contradicts itself: /floor/velocity has not x and y in each row.",
                            path.string()));
        const auto velocity = moves.read<double>();
        for (std::size_t k = 0; k + 1 < velocity.size(); k += 2)
            floor_->velocity.push_back({velocity[k], velocity[k + 1]});
        if (floor_->velocity.empty() || !vertical_impulse_.row_shape().empty())
            throw FileError(fmt::format(
                "'{}' contradicts itself: it is of spheres, but does not say how their floor moves "
                "or how they rub.",
                path.string()));
    }
    complete_ = file_->integers_attribute(parameters, "complete").at(0) == 1;
    std::vector<std::uint64_t> lengths{periods_.rows(),
                                       clock_.rows(),
                                       kind_.rows(),
                                       i_.rows(),
                                       j_.rows(),
                                       normal_x_.rows(),
                                       normal_y_.rows(),
                                       normal_impulse_.rows(),
                                       tangential_impulse_.rows(),
                                       sticks_.rows()};
    if (spheres) lengths.push_back(vertical_impulse_.rows());
    events_ = common_length(path, complete_, lengths);
    const auto numbers = [&](const char* name) {
        return file_->column(std::string("/initial/") + name).read<double>();
    };
    const auto position = numbers("position"), velocity = numbers("velocity");
    const auto angle = numbers("angle"), spin = numbers("spin");
    const auto radius = numbers("radius"), mass = numbers("mass");
    const auto inertia = numbers("moment_of_inertia");
    const std::size_t n = angle.size();
    const auto rolling = spheres ? numbers("rolling_spin") : std::vector<double>(2 * n, 0.0);
    if (position.size() != 2 * n || rolling.size() != 2 * n || velocity.size() != 2 * n ||
        spin.size() != n || radius.size() != n || mass.size() != n || inertia.size() != n)
        throw FileError(
            fmt::format("'{}' contradicts itself: its columns differ in length.", path.string()));
    for (std::size_t i = 0; i < n; ++i)
        initial_.push_back({{position[2 * i], position[2 * i + 1]},
                            {velocity[2 * i], velocity[2 * i + 1]},
                            angle[i],
                            spin[i],
                            0.0,
                            radius[i],
                            mass[i],
                            inertia[i],
                            {rolling[2 * i], rolling[2 * i + 1]}});
    period_ = file_->number_attribute(parameters, "period");
    swirl_end_ = file_->number_attribute(parameters, "swirl_end");
    container_radius_ = file_->number_attribute(parameters, "container_radius");
    Snapshot first;
    first.period = period_;
    first.container_radius = container_radius_;
    spheres ? first.resize_for_spheres(n) : first.resize(n);
    for (std::size_t i = 0; i < n; ++i) first.set(i, initial_[i]);
    require_possible(first, Spins::known, path.string());
}

std::string EventLogReader::provenance(const std::string& name) const {
    const std::string at = parameters + "/" + name;
    return file_->has(at) ? file_->read_text(at) : "";
}

std::vector<Event> EventLogReader::read(std::uint64_t first, std::uint64_t count) const {
    const auto periods = periods_.read<std::int64_t>(first, count);
    const auto clock = clock_.read<double>(first, count);
    const auto kind = kind_.read<std::uint8_t>(first, count);
    const auto i = i_.read<std::uint32_t>(first, count), j = j_.read<std::uint32_t>(first, count);
    const auto normal_x = normal_x_.read<double>(first, count);
    const auto normal_y = normal_y_.read<double>(first, count);
    const auto normal_impulse = normal_impulse_.read<double>(first, count);
    const auto tangential_impulse = tangential_impulse_.read<double>(first, count);
    const auto sticks = sticks_.read<std::uint8_t>(first, count);
    const auto vertical =
        floor_ ? vertical_impulse_.read<double>(first, count) : std::vector<double>(count, 0.0);
    std::vector<Event> events;
    events.reserve(count);
    for (std::size_t k = 0; k < count; ++k) {
        if (kind[k] > (floor_ ? 3 : 2) || sticks[k] > 1 || i[k] >= initial_.size() ||
            j[k] >= initial_.size())
            throw FileError(fmt::format("Event {} of the log is damaged.", first + k));
        events.push_back({periods[k],
                          clock[k],
                          EventKind(kind[k]),
                          i[k],
                          j[k],
                          {normal_x[k], normal_y[k]},
                          {normal_impulse[k], tangential_impulse[k], sticks[k] == 1, vertical[k]},
                          0.0});
    }
    return events;
}

Replay::Replay(std::vector<Disc> initial, double swirl_end, std::optional<MovingFloor> floor)
    : discs_(std::move(initial)),
      swirl_end_(swirl_end),
      floor_(std::move(floor)),
      motions_(discs_.size()) {
    for (std::size_t i = 0; i < discs_.size(); ++i) let_fly(i);
}

/// How a sphere moves from the state it has got.
void Replay::let_fly(std::size_t i) {
    if (floor_) motions_[i] = floor_motion(discs_[i], floor_->floor, floor_->velocity.at(segment_));
}

void Replay::bring_to(std::size_t i, double t) {
    discs_[i] = floor_ ? moved_to(discs_[i], motions_[i], t) : discs_[i].at(t);
}

void Replay::pass_vertex(const Event& event) {
    const bool is_last = event.clock == swirl_end_;
    if (floor_) segment_ = is_last ? 0 : segment_ + 1;
    if (floor_ && segment_ >= floor_->velocity.size())
        throw FileError(
            "An event log contradicts itself: it has more path vertices in a swirl than "
            "its floor has legs.");
    if (!is_last && !(floor_ && floor_->floor.deceleration != 0.0)) return;
    for (std::size_t i = 0; i < discs_.size(); ++i) {
        bring_to(i, event.clock);
        if (is_last) discs_[i].time = 0.0;
        let_fly(i);
    }
    periods_ += is_last ? 1 : 0;
}

void Replay::apply(const Event& event) {
    if (event.kind == EventKind::path_vertex) return pass_vertex(event);
    if (event.kind == EventKind::begins_to_roll) {
        if (!floor_) return;
        discs_.at(event.i) = set_rolling(discs_[event.i], motions_[event.i], floor_->floor,
                                         floor_->velocity.at(segment_));
        return let_fly(event.i);
    }
    const Vec2 tangent{event.normal.y, -event.normal.x};
    const Vec2 kick = event.impulse.normal * event.normal + event.impulse.tangential * tangent;
    const auto push = [&](std::size_t i, double direction) {
        Disc& d = discs_.at(i);
        bring_to(i, event.clock);
        const Vec2 change = (1.0 / d.mass) * kick;
        d.velocity = direction < 0.0 ? d.velocity - change : d.velocity + change;
        d.spin = d.spin + d.radius * event.impulse.tangential * (1.0 / d.inertia);
        d.rolling_spin =
            d.rolling_spin - (d.radius * event.impulse.vertical * (1.0 / d.inertia)) * tangent;
        let_fly(i);
    };
    push(event.i, -1.0);
    if (event.kind == EventKind::disc_disc) push(event.j, 1.0);
}

}  // namespace swirl
