#include "swirl/engine/validate.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <initializer_list>
#include <utility>
#include <vector>

#include "swirl/engine/neighbors/engine_state.hpp"
#include "swirl/math/cpu_width.hpp"
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

bool is_share(double value) { return value >= 0.0 && value <= 1.0; }

Problem unless_positive(const std::string& what, double value, double maximum = largest_magnitude) {
    if (value > 0.0 && value <= maximum) return {};
    return joined({what, " is ", text_of(value), ", but it must be above 0 and at most ",
                   text_of(maximum), "."});
}
Problem unless_not_negative(const std::string& what, double value) {
    if (value >= 0.0 && value <= largest_magnitude) return {};
    return joined({what, " is ", text_of(value), ", but it must be from 0 to ",
                   text_of(largest_magnitude), "."});
}
struct Named {
    const char* name;
    double value;
};
/// `owner` has these numbers.
Problem unless_finite(const std::string& owner, std::initializer_list<Named> numbers) {
    for (const Named& number : numbers)
        if (!(std::abs(number.value) <= largest_magnitude))
            return joined({number.name, " of ", owner, " is ", text_of(number.value),
                           ", but its magnitude must be at most ", text_of(largest_magnitude),
                           "."});
    return {};
}

Problem problem_with(const ContainerPath& path, Shape shape) {
    constexpr double rounding = 1e-9;  // relative to the period and the largest coordinate
    const std::vector<Segment>& segments = path.segments;
    if (auto problem = unless_positive("the period of the path", path.period)) return problem;
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
        if (auto problem = unless_finite(name(k), {{"begin", s.begin},
                                                   {"end", s.end},
                                                   {"start.x", s.start.x},
                                                   {"start.y", s.start.y},
                                                   {"velocity.x", s.velocity.x},
                                                   {"velocity.y", s.velocity.y},
                                                   {"turn_rate", s.turn_rate}}))
            return problem;
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
    for (const Coefficient& c : coefficients) {
        const double value = s.*c.member;
        const std::string what = joined({c.name, " of ", name});
        if (!c.is_share) {
            if (auto problem = unless_not_negative(what, value)) return problem;
        } else if (!is_share(value)) {
            return joined({what, " is ", text_of(value), ", but it must be from 0 to 1."});
        }
    }
    return {};
}

/// Composes no text, since there may be millions of discs.
bool is_sound(const Disc& d) {
    for (const double number : {d.position.x, d.position.y, d.velocity.x, d.velocity.y, d.angle,
                                d.spin, d.rolling_spin.x, d.rolling_spin.y})
        if (!(std::abs(number) <= largest_magnitude)) return false;
    if (d.can_spin != 1.0 && !(d.can_spin == 0.0 && d.spin == 0.0)) return false;
    return d.radius > 0.0 && d.radius <= largest_magnitude && d.mass > 0.0 &&
           d.mass <= largest_magnitude && d.inertia > 0.0 && d.inertia <= largest_inertia;
}

Problem problem_with(const std::vector<Disc>& discs) {
    if (discs.empty()) return "the scene has no discs.";
    if (static_cast<double>(discs.size()) > max_discs)
        return joined({"the scene has ", std::to_string(discs.size()), " discs, but at most ",
                       text_of(max_discs), " are allowed."});
    for (std::size_t i = 0; i < discs.size(); ++i) {
        const Disc& d = discs[i];
        if (is_sound(d)) continue;
        const std::string name = joined({"disc ", std::to_string(i)});
        if (auto problem = unless_finite(name, {{"position.x", d.position.x},
                                                {"position.y", d.position.y},
                                                {"velocity.x", d.velocity.x},
                                                {"velocity.y", d.velocity.y},
                                                {"angle", d.angle},
                                                {"spin", d.spin},
                                                {"rolling_spin.x", d.rolling_spin.x},
                                                {"rolling_spin.y", d.rolling_spin.y}}))
            return problem;
        for (const auto& [what, value] :
             {std::pair("radius of ", d.radius), std::pair("mass of ", d.mass)})
            if (auto problem = unless_positive(joined({what, name}), value)) return problem;
        if (auto problem =
                unless_positive(joined({"inertia of ", name}), d.inertia, largest_inertia))
            return problem;
        if (d.can_spin != 0.0 && d.can_spin != 1.0)
            return joined(
                {"can_spin of ", name, " is ", text_of(d.can_spin), ", but it must be 0 or 1."});
        return joined({name, " has the spin ", text_of(d.spin), ", but it cannot spin."});
    }
    return {};
}

