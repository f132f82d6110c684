#include "swirl/io/tracks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <set>

#include "swirl/io/atomic_file.hpp"
#include "swirl/io/file_error.hpp"
#include "swirl/io/range_checks.hpp"
#include "swirl/io/read_number.hpp"
#include "swirl/io/track_repair.hpp"
#include "swirl/math/unit_circle.hpp"

namespace swirl {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// Iterates over the lines of a text and reports errors with the line number.
class Lines {
  public:
    Lines(const std::filesystem::path& path, std::string_view text) : path_(path), rest_(text) {
        // Some editors and spreadsheets write a byte order mark first.
        constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
        if (rest_.starts_with(byte_order_mark)) rest_.remove_prefix(byte_order_mark.size());
    }

    bool next(std::string_view& line) {
        if (rest_.empty()) return false;
        const std::size_t end = rest_.find('\n');
        ++number_;
        // If a file was truncated within a number, its last line would hold a wrong number.
        if (end == rest_.npos)
            error(
                "the last line has no line break, so the file may be truncated here.\n"
                "hint: if the file is complete, append a line break");
        line = rest_.substr(0, end);
        rest_.remove_prefix(end + 1);
        if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
        return true;
    }
    std::string_view expect(std::string_view what) {
        std::string_view line;
        if (!next(line))
            throw FileError(fmt::format("'{}' ends after line {}, but {} was expected.",
                                        path_.string(), number_, what));
        return line;
    }
    [[noreturn]] void error(std::string_view what) const {
        throw FileError(fmt::format("'{}', line {}: {}.", path_.string(), number_, what));
    }
    double number(std::string_view text) const {
        while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
        while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
        const auto value = read_number(text);
        if (!value) error(fmt::format("'{}' is not a finite number", text));
        return *value;
    }
    std::int64_t integer(std::string_view text) const {
        const double value = number(text);  // pandas writes frame 3 as 3.0 if a column has gaps
        if (value != std::floor(value) || std::abs(value) > 0x1p53)
            error(fmt::format("'{}' is not a whole number", text));
        return static_cast<std::int64_t>(value);
    }

  private:
    const std::filesystem::path& path_;
    std::string_view rest_;
    std::size_t number_ = 0;
};

std::vector<std::string_view> split(std::string_view line, char separator) {
    std::vector<std::string_view> parts;
    for (;;) {
        const std::size_t end = line.find(separator);
        const std::string_view part = line.substr(0, end);
        if (separator != ' ' || !part.empty()) parts.push_back(part);
        if (end == line.npos) return parts;
        line.remove_prefix(end + 1);
    }
}

/// Splits a CSV line at its commas; surrounding spaces and quotes are removed.
std::vector<std::string_view> cells(std::string_view line) {
    std::vector<std::string_view> parts;
    for (;;) {
        while (line.starts_with(' ')) line.remove_prefix(1);
        const std::size_t close = line.starts_with('"') ? line.find('"', 1) : line.npos;
        const std::size_t end = line.find(',', close == line.npos ? 0 : close);
        std::string_view part =
            close == line.npos ? line.substr(0, end) : line.substr(1, close - 1);
        while (close == line.npos && part.ends_with(' ')) part.remove_suffix(1);
        parts.push_back(part);
        if (end == line.npos) return parts;
        line.remove_prefix(end + 1);
    }
}

/// Index of column `name` in the header line `names`; none if absent. A repeated column is an
/// error.
std::optional<std::size_t> index_of(const Lines& lines, const std::vector<std::string_view>& names,
                                    std::string_view name) {
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) return {};
    if (std::find(found + 1, names.end(), name) != names.end())
        lines.error(fmt::format("there are two columns '{}'", name));
    return std::size_t(found - names.begin());
}

/// Converts frames to snapshots; missing velocities are finite differences.
class TrackSeries {
  public:
    TrackSeries(Tracks tracks, const TrackScale& scale)
        : tracks_(std::move(tracks)),
          scale_(scale),
          step_(commonest_step(tracks_)),
          period_(scale.our_period()) {}

    std::uint64_t frames() const { return tracks_.frames.size(); }
    std::vector<std::uint64_t> breaks() const {
        std::vector<std::uint64_t> found;
        for (std::size_t k = 1; k < tracks_.frames.size(); ++k)
            if (tracks_.frames[k].id != tracks_.frames[k - 1].id) found.push_back(k);
        return found;
    }

    Snapshot frame(std::uint64_t k) const {
        const TrackFrame& f = tracks_.frames.at(k);
        Snapshot s;
        s.resize(f.id.size());
        const double time = time_of(k);
        s.period = period_;
        s.periods = static_cast<std::int64_t>(std::floor(time / s.period));
        s.clock = time - double(s.periods) * s.period;
        s.container_radius = scale_.container_radius;
        const Vec2 direction = unit_circle(phase() / (2.0 * pi) + s.clock / s.period);
        s.container_centre = scale_.amplitude * direction;
        s.container_velocity = (scale_.amplitude * 2.0 * pi / s.period) * perpendicular(direction);
        for (std::size_t i = 0; i < s.size(); ++i) {
            const double mass = f.mass.empty() ? 1.0 : f.mass[i];
            s.set(i, {lab(f.position[i]), velocity(k, i), unknown,
                      f.spin.empty() ? unknown : spin_sign() * f.spin[i] / scale_.camera_time(),
                      s.clock, f.radius.empty() ? 1.0 : f.radius[i] / scale_.pixels_per_radius,
                      mass, unknown});
        }
        require_possible(s, Spins::maybe_unknown);
        return s;
    }

