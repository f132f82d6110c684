#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <condition_variable>
#include <cstring>
#include <deque>
#include <exception>
#include <mutex>
#include <numeric>
#include <thread>

#include "swirl/io/file_error.hpp"
#include "swirl/io/h5md.hpp"
#include "swirl/io/recording.hpp"
#include "swirl/io/repeat_stream.hpp"
#include "swirl/io/trajectory.hpp"
#include "swirl/math/wide.hpp"

namespace swirl {
namespace {

using Clock = std::chrono::steady_clock;
using Words = std::vector<std::uint64_t>;

using h5md::observables;
using h5md::parameters;
using h5md::particles;

constexpr std::chrono::milliseconds flush_interval(500);

// A chunk is what is compressed, written and read in one piece. Small enough for six of them to
// stay near the processor, large enough for their number not to matter.
constexpr std::uint64_t chunk_bytes = 128 * 1024;
constexpr std::uint64_t max_frames_per_chunk = 1024;

std::uint64_t frames_per_chunk(std::uint64_t discs) {
    const std::uint64_t frame = std::max<std::uint64_t>(1, discs) * sizeof(double);
    return std::clamp<std::uint64_t>(chunk_bytes / frame, 1, max_frames_per_chunk);
}
/// Of the columns with one value for each frame; whole chunks of the others.
std::uint64_t moments_per_chunk(std::uint64_t discs) {
    const std::uint64_t frames = frames_per_chunk(discs);
    return max_frames_per_chunk / frames * frames;
}

/// The columns with one value for each disc and frame, and where they are in the file. Those from
/// spin_x on are of spheres.
enum Quantity {
    x,
    y,
    vx,
    vy,
    angle,
    spin,
    spin_x,
    spin_y,
    turned_w,
    turned_x,
    turned_y,
    turned_z,
    quantities
};
struct Place {
    const char* name;
    std::optional<std::uint64_t> component;
};
constexpr Place places[quantities] = {
    {"position", 0},    {"position", 1},          {"velocity", 0},     {"velocity", 1},
    {"angle", {}},      {"angular_velocity", {}}, {"rolling_spin", 0}, {"rolling_spin", 1},
    {"orientation", 0}, {"orientation", 1},       {"orientation", 2},  {"orientation", 3}};
/// In the dataset of the quantity before it.
constexpr bool shares_dataset(int quantity) { return places[quantity].component.value_or(0) > 0; }

/// The columns with one value for each frame.
enum Moment {
    step,
    time,
    periods,
    clock,
    events,
    centre_x,
    centre_y,
    centre_vx,
    centre_vy,
    moments
};
constexpr const char* moment_names[moments] = {"step",        "time",         "swirls",
                                               "clock",       "events",       "container_x",
                                               "container_y", "container_vx", "container_vy"};
constexpr bool is_whole(int moment) {
    return moment == step || moment == periods || moment == events;
}
std::string moment_place(int moment) {
    if (moment == step || moment == time) return particles + "/position/" + moment_names[moment];
    return observables + "/" + moment_names[moment] + "/value";
}

/// Frames on their way to the file, column by column. One thread fills it while the other may
/// already look at what it has been filled with.
struct FrameBlock {
    FrameBlock(std::uint64_t frames, std::uint64_t discs, int quantities_kept) {
        for (int q = 0; q < quantities_kept; ++q) of_discs[q].resize(frames * discs);
        for (Words& column : of_frames) column.resize(frames);
    }
    std::array<std::vector<double>, quantities> of_discs;
    std::array<Words, moments> of_frames;
    std::uint64_t first = 0;  // number of its first frame
    std::atomic<std::uint64_t> filled = 0;
};

std::uint64_t bits_of(double value) {
    std::uint64_t bits;
    std::memcpy(&bits, &value, sizeof bits);
    return bits;
}

/// Where the discs are at the snapshot's clock: Snapshot::position() and orientation().
SWIRL_WIDE void bring_forward(std::size_t n, double now, const double* __restrict held_at,
                              const double* __restrict from, const double* __restrict rate,
                              double* __restrict to) {
    for (std::size_t i = 0; i < n; ++i) to[i] = from[i] + (now - held_at[i]) * rate[i];
}

// --- the layout ----------------------------------------------------------------------------------

struct Compression {
    Packing packing;
    int level;
    explicit Compression(int c)
        : packing(c == 0  ? Packing::none
                  : c > 0 ? Packing::deflate
                          : Packing::stream),
          level(std::max(c, 1)) {}
};

// Every time series has its own step and time in H5MD; here they are all the same two.
void link_times(Hdf5File& file, const std::string& group) {
    h5md::link_times(file, particles + "/position", group);
}

void create_series(Hdf5File& file, const std::string& name, const Dimensions& row,
                   const Compression& c) {
    const std::string group = particles + "/" + name;
    const bool owns_times = name == "position";
    if (!owns_times) {
        file.create_group(group);
        link_times(file, group);
    }
    Dimensions chunk{frames_per_chunk(row[0]), row[0]};
    if (row.size() > 1) chunk.push_back(1);
    file.create_column<double>(group + "/value", row, chunk, c.packing, c.level);
    std::vector<std::string> scales{group + "/time", particles + "/particle"};
    if (row.size() > 1)
        scales.push_back(particles + (row[1] == 3 ? "/xyz" : row[1] == 2 ? "/xy" : "/wxyz"));
    file.attach_scales(group + "/value", scales);
}

void create_moments(Hdf5File& file, std::uint64_t discs, const Compression& c) {
    for (int m = 0; m < moments; ++m) {
        const std::string place = moment_place(m), group = place.substr(0, place.rfind('/'));
        if (m == step) file.create_group(group);
        if (m > time) {
            file.create_group(group);
            link_times(file, group);
        }
        const Dimensions chunk{moments_per_chunk(discs)};
        if (is_whole(m))
            file.create_column<std::int64_t>(place, {}, chunk, c.packing, c.level);
        else
            file.create_column<double>(place, {}, chunk, c.packing, c.level);
        if (m == time) file.make_scale(place, "time");
        if (m != time && m != step) file.attach_scales(place, {group + "/time"});
    }
    file.attach_scales(moment_place(step), {moment_place(time)});
}

void create_fixed(Hdf5File& file, const Snapshot& first) {
    const std::uint64_t n = first.size();
    std::vector<std::int64_t> id(n);
    std::iota(id.begin(), id.end(), 0);
    file.write(particles + "/particle", id, {n});
    file.make_scale(particles + "/particle", "particle");
    file.write(particles + "/xyz", std::vector<std::int64_t>{0, 1, 2}, {3});
    file.make_scale(particles + "/xyz", "xyz");
    if (first.are_spheres()) {
        file.write(particles + "/xy", std::vector<std::int64_t>{0, 1}, {2});
        file.make_scale(particles + "/xy", "xy");
        file.write(particles + "/wxyz", std::vector<std::int64_t>{0, 1, 2, 3}, {4});
        file.make_scale(particles + "/wxyz", "wxyz");
    }
    file.write(particles + "/id", id, {n});
    file.write(particles + "/species", h5md::species_of(first.radius, first.mass), {n});
    file.write(particles + "/mass", first.mass, {n});
    file.write(particles + "/radius", first.radius, {n});
    file.write(particles + "/moment_of_inertia", first.inertia, {n});
    for (const char* name : {"/id", "/species", "/mass", "/radius", "/moment_of_inertia"})
        file.attach_scales(particles + name, {particles + "/particle"});
}

void create_layout(Hdf5File& file, const Snapshot& first, const Compression& compression) {
    h5md::create_head(file, particles);
    create_fixed(file, first);
    file.create_group(observables);
    const std::uint64_t n = first.size();
    create_moments(file, n, compression);
    create_series(file, "position", {n, 3}, compression);
    create_series(file, "velocity", {n, 3}, compression);
    create_series(file, "angle", {n}, compression);
    create_series(file, "angular_velocity", {n}, compression);
    if (!first.are_spheres()) return;
    create_series(file, "rolling_spin", {n, 2}, compression);
    create_series(file, "orientation", {n, 4}, compression);
}

void create_parameters(Hdf5File& file, const Snapshot& first, const Provenance& provenance) {
    h5md::create_parameters(file, provenance);
    file.set_attribute(parameters, "period", first.period);
    file.set_attribute(parameters, "container_radius", first.container_radius);
    if (first.are_spheres())
        file.set_attribute(parameters, "floor", std::vector<std::int64_t>{first.on_floor});
    if (first.lie_flat) file.set_attribute(parameters, "lie_flat", std::vector<std::int64_t>{1});
}

// --- the file's side -----------------------------------------------------------------------------

/// Puts blocks into the file. A chunk that is not full yet is put there with zeros behind, and put
/// again when there is more.
class FrameFile {
  public:
    FrameFile(const std::filesystem::path& path, Hdf5File file)
        : path_(path), file_(std::move(file)) {
        kept_ = file_.has(particles + "/orientation/value") ? quantities : spin_x;
        for (int q = 0; q < kept_; ++q)
            of_discs_[q] = shares_dataset(q) ? of_discs_[q - 1]
                                             : std::make_shared<Column>(file_.column(
                                                   particles + "/" + places[q].name + "/value"));
        for (int m = 0; m < moments; ++m) of_frames_[m] = file_.column(moment_place(m));
        discs_ = of_discs_[angle]->row_shape().at(0);
        frames_per_chunk_ = frames_per_chunk(discs_);
        moments_per_chunk_ = moments_per_chunk(discs_);
        chunk_.resize(frames_per_chunk_ * discs_);
        for (Words& column : latest_) column.resize(moments_per_chunk_);
        const Dimensions chunk{frames_per_chunk_, discs_};
        if (of_discs_[angle]->chunk_shape() != chunk ||
            of_frames_[step].chunk_shape() != Dimensions{moments_per_chunk_})
            throw FileError(fmt::format(
                "'{}' was begun by another version of swirl; only that one can carry on with it.",
                path_.string()));
        file_.set_attribute(parameters, "complete", std::vector<std::int64_t>{0});
    }

