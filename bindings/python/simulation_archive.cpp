#include "simulation_archive.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "custom_scene.hpp"
#include "swirl/engine/validate.hpp"
#include "swirl/io/checksum.hpp"
#include "swirl/io/file_error.hpp"
#include "swirl/io/state_archive.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/json.hpp"
#include "swirl/run/particle_sizes.hpp"
#include "swirl/run/ramp.hpp"

namespace swirl::python {
namespace {

constexpr std::string_view archive_head = "swirl simulation 3\n";

[[noreturn]] void reject_archive(std::string_view reason) {
    throw FileError(fmt::format("not a swirl simulation that can continue: {}.", reason));
}

bool same_segments(const std::vector<Segment>& a, const std::vector<Segment>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](const Segment& x, const Segment& y) {
                          return x.begin == y.begin && x.end == y.end && x.start.x == y.start.x &&
                                 x.start.y == y.start.y && x.velocity.x == y.velocity.x &&
                                 x.velocity.y == y.velocity.y && x.turn_rate == y.turn_rate;
                      });
}

/// The path must be that of the parameters (`path`), or what polygon() makes of its vertices.
void require_path(const std::vector<Segment>& segments, const ContainerPath& path,
                  const RunConfig& config, bool is_custom) {
    if (same_segments(segments, path.segments)) return;
    if (!is_custom) reject_archive("its path does not match its parameters");
    Numbers vertices(std::vector<py::ssize_t>{signed_size(segments.size()), 2}),
        times(signed_size(segments.size()));
    for (std::size_t k = 0; k < segments.size(); ++k) {
        vertices.mutable_data()[2 * k] = segments[k].start.x;
        vertices.mutable_data()[2 * k + 1] = segments[k].start.y;
        times.mutable_data()[k] = segments[k].begin;
    }
    if (!same_segments(segments, polygon(vertices, times, config.period).segments))
        reject_archive("a segment of its path does not lead to the next one");
}

/// Custom discs must be in the ranges of discs given as arrays, others must be those of the
/// parameters.
void require_discs(const InitialState& scene, const RunConfig& config, bool is_custom,
                   double clock) {
    std::vector<double> radius, mass, inertia, can_spin;
    InitialState now = scene;
    for (Disc& d : now.discs) {
        radius.push_back(d.radius);
        mass.push_back(d.mass);
        inertia.push_back(d.inertia);
        can_spin.push_back(d.can_spin);
        d = d.at(clock);
    }
    if (is_custom) {
        // Long-lasting contacts leave overlaps larger than rounding errors.
        constexpr double tolerance = 1e-3;
        return require_valid_discs(now, scene.path.segment_at(clock).position_at(clock), tolerance);
    }
    const std::vector<ParticleProperties> particles = particles_of(config);
    bool same = radius.size() == particles.size();
    for (std::size_t i = 0; same && i < particles.size(); ++i)
        same = radius[i] == particles[i].radius && mass[i] == particles[i].mass &&
               inertia[i] == particles[i].inertia && can_spin[i] == particles[i].can_spin;
    if (!same) reject_archive("its discs do not match its parameters");
}

}  // namespace

std::string archive_bytes(ArchivedSimulation simulation) {
    StateWriter write;
    std::string config = config_text(simulation.config);
    write(config, simulation.is_custom, simulation.scene.path.segments);
    Progress& progress = simulation.progress;
    write(progress.periods, progress.clock, progress.segment, progress.events);
    write(simulation.scene.discs);
    const std::uint64_t sum = checksum(write.bytes());
    std::string bytes(archive_head);
    bytes.append(reinterpret_cast<const char*>(&sum), sizeof sum);
    return bytes + write.bytes();
}

ArchivedSimulation read_archive(std::string_view bytes) {
    std::uint64_t sum = 0;
    if (!bytes.starts_with(archive_head) || bytes.size() < archive_head.size() + sizeof sum)
        reject_archive("it has another beginning or version");
    std::memcpy(&sum, bytes.data() + archive_head.size(), sizeof sum);
    bytes.remove_prefix(archive_head.size() + sizeof sum);
    if (checksum(bytes) != sum) reject_archive("it is damaged");
    StateReader read(bytes);
    std::string text;
    std::vector<Segment> segments;
    std::vector<Disc> discs;
    ArchivedSimulation archived;
    Progress& progress = archived.progress;
    read(text, archived.is_custom, segments);
    read(progress.periods, progress.clock, progress.segment, progress.events);
    read(discs);
    read.expect_end();
    try {
        archived.config = resolve(parameters_in(text));
        const RunConfig& config = archived.config;
        if (archived.is_custom && config.shape() != Shape::disc)
            reject_archive("only discs can be given as arrays");
        if (progress.periods < 0) reject_archive("its number of periods is negative");
        archived.scene = surroundings_in(config, progress.periods);
        require_path(segments, archived.scene.path, config, archived.is_custom);
        archived.scene.path.segments = std::move(segments);
        archived.scene.discs = std::move(discs);
        if (const auto problem = validate(archived.scene, progress))
            reject_archive(std::string_view(*problem).substr(0, problem->size() - 1));
        require_discs(archived.scene, config, archived.is_custom, progress.clock);
        return archived;
    } catch (const UsageError& error) {
        reject_archive(error.what());
    }
}

}  // namespace swirl::python
