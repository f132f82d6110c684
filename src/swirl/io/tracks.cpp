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
#include "swirl/io/number_table.hpp"
#include "swirl/io/range_checks.hpp"
#include "swirl/io/read_number.hpp"
#include "swirl/io/track_repair.hpp"
#include "swirl/math/unit_circle.hpp"

namespace swirl {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// Converts frames to snapshots; missing velocities are finite differences.
class TrackSeries {
  public:
    TrackSeries(Tracks tracks, const TrackScale& scale)
        : tracks_(std::move(tracks)),
          scale_(scale),
          step_(commonest_step(tracks_)),
          period_(scale.our_period()) {}

    std::uint64_t frames() const { return tracks_.frames.size(); }
    bool takes_differences() const {
        return !tracks_.frames.empty() && tracks_.frames.front().velocity.empty();
    }
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
        const TrackFrame& f = tracks_.frames[k];
        return f.time.value_or(double(f.number) / scale_.frames_per_time) * scale_.camera_time();
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
    double period_;      // unit: that of the result
};

/// Reads the atoms after an "ITEM: ATOMS" line into `frame`, sorted by ID.
void read_atoms(TextLines& lines, std::string_view names, std::int64_t atoms, TrackFrame& frame) {
    NumberTable table(lines, names);
    const auto wrapped_or_not = [&](std::string_view wrapped, std::string_view unwrapped) {
        const auto index = table.find({wrapped});
        return index ? index : table.find({unwrapped});
    };
    const auto id = table.find({"id"}), x = wrapped_or_not("x", "xu"),
               y = wrapped_or_not("y", "yu"), vx = table.find({"vx"}), vy = table.find({"vy"}),
               radius = table.find({"radius"}), mass = table.find({"mass"}),
               omega = table.find({"omegaz"});
    if (!id || !x || !y) lines.fail("the atoms must have the columns id, x and y (or xu and yu)");
    const auto value = [&](const std::optional<std::size_t>& column, double otherwise) {
        return column ? table.number(*column) : otherwise;
    };
    struct Atom {
        Vec2 position, velocity;
        double radius, mass, spin;
    };
    std::map<std::int64_t, Atom> by_id;
    for (std::int64_t k = 0; k < atoms; ++k) {
        if (!table.next()) lines.fail_at_end("an atom");
        const Atom atom{{table.number(*x), table.number(*y)},
                        {value(vx, 0.0), value(vy, 0.0)},
                        value(radius, 1.0),
                        value(mass, 1.0),
                        value(omega, 0.0)};
        if (const std::int64_t number = table.integer(*id); !by_id.emplace(number, atom).second)
            lines.fail(fmt::format("atom {} appears twice", number));
    }
    for (const auto& [number, atom] : by_id) {
        frame.id.push_back(number);
        frame.position.push_back(atom.position);
        if (vx && vy) frame.velocity.push_back(atom.velocity);
        if (radius) frame.radius.push_back(atom.radius);
        if (mass) frame.mass.push_back(atom.mass);
        if (omega) frame.spin.push_back(atom.spin);
    }
}

/// The column with the given name, in any case, or else with one of the usual names.
std::optional<std::size_t> find_column(NumberTable& table, const std::string& given,
                                       const std::vector<std::string_view>& usual) {
    if (given.empty()) return table.find(usual);
    const std::string name = in_lower_case(given);
    return table.find({name});
}
const std::string& or_else(const std::string& given, const std::string& usual) {
    return given.empty() ? usual : given;
}

}  // namespace

