#include "swirl/io/export.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <initializer_list>
#include <iterator>
#include <span>
#include <vector>

#include "swirl/io/atomic_file.hpp"
#include "swirl/io/file_error.hpp"
#include "swirl/io/h5md.hpp"
#include "swirl/io/table.hpp"
#include "swirl/io/trajectory.hpp"
#include "swirl/math/unit_circle.hpp"

namespace swirl {
namespace {

using Text = fmt::memory_buffer;

template <class... Parts>
void add(Text& text, fmt::format_string<Parts...> format, Parts&&... parts) {
    fmt::format_to(std::back_inserter(text), format, std::forward<Parts>(parts)...);
}

/// Unknown values are NaN in a snapshot; formats without a missing value get 0.
double or_zero(double value) { return std::isfinite(value) ? value : 0.0; }

void write_frames(const SnapshotSeries& series, const ExportOptions& options, auto&& write) {
    const std::uint64_t count = exported_frames(series.frames, options);
    for (std::uint64_t n = 0; n < count; ++n) {
        const std::uint64_t k = options.first + n * options.stride;
        write(k, series.frame(k));
        if (options.on_frame) options.on_frame(n + 1);
    }
}

/// Null if they are unknown in all frames.
const PinnedColumns* states_of(const SnapshotSeries& series, std::uint64_t k) {
    return series.pinned ? &series.pinned(k) : nullptr;
}

/// Appends the text that format(text, k, snapshot) adds for each frame k.
void write_text_frames(const SnapshotSeries& series, AtomicFile& file, const ExportOptions& options,
                       auto&& format) {
    write_frames(series, options, [&](std::uint64_t k, const Snapshot& s) {
        Text text;
        format(text, k, s);
        file.append({text.data(), text.size()});
    });
}

/// True if the frames are of spheres or coins with known orientations, as in a recorded run.
bool has_spheres(const SnapshotSeries& series) {
    if (series.frames == 0) return false;
    const Snapshot first = series.frame(0);
    return first.are_spheres() && !first.turned.empty();
}

/// Formats without a missing value get −1.
int state_number(double value) { return std::isfinite(value) ? static_cast<int>(value) : -1; }

/// Type number of the container: the one after those of the discs, which count from 1.
std::int64_t type_of_container(const std::vector<std::int64_t>& species) {
    return species.empty() ? 1 : *std::max_element(species.begin(), species.end()) + 2;
}

void write_lammps(const SnapshotSeries& series, AtomicFile& file, const ExportOptions& options) {
    write_text_frames(series, file, options, [&](Text& text, std::uint64_t k, const Snapshot& s) {
        const PinnedColumns* const states = states_of(series, k);
        const auto species = h5md::species_of(s.radius, s.mass);
        add(text, "ITEM: TIMESTEP\n{}\nITEM: NUMBER OF ATOMS\n{}\nITEM: BOX BOUNDS ff ff ff\n", k,
            s.size() + (options.container ? 1 : 0));
        add(text, "{} {}\n{} {}\n-1 1\n", -series.reach, series.reach, -series.reach, series.reach);
        add(text, "ITEM: ATOMS id type x y z vx vy vz radius mass {}{}\n",
            !s.are_spheres()   ? "omegaz"
            : s.turned.empty() ? "omegaz omegax omegay"
                               : "omegaz omegax omegay quatw quati quatj quatk",
            states ? " pinned resident" : "");
        for (std::size_t i = 0; i < s.size(); ++i) {
            options.check_stop_at(i);
            const Vec2 p = s.position(i);
            add(text, "{} {} {} {} 0 {} {} 0 {} {} {}", i + 1, species[i] + 1, p.x, p.y, s.vx[i],
                s.vy[i], s.radius[i], s.mass[i], or_zero(s.spin[i]));
            if (s.are_spheres()) add(text, " {} {}", s.spin_x[i], s.spin_y[i]);
            if (!s.turned.empty()) {
                const Quaternion q = s.quaternion(i);
                add(text, " {} {} {} {}", q.w, q.x, q.y, q.z);
            }
            if (states)
                add(text, " {} {}", state_number(states->pinned[i]),
                    state_number(states->resident[i]));
            add(text, "\n");
        }
        if (!options.container) return;
        const Vec2 c = s.container_centre, v = s.container_velocity;
        add(text, "{} {} {} {} 0 {} {} 0 {} 0 0", s.size() + 1, type_of_container(species), c.x,
            c.y, v.x, v.y, s.container_radius);
        add(text, "{}{}{}\n", s.are_spheres() ? " 0 0" : "", s.turned.empty() ? "" : " 1 0 0 0",
            states ? " -1 -1" : "");
    });
}

/// ASE accepts chemical symbols only, X for none.
const char* symbol_of_species(std::int64_t species) {
    static constexpr const char* symbols[] = {"H", "He", "Li", "Be", "B", "C", "N", "O", "F", "Ne"};
    return species < std::ssize(symbols) ? symbols[species] : "X";
}

void write_xyz(const SnapshotSeries& series, AtomicFile& file, const ExportOptions& options) {
    write_text_frames(series, file, options, [&](Text& text, std::uint64_t k, const Snapshot& s) {
        const PinnedColumns* const states = states_of(series, k);
        const auto species = h5md::species_of(s.radius, s.mass);
        add(text,
            "{}\nProperties=species:S:1:pos:R:3:velo:R:3:omega:R:{}:radius:R:1:id:I:1{}{} Time={} "
            "pbc=\"F F F\" container_x={} container_y={} container_radius={}\n",
            s.size() + (options.container ? 1 : 0), s.are_spheres() ? 3 : 1,
            s.turned.empty() ? "" : ":orientation:R:4", states ? ":pinned:I:1:resident:I:1" : "",
            s.time(), s.container_centre.x, s.container_centre.y, s.container_radius);
        for (std::size_t i = 0; i < s.size(); ++i) {
            options.check_stop_at(i);
            const Vec2 p = s.position(i);
            add(text, "{} {} {} 0 {} {} 0 ", symbol_of_species(species[i]), p.x, p.y, s.vx[i],
                s.vy[i]);
            if (s.are_spheres()) add(text, "{} {} ", s.spin_x[i], s.spin_y[i]);
            add(text, "{} {} {}", or_zero(s.spin[i]), s.radius[i], i + 1);
            if (!s.turned.empty()) {
                const Quaternion q = s.quaternion(i);
                add(text, " {} {} {} {}", q.x, q.y, q.z, q.w);  // the order of OVITO
            }
            if (states)
                add(text, " {} {}", state_number(states->pinned[i]),
                    state_number(states->resident[i]));
            add(text, "\n");
        }
        if (!options.container) return;
        const Vec2 c = s.container_centre, v = s.container_velocity;
        add(text, "X {} {} 0 {} {} 0 {}0 {} {}{}{}\n", c.x, c.y, v.x, v.y,
            s.are_spheres() ? "0 0 " : "", s.container_radius, s.size() + 1,
            s.turned.empty() ? "" : " 0 0 0 1", states ? " -1 -1" : "");
    });
}

void write_csv(const SnapshotSeries& series, AtomicFile& file, const ExportOptions& options) {
    file.append("frame,particle,x,y\n");
    write_text_frames(series, file, options, [&](Text& text, std::uint64_t k, const Snapshot& s) {
        for (std::size_t i = 0; i < s.size(); ++i) {
            options.check_stop_at(i);
            const Vec2 p = s.position(i);
            add(text, "{},{},{},{}\n", k, i, (series.reach + p.x) * options.pixels_per_radius,
                (series.reach - p.y) * options.pixels_per_radius);
        }
    });
}

void add_cell(Text& text, double value) { add(text, ",{}", cell_text(value)); }

/// Positions, velocities, spins and particles in r, v and m; times stay.
Snapshot in_printed_units(Snapshot s, const MeasuredUnits& units) {
    const auto divide = [](std::initializer_list<std::vector<double>*> columns, double unit) {
        for (std::vector<double>* column : columns)
            for (double& value : *column) value /= unit;
    };
    s = s.up_to_date();
    divide({&s.x, &s.y, &s.radius}, units.r);
    divide({&s.vx, &s.vy}, units.v);
    divide({&s.spin, &s.spin_x, &s.spin_y}, units.of("v/r"));
    divide({&s.mass}, units.m);
    divide({&s.inertia}, units.of("m r²"));
    s.container_centre = (1.0 / units.r) * s.container_centre;
    return s;
}

void write_table(const SnapshotSeries& series, AtomicFile& file, const ExportOptions& options) {
    const bool spheres = has_spheres(series);
    file.append(
        "frame,time (r/v),periods,container x (r),container y (r),disc,x (r),y (r),v_x (v),v_y (v),"
        "angle (rad),spin (v/r),radius (r),mass (m),moment of inertia (m r²)");
    if (spheres) file.append(",spin x (v/r),spin y (v/r),turned w,turned x,turned y,turned z");
    if (series.pinned) file.append(",pinned,resident");
    file.append("\n");
    const double time_unit = series.units.of("r/v");
    write_text_frames(series, file, options, [&](Text& text, std::uint64_t k, const Snapshot& raw) {
        const PinnedColumns* const states = states_of(series, k);
        const Snapshot s = in_printed_units(raw, series.units);
        for (std::size_t i = 0; i < s.size(); ++i) {
            options.check_stop_at(i);
            const Vec2 p{s.x[i], s.y[i]};
            add(text, "{},{},{},{},{},{},{},{}", k, s.time() / time_unit,
                double(s.periods) + s.clock / s.period, s.container_centre.x, s.container_centre.y,
                i, p.x, p.y);
            for (const double value :
                 {s.vx[i], s.vy[i], s.angle[i], s.spin[i], s.radius[i], s.mass[i], s.inertia[i]})
                add_cell(text, value);
            if (spheres) {
                const Quaternion q = s.turned[i];
                add(text, ",{},{},{},{},{},{}", s.spin_x[i], s.spin_y[i], q.w, q.x, q.y, q.z);
            }
            if (states)
                for (const double state : {states->pinned[i], states->resident[i]})
                    add_cell(text, state);
            add(text, "\n");
        }
    });
}

// --- VTK -----------------------------------------------------------------------------------------

std::string base64(std::string_view bytes) {
    constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t group = 0;
        const std::size_t n = std::min<std::size_t>(3, bytes.size() - i);
        for (std::size_t k = 0; k < 3; ++k)
            group = group << 8 | (k < n ? static_cast<unsigned char>(bytes[i + k]) : 0u);
        for (std::size_t k = 0; k < 4; ++k)
            text += k <= n ? digits[group >> (18 - 6 * k) & 63] : '=';
    }
    return text;
}

template <class T>
void add_array(Text& text, const char* type, const char* name, int components,
               const std::vector<T>& values) {
    const std::uint64_t size = values.size() * sizeof(T);
    std::string bytes(sizeof size + size, '\0');
    std::memcpy(bytes.data(), &size, sizeof size);
    if (size > 0) std::memcpy(bytes.data() + sizeof size, values.data(), size);
    add(text,
        "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"binary\">\n{}\n"
        "</DataArray>\n",
        type, name, components, base64(bytes));
}

/// The start of a file with one piece, up to its points.
void begin_vtp(Text& text, std::size_t points, std::size_t vertices, std::size_t lines) {
    add(text,
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" "
        "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<PolyData>\n"
        "<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"{}\" NumberOfLines=\"{}\" "
        "NumberOfStrips=\"0\" NumberOfPolys=\"0\">\n<Points>\n",
        points, vertices, lines);
}

std::string vtp_of(const Snapshot& s, const PinnedColumns* states) {
    const std::size_t n = s.size();
    std::vector<double> points(3 * n), velocity(3 * n), angle(n);
    std::vector<std::int64_t> connectivity(n), offsets(n), id(n);
    for (std::size_t i = 0; i < n; ++i) {
        const Vec2 p = s.position(i);
        points[3 * i] = p.x;
        points[3 * i + 1] = p.y;
        velocity[3 * i] = s.vx[i];
        velocity[3 * i + 1] = s.vy[i];
        angle[i] = s.orientation(i);
        connectivity[i] = id[i] = std::int64_t(i);
        offsets[i] = std::int64_t(i + 1);
    }
    Text text;
    begin_vtp(text, n, n, 0);
    add_array(text, "Float64", "Points", 3, points);
    add(text, "</Points>\n<Verts>\n");
    add_array(text, "Int64", "connectivity", 1, connectivity);
    add_array(text, "Int64", "offsets", 1, offsets);
    add(text, "</Verts>\n<PointData>\n");
    add_array(text, "Float64", "velocity", 3, velocity);
    add_array(text, "Float64", "angle", 1, angle);
    add_array(text, "Float64", "spin", 1, s.spin);
    if (s.are_spheres()) {
        add_array(text, "Float64", "spin_x", 1, s.spin_x);
        add_array(text, "Float64", "spin_y", 1, s.spin_y);
    }
    if (!s.turned.empty()) {
        std::vector<double> turned;
        for (std::size_t i = 0; i < n; ++i) {
            const Quaternion q = s.quaternion(i);
            turned.insert(turned.end(), {q.w, q.x, q.y, q.z});
        }
        add_array(text, "Float64", "turned", 4, turned);
    }
    add_array(text, "Float64", "radius", 1, s.radius);
    add_array(text, "Float64", "mass", 1, s.mass);
    add_array(text, "Int64", "id", 1, id);
    if (states) {
        add_array(text, "Float64", "pinned", 1, states->pinned);
        add_array(text, "Float64", "resident", 1, states->resident);
    }
    add(text, "</PointData>\n</Piece>\n</PolyData>\n</VTKFile>\n");
    return fmt::to_string(text);
}

/// The wall as one closed polygonal line.
std::string container_vtp_of(const Snapshot& s) {
    constexpr int sides = 180;
    std::vector<double> points;
    std::vector<std::int64_t> connectivity;
    for (int k = 0; k < sides; ++k) {
        const Vec2 p =
            s.container_centre + s.container_radius * unit_circle(double(k) / double(sides));
        points.insert(points.end(), {p.x, p.y, 0.0});
        connectivity.push_back(k);
    }
    connectivity.push_back(0);
    Text text;
    begin_vtp(text, sides, 0, 1);
    add_array(text, "Float64", "Points", 3, points);
    add(text, "</Points>\n<Lines>\n");
    add_array(text, "Int64", "connectivity", 1, connectivity);
    add_array(text, "Int64", "offsets", 1, std::vector<std::int64_t>{sides + 1});
    add(text, "</Lines>\n</Piece>\n</PolyData>\n</VTKFile>\n");
    return fmt::to_string(text);
}

std::string escaped(const std::string& text) {
    std::string out;
    for (const char c : text) {
        if (c == '&')
            out += "&amp;";
        else if (c == '<')
            out += "&lt;";
        else if (c == '"')
            out += "&quot;";
        else
            out += c;
    }
    return out;
}

/// Writes and publishes the frames, and returns the content of the index. If it fails, removes the
/// frames that it wrote.
std::string write_vtp_frames(const SnapshotSeries& series, const std::filesystem::path& folder,
                             const ExportOptions& options) {
    std::vector<std::filesystem::path> written;
    Text index;
    add(index,
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" "
        "byte_order=\"LittleEndian\">\n<Collection>\n");
    try {
        FilesystemSync frames(folder);  // one sync before the index, not one per frame
        write_frames(series, options, [&](std::uint64_t k, const Snapshot& s) {
            const auto add_part = [&](int part, const std::string& name, const std::string& vtp) {
                AtomicFile frame(folder / name);
                frame.append(vtp);
                frame.flush_buffer();
                frame.publish();
                written.push_back(folder / name);
                add(index, "<DataSet timestep=\"{}\" part=\"{}\" file=\"{}/{}\"/>\n", s.time(),
                    part, escaped(folder.filename().string()), name);
            };
            add_part(0, fmt::format("{:06}.vtp", k), vtp_of(s, states_of(series, k)));
            add_part(1, fmt::format("{:06}_container.vtp", k), container_vtp_of(s));
        });
        frames.sync();
    } catch (...) {
        std::error_code ignored;
        for (const auto& frame : written) std::filesystem::remove(frame, ignored);
        std::filesystem::remove(folder, ignored);  // fails if other files are in it
        throw;
    }
    add(index, "</Collection>\n</VTKFile>\n");
    return fmt::to_string(index);
}

/// An existing index is removed first, and the new one is written last. So an index never refers to
/// frames that are missing or belong to another recording.
void write_vtp(const SnapshotSeries& series, const std::filesystem::path& path,
               const ExportOptions& options) {
    std::filesystem::path folder = path;
    folder.replace_extension();
    if (folder == path) folder += "_frames";
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error)
        throw FileError(fmt::format("the folder '{}' could not be created: {}.", folder.string(),
                                    error.message()));
    require_replaceable(path);
    std::filesystem::remove(path, error);
    write_file_atomically(path, write_vtp_frames(series, folder, options));
}