    std::uint64_t discs() const { return discs_; }
    bool are_spheres() const { return kept_ == quantities; }
    int quantities_kept() const { return kept_; }
    std::uint64_t frames_per_block() const { return frames_per_chunk_; }

    /// Forgets all frames but the first `frames`; gives back those of the chunk that is begun.
    void cut(std::uint64_t frames, FrameBlock& block) {
        const auto cut_column = [&](Column& column) {
            if (column.rows() < frames)
                throw FileError(fmt::format(
                    "'{}' holds {} frames, but the checkpoint was made when it held {}; it does "
                    "not belong to the checkpoint, or has been changed since.",
                    path_.string(), column.rows(), frames));
            if (column.rows() > frames) column.resize(frames);
        };
        for (int q = 0; q < kept_; ++q)
            if (!shares_dataset(q)) cut_column(*of_discs_[q]);
        for (Column& column : of_frames_) cut_column(column);

        block.first = frames / frames_per_chunk_ * frames_per_chunk_;
        const std::uint64_t rest = frames - block.first;
        block.filled = rest;
        if (rest > 0)
            for (int q = 0; q < kept_; ++q) {
                const auto rows = of_discs_[q]->read<double>(block.first, rest);
                const std::size_t stride = rows.size() / (rest * discs_);
                for (std::size_t k = 0; k < rest * discs_; ++k)
                    block.of_discs[q][k] = rows[k * stride + places[q].component.value_or(0)];
            }
        latest_first_ = frames / moments_per_chunk_ * moments_per_chunk_;
        latest_end_ = frames;
        for (int m = 0; m < moments; ++m) {
            const auto words = words_of(m, latest_first_, frames - latest_first_);
            std::copy(words.begin(), words.end(), latest_[m].begin());
            std::copy(words.end() - std::ptrdiff_t(rest), words.end(), block.of_frames[m].begin());
        }
        put_ = frames;
    }

