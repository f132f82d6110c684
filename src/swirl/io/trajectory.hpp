// Recorded frames: an HDF5 file that is valid H5MD 1.1 (de Buyl, Colberg, Höfling 2014,
// doi:10.1016/j.cpc.2014.01.018; nongnu.org/h5md), loads in MDAnalysis, and opens in xarray and
// h5py as netCDF-4. T is the number of frames and N the number of discs.
//
//   /h5md                                  version {1,1}; author, creator
//   /particles/trajectory/box              dimension 3, boundary "none": there is no box
//   /particles/trajectory/position         step i64[T], time f64[T], value f64[T][N][3], z = 0
//   /particles/trajectory/velocity         value f64[T][N][3]; step and time link to the position's
//   /particles/trajectory/angle            value f64[T][N], rad, not reduced modulo 2π
//   /particles/trajectory/angular_velocity value f64[T][N]
//   For spheres and coins in addition:
//   /particles/trajectory/rolling_spin     value f64[T][N][2], (ω_x, ω_y); angular_velocity is ω_z
//   /particles/trajectory/orientation      value f64[T][N][4], the unit quaternion w, x, y, z that
//                                          takes the sphere's axes to the lab's; first 1, 0, 0, 0
//   /particles/trajectory/mass, radius, moment_of_inertia f64[N]; species, id i64[N]
//   /observables/NAME                      step, time, value f64[T] (or i64[T]):
//       swirls (i64), clock                time = swirls·period + clock, but never rounded
//       events (i64)                       events executed before the frame
//       container_x, container_y, container_vx, container_vy
//   If the period changes during the run, in addition (the attribute `period` is then the first):
//       period, period_start               time = period_start + clock
//   /parameters                            attributes: format (1), period, container_radius,
//                                          complete (0 or 1); for spheres and coins floor (0 or 1);
//                                          for coins lie_flat (1); one text dataset for each entry
//                                          of the provenance
//
// Units: length = disc radius, mass = disc mass, speed of the container = 1. `step` is the number
// of the frame. All columns are float64 or int64, and compression is lossless. x, y and z are in
// separate chunks. The chunks of z are never written, since HDF5 reads zeros for missing chunks.
//
// While the file is being written its name is NAME.partial. It gets its final name when it is
// complete. Frames that are older than one second survive a kill or a power cut: NAME.partial is
// then a valid file with complete = 0, and --resume continues it.
//
// The writer compresses and writes on a thread of its own. write() only copies the frame; it waits
// if three blocks of frames are queued. An error on that thread is thrown by the next call.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "swirl/io/hdf5.hpp"
#include "swirl/physics/snapshot.hpp"

namespace swirl {

/// Where a file comes from: ordered pairs of a name and a text ("version", "command", "seed" …).
using Provenance = std::vector<std::pair<std::string, std::string>>;

/// 0: none, 1 (fastest) … 9 (smallest): byte shuffle and deflate. Level 1 saves a fifth of the file
/// at 30 frames per period, but takes several times as long as the run itself.
inline constexpr int default_compression = 0;

class TrajectoryWriter {
  public:
    /// `first` gives the constants: number of discs, radii, masses, period, container.
    TrajectoryWriter(const std::filesystem::path& path, const Snapshot& first,
                     const Provenance& provenance, int compression = default_compression,
                     bool period_changes = false);
    /// Continues an unfinished file after its first `frames` frames and drops the others. Throws
    /// FileError if it has fewer frames, or belongs to another run (recording.hpp).
    static TrajectoryWriter resume(const std::filesystem::path& path, std::uint64_t frames,
                                   const std::string& run = "");

    /// Leaves an unfinished file with the frames that have been flushed.
    ~TrajectoryWriter();
    TrajectoryWriter(TrajectoryWriter&&) noexcept;
    TrajectoryWriter& operator=(TrajectoryWriter&&) noexcept;

    /// Appends a frame. `events_before` counts the events executed before it.
    void write(const Snapshot& snapshot, std::uint64_t events_before);
    std::uint64_t frames() const;
    /// After this call all frames written so far survive a kill and a power cut.
    void flush();
    /// Completes the file and publishes it under its final name.
    void finish();

  private:
    class Pipeline;
    explicit TrajectoryWriter(std::unique_ptr<Pipeline> pipeline);
    std::unique_ptr<Pipeline> pipeline_;
};

/// Random access to the frames of a trajectory. A recording that is being written can be read, too:
/// the reader has the frames that it had when it was opened, and opens it again when it has
/// changed.
class TrajectoryReader {
  public:
    /// Opens a finished or unfinished file. This constructor and frame() throw FileError, also for
    /// values that no run can have (range_checks.hpp).
    explicit TrajectoryReader(const std::filesystem::path& path);

    std::uint64_t frames() const { return frames_; }
    std::size_t discs() const { return constants_.size(); }
    bool complete() const { return complete_; }
    const std::string& path() const { return path_; }
    Snapshot frame(std::uint64_t k);
    std::uint64_t events_before(std::uint64_t k) const;
    /// Some datasets serve other programs only: id, particle, species, the numbers of the
    /// components, step and time of each series, z of positions and velocities. Returns the name of
    /// one that contradicts the rest of the file, or "" if there is none.
    std::string inconsistent_dataset();
    /// Reads all data that this class can read, to check that they are readable.
    void read_all();
    /// Half the width of a square about the origin that contains the container in all frames.
    double reach() const;
    /// "" if there is no entry of this name.
    std::string provenance(const std::string& name);
    std::vector<std::string> provenance_names();

  private:
    void open();
    void reopen();
    template <class Read>
    auto reread(Read&& read);
    void open_columns();
    void require_ascending_times() const;
    void read_constants();
    void load_block_of(std::uint64_t k);
    std::string inconsistent_index_or_time() const;
    std::string inconsistent_time_of(const std::string& group) const;

    std::string path_, run_;
    std::unique_ptr<Hdf5File> file_;
    bool are_spheres_ = false, complete_ = false, period_changes_ = false;
    std::vector<Column> series_;                       // index: trajectory_layout::Series
    std::vector<std::vector<std::int64_t>> counters_;  // index: trajectory_layout::Counter
    std::vector<std::vector<double>> scalars_;         // index: trajectory_layout::Scalar
    Snapshot constants_;
    std::uint64_t frames_ = 0, frames_per_block_ = 1;
    // The frames of one block, as they are in the file: a vector for each series.
    std::uint64_t block_begin_ = 0, block_end_ = 0;
    std::vector<std::vector<double>> block_;
};

}  // namespace swirl
