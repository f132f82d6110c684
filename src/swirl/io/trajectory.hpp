// Recorded frames: an HDF5 file that is valid H5MD 1.1 (de Buyl, Colberg, Höfling 2014,
// doi:10.1016/j.cpc.2014.01.018; nongnu.org/h5md), loads in MDAnalysis, and opens in xarray and
// h5py as netCDF-4.
//
//   /h5md                                version {1,1}; author, creator
//   /particles/trajectory/box            dimension 3, boundary "none"; there is no box
//   /particles/trajectory/position       step i64[T], time f64[T], value f64[T][N][3], z = 0
//   /particles/trajectory/velocity         the same; step and time are links to position's
//   /particles/trajectory/angle            value f64[T][N], rad, not reduced
//   /particles/trajectory/angular_velocity value f64[T][N]
//   Of spheres besides:
//   /particles/trajectory/rolling_spin     value f64[T][N][2], (ω_x, ω_y); angular_velocity is ω_z
//   /particles/trajectory/orientation      value f64[T][N][4], the unit quaternion w, x, y, z that
//                                        takes the sphere's axes to the lab's; 1, 0, 0, 0 at first
//   /particles/trajectory/mass, radius, moment_of_inertia f64[N]; species, id i64[N]
//   /observables/NAME                    step, time, value f64[T] (or i64), the same T:
//       swirls (i64), clock              time = swirls·T + clock, but exact for ever
//       events (i64)                     events executed before the frame
//       container_x, container_y, container_vx, container_vy
//   /parameters                          attributes: format (1), period, container_radius,
//                                        complete (0 or 1);
//                                        of spheres and coins floor (0 or 1); of coins
//                                        lie_flat (1);
//                                        texts: one dataset for each entry of the provenance
//
// Units: length = disc radius, mass = disc mass, speed of the container = 1. All columns float64,
// compressed without loss. `step` is the number of the frame. x, y and z lie in chunks of their
// own, and those of z are not there at all: HDF5 gives zeros for them.
//
// While it is being written the file is called NAME.partial; it gets its name when it is complete.
// What was written more than a second ago survives a kill or a power cut: NAME.partial is then a
// valid file with complete = 0, and --resume carries on with it.
//
// A thread of the writer's own compresses and writes; who calls write() only copies a frame, and
// waits only when three chunks of frames are on their way already. What goes wrong on that thread
// is thrown by the next call.
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

/// Who made a file, from what: name and text, in order ("version", "command", "config", "seed" …).
using Provenance = std::vector<std::pair<std::string, std::string>>;

/// 0: none. 1…9: deflate, 1 the quickest. Quick: what repeats from one frame to the next is left
/// out, and the rest stays as it is (repeat_stream.hpp); deflate to those who read it, as quick as
/// none to who writes it.
inline constexpr int quick_compression = -1;
inline constexpr int default_compression = quick_compression;

class TrajectoryWriter {
  public:
    /// `first` gives what does not change: number, radii, masses, period, container.
    TrajectoryWriter(const std::filesystem::path& path, const Snapshot& first,
                     const Provenance& provenance, int compression = default_compression);
    /// Carries on with an unfinished file, of which the first `frames` frames count. Throws
    /// FileError if it holds fewer, or belongs to another run (recording.hpp).
    static TrajectoryWriter resume(const std::filesystem::path& path, std::uint64_t frames,
                                   const std::string& run = "");

    /// Unfinished: what was flushed stays.
    ~TrajectoryWriter();
    TrajectoryWriter(TrajectoryWriter&&) noexcept;
    TrajectoryWriter& operator=(TrajectoryWriter&&) noexcept;

    /// Adds a frame; `events`: how many had been executed.
    void write(const Snapshot& snapshot, std::uint64_t events);
    std::uint64_t frames() const;
    /// Everything written so far survives a kill and a power cut.
    void flush();
    /// Completes the file and gives it its name.
    void finish();

  private:
    class Work;
    explicit TrajectoryWriter(std::unique_ptr<Work> work);
    std::unique_ptr<Work> work_;
};

/// Frames that can be asked for by number: recorded by us, or by a camera.
class TrajectoryReader {
  public:
    /// Reads finished and unfinished files. Throws FileError, also in frame() for what no dish can
    /// be (range_checks.hpp).
    explicit TrajectoryReader(const std::filesystem::path& path);

    std::uint64_t frames() const { return frames_; }
    std::size_t discs() const { return fixed_.size(); }
    bool complete() const { return complete_; }
    Snapshot frame(std::uint64_t k);
    std::uint64_t events_before(std::uint64_t k) const;
    /// The name of a column that is there for other programs alone (id, particle, species, the
    /// components' numbers, step and time of each series, z of positions and velocities) and is not
    /// what follows from the others; "" if there is none.
    std::string contradicted();
    /// Everything that is ever read of it, for whoever asks whether that is possible at all.
    void read_all();
    /// Half the width of a square about the swirl centre that holds the container at all times.
    double reach() const;
    /// "" where there is none.
    std::string provenance(const std::string& name) const;
    std::vector<std::string> provenance_names() const;

  private:
    void load_block_of(std::uint64_t k);
    std::string contradicted_by_names_or_times() const;
    /// Whatever has a step and a time of its own.
    std::vector<std::string> series_names() const;

    std::string path_;
    std::unique_ptr<Hdf5File> file_;
    Column position_, velocity_, angle_, angular_velocity_, rolling_spin_, orientation_;
    Column step_, time_;
    bool are_spheres_ = false;
    std::vector<std::int64_t> periods_, events_;
    std::vector<double> clock_, container_x_, container_y_, container_vx_, container_vy_;
    Snapshot fixed_;
    std::uint64_t frames_ = 0, block_ = 0, block_begin_ = 0, block_end_ = 0;
    bool complete_ = false;
    struct {
        std::vector<double> position, velocity, angle, angular_velocity, rolling_spin, orientation;
    } loaded_;
};

}  // namespace swirl
