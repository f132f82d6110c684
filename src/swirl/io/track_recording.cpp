#include "swirl/io/track_recording.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "swirl/io/atomic_file.hpp"
#include "swirl/io/file_error.hpp"
#include "swirl/io/h5md.hpp"
#include "swirl/io/hdf5.hpp"
#include "swirl/io/recording.hpp"

namespace swirl {
namespace {

constexpr std::int64_t no_disc = -1;
constexpr std::uint64_t frames_in_a_chunk = 256;
constexpr int compression = 1;  // level of deflate
constexpr double no_value = std::numeric_limits<double>::quiet_NaN();

std::string path_of(const std::string& name) { return h5md::tracks + "/" + name; }

/// The column of each disc ID; a disc keeps its column in all frames.
std::map<std::int64_t, std::size_t> slots_of(const Tracks& tracks) {
    std::map<std::int64_t, std::size_t> slots;
    for (const TrackFrame& f : tracks.frames)
        for (const std::int64_t id : f.id) slots.emplace(id, 0);
    std::size_t next = 0;
    for (auto& [id, slot] : slots) slot = next++;
    return slots;
}

/// Writes datasets with one row per frame and one column per disc ID of the whole recording.
class TrackWriter {
  public:
    TrackWriter(Hdf5File& file, const Tracks& tracks)
        : file_(file), tracks_(tracks), slots_(slots_of(tracks)) {}

    void write_times(const std::vector<double>& times) {
        std::vector<std::int64_t> numbers;
        for (const TrackFrame& f : tracks_.frames) numbers.push_back(f.number);
        file_.create_group(path_of("position"));
        file_.write(path_of("position/step"), numbers, {numbers.size()});
        file_.write(path_of("position/time"), times, {times.size()});
    }
    void write_positions() {
        std::vector<double> rows(tracks_.frames.size() * slots_.size() * 3, 0.0);
        for (std::size_t at = 0; at < rows.size(); at += 3) rows[at] = rows[at + 1] = no_value;
        visit([&](std::size_t at, const TrackFrame& f, std::size_t, std::size_t i) {
            rows[3 * at] = f.position[i].x;
            rows[3 * at + 1] = f.position[i].y;
        });
        write_rows<double>("position", {slots_.size(), 3}, rows);
    }
    void write_ids() {
        std::vector<std::int64_t> rows(tracks_.frames.size() * slots_.size(), no_disc);
        visit([&](std::size_t at, const TrackFrame& f, std::size_t, std::size_t i) {
            rows[at] = f.id[i];
        });
        write_values("id", rows);
    }
    void write_column(const TrackColumn& column) {
        std::vector<double> rows(tracks_.frames.size() * slots_.size(), no_value);
        visit([&](std::size_t at, const TrackFrame&, std::size_t k, std::size_t i) {
            rows[at] = column.values.at(k).at(i);
        });
        write_values(column.name, rows);
    }

  private:
    /// Calls call(index into the rows, frame, index of the frame, index of the disc in the frame).
    template <class Visit>
    void visit(Visit&& call) const {
        for (std::size_t k = 0; k < tracks_.frames.size(); ++k) {
            const TrackFrame& f = tracks_.frames[k];
            for (std::size_t i = 0; i < f.id.size(); ++i)
                call(k * slots_.size() + slots_.at(f.id[i]), f, k, i);
        }
    }
    template <class T>
    void write_values(const std::string& name, const std::vector<T>& rows) {
        file_.create_group(path_of(name));
        h5md::link_times(file_, path_of("position"), path_of(name));
        write_rows<T>(name, {slots_.size()}, rows);
    }
    template <class T>
    void write_rows(const std::string& name, const Dimensions& row, const std::vector<T>& rows) {
        Dimensions chunk{frames_in_a_chunk, row[0]};
        if (row.size() > 1) chunk.push_back(1);
        file_.create_column<T>(path_of(name + "/value"), row, chunk, compression)
            .append(rows.data(), tracks_.frames.size());
    }