    /// The first `frames` frames of a block, those that were put before among them.
    void put(const FrameBlock& block, std::uint64_t frames) {
        if (block.first + frames <= put_) return;
        changed_ = true;
        put_ = block.first + frames;
        for (int q = 0; q < kept_; ++q) {
            if (of_discs_[q]->rows() < put_) of_discs_[q]->resize(put_);
            put_column(*of_discs_[q], block.of_discs[q].data(), block.first, frames, discs_,
                       places[q].component);
        }
        for (std::uint64_t k = std::max(latest_end_, block.first); k < put_; ++k) {
            if (k - latest_first_ == moments_per_chunk_) put_moments();
            for (int m = 0; m < moments; ++m)
                latest_[m][k - latest_first_] = block.of_frames[m][k - block.first];
            latest_end_ = k + 1;
        }
    }

    void commit() {
        if (!changed_) return;
        put_moments();
        file_.flush();
        changed_ = false;
    }

    void finish() {
        put_moments();
        file_.set_attribute(parameters, "complete", std::vector<std::int64_t>{1});
        of_discs_ = {};
        of_frames_ = {};
        file_.finish(path_);
    }

  private:
    Words words_of(int m, std::uint64_t first, std::uint64_t count) {
        Words words(count);
        if (is_whole(m)) {
            const auto values = of_frames_[m].read<std::int64_t>(first, count);
            if (count > 0) std::memcpy(words.data(), values.data(), count * sizeof words[0]);
        } else {
            const auto values = of_frames_[m].read<double>(first, count);
            if (count > 0) std::memcpy(words.data(), values.data(), count * sizeof words[0]);
        }
        return words;
    }