// --- GSD (gsd.readthedocs.io, "File layer", version 2.0) -----------------------------------------

struct GsdHeader {
    std::uint64_t magic = 0x65DF65DF65DF65DF;
    std::uint64_t index_location = 0, index_allocated_entries = 0;
    std::uint64_t namelist_location = 0, namelist_allocated_entries = 0;
    std::uint32_t schema_version = 1u << 16 | 4u;
    std::uint32_t gsd_version = 2u << 16;
    char application[64] = "swirl";
    char schema[64] = "hoomd";
    char reserved[80] = {};
};
static_assert(sizeof(GsdHeader) == 256);

struct GsdEntry {
    std::uint64_t frame, N;
    std::int64_t location;
    std::uint32_t M;
    std::uint16_t id;
    std::uint8_t type, flags;
};
static_assert(sizeof(GsdEntry) == 32);

enum GsdType : std::uint8_t {
    gsd_u8 = 1,
    gsd_u32 = 3,
    gsd_u64 = 4,
    gsd_i8 = 5,
    gsd_f32 = 9,
    gsd_f64
};

class GsdWriter {
  public:
    /// Readers expect values for every name in the list.
    GsdWriter(AtomicFile& file, bool of_spheres, bool with_pinned) : file_(file) {
        file_.append({reinterpret_cast<const char*>(&header_), sizeof header_});
        if (of_spheres) names_.emplace_back("log/particles/rolling_spin");
        if (with_pinned)
            names_.insert(names_.end(), {"log/particles/pinned", "log/particles/resident"});
        std::string list;
        for (const std::string_view name : names_) list += std::string(name) + '\0';
        header_.namelist_location = file_.size();
        header_.namelist_allocated_entries = (list.size() + 63) / 64;
        list.resize(64 * header_.namelist_allocated_entries);
        file_.append(list);
    }
    template <class T>
    void add(std::string_view name, GsdType type, const std::vector<T>& values,
             std::uint32_t columns) {
        const auto id = std::find(names_.begin(), names_.end(), name) - names_.begin();
        entries_.push_back({frame_, values.size() / columns, std::int64_t(file_.size()), columns,
                            std::uint16_t(id), type, 0});
        file_.append({reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)});
    }
    void end_frame() { ++frame_; }
    void finish() {
        // Readers find entries by bisection. A zero entry marks the end.
        std::stable_sort(entries_.begin(), entries_.end(), [](const auto& a, const auto& b) {
            return a.frame != b.frame ? a.frame < b.frame : a.id < b.id;
        });
        entries_.push_back({});
        header_.index_location = file_.size();
        header_.index_allocated_entries = entries_.size();
        file_.append(
            {reinterpret_cast<const char*>(entries_.data()), entries_.size() * sizeof(GsdEntry)});
        file_.replace(0, {reinterpret_cast<const char*>(&header_), sizeof header_});
    }

  private:
    std::vector<std::string_view> names_{"configuration/step",
                                         "configuration/dimensions",
                                         "configuration/box",
                                         "particles/N",
                                         "particles/types",
                                         "particles/typeid",
                                         "particles/mass",
                                         "particles/diameter",
                                         "particles/moment_inertia",
                                         "particles/position",
                                         "particles/orientation",
                                         "particles/velocity",
                                         "particles/angmom",
                                         "log/particles/angular_velocity",
                                         "log/time"};
    AtomicFile& file_;
    GsdHeader header_;
    std::vector<GsdEntry> entries_;
    std::uint64_t frame_ = 0;
};

