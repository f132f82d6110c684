#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <exception>
#include <mutex>
#include <numeric>
#include <thread>

#include "swirl/io/file_error.hpp"
#include "swirl/io/h5md.hpp"
#include "swirl/io/recording.hpp"
#include "swirl/io/trajectory.hpp"
#include "swirl/io/trajectory_layout.hpp"
#include "swirl/math/wide.hpp"

namespace swirl {
namespace {

using Clock = std::chrono::steady_clock;

using h5md::observables;
using h5md::parameters;
using h5md::particles;
using namespace trajectory_layout;

constexpr std::chrono::milliseconds flush_interval(500);

// HDF5 compresses, writes and reads whole chunks. This size fits into its cache several times, and
// is large enough for the cost per chunk not to matter.
constexpr std::uint64_t chunk_bytes = 128 * 1024;
constexpr std::uint64_t max_frames_per_chunk = 1024;

std::uint64_t frames_per_chunk(std::uint64_t discs) {
    const std::uint64_t frame = std::max<std::uint64_t>(1, discs) * sizeof(double);
    return std::clamp<std::uint64_t>(chunk_bytes / frame, 1, max_frames_per_chunk);
}

/// The columns of doubles that the series consist of. z is never written: HDF5 reads zeros.
enum Quantity { x, y, vx, vy, phi, omega_z, omega_x, omega_y, q_w, q_x, q_y, q_z, quantities };
struct Location {
    Series series;
    std::uint64_t component;
};
constexpr Location locations[quantities] = {
    {position, 0},    {position, 1},         {velocity, 0},     {velocity, 1},
    {angle, 0},       {angular_velocity, 0}, {rolling_spin, 0}, {rolling_spin, 1},
    {orientation, 0}, {orientation, 1},      {orientation, 2},  {orientation, 3}};
constexpr int quantity_count(bool are_spheres) { return are_spheres ? quantities : omega_x; }

/// Frames on their way to the file, column by column. One thread appends frames while the other may
/// already read the first `filled` ones.
struct FrameBlock {
    FrameBlock(std::uint64_t frames, std::uint64_t discs, bool are_spheres) {
        for (int q = 0; q < quantity_count(are_spheres); ++q) of_discs[q].resize(frames * discs);
        for (auto& column : of_counters) column.resize(frames);
        for (auto& column : of_scalars) column.resize(frames);
    }
    std::array<std::vector<double>, quantities> of_discs;
    std::array<std::vector<std::int64_t>, counters> of_counters;
    std::array<std::vector<double>, scalars> of_scalars;
    std::uint64_t first = 0;  // number of its first frame
    std::atomic<std::uint64_t> filled = 0;
};

/// The positions (or angles) at time `now` of discs that move uniformly from their stored states:
/// Snapshot::position() and orientation(), vectorised.
SWIRL_WIDE void extrapolate(std::size_t n, double now, const double* __restrict held_at,
                            const double* __restrict from, const double* __restrict rate,
                            double* __restrict to) {
    for (std::size_t i = 0; i < n; ++i) to[i] = from[i] + (now - held_at[i]) * rate[i];
}

/// Copies the state of a snapshot into frame `k` of a block. Spheres must be held at the snapshot's
/// clock (Snapshot::up_to_date), because extrapolate() ignores accelerations.
void copy_frame(const Snapshot& s, std::uint64_t k, FrameBlock& block) {
    const std::size_t n = s.size();
    const auto row = [&](Quantity q) { return block.of_discs[q].data() + k * n; };
    extrapolate(n, s.clock, s.held_at.data(), s.x.data(), s.vx.data(), row(x));
    extrapolate(n, s.clock, s.held_at.data(), s.y.data(), s.vy.data(), row(y));
    extrapolate(n, s.clock, s.held_at.data(), s.angle.data(), s.spin.data(), row(phi));
    std::copy_n(s.vx.data(), n, row(vx));
    std::copy_n(s.vy.data(), n, row(vy));
    std::copy_n(s.spin.data(), n, row(omega_z));
    block.of_counters[periods][k] = s.periods;
    block.of_scalars[time][k] = s.time();
    block.of_scalars[clock][k] = s.clock;
    block.of_scalars[period_length][k] = s.period;
    block.of_scalars[period_start][k] = s.period_start();
    block.of_scalars[centre_x][k] = s.container_centre.x;
    block.of_scalars[centre_y][k] = s.container_centre.y;
    block.of_scalars[centre_vx][k] = s.container_velocity.x;
    block.of_scalars[centre_vy][k] = s.container_velocity.y;
    if (!s.are_spheres()) return;
    std::copy_n(s.spin_x.data(), n, row(omega_x));
    std::copy_n(s.spin_y.data(), n, row(omega_y));
    for (std::size_t i = 0; i < n; ++i) {
        const Quaternion q = s.turned.empty() ? Quaternion{} : s.turned[i];
        row(q_w)[i] = q.w;
        row(q_x)[i] = q.x;
        row(q_y)[i] = q.y;
        row(q_z)[i] = q.z;
    }
}

// --- the layout of the file ----------------------------------------------------------------------

// H5MD demands a step and a time for each series; here all series share those of the position.
void create_group_with_times(Hdf5File& file, const std::string& group) {
    file.create_group(group);
    h5md::link_times(file, particles + "/position", group);
}

void create_series(Hdf5File& file, int series, std::uint64_t discs, int compression) {
    const SeriesLayout& layout = layouts[series];
    const std::string group = group_of(series);
    if (series != position) create_group_with_times(file, group);
    Dimensions row{discs}, chunk{frames_per_chunk(discs), discs};
    std::vector<std::string> scales{group + "/time", particles + "/particle"};
    if (layout.scale) {
        row.push_back(layout.components);
        chunk.push_back(1);
        scales.push_back(particles + layout.scale);
    }
    file.create_column<double>(group + "/value", row, chunk, compression);
    file.attach_scales(group + "/value", scales);
}

void create_observable(Hdf5File& file, const std::string& path, bool is_counter, int compression) {
    const std::string group = path.substr(0, path.rfind('/'));
    create_group_with_times(file, group);
    const Dimensions chunk{max_frames_per_chunk};
    if (is_counter)
        file.create_column<std::int64_t>(path, {}, chunk, compression);
    else
        file.create_column<double>(path, {}, chunk, compression);
    file.attach_scales(path, {group + "/time"});
}

void create_frame_columns(Hdf5File& file, int compression, bool period_changes) {
    const Dimensions chunk{max_frames_per_chunk};
    file.create_group(particles + "/position");
    file.create_column<std::int64_t>(counter_paths[step], {}, chunk, compression);
    file.create_column<double>(scalar_paths[time], {}, chunk, compression);
    file.make_scale(scalar_paths[time], "time");
    file.attach_scales(counter_paths[step], {scalar_paths[time]});
    for (int c = step + 1; c < counters; ++c)
        create_observable(file, counter_paths[c], true, compression);
    for (int s = time + 1; s < scalar_count(period_changes); ++s)
        create_observable(file, scalar_paths[s], false, compression);
}

/// Writes 0, 1, … n − 1 as a dimension scale.
void write_scale(Hdf5File& file, const std::string& name, std::uint64_t n) {
    std::vector<std::int64_t> numbers(n);
    std::iota(numbers.begin(), numbers.end(), 0);
    file.write(particles + "/" + name, numbers, {n});
    file.make_scale(particles + "/" + name, name);
}

void write_constants(Hdf5File& file, const Snapshot& first) {
    const std::uint64_t n = first.size();
    write_scale(file, "particle", n);
    write_scale(file, "xyz", 3);
    if (first.are_spheres()) {
        write_scale(file, "xy", 2);
        write_scale(file, "wxyz", 4);
    }
    std::vector<std::int64_t> id(n);
    std::iota(id.begin(), id.end(), 0);
    file.write(particles + "/id", id, {n});
    file.write(particles + "/species", h5md::species_of(first.radius, first.mass), {n});
    file.write(particles + "/mass", first.mass, {n});
    file.write(particles + "/radius", first.radius, {n});
    file.write(particles + "/moment_of_inertia", first.inertia, {n});
    for (const char* name : {"/id", "/species", "/mass", "/radius", "/moment_of_inertia"})
        file.attach_scales(particles + name, {particles + "/particle"});
    if (first.can_spin.empty()) return;
    file.write(particles + "/can_spin", first.can_spin, {n});
    file.attach_scales(particles + "/can_spin", {particles + "/particle"});
}

void write_parameters(Hdf5File& file, const Snapshot& first, const Provenance& provenance) {
    h5md::create_parameters(file, provenance);
    file.set_attribute(parameters, "period", first.period);
    file.set_attribute(parameters, "container_radius", first.container_radius);
    if (first.are_spheres())
        file.set_attribute(parameters, "floor", std::vector<std::int64_t>{first.on_floor});
    if (first.lie_flat) file.set_attribute(parameters, "lie_flat", std::vector<std::int64_t>{1});
}

Hdf5File create_file(const std::filesystem::path& path, const Snapshot& first,
                     const Provenance& provenance, int compression, bool period_changes) {
    Hdf5File file(partial_name(path), JournaledFile::Mode::create);
    h5md::create_head(file, particles);
    write_constants(file, first);
    file.create_group(observables);
    create_frame_columns(file, compression, period_changes);
    for (int k = 0; k < series_count(first.are_spheres()); ++k)
        create_series(file, k, first.size(), compression);
    write_parameters(file, first, provenance);
    return file;
}

/// Appends frames to an unfinished recording.
class FrameFile {
  public:
    FrameFile(const std::filesystem::path& path, Hdf5File file)
        : path_(path),
          file_(std::move(file)),
          are_spheres_(file_.has(group_of(orientation) + "/value")),
          scalar_count_(scalar_count(file_.has(scalar_paths[period_length]))) {
        for (int k = 0; k < series_count(are_spheres_); ++k)
            series_columns_[k] = file_.column(group_of(k) + "/value");
        for (int c = 0; c < counters; ++c) counter_columns_[c] = file_.column(counter_paths[c]);
        for (int s = 0; s < scalar_count_; ++s) scalar_columns_[s] = file_.column(scalar_paths[s]);
        discs_ = series_columns_[angle].row_shape().at(0);
        file_.set_attribute(parameters, "complete", std::vector<std::int64_t>{0});
    }

