#include "swirl/run/report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "swirl/run/run.hpp"

namespace swirl {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

TEST(WithError, HasAsManyDigitsAsTheErrorSupports) {
    EXPECT_EQ(with_error(-0.03712, 0.00123), "−0.0371 ± 0.0012");
    EXPECT_EQ(with_error(-0.03712, 0.00523), "−0.037 ± 0.005");
    EXPECT_EQ(with_error(37.84, 0.21), "37.8 ± 0.2");
    EXPECT_EQ(with_error(37.84, 21.0), "38 ± 21");
    EXPECT_EQ(with_error(0.5, 0.0099), "0.500 ± 0.010");
    EXPECT_EQ(with_error(-2.34e-17, 4.1e-18), "−2.3e-17 ± 4e-18");
}

/// Over the first ten periods.
double events_per_period(RunConfig config) {
    config.periods = 10;
    config.warmup = 0;
    return static_cast<double>(run(config).events.total()) / 10.0;
}

TEST(WithError, PrintsMissingValues) {
    EXPECT_EQ(with_error(2.0 * 3.14159265, 4e-15), "6.28");  // rounding errors
    EXPECT_EQ(with_error(nan, 0.1), "n/a");
    EXPECT_EQ(with_error(-0.25, nan), "−0.25");
}

TEST(RotationWords, NameTheDirectionBeyondTwoErrors) {
    EXPECT_EQ(rotation_words({0.1, 0.01, 10.0, 10}, true), "rotate with the swirl");
    EXPECT_EQ(rotation_words({-0.1, 0.01, 10.0, 10}, true),
              "rotate against the swirl (counterrotation)");
    EXPECT_EQ(rotation_words({-0.1, 0.01, 10.0, 10}, false), "rotate clockwise");
    for (const double mean : {0.019, -0.019})
        EXPECT_EQ(rotation_words({mean, 0.01, 10.0, 10}, true),
                  "stall, no rotation beyond the error");
}

TEST(RigidBodyLine, IsThereIfTheRatesDifferByMoreThanThreeErrors) {
    RotationEstimates rates;
    rates.mean_by_time = {0.007, 0.001, 10.0, 10};
    rates.rigid_by_time = {0.004, 0.001, 10.0, 10};
    EXPECT_EQ(rigid_body_line(rates), "");
    rates.rigid_by_time.mean = -0.006;
    EXPECT_THAT(rigid_body_line(rates), testing::HasSubstr("  rigid body  ϖ/Ω = −0.0060 ± 0.0010"));
    rates.rigid_by_time.mean = nan;
    EXPECT_EQ(rigid_body_line(rates), "");
}

TEST(WithCommas, GroupsByThousands) {
    EXPECT_EQ(with_commas(0), "0");
    EXPECT_EQ(with_commas(999), "999");
    EXPECT_EQ(with_commas(1000), "1,000");
    EXPECT_EQ(with_commas(1234567), "1,234,567");
}

TEST(Headline, GivesNoAverageWithoutAWholePeriod) {
    RunConfig config;
    config.events = 300;
    const RunResult short_run = run(config);
    EXPECT_LT(short_run.periods, 1.0);
    EXPECT_EQ(headline(short_run), "48 discs completed no whole period, so there are no averages.");
    EXPECT_THAT(warnings(short_run), testing::ElementsAre(testing::AllOf(
                                         testing::HasSubstr("the run covers 0.16 periods"),
                                         testing::HasSubstr("hint: use more --events."))));
    EXPECT_EQ(report(short_run, true).find("ϖ/Ω"), std::string::npos);
    EXPECT_EQ(report(short_run, true).find("rigid"), std::string::npos);
    for (const Estimate& e :
         {short_run.rotation.mean_by_event, short_run.rotation.mean_by_time,
          short_run.rotation.rigid_by_event, short_run.rotation.rigid_by_time}) {
        EXPECT_TRUE(std::isnan(e.mean));
        EXPECT_TRUE(std::isnan(e.error));
        EXPECT_EQ(e.blocks, 0u);
    }
    // One whole period is warm-up, and the next is not complete.
    config.discs = 5;
    config.warmup = 1;
    config.events = static_cast<std::int64_t>(1.5 * events_per_period(config));
    const RunResult another = run(config);
    EXPECT_GT(another.periods, 1.0);
    EXPECT_LT(another.periods, 2.0);
    EXPECT_EQ(headline(another),
              "5 discs completed no whole period after the warm-up, so there are no averages.");
}

TEST(Headline, GivesTheAverageOfASinglePeriod) {
    RunConfig config;
    config.discs = 5;
    config.periods = 1;
    config.warmup = 0;
    EXPECT_THAT(headline(run(config)), testing::HasSubstr("ϖ/Ω = "));
}

TEST(Headline, NeedsFiveBlocksForADirectionAndFiftyForNone) {
    RunResult result;
    result.periods = 100.0;
    const auto words = [&](double mean, std::size_t blocks) {
        result.rotation.mean_by_time = {mean, 0.01, 10.0, blocks};
        result.rotation.mean_by_event.blocks = blocks;
        return headline(result);
    };
    EXPECT_THAT(words(0.1, 4), testing::HasSubstr("4 periods are too few to determine"));
    EXPECT_THAT(words(0.1, 5), testing::HasSubstr("48 discs rotate with the swirl: "));
    EXPECT_THAT(words(0.0, 49), testing::HasSubstr("49 periods are too few to determine"));
    EXPECT_THAT(words(0.0, 50), testing::HasSubstr("48 discs stall, "));
}

TEST(Report, SaysThatOmegaIsOnlyAUnitWhereThePathHasNoMFrame) {
    for (const bool turns : {true, false}) {
        RunConfig config;
        config.path = turns ? PathShape::polygon : PathShape::line;
        config.discs = 5;
        config.periods = 2;
        config.warmup = 0;
        EXPECT_EQ(report(run(config), false).find("only a unit") == std::string::npos, turns);
    }
}

TEST(Warnings, AreEmptyOnlyForASteadyCompleteRun) {
    RunResult result;
    result.complete = true;
    result.rotation.mean_by_event.blocks = 100;
    result.steady.verdict = result.steady_spin.verdict = SteadyState::Verdict::steady;
    EXPECT_TRUE(warnings(result).empty());
    result.complete = false;
    EXPECT_THAT(warnings(result), testing::ElementsAre(testing::HasSubstr("incomplete")));
    result.complete = true;
    result.steady.verdict = SteadyState::Verdict::drifting;
    result.steady.change = {.before = 0.3, .after = 1.0, .size = 9.0, .max_size = 4.6};
    result.steady_spin.change = {.size = 1.0, .max_size = 4.7, .effective_samples = 10.0};
    EXPECT_THAT(report(result, false),
                testing::HasSubstr("  steady      no: the rotation drifts from 0.3 to 1\n"));
    EXPECT_THAT(report(result, true),
                testing::HasSubstr(
                    "  changes     largest of the rotation 9.0 standard errors (limit 4.6), of the "
                    "spins 1.0 (limit 4.7); 3 % of steady runs exceed a limit"));
    EXPECT_THAT(
        warnings(result),
        testing::ElementsAre(testing::HasSubstr("not steady: the rotation drifts from 0.3 to 1.")));
    std::swap(result.steady, result.steady_spin);
    EXPECT_EQ(result.steady_state(), SteadyState::Verdict::drifting);
    EXPECT_THAT(warnings(result), testing::ElementsAre(testing::HasSubstr(
                                      "not steady: the mean spin drifts from 0.3 to 1.")));
    result.steady_spin.verdict = SteadyState::Verdict::steady;
    result.steady.verdict = SteadyState::Verdict::jumping;
    result.steady.change = {.before = 0.72, .after = 1.0, .size = 9.0, .max_size = 4.6};
    result.steady.period = 812.0;
    EXPECT_EQ(steady_state_found(result), "the rotation jumps at period 812 from 0.72 to 1");
    EXPECT_STREQ(verdict(result.steady_state()), "jumping");
    result.steady.verdict = SteadyState::Verdict::switching;
    result.steady.states = {.low = -0.05, .high = 1.0, .changes = 14};
    EXPECT_EQ(steady_state_found(result),
              "the rotation switches between two states, −0.05 and 1, 14 times");
    EXPECT_THAT(warnings(result), testing::ElementsAre(testing::HasSubstr("mixes both states")));
    result.steady_spin.verdict = result.steady.verdict = SteadyState::Verdict::too_short;
    EXPECT_THAT(warnings(result),
                testing::ElementsAre(testing::HasSubstr("steady state not verified")));
    // The spins may be too correlated for the test although the rotation is steady.
    result.steady.verdict = SteadyState::Verdict::steady;
    result.steady_spin.change = {.size = 15.9, .max_size = 79.1};
    EXPECT_THAT(
        warnings(result),
        testing::ElementsAre(testing::HasSubstr("cannot distinguish a change from chance")));
    result.config.mu_disc = result.config.mu_wall = 0.0;
    EXPECT_THAT(warnings(result), testing::ElementsAre(testing::HasSubstr("without bound")));
    // Rotation and spins may be steady while the energy grows.
    result.steady.verdict = result.steady_spin.verdict = SteadyState::Verdict::steady;
    result.steady.change = result.steady_spin.change = {.size = 1.0, .max_size = 4.6};
    EXPECT_THAT(report(result, false),
                testing::HasSubstr("  steady      rotation and spins: no change larger than "
                                   "chance; the energy grows\n"));
    result.config.path = PathShape::circle;
    EXPECT_THAT(report(result, false),
                testing::HasSubstr("  steady      yes: no change larger than "
                                   "chance\n"));
    result.config.path = PathShape::polygon;
    result.steady.verdict = result.steady_spin.verdict = SteadyState::Verdict::too_short;
    // On a floor the energy does not grow, because floor friction dissipates it.
    result.config.floor = true;
    EXPECT_THAT(warnings(result),
                testing::ElementsAre(testing::HasSubstr("steady state not verified")));
}

// 3.3e-10 is the overlap after half a million bounces (docs/explanation/physics.md).
TEST(Warnings, ReportSpheresThatSinkIntoTheWallWithoutContactDuration) {
    RunResult result;
    result.complete = true;
    result.rotation.mean_by_event.blocks = 100;
    result.steady.verdict = result.steady_spin.verdict = SteadyState::Verdict::steady;
    result.config.body = Shape::sphere;
    result.config.floor = true;
    result.max_overlap = 3.3e-10;
    EXPECT_TRUE(
        warnings(result).empty());  // a large container may cause it with a contact duration
    result.config.contact_duration = 0.0;
    EXPECT_THAT(warnings(result),
                testing::ElementsAre(testing::AllOf(testing::HasSubstr("spheres that the floor"),
                                                    testing::HasSubstr("3.3e-10 r so far"),
                                                    testing::HasSubstr("--contact-duration"))));
    result.max_overlap = 1e-14;
    EXPECT_TRUE(warnings(result).empty());
}

}  // namespace
}  // namespace swirl