/// HOOMD's angular momentum, the quaternion 2 q L with L = q̄ (I ω) q in the body's axes; this
/// equals 2 (I ω) q. Zero if the spin or the moment of inertia is unknown.
Quaternion angular_momentum(const Snapshot& s, std::size_t i, const Quaternion& q) {
    const double twice = 2.0 * or_zero(s.inertia[i]);
    const Vec2 rolling = s.are_spheres() ? Vec2{s.spin_x[i], s.spin_y[i]} : Vec2{0.0, 0.0};
    return Quaternion{0.0, twice * rolling.x, twice * rolling.y, twice * or_zero(s.spin[i])} * q;
}

/// Species, masses, sizes and moments of inertia.
void add_constants(GsdWriter& gsd, const Snapshot& s) {
    constexpr std::uint32_t name_size = 15;
    const auto species = h5md::species_of(s.radius, s.mass);
    const auto last = species.empty() ? 0 : *std::max_element(species.begin(), species.end());
    std::vector<char> types;
    for (std::int64_t k = 0; k <= last; ++k)
        for (const char c : fmt::format("D{:<14}", k + 1)) types.push_back(c == ' ' ? '\0' : c);
    std::vector<float> mass(s.mass.begin(), s.mass.end()), diameter, inertia;
    for (std::size_t i = 0; i < s.size(); ++i) {
        diameter.push_back(float(2.0 * s.radius[i]));
        const float about_z = float(or_zero(s.inertia[i]));
        const float about_xy = s.are_balls() ? about_z : 0.0f;
        inertia.insert(inertia.end(), {about_xy, about_xy, about_z});
    }
    gsd.add("particles/types", gsd_i8, types, name_size);
    gsd.add("particles/typeid", gsd_u32, std::vector<std::uint32_t>(species.begin(), species.end()),
            1);
    gsd.add("particles/mass", gsd_f32, mass, 1);
    gsd.add("particles/diameter", gsd_f32, diameter, 1);
    gsd.add("particles/moment_inertia", gsd_f32, inertia, 3);
}