    std::uint64_t discs() const { return discs_; }
    bool are_spheres() const { return are_spheres_; }

    /// Drops all frames but the first `frames`. Throws DamagedFile if there are fewer.
    void truncate(std::uint64_t frames) {
        const auto truncate_column = [&](Column& column) {
            require_recorded(path_, "frames", column.rows(), frames);
            if (column.rows() > frames) column.resize(frames);
        };
        for (int k = 0; k < series_count(are_spheres_); ++k) truncate_column(series_columns_[k]);
        for (Column& column : counter_columns_) truncate_column(column);
        for (int s = 0; s < scalar_count_; ++s) truncate_column(scalar_columns_[s]);
        frames_ = frames;
    }

    /// Appends those of the first `filled` frames of a block that are not in the file yet.
    void append(const FrameBlock& block, std::uint64_t filled) {
        const std::uint64_t end = block.first + filled;
        if (end <= frames_) return;
        const std::uint64_t skipped = frames_ - block.first, count = end - frames_;
        for (int q = 0; q < quantity_count(are_spheres_); ++q) {
            const auto [series, component] = locations[q];
            Column& column = series_columns_[series];
            if (column.rows() < end) column.resize(end);
            const bool is_vector = layouts[series].components > 1;
            column.write(frames_, count, block.of_discs[q].data() + skipped * discs_,
                         is_vector ? std::optional(component) : std::nullopt);
        }
        for (int c = 0; c < counters; ++c)
            counter_columns_[c].append(block.of_counters[c].data() + skipped, count);
        for (int s = 0; s < scalar_count_; ++s)
            scalar_columns_[s].append(block.of_scalars[s].data() + skipped, count);
        frames_ = end;
        is_changed_ = true;
    }