/// Disc i is at `position` when the container is at `centre`.
Problem unless_inside(const InitialState& scene, std::size_t i, const Vec2& position,
                      const Vec2& centre, double tolerance) {
    const double radius = scene.discs[i].radius;
    const Vec2 from = position - centre;
    const double out = std::hypot(from.x, from.y) + radius - scene.container_radius;
    if (out <= tolerance * radius) return {};
    return joined({"disc ", std::to_string(i), " at ", text_of(position), " extends ",
                   text_of(out, 3), " beyond the container, whose centre is ", text_of(centre),
                   " and whose radius is ", text_of(scene.container_radius), "."});
}

Problem problem_with_wall(const InitialState& scene, const Vec2& centre, double tolerance) {
    for (std::size_t i = 0; i < scene.discs.size(); ++i)
        if (auto problem = unless_inside(scene, i, scene.discs[i].position, centre, tolerance))
            return problem;
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
    if (auto problem = unless_positive("the radius of the container", scene.container_radius))
        return problem;
    if (auto problem = problem_with(scene.disc_surface, "the discs")) return problem;
    if (auto problem = problem_with(scene.wall_surface, "the wall")) return problem;
    if (scene.law && scene.shape != Shape::disc && scene.law.loops->many_spheres.run == nullptr)
        return "the contact law is for discs only, but the bodies are spheres or coins.";
    for (const auto& [what, value] :
         {std::pair("the deceleration by the floor", scene.floor.deceleration),
          std::pair("the rolling resistance of the floor", scene.floor.rolling_resistance)})
        if (auto problem = unless_not_negative(what, value)) return problem;
    return problem_with(scene.discs);
}

/// Larger counts would not be exact in a double.
constexpr std::int64_t largest_count = std::int64_t{1} << 53;

Problem problem_with_counts(const Progress& progress) {
    const auto problem = [](const char* what, const std::string& count) {
        return joined({"the number of ", what, " is ", count, ", but it must be from 0 to ",
                       std::to_string(largest_count), "."});
    };
    if (progress.periods < 0 || progress.periods > largest_count)
        return problem("periods", std::to_string(progress.periods));
    const EventCounts& e = progress.events;
    for (const auto& [what, count] :
         {std::pair("collisions of two discs", e.disc_disc),
          std::pair("collisions with the wall", e.disc_wall),
          std::pair("path vertices", e.path_vertex),
          std::pair("collisions made elastic by the TC model", e.elastic_by_tc),
          std::pair("times that a sphere begins to roll", e.begins_to_roll)})
        if (count > std::uint64_t{largest_count}) return problem(what, std::to_string(count));
    return {};
}

Problem problem_with(const Progress& progress, const std::vector<Segment>& segments) {
    if (auto problem = problem_with_counts(progress)) return problem;
    if (progress.segment >= segments.size())
        return joined({"the segment is ", std::to_string(progress.segment),
                       ", but the last one of the path is ", std::to_string(segments.size() - 1),
                       "."});
    const Segment& segment = segments[progress.segment];
    if (!(progress.clock >= segment.begin && progress.clock <= segment.end))
        return joined({"the clock is ", text_of(progress.clock), ", but segment ",
                       std::to_string(progress.segment), " of the path lasts from ",
                       text_of(segment.begin), " to ", text_of(segment.end), "."});
    const std::uint64_t ended =
        static_cast<std::uint64_t>(progress.periods) * segments.size() + progress.segment;
    if (progress.events.path_vertex != ended)
        return joined({"the number of path vertices is ",
                       std::to_string(progress.events.path_vertex), ", but ", std::to_string(ended),
                       " segments have ended."});
    return {};
}

Problem problem_with_times(const std::vector<Disc>& discs, double clock) {
    for (std::size_t i = 0; i < discs.size(); ++i)
        for (const auto& [what, time] : {std::pair("time", discs[i].time),
                                         std::pair("last_collision", discs[i].last_collision)})
            if (!(time >= 0.0 && time <= clock))
                return joined({what, " of disc ", std::to_string(i), " is ", text_of(time),
                               ", but it must be from 0 to the clock, ", text_of(clock), "."});
    return {};
}