    /// What has come since the last chunk of the columns that have one value for each frame.
    void put_moments() {
        const std::uint64_t count = latest_end_ - latest_first_;
        for (int m = 0; m < moments; ++m) {
            if (of_frames_[m].rows() < latest_end_) of_frames_[m].resize(latest_end_);
            if (count == 0) continue;
            if (is_whole(m))
                put_column(of_frames_[m], reinterpret_cast<const std::int64_t*>(latest_[m].data()),
                           latest_first_, count, 1, {});
            else
                put_column(of_frames_[m], reinterpret_cast<const double*>(latest_[m].data()),
                           latest_first_, count, 1, {});
        }
        if (count == moments_per_chunk_) latest_first_ = latest_end_;
    }

    template <class T>
    void put_column(Column& column, const T* values, std::uint64_t first, std::uint64_t rows,
                    std::uint64_t row, std::optional<std::uint64_t> component) {
        if (column.packing() == Packing::deflate)
            return column.change(first, rows, values, component);
        const std::uint64_t whole = column.chunk_shape()[0] * row, there = rows * row;
        const void* bytes = values;
        if (there < whole) {
            chunk_.resize(std::max<std::size_t>(chunk_.size(), whole));
            std::memcpy(chunk_.data(), values, there * sizeof(T));
            std::fill(chunk_.begin() + std::ptrdiff_t(there),
                      chunk_.begin() + std::ptrdiff_t(whole), 0);
            bytes = chunk_.data();
        }
        std::size_t size = 0;
        if (column.packing() == Packing::stream)
            size =
                make_repeat_stream({static_cast<const std::uint64_t*>(bytes), whole}, row, stream_);
        if (size > 0) return column.put_chunk(first, stream_.data(), size, false, component);
        column.put_chunk(first, bytes, whole * sizeof(T), true, component);
    }

    std::filesystem::path path_;
    Hdf5File file_;  // before the columns, which refer to it
    std::array<std::shared_ptr<Column>, quantities> of_discs_;
    int kept_ = spin_x;  // of the quantities: those of discs, or all
    std::array<Column, moments> of_frames_;
    std::uint64_t discs_ = 0, frames_per_chunk_ = 1, moments_per_chunk_ = 1;
    std::uint64_t put_ = 0;                            // frames that are in the file
    bool changed_ = true;                              // since the last commit
    std::array<Words, moments> latest_;                // a chunk of each
    std::uint64_t latest_first_ = 0, latest_end_ = 0;  // numbers of the frames in there
    Words chunk_;
    std::vector<unsigned char> stream_;
};

}  // namespace

// --- two threads ---------------------------------------------------------------------------------

class TrajectoryWriter::Work {
  public:
    Work(FrameFile file, std::optional<std::uint64_t> frames_there) : file_(std::move(file)) {
        for (int k = 0; k < blocks_on_their_way + 1; ++k)
            idle_.push_back(std::make_unique<FrameBlock>(file_.frames_per_block(), file_.discs(),
                                                         file_.quantities_kept()));
        take_idle_block();
        if (frames_there) {
            frames_ = *frames_there;
            file_.cut(frames_, *filling_);
        }
        thread_ = std::thread([this] { work(); });
    }
    ~Work() { end_thread(); }
    Work(const Work&) = delete;
    Work& operator=(const Work&) = delete;

    void write(const Snapshot& s, std::uint64_t events_before) {
        if (failed_.load(std::memory_order_relaxed)) flush();  // throws
        FrameBlock& b = *filling_;
        const std::uint64_t k = b.filled.load(std::memory_order_relaxed), n = file_.discs();
        const auto at = [&](Quantity q) { return b.of_discs[q].data() + k * n; };
        bring_forward(n, s.clock, s.held_at.data(), s.x.data(), s.vx.data(), at(x));
        bring_forward(n, s.clock, s.held_at.data(), s.y.data(), s.vy.data(), at(y));
        bring_forward(n, s.clock, s.held_at.data(), s.angle.data(), s.spin.data(), at(angle));
        std::copy_n(s.vx.data(), n, at(vx));
        std::copy_n(s.vy.data(), n, at(vy));
        std::copy_n(s.spin.data(), n, at(spin));
        if (file_.are_spheres()) {
            // Of a snapshot whose spheres are held now: nobody is accelerated.
            std::copy_n(s.spin_x.data(), n, at(spin_x));
            std::copy_n(s.spin_y.data(), n, at(spin_y));
            for (std::size_t i = 0; i < n; ++i) {
                const Quaternion q = s.turned.empty() ? Quaternion{} : s.turned[i];
                at(turned_w)[i] = q.w;
                at(turned_x)[i] = q.x;
                at(turned_y)[i] = q.y;
                at(turned_z)[i] = q.z;
            }
        }
        b.of_frames[step][k] = frames_;
        b.of_frames[time][k] = bits_of(s.time());
        b.of_frames[periods][k] = static_cast<std::uint64_t>(s.periods);
        b.of_frames[clock][k] = bits_of(s.clock);
        b.of_frames[events][k] = events_before;
        b.of_frames[centre_x][k] = bits_of(s.container_centre.x);
        b.of_frames[centre_y][k] = bits_of(s.container_centre.y);
        b.of_frames[centre_vx][k] = bits_of(s.container_velocity.x);
        b.of_frames[centre_vy][k] = bits_of(s.container_velocity.y);
        b.filled.store(k + 1, std::memory_order_release);
        ++frames_;
        if (k + 1 == file_.frames_per_block()) hand_over();
    }