    void commit() {
        if (is_changed_) file_.flush();
        is_changed_ = false;
    }

    void finish() {
        file_.set_attribute(parameters, "complete", std::vector<std::int64_t>{1});
        series_columns_ = {};
        counter_columns_ = {};
        scalar_columns_ = {};
        file_.finish(path_);
    }

  private:
    std::filesystem::path path_;
    Hdf5File file_;  // declared before the columns, which refer to it
    bool are_spheres_;
    int scalar_count_;
    std::array<Column, all_series> series_columns_;
    std::array<Column, counters> counter_columns_;
    std::array<Column, scalars> scalar_columns_;
    std::uint64_t discs_ = 0;
    std::uint64_t frames_ = 0;  // frames in the file
    bool is_changed_ = true;    // changed since the last commit
};

}  // namespace

// --- two threads ---------------------------------------------------------------------------------

/// The caller's thread fills blocks with frames; a second thread writes them to the file.
class TrajectoryWriter::Pipeline {
  public:
    Pipeline(FrameFile file, std::optional<std::uint64_t> frames_to_keep) : file_(std::move(file)) {
        if (frames_to_keep) {
            frames_ = *frames_to_keep;
            file_.truncate(frames_);
        }
        for (int k = 0; k < max_queued_blocks + 1; ++k)
            idle_.push_back(std::make_unique<FrameBlock>(frames_per_block(), file_.discs(),
                                                         file_.are_spheres()));
        take_idle_block();
        thread_ = std::thread([this] { work(); });
    }
    ~Pipeline() { end_thread(); }
    Pipeline(const Pipeline&) = delete;
    Pipeline& operator=(const Pipeline&) = delete;

