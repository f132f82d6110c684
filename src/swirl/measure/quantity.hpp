// What a printed number is: its name, its unit as powers of r, v and m, and how its values combine.
// The registry (quantities.hpp) has one row for each number of every report and for each column of
// every table.
//
// Measurements compute in the units of the snapshots, whatever these are. A report divides each
// value by its unit, so every printed number is in the unit beside it. Three kinds of value are
// ratios already: rates in Ω, times in T, and angles.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <string_view>

namespace swirl {

/// No constant expression calls it, so it ends the compilation.
void this_is_no_unit();

/// A product of powers, read from its text at compile time: "m v²/r" is {r: −1, v: 2, m: 1}.
struct Unit {
    const char* text;
    int r = 0, v = 0, m = 0;
    int omega = 0;  // power of Ω; T counts −1

    consteval Unit(const char* unit) : text(unit) {  // NOLINT: implicit on purpose
        std::string_view left(unit);
        int sign = 1;
        while (!left.empty()) {
            if (take(left, " ")) continue;
            if (take(left, "/")) {
                sign = -1;
                continue;
            }
            const char symbol = take_symbol(left);
            const int power = sign * (take(left, "²") ? 2 : take(left, "³") ? 3 : 1);
            if (symbol == 'r') r += power;
            if (symbol == 'v') v += power;
            if (symbol == 'm') m += power;
            if (symbol == 'O') omega += power;
            if (symbol == 'T') omega -= power;
        }
    }
    bool is_number() const { return std::string_view(text) == "1"; }
    /// The dimension, as powers of length, time and mass.
    int length() const { return r + v; }
    int time() const { return -v - omega; }
    int mass() const { return m; }

  private:
    static consteval bool take(std::string_view& text, std::string_view symbol) {
        if (!text.starts_with(symbol)) return false;
        text.remove_prefix(symbol.size());
        return true;
    }
    /// '1' for a pure number and for angles.
    static consteval char take_symbol(std::string_view& text) {
        if (take(text, "1") || take(text, "rad") || take(text, "°")) return '1';
        if (take(text, "Ω")) return 'O';
        for (const char* symbol : {"r", "v", "m", "T"})
            if (take(text, symbol)) return *symbol;
        this_is_no_unit();
        return '1';
    }
};

constexpr double integer_power(double base, int exponent) {
    double product = 1.0;
    for (int k = exponent < 0 ? -exponent : exponent; k > 0; --k) product *= base;
    return exponent < 0 ? 1.0 / product : product;
}

/// r, v and m in the units of the snapshots: the radius and the mass of a disc, and the speed of
/// the container.
struct MeasuredUnits {
    double r = 1.0, v = 1.0, m = 1.0;

    double of(const Unit& unit) const {
        return integer_power(r, unit.r) * integer_power(v, unit.v) * integer_power(m, unit.m);
    }
};

/// What a measurement must know about the snapshots to come.
struct ObservedDish {
    double container_radius, period;
    MeasuredUnits units = {};
};

/// How the values of periods make that of a run.
enum class Combines : std::uint8_t {
    as_mean,       // a mean, weighted with what each period contributes
    as_direction,  // the same for an angle in degrees: unit vectors are averaged
    as_count,      // a number of samples, which grows with the run and with the frames
    not_at_all,    // a function of averages, an extreme or a check: a single period has no value
    as_axis        // says where a row of a table is; the same in every run
};

/// What is counted once in the average.
enum class Per : std::uint8_t {
    time,       // equal steps of time, as frames have
    event,      // every event, or every k-th
    collision,  // every collision: recorded frames are not enough
    run         // one value for the run
};

/// Frames per period of a recording below which a value is biased by more than a third of its error
/// in 400 periods, and is n/a. 0 if a frame now and then shows the value. Measured with 5, 12 and
/// 48 discs (tests/run/frame_rates_test.cpp).
struct MinRates {
    double of_frames;  // frames that hold velocities
    double of_tracks;  // positions alone: velocities are differences, which miss collisions
};
/// No rate of a camera is enough.
inline constexpr double never_enough = std::numeric_limits<double>::infinity();

/// True if a recording has this rate, up to the frame that a recording of few periods may lack.
constexpr bool rate_suffices(double frames_per_period, double minimum) {
    return frames_per_period >= 0.99 * minimum;
}

struct Quantity {
    const char* name;  // "temperature.granular", or MEASUREMENT.TABLE.COLUMN
    Unit unit;
    Combines combines;
    Per per;
    MinRates min_rates;
    const char* words;  // empty for columns of tables

    /// The name within its group: "granular".
    constexpr const char* key() const {
        const char* last = name;
        for (const char* c = name; *c != '\0'; ++c)
            if (*c == '.') last = c + 1;
        return last;
    }
    /// "temperature"; empty for a number without a group.
    constexpr std::string_view group() const {
        const std::string_view all(name);
        const std::size_t dot = all.find('.');
        return dot == all.npos ? std::string_view() : all.substr(0, dot);
    }
};

}  // namespace swirl
