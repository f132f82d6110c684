#include "swirl/run/config.hpp"

#include <fmt/format.h>

#include <cmath>
#include <tuple>
#include <vector>

#include "swirl/engine/partial_friction.hpp"
#include "swirl/engine/placement.hpp"
#include "swirl/math/random.hpp"
#include "swirl/math/unit_circle.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/initial_parameter.hpp"
#include "swirl/run/particle_sizes.hpp"
#include "swirl/run/path_parameter.hpp"
#include "swirl/run/ramp.hpp"

namespace swirl {
namespace {

std::optional<Message> out_of_interval(const MessageValue& name, double value, double from,
                                       double to) {
    if (value >= from && value <= to) return {};
    return Message("out_of_range", {name, {"value", value}, {"from", from}, {"to", to}});
}

/// The default contact duration is allowed in runs that do not use it, whatever the period.
std::optional<Message> contact_longer_than_period(const RunConfig& c) {
    if (c.contact_duration <= c.period) return {};
    const bool is_default = c.contact_duration == RunConfig{}.contact_duration;
    if (is_default && !c.uses_contact_duration()) return {};
    if (!is_default)
        return out_of_interval({"name", "--contact-duration"}, c.contact_duration, 0.0, c.period);
    return Message("short_period", {{"period", c.period}, {"duration", c.contact_duration}});
}

/// Ranges that depend on other parameters.
std::optional<Message> problem_with_ratios(const RunConfig& c) {
    if (auto message = contact_longer_than_period(c)) return message;
    if (!c.mixture) return {};
    if (const auto& percent = c.mixture->percent) {
        if (!(*percent > 0.0 && *percent <= 100.0))
            return Message("mixture_share", {{"percent", *percent}});
        if (c.mixture->count < 1)
            return Message("mixture_of_none",
                           {{"percent", *percent}, {"discs", c.discs}, body_of(c)});
    }
    if (c.mixture->count < 1 || c.mixture->count > c.discs)
        return Message("mixture_count", {{"count", c.mixture->count},
                                         {"discs", c.discs},
                                         {"radius", c.mixture->radius},
                                         body_of(c)});
    if (auto message = out_of_interval({"name", Message("mixture_radius")}, c.mixture->radius,
                                       smallest_value, largest_value))
        return message;
    return out_of_interval({"name", Message("mixture_mass")}, c.mixture->mass, smallest_value,
                           largest_value);
}

/// Does not name --discs, because a search for a crossing has no such option.
Message hint_on_capacity(const RunConfig& c) { return {"fewer_particles", {body_of(c)}}; }

/// The only upper bound for unequal discs is the area of the container.
std::optional<Message> problem_with_area(const RunConfig& c) {
    const double R = c.container_radius;
    double area = 0.0;
    if (c.mixture) {
        const auto count = static_cast<double>(c.mixture->count);
        area = (static_cast<double>(c.discs) - count) * c.radius * c.radius +
               count * c.mixture->radius * c.mixture->radius;
    } else {
        for (const ParticleProperties& particle : particles_of(c))
            area += particle.radius * particle.radius;
    }
    if (area <= R * R) return {};
    return Message("too_much_area", {{"discs", c.discs},
                                     body_of(c),
                                     {"container", R},
                                     with_decimals("percent", 100.0 * area / (R * R), 0)}) +
           hint_on_capacity(c);
}

/// The largest number of discs of one size, by the known arrangements or, in larger containers, by
/// a bound for all arrangements.
struct Capacity {
    bool is_of_known;  // it holds for the known arrangements only
    double maximum;
};
Capacity capacity(const RunConfig& c) {
    if (const auto n = discs_in_densest_known_arrangement(c.radius, c.container_radius))
        return {true, static_cast<double>(*n)};
    return {false, max_discs_in_container(c.radius, c.container_radius)};
}

/// In radii of the smallest disc. The centres of Verlet skins are stored in single precision. The
/// narrowest skin, 0.005 radii, must exceed their rounding error, 6·10⁻⁸ of the distance.
constexpr double max_container_ratio = 5e4;

std::optional<Message> problem_with_size(const RunConfig& c) {
    const double R = c.container_radius;
    const auto [smallest, largest] = radius_bounds(c);
    if (largest >= R)
        return Message("particle_too_large",
                       {body_of(c),
                        {"radius", largest},
                        {"container", R},
                        c.sizes ? MessageValue("what", Message("largest_size"))
                                : MessageValue("what", "--radius")});
    if (R > max_container_ratio * smallest)
        return Message(
            "container_too_large",
            {{"container", R}, {"times", max_container_ratio}, body_of(c), {"radius", smallest}});
    if (has_unequal_sizes(c)) return problem_with_area(c);
    const auto [is_of_known, maximum] = capacity(c);
    if (static_cast<double>(c.discs) <= maximum) return {};
    return Message(is_of_known ? Code("too_many_known") : Code("too_many"),
                   {{"discs", c.discs},
                    body_of(c),
                    {"container", R},
                    with_decimals("most", maximum, 0)}) +
           hint_on_capacity(c);
}

/// A contact within the contact duration is delayed: the particles separate with half of the speed
/// that the floor's friction removes in that time (docs/explanation/spheres.md). This separation
/// speed must be small compared with the speed of the container. A ratio of 0.3 changes ϖ by less
/// than one standard error; a ratio of 3 suppresses the counterrotation.
std::optional<Message> problem_with_floor_friction(const RunConfig& c) {
    constexpr double max_ratio = 0.5;
    const double speed = c.amplitude * c.omega();
    const double separation = 0.5 * c.floor_friction * c.gravity * c.contact_duration;
    if (!c.floor || c.amplitude == 0.0 || separation <= max_ratio * speed) return {};
    return Message("floor_friction_too_large",
                   {{"friction", c.floor_friction},
                    {"gravity", c.gravity},
                    {"duration", c.contact_duration},
                    rounded("change", 2.0 * separation / speed, 2),
                    rounded("most", 2.0 * max_ratio * speed / c.contact_duration, 3)});
}

/// With less resistance than the floor's friction, a sphere that slows down does not slide
/// (floor.hpp).
std::optional<Message> problem_with_rolling_resistance(const RunConfig& c) {
    if (c.rolling_resistance <= c.floor_friction) return {};
    return Message("rolling_resistance_too_large",
                   {{"resistance", c.rolling_resistance}, {"friction", c.floor_friction}});
}

std::optional<Message> problem_with_body(const RunConfig& c) {
    if (c.frictionless != Frictionless::none && c.shape() != Shape::disc)
        return Message("frictionless_only_discs");
    if (c.body == Shape::sphere) return {};
    const RunConfig defaults;
    for (const Parameter& p : run_parameters) {
        if (!needs_spheres(p.applies_to)) continue;
        const double value = c.*p.number();
        if (value != defaults.*p.number())
            return Message("only_for_spheres", {{"name", option_name(p.name)}, {"value", value}});
    }
    return {};
}

std::optional<Message> problem_with_units(const RunConfig& c) {
    if (c.length_unit.empty() || c.radius == 1.0) return {};
    return Message("unit_of_radius", {{"unit", c.length_unit}, {"radius", c.radius}});
}

std::optional<Message> problem_with_warmup(const RunConfig& c) {
    if (!c.warmup || *c.warmup == 0) return {};
    if (c.periods) {
        if (*c.warmup < *c.periods) return {};
        return Message("warmup_of_all_periods", {{"warmup", *c.warmup}, {"periods", *c.periods}});
    }
    // Every period has at least the events at the vertices of the path.
    const std::int64_t segments = path_vertices(c);
    if (*c.warmup < c.events / segments + 1) return {};
    return Message("warmup_of_all_events",
                   {{"warmup", *c.warmup}, {"events", c.events}, {"periods", c.events / segments}});
}

}  // namespace

std::optional<Message> problem(const RunConfig& config) {
    if (auto message = out_of_range(config)) return message;
    if (auto message = problem_with_ratios(config)) return message;
    if (auto message = problem_with_sizes(config)) return message;
    if (auto message = problem_with_size(config)) return message;
    if (auto message = problem_with_body(config)) return message;
    if (auto message = problem_with_path(config)) return message;
    if (auto message = problem_with_units(config)) return message;
    if (auto message = problem_with_floor_friction(config)) return message;
    if (auto message = problem_with_rolling_resistance(config)) return message;
    if (auto message = problem_with_warmup(config)) return message;
    return problem_with_ramps(config);
}

Tuning stopped_by(const std::atomic<bool>* stop) {
    Tuning tuning;
    if (stop) tuning.is_stopped = [stop] { return stop->load(std::memory_order_relaxed); };
    return tuning;
}

const char* body_word(const RunConfig& config) {
    return config.body == Shape::sphere ? "sphere" : "disc";
}

MessageValue body_of(const RunConfig& config) {
    return {"body", config.body == Shape::sphere ? Message("sphere") : Message("disc")};
}

namespace {

/// The coefficients of these contacts, from the rows that have one (parameter_table.cpp).
Surface surface_of(Contacts contacts, const RunConfig& config) {
    Surface surface;
    for (const Parameter& p : run_parameters)
        if (p.contacts == Contacts::all || p.contacts == contacts)
            surface.*p.coefficient = config.*p.number();
    return surface;
}

}  // namespace

InitialState without_discs(const RunConfig& c, const ContainerPath& path) {
    InitialState scene{
        .path = path,
        .container_radius = c.container_radius,
        .disc_surface = surface_of(Contacts::of_particles, c),
        .wall_surface = surface_of(Contacts::with_wall, c),
        .shape = c.shape(),
        .floor = {.deceleration = c.floor ? c.floor_friction * c.gravity : 0.0,
                  .bodies_lie_flat = c.shape() == Shape::coin,
                  .rolling_resistance = c.floor ? c.rolling_resistance * c.gravity : 0.0},
        .law = without_friction_in(c.frictionless)};
    if (c.frictionless == Frictionless::wall) scene.wall_surface.mu = 0.0;
    return scene;
}

namespace {

Message no_placement_message(const RunConfig& c) {
    Message message("not_placed", {{"discs", c.discs},
                                   body_of(c),
                                   {"radii", radii_text(c)},
                                   {"container", c.container_radius}});
    if (!has_unequal_sizes(c)) {
        const auto [is_of_known, maximum] = capacity(c);
        message +=
            Message(is_of_known ? Code("placement_may_fail_known") : Code("placement_may_fail"),
                    {with_decimals("most", maximum, 0)});
    }
    return message + hint_on_capacity(c);
}

}  // namespace

InitialState make_initial_state(const RunConfig& c, const std::atomic<bool>* stop) {
    // A configuration may have been changed since resolve() validated it.
    if (const auto message = problem(c)) throw_usage_error(*message);
    if (!c.initial.empty()) return given_initial_state(c);
    const std::vector<ParticleProperties> particles = particles_of(c);
    std::vector<double> radii;
    radii.reserve(particles.size());
    for (const ParticleProperties& particle : particles) radii.push_back(particle.radius);

    const auto centres =
        place_discs(radii, c.container_radius, c.seed, stopped_by(stop).is_stopped);
    if (!centres && stop && stop->load())
        throw_interrupted(fmt::format("stopped during the placement of the {}s.", body_word(c)));
    if (!centres) throw_usage_error(no_placement_message(c));

    InitialState state = surroundings_in(c, 0);
    // A tenth of the container's speed for the paper's parameters. It does not depend on that
    // speed, because the discs must also move in a container at rest.
    const double max_initial_speed = 0.02 * c.container_radius * c.omega();
    const Segment& segment = state.path.segments.front();
    // A separate stream: the velocities must not repeat the numbers that placed the discs.
    constexpr std::uint64_t stream = 0x76656c6f63697479;  // "velocity" in ASCII
    Random random(Random(c.seed ^ stream).bits());
    state.discs.reserve(particles.size());
    for (std::size_t i = 0; i < particles.size(); ++i) {
        if (stop && stop->load()) throw_interrupted("stopped before the first event.");
        const auto& [radius, mass, inertia, can_spin] = particles[i];
        Disc disc{.position = segment.start + (*centres)[i],
                  .velocity = segment.velocity + random.in_disc(max_initial_speed),
                  .angle = 0.0,
                  .spin = 0.0,
                  .time = 0.0,
                  .radius = radius,
                  .mass = mass,
                  .inertia = inertia};
        disc.can_spin = can_spin;
        state.discs.push_back(disc);
    }
    return state;
}

}  // namespace swirl
