#include "swirl/run/config.hpp"

#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "swirl/engine/placement.hpp"
#include "swirl/math/random.hpp"
#include "swirl/run/failure.hpp"

namespace swirl {
namespace {

std::optional<std::string> out_of_interval(const char* name, double value, double from, double to) {
    if (value >= from && value <= to) return {};
    return fmt::format("{} is {}, but it must be a number from {} to {}.", name, value, from, to);
}

/// Where no contact asks for it, the default of the contact duration restricts nothing.
std::optional<std::string> contact_longer_than_period(const RunConfig& c) {
    if (c.contact_duration <= c.period) return {};
    const bool is_default = c.contact_duration == RunConfig{}.contact_duration;
    if (is_default && !c.uses_contact_duration()) return {};
    if (!is_default)
        return out_of_interval("--contact-duration", c.contact_duration, 0.0, c.period);
    return fmt::format(
        "The period is {}, but the contact duration, {} by default, must not be longer; give a "
        "--contact-duration from 0 to {}, or a longer period.",
        c.period, c.contact_duration, c.period);
}

/// Ranges that depend on other parameters.
std::optional<std::string> out_of_proportion(const RunConfig& c) {
    if (auto answer = contact_longer_than_period(c)) return answer;
    if (!c.mixture) return {};
    if (c.mixture->count < 1 || c.mixture->count > c.discs)
        return fmt::format(
            "the count in --mixture is {}, but it must be a whole number from 1 to {}.",
            c.mixture->count, c.discs);
    if (auto answer = out_of_interval("the radius in --mixture", c.mixture->radius, smallest_value,
                                      largest_value))
        return answer;
    return out_of_interval("the mass in --mixture", c.mixture->mass, smallest_value, largest_value);
}

/// Names no option for the number: a search has no --discs.
std::string advice_on_room(const RunConfig& c) {
    return fmt::format("fewer {}s or a larger --container-radius would be right.", body_word(c));
}

/// Of a mixture it is only known that it cannot cover more than all there is.
std::optional<std::string> does_not_cover(const RunConfig& c) {
    const double R = c.container_radius;
    const auto count = static_cast<double>(c.mixture->count);
    const double area = (static_cast<double>(c.discs) - count) * c.radius * c.radius +
                        count * c.mixture->radius * c.mixture->radius;
    if (area <= R * R) return {};
    return fmt::format(
        "{} {}s do not fit into a container of radius {}: together they would cover {:.0f} % of "
        "it; {}",
        c.discs, body_word(c), R, 100.0 * area / (R * R), advice_on_room(c));
}

/// In radii of the smallest disc. The centres of Verlet skins are held in single precision, and the
/// narrowest skin, 0.005 radii, must be wider than their rounding, 6·10⁻⁸ of the distance.
constexpr double widest_container = 5e4;

std::optional<std::string> does_not_fit(const RunConfig& c) {
    const double R = c.container_radius;
    const double big = c.mixture ? std::fmax(c.radius, c.mixture->radius) : c.radius;
    if (big >= R)
        return fmt::format(
            "A {} of radius {} does not fit into a container of radius {}: --container-radius "
            "must be larger than --radius.",
            body_word(c), big, R);
    const double small = c.mixture ? std::fmin(c.radius, c.mixture->radius) : c.radius;
    if (R > widest_container * small)
        return fmt::format(
            "A container of radius {} is more than {} times as large as a {} of radius {}, and "
            "the search for neighbours is not as fine as that; a smaller --container-radius would "
            "be right.",
            R, widest_container, body_word(c), small);
    if (c.mixture) return does_not_cover(c);
    const double maximum = max_discs_in_container(c.radius, R);
    if (static_cast<double>(c.discs) <= maximum) return {};
    return fmt::format(
        "{} {}s do not fit into a container of radius {}, where no arrangement holds more than "
        "{:.0f}; {}",
        c.discs, body_word(c), R, maximum, advice_on_room(c));
}

/// What only a floor does.
std::optional<std::string> not_without_floor(const RunConfig& c) {
    if (c.floor) return {};
    const RunConfig usual;
    const auto answer = [](const char* name, double value) {
        return fmt::format("{} is {}, but there is no floor; --floor sliding would be right.", name,
                           value);
    };
    if (c.floor_friction != usual.floor_friction)
        return answer("--floor-friction", c.floor_friction);
    if (c.gravity != usual.gravity) return answer("--gravity", c.gravity);
    if (c.rolling_resistance != usual.rolling_resistance)
        return answer("--rolling-resistance", c.rolling_resistance);
    return {};
}

/// A contact that would happen within the contact duration is put off by letting the bodies part
/// with half of what the floor's friction takes from them in that time (docs/spheres.md). That must
/// stay small beside the speed of the container: 0.3 of it changes ϖ by less than one standard
/// error, 3 of it takes the counterrotation away.
std::optional<std::string> floor_too_rough(const RunConfig& c) {
    constexpr double bearable = 0.5;
    const double speed = c.amplitude * c.omega();
    const double parting = 0.5 * c.floor_friction * c.gravity * c.contact_duration;
    if (!c.floor || c.amplitude == 0.0 || parting <= bearable * speed) return {};
    return fmt::format(
        "--floor-friction {} times --gravity {} is too much for --contact-duration {}: within it "
        "the floor changes velocities by {:.2g} of the container's speed. A product below {:.3g} "
        "would be right.",
        c.floor_friction, c.gravity, c.contact_duration, 2.0 * parting / speed,
        2.0 * bearable * speed / c.contact_duration);
}

/// Up to the floor's friction a sphere that slows down does not slide (floor.hpp).
std::optional<std::string> resists_too_much(const RunConfig& c) {
    if (c.rolling_resistance <= c.floor_friction) return {};
    return fmt::format(
        "--rolling-resistance is {}, but it must not be above --floor-friction, {}: the spheres "
        "would slide instead of rolling.",
        c.rolling_resistance, c.floor_friction);
}

/// What is of spheres alone, and what nobody on a floor can do.
std::optional<std::string> not_for_this_body(const RunConfig& c) {
    if (c.body == Shape::disc) {
        if (c.rolling_resistance != 0.0)
            return fmt::format(
                "--rolling-resistance is {}, but discs do not roll; --body sphere would be right.",
                c.rolling_resistance);
        if (c.vertical_disc != 1.0)
            return fmt::format(
                "--vertical-disc is {}, but discs do not slip vertically; --body sphere would be "
                "right.",
                c.vertical_disc);
        if (c.vertical_wall != 1.0)
            return fmt::format(
                "--vertical-wall is {}, but discs do not slip vertically; --body sphere would be "
                "right.",
                c.vertical_wall);
    }
    if (c.path == PathShape::circle && c.shape() != Shape::disc)
        return "--path is circle, but on it the friction of the floor would turn while a body "
               "slides, and its flight be no parabola; --path polygon would be right.";
    return {};
}

std::optional<std::string> warmup_too_long(const RunConfig& c) {
    if (!c.warmup || *c.warmup == 0) return {};
    if (c.periods) {
        if (*c.warmup < *c.periods) return {};
        return fmt::format(
            "--warmup is {} periods, but the whole run is only --periods {}: the warm-up must be "
            "shorter than the run.",
            *c.warmup, *c.periods);
    }
    // Every swirl has at least the events at the ends of its legs.
    const std::int64_t segments = c.path == PathShape::circle || c.amplitude == 0.0 ? 1 : c.sides;
    if (*c.warmup < c.events / segments + 1) return {};
    return fmt::format(
        "--warmup is {} periods, but a run of --events {} cannot be longer than {} periods: the "
        "warm-up must be shorter than the run.",
        *c.warmup, c.events, c.events / segments);
}

}  // namespace

std::optional<std::string> problem(const RunConfig& config) {
    if (auto answer = out_of_range(config)) return answer;
    if (auto answer = out_of_proportion(config)) return answer;
    if (auto answer = does_not_fit(config)) return answer;
    if (auto answer = not_for_this_body(config)) return answer;
    if (auto answer = not_without_floor(config)) return answer;
    if (auto answer = floor_too_rough(config)) return answer;
    if (auto answer = resists_too_much(config)) return answer;
    return warmup_too_long(config);
}

ContainerPath make_path(const RunConfig& c) {
    return c.path == PathShape::circle ? circular_path(c.amplitude, c.period)
                                       : polygon_path(c.amplitude, c.period, c.sides);
}

double container_speed(const RunConfig& c) {
    if (c.path == PathShape::circle) return c.amplitude * c.omega();
    return 2.0 * c.amplitude * c.sides * std::sin(pi / c.sides) / c.period;
}

Tuning stopped_by(const std::atomic<bool>* stop) {
    Tuning tuning;
    if (stop) tuning.is_stopped = [stop] { return stop->load(std::memory_order_relaxed); };
    return tuning;
}

const char* body_word(const RunConfig& config) {
    return config.body == Shape::sphere ? "sphere" : "disc";
}

InitialState without_discs(const RunConfig& c, const ContainerPath& path) {
    return {
        {},
        path,
        c.container_radius,
        {c.mu_disc, c.restitution, c.tangential_restitution, c.contact_duration, c.vertical_disc},
        {c.mu_wall, c.restitution, c.tangential_restitution, c.contact_duration, c.vertical_wall},
        c.shape(),
        {c.floor ? c.floor_friction * c.gravity : 0.0, c.shape() == Shape::coin,
         c.floor ? c.rolling_resistance * c.gravity : 0.0}};
}

InitialState make_initial_state(const RunConfig& c, const std::atomic<bool>* stop) {
    const auto n = static_cast<std::size_t>(c.discs);
    const std::size_t second = c.mixture ? static_cast<std::size_t>(c.mixture->count) : 0;
    std::vector<double> radii(n, c.radius);
    for (std::size_t i = n - second; i < n; ++i) radii[i] = c.mixture->radius;

    const auto centres =
        place_discs(radii, c.container_radius, c.seed, stopped_by(stop).is_stopped);
    if (!centres && stop && stop->load())
        throw_interrupted(fmt::format("Stopped before the {}s had their places.", body_word(c)));
    if (!centres)
        throw_wrong_call(fmt::format(
            "{} {}s of radius {}{} could not be placed in a container of radius {} without "
            "overlap: {}{}",
            c.discs, body_word(c), c.radius,
            c.mixture ? fmt::format(" and {}", c.mixture->radius) : "", c.container_radius,
            c.mixture ? ""
                      : fmt::format("no arrangement holds more than {:.0f}, and close to that none "
                                    "may be found; ",
                                    max_discs_in_container(c.radius, c.container_radius)),
            advice_on_room(c)));

    InitialState scene = without_discs(c, make_path(c));
    // Small against the container's speed (a tenth of it in the paper's dish), and there also when
    // the container stands still.
    const double small_speed = 0.02 * c.container_radius * c.omega();
    const double inertia_factor = c.inertia / (c.mass * c.radius * c.radius);
    const Segment& segment = scene.path.segments.front();
    // A stream of its own: the velocities must not repeat the numbers that placed the discs.
    Random random(Random(c.seed ^ 0x76656c6f63697479u).bits());
    scene.discs.reserve(n);
    for (std::size_t i = 0; i < n; ++i) {
        if (stop && stop->load()) throw_interrupted("Stopped before the first event.");
        const double mass = i < n - second ? c.mass : c.mixture->mass;
        const double inertia =
            i < n - second ? c.inertia : inertia_factor * mass * radii[i] * radii[i];
        scene.discs.push_back({segment.start + (*centres)[i],
                               segment.velocity + random.in_disc(small_speed), 0.0, 0.0, 0.0,
                               radii[i], mass, inertia});
    }
    return scene;
}

}  // namespace swirl
