#include "swirl/run/initial_parameter.hpp"

#include <fmt/format.h>

#include "swirl/engine/validate.hpp"
#include "swirl/run/config.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/parameter_readers.hpp"
#include "swirl/run/particle_sizes.hpp"
#include "swirl/run/ramp.hpp"

namespace swirl {
namespace {

constexpr std::string_view states_word = "states";

/// Squares and products of larger numbers could overflow. The parameters of a run cannot lead to
/// speeds of this size.
constexpr double largest_given = 1e15;

std::optional<std::string> problem_with_numbers(std::size_t i, const Disc& d) {
    constexpr double any = largest_given;
    const struct {
        const char* name;
        double value, from, to;
    } numbers[] = {{"x", d.position.x, -any, any},
                   {"y", d.position.y, -any, any},
                   {"vx", d.velocity.x, -any, any},
                   {"vy", d.velocity.y, -any, any},
                   {"angle", d.angle, -any, any},
                   {"spin", d.spin, -any, any},
                   {"radius", d.radius, smallest_value, largest_value},
                   {"mass", d.mass, smallest_value, largest_value},
                   {"inertia", d.inertia, 1e-30, 1e30}};
    for (const auto& [name, value, from, to] : numbers)
        if (!(value >= from && value <= to))
            return fmt::format("{} of disc {} is {}, but it must be a number from {} to {}.", name,
                               i, value, from, to);
    if (d.can_spin != 0.0 && d.can_spin != 1.0)
        return fmt::format("can_spin of disc {} is {}, but it must be 0 or 1.", i, d.can_spin);
    if (d.can_spin == 0.0 && d.spin != 0.0)
        return fmt::format("disc {} has the spin {}, but it cannot spin.", i, d.spin);
    return {};
}

InitialState scene_of(const RunConfig& c) {
    InitialState scene = surroundings_in(c, 0);
    const std::vector<ParticleProperties> particles = particles_of(c);
    for (std::size_t i = 0; i < particles.size(); ++i) {
        const auto& [position, velocity, spin] = c.initial[i];
        const auto& [radius, mass, inertia, can_spin] = particles[i];
        Disc disc{.position = position,
                  .velocity = velocity,
                  .angle = 0.0,
                  .spin = spin,
                  .time = 0.0,
                  .radius = radius,
                  .mass = mass,
                  .inertia = inertia};
        disc.can_spin = can_spin;
        scene.discs.push_back(disc);
    }
    return scene;
}

}  // namespace

void read_initial(std::string_view text, const ParameterTexts& given, RunConfig& config) {
    if (!text.starts_with(states_word))
        throw_usage_error(fmt::format(
            "--initial is '{}', but it must be a CSV file with the columns x, y, vx, vy and spin.",
            text));
    text.remove_prefix(states_word.size());
    for (const std::string_view part : split(text, " ")) {
        if (part.empty()) continue;
        const auto texts = split(part, ":");
        std::vector<double> n;
        for (const std::string_view number : texts)
            if (const auto value = read_number(number)) n.push_back(*value);
        if (n.size() != 5 || texts.size() != 5)
            throw_usage_error(fmt::format(
                "disc {} of --initial is '{}', but it must be X:Y:VX:VY:SPIN in finite numbers.",
                config.initial.size(), part));
        config.initial.push_back({{n[0], n[1]}, {n[2], n[3]}, n[4]});
    }
    if (config.initial.empty()) throw_usage_error("--initial has no discs.");
    if (!given.contains("discs")) config.discs = static_cast<std::int64_t>(config.initial.size());
}

ParameterValue write_initial(const RunConfig& config) {
    if (config.initial.empty()) return {};
    std::string text(states_word);
    for (const auto& [p, v, spin] : config.initial)
        text += fmt::format(" {}:{}:{}:{}:{}", p.x, p.y, v.x, v.y, spin);
    return text;
}

std::optional<std::string> problem_with_given_discs(const InitialState& scene, const Vec2& centre,
                                                    double tolerance) {
    for (std::size_t i = 0; i < scene.discs.size(); ++i)
        if (auto message = problem_with_numbers(i, scene.discs[i])) return message;
    return overlap_in(scene, centre, tolerance);
}

std::optional<Message> problem_with_initial(const RunConfig& c) {
    if (c.initial.empty()) return {};
    if (c.initial.size() > max_listed_sizes)
        return without_code(fmt::format("--initial has more than {} discs.", max_listed_sizes));
    if (static_cast<std::int64_t>(c.initial.size()) != c.discs)
        return without_code(
            fmt::format("--initial has {}, but the other options give {}.\nhint: omit --discs.",
                        counted(static_cast<std::int64_t>(c.initial.size()), "disc"), c.discs));
    if (c.shape() != Shape::disc)
        return without_code(
            "--initial is only for discs without a floor.\nhint: omit --body and --floor.");
    const InitialState scene = scene_of(c);
    const auto message =
        problem_with_given_discs(scene, scene.path.segments.front().start, initial_overlap);
    if (!message) return {};
    return without_code(fmt::format(
        "--initial: {}\nhint: discs count from 0; positions are in the lab frame.", *message));
}

InitialState given_initial_state(const RunConfig& config) {
    if (const auto message = problem_with_initial(config)) throw_usage_error(*message);
    return scene_of(config);
}

}  // namespace swirl
