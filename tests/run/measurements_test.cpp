#include "swirl/run/measurements.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <tuple>

#include "io/scratch.hpp"
#include "run/measured_run.hpp"
#include "swirl/measure/measurement_list.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/json.hpp"
#include "swirl/run/period_series.hpp"

namespace swirl {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
namespace fs = std::filesystem;

RunConfig thirty_periods() {
    RunConfig config;
    config.discs = 30;
    config.periods = 30;
    config.warmup = 5;
    return config;
}

std::vector<std::string> everything() { return read_measurement_list("all"); }

/// At rest relative to the container, in its middle.
Snapshot make_snapshot_of_one_disc() {
    Snapshot s;
    s.period = paper_period;
    s.container_radius = 20.0;
    s.container_centre = {0.0, -1.892};
    s.resize(1);
    s.set(0, {s.container_centre, {0.0, 0.0}, 0.0, 0.0, 0.0, 1.0, 1.0, 10.0});
    return s;
}

double sum(const nlohmann::ordered_json& column) {
    double total = 0.0;
    for (const auto& value : column) total += value.get<double>();
    return total;
}

TEST(Measurements, DoNotChangeTheRun) {
    const RunResult alone = run(thirty_periods());
    const MeasuredRun measured = measured_run(thirty_periods(), everything());
    EXPECT_EQ(measured.run.state_hash, alone.state_hash);
    EXPECT_EQ(measured.run.rotation.mean_by_event.mean, alone.rotation.mean_by_event.mean);
    EXPECT_EQ(measured.run.rotation.mean_by_time.mean, alone.rotation.mean_by_time.mean);
}

TEST(Measurements, DensityTimesAreaIsTheNumberOfDiscs) {
    const auto density = measured_run(thirty_periods(), {"density"}).measured["density"];
    const double area = 4.0 * paper_container_radius * paper_container_radius / 10000.0;
    // Sums of 10^4 counts divided by one number: round-off only.
    EXPECT_NEAR(sum(density["by_time"]) * area, 30.0, 1e-9);
    EXPECT_NEAR(sum(density["by_event"]) * area, 30.0, 1e-9);
}

TEST(Measurements, Take511SamplesPerPeriodAfterTheWarmUp) {
    const auto flow = measured_run(thirty_periods(), {"flow"}).measured["flow"];
    EXPECT_EQ(sum(flow["visits"]), 30.0 * 511.0 * 25.0);
}

double mean_of(const nlohmann::ordered_json& number) { return number["mean"].get<double>(); }

TEST(Measurements, RatesAreThoseOfTheEventsAfterTheWarmUp) {
    const MeasuredRun done = measured_run(thirty_periods(), {"collisions"});
    const auto& rates = done.measured["collisions"];
    const EventCounts &all = done.run.events, &warm = done.run.warmup_events;
    const double per_disc = 30.0 * 25.0 * paper_period;
    const double with_discs = 2.0 * static_cast<double>(all.disc_disc - warm.disc_disc) / per_disc;
    const double with_wall = static_cast<double>(all.disc_wall - warm.disc_wall) / per_disc;
    // The same counts divided by the same time, in another order.
    EXPECT_NEAR(mean_of(rates["disc_disc_rate"]), with_discs, 1e-12);
    EXPECT_NEAR(mean_of(rates["disc_wall_rate"]), with_wall, 1e-12);
    EXPECT_NEAR(mean_of(rates["mean_free_time"]), 1.0 / (with_discs + with_wall), 1e-12);
    EXPECT_GT(rates["mean_free_time"]["error"].get<double>(), 0.0);
}

/// All text that a result has in files and on the terminal.
std::string written(const MeasurementReports& reports) {
    const Scratch scratch;
    std::string text = measured_json(reports).dump() + measured_text(reports);
    for (const fs::path& file : write_measured_tables(reports, scratch.folder())) {
        std::ifstream opened(file);
        text.append(std::istreambuf_iterator<char>(opened), {});
    }
    return text;
}

void expect_missing_numbers_are_empty(const MeasurementReports& reports, const std::string& what) {
    for (const auto& [name, report] : reports) {
        for (const ReportRow& row : report.rows) {
            EXPECT_FALSE(std::isinf(row.estimate.mean)) << what << " " << name << "." << row.name;
            EXPECT_FALSE(std::isinf(row.estimate.error)) << what << " " << name << "." << row.name;
        }
        const std::string text = written({{name, report}});
        // As values, not in names such as "frequency_finite".
        for (const char* value : {",inf", ",-inf", ",nan", ",-nan", " inf", " nan", ":inf"})
            EXPECT_EQ(text.find(value), std::string::npos) << what << " " << name << value;
    }
}

TEST(MeasuredText, CountsMissingAveragesOnceTheyAreMostOfThem) {
    for (const std::size_t missing : {2u, 3u}) {
        MeasurementReport report{"speeds", {}};
        for (std::size_t k = 0; k < 5; ++k)
            report.report.rows.push_back(
                {quantity("rolling.floor_slip"), {k < missing ? std::nan("") : 1.0, 0.1}});
        const std::string text = measured_text({report});
        EXPECT_EQ(text.find("3 of 5 averages") != std::string::npos, missing == 3) << text;
        EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), missing == 3 ? 3 : 5) << text;
    }
}

