#include "files/trajectory.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "files/file_error.hpp"
#include "files/series.hpp"
#include "files/whole_file.hpp"

namespace swirl {
namespace {

const std::string particles = "/particles/trajectory";
const std::string observables = "/observables";
const std::string parameters = "/parameters";

constexpr std::chrono::milliseconds flush_interval(500);

// A chunk is what is compressed, written and read in one piece.
constexpr std::uint64_t chunk_bytes = 256 * 1024;
constexpr std::uint64_t most_frames_per_chunk = 1024;

std::uint64_t frames_per_chunk(std::uint64_t discs) {
    const std::uint64_t frame = std::max<std::uint64_t>(1, discs) * 3 * sizeof(double);
    return std::clamp<std::uint64_t>(chunk_bytes / frame, 1, most_frames_per_chunk);
}

std::filesystem::path partial_name(const std::filesystem::path& path) {
    return path.string() + std::string(partial_suffix);
}

// Every time series has its own step and time in H5MD; here they are all the same two.
void link_times(Hdf5File& file, const std::string& group) {
    file.link(particles + "/position/step", group + "/step");
    file.link(particles + "/position/time", group + "/time");
}

void create_particle_series(Hdf5File& file, const std::string& name, const Dimensions& row,
                            std::uint64_t chunk, int compression) {
    const std::string group = particles + "/" + name;
    file.create_group(group);
    link_times(file, group);
    file.create_column<double>(group + "/value", row, chunk, compression);
    std::vector<std::string> scales{group + "/time", particles + "/particle"};
    if (row.size() > 1) scales.push_back(particles + "/xyz");
    file.attach_scales(group + "/value", scales);
}

template <class T>
void create_observable(Hdf5File& file, const std::string& name, int compression) {
    const std::string group = observables + "/" + name;
    file.create_group(group);
    link_times(file, group);
    file.create_column<T>(group + "/value", {}, most_frames_per_chunk, compression);
    file.attach_scales(group + "/value", {group + "/time"});
}

void create_fixed(Hdf5File& file, const Snapshot& first) {
    const std::uint64_t n = first.size();
    std::vector<std::int64_t> id(n), species(n, 0);
    std::vector<std::pair<double, double>> kinds;  // radius and mass make a species
    for (std::size_t i = 0; i < n; ++i) {
        id[i] = std::int64_t(i);
        const std::pair kind(first.radius[i], first.mass[i]);
        const auto found = std::find(kinds.begin(), kinds.end(), kind);
        species[i] = found - kinds.begin();
        if (found == kinds.end()) kinds.push_back(kind);
    }
    file.write(particles + "/particle", id, {n});
    file.make_scale(particles + "/particle", "particle");
    file.write(particles + "/xyz", std::vector<std::int64_t>{0, 1, 2}, {3});
    file.make_scale(particles + "/xyz", "xyz");
    file.write(particles + "/id", id, {n});
    file.write(particles + "/species", species, {n});
    file.write(particles + "/mass", first.mass, {n});
    file.write(particles + "/radius", first.radius, {n});
    file.write(particles + "/moment_of_inertia", first.inertia, {n});
    for (const char* name : {"/id", "/species", "/mass", "/radius", "/moment_of_inertia"})
        file.attach_scales(particles + name, {particles + "/particle"});
}

void create_layout(Hdf5File& file, const Snapshot& first, int compression) {
    const std::uint64_t n = first.size(), chunk = frames_per_chunk(n);
    file.create_group("/h5md");
    file.set_attribute("/h5md", "version", std::vector<std::int64_t>{1, 1});
    file.create_group("/h5md/author");
    file.set_attribute("/h5md/author", "name", std::string("unknown"));
    file.create_group("/h5md/creator");
    file.set_attribute("/h5md/creator", "name", std::string("swirl"));
    file.create_group("/particles");
    file.create_group(particles);
    file.create_group(particles + "/box");
    file.set_attribute(particles + "/box", "dimension", std::vector<std::int64_t>{3});
    file.set_attribute(particles + "/box", "boundary",
                       std::vector<std::string>{"none", "none", "none"});
    create_fixed(file, first);

    const std::string position = particles + "/position";
    file.create_group(position);
    file.create_column<std::int64_t>(position + "/step", {}, most_frames_per_chunk, compression);
    file.create_column<double>(position + "/time", {}, most_frames_per_chunk, compression);
    file.make_scale(position + "/time", "time");
    file.attach_scales(position + "/step", {position + "/time"});
    file.create_column<double>(position + "/value", {n, 3}, chunk, compression);
    file.attach_scales(position + "/value",
                       {position + "/time", particles + "/particle", particles + "/xyz"});
    create_particle_series(file, "velocity", {n, 3}, chunk, compression);
    create_particle_series(file, "angle", {n}, chunk, compression);
    create_particle_series(file, "angular_velocity", {n}, chunk, compression);

    file.create_group(observables);
    create_observable<std::int64_t>(file, "swirls", compression);
    create_observable<std::int64_t>(file, "events", compression);
    for (const char* name : {"clock", "container_x", "container_y", "container_vx", "container_vy"})
        create_observable<double>(file, name, compression);
}

template <class T>
void empty(Column& column, std::vector<T>& buffer, std::uint64_t frames) {
    column.append(buffer.data(), frames);
    buffer.clear();
}

}  // namespace

TrajectoryWriter::TrajectoryWriter(const std::filesystem::path& path, Hdf5File file)
    : path_(path),
      file_(std::make_unique<Hdf5File>(std::move(file))),
      last_flush_(std::chrono::steady_clock::now()) {}

TrajectoryWriter::TrajectoryWriter(const std::filesystem::path& path, const Snapshot& first,
                                   const Provenance& provenance, int compression)
    : TrajectoryWriter(path, Hdf5File(partial_name(path), StagedFile::Mode::create)) {
    create_layout(*file_, first, compression);
    file_->create_group(parameters);
    for (const auto& [name, text] : provenance) {
        file_->write(parameters + "/" + name, text);
        if (name == "version") file_->set_attribute("/h5md/creator", "version", text);
    }
    if (!file_->has_attribute("/h5md/creator", "version"))
        file_->set_attribute("/h5md/creator", "version", std::string("unknown"));
    file_->set_attribute(parameters, "period", first.period);
    file_->set_attribute(parameters, "container_radius", first.container_radius);
    file_->set_attribute(parameters, "complete", std::vector<std::int64_t>{0});
    open_columns();
    flush();
}

TrajectoryWriter TrajectoryWriter::resume(const std::filesystem::path& path, std::uint64_t frames) {
    take_back_name(partial_name(path), path);
    TrajectoryWriter writer(path, Hdf5File(partial_name(path), StagedFile::Mode::change));
    writer.file_->set_attribute(parameters, "complete", std::vector<std::int64_t>{0});
    writer.open_columns();
    Columns& c = writer.columns_;
    for (Column* column :
         {&c.step, &c.time, &c.position, &c.velocity, &c.angle, &c.angular_velocity, &c.swirls,
          &c.clock, &c.events, &c.container_x, &c.container_y, &c.container_vx, &c.container_vy}) {
        if (column->rows() < frames)
            throw FileError(fmt::format(
                "'{}' holds {} frames, but the checkpoint was made when it held {}; it does not "
                "belong to the checkpoint, or has been changed since.",
                partial_name(path).string(), column->rows(), frames));
        column->resize(frames);
    }
    writer.frames_ = frames;
    return writer;
}

void TrajectoryWriter::open_columns() {
    const auto particle = [&](const char* name) {
        return file_->column(particles + "/" + name + "/value");
    };
    const auto observable = [&](const char* name) {
        return file_->column(observables + "/" + name + "/value");
    };
    columns_ = {file_->column(particles + "/position/step"),
                file_->column(particles + "/position/time"),
                particle("position"),
                particle("velocity"),
                particle("angle"),
                particle("angular_velocity"),
                observable("swirls"),
                observable("clock"),
                observable("events"),
                observable("container_x"),
                observable("container_y"),
                observable("container_vx"),
                observable("container_vy")};
    discs_ = columns_.angle.row_shape().at(0);
    frames_per_chunk_ = frames_per_chunk(discs_);
}

void TrajectoryWriter::write(const Snapshot& s, std::uint64_t events) {
    Buffers& b = buffers_;
    for (std::size_t i = 0; i < discs_; ++i) {
        const Vec2 p = s.position(i);
        b.position.insert(b.position.end(), {p.x, p.y, 0.0});
        b.velocity.insert(b.velocity.end(), {s.vx[i], s.vy[i], 0.0});
        b.angle.push_back(s.orientation(i));
        b.angular_velocity.push_back(s.spin[i]);
    }
    b.step.push_back(std::int64_t(frames_));
    b.time.push_back(s.time());
    b.swirls.push_back(s.swirls);
    b.clock.push_back(s.clock);
    b.events.push_back(std::int64_t(events));
    b.container_x.push_back(s.container_centre.x);
    b.container_y.push_back(s.container_centre.y);
    b.container_vx.push_back(s.container_velocity.x);
    b.container_vy.push_back(s.container_velocity.y);
    ++frames_;
    if (frames_ % frames_per_chunk_ == 0) empty_buffers();
    if (std::chrono::steady_clock::now() - last_flush_ >= flush_interval) flush();
}

void TrajectoryWriter::empty_buffers() {
    const std::uint64_t n = buffers_.step.size();
    if (n == 0) return;
    empty(columns_.position, buffers_.position, n);
    empty(columns_.velocity, buffers_.velocity, n);
    empty(columns_.angle, buffers_.angle, n);
    empty(columns_.angular_velocity, buffers_.angular_velocity, n);
    empty(columns_.step, buffers_.step, n);
    empty(columns_.time, buffers_.time, n);
    empty(columns_.swirls, buffers_.swirls, n);
    empty(columns_.clock, buffers_.clock, n);
    empty(columns_.events, buffers_.events, n);
    empty(columns_.container_x, buffers_.container_x, n);
    empty(columns_.container_y, buffers_.container_y, n);
    empty(columns_.container_vx, buffers_.container_vx, n);
    empty(columns_.container_vy, buffers_.container_vy, n);
}

void TrajectoryWriter::flush(bool durable) {
    empty_buffers();
    file_->flush(durable);
    last_flush_ = std::chrono::steady_clock::now();
}

void TrajectoryWriter::finish() {
    empty_buffers();
    file_->set_attribute(parameters, "complete", std::vector<std::int64_t>{1});
    columns_ = {};
    file_->close();
    file_.reset();
    give_final_name(partial_name(path_), path_);
}

TrajectoryReader::TrajectoryReader(const std::filesystem::path& path)
    : file_(std::make_unique<Hdf5File>(path, StagedFile::Mode::read)) {
    if (!file_->has_attribute("/h5md", "version") || !file_->has(particles + "/position/value"))
        throw FileError(
            fmt::format("'{}' is an HDF5 file, but not a trajectory: it has no {}/position.",
                        path.string(), particles));
    if (!file_->has(parameters) || !file_->has(observables + "/swirls/value"))
        throw FileError(fmt::format(
            "'{}' is an H5MD file of another program: it has no record of the container.",
            path.string()));
    position_ = file_->column(particles + "/position/value");
    velocity_ = file_->column(particles + "/velocity/value");
    angle_ = file_->column(particles + "/angle/value");
    angular_velocity_ = file_->column(particles + "/angular_velocity/value");
    const auto numbers = [&](const char* name) {
        return file_->column(observables + "/" + name + "/value").read<double>();
    };
    swirls_ = file_->column(observables + "/swirls/value").read<std::int64_t>();
    events_ = file_->column(observables + "/events/value").read<std::int64_t>();
    clock_ = numbers("clock");
    container_x_ = numbers("container_x");
    container_y_ = numbers("container_y");
    container_vx_ = numbers("container_vx");
    container_vy_ = numbers("container_vy");
    // A file cut off between two columns counts as far as all of them go.
    frames_ = std::min({position_.rows(), velocity_.rows(), angle_.rows(), angular_velocity_.rows(),
                        swirls_.size(), events_.size(), clock_.size(), container_x_.size(),
                        container_y_.size(), container_vx_.size(), container_vy_.size()});
    fixed_.resize(file_->column(particles + "/radius").rows());
    fixed_.radius = file_->column(particles + "/radius").read<double>();
    fixed_.mass = file_->column(particles + "/mass").read<double>();
    fixed_.inertia = file_->column(particles + "/moment_of_inertia").read<double>();
    fixed_.period = file_->number_attribute(parameters, "period");
    fixed_.container_radius = file_->number_attribute(parameters, "container_radius");
    complete_ = file_->integers_attribute(parameters, "complete").at(0) == 1;
    block_ = frames_per_chunk(discs());
    if (position_.row_shape() != Dimensions{discs(), 3} ||
        velocity_.row_shape() != Dimensions{discs(), 3} ||
        angle_.row_shape() != Dimensions{discs()})
        throw FileError(
            fmt::format("'{}' contradicts itself: its columns differ in shape.", path.string()));
}

void TrajectoryReader::load_block_of(std::uint64_t k) {
    if (k >= block_begin_ && k < block_end_) return;
    block_begin_ = k / block_ * block_;
    block_end_ = std::min(block_begin_ + block_, frames_);
    const std::uint64_t n = block_end_ - block_begin_;
    loaded_ = {position_.read<double>(block_begin_, n), velocity_.read<double>(block_begin_, n),
               angle_.read<double>(block_begin_, n),
               angular_velocity_.read<double>(block_begin_, n)};
}

Snapshot TrajectoryReader::frame(std::uint64_t k) {
    if (k >= frames_)
        throw FileError(fmt::format("Frame {} was asked for, but there are {}.", k, frames_));
    load_block_of(k);
    Snapshot s = fixed_;
    s.swirls = swirls_[k];
    s.clock = clock_[k];
    s.container_centre = {container_x_[k], container_y_[k]};
    s.container_velocity = {container_vx_[k], container_vy_[k]};
    const std::size_t first = (k - block_begin_) * discs();
    for (std::size_t i = 0; i < discs(); ++i) {
        const std::size_t at = first + i;
        s.set(i, {{loaded_.position[3 * at], loaded_.position[3 * at + 1]},
                  {loaded_.velocity[3 * at], loaded_.velocity[3 * at + 1]},
                  loaded_.angle[at],
                  loaded_.angular_velocity[at],
                  s.clock,
                  fixed_.radius[i],
                  fixed_.mass[i],
                  fixed_.inertia[i]});
    }
    return s;
}

double TrajectoryReader::reach() const {
    double furthest = 0.0;
    for (const auto* along : {&container_x_, &container_y_})
        for (const double c : *along) furthest = std::max(furthest, std::abs(c));
    return furthest + fixed_.container_radius;
}

SnapshotSeries series_of(std::shared_ptr<TrajectoryReader> reader) {
    return {reader->frames(), reader->reach(), true,
            [reader](std::uint64_t k) { return reader->frame(k); }};
}

std::uint64_t TrajectoryReader::events_before(std::uint64_t k) const {
    return std::uint64_t(events_.at(k));
}

std::string TrajectoryReader::provenance(const std::string& name) const {
    const std::string at = parameters + "/" + name;
    return file_->has(at) ? file_->read_text(at) : "";
}
std::vector<std::string> TrajectoryReader::provenance_names() const {
    return file_->names_in(parameters);
}

}  // namespace swirl
