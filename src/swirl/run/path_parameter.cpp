#include "swirl/run/path_parameter.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "swirl/math/unit_circle.hpp"
#include "swirl/run/config.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/parameter_readers.hpp"

namespace swirl {
namespace {

constexpr std::string_view points_word = "points";
/// The shapes that a user can give.
const std::vector<std::string> shape_words{"polygon", "circle", "line", "ellipse", "lissajous"};
constexpr std::int64_t max_cycles = 1000;

[[noreturn]] void reject_path(std::string_view text) {
    Message message("not_a_path", {{"text", text}});
    add_nearest_value(message, text.substr(0, text.find(':')), shape_words);
    throw_usage_error(message);
}

void read_ellipse(std::string_view text, RunConfig& config) {
    const auto parts = split(text, ":");
    const auto ratio = parts.size() == 2 ? read_number(parts[1]) : std::nullopt;
    if (!ratio || !(*ratio >= 0.0 && *ratio <= largest_value))
        throw_usage_error(Message("not_an_ellipse", {{"text", text}, {"most", largest_value}}));
    config.path = PathShape::ellipse;
    config.curve.axis_ratio = *ratio;
}

void read_lissajous(std::string_view text, RunConfig& config) {
    const auto parts = split(text, ":");
    std::optional<std::int64_t> p, q;
    std::optional<double> lead = 0.0;
    if (parts.size() == 3 || parts.size() == 4) {
        p = read_whole_number(parts[1]);
        q = read_whole_number(parts[2]);
        if (parts.size() == 4) lead = read_number(parts[3]);
    }
    const auto is_cycles = [](const auto& n) { return n && *n >= 1 && *n <= max_cycles; };
    if (!is_cycles(p) || !is_cycles(q) || !lead || !(std::fabs(*lead) <= 360.0))
        throw_usage_error(
            Message("not_a_lissajous_figure", {{"text", text}, {"most", max_cycles}}));
    config.path = PathShape::lissajous;
    config.curve.x_cycles = *p;
    config.curve.y_cycles = *q;
    config.curve.y_lead = *lead;
}

/// The number of a point in a message, from 1.
MessageValue number_of(std::size_t index) { return {"point", static_cast<double>(index + 1)}; }

PathPoint read_point(std::size_t index, std::string_view text) {
    const auto parts = split(text, ":");
    std::array<double, 3> numbers{};
    if (parts.size() != numbers.size())
        throw_usage_error(Message("not_a_point", {number_of(index), {"text", text}}));
    for (std::size_t c = 0; c < numbers.size(); ++c) {
        const auto number = read_number(parts[c]);
        if (!number)
            throw_usage_error(
                Message("point_without_number", {number_of(index), {"text", parts[c]}}));
        numbers[c] = *number;
    }
    return {numbers[0], {numbers[1], numbers[2]}};
}

/// The largest distance from the origin.
double amplitude_of(const std::vector<PathPoint>& points) {
    double square = 0.0;
    for (const PathPoint& p : points) square = std::fmax(square, dot(p.at, p.at));
    return square_root(square);
}

/// Shifts times to start at 0 and closes the path exactly, or rejects it.
void validate_points(std::vector<PathPoint>& points) {
    if (points.size() < 3)
        throw_usage_error(
            Message("too_few_points", {{"points", static_cast<double>(points.size())}}));
    if (points.size() > max_path_points)
        throw_usage_error(
            Message("too_many_points", {{"points", static_cast<double>(points.size())},
                                        {"most", static_cast<double>(max_path_points)}}));
    for (std::size_t k = 0; k < points.size(); ++k)
        for (const double value : {points[k].time, points[k].at.x, points[k].at.y})
            if (!(std::fabs(value) <= largest_value))
                throw_usage_error(Message("point_out_of_range", {number_of(k),
                                                                 {"value", value},
                                                                 {"from", -largest_value},
                                                                 {"to", largest_value}}));
    const double start = points.front().time, period = points.back().time - start;
    // Shorter segments would be lost in the rounding of the times.
    const double shortest = 1e-9 * period;
    for (std::size_t k = 0; k + 1 < points.size(); ++k) {
        const double from = points[k].time, to = points[k + 1].time;
        if (!(to > from && to - from >= shortest))
            throw_usage_error(
                Message("point_too_early", {number_of(k + 1), {"time", to}, {"before", from}}));
    }
    const Vec2 gap = points.back().at - points.front().at;
    if (std::hypot(gap.x, gap.y) > 1e-9 * amplitude_of(points))
        throw_usage_error(Message("open_path", {{"x", points.front().at.x},
                                                {"y", points.front().at.y},
                                                {"x_end", points.back().at.x},
                                                {"y_end", points.back().at.y}}));
    points.back().at = points.front().at;
    if (start != 0.0)
        for (PathPoint& p : points) p.time -= start;
}

void read_points(std::string_view text, const ParameterTexts& given, RunConfig& config) {
    text.remove_prefix(points_word.size());
    std::vector<PathPoint> points;
    for (const std::string_view part : split(text, " "))
        if (!part.empty()) points.push_back(read_point(points.size(), part));
    validate_points(points);
    const double amplitude = amplitude_of(points);
    if (!given.contains("amplitude"))
        config.amplitude = amplitude;
    else if (amplitude == 0.0 && config.amplitude > 0.0)
        throw_usage_error(Message("points_at_origin", {{"amplitude", config.amplitude}}));
    if (!given.contains("period")) config.period = points.back().time;
    config.path = PathShape::points;
    config.curve.points = std::move(points);
}

/// Scaled to the amplitude and the period of the configuration; unchanged if these are its own.
std::vector<PathPoint> scaled_points(const RunConfig& c) {
    std::vector<PathPoint> points = c.curve.points;
    const double amplitude = amplitude_of(points), period = points.back().time;
    if (c.amplitude != amplitude)
        for (PathPoint& p : points) p.at = (c.amplitude / amplitude) * p.at;
    if (c.period != period)
        for (PathPoint& p : points) p.time = c.period * (p.time / period);
    return points;
}

/// cos and sin of 2π (cycles · k/M + lead/360). The product is reduced in whole numbers.
Vec2 at_cycle(std::int64_t cycles, int k, int sides, double lead = 0.0) {
    const double turns = double(cycles * k % sides) / sides + lead / 360.0;
    return unit_circle(turns);
}

ContainerPath unshifted_path(const RunConfig& c) {
    const double A = c.amplitude;
    if (A == 0.0) return still_path(c.period);
    switch (c.path) {
        case PathShape::circle:
            return circular_path(A, c.period, c.path_phase / 360.0);
        case PathShape::line:
            return sampled_path(c.period, c.sides, [&](int k) {
                return Vec2{A * at_cycle(1, k, c.sides).x, 0.0};
            });
        case PathShape::ellipse:
            return sampled_path(c.period, c.sides, [&](int k) {
                const Vec2 u = A * at_cycle(1, k, c.sides);
                return Vec2{u.x, c.curve.axis_ratio * u.y};
            });
        case PathShape::lissajous:
            return sampled_path(c.period, c.sides, [&](int k) {
                return Vec2{A * at_cycle(c.curve.x_cycles, k, c.sides).x,
                            A * at_cycle(c.curve.y_cycles, k, c.sides, c.curve.y_lead).y};
            });
        case PathShape::points:
            return polyline_path(scaled_points(c));
        case PathShape::polygon:
            break;
    }
    return polygon_path(A, c.period, c.sides);
}

/// Within a tenth of a circle of the amplitude, and of uniform rotation in radians.
bool is_nearly_circular(const ContainerPath& path, double amplitude) {
    constexpr double tolerance = 0.1;
    const double first = turns_of(path.segments.front().start);
    for (const Segment& segment : path.segments)
        for (const double t : {segment.begin, 0.5 * (segment.begin + segment.end)}) {
            const Vec2 C = segment.position_at(t);
            const double turns = turns_of(C) - first - t / path.period;
            const double lag = 2.0 * pi * (turns - std::round(turns));
            const double distance = std::hypot(C.x, C.y);
            if (!(distance >= (1.0 - tolerance) * amplitude && std::fabs(lag) <= tolerance))
                return false;
        }
    return true;
}

}  // namespace

bool is_path_shape(std::string_view text) {
    const std::string_view word = text.substr(0, text.find_first_of(": "));
    return word == points_word ||
           std::find(shape_words.begin(), shape_words.end(), word) != shape_words.end();
}

void read_path(std::string_view text, const ParameterTexts& given, RunConfig& config) {
    if (text == "polygon")
        config.path = PathShape::polygon;
    else if (text == "circle")
        config.path = PathShape::circle;
    else if (text == "line")
        config.path = PathShape::line;
    else if (text == "ellipse" || text.starts_with("ellipse:"))
        read_ellipse(text, config);
    else if (text == "lissajous" || text.starts_with("lissajous:"))
        read_lissajous(text, config);
    else if (text == points_word || text.starts_with("points "))
        read_points(text, given, config);
    else
        reject_path(text);
    if (config.path == PathShape::lissajous && !given.contains("sides"))
        config.sides =
            static_cast<int>(paper_sides * std::max(config.curve.x_cycles, config.curve.y_cycles));
}

ParameterValue write_path(const RunConfig& config) {
    const PathCurve& curve = config.curve;
    switch (config.path) {
        case PathShape::circle:
            return "circle";
        case PathShape::line:
            return "line";
        case PathShape::ellipse:
            return fmt::format("ellipse:{}", curve.axis_ratio);
        case PathShape::lissajous:
            return fmt::format("lissajous:{}:{}", curve.x_cycles, curve.y_cycles) +
                   (curve.y_lead == 0.0 ? "" : fmt::format(":{}", curve.y_lead));
        case PathShape::points: {
            std::string text(points_word);
            for (const PathPoint& p : curve.points)
                text += fmt::format(" {}:{}:{}", p.time, p.at.x, p.at.y);
            return text;
        }
        case PathShape::polygon:
            break;
    }
    return "polygon";
}

void read_direction(std::string_view text, const ParameterTexts&, RunConfig& config) {
    if (text != "clockwise" && text != "counter-clockwise")
        reject_choice("direction", text, {"counter-clockwise", "clockwise"});
    config.clockwise = text == "clockwise";
}
ParameterValue write_direction(const RunConfig& config) {
    return config.clockwise ? ParameterValue("clockwise") : ParameterValue();
}

std::optional<Message> problem_with_path(const RunConfig& c) {
    if (c.path == PathShape::circle && c.shape() != Shape::disc)
        return Message("circle_with_floor");
    const std::int64_t cycles = std::max(c.curve.x_cycles, c.curve.y_cycles);
    if (c.path == PathShape::lissajous && c.sides < 4 * cycles)
        return Message(
            "few_sides_of_lissajous_figure",
            {{"sides", std::int64_t{c.sides}}, {"cycles", cycles}, {"least", 4 * cycles}});
    const double y_axis = c.amplitude * c.curve.axis_ratio;
    if (c.path == PathShape::ellipse && y_axis > largest_value)
        return Message("wide_ellipse", {{"axis", y_axis}, {"most", largest_value}});
    return {};
}

ContainerPath make_path(const RunConfig& c) {
    ContainerPath path = unshifted_path(c);
    if (c.path_phase != 0.0 && c.path != PathShape::circle && c.amplitude > 0.0) {
        double clock = c.period * (c.path_phase / 360.0);
        // If the phase is that of a vertex, the run starts exactly there.
        for (const Segment& segment : path.segments)
            for (const double vertex : {segment.begin, segment.end})
                if (std::fabs(clock - vertex) <= 1e-9 * c.period) clock = vertex;
        if (clock > 0.0 && clock < c.period) path = path_from(path, clock);
    }
    return c.clockwise ? mirrored(std::move(path)) : path;
}

std::int64_t path_vertices(const RunConfig& c) {
    if (c.path == PathShape::circle || c.amplitude == 0.0) return 1;
    if (c.path == PathShape::points) return static_cast<std::int64_t>(c.curve.points.size()) - 1;
    return c.sides;
}

double container_speed(const RunConfig& c) {
    if (c.path == PathShape::circle) return c.amplitude * c.omega();
    if (c.path == PathShape::polygon)
        return 2.0 * c.amplitude * c.sides * unit_circle(0.5 / c.sides).y / c.period;
    double length = 0.0;
    for (const Segment& segment : unshifted_path(c).segments)
        length +=
            (segment.end - segment.begin) * square_root(dot(segment.velocity, segment.velocity));
    return length / c.period;
}

MeasuredUnits units_of(const RunConfig& c) {
    const double speed =
        c.amplitude > 0.0 ? container_speed(c) : c.radius * (paper_period / c.period);
    return {.r = c.radius, .v = static_cast<double>(static_cast<float>(speed)), .m = c.mass};
}

ObservedDish dish_of(const RunConfig& c) { return {c.container_radius, c.period, units_of(c)}; }

double path_reach(const RunConfig& c) {
    if (c.path != PathShape::ellipse && c.path != PathShape::lissajous) return c.amplitude;
    double square = 0.0;
    for (const Segment& segment : unshifted_path(c).segments)
        square = std::fmax(square, dot(segment.start, segment.start));
    return square_root(square);
}

bool has_m_frame(const RunConfig& c) {
    if (c.amplitude == 0.0) return true;
    if (c.path == PathShape::polygon || c.path == PathShape::circle) return true;
    if (c.path == PathShape::ellipse) return c.curve.axis_ratio == 1.0;
    if (c.path != PathShape::points) return false;
    const ContainerPath path = make_path(c);
    return is_nearly_circular(c.turns_clockwise() ? mirrored(path) : path, c.amplitude);
}

void keep_path_or_sides(ParameterTexts& texts, const ParameterTexts& command_line) {
    const auto path = texts.find("path");
    if (path == texts.end()) return;
    const bool path_given = command_line.contains("path");
    const bool sides_given = command_line.contains("sides");
    const bool has_points = path->second.starts_with(points_word);
    if (path_given && has_points)
        for (const char* name : {"amplitude", "period", "speed"})
            if (!command_line.contains(name)) texts.erase(name);
    if (!has_points && path->second.find("circle") == std::string::npos) return;
    if (path_given && !sides_given) texts.erase("sides");
    if (sides_given && !path_given) texts.erase("path");
}

}  // namespace swirl