// No sample, no period, one disc, a disc that is never pinned, no collision: every number that does
// not exist is missing in the same way.
TEST(Measurements, NumbersThatDoNotExistAreMissingInEveryFile) {
    RunConfig config;
    config.discs = 1;
    config.periods = 3;
    config.warmup = 0;
    Observation nothing = observation_of(config, everything());
    expect_missing_numbers_are_empty(nothing.report(), "no sample");
    nothing.close_block();
    expect_missing_numbers_are_empty(nothing.report(), "an empty period");
    for (const std::int64_t discs : {1, 2}) {
        config.discs = discs;
        Observation observation = observation_of(config, everything());
        PeriodSeries series(config, everything());
        RunControl control;
        control.observation = &observation;
        control.series = &series;
        run(config, control);
        expect_missing_numbers_are_empty(observation.report(), fmt::format("{} discs", discs));
        const std::string table = "\n" + series.header() + series.rows();
        for (const char* value : {",inf", ",-inf", ",nan", ",-nan"})
            EXPECT_EQ(table.find(value), std::string::npos) << discs << value;
    }
    // A disc in the middle of a large container: frames, and vertices of the path as events.
    Snapshot s = make_snapshot_of_one_disc();
    Observation at_rest({s.container_radius, s.period}, everything());
    Event vertex{};
    vertex.kind = EventKind::path_vertex;
    for (int period = 0; period < 2; ++period) {
        s.periods = period;
        for (int k = 0; k < samples_per_period; ++k) {
            s.clock = s.period * k / samples_per_period;
            s.held_at[0] = s.clock;
            at_rest.sample(s);
        }
        at_rest.sample(vertex, s);
        at_rest.close_block();
    }
    expect_missing_numbers_are_empty(at_rest.report(), "at rest");
}

TEST(Measurements, OrderAndPackingAreWithinTheirBounds) {
    const auto measured = measured_run(thirty_periods(), {"order", "packing"}).measured;
    // The mean over discs of π/(area) is at least π over the mean area, by Jensen's inequality.
    const double over_the_container = 30.0 / (paper_container_radius * paper_container_radius);
    for (const char* whose : {"all", "pinned"}) {
        EXPECT_GT(mean_of(measured["order"][whose]), 0.0);
        EXPECT_LT(mean_of(measured["order"][whose]), 1.0);
        EXPECT_LT(mean_of(measured["packing"][whose]), 1.0);
    }
    EXPECT_GT(mean_of(measured["packing"]["all"]), over_the_container);
}