void add_motion(GsdWriter& gsd, const Snapshot& s, const PinnedColumns* states) {
    std::vector<float> position, orientation, velocity, momentum;
    for (std::size_t i = 0; i < s.size(); ++i) {
        const Vec2 p = s.position(i);
        const double half = 0.5 * or_zero(s.orientation(i));
        const Quaternion q = s.turned.empty() ? Quaternion{std::cos(half), 0.0, 0.0, std::sin(half)}
                                              : s.quaternion(i);
        position.insert(position.end(), {float(p.x), float(p.y), 0.0f});
        orientation.insert(orientation.end(), {float(q.w), float(q.x), float(q.y), float(q.z)});
        velocity.insert(velocity.end(), {float(s.vx[i]), float(s.vy[i]), 0.0f});
        const Quaternion L = angular_momentum(s, i, q);
        momentum.insert(momentum.end(), {float(L.w), float(L.x), float(L.y), float(L.z)});
    }
    gsd.add("particles/position", gsd_f32, position, 3);
    gsd.add("particles/orientation", gsd_f32, orientation, 4);
    gsd.add("particles/velocity", gsd_f32, velocity, 3);
    gsd.add("particles/angmom", gsd_f32, momentum, 4);
    gsd.add("log/particles/angular_velocity", gsd_f64, s.spin, 1);
    if (states) {
        gsd.add("log/particles/pinned", gsd_f64, states->pinned, 1);
        gsd.add("log/particles/resident", gsd_f64, states->resident, 1);
    }
    if (!s.are_spheres()) return;
    std::vector<double> rolling;
    for (std::size_t i = 0; i < s.size(); ++i)
        rolling.insert(rolling.end(), {s.spin_x[i], s.spin_y[i]});
    gsd.add("log/particles/rolling_spin", gsd_f64, rolling, 2);
}

