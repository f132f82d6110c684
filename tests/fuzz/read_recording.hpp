// Small recordings of each kind, and functions that read everything the program ever reads of one.
#pragma once

#include <hdf5.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "fuzzed_file.hpp"
#include "swirl/io/event_log.hpp"
#include "swirl/io/file_error.hpp"
#include "swirl/io/track_recording.hpp"
#include "swirl/io/trajectory.hpp"

namespace swirl {

inline std::vector<unsigned char> bytes_and_remove(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    std::vector<unsigned char> bytes{std::istreambuf_iterator<char>(file), {}};
    std::filesystem::remove(path);
    return bytes;
}

inline Snapshot small_snapshot(bool spheres, std::uint64_t k) {
    Snapshot s;
    spheres ? s.resize_for_spheres(3) : s.resize(3);
    if (spheres) s.turned.assign(3, {1.0, 0.0, 0.0, 0.0});
    s.period = 10.0;
    s.container_radius = 8.0;
    s.periods = std::int64_t(k / 4);
    s.clock = 2.5 * double(k % 4);
    for (std::size_t i = 0; i < 3; ++i)
        s.set(i,
              {{3.0 * double(i), 0.1 * double(k)}, {1.0, -1.0}, 0.5, 0.1, s.clock, 1.0, 1.0, 0.5});
    return s;
}

/// A trajectory and an event log of discs, the same of spheres, and tracks.
inline std::vector<std::vector<unsigned char>> good_recordings() {
    const auto path = std::filesystem::temp_directory_path() /
                      ("swirl_recording_fuzz_" + std::to_string(getpid()) + ".h5");
    const Provenance provenance{{"version", "1"}, {"parameters", "{}"}, {"run", "a"}};
    std::vector<std::vector<unsigned char>> all;
    for (const bool spheres : {false, true}) {
        TrajectoryWriter frames(path, small_snapshot(spheres, 0), provenance);
        for (std::uint64_t k = 0; k < 6; ++k) frames.write(small_snapshot(spheres, k), 2 * k);
        frames.finish();
        all.push_back(bytes_and_remove(path));
        MovingFloor floor;
        if (spheres) floor = {{.deceleration = 2.0}, {{1.0, 0.0}, {0.0, 1.0}}};
        EventLogWriter events(path, small_snapshot(spheres, 0), 10.0, provenance, 1, floor);
        for (std::uint32_t k = 0; k < 6; ++k)
            events.write({0,
                          0.5 * k,
                          k == 5 ? EventKind::path_vertex : EventKind(k % 2),
                          k % 3,
                          (k + 1) % 3,
                          {1.0, 0.0},
                          {0.1, 0.05, true, 0.0},
                          0.0});
        events.finish();
        all.push_back(bytes_and_remove(path));
    }
    Tracks tracks;
    for (int k = 0; k < 3; ++k) {
        TrackFrame f;
        f.number = k;
        f.id = {0, 2};
        f.position = {{1.0, 2.0}, {3.0, 4.0 + k}};
        tracks.frames.push_back(f);
    }
    const std::vector<std::vector<double>> row(3, {1.0, 1.0});
    write_track_recording(path, tracks, {0.0, 0.1, 0.2}, {{"radius", row}, {"spin", row}},
                          provenance);
    all.push_back(bytes_and_remove(path));
    return all;
}

/// Options that reduce the bookkeeping of the address sanitizer, which takes a quarter of the time.
#define SWIRL_CHEAPER_ALLOCATIONS \
    "malloc_context_size=2:quarantine_size_mb=8:thread_local_quarantine_size_kb=64"

/// Makes the HDF5 library keep its tables of half a megabyte. By default it allocates them again
/// for each file, which takes a third of the time.
inline bool keep_tables_of_library() {
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    return H5set_free_list_limits(-1, -1, -1, -1, -1, -1) >= 0;
}

enum class RecordingKind { trajectory, event_log, tracks };

/// The kinds of good_recordings(), in order.
inline constexpr RecordingKind kinds_of_good_recordings[] = {
    RecordingKind::trajectory, RecordingKind::event_log, RecordingKind::trajectory,
    RecordingKind::event_log, RecordingKind::tracks};

inline void read_recording(const std::filesystem::path& path, RecordingKind kind) {
    if (kind == RecordingKind::trajectory)
        read_or_reject<FileError>([&] {
            TrajectoryReader reader(path);
            for (const std::string& name : reader.provenance_names())
                read_or_reject<FileError>([&] { reader.provenance(name); });
            for (std::uint64_t k = 0; k < reader.frames() && k < 50; ++k) {
                reader.frame(k);
                reader.events_before(k);
            }
            reader.inconsistent_dataset();
            reader.reach();
        });
    if (kind == RecordingKind::event_log)
        read_or_reject<FileError>([&] {
            EventLogReader log(path);
            log.provenance("parameters");
            Replay replay(log.initial(), log.period_end(), log.floor());
            for (const Event& event : log.read(0, std::min<std::uint64_t>(log.events(), 5000)))
                replay.apply(event);
        });
    if (kind == RecordingKind::tracks)
        read_or_reject<FileError>([&] { read_track_recording(path); });
}

}  // namespace swirl
