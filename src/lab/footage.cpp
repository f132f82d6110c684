#include "lab/footage.hpp"

#include <fmt/format.h>

#include <cmath>
#include <memory>

#include "physics/unit_circle.hpp"
#include "simulation/simulation.hpp"

namespace swirl {

namespace {

/// A number as people write it, with the true minus sign.
std::string plain(double value) {
    const std::string text = fmt::format("{:g}", std::abs(value));
    return value < 0.0 ? "−" + text : text;
}

/// Points along the path of C; the circle gets enough of them to look round.
std::vector<Vec2> outline(const ContainerPath& path) {
    std::vector<Vec2> points;
    for (const Leg& leg : path.legs) {
        const int parts = leg.turning == 0.0 ? 1 : 180;
        for (int k = 0; k < parts; ++k)
            points.push_back(leg.position_at(leg.begin + (leg.end - leg.begin) * k / parts));
    }
    return points;
}

}  // namespace

std::vector<std::string> parameter_labels(const RunConfig& config) {
    std::vector<std::string> labels{fmt::format("$N$ = {}", config.discs)};
    labels.push_back("$μ_{d}$ = " + plain(config.mu_disc));
    labels.push_back("$μ_{w}$ = " + plain(config.mu_wall));
    if (config.restitution != 1.0) labels.push_back("$e$ = " + plain(config.restitution));
    if (config.tangential_restitution != 0.0)
        labels.push_back("$β$ = " + plain(config.tangential_restitution));
    labels.push_back(
        "$I$ = " + plain(config.inertia / (config.mass * config.radius * config.radius)) +
        " $m$$r^{2}$");
    labels.push_back("$R$ = " + plain(config.container_radius / config.radius) + " $r$");
    labels.push_back("$A$ = " + plain(config.amplitude / config.radius) + " $r$");
    if (config.mixture)
        labels.push_back(fmt::format("{} discs of {} $r$", config.mixture->count,
                                     plain(config.mixture->radius / config.radius)));
    labels.push_back(fmt::format("seed {}", config.seed));
    return labels;
}

Footage simulated(const RunConfig& config) {
    Footage footage;
    const ContainerPath path = make_path(config);
    footage.open = [config]() -> Reel {
        auto simulation = std::make_shared<Simulation>(make_scene(config));
        return [simulation, period = config.period](double swirls) {
            const double whole = std::floor(swirls);
            simulation->advance_to(static_cast<std::int64_t>(whole), (swirls - whole) * period);
            return simulation->snapshot();
        };
    };
    footage.path = outline(path);
    footage.container_radius = config.container_radius;
    footage.amplitude = config.amplitude;
    footage.period = config.period;
    footage.caption = fmt::format("{} disc{}", config.discs, config.discs == 1 ? "" : "s");
    footage.parameters = parameter_labels(config);
    return footage;
}

Footage rolling_ball(double slip, double ball_radius, const RunConfig& container) {
    Footage footage;
    const double gamma = slip * container.container_radius / ball_radius;
    footage.open = [=]() -> Reel {
        const ContainerPath path = circular_path(container.amplitude, container.period);
        return [=](double swirls) {
            const double whole = std::floor(swirls);
            const double omega = path.omega(), clock = (swirls - whole) * container.period;
            const Vec2 outward = unit_circle(swirls - whole);
            Snapshot s;
            s.swirls = static_cast<std::int64_t>(whole);
            s.clock = clock;
            s.period = container.period;
            s.container_centre = path.leg_at(clock).position_at(clock);
            s.container_velocity = path.leg_at(clock).velocity_at(clock);
            s.container_radius = container.container_radius;
            s.resize(1);
            const double arm = container.amplitude + container.container_radius - ball_radius;
            Disc ball{};
            ball.position = arm * outward;
            ball.velocity = (arm * omega) * perpendicular(outward);
            ball.spin = (1.0 - gamma) * omega;
            ball.angle = ball.spin * swirls * container.period;
            ball.time = clock;
            ball.radius = ball_radius;
            ball.mass = 1.0;
            ball.inertia = solid_inertia(1.0, ball_radius);
            s.set(0, ball);
            return s;
        };
    };
    footage.path = outline(circular_path(container.amplitude, container.period));
    footage.container_radius = container.container_radius;
    footage.amplitude = container.amplitude;
    footage.period = container.period;
    footage.caption = slip == 0.0 ? "slip" : "no slip";
    footage.parameters = {"$s$ = " + plain(slip),
                          "$γ$ = $s$ $R$/$R_{ball}$ = " + fmt::format("{:.3g}", gamma),
                          "$ϖ$/$Ω$ = 1 − $γ$ = " + (gamma > 1.0 ? "−" : std::string()) +
                              fmt::format("{:.3g}", std::abs(1.0 - gamma))};
    return footage;
}

}  // namespace swirl