TEST(Measurements, DiffusionHasLagsBelowAPeriodAndOfWholePeriods) {
    const auto table = measured_run(thirty_periods(), {"diffusion"}).measured["diffusion"];
    // Lags of 1, 2, 4, … 64 of 73 parts of a period, and, in 25 periods, lags of 1, 2, 4, 8 and 16
    // periods.
    ASSERT_EQ(table["lag"].size(), 12u);
    EXPECT_NEAR(table["lag"][0].get<double>(), paper_period / 73.0, 1e-9);
    EXPECT_NEAR(table["lag"][7].get<double>(), paper_period, 1e-9);
    EXPECT_NEAR(table["lag"][11].get<double>(), 16.0 * paper_period, 1e-9);
    // At the shortest lag discs fly almost straight; at no lag do they leave the container.
    const double flight = table["displacement"][0].get<double>();
    EXPECT_NEAR(table["displacement"][1].get<double>() / flight, 4.0, 0.5);
    for (const auto& square : table["displacement"])
        EXPECT_LT(square.get<double>(), 4.0 * 7.6 * 7.6);
}

TEST(Measurements, ListOfAllHasEveryMeasurement) {
    const std::vector<std::string> rows = std::apply(
        [](const auto&... row) { return std::vector<std::string>{row.name...}; }, measurement_list);
    EXPECT_EQ(everything(), rows);
    EXPECT_GT(rows.size(), 20u);
}

TEST(Measurements, OneDiscIsMeasuredWithoutACrash) {
    RunConfig config = thirty_periods();
    config.discs = 1;
    const MeasuredRun done = measured_run(config, everything());
    EXPECT_EQ(mean_of(done.measured["collisions"]["disc_disc_rate"]), 0.0);
    EXPECT_TRUE(std::isnan(done.measured["order"]["all"]["mean"].get<double>()));
    // Its cell is the whole container.
    EXPECT_NEAR(mean_of(done.measured["packing"]["all"]),
                1.0 / (paper_container_radius * paper_container_radius), 1e-12);
}

TEST(Measurements, FramesWithoutEventsGiveNoCollisionRates) {
    Observation observation = observation_of(thirty_periods(), everything());
    for (int period = 0; period < 3; ++period) observation.close_block();
    for (const auto& [name, report] : observation.report())
        for (const ReportRow& row : report.rows)
            EXPECT_TRUE(std::isnan(row.estimate.mean)) << name << "." << row.name;
}

TEST(Measurements, ListKeepsTheOrderAndDropsDuplicates) {
    EXPECT_THAT(read_measurement_list("flow,density,flow"), ElementsAre("flow", "density"));
    EXPECT_EQ(everything().size(), measurement_kinds().size());
}

TEST(Measurements, InvalidListsAreRejectedWithTheirCause) {
    const std::pair<const char*, const char*> cases[] = {
        {"flow,dennsity", "density, flow, profile"},
        {"", "a name in the list is empty"},
        {"flow,", "a name in the list is empty"},
        {"all,flow", "cannot be combined"},
    };
    for (const auto& [list, cause] : cases) {
        try {
            read_measurement_list(list);
            FAIL() << list;
        } catch (const UsageError& wrong) {
            EXPECT_THAT(wrong.what(), HasSubstr(cause)) << list;
        }
    }
}

TEST(Measurements, TablesAreWrittenWithTheirColumns) {
    const Scratch scratch;
    const fs::path& folder = scratch.folder();
    Observation observation = observation_of(thirty_periods(), {"profile", "slip"});
    RunControl control;
    control.observation = &observation;
    run(thirty_periods(), control);
    const auto files = write_measured_tables(observation.report(), folder);
    EXPECT_THAT(files, ElementsAre(folder / "profile.csv", folder / "numbers.csv"));
    std::ifstream profile(files[0]), numbers(files[1]);
    std::string line;
    std::getline(profile, line);
    EXPECT_EQ(line,
              "theta,visits,varpi_m,varpi_m_error,wall,normalised,normalised_error,distance,"
              "distance_error,speed,speed_error");
    std::getline(numbers, line);
    EXPECT_EQ(line, "quantity,unit,mean,error,effective_samples,blocks");
    std::getline(numbers, line);
    EXPECT_THAT(line, HasSubstr("slip.cluster,1,0."));
}

