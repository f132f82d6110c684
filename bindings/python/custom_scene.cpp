#include "custom_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "swirl/run/failure.hpp"
#include "swirl/run/initial_parameter.hpp"
#include "swirl/run/parameters.hpp"
#include "swirl/run/particle_sizes.hpp"

namespace swirl::python {
namespace {

std::string shape_text(const Numbers& a) {
    std::string text;
    for (py::ssize_t d = 0; d < a.ndim(); ++d)
        text += fmt::format("{}{}", d ? " × " : "", a.shape(d));
    return a.ndim() == 0 ? "one number" : text;
}

/// `rows` is 0 if any number of rows is allowed.
void require_pairs(const char* name, const Numbers& values, std::size_t rows) {
    if (values.ndim() != 2 || values.shape(1) != 2 ||
        (rows && values.shape(0) != signed_size(rows)))
        throw UsageError(fmt::format("{} has shape {}, but it must be {} × 2: x and y of each.",
                                     name, shape_text(values),
                                     rows ? fmt::format("{}", rows) : "N"));
}

/// One value for each of n discs; `otherwise` for all if `values` is not given.
std::vector<double> column_of(const char* name, const std::optional<Numbers>& values, std::size_t n,
                              double otherwise) {
    if (!values) return std::vector<double>(n, otherwise);
    if (values->ndim() == 0) return std::vector<double>(n, *values->data());
    if (values->ndim() != 1 || values->shape(0) != signed_size(n))
        throw UsageError(
            fmt::format("{} has shape {}, but it must be {} numbers, or one for all discs.", name,
                        shape_text(*values), n));
    return {values->data(), values->data() + n};
}

}  // namespace

void require_valid_discs(const InitialState& scene, const Vec2& centre, double tolerance) {
    if (const auto problem = problem_with_given_discs(scene, centre, tolerance))
        throw UsageError(*problem);
}

std::vector<Disc> discs_of(const GivenDiscs& given, const RunConfig& config,
                           const Segment& first_segment) {
    require_pairs("position", given.position, 0);
    const auto n = static_cast<std::size_t>(given.position.shape(0));
    if (n == 0) throw UsageError("position has shape 0 × 2, but there must be at least one disc.");
    if (static_cast<double>(n) > max_discs)
        throw UsageError(
            fmt::format("position has {} discs, but at most {} can be simulated.", n, max_discs));
    if (given.velocity) require_pairs("velocity", *given.velocity, n);
    const auto angle = column_of("angle", given.angle, n, 0.0);
    const auto spin = column_of("spin", given.spin, n, 0.0);
    const auto radius = column_of("radius", given.radius, n, config.radius);
    auto mass = column_of("mass", given.mass, n, config.mass);
    if (given.radius && !given.mass)
        for (std::size_t i = 0; i < n; ++i) mass[i] = mass_of_same_material(radius[i], config);
    // By default the same multiple of m r² for all discs.
    std::vector<double> inertia(n);
    const double multiple = config.inertia / (config.mass * config.radius * config.radius);
    for (std::size_t i = 0; i < n; ++i) inertia[i] = multiple * mass[i] * radius[i] * radius[i];
    if (given.inertia) inertia = column_of("inertia", given.inertia, n, 0.0);
    std::vector<double> can_spin = which_can_spin(config, n);
    if (given.cannot_spin) can_spin = column_of("cannot_spin", given.cannot_spin, n, 0.0);
    std::vector<Disc> discs;
    discs.reserve(n);
    for (std::size_t i = 0; i < n; ++i) {
        const double* const p = given.position.data() + 2 * i;
        const Vec2 velocity =
            given.velocity ? Vec2{given.velocity->data()[2 * i], given.velocity->data()[2 * i + 1]}
                           : first_segment.velocity;
        Disc disc{.position = {p[0], p[1]},
                  .velocity = velocity,
                  .angle = angle[i],
                  .spin = spin[i],
                  .time = 0.0,
                  .radius = radius[i],
                  .mass = mass[i],
                  .inertia = inertia[i]};
        disc.can_spin = given.cannot_spin ? 1.0 - can_spin[i] : can_spin[i];
        discs.push_back(disc);
    }
    return discs;
}

ContainerPath polygon(const Numbers& vertices, const std::optional<Numbers>& times, double period) {
    require_pairs("motion", vertices, 0);
    const auto n = static_cast<std::size_t>(vertices.shape(0));
    if (n < 2) throw UsageError("motion has one vertex, but it must have at least two.");
    for (std::size_t k = 0; k < 2 * n; ++k)
        if (!(std::abs(vertices.data()[k]) <= largest_value))
            throw UsageError(fmt::format("motion contains {}, but it must be from {} to {}.",
                                         vertices.data()[k], -largest_value, largest_value));
    if (static_cast<double>(n) > max_sides)
        throw UsageError(
            fmt::format("motion has {} vertices, but at most {} are allowed.", n, max_sides));
    const auto vertex = [&](std::size_t k) {
        return Vec2{vertices.data()[2 * (k % n)], vertices.data()[2 * (k % n) + 1]};
    };
    std::vector<double> at(n + 1, 0.0);
    if (times) {
        const auto given = column_of("motion_times", times, n, 0.0);
        std::copy(given.begin(), given.end(), at.begin());
    } else {
        // The speed is constant, so times are proportional to the length of the path.
        for (std::size_t k = 0; k < n; ++k) {
            const Vec2 side = vertex(k + 1) - vertex(k);
            at[k + 1] = at[k] + std::hypot(side.x, side.y);
        }
        if (!(at[n] > 0.0)) throw UsageError("all vertices of path are the same point.");
        const double time_per_length = period / at[n];
        for (double& t : at) t *= time_per_length;
    }
    at[n] = period;
    if (at[0] != 0.0)
        throw UsageError(
            fmt::format("motion_times begins with {}, but it must begin with 0.", at[0]));
    ContainerPath path{period, {}};
    const double min_duration = 1e-9 * period;
    for (std::size_t k = 0; k < n; ++k) {
        const double duration = at[k + 1] - at[k];
        if (!(duration >= min_duration))
            throw UsageError(
                fmt::format("motion has vertex {} at time {} and the next one at {}, but times "
                            "must increase up "
                            "to the period {}, and consecutive vertices must differ.",
                            k, at[k], at[k + 1], period));
        path.segments.push_back(
            {at[k], at[k + 1], vertex(k), (1.0 / duration) * (vertex(k + 1) - vertex(k)), 0.0});
    }
    return path;
}

}  // namespace swirl::python