Tracks read_track_table(const std::filesystem::path& path, const TableLayout& layout) {
    const std::string text = read_whole_file(path);
    TextLines lines(fmt::format("'{}'", path.string()), text);
    NumberTable table(lines);
    // Names of trackpy, TrackMate, MOSAIC and Manual Tracking.
    const auto frame = find_column(table, layout.frame, {"frame", "slice", "slice n°"}),
               particle = find_column(table, layout.particle,
                                      {"particle", "track_id", "trajectory", "track n°"}),
               x = find_column(table, layout.x, {"x", "position_x"}),
               y = find_column(table, layout.y, {"y", "position_y"});
    if (!frame || !particle || !x || !y)
        lines.fail(layout.has_names()
                       ? fmt::format("the header must name the columns {}, {}, {} and {}",
                                     or_else(layout.frame, "frame"),
                                     or_else(layout.particle, "particle"), or_else(layout.x, "x"),
                                     or_else(layout.y, "y"))
                       : "the header must name the columns frame, particle, x and y.\nhint: name "
                         "other columns, such as --columns frame=Slice,particle=Track");
    struct Entry {
        Vec2 position;
        double radius, spin;
    };
    std::map<std::int64_t, std::map<std::int64_t, Entry>> tracks;  // keys: particle and frame
    std::optional<std::size_t> radius, spin, time;
    std::map<std::int64_t, double> times;  // time of each frame
    if (table.find({"seen"})) {            // a file of `swirl track`
        radius = table.find({"radius"});
        spin = table.find({"spin"});
        time = table.find({"time"});
    }
    const bool has_units = table.find({"track_id"}).has_value();  // TrackMate: up to three rows
    while (table.next()) {
        if (has_units && tracks.empty() && !table.is_number(*frame)) continue;
        if (table.is_missing(*particle) || table.is_missing(*x) || table.is_missing(*y)) continue;
        const std::int64_t id = table.integer(*particle), number = table.integer(*frame);
        Entry entry{{table.number(*x), table.number(*y)}, 0.0, unknown};
        if (radius) entry.radius = table.number(*radius);
        if (time) {
            const double here = table.number(*time);
            const double first = times.try_emplace(number, here).first->second;
            if (first != here)
                lines.fail(fmt::format("the time of frame {} is {}, but {} in an earlier line",
                                       number, here, first));
        }
        // The table counts spins counter-clockwise in the image; y points down, which flips the
        // sign.
        if (spin && !table.is_empty(*spin)) entry.spin = -table.number(*spin);
        if (!tracks[id].try_emplace(number, entry).second)
            lines.fail(fmt::format("particle {} appears twice in frame {}", id, number));
    }
    if (tracks.empty()) throw FileError(fmt::format("'{}' holds no positions.", path.string()));

    Tracks result;
    result.y_down = !layout.y_up;
    std::map<std::int64_t, TrackFrame> frames;
    for (const auto& [id, track] : tracks)
        for (const auto& [number, entry] : track) {
            TrackFrame& f = frames[number];
            f.number = number;
            if (time) f.time = times[number];
            f.id.push_back(id);
            f.position.push_back(entry.position);
            if (radius) f.radius.push_back(entry.radius);
            if (spin) f.spin.push_back(entry.spin);
        }
    for (auto& [number, f] : frames) result.frames.push_back(std::move(f));
    require_ascending_frames(result, path);
    return result;
}

Tracks read_lammps_dump(const std::filesystem::path& path) {
    constexpr std::string_view atoms_item = "ITEM: ATOMS";
    const std::string text = read_whole_file(path);
    TextLines lines(fmt::format("'{}'", path.string()), text);
    const auto integer = [&](std::string_view name) {
        NumberTable table(lines, name);
        if (!table.next()) lines.fail_at_end(name);
        return table.integer(0);
    };
    Tracks result;
    TrackFrame frame;
    std::int64_t atoms = -1;  // −1: not given yet for this frame
    std::string_view line;
    while (lines.next(line)) {
        if (line == "ITEM: TIMESTEP") {
            frame = {};
            atoms = -1;
            frame.number = integer("timestep");
        } else if (line == "ITEM: NUMBER OF ATOMS") {
            atoms = integer("atoms");
            if (atoms < 0 || atoms > std::int64_t(text.size()))
                lines.fail(fmt::format("{} atoms cannot be in this file", atoms));
        } else if (line.starts_with("ITEM: BOX BOUNDS")) {
            for (int k = 0; k < 3; ++k) lines.expect("the bounds of the box");
        } else if (line.starts_with(atoms_item)) {
            if (atoms < 0) lines.fail("ITEM: NUMBER OF ATOMS is missing before ITEM: ATOMS");
            read_atoms(lines, line.substr(atoms_item.size()), atoms, frame);
            result.frames.push_back(frame);
        } else if (line == "ITEM: UNITS" || line == "ITEM: TIME") {
            lines.expect("a value");
        } else if (!line.empty()) {
            lines.fail("this is not a LAMMPS text dump: 'ITEM: …' was expected");
        }
    }
    if (result.frames.empty()) throw FileError(fmt::format("'{}' holds no frames.", path.string()));
    require_ascending_frames(result, path);
    return result;
}

void require_ascending_frames(const Tracks& tracks, const std::filesystem::path& path) {
    for (std::size_t k = 1; k < tracks.frames.size(); ++k) {
        const TrackFrame &before = tracks.frames[k - 1], &here = tracks.frames[k];
        if (here.number <= before.number)
            throw FileError(fmt::format("'{}': frame {} follows frame {}, but frames must ascend.",
                                        path.string(), here.number, before.number));
        if (here.time && !(*here.time > before.time))
            throw FileError(fmt::format(
                "'{}': the time of frame {} is {}, which is not after the time {} of frame {}.",
                path.string(), here.number, *here.time, *before.time, before.number));
    }
}

double TrackScale::our_period() const { return amplitude > 0.0 ? 2.0 * pi * amplitude : period; }

SnapshotSeries series_of(Tracks tracks, const TrackScale& scale) {
    auto series = std::make_shared<TrackSeries>(std::move(tracks), scale);
    SnapshotSeries found{series->frames(), scale.amplitude + scale.container_radius,
                         [series](std::uint64_t k) { return series->frame(k); }, series->breaks()};
    found.velocities_are_differences = series->takes_differences();
    return found;
}

}  // namespace swirl