std::string text_of(const fs::path& file) {
    std::ifstream in(file);
    return {std::istreambuf_iterator<char>(in), {}};
}

/// The line of the help on a number or table, empty if there is none.
std::string line_of(const std::string& help, const std::string& name) {
    const std::size_t begin = help.find("\n  " + name + " ");
    return begin == help.npos ? "" : help.substr(begin, help.find('\n', begin + 1) - begin);
}

TEST(Measurements, EveryRowAndTableIsInTheJsonInTheCsvAndInTheHelp) {
    const Scratch scratch;
    Observation observation = observation_of(thirty_periods(), everything());
    RunControl control;
    control.observation = &observation;
    run(thirty_periods(), control);
    const MeasurementReports reports = observation.report();
    write_measured_tables(reports, scratch.folder());
    const auto json = measured_json(reports);
    const std::string numbers = text_of(scratch / "numbers.csv"), help = measurement_help_text(),
                      terminal = measured_text(reports),
                      docs = text_of(fs::path(SWIRL_SOURCE_DIR) / "docs/reference/measurements.md");
    for (const auto& [name, report] : reports) {
        EXPECT_TRUE(docs.find("\n### " + name + "\n") != std::string::npos)
            << "docs/reference/measurements.md has no section '### " << name << "'";
        for (const ReportRow& row : report.rows) {
            const std::string full = name + "." + row.name;
            EXPECT_TRUE(json.at(name).contains(row.name)) << full;
            EXPECT_THAT(numbers, HasSubstr("\n" + full + "," + row.unit + ","));
            EXPECT_THAT(line_of(help, full),
                        AllOf(HasSubstr(row.unit), HasSubstr(row.description)));
            // Discs do not roll, and equal ones do not segregate: one line "n/a" replaces the rows
            // of such a measurement.
            const bool is_absent = name == "rolling" || name == "segregation";
            EXPECT_THAT(terminal, HasSubstr(is_absent ? "  " + name + "  " : "  " + full + " "));
        }
        for (const ReportTable& table : report.tables) {
            const std::string full = *table.name == '\0' ? name : name + "." + table.name;
            const auto& columns = *table.name == '\0' ? json.at(name) : json.at(name)[table.name];
            const std::string csv = text_of(scratch / (full + ".csv"));
            EXPECT_THAT(line_of(help, full), HasSubstr(table.description));
            EXPECT_THAT(help, HasSubstr(" " + std::string(table.columns.front().name)));
            EXPECT_THAT(terminal, HasSubstr("  " + full + " "));
            for (const ReportColumn& column : table.columns) {
                EXPECT_EQ(columns.at(column.name).size(), table.rows()) << full;
                EXPECT_THAT(csv.substr(0, csv.find('\n')), HasSubstr(column.name));
            }
        }
    }
}

TEST(Measurements, EveryRowOfEveryRunIsInTheJsonAndInTheHelp) {
    const RunResult result = run(thirty_periods());
    const auto json = result_json(result);
    const std::string help = measurement_help_text();
    int rows = 0;
    result.report([&](const std::string& group, const ReportRow& row) {
        const std::string full = (group.empty() ? "" : group + ".") + row.name;
        const auto& there = group.empty() ? json : json.at(group);
        EXPECT_EQ(there.at(row.name).dump(), row_json(row).dump()) << full;
        EXPECT_THAT(line_of(help, full), AllOf(HasSubstr(row.unit), HasSubstr(row.description)));
        ++rows;
    });
    EXPECT_EQ(rows, 20);
    EXPECT_EQ(json.at("steady_state").at("spin_change").dump(),
              nlohmann::ordered_json(result.steady_spin.change.size).dump());
    EXPECT_EQ(json.at("energy").get<double>(), result.energy);
    EXPECT_EQ(json.at("max_overlap").get<double>(), result.max_overlap);
}

}  // namespace
}  // namespace swirl
