#include "swirl/io/trajectory.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "swirl/io/file_error.hpp"
#include "swirl/io/h5md.hpp"
#include "swirl/io/range_checks.hpp"
#include "swirl/io/recording.hpp"
#include "swirl/io/series.hpp"
#include "swirl/physics/limits.hpp"

namespace swirl {
namespace {

using h5md::observables;
using h5md::parameters;
using h5md::particles;

bool lie_in_plane(const std::vector<double>& vectors) {
    for (std::size_t z = 2; z < vectors.size(); z += 3)
        if (vectors[z] != 0.0) return false;
    return true;
}

}  // namespace

TrajectoryReader::TrajectoryReader(const std::filesystem::path& path)
    : path_(path.string()), file_(std::make_unique<Hdf5File>(path, JournaledFile::Mode::read)) {
    if (!file_->has_attribute("/h5md", "version") || !file_->has(particles + "/position/value"))
        throw FileError(
            fmt::format("'{}' is an HDF5 file, but not a trajectory: it has no {}/position.",
                        path.string(), particles));
    if (!file_->has(parameters) || !file_->has(observables + "/swirls/value"))
        throw FileError(fmt::format(
            "'{}' is an H5MD file of another program: it has no record of the container.",
            path.string()));
    h5md::require_known_format(*file_, path);
    position_ = file_->column(particles + "/position/value");
    velocity_ = file_->column(particles + "/velocity/value");
    angle_ = file_->column(particles + "/angle/value");
    angular_velocity_ = file_->column(particles + "/angular_velocity/value");
    are_spheres_ = file_->has(particles + "/orientation/value");
    if (are_spheres_) {
        rolling_spin_ = file_->column(particles + "/rolling_spin/value");
        orientation_ = file_->column(particles + "/orientation/value");
    }
    const auto of_frames = [&](const std::string& name) {
        Column column = file_->column(name);
        if (column.row_shape().empty()) return column;
        throw FileError(
            fmt::format("'{}' contradicts itself: a frame has one value in {}, and it has a table.",
                        path.string(), name));
    };
    const auto observed = [&](const char* name) {
        return of_frames(observables + "/" + name + "/value");
    };
    const auto numbers = [&](const char* name) { return observed(name).read<double>(); };
    periods_ = observed("swirls").read<std::int64_t>();
    events_ = observed("events").read<std::int64_t>();
    clock_ = numbers("clock");
    container_x_ = numbers("container_x");
    container_y_ = numbers("container_y");
    container_vx_ = numbers("container_vx");
    container_vy_ = numbers("container_vy");
    step_ = of_frames(particles + "/position/step");
    time_ = of_frames(particles + "/position/time");
    complete_ = file_->integers_attribute(parameters, "complete").at(0) == 1;
    std::vector<std::uint64_t> lengths{
        position_.rows(),    velocity_.rows(),    angle_.rows(),       angular_velocity_.rows(),
        step_.rows(),        time_.rows(),        periods_.size(),     events_.size(),
        clock_.size(),       container_x_.size(), container_y_.size(), container_vx_.size(),
        container_vy_.size()};
    if (are_spheres_) {
        lengths.push_back(rolling_spin_.rows());
        lengths.push_back(orientation_.rows());
    }
    frames_ = common_length(path, complete_, lengths);
    const auto of_discs = [&](const char* name) {
        return file_->column(particles + "/" + name).read<double>();
    };
    const auto radius = of_discs("radius"), mass = of_discs("mass"),
               inertia = of_discs("moment_of_inertia");
    const Dimensions row{radius.size()}, row_of_vectors{radius.size(), 3};
    if (position_.row_shape() != row_of_vectors || velocity_.row_shape() != row_of_vectors ||
        angle_.row_shape() != row || angular_velocity_.row_shape() != row ||
        mass.size() != radius.size() || inertia.size() != radius.size())
        throw FileError(
            fmt::format("'{}' contradicts itself: its columns differ in shape.", path.string()));
    const Dimensions row_of_spins{radius.size(), 2}, row_of_turns{radius.size(), 4};
    if (are_spheres_ &&
        (rolling_spin_.row_shape() != row_of_spins || orientation_.row_shape() != row_of_turns))
        throw FileError(
            fmt::format("'{}' contradicts itself: its columns differ in shape.", path.string()));
    if (are_spheres_) {
        fixed_.resize_for_spheres(radius.size());
        fixed_.turned.resize(radius.size());
        fixed_.on_floor = file_->integers_attribute(parameters, "floor").at(0) == 1;
        fixed_.lie_flat = file_->has_attribute(parameters, "lie_flat");
    }
    fixed_.resize(radius.size());
    fixed_.radius = radius;
    fixed_.mass = mass;
    fixed_.inertia = inertia;
    fixed_.period = file_->number_attribute(parameters, "period");
    fixed_.container_radius = file_->number_attribute(parameters, "container_radius");
    require_possible(fixed_, Spins::known, path_);
    if (!(reach() <= largest_coordinate))
        throw FileError(
            fmt::format("'{}': the container goes as far as {}, but must stay within {}.", path_,
                        reach(), largest_coordinate));
    block_ = angle_.chunk_shape().empty() ? 1 : std::max<std::uint64_t>(1, angle_.chunk_shape()[0]);
}

void TrajectoryReader::load_block_of(std::uint64_t k) {
    if (k >= block_begin_ && k < block_end_) return;
    block_begin_ = k / block_ * block_;
    block_end_ = std::min(block_begin_ + block_, frames_);
    const std::uint64_t n = block_end_ - block_begin_;
    loaded_ = {position_.read<double>(block_begin_, n),
               velocity_.read<double>(block_begin_, n),
               angle_.read<double>(block_begin_, n),
               angular_velocity_.read<double>(block_begin_, n),
               {},
               {}};
    if (!are_spheres_) return;
    loaded_.rolling_spin = rolling_spin_.read<double>(block_begin_, n);
    loaded_.orientation = orientation_.read<double>(block_begin_, n);
}

Snapshot TrajectoryReader::frame(std::uint64_t k) {
    if (k >= frames_)
        throw FileError(fmt::format("Frame {} was asked for, but there are {}.", k, frames_));
    load_block_of(k);
    Snapshot s = fixed_;
    s.periods = periods_[k];
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
        if (!are_spheres_) continue;
        s.set_floor_motion(i, {loaded_.rolling_spin[2 * at], loaded_.rolling_spin[2 * at + 1]},
                           {0.0, 0.0});
        const double* const q = loaded_.orientation.data() + 4 * at;
        s.turned[i] = {q[0], q[1], q[2], q[3]};
    }
    require_possible(s, Spins::known, path_);
    return s;
}