    void write(const Snapshot& s, std::uint64_t events_before) {
        if (failed_.load(std::memory_order_relaxed)) flush();  // throws
        FrameBlock& block = *filling_;
        const std::uint64_t k = block.filled.load(std::memory_order_relaxed);
        copy_frame(s, k, block);
        block.of_counters[step][k] = std::int64_t(frames_);
        block.of_counters[events][k] = std::int64_t(events_before);
        block.filled.store(k + 1, std::memory_order_release);
        ++frames_;
        if (k + 1 == frames_per_block()) submit_block();
    }

    std::uint64_t frames() const { return frames_; }

    void flush() {
        std::unique_lock lock(mutex_);
        flush_requested_ = true;
        to_thread_.notify_one();
        from_thread_.wait(lock, [&] { return !flush_requested_ || failure_; });
        if (failure_) std::rethrow_exception(failure_);
    }

    void finish() {
        flush();
        end_thread();
        file_.finish();
    }

  private:
    static constexpr int max_queued_blocks = 3;

    std::uint64_t frames_per_block() const { return frames_per_chunk(file_.discs()); }

    void submit_block() {
        std::unique_lock lock(mutex_);
        queue_.push_back(std::move(filling_));
        to_thread_.notify_one();
        from_thread_.wait(lock, [&] { return !idle_.empty() || failure_; });
        if (failure_) std::rethrow_exception(failure_);
        take_idle_block();
    }
    void take_idle_block() {
        filling_ = std::move(idle_.back());
        idle_.pop_back();
        filling_->filled = 0;
        filling_->first = frames_;
    }

    void end_thread() {
        if (!thread_.joinable()) return;
        {
            const std::lock_guard lock(mutex_);
            stop_ = true;
        }
        to_thread_.notify_one();
        thread_.join();
    }