    std::uint64_t frames() const { return frames_; }

    void flush() {
        std::unique_lock lock(mutex_);
        flush_wanted_ = true;
        to_thread_.notify_one();
        from_thread_.wait(lock, [&] { return !flush_wanted_ || failure_; });
        if (failure_) std::rethrow_exception(failure_);
    }

    void finish() {
        flush();
        end_thread();
        file_.finish();
    }

  private:
    static constexpr int blocks_on_their_way = 3;

    void hand_over() {
        std::unique_lock lock(mutex_);
        waiting_.push_back(std::move(filling_));
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
                                  [&] { return stop_ || !waiting_.empty() || flush_wanted_; });
            if (stop_) return;
            if (!waiting_.empty()) {
                const FrameBlock& block = *waiting_.front();
                lock.unlock();
                file_.put(block, file_.frames_per_block());
                lock.lock();
                idle_.push_back(std::move(waiting_.front()));
                waiting_.pop_front();
                from_thread_.notify_one();
            }
            const bool in_time = Clock::now() - last_flush < flush_interval;
            if (!waiting_.empty() ? in_time : in_time && !flush_wanted_) continue;
            // The block being filled stays where it is, or goes to the end of those that wait.
            const FrameBlock* const block = waiting_.empty() ? filling_.get() : nullptr;
            const std::uint64_t filled = block ? block->filled.load(std::memory_order_acquire) : 0;
            const bool wanted = waiting_.empty() && flush_wanted_;
            lock.unlock();
            if (block) file_.put(*block, filled);
            file_.commit();
            last_flush = Clock::now();
            lock.lock();
            if (!wanted) continue;
            flush_wanted_ = false;
            from_thread_.notify_one();
        }
    }

    FrameFile file_;
    std::uint64_t frames_ = 0;
    std::unique_ptr<FrameBlock> filling_;

    std::mutex mutex_;  // for all that follows
    std::condition_variable to_thread_, from_thread_;
    std::deque<std::unique_ptr<FrameBlock>> waiting_, idle_;
    bool flush_wanted_ = false;
    bool stop_ = false;
    std::exception_ptr failure_;
    std::atomic<bool> failed_ = false;
    std::thread thread_;
};

namespace {

FrameFile new_file(const std::filesystem::path& path, const Snapshot& first,
                   const Provenance& provenance, int compression) {
    Hdf5File file(partial_name(path), JournaledFile::Mode::create);
    create_layout(file, first, Compression(compression));
    create_parameters(file, first, provenance);
    return {path, std::move(file)};
}

}  // namespace

TrajectoryWriter::TrajectoryWriter(std::unique_ptr<Work> work) : work_(std::move(work)) {}

TrajectoryWriter::TrajectoryWriter(const std::filesystem::path& path, const Snapshot& first,
                                   const Provenance& provenance, int compression)
    : work_(std::make_unique<Work>(new_file(path, first, provenance, compression), std::nullopt)) {
    flush();
}

TrajectoryWriter TrajectoryWriter::resume(const std::filesystem::path& path, std::uint64_t frames,
                                          const std::string& run) {
    return TrajectoryWriter(
        std::make_unique<Work>(FrameFile(path, reopen_recording(path, run)), frames));
}

TrajectoryWriter::~TrajectoryWriter() = default;
TrajectoryWriter::TrajectoryWriter(TrajectoryWriter&&) noexcept = default;
TrajectoryWriter& TrajectoryWriter::operator=(TrajectoryWriter&&) noexcept = default;

void TrajectoryWriter::write(const Snapshot& snapshot, std::uint64_t events_before) {
    work_->write(snapshot, events_before);
}
std::uint64_t TrajectoryWriter::frames() const { return work_->frames(); }
void TrajectoryWriter::flush() { work_->flush(); }
void TrajectoryWriter::finish() { work_->finish(); }

}  // namespace swirl