void write_gsd(const SnapshotSeries& series, AtomicFile& file, const ExportOptions& options) {
    GsdWriter gsd(file, has_spheres(series), series.pinned != nullptr);
    const float width = float(2.0 * series.reach);
    write_frames(series, options, [&](std::uint64_t k, const Snapshot& s) {
        gsd.add("configuration/step", gsd_u64, std::vector<std::uint64_t>{k}, 1);
        if (k == options.first) {
            gsd.add("configuration/dimensions", gsd_u8, std::vector<std::uint8_t>{2}, 1);
            gsd.add("configuration/box", gsd_f32, std::vector<float>{width, width, 1, 0, 0, 0}, 1);
        }
        gsd.add("particles/N", gsd_u32, std::vector<std::uint32_t>{std::uint32_t(s.size())}, 1);
        if (k == options.first || !series.same_discs()) add_constants(gsd, s);
        add_motion(gsd, s, states_of(series, k));
        gsd.add("log/time", gsd_f64, std::vector<double>{s.time()}, 1);
        gsd.end_frame();
    });
    gsd.finish();
}

template <auto write>
void write_single_file(const SnapshotSeries& series, const std::filesystem::path& path,
                       const ExportOptions& options) {
    AtomicFile file(path);
    write(series, file, options);
    file.finish();
}