    void work() {
        try {
            write_until_stopped();
        } catch (...) {
            const std::lock_guard lock(mutex_);
            failure_ = std::current_exception();
            failed_ = true;
        }
        from_thread_.notify_one();
    }

    void write_until_stopped() {
        auto last_flush = Clock::now();
        std::unique_lock lock(mutex_);
        while (true) {
            to_thread_.wait_until(lock, last_flush + flush_interval,
                                  [&] { return stop_ || !queue_.empty() || flush_requested_; });
            if (stop_) return;
            if (!queue_.empty()) write_queued_block(lock);
            const bool is_early = Clock::now() - last_flush < flush_interval;
            // An explicit flush includes the queue, so the queue is written first.
            const bool is_requested = flush_requested_ && queue_.empty();
            if (is_early && !is_requested) continue;
            flush_file(lock);
            last_flush = Clock::now();
            if (!is_requested) continue;
            flush_requested_ = false;
            from_thread_.notify_one();
        }
    }

    void write_queued_block(std::unique_lock<std::mutex>& lock) {
        const FrameBlock& block = *queue_.front();
        lock.unlock();
        file_.append(block, frames_per_block());
        lock.lock();
        idle_.push_back(std::move(queue_.front()));
        queue_.pop_front();
        from_thread_.notify_one();
    }

    /// Commits the file, with the frames of the block that is being filled if no block precedes it
    /// in the queue. Meanwhile that block stays alive: the caller's thread can only queue it.
    void flush_file(std::unique_lock<std::mutex>& lock) {
        const FrameBlock* const block = queue_.empty() ? filling_.get() : nullptr;
        const std::uint64_t filled = block ? block->filled.load(std::memory_order_acquire) : 0;
        lock.unlock();
        if (block) file_.append(*block, filled);
        file_.commit();
        lock.lock();
    }

    FrameFile file_;
    std::uint64_t frames_ = 0;
    std::unique_ptr<FrameBlock> filling_;

    std::mutex mutex_;  // guards everything below
    std::condition_variable to_thread_, from_thread_;
    std::deque<std::unique_ptr<FrameBlock>> queue_, idle_;
    bool flush_requested_ = false;
    bool stop_ = false;
    std::exception_ptr failure_;
    std::atomic<bool> failed_ = false;
    std::thread thread_;
};

TrajectoryWriter::TrajectoryWriter(std::unique_ptr<Pipeline> pipeline)
    : pipeline_(std::move(pipeline)) {}

TrajectoryWriter::TrajectoryWriter(const std::filesystem::path& path, const Snapshot& first,
                                   const Provenance& provenance, int compression,
                                   bool period_changes)
    : pipeline_(std::make_unique<Pipeline>(
          FrameFile(path, create_file(path, first, provenance, compression, period_changes)),
          std::nullopt)) {
    flush();
}

TrajectoryWriter TrajectoryWriter::resume(const std::filesystem::path& path, std::uint64_t frames,
                                          const std::string& run) {
    return TrajectoryWriter(std::make_unique<Pipeline>(
        FrameFile(path, reopen_recording(path, run, group_of(position) + "/value")), frames));
}

TrajectoryWriter::~TrajectoryWriter() = default;
TrajectoryWriter::TrajectoryWriter(TrajectoryWriter&&) noexcept = default;
TrajectoryWriter& TrajectoryWriter::operator=(TrajectoryWriter&&) noexcept = default;

void TrajectoryWriter::write(const Snapshot& snapshot, std::uint64_t events_before) {
    pipeline_->write(snapshot, events_before);
}
std::uint64_t TrajectoryWriter::frames() const { return pipeline_->frames(); }
void TrajectoryWriter::flush() { pipeline_->flush(); }
void TrajectoryWriter::finish() { pipeline_->finish(); }

}  // namespace swirl
