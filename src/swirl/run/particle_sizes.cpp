#include "swirl/run/particle_sizes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "swirl/math/elementary.hpp"
#include "swirl/math/normal_deviate.hpp"
#include "swirl/math/random.hpp"
#include "swirl/run/config.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/parameter_readers.hpp"

namespace swirl {
namespace {

constexpr std::string_view list_word = "list";
/// Gaussian deviates beyond this many standard deviations are drawn again.
constexpr double max_deviation = 3.0;
constexpr double max_log_deviation = 1.0, max_exponent = 20.0;

struct Form {
    SizeLaw law;
    std::string_view word;
    std::size_t numbers;
    const char* text;
};
constexpr Form forms[] = {{SizeLaw::uniform, "uniform", 2, "uniform:MIN:MAX"},
                          {SizeLaw::normal, "normal", 2, "normal:MEAN:SD"},
                          {SizeLaw::lognormal, "lognormal", 2, "lognormal:MEDIAN:SD_OF_LN"},
                          {SizeLaw::power, "power", 3, "power:EXPONENT:MIN:MAX"}};

[[noreturn]] void reject_sizes(std::string_view text) {
    Message message("not_sizes", {{"text", text}});
    add_nearest_value(message, text.substr(0, text.find(':')),
                      {"uniform", "normal", "lognormal", "power", "file"});
    throw_usage_error(message);
}

Sizes listed_sizes(std::string_view text) {
    Sizes sizes{SizeLaw::listed, {}, {}};
    text.remove_prefix(list_word.size());
    for (const std::string_view part : split(text, " ")) {
        if (part.empty()) continue;
        const auto numbers = split(part, ":");
        const auto radius = read_number(numbers[0]);
        const auto mass = numbers.size() == 2 ? read_number(numbers[1]) : std::nullopt;
        if (!radius || numbers.size() > 2 || (numbers.size() == 2 && !mass))
            throw_usage_error(
                Message("not_a_size",
                        {{"entry", static_cast<double>(sizes.listed.size() + 1)}, {"text", part}}));
        sizes.listed.push_back({*radius, mass});
    }
    if (sizes.listed.empty()) throw_usage_error(Message("no_sizes"));
    return sizes;
}

double drawn_radius(const Sizes& sizes, Random& random) {
    const auto& [a, b, c] = sizes.numbers;
    const auto deviate = [&random] {
        for (;;) {
            const double z = normal_deviate(random);
            if (z >= -max_deviation && z <= max_deviation) return z;
        }
    };
    switch (sizes.law) {
        case SizeLaw::uniform:
            return a + random.uniform() * (b - a);
        case SizeLaw::normal:
            return a + b * deviate();
        case SizeLaw::lognormal:
            return a * exponential(b * deviate());
        case SizeLaw::power: {
            // The inverse of the distribution function, relative to the smallest radius.
            const double u = random.uniform(), log_ratio = logarithm(c / b), s = 1.0 - a;
            constexpr double nearly_one = 1e-6;
            const double relative =
                std::fabs(s) < nearly_one
                    ? exponential(u * log_ratio)
                    : power(1.0 + u * (exponential(s * log_ratio) - 1.0), 1.0 / s);
            return std::clamp(b * relative, b, c);
        }
        case SizeLaw::listed:
            break;
    }
    return 0.0;
}

std::optional<Message> outside_range(const Message& what, double value, double from, double to) {
    if (value >= from && value <= to) return {};
    return Message("out_of_range", {{"name", what}, {"value", value}, {"from", from}, {"to", to}});
}

std::optional<Message> problem_with_list(const RunConfig& c) {
    const auto& listed = c.sizes->listed;
    if (listed.size() > max_listed_sizes)
        return Message("too_many_sizes", {{"listed", static_cast<double>(listed.size())},
                                          {"most", static_cast<double>(max_listed_sizes)}});
    if (static_cast<std::int64_t>(listed.size()) != c.discs)
        return Message("other_number_of_sizes",
                       {{"listed", static_cast<double>(listed.size())}, {"discs", c.discs}});
    for (const ListedSize& size : listed) {
        if (auto message =
                outside_range(Message("size_radius"), size.radius, smallest_value, largest_value))
            return message;
        if (!size.mass) continue;
        if (auto message =
                outside_range(Message("size_mass"), *size.mass, smallest_value, largest_value))
            return message;
    }
    return {};
}

}  // namespace

void read_sizes(std::string_view text, const ParameterTexts& given, RunConfig& config) {
    if (text.starts_with("list ")) {
        config.sizes = listed_sizes(text);
        if (!given.contains("discs"))
            config.discs = static_cast<std::int64_t>(config.sizes->listed.size());
        return;
    }
    const auto parts = split(text, ":");
    for (const Form& form : forms) {
        if (parts.front() != form.word) continue;
        Sizes sizes{form.law, {}, {}};
        bool valid = parts.size() == form.numbers + 1;
        for (std::size_t k = 0; valid && k < form.numbers; ++k) {
            const auto number = read_number(parts[k + 1]);
            valid = number.has_value();
            if (valid) sizes.numbers[k] = *number;
        }
        if (!valid)
            throw_usage_error(Message("not_of_this_form", {{"text", text}, {"form", form.text}}));
        config.sizes = sizes;
        return;
    }
    reject_sizes(text);
}

ParameterValue write_sizes(const RunConfig& config) {
    if (!config.sizes) return {};
    std::string text;
    for (const Form& form : forms) {
        if (form.law != config.sizes->law) continue;
        text = form.word;
        for (std::size_t k = 0; k < form.numbers; ++k)
            text += fmt::format(":{}", config.sizes->numbers[k]);
        return text;
    }
    text = list_word;
    for (const ListedSize& size : config.sizes->listed)
        text += size.mass ? fmt::format(" {}:{}", size.radius, *size.mass)
                          : fmt::format(" {}", size.radius);
    return text;
}

double mass_of_same_material(double radius, const RunConfig& config) {
    const double ratio = radius / config.radius;
    return config.mass * ratio * ratio * (config.body == Shape::sphere ? ratio : 1.0);
}

RadiusBounds radius_bounds(const RunConfig& c) {
    if (c.mixture)
        return {std::fmin(c.radius, c.mixture->radius), std::fmax(c.radius, c.mixture->radius)};
    if (!c.sizes) return {c.radius, c.radius};
    const auto& [a, b, last] = c.sizes->numbers;
    switch (c.sizes->law) {
        case SizeLaw::uniform:
            return {a, b};
        case SizeLaw::normal:
            return {a - max_deviation * b, a + max_deviation * b};
        case SizeLaw::lognormal:
            return {a * exponential(-max_deviation * b), a * exponential(max_deviation * b)};
        case SizeLaw::power:
            return {b, last};
        case SizeLaw::listed:
            break;
    }
    const auto [least, most] = std::minmax_element(
        c.sizes->listed.begin(), c.sizes->listed.end(),
        [](const ListedSize& x, const ListedSize& y) { return x.radius < y.radius; });
    return {least->radius, most->radius};
}

Message radii_text(const RunConfig& c) {
    if (c.mixture) return {"two_radii", {{"radius", c.radius}, {"second", c.mixture->radius}}};
    if (!c.sizes) return {"one_radius", {{"radius", c.radius}}};
    if (c.sizes->law != SizeLaw::listed)
        return {"radii_of_law", {{"law", std::get<std::string>(write_sizes(c))}}};
    const RadiusBounds bounds = radius_bounds(c);
    return {"radii_between", {{"from", bounds.smallest}, {"to", bounds.largest}}};
}

std::vector<double> which_can_spin(const RunConfig& c, std::size_t n) {
    std::vector<double> can_spin(n, 1.0);
    const auto held = static_cast<std::size_t>(std::llround(c.cannot_spin * double(n)));
    std::vector<std::size_t> others(held == 0 ? 0 : n);
    std::iota(others.begin(), others.end(), std::size_t{0});
    // A separate stream: the choice must not depend on the numbers that place the discs.
    constexpr std::uint64_t stream = 0x6361'6e6e'6f74'2073;  // "cannot s" in ASCII
    Random random(Random(c.seed ^ stream).bits());
    for (std::size_t k = 0; k < held; ++k) {
        std::swap(others[k], others[k + random.below(n - k)]);
        can_spin[others[k]] = 0.0;
    }
    return can_spin;
}

namespace {

std::vector<ParticleProperties> sizes_of(const RunConfig& c) {
    const auto n = static_cast<std::size_t>(c.discs);
    std::vector<ParticleProperties> particles(n, {c.radius, c.mass, c.inertia});
    const double inertia_factor = c.inertia / (c.mass * c.radius * c.radius);
    if (c.mixture)
        for (std::size_t i = n - static_cast<std::size_t>(c.mixture->count); i < n; ++i)
            particles[i] = {
                c.mixture->radius, c.mixture->mass,
                inertia_factor * c.mixture->mass * c.mixture->radius * c.mixture->radius};
    if (!c.sizes) return particles;
    // A separate stream: radii must not repeat the numbers that place the discs.
    constexpr std::uint64_t stream = 0x7369'7a65'7320'6f66;  // "sizes of" in ASCII
    Random random(Random(c.seed ^ stream).bits());
    for (std::size_t i = 0; i < n; ++i) {
        const bool is_listed = c.sizes->law == SizeLaw::listed;
        const double r = is_listed ? c.sizes->listed[i].radius : drawn_radius(*c.sizes, random);
        const double m = is_listed && c.sizes->listed[i].mass ? *c.sizes->listed[i].mass
                                                              : mass_of_same_material(r, c);
        particles[i] = {r, m, inertia_factor * m * r * r};
    }
    return particles;
}

}  // namespace

std::vector<ParticleProperties> particles_of(const RunConfig& c) {
    std::vector<ParticleProperties> particles = sizes_of(c);
    const std::vector<double> can_spin = which_can_spin(c, particles.size());
    for (std::size_t i = 0; i < particles.size(); ++i) particles[i].can_spin = can_spin[i];
    return particles;
}

std::optional<Message> problem_with_sizes(const RunConfig& c) {
    if (!c.sizes) return {};
    if (c.mixture) return Message("sizes_and_mixture");
    const auto& [a, b, last] = c.sizes->numbers;
    switch (c.sizes->law) {
        case SizeLaw::listed:
            return problem_with_list(c);
        case SizeLaw::normal:
            if (!(b >= 0.0 && max_deviation * b < a))
                return Message("wide_sizes",
                               {{"mean", a}, {"deviation", b}, {"most", max_deviation}});
            break;
        case SizeLaw::lognormal:
            if (auto message = outside_range(Message("size_deviation"), b, 0.0, max_log_deviation))
                return message;
            break;
        case SizeLaw::power:
            if (auto message =
                    outside_range(Message("size_exponent"), a, -max_exponent, max_exponent))
                return message;
            break;
        case SizeLaw::uniform:
            break;
    }
    const double low = c.sizes->law == SizeLaw::power ? b : a;
    const double high = c.sizes->law == SizeLaw::power ? last : b;
    const bool is_interval = c.sizes->law == SizeLaw::power || c.sizes->law == SizeLaw::uniform;
    if (auto message = outside_range(Message("size_radius"), low, smallest_value, largest_value))
        return message;
    if (is_interval && !(high >= low && high <= largest_value))
        return Message("largest_below_smallest",
                       {{"value", high}, {"from", low}, {"to", largest_value}});
    const RadiusBounds bounds = radius_bounds(c);
    if (auto message =
            outside_range(Message("size_smallest"), bounds.smallest, smallest_value, largest_value))
        return message;
    return outside_range(Message("size_largest"), bounds.largest, smallest_value, largest_value);
}

}  // namespace swirl