    Hdf5File& file_;
    const Tracks& tracks_;
    std::map<std::int64_t, std::size_t> slots_;
};

[[noreturn]] void contradicts(const std::filesystem::path& path, const std::string& what) {
    throw FileError(fmt::format("'{}' contradicts itself: {}.", path.string(), what));
}

/// Reads the datasets of a file; all of them have as many values as `id`.
class TrackReader {
  public:
    explicit TrackReader(const std::filesystem::path& path)
        : path_(path), file_(path, JournaledFile::Mode::read) {
        if (!file_.has(path_of("position/value")) || !file_.has(path_of("id/value")))
            throw FileError(fmt::format("'{}' is an HDF5 file, but holds no tracks: it has no {}.",
                                        path.string(), path_of("position")));
        h5md::require_known_format(file_, path);
        number_ = file_.column(path_of("position/step")).read<std::int64_t>();
        id_ = file_.column(path_of("id/value")).read<std::int64_t>();
        if (file_.has(path_of("position/time")))
            time_ = file_.column(path_of("position/time")).read<double>();
        position_ = file_.column(path_of("position/value")).read<double>();
        if (number_.empty() || id_.size() % number_.size() != 0 ||
            position_.size() != 3 * id_.size())
            contradicts(path, "its columns differ in length");
        if (!time_.empty() && time_.size() != number_.size())
            contradicts(path, "its columns differ in length");
    }
    Tracks read() {
        const auto radius = column("radius"), spin = column("spin");
        const std::size_t row = id_.size() / number_.size();
        Tracks tracks;
        tracks.y_down = true;
        for (std::size_t k = 0; k < number_.size(); ++k) {
            TrackFrame f;
            f.number = number_[k];
            if (!time_.empty()) f.time = time_[k];
            for (std::size_t at = k * row; at < (k + 1) * row; ++at) {
                if (id_[at] == no_disc) continue;
                if (!f.id.empty() && id_[at] <= f.id.back())
                    contradicts(path_,
                                fmt::format("the disc IDs of frame {} do not ascend", f.number));
                f.id.push_back(id_[at]);
                f.position.push_back(
                    {require_finite(position_[3 * at]), require_finite(position_[3 * at + 1])});
                if (!radius.empty()) f.radius.push_back(require_finite(radius[at]));
                // The file counts spins counter-clockwise in the image; y down flips the sign.
                if (!spin.empty()) f.spin.push_back(-spin[at]);
            }
            if (!f.id.empty()) tracks.frames.push_back(std::move(f));
        }
        if (tracks.frames.empty())
            throw FileError(fmt::format("'{}' holds no positions.", path_.string()));
        require_ascending_frames(tracks, path_);
        if (!has_uneven_times())
            for (TrackFrame& f : tracks.frames) f.time.reset();
        return tracks;
    }

  private:
    /// Times of equal steps are those of the frame numbers, which readers use.
    bool has_uneven_times() const {
        constexpr double rounding = 1e-6;  // fraction of a step
        if (time_.empty() || number_.size() < 3) return false;
        const double step =
            (time_.back() - time_.front()) / double(number_.back() - number_.front());
        for (std::size_t k = 0; k < number_.size(); ++k)
            if (std::abs(time_[k] - time_[0] - step * double(number_[k] - number_[0])) >
                rounding * step)
                return true;
        return false;
    }
    /// Values of an optional column; empty if the file does not have it.
    std::vector<double> column(const std::string& name) const {
        if (!file_.has(path_of(name + "/value"))) return {};
        auto values = file_.column(path_of(name + "/value")).read<double>();
        if (values.size() != id_.size()) contradicts(path_, "its columns differ in length");
        return values;
    }
    double require_finite(double value) const {
        if (!std::isfinite(value)) contradicts(path_, "a disc has an ID but no position or radius");
        return value;
    }

    const std::filesystem::path& path_;
    Hdf5File file_;
    std::vector<std::int64_t> number_, id_;
    std::vector<double> position_, time_;
};

}  // namespace

void write_track_recording(const std::filesystem::path& path, const Tracks& tracks,
                           const std::vector<double>& times,
                           const std::vector<TrackColumn>& columns, const Provenance& provenance) {
    const std::filesystem::path partial = partial_name(path);
    Hdf5File file(partial, JournaledFile::Mode::create);
    try {
        h5md::create_head(file, h5md::tracks);
        h5md::create_parameters(file, provenance);
        TrackWriter writer(file, tracks);
        writer.write_times(times);
        writer.write_positions();
        writer.write_ids();
        for (const TrackColumn& column : columns) writer.write_column(column);
        file.finish(path);
    } catch (const FileError&) {
        // Tracks are written at once and never resumed, so an incomplete file is useless.
        std::error_code ignored;
        std::filesystem::remove(partial, ignored);
        std::filesystem::remove(partial.string() + ".journal", ignored);
        throw;
    }
}

bool is_track_recording(const std::filesystem::path& path) {
    if (!file_signature(path).starts_with("\x89HDF")) return false;
    try {
        return Hdf5File(path, JournaledFile::Mode::read).has(path_of("position/value"));
    } catch (const FileChanged&) {
        return false;  // tracks are written at once, so the file is the recording of a run
    }
}

Tracks read_track_recording(const std::filesystem::path& path) { return TrackReader(path).read(); }

}  // namespace swirl
