// The statistics of the chapters about mechanism and material, and the plans of their figures.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "swirl/paper/chapters.hpp"
#include "swirl/paper/coarse_zero.hpp"
#include "swirl/paper/rank_correlation.hpp"

namespace swirl {
namespace {

TEST(CoarseZero, IsThatOfTheStraightLineBetweenTheNeighbouringPoints) {
    const CoarseZero zero = last_zero({{20, 0.5, 0.01}, {30, 0.3, 0.03}, {40, -0.1, 0.01}});
    EXPECT_TRUE(zero.falls);
    // The zero is 30 + 10 · 0.3/0.4. The errors have the weights ¼ and ¾ and are divided by the
    // slope of 0.04.
    EXPECT_NEAR(zero.discs, 37.5, 1e-12);
    EXPECT_NEAR(zero.error, std::hypot(0.25 * 0.03, 0.75 * 0.01) / 0.04, 1e-12);
    EXPECT_FALSE(last_zero({{20, -0.5, 0.01}, {30, 0.3, 0.03}}).falls);
    // The last of two changes, and no change where the signs are uncertain.
    EXPECT_NEAR(last_zero({{10, -1, 0.1}, {20, 1, 0.1}, {30, -1, 0.1}}).discs, 25.0, 1e-12);
    EXPECT_FALSE(last_zero({{20, 0.5, 0.01}, {30, -0.1, 0.1}}).exists());
    EXPECT_FALSE(last_zero({}).exists());
}

TEST(RankCorrelation, HasTheClosedFormsOfSmallSamples) {
    const Values x{1, 2, 3, 4, 5};
    EXPECT_NEAR(rank_correlation_of(x, {1, 4, 9, 16, 25}), 1.0, 1e-15);
    EXPECT_NEAR(rank_correlation_of(x, {5, 3, 2, 1, -9}), -1.0, 1e-15);
    // Without equal values: 1 − 6 Σ d²/(n (n² − 1)), here Σ d² = 1 + 1 + 0 + 1 + 1.
    EXPECT_NEAR(rank_correlation_of(x, {20, 10, 30, 50, 40}), 1.0 - 6.0 * 4.0 / 120.0, 1e-15);
    EXPECT_EQ(ranks_of({3.0, 1.0, 3.0}), (Values{2.5, 1.0, 2.5}));
    EXPECT_TRUE(std::isnan(rank_correlation_of(x, {1, 1, 1, 1, 1})));
}

TEST(RankCorrelation, TheJackknifeGivesTheStandardErrorOfAMean) {
    const Values values{1.0, 4.0, 2.0, 7.0, 3.0, 1.0};
    const Estimate found = jackknife(values.size(), [&](const std::vector<std::size_t>& points) {
        double sum = 0.0;
        for (const double value : chosen(values, points)) sum += value;
        return sum / static_cast<double>(points.size());
    });
    double square = 0.0;
    for (const double value : values) square += (value - 3.0) * (value - 3.0);
    EXPECT_NEAR(found.mean, 3.0, 1e-14);
    EXPECT_NEAR(found.error, std::sqrt(square / 30.0), 1e-14);
    EXPECT_TRUE(std::isnan(jackknife(3, [](const auto&) { return 1.0; }).mean));
}

TEST(ChapterMechanism, FullFiguresHaveEightSeedsAndEachRunItsOwnConfiguration) {
    std::set<std::string> keys, configurations;
    for (const auto& chapter : {chapter_mechanism(), chapter_material()})
        for (const PaperFigure& figure : chapter) {
            const FigurePlan plan = figure.plan(PaperSettings{});
            for (const PaperPoint& point : plan.points) {
                EXPECT_EQ(point.runs.size(), 8u) << point.name;
                for (const PaperTask& task : point.runs) {
                    EXPECT_TRUE(keys.insert(task.key).second) << task.key;
                    EXPECT_NE(task.description, "");
                    configurations.insert(std::string(figure.name) + task.description);
                }
            }
        }
    EXPECT_EQ(configurations.size(), keys.size());
}

}  // namespace
}  // namespace swirl
