#include "swirl/engine/validate.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <initializer_list>
#include <utility>
#include <vector>

#include "swirl/physics/limits.hpp"

namespace swirl {
namespace {

using Problem = std::optional<std::string>;

std::string text_of(double value, int digits = 6) {
    char text[32];
    return {text,
            std::to_chars(text, text + sizeof text, value, std::chars_format::general, digits).ptr};
}
std::string joined(std::initializer_list<std::string> parts) {
    std::string text;
    for (const std::string& part : parts) text += part;
    return text;
}
std::string text_of(const Vec2& v) { return joined({"(", text_of(v.x), ", ", text_of(v.y), ")"}); }

bool is_finite(std::initializer_list<double> values) {
    return std::all_of(values.begin(), values.end(),
                       [](double value) { return std::abs(value) <= largest_magnitude; });
}
bool is_positive(double value) { return value > 0.0 && value <= largest_magnitude; }
bool is_share(double value) { return value >= 0.0 && value <= 1.0; }

Problem problem_with(const ContainerPath& path, Shape shape) {
    constexpr double rounding = 1e-9;  // relative to the period and the largest coordinate
    const std::vector<Segment>& segments = path.segments;
    if (!is_positive(path.period))
        return joined(
            {"the period of the path is ", text_of(path.period), ", but it must be above 0."});
    if (segments.empty()) return "the path has no segments.";
    if (segments.front().begin != 0.0)
        return joined({"the path begins at the time ", text_of(segments.front().begin),
                       ", but it must be 0."});
    double reach = 0.0;
    const auto name = [](std::size_t k) {
        return joined({"segment ", std::to_string(k), " of the path"});
    };
    for (std::size_t k = 0; k < segments.size(); ++k) {
        const Segment& s = segments[k];
        if (!is_finite(
                {s.begin, s.end, s.start.x, s.start.y, s.velocity.x, s.velocity.y, s.turn_rate}))
            return joined({name(k), " has a number that is not finite."});
        if (!(s.begin < s.end))
            return joined({name(k), " ends at ", text_of(s.end),
                           ", but it must be after its begin, ", text_of(s.begin), "."});
        if (shape != Shape::disc && s.turn_rate != 0.0)
            return joined({name(k), " is an arc, but spheres and coins need straight segments."});
        reach = std::max({reach, std::abs(s.start.x), std::abs(s.start.y)});
    }
    for (std::size_t k = 0; k < segments.size(); ++k) {
        const Segment &s = segments[k], &next = segments[(k + 1) % segments.size()];
        const bool is_last = k + 1 == segments.size();
        const double begin = is_last ? path.period : next.begin;
        if (std::abs(s.end - begin) > rounding * path.period)
            return joined({name(k), " ends at ", text_of(s.end), ", but ",
                           is_last ? "the period is " : "the next one begins at ", text_of(begin),
                           "."});
        const Vec2 gap = s.position_at(s.end) - next.start;
        if (std::hypot(gap.x, gap.y) >
            rounding * (reach + std::hypot(s.velocity.x, s.velocity.y) * (s.end - s.begin)))
            return joined({name(k), " ends at ", text_of(s.position_at(s.end)),
                           ", but the next one starts at ", text_of(next.start), "."});
    }
    return {};
}

Problem problem_with(const Surface& s, const char* name) {
    if (!(s.mu >= 0.0 && s.mu <= largest_magnitude))
        return joined({"mu of ", name, " is ", text_of(s.mu), ", but it must be 0 or more."});
    if (!(s.contact_duration >= 0.0 && s.contact_duration <= largest_magnitude))
        return joined({"contact_duration of ", name, " is ", text_of(s.contact_duration),
                       ", but it must be 0 or more."});
    for (const auto& [what, value] : {std::pair("restitution", s.restitution),
                                      std::pair("tangential_restitution", s.tangential_restitution),
                                      std::pair("vertical_friction", s.vertical_friction)})
        if (!is_share(value))
            return joined(
                {what, " of ", name, " is ", text_of(value), ", but it must be from 0 to 1."});
    return {};
}

Problem problem_with(const std::vector<Disc>& discs) {
    if (discs.empty()) return "the scene has no discs.";
    if (static_cast<double>(discs.size()) > max_discs)
        return joined({"the scene has ", std::to_string(discs.size()), " discs, but at most ",
                       text_of(max_discs), " are allowed."});
    for (std::size_t i = 0; i < discs.size(); ++i) {
        const Disc& d = discs[i];
        if (!is_finite({d.position.x, d.position.y, d.velocity.x, d.velocity.y, d.angle, d.spin,
                        d.time, d.rolling_spin.x, d.rolling_spin.y, d.last_collision}))
            return joined({"disc ", std::to_string(i), " has a number that is not finite."});
        for (const auto& [what, value] : {std::pair("radius", d.radius), std::pair("mass", d.mass),
                                          std::pair("inertia", d.inertia)})
            if (!is_positive(value))
                return joined({what, " of disc ", std::to_string(i), " is ", text_of(value),
                               ", but it must be above 0."});
        if (d.can_spin != 0.0 && d.can_spin != 1.0)
            return joined({"can_spin of disc ", std::to_string(i), " is ", text_of(d.can_spin),
                           ", but it must be 0 or 1."});
        if (d.can_spin == 0.0 && d.spin != 0.0)
            return joined({"disc ", std::to_string(i), " has the spin ", text_of(d.spin),
                           ", but it cannot spin."});
    }
    return {};
}

Problem problem_with_wall(const InitialState& scene, const Vec2& centre, double tolerance) {
    for (std::size_t i = 0; i < scene.discs.size(); ++i) {
        const Disc& d = scene.discs[i];
        const Vec2 from = d.position - centre;
        const double out = std::hypot(from.x, from.y) + d.radius - scene.container_radius;
        if (out > tolerance * d.radius)
            return joined({"disc ", std::to_string(i), " at ", text_of(d.position), " extends ",
                           text_of(out, 3), " beyond the container, whose centre is ",
                           text_of(centre), " and whose radius is ",
                           text_of(scene.container_radius), "."});
    }
    return {};
}

}  // namespace

std::optional<std::string> overlap_in(const InitialState& scene, const Vec2& centre,
                                      double tolerance) {
    if (auto problem = problem_with_wall(scene, centre, tolerance)) return problem;
    const std::vector<Disc>& discs = scene.discs;
    // In rows of the height of the largest disc, each in order of x, the partners of a disc are in
    // its own row and in the next one, within the sum of the largest radii in x.
    double largest = 0.0;
    for (const Disc& d : discs) largest = std::max(largest, d.radius);
    struct Place {
        double row, x;
        std::size_t disc;
    };
    std::vector<Place> places;
    for (std::size_t i = 0; i < discs.size(); ++i)
        places.push_back({std::floor((discs[i].position.y - centre.y) / (2.0 * largest)),
                          discs[i].position.x, i});
    const auto is_before = [](const Place& a, const Place& b) {
        return a.row != b.row ? a.row < b.row : a.x < b.x;
    };
    std::sort(places.begin(), places.end(), is_before);
    const auto overlap = [&](std::size_t i, std::size_t j) -> Problem {
        const Vec2 apart = discs[j].position - discs[i].position;
        const double distance = std::hypot(apart.x, apart.y),
                     contact = discs[i].radius + discs[j].radius;
        if (contact - distance <= tolerance * std::min(discs[i].radius, discs[j].radius)) return {};
        return joined({"discs ", std::to_string(std::min(i, j)), " and ",
                       std::to_string(std::max(i, j)), " overlap: their distance is ",
                       text_of(distance), ", but their radii add up to ", text_of(contact), "."});
    };
    for (auto a = places.begin(); a != places.end(); ++a) {
        const double reach = discs[a->disc].radius + largest;
        const auto next_row =
            std::lower_bound(a, places.end(), Place{a->row + 1.0, a->x - reach, 0}, is_before);
        for (const auto& [row, first] :
             {std::pair(a->row, a + 1), std::pair(a->row + 1.0, next_row)})
            for (auto b = first; b != places.end() && b->row == row && b->x <= a->x + reach; ++b)
                if (auto problem = overlap(a->disc, b->disc)) return problem;
    }
    return {};
}

namespace {

Problem problem_with_values(const InitialState& scene) {
    if (auto problem = problem_with(scene.path, scene.shape)) return problem;
    if (!is_positive(scene.container_radius))
        return joined({"the radius of the container is ", text_of(scene.container_radius),
                       ", but it must be above 0."});
    if (auto problem = problem_with(scene.disc_surface, "the discs")) return problem;
    if (auto problem = problem_with(scene.wall_surface, "the wall")) return problem;
    if (!(scene.floor.deceleration >= 0.0 && scene.floor.rolling_resistance >= 0.0) ||
        !is_finite({scene.floor.deceleration, scene.floor.rolling_resistance}))
        return joined({"the floor has the deceleration ", text_of(scene.floor.deceleration),
                       " and the rolling resistance ", text_of(scene.floor.rolling_resistance),
                       ", but both must be 0 or more."});
    return problem_with(scene.discs);
}

}  // namespace

std::optional<std::string> validate(const InitialState& scene) {
    if (auto problem = problem_with_values(scene)) return problem;
    return overlap_in(scene, scene.path.segments.front().start, rounding_overlap);
}

std::optional<std::string> validate(const InitialState& scene, const Progress& progress) {
    const bool begins = progress.periods == 0 && progress.clock == 0.0 && progress.segment == 0 &&
                        progress.events.total() == 0;
    return begins ? validate(scene) : problem_with_values(scene);
}

void stop_if(const std::optional<std::string>& problem) {
    if (!problem) return;
#if !defined(__wasm__)  // WebAssembly has no standard error
    std::fprintf(stderr, "swirl::Simulation: %s\n", problem->c_str());
#endif
    std::abort();
}

}  // namespace swirl
