#include "lab/measurements.hpp"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>

#include "lab/failure.hpp"

namespace swirl {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
namespace fs = std::filesystem;

RunConfig short_run() {
    RunConfig config;
    config.discs = 30;
    config.periods = 30;
    config.warmup = 5;
    return config;
}

std::vector<std::string> everything() { return read_measurement_list("all"); }

double sum(const nlohmann::ordered_json& column) {
    double total = 0.0;
    for (const auto& value : column) total += value.get<double>();
    return total;
}

TEST(Measurements, NotABitOfTheRunChanges) {
    const RunResult alone = run(short_run());
    const MeasuredRun measured = measured_run(short_run(), everything());
    EXPECT_EQ(measured.run.state_hash, alone.state_hash);
    EXPECT_EQ(measured.run.rotation.by_event.mean, alone.rotation.by_event.mean);
    EXPECT_EQ(measured.run.rotation.by_time.mean, alone.rotation.by_time.mean);
}

TEST(Measurements, DensityTimesAreaIsTheNumberOfDiscs) {
    const auto density = measured_run(short_run(), {"density"}).measured["density"];
    const double area = 4.0 * paper_container_radius * paper_container_radius / 10000.0;
    // Sums of 10^4 counts divided by one number: round-off only.
    EXPECT_NEAR(sum(density["by_time"]) * area, 30.0, 1e-9);
    EXPECT_NEAR(sum(density["by_event"]) * area, 30.0, 1e-9);
}

TEST(Measurements, LooksAreMadeOnlyAfterTheWarmUpAnd511TimesAPeriod) {
    const auto flow = measured_run(short_run(), {"flow"}).measured["flow"];
    EXPECT_EQ(sum(flow["visits"]), 30.0 * 511.0 * 25.0);
}

TEST(Measurements, TheRotationOfTheProfileIsThatOfTheRun) {
    // ϖ_M = ϖ − Ω; the slices' means weighted with their visits make the mean over the discs. The
    // run looks 64 times a period, the profile 511 times: they agree within the error.
    const MeasuredRun done = measured_run(short_run(), {"profile"});
    const auto& profile = done.measured["profile"];
    double total = 0.0;
    for (std::size_t k = 0; k < profile["theta"].size(); ++k)
        if (profile["visits"][k].get<double>() > 0.0)
            total += profile["visits"][k].get<double>() * profile["varpi_m"][k].get<double>();
    EXPECT_NEAR(total / sum(profile["visits"]) + 1.0, done.run.rotation.by_time.mean,
                3.0 * done.run.rotation.by_time.error);
}

TEST(Measurements, ListIsReadInOrderAndWithoutDoubles) {
    EXPECT_THAT(read_measurement_list("flow,density,flow"), ElementsAre("flow", "density"));
    EXPECT_EQ(everything().size(), measurement_kinds().size());
}

TEST(Measurements, UnknownNameIsRefusedWithThoseThereAre) {
    for (const char* list : {"flow,dennsity", "", "flow,", "all,flow"}) {
        try {
            read_measurement_list(list);
            FAIL() << list;
        } catch (const WrongCall& wrong) {
            EXPECT_THAT(wrong.what(), HasSubstr("density, flow, profile"));
        }
    }
}

TEST(Measurements, TablesAreWrittenWithTheirColumns) {
    const fs::path folder = fs::path(::testing::TempDir()) / "measured_tables";
    fs::create_directories(folder);
    const auto files =
        write_measured_tables(measured_run(short_run(), {"profile", "slip"}).measured, folder);
    EXPECT_THAT(files, ElementsAre(folder / "profile.csv", folder / "numbers.csv"));
    std::ifstream profile(files[0]), numbers(files[1]);
    std::string line;
    std::getline(profile, line);
    EXPECT_EQ(line, "theta,visits,varpi_m,varpi_m_error,wall,normalised,normalised_error");
    std::getline(numbers, line);
    EXPECT_EQ(line, "quantity,mean,error,effective_samples,blocks");
    std::getline(numbers, line);
    EXPECT_THAT(line, HasSubstr("slip.cluster,0."));
    fs::remove_all(folder);
}

}  // namespace
}  // namespace swirl
