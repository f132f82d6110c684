#include "swirl/io/trajectory.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "swirl/io/atomic_file.hpp"
#include "swirl/io/file_error.hpp"
#include "swirl/io/h5md.hpp"
#include "swirl/io/optional_file.hpp"
#include "swirl/io/range_checks.hpp"
#include "swirl/io/recording.hpp"
#include "swirl/io/series.hpp"
#include "swirl/io/trajectory_layout.hpp"
#include "swirl/physics/limits.hpp"

namespace swirl {
namespace {

using h5md::observables;
using h5md::parameters;
using h5md::particles;
using namespace trajectory_layout;

bool lie_in_plane(const std::vector<double>& vectors) {
    for (std::size_t z = 2; z < vectors.size(); z += 3)
        if (vectors[z] != 0.0) return false;
    return true;
}

}  // namespace

namespace {

/// Calls read(), and again if the file has changed meanwhile. A writer commits twice a second, and
/// read() takes milliseconds, so the second attempt mostly succeeds.
auto repeat_if_changed(auto&& read) {
    for (int attempts_left = 50;; --attempts_left) {
        try {
            return read();
        } catch (const FileChanged&) {
            if (attempts_left == 0) throw;
        }
    }
}

}  // namespace

TrajectoryReader::TrajectoryReader(const std::filesystem::path& path) : path_(path.string()) {
    repeat_if_changed([&] { open(); });
}

template <class Read>
auto TrajectoryReader::reread(Read&& read) {
    bool is_first = true;
    return repeat_if_changed([&] {
        if (!std::exchange(is_first, false)) reopen();
        return read();
    });
}

/// The frames that were there remain. The file may have got its final name.
void TrajectoryReader::reopen() {
    std::string path = path_;
    if (path.ends_with(partial_suffix) && !file_exists(path))
        path.resize(path.size() - partial_suffix.size());
    TrajectoryReader again(path);
    if (again.run_ != run_ || again.frames_ < frames_)
        throw FileError(
            fmt::format("'{}' was replaced by another recording while it was read.", path));
    path_ = path;
    file_ = std::move(again.file_);
    series_ = std::move(again.series_);
}

void TrajectoryReader::open() {
    const std::filesystem::path path = path_;
    series_.clear();
    counters_.clear();
    scalars_.clear();
    constants_ = {};
    file_ = std::make_unique<Hdf5File>(path, JournaledFile::Mode::read);
    if (!file_->has_attribute("/h5md", "version") || !file_->has(group_of(position) + "/value"))
        throw FileError(fmt::format("'{}' is an HDF5 file, but not a trajectory: it has no {}.",
                                    path_, group_of(position)));
    if (!file_->has(parameters) || !file_->has(counter_paths[periods]))
        throw FileError(fmt::format(
            "'{}' is an H5MD file of another program: it does not describe the container.", path_));
    h5md::require_known_format(*file_, path);
    are_spheres_ = file_->has(group_of(orientation) + "/value");
    period_changes_ = file_->has(scalar_paths[period_length]);
    complete_ = file_->integers_attribute(parameters, "complete").at(0) == 1;
    const std::string run_path = parameters + "/" + run_entry;
    run_ = file_->has(run_path) ? file_->read_text(run_path) : "";
    open_columns();
    read_constants();
    if (!(reach() <= largest_coordinate))
        throw FileError(
            fmt::format("'{}': the container reaches as far as {}, but must stay within {}.", path_,
                        reach(), largest_coordinate));
}

/// Opens the series, and reads the columns with one value per frame.
void TrajectoryReader::open_columns() {
    std::vector<std::uint64_t> lengths;
    for (int k = 0; k < series_count(are_spheres_); ++k) {
        series_.push_back(file_->column(group_of(k) + "/value"));
        lengths.push_back(series_.back().rows());
    }
    const auto frame_column = [&](const std::string& path) {
        Column column = file_->column(path);
        if (!column.row_shape().empty())
            throw_inconsistent(path_, fmt::format("{} must have one value per frame", path));
        lengths.push_back(column.rows());
        return column;
    };
    for (const std::string& path : counter_paths)
        counters_.push_back(frame_column(path).read<std::int64_t>());
    for (int k = 0; k < scalar_count(period_changes_); ++k)
        scalars_.push_back(frame_column(scalar_paths[k]).read<double>());
    frames_ = common_length(path_, complete_, lengths);
    require_ascending_times();
    const Dimensions& chunk = series_[angle].chunk_shape();
    frames_per_block_ = chunk.empty() ? 1 : std::max<std::uint64_t>(1, chunk[0]);
}

/// Frames at events may have equal times.
void TrajectoryReader::require_ascending_times() const {
    for (std::uint64_t k = 1; k < frames_; ++k) {
        const auto time = [&](std::uint64_t frame) {
            return std::pair(counters_[periods][frame], scalars_[clock][frame]);
        };
        if (time(k) < time(k - 1) || counters_[events][k] < counters_[events][k - 1])
            throw FileError(
                fmt::format("'{}' is not a recording of a run: the clock of frame {} is before "
                            "that of frame {}.",
                            path_, k, k - 1));
    }
}

/// Reads what is the same in all frames, and checks the shapes of the series against it.
void TrajectoryReader::read_constants() {
    const auto read = [&](const char* name) {
        return file_->column(particles + "/" + name).read<double>();
    };
    auto radius = read("radius"), mass = read("mass"), inertia = read("moment_of_inertia");
    const std::size_t n = radius.size();
    const bool all_can_spin = !file_->has(particles + "/can_spin");
    auto can_spin = all_can_spin ? std::vector<double>{} : read("can_spin");
    bool same_shape =
        mass.size() == n && inertia.size() == n && (all_can_spin || can_spin.size() == n);
    for (std::size_t k = 0; k < series_.size(); ++k) {
        Dimensions row{n};
        if (layouts[k].components > 1) row.push_back(layouts[k].components);
        same_shape = same_shape && series_[k].row_shape() == row;
    }
    if (!same_shape) throw_inconsistent(path_, "its columns differ in shape");
    if (are_spheres_) {
        constants_.resize_for_spheres(n);
        constants_.turned.resize(n);
        constants_.on_floor = file_->integers_attribute(parameters, "floor").at(0) == 1;
        constants_.lie_flat = file_->has_attribute(parameters, "lie_flat");
    }
    constants_.resize(n);
    constants_.radius = std::move(radius);
    constants_.mass = std::move(mass);
    constants_.inertia = std::move(inertia);
    constants_.can_spin = std::move(can_spin);
    constants_.period = file_->number_attribute(parameters, "period");
    constants_.container_radius = file_->number_attribute(parameters, "container_radius");
    require_possible(constants_, Spins::known, path_);
}

void TrajectoryReader::load_block_of(std::uint64_t k) {
    if (k >= block_begin_ && k < block_end_) return;
    const std::uint64_t begin = k / frames_per_block_ * frames_per_block_;
    const std::uint64_t end = std::min(begin + frames_per_block_, frames_);
    block_begin_ = block_end_ = 0;
    reread([&] {
        block_.clear();
        for (const Column& column : series_)
            block_.push_back(column.read<double>(begin, end - begin));
    });
    block_begin_ = begin;
    block_end_ = end;
}

Snapshot TrajectoryReader::frame(std::uint64_t k) {
    if (k >= frames_)
        throw FileError(fmt::format("frame {} was requested, but there are {}.", k, frames_));
    load_block_of(k);
    Snapshot s = constants_;
    s.periods = counters_[periods][k];
    s.clock = scalars_[clock][k];
    if (period_changes_) {
        s.period = scalars_[period_length][k];
        s.periods_at_change = s.periods;
        s.time_at_change = scalars_[period_start][k];
    }
    s.container_centre = {scalars_[centre_x][k], scalars_[centre_y][k]};
    s.container_velocity = {scalars_[centre_vx][k], scalars_[centre_vy][k]};
    const std::size_t first = (k - block_begin_) * discs();
    for (std::size_t i = 0; i < discs(); ++i) {
        const auto values = [&](Series series) {
            return block_[series].data() + (first + i) * layouts[series].components;
        };
        const double *const p = values(position), *const v = values(velocity);
        s.set_motion(i, {{p[0], p[1]}, {v[0], v[1]}, s.clock}, *values(angle),
                     *values(angular_velocity));
        if (!are_spheres_) continue;
        const double *const spin = values(rolling_spin), *const q = values(orientation);
        s.set_floor_motion(i, {spin[0], spin[1]}, {0.0, 0.0});
        s.turned[i] = {q[0], q[1], q[2], q[3]};
    }
    require_possible(s, Spins::known, path_);
    return s;
}

double TrajectoryReader::reach() const {
    double furthest = 0.0;
    for (const Scalar along : {centre_x, centre_y})
        for (const double c : scalars_[along]) furthest = std::max(furthest, std::abs(c));
    return furthest + constants_.container_radius;
}

SnapshotSeries series_of(std::shared_ptr<TrajectoryReader> reader) {
    SnapshotSeries series;
    series.frames = reader->frames();
    series.reach = reader->reach();
    series.frame = [reader](std::uint64_t k) { return reader->frame(k); };
    if (series.frames == 0) return series;
    const Snapshot first = series.frame(0);
    series.units = units_in(first);
    series.clockwise = moves_clockwise(first);
    return series;
}

std::uint64_t TrajectoryReader::events_before(std::uint64_t k) const {
    return std::uint64_t(counters_[events].at(k));
}

void TrajectoryReader::read_all() {
    for (const std::string& name : provenance_names()) provenance(name);
    inconsistent_index_or_time();
    for (std::uint64_t k = 0; k < frames_; k += frames_per_block_) frame(k);
}

std::string TrajectoryReader::inconsistent_index_or_time() const {
    const auto integers = [&](const std::string& name) {
        return file_->column(particles + "/" + name).read<std::int64_t>();
    };
    const auto is_index = [&](const char* name, std::size_t entries) {
        std::vector<std::int64_t> numbers(entries);
        std::iota(numbers.begin(), numbers.end(), 0);
        return integers(name) == numbers;
    };
    for (const char* name : {"id", "particle"})
        if (!is_index(name, discs())) return name;
    if (!is_index("xyz", 3)) return "xyz";
    if (are_spheres_ && !is_index("xy", 2)) return "xy";
    if (are_spheres_ && !is_index("wxyz", 4)) return "wxyz";
    if (integers("species") != h5md::species_of(constants_.radius, constants_.mass))
        return "species";
    std::vector<std::string> groups;
    for (int k = 0; k < series_count(are_spheres_); ++k) groups.push_back(group_of(k));
    for (const std::string& path : counter_paths)
        if (path.ends_with("/value")) groups.push_back(path.substr(0, path.rfind('/')));
    for (int k = clock; k < scalar_count(period_changes_); ++k) {
        const std::string& path = scalar_paths[k];
        groups.push_back(path.substr(0, path.rfind('/')));
    }
    for (const std::string& group : groups)
        if (std::string name = inconsistent_time_of(group); !name.empty()) return name;
    return "";
}

std::string TrajectoryReader::inconsistent_time_of(const std::string& group) const {
    const Column step = file_->column(group + "/step"), time = file_->column(group + "/time");
    for (const Column* each : {&step, &time})
        if (!each->row_shape().empty() || each->rows() < frames_ ||
            (complete_ && each->rows() != frames_))
            return group + (each == &step ? "/step" : "/time");
    const auto steps = step.read<std::int64_t>(0, frames_);
    const auto times = time.read<double>(0, frames_);
    for (std::uint64_t k = 0; k < frames_; ++k) {
        if (steps[k] != std::int64_t(k)) return group + "/step";
        const double start = period_changes_ ? scalars_[period_start][k]
                                             : double(counters_[periods][k]) * constants_.period;
        if (times[k] != start + scalars_[clock][k]) return group + "/time";
    }
    return "";
}

std::string TrajectoryReader::inconsistent_dataset() {
    if (std::string name = inconsistent_index_or_time(); !name.empty()) return name;
    for (std::uint64_t k = 0; k < frames_; k += frames_per_block_) {
        load_block_of(k);
        for (const Series series : {position, velocity})
            if (!lie_in_plane(block_[series])) return layouts[series].name;
    }
    return "";
}

std::string TrajectoryReader::provenance(const std::string& name) {
    const std::string path = parameters + "/" + name;
    return reread([&] { return file_->has(path) ? file_->read_text(path) : std::string(); });
}
std::vector<std::string> TrajectoryReader::provenance_names() {
    return reread([&] { return file_->names_in(parameters); });
}

}  // namespace swirl