  private:
    double spin_sign() const { return tracks_.y_down != scale_.clockwise ? -1.0 : 1.0; }
    /// A clockwise motion is mirrored, and its phase with it.
    double phase() const { return scale_.clockwise ? pi - scale_.phase : scale_.phase; }
    double time_of(std::uint64_t k) const {
        return double(tracks_.frames[k].number) / scale_.frames_per_time * scale_.camera_time();
    }
    bool adjacent(std::uint64_t k, std::uint64_t next) const {
        return tracks_.frames[next].number - tracks_.frames[k].number <= (longest_gap + 1) * step_;
    }
    Vec2 to_lab_axes(const Vec2& v) const {
        return {(scale_.clockwise ? -1.0 : 1.0) * v.x / scale_.pixels_per_radius,
                (tracks_.y_down ? -1.0 : 1.0) * v.y / scale_.pixels_per_radius};
    }
    Vec2 lab(const Vec2& p) const { return to_lab_axes(p - scale_.swirl_centre); }

    std::optional<Vec2> find_position(std::uint64_t k, std::int64_t id) const {
        if (k >= tracks_.frames.size()) return {};
        const TrackFrame& f = tracks_.frames[k];
        const auto at = std::lower_bound(f.id.begin(), f.id.end(), id);
        if (at == f.id.end() || *at != id) return {};
        return f.position[std::size_t(at - f.id.begin())];
    }
    Vec2 velocity(std::uint64_t k, std::size_t i) const {
        const TrackFrame& f = tracks_.frames[k];
        if (!f.velocity.empty()) return (1.0 / scale_.camera_time()) * to_lab_axes(f.velocity[i]);
        std::uint64_t from = k, to = k;
        Vec2 first = f.position[i], last = first;
        if (k > 0 && adjacent(k - 1, k))
            if (const auto before = find_position(k - 1, f.id[i])) from = k - 1, first = *before;
        if (k + 1 < tracks_.frames.size() && adjacent(k, k + 1))
            if (const auto after = find_position(k + 1, f.id[i])) to = k + 1, last = *after;
        if (from == to) return {0.0, 0.0};
        return (1.0 / (time_of(to) - time_of(from))) * to_lab_axes(last - first);
    }

    Tracks tracks_;
    TrackScale scale_;
    std::int64_t step_;  // usual difference between two frame numbers
    double period_;      // in units of the result
};

}  // namespace

Tracks read_trackpy_csv(const std::filesystem::path& path) {
    const std::string text = read_whole_file(path);
    Lines lines(path, text);
    const auto names = cells(lines.expect("a header line with frame, particle, x, y"));
    const auto frame = index_of(lines, names, "frame"),
               particle = index_of(lines, names, "particle");
    const auto x = index_of(lines, names, "x"), y = index_of(lines, names, "y");
    if (!frame || !particle || !x || !y)
        lines.error(
            "the header must name the columns frame, particle, x and y, separated by commas");

    struct Entry {
        Vec2 position;
        double radius, spin;
    };
    std::map<std::int64_t, std::map<std::int64_t, Entry>> tracks;  // by particle and frame
    const auto swirl_column = [&](std::string_view name) {
        return index_of(lines, names, "seen") ? index_of(lines, names, name) : std::nullopt;
    };
    const auto radius = swirl_column("radius"), spin = swirl_column("spin");
    // The table counts spins counter-clockwise in the image; y points down, which flips the sign.
    const auto spin_in = [&](std::string_view cell) {
        return cell.empty() ? unknown : -lines.number(cell);
    };
    std::string_view line;
    while (lines.next(line)) {
        if (line.empty()) continue;
        const auto parts = cells(line);
        if (parts.size() != names.size())
            lines.error(fmt::format("{} values, but the header names {} columns", parts.size(),
                                    names.size()));
        const bool fresh =
            tracks[lines.integer(parts[*particle])]
                .try_emplace(lines.integer(parts[*frame]),
                             Entry{{lines.number(parts[*x]), lines.number(parts[*y])},
                                   radius ? lines.number(parts[*radius]) : 0.0,
                                   spin ? spin_in(parts[*spin]) : 0.0})
                .second;
        if (!fresh)
            lines.error(fmt::format("particle {} appears twice in frame {}", parts[*particle],
                                    parts[*frame]));
    }
    if (tracks.empty()) throw FileError(fmt::format("'{}' holds no positions.", path.string()));

    Tracks result;
    result.y_down = true;
    std::map<std::int64_t, TrackFrame> frames;
    for (const auto& [id, track] : tracks)
        for (const auto& [number, entry] : track) {
            TrackFrame& f = frames[number];
            f.number = number;
            f.id.push_back(id);
            f.position.push_back(entry.position);
            if (radius) f.radius.push_back(entry.radius);
            if (spin) f.spin.push_back(entry.spin);
        }
    for (auto& [number, f] : frames) result.frames.push_back(std::move(f));
    return result;
}

