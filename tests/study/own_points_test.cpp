#include "swirl/study/own_points.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "swirl/run/failure.hpp"

namespace swirl {
namespace {

class OwnPoints : public ::testing::Test {
  protected:
    void SetUp() override { std::filesystem::create_directories(folder_); }
    void TearDown() override { std::filesystem::remove_all(folder_); }

    std::vector<RotationPoint> read(const std::string& text, std::optional<double> period = {}) {
        const std::string file = folder_ / "mine.csv";
        std::ofstream(file) << text;
        return read_own_points(file, period);
    }
    std::string error(const std::string& text) {
        try {
            read(text);
        } catch (const UsageError& wrong) {
            return wrong.what();
        }
        return "";
    }

    const std::filesystem::path folder_ =
        std::filesystem::path(::testing::TempDir()) /
        ::testing::UnitTest::GetInstance()->current_test_info()->name();
};

TEST_F(OwnPoints, TurnsHaveTheErrorOfReadingAMark) {
    const double reading = std::sqrt(2.0) / 12.0;
    for (const char* text :
         {"N turns circles\n8 4.5 20\n48 -0.7 20\n", "N,turns,circles\n8,4.5,20\n48,-0.7,20\n",
          "n;turns;circles\n8;4,5;20\n48;-0,7;20\n",
          "# my dish\nspheres\tcircles\tturns\n8\t20\t4.5\n48\t20\t-0.7\n"}) {
        const auto points = read(text);
        ASSERT_EQ(points.size(), 2u) << text;
        EXPECT_EQ(points[0].discs, 8.0);
        EXPECT_EQ(points[0].mean, 0.225);
        EXPECT_DOUBLE_EQ(points[0].error, reading / 20.0);
        EXPECT_EQ(points[1].mean, -0.7 / 20.0);
    }
    const auto timed = read("N,turns,time\n8,4.5,10\n", 0.5);
    EXPECT_EQ(timed[0].mean, 0.225);
    const auto rated = read("discs,rate,error\n36,-0.01,0.002\n");
    EXPECT_EQ(rated[0].mean, -0.01);
    EXPECT_EQ(rated[0].error, 0.002);
}

TEST_F(OwnPoints, WrongRowsAreNamedWithTheirLine) {
    using testing::HasSubstr;
    EXPECT_THAT(error("N turns circles\n8 4.5 20\n48 x 20\n"), HasSubstr("line 3"));
    EXPECT_THAT(error("N turns circles\n8 4.5 0\n"), HasSubstr("number of circles is 0"));
    EXPECT_THAT(error("N turns circles\n8 900 20\n"),
                HasSubstr("900 turns in 20 circles are too many"));
    EXPECT_THAT(error("N turns circles\n8 nan 20\n"), HasSubstr("line 2"));
    EXPECT_THAT(error("N turns circles\n8.5 4 20\n"), HasSubstr("line 2"));
    EXPECT_THAT(error("N,rate\n8,0.2\n"), HasSubstr("without the column 'error'"));
    EXPECT_THAT(error("N,turns,time\n8,4.5,10\n"), HasSubstr("duration of a circle is unknown"));
    EXPECT_THAT(error("N,turns\n8,4.5\n"), HasSubstr("circles"));
    EXPECT_THAT(error(""), HasSubstr("mine.csv"));
}

TEST_F(OwnPoints, TheBestParameterOfASweepIsFound) {
    const SweepPlan plan = make_plan({{"discs", "8,16,32"}, {"mu", "0.2,0.4"}}, 1);
    CollectedSweep collected{.table = Table({"discs"})};
    for (const double mu : {0.2, 0.4})
        for (const double n : {8.0, 16.0, 32.0}) {
            CollectedRow row{
                {{"discs", std::to_string(int(n))}, {"mu", mu == 0.2 ? "0.2" : "0.4"}}};
            row.rotation[default_rate] = {.mean = 0.3 - mu * n / 40.0, .error = 0.001};
            collected.rows.push_back(row);
        }
    const auto points = read("N,rate,error\n8,0.24,0.01\n24,0.12,0.01\n60,1,0.1\n");
    const Comparison found = compare_with_sweep(plan, collected, points);
    EXPECT_EQ(found.parameter, "mu");
    EXPECT_EQ(found.left_out, 1u);
    ASSERT_TRUE(found.best);
    EXPECT_NEAR(found.best->value, 0.3, 1e-3);
    EXPECT_THAT(comparison_text(found),
                testing::AllOf(testing::HasSubstr("2 points for mu 0.2"),
                               testing::HasSubstr("1 point outside"),
                               testing::HasSubstr("best fit    mu = 0.30")));
    EXPECT_THROW(compare_with_sweep(make_plan({{"mu", "0.2,0.4"}}, 1), collected, points),
                 UsageError);
}

}  // namespace
}  // namespace swirl