double TrajectoryReader::reach() const {
    double furthest = 0.0;
    for (const auto* along : {&container_x_, &container_y_})
        for (const double c : *along) furthest = std::max(furthest, std::abs(c));
    return furthest + fixed_.container_radius;
}

SnapshotSeries series_of(std::shared_ptr<TrajectoryReader> reader) {
    return {reader->frames(), reader->reach(),
            [reader](std::uint64_t k) { return reader->frame(k); }};
}

std::uint64_t TrajectoryReader::events_before(std::uint64_t k) const {
    return std::uint64_t(events_.at(k));
}

std::vector<std::string> TrajectoryReader::series_names() const {
    std::vector<std::string> names;
    for (const char* name : {"position", "velocity", "angle", "angular_velocity"})
        names.push_back(particles + "/" + name);
    if (are_spheres_)
        for (const char* name : {"rolling_spin", "orientation"})
            names.push_back(particles + "/" + name);
    for (const char* name : {"swirls", "events", "clock", "container_x", "container_y",
                             "container_vx", "container_vy"})
        names.push_back(observables + "/" + name);
    return names;
}

void TrajectoryReader::read_all() {
    for (const std::string& name : provenance_names()) provenance(name);
    contradicted_by_names_or_times();
    for (std::uint64_t k = 0; k < frames_; k += block_) frame(k);
}

std::string TrajectoryReader::contradicted_by_names_or_times() const {
    const auto whole = [&](const std::string& name) {
        return file_->column(particles + "/" + name).read<std::int64_t>();
    };
    const auto counts = [&](const char* name, std::size_t entries) {
        std::vector<std::int64_t> numbers(entries);
        std::iota(numbers.begin(), numbers.end(), 0);
        return whole(name) == numbers;
    };
    for (const char* name : {"id", "particle"})
        if (!counts(name, discs())) return name;
    if (!counts("xyz", 3)) return "xyz";
    if (are_spheres_ && !counts("xy", 2)) return "xy";
    if (are_spheres_ && !counts("wxyz", 4)) return "wxyz";
    if (whole("species") != h5md::species_of(fixed_.radius, fixed_.mass)) return "species";
    for (const std::string& series : series_names()) {
        const Column step = file_->column(series + "/step"), time = file_->column(series + "/time");
        for (const Column* each : {&step, &time})
            if (!each->row_shape().empty() || each->rows() < frames_ ||
                (complete_ && each->rows() != frames_))
                return series + (each == &step ? "/step" : "/time");
        const auto steps = step.read<std::int64_t>(0, frames_);
        const auto times = time.read<double>(0, frames_);
        for (std::uint64_t k = 0; k < frames_; ++k) {
            if (steps[k] != std::int64_t(k)) return series + "/step";
            if (times[k] != double(periods_[k]) * fixed_.period + clock_[k])
                return series + "/time";
        }
    }
    return "";
}

std::string TrajectoryReader::contradicted() {
    if (std::string name = contradicted_by_names_or_times(); !name.empty()) return name;
    for (std::uint64_t k = 0; k < frames_; k += block_) {
        load_block_of(k);
        if (!lie_in_plane(loaded_.position)) return "position";
        if (!lie_in_plane(loaded_.velocity)) return "velocity";
    }
    return "";
}

std::string TrajectoryReader::provenance(const std::string& name) const {
    const std::string at = parameters + "/" + name;
    return file_->has(at) ? file_->read_text(at) : "";
}
std::vector<std::string> TrajectoryReader::provenance_names() const {
    return file_->names_in(parameters);
}

}  // namespace swirl
