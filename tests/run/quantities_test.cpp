// Properties that every printed number must have, whatever it measures: a change of units changes
// none, nor does the mirror image, and the periods of a series add up to the run.
#include "swirl/measure/quantities.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <optional>
#include <regex>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "swirl/run/measurements.hpp"
#include "swirl/run/period_series.hpp"
#include "swirl/run/run.hpp"

namespace swirl {
namespace quantity_properties {

struct PrintedNumber {
    std::string name;
    const Quantity* quantity;
    double value;
};

/// All rows of the run and of its measurements, and all values of their tables.
std::vector<PrintedNumber> numbers_of(const RunResult& run, const MeasurementReports& reports) {
    std::vector<PrintedNumber> all;
    const auto add = [&](const ReportRow& row) {
        const std::string name = row.quantity->name;
        all.push_back({name, row.quantity, row.estimate.mean});
        all.push_back({name + " error", row.quantity, row.estimate.error});
        for (const ReportDetail& detail : row.details)
            all.push_back({name + " " + detail.name, row.quantity, detail.value});
    };
    run.report([&](const std::string&, const ReportRow& row) { add(row); });
    for (const auto& [measurement, report] : reports) {
        for (const ReportRow& row : report.rows) add(row);
        for (const ReportTable& table : report.tables)
            for (std::size_t k = 0; k < table.values.size(); ++k) {
                const ReportColumn& column = table.columns[k % table.columns.size()];
                all.push_back({measurement + "." + table.name + "." + column.name + " " +
                                   std::to_string(k / table.columns.size()),
                               column.quantity, table.values[k]});
            }
    }
    return all;
}

std::vector<PrintedNumber> measured(const RunConfig& config,
                                    std::optional<FinalState> begin_from = {}) {
    Observation observation = observation_of(config, read_measurement_list("all"));
    RunControl control;
    control.observation = &observation;
    control.begin_from = std::move(begin_from);
    const RunResult result = run(config, control);
    return numbers_of(result, observation.report());
}

bool equal_or_missing(double a, double b) { return (std::isnan(a) && std::isnan(b)) || a == b; }

/// Reports each quantity once.
void expect_same(const std::vector<PrintedNumber>& a, const std::vector<PrintedNumber>& b) {
    ASSERT_EQ(a.size(), b.size());
    std::set<const Quantity*> different;
    std::size_t known = 0;
    for (std::size_t k = 0; k < a.size(); ++k) {
        known += std::isnan(a[k].value) ? 0 : 1;
        if (equal_or_missing(a[k].value, b[k].value) || !different.insert(a[k].quantity).second)
            continue;
        ADD_FAILURE() << a[k].name << ": " << a[k].value << " and " << b[k].value;
    }
    EXPECT_GT(known, a.size() / 8);
}

RunConfig known(const ParameterTexts& texts) {
    RunConfig config = resolve(texts);
    config.periods = 24;
    config.warmup = 2;
    return config;
}
RunConfig discs() {
    return known({{"discs", "28"}, {"restitution", "0.98"}, {"mixture", "25%:0.75"}});
}
RunConfig spheres() { return known({{"preset", "experiment"}, {"discs", "24"}}); }

struct Factors {
    double length = 1.0, time = 1.0, mass = 1.0;
};

/// The same dish in other units.
RunConfig in_units(RunConfig c, const Factors& f) {
    for (double* l : {&c.radius, &c.container_radius, &c.amplitude}) *l *= f.length;
    for (double* t : {&c.period, &c.contact_duration}) *t *= f.time;
    c.gravity *= f.length / (f.time * f.time);
    c.mass *= f.mass;
    c.inertia *= f.mass * f.length * f.length;
    if (c.mixture) {
        c.mixture->radius *= f.length;
        c.mixture->mass *= f.mass;
    }
    return c;
}
/// The placement stops at an absolute distance, so all runs start from the discs of one.
FinalState beginning(const RunConfig& config, const Factors& f) {
    const InitialState first = make_initial_state(config);
    FinalState state{f.length * first.path.segments.front().start, first.discs};
    for (Disc& disc : state.discs) {
        disc.position = f.length * disc.position;
        disc.velocity = (f.length / f.time) * disc.velocity;
        disc.radius *= f.length;
        disc.mass *= f.mass;
        disc.inertia *= f.mass * f.length * f.length;
    }
    return state;
}

// The factors are powers of two, so nothing is rounded.
TEST(Quantities, DoNotDependOnTheUnitsOfTheRun) {
    constexpr Factors factors[] = {
        {.length = 4.0}, {.time = 0.5}, {.mass = 8.0}, {0.25, 2.0, 16.0}};
    for (const RunConfig& dish : {discs(), spheres()}) {
        SCOPED_TRACE(body_word(dish));
        const std::vector<PrintedNumber> here = measured(dish, beginning(dish, {}));
        for (const Factors& f : factors) {
            SCOPED_TRACE(testing::Message() << f.length << " " << f.time << " " << f.mass);
            expect_same(here, measured(in_units(dish, f), beginning(dish, f)));
        }
    }
}

/// Discs with given positions and velocities, here and in the mirror.
RunConfig placed(RunConfig config) {
    for (const Disc& disc : make_initial_state(config).discs)
        config.initial.push_back({disc.position, disc.velocity, 0.1});
    return config;
}
RunConfig in_the_mirror(RunConfig config) {
    config.clockwise = !config.clockwise;
    for (InitialMotion& motion : config.initial) {
        motion.position.y = -motion.position.y;
        motion.velocity.y = -motion.velocity.y;
        motion.spin = -motion.spin;
    }
    return config;
}

TEST(Quantities, CountWithTheSwirlInAClockwiseDish) {
    for (const char* path : {"polygon", "circle", "ellipse:0.75"}) {
        SCOPED_TRACE(path);
        ParameterTexts texts{{"discs", "28"}, {"restitution", "0.98"}, {"path", path}};
        const RunConfig dish = placed(known(texts));
        expect_same(measured(dish), measured(in_the_mirror(dish)));
    }
}

/// Angles in degrees are compared on the circle.
double distance(double a, double b, bool degrees) {
    return degrees ? std::remainder(a - b, 360.0) : a - b;
}

TEST(Quantities, OfPeriodsAddUpToTheRun) {
    for (RunConfig dish : {discs(), spheres()}) {
        SCOPED_TRACE(body_word(dish));
        dish.warmup = 0;
        const std::vector<std::string> names = read_measurement_list("all");
        Observation observation = observation_of(dish, names);
        PeriodSeries series(dish, names);
        RunControl control;
        control.observation = &observation;
        control.series = &series;
        const RunResult result = run(dish, control);
        std::vector<ReportRow> rows;
        result.rotation.report([&](const ReportRow& row) { rows.push_back(row); });
        for (const auto& [name, report] : observation.report())
            rows.insert(rows.end(), report.rows.begin(), report.rows.end());
        const std::vector<SeriesAverage> averages = series.averages();
        std::size_t compared = 0;
        for (const ReportRow& row : rows) {
            const std::string full = row.quantity->name, key = row.name;
            const auto average =
                std::find_if(averages.begin(), averages.end(), [&](const SeriesAverage& a) {
                    return a.name == full || ("rotation." + a.name) == full;
                });
            ASSERT_NE(average, averages.end()) << full;
            const double whole = row.estimate.mean, mean = average->estimate.mean;
            if (row.quantity->combines == Combines::not_at_all || std::isnan(whole)) {
                EXPECT_TRUE(std::isnan(mean)) << full << " " << mean;
                continue;
            }
            // The sums are added in another order.
            const bool degrees = row.quantity->combines == Combines::as_direction;
            EXPECT_LT(std::fabs(distance(mean, whole, degrees)), 1e-9 * (1.0 + std::fabs(whole)))
                << full << " " << mean << " " << whole;
            ++compared;
        }
        EXPECT_GT(compared, rows.size() / 3);
    }
}

TEST(Quantities, AreNamedOnce) {
    std::set<std::string> names;
    for (const Quantity& row : all_quantities::rows)
        EXPECT_TRUE(names.insert(row.name).second) << row.name;
}

/// The rows of the table of frame rates in the documentation.
std::set<std::pair<std::string, std::string>> documented_rates() {
    std::ifstream lines(SWIRL_SOURCE_DIR "/docs/reference/measurements.md");
    std::set<std::pair<std::string, std::string>> rates;
    bool inside = false;
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with("| values | frames per period, with velocities |")) inside = true;
        if (inside && line.empty()) break;
        std::smatch cells;
        static const std::regex row(R"(.*\| (\d+) \| (\d+|none) \|)");
        if (inside && std::regex_match(line, cells, row)) rates.emplace(cells[1], cells[2]);
    }
    return rates;
}

// Only slow tests measure the bias at these rates.
TEST(Quantities, HaveTheFrameRatesOfTheDocumentation) {
    const auto text = [](double rate) {
        return rate == never_enough ? std::string("none") : fmt::format("{:.0f}", rate);
    };
    std::set<std::pair<std::string, std::string>> rates;
    for (const Quantity& row : all_quantities::rows)
        if (row.min_rates.of_tracks > 0.0)
            rates.emplace(text(row.min_rates.of_frames), text(row.min_rates.of_tracks));
    EXPECT_EQ(rates, documented_rates());
}

TEST(Quantities, HaveTheDimensionOfTheirUnit) {
    const Unit& power = quantity("energy.wall_power").unit;
    EXPECT_EQ(power.length(), 2);
    EXPECT_EQ(power.time(), -3);
    EXPECT_EQ(power.mass(), 1);
    EXPECT_EQ(quantity("residence.length").unit.time(), 1);
    EXPECT_EQ(quantity("fluctuations.n_variance").unit.time(), -2);
    EXPECT_EQ(quantity("radial.density").unit.length(), -2);
}

}  // namespace quantity_properties
}  // namespace swirl