constexpr std::array formats{
    ExportFormat{"lammps", ".dump", "OVITO, VMD, MDAnalysis", write_single_file<write_lammps>},
    ExportFormat{"xyz", ".xyz", "extended XYZ: OVITO, ASE", write_single_file<write_xyz>},
    ExportFormat{"vtp", ".pvd", "ParaView, VTK", write_vtp},
    ExportFormat{"csv", ".csv", "trackpy: positions in pixels", write_single_file<write_csv>},
    // Another ending than that of csv, so that both formats have different default file names.
    ExportFormat{"table", ".table.csv", "CSV with all quantities", write_single_file<write_table>},
    ExportFormat{"gsd", ".gsd", "HOOMD", write_single_file<write_gsd>},
};

}  // namespace

std::span<const ExportFormat> export_formats() { return formats; }

const ExportFormat* export_format(std::string_view name) {
    for (const ExportFormat& format : formats)
        if (format.name == name) return &format;
    return nullptr;
}

std::uint64_t exported_frames(std::uint64_t frames, const ExportOptions& options) {
    const std::uint64_t end = options.last < frames ? options.last + 1 : frames;
    return options.first < end ? (end - options.first - 1) / options.stride + 1 : 0;
}

void export_series(const SnapshotSeries& series, const ExportFormat& format,
                   const std::filesystem::path& path, const ExportOptions& options) {
    format.write(series, path, options);
}

}  // namespace swirl