/// How far a disc may extend beyond the container, in its radii. Rounding moves it by less than
/// 10⁻⁶; with more, a run would end with an error anyway.
constexpr double largest_excess = 1e-3;

/// Each disc is at its own time.
Problem problem_with_positions(const InitialState& scene, const Progress& progress) {
    const Segment& segment = scene.path.segments[progress.segment];
    const Vec2 centre = segment.position_at(progress.clock);
    for (std::size_t i = 0; i < scene.discs.size(); ++i) {
        const Disc& d = scene.discs[i];
        const FloorMotion motion = scene.shape == Shape::disc
                                       ? FloorMotion{}
                                       : floor_motion(d, scene.floor, segment.velocity);
        const Vec2 position = moved_to(d, motion, progress.clock).position;
        if (auto problem = unless_inside(scene, i, position, centre, largest_excess))
            return problem;
    }
    return {};
}

}  // namespace

std::optional<std::string> validate(const InitialState& scene, const Progress& progress) {
    if (auto problem = problem_with_values(scene)) return problem;
    if (auto problem = problem_with(progress, scene.path.segments)) return problem;
    if (auto problem = problem_with_times(scene.discs, progress.clock)) return problem;
    const bool begins = progress.clock == 0.0 && progress.events.total() == 0;
    return begins ? overlap_in(scene, scene.path.segments.front().start, rounding_overlap)
                  : problem_with_positions(scene, progress);
}

std::optional<std::string> validate(const Tuning& tuning) {
    if (tuning.cells_per_side < 0 || tuning.cells_per_side > max_cells_per_side)
        return joined({"cells_per_side is ", std::to_string(tuning.cells_per_side),
                       ", but it must be from 0 to ", std::to_string(max_cells_per_side), "."});
    if (!has_width(tuning.width))
        return joined({"width is ", std::to_string(static_cast<int>(tuning.width)),
                       ", but this processor or this build has no loop of that width."});
    if (tuning.search > SearchMethod::cells)
        return joined({"search is ", std::to_string(static_cast<int>(tuning.search)),
                       ", but the last search method is ",
                       std::to_string(static_cast<int>(SearchMethod::cells)), "."});
    return {};
}

std::optional<std::string> problem_with_change(const InitialState& scene, std::size_t segments,
                                               const Progress& progress) {
    if (progress.segment != 0 || progress.clock != 0.0)
        return joined({"the surroundings can change at the start of a period, but the clock is ",
                       text_of(progress.clock), "."});
    if (scene.path.segments.empty()) return "the path has no segments.";
    if (scene.path.segments.size() != segments)
        return joined({"the new path has ", std::to_string(scene.path.segments.size()),
                       " segments, but it must have as many as before, ", std::to_string(segments),
                       "."});
    return {};
}

std::optional<std::string> problem_with_time(const Progress& now, double period,
                                             std::int64_t periods, double clock) {
    if (!(clock >= 0.0 && clock <= period))
        return joined({"the clock is ", text_of(clock), ", but it must be from 0 to the period, ",
                       text_of(period), "."});
    if (periods > largest_count)
        return joined({"the number of periods is ", std::to_string(periods),
                       ", but it must be at most ", std::to_string(largest_count), "."});
    if (periods < now.periods || (periods == now.periods && clock < now.clock))
        return joined({"period ", std::to_string(periods), " with the clock ", text_of(clock),
                       " is past, because the simulation is in period ",
                       std::to_string(now.periods), " and its clock is ", text_of(now.clock), "."});
    return {};
}

std::optional<std::string> problem_with_radii(const std::vector<double>& radii,
                                              double container_radius) {
    if (auto problem = unless_positive("the radius of the container", container_radius))
        return problem;
    for (std::size_t i = 0; i < radii.size(); ++i) {
        if (radii[i] > 0.0 && radii[i] <= largest_magnitude) continue;
        return unless_positive(joined({"the radius of disc ", std::to_string(i)}), radii[i]);
    }
    return {};
}

void stop_if(const std::optional<std::string>& problem, const char* function) {
    if (problem) stop(problem->c_str(), function);
}

void stop(const char* problem, const char* function) {
    if constexpr (preconditions_are_checked)  // WebAssembly has no standard error
        std::fprintf(stderr, "swirl::%s: %s\n", function, problem);
    std::abort();
}

}  // namespace swirl