namespace {

/// The columns of a LAMMPS dump that are read; the optional ones may be absent.
struct DumpColumns {
    std::size_t count;
    std::size_t id, x, y;
    std::optional<std::size_t> vx, vy, radius, mass, omega;
};

DumpColumns dump_columns(const Lines& lines, const std::vector<std::string_view>& names) {
    const auto column = [&](std::string_view name) { return index_of(lines, names, name); };
    const auto wrapped_or_not = [&](std::string_view wrapped, std::string_view unwrapped) {
        const auto index = column(wrapped);
        return index ? index : column(unwrapped);
    };
    const auto id = column("id"), x = wrapped_or_not("x", "xu"), y = wrapped_or_not("y", "yu");
    if (!id || !x || !y) lines.error("the atoms must have the columns id, x and y (or xu and yu)");
    return {
        names.size(),    *id, *x, *y, column("vx"), column("vy"), column("radius"), column("mass"),
        column("omegaz")};
}

/// Reads the atoms after an "ITEM: ATOMS" line into `frame`, sorted by ID.
void read_atoms(Lines& lines, std::string_view names, std::int64_t atoms, TrackFrame& frame) {
    const DumpColumns columns = dump_columns(lines, split(names, ' '));
    struct Atom {
        Vec2 position, velocity;
        double radius, mass, spin;
    };
    std::map<std::int64_t, Atom> by_id;
    for (std::int64_t k = 0; k < atoms; ++k) {
        const auto parts = split(lines.expect("an atom"), ' ');
        if (parts.size() != columns.count)
            lines.error(fmt::format("{} values for {} columns", parts.size(), columns.count));
        const auto value = [&](const std::optional<std::size_t>& column, double otherwise) {
            return column ? lines.number(parts[*column]) : otherwise;
        };
        const Atom atom{{lines.number(parts[columns.x]), lines.number(parts[columns.y])},
                        {value(columns.vx, 0.0), value(columns.vy, 0.0)},
                        value(columns.radius, 1.0),
                        value(columns.mass, 1.0),
                        value(columns.omega, 0.0)};
        if (!by_id.emplace(lines.integer(parts[columns.id]), atom).second)
            lines.error(fmt::format("atom {} appears twice", parts[columns.id]));
    }
    for (const auto& [id, atom] : by_id) {
        frame.id.push_back(id);
        frame.position.push_back(atom.position);
        if (columns.vx && columns.vy) frame.velocity.push_back(atom.velocity);
        if (columns.radius) frame.radius.push_back(atom.radius);
        if (columns.mass) frame.mass.push_back(atom.mass);
        if (columns.omega) frame.spin.push_back(atom.spin);
    }
}

}  // namespace

Tracks read_lammps_dump(const std::filesystem::path& path) {
    constexpr std::string_view atoms_item = "ITEM: ATOMS";
    const std::string text = read_whole_file(path);
    Lines lines(path, text);
    Tracks result;
    TrackFrame frame;
    std::int64_t atoms = -1;  // −1: not given yet for this frame
    std::string_view line;
    while (lines.next(line)) {
        if (line == "ITEM: TIMESTEP") {
            frame = {};
            atoms = -1;
            frame.number = lines.integer(lines.expect("a time step"));
            if (!result.frames.empty() && frame.number <= result.frames.back().number)
                lines.error("the time steps do not ascend");
        } else if (line == "ITEM: NUMBER OF ATOMS") {
            atoms = lines.integer(lines.expect("the number of atoms"));
            if (atoms < 0 || atoms > std::int64_t(text.size()))
                lines.error(fmt::format("{} atoms cannot be in this file", atoms));
        } else if (line.starts_with("ITEM: BOX BOUNDS")) {
            for (int k = 0; k < 3; ++k) lines.expect("the bounds of the box");
        } else if (line.starts_with(atoms_item)) {
            if (atoms < 0) lines.error("ITEM: NUMBER OF ATOMS is missing before ITEM: ATOMS");
            read_atoms(lines, line.substr(atoms_item.size()), atoms, frame);
            result.frames.push_back(frame);
        } else if (line == "ITEM: UNITS" || line == "ITEM: TIME") {
            lines.expect("a value");
        } else if (!line.empty()) {
            lines.error("this is not a LAMMPS text dump: 'ITEM: …' was expected");
        }
    }
    if (result.frames.empty()) throw FileError(fmt::format("'{}' holds no frames.", path.string()));
    return result;
}

double TrackScale::our_period() const { return amplitude > 0.0 ? 2.0 * pi * amplitude : period; }

SnapshotSeries series_of(Tracks tracks, const TrackScale& scale) {
    auto series = std::make_shared<TrackSeries>(std::move(tracks), scale);
    return {series->frames(), scale.amplitude + scale.container_radius,
            [series](std::uint64_t k) { return series->frame(k); }, series->breaks()};
}

}  // namespace swirl
