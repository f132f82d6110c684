#include "swirl/run/path_parameter.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "run/rejected_parameters.hpp"
#include "swirl/run/config.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/json.hpp"
#include "swirl/run/measurements.hpp"
#include "swirl/run/run.hpp"

namespace swirl {
namespace {

/// The vertices of a path as the text of --motion.
std::string points_of(const ContainerPath& path) {
    std::string text = "points";
    for (const Segment& s : path.segments)
        text += fmt::format(" {}:{}:{}", s.begin, s.start.x, s.start.y);
    const Vec2 first = path.segments.front().start;
    return text + fmt::format(" {}:{}:{}", path.period, first.x, first.y);
}

std::uint64_t hash_of(const ParameterTexts& texts) { return run(resolve(texts)).state_hash; }

TEST(PathParameter, ThePolygonFromAFileGivesTheSameTrajectory) {
    for (const char* sides : {"3", "7", "30", "100"}) {
        const ParameterTexts polygon{{"discs", "28"}, {"events", "5000"}, {"sides", sides}};
        ParameterTexts points{{"discs", "28"}, {"events", "5000"}};
        points["path"] = points_of(make_path(resolve(polygon)));
        EXPECT_EQ(hash_of(points), hash_of(polygon)) << sides;
        // An ellipse with equal axes is that polygon, too.
        ParameterTexts ellipse = polygon;
        ellipse["path"] = "ellipse:1";
        EXPECT_EQ(hash_of(ellipse), hash_of(polygon)) << sides;
    }
}

TEST(PathParameter, AConfigurationHoldsThePathItself) {
    for (const char* path : {"line", "ellipse:0.5", "lissajous:2:3", "lissajous:1:2:45", "circle",
                             "points 0:1:0 1:0:2 3:-1:0.1 4:1:0"}) {
        const RunConfig config = resolve({{"path", path}, {"discs", "5"}});
        EXPECT_EQ(config_json(config)["path"], path);
        EXPECT_EQ(config_json(resolve(texts_of(config))), config_json(config)) << path;
        EXPECT_EQ(config_json(resolve(parameters_in(config_json(config)))), config_json(config));
        const ContainerPath made = make_path(config);
        for (std::size_t k = 0; k < made.segments.size(); ++k) {
            const Segment &s = made.segments[k],
                          &next = made.segments[(k + 1) % made.segments.size()];
            const Vec2 gap = s.position_at(s.end) - next.start;
            EXPECT_LT(std::hypot(gap.x, gap.y), 1e-13) << path << " segment " << k;
        }
        EXPECT_DOUBLE_EQ(made.segments.back().end, config.period);
        EXPECT_EQ(path_vertices(config), std::int64_t(made.segments.size()));
    }
}

TEST(PathParameter, ShapesHaveTheirFormulas) {
    const RunConfig config =
        resolve({{"path", "lissajous:2:3:30"}, {"amplitude", "2"}, {"period", "6"}});
    EXPECT_EQ(config.sides, 90);
    const ContainerPath path = make_path(config);
    for (const Segment& s : path.segments) {
        const double u = s.begin / 6.0;
        EXPECT_NEAR(s.start.x, 2.0 * std::cos(4.0 * pi * u), 1e-13);
        EXPECT_NEAR(s.start.y, 2.0 * std::sin(6.0 * pi * u + pi / 6.0), 1e-13);
    }
    const ContainerPath ellipse = make_path(resolve({{"path", "ellipse:0.5"}}));
    for (const Segment& s : ellipse.segments)
        EXPECT_NEAR(s.start.x * s.start.x + 4.0 * s.start.y * s.start.y, 1.892 * 1.892, 1e-13);
    for (const Segment& s : make_path(resolve({{"path", "line"}})).segments) {
        EXPECT_EQ(s.start.y, 0.0);
        EXPECT_NEAR(s.start.x, 1.892 * std::cos(2.0 * pi * s.begin / paper_period), 1e-13);
    }
}

TEST(PathParameter, PointsHaveTheirOwnAmplitudeAndPeriodUnlessScaled) {
    const std::string square = "points 5:1:1 6:-1:1 7:-1:-1 8:1:-1 9:1:1";
    const RunConfig own = resolve({{"path", square}, {"discs", "5"}});
    EXPECT_EQ(own.period, 4.0);
    EXPECT_EQ(own.amplitude, std::sqrt(2.0));
    EXPECT_EQ(container_speed(own), 2.0);
    EXPECT_EQ(make_path(own).segments[0].begin, 0.0);
    const RunConfig scaled = resolve(
        {{"path", square}, {"discs", "5"}, {"amplitude", "2.8284271247461903"}, {"period", "8"}});
    EXPECT_NEAR(make_path(scaled).segments[1].start.x, -2.0, 1e-15);
    EXPECT_EQ(make_path(scaled).segments[1].begin, 2.0);
    EXPECT_NEAR(container_speed(scaled), 2.0, 1e-15);
    const RunConfig fast = resolve({{"path", square}, {"discs", "5"}, {"speed", "4"}});
    EXPECT_NEAR(fast.period, 2.0, 1e-15);
    // A path on the command line brings its own period; the file's other parameters stay.
    const RunConfig other = resolve(overridden(texts_of(RunConfig{}), {{"path", square}}));
    EXPECT_EQ(other.period, 4.0);
    EXPECT_EQ(other.discs, 48);
}

TEST(PathParameter, APhaseStartsTheSamePathElsewhere) {
    for (const char* path : {"polygon", "circle", "ellipse:0.5", "points 0:1:0 1:0:2 3:-1:0 4:1:0"})
        for (const double degrees : {12.0, 100.0, 359.0}) {
            const RunConfig at_zero = resolve({{"path", path}, {"discs", "5"}});
            const RunConfig config = resolve(
                {{"path", path}, {"discs", "5"}, {"path_phase", fmt::format("{}", degrees)}});
            const ContainerPath a = make_path(at_zero), b = make_path(config);
            EXPECT_EQ(b.segments.front().begin, 0.0);
            EXPECT_EQ(b.segments.back().end, a.period);
            for (double t = 0.013; t < 1.0; t += 0.05) {
                double u = t + degrees / 360.0;
                u -= std::floor(u);
                const Vec2 p = a.segment_at(u * a.period).position_at(u * a.period),
                           q = b.segment_at(t * a.period).position_at(t * a.period);
                EXPECT_NEAR(p.x, q.x, 1e-13) << path << ' ' << degrees << ' ' << t;
                EXPECT_NEAR(p.y, q.y, 1e-13);
            }
        }
    // A phase at a vertex gives no segment without duration.
    EXPECT_EQ(make_path(resolve({{"path_phase", "12"}})).segments.size(), 30u);
    EXPECT_EQ(make_path(resolve({{"path_phase", "13"}})).segments.size(), 31u);
}

TEST(PathParameter, RejectsWhatIsNoClosedPath) {
    const auto expect = [](const std::string& points, const char* says) {
        expect_rejected({{"path", points}, {"discs", "5"}}, says);
    };
    expect("points", "at least three");
    expect("points 0:1:1", "1 point");
    expect("points 0:1:1 1:1:1", "at least three");
    expect("points 0:1:1 1:0:0 2:1:0.9", "not closed");
    expect("points 0:1:1 1:0:0 1:0:1 2:1:1", "times must increase");
    expect("points 0:1:1 2:0:0 1:0:1 3:1:1", "times must increase");
    expect("points 0:1:1 1e-12:0:0 1:1:1", "times must increase");
    expect("points 0:1:1 nan:0:0 2:1:1", "'nan'");
    expect("points 0:1:1 1:inf:0 2:1:1", "'inf'");
    expect("points 0:1:1 1:1e7:0 2:1:1", "from -1000000 to 1000000");
    expect("points 0:1:1 1:0 2:1:1", "must be T:X:Y");
    expect("points 0:1:1 1:0:0:0 2:1:1", "must be T:X:Y");
    std::string many = "points";
    for (std::size_t k = 0; k <= max_path_points; ++k) many += fmt::format(" {}:{}:0", k, k % 2);
    expect(many, "at most 20000");
    expect_rejected({{"path", "points 0:0:0 1:0:0 2:0:0"}, {"amplitude", "1"}},
                    "all at the origin");
    expect_rejected({{"path", "points 0:1:1 1:0:0 2:1:1"}, {"sides", "5"}}, "--sides is 5");
}

TEST(MFrame, ExistsOnNearlyCircularPathsOnly) {
    const auto has = [](ParameterTexts texts) {
        texts["discs"] = "5";
        return has_m_frame(resolve(texts));
    };
    EXPECT_TRUE(has({}));
    EXPECT_TRUE(has({{"path", "circle"}, {"path_phase", "77"}}));
    EXPECT_TRUE(has({{"sides", "3"}}));
    EXPECT_TRUE(has({{"amplitude", "0"}}));
    EXPECT_TRUE(has({{"path", "ellipse:1"}}));
    EXPECT_TRUE(has({{"path", points_of(polygon_path(2.0, 5.0, 30))}}));
    EXPECT_FALSE(
        has({{"path", points_of(polygon_path(2.0, 5.0, 3))}}));  // half as far at the sides
    EXPECT_TRUE(has({{"path", points_of(mirrored(polygon_path(2.0, 5.0, 30)))}}));
    EXPECT_FALSE(has({{"path", "ellipse:0.9"}}));
    EXPECT_FALSE(has({{"path", "line"}}));
    EXPECT_FALSE(has({{"path", "lissajous:1:1"}}));
    EXPECT_TRUE(has({{"direction", "clockwise"}}));
}

TEST(MFrame, ItsMeasurementsAreRejectedElsewhere) {
    const RunConfig line = resolve({{"path", "line"}, {"discs", "5"}});
    EXPECT_THROW(observation_of(line, {"slip"}), UsageError);
    EXPECT_THROW(observation_of(line, {"segregation", "density"}), UsageError);
    EXPECT_EQ(observation_of(line, {"segregation", "order"}).names().size(), 2u);
    const auto all = observation_of(line, read_measurement_list("all")).names();
    EXPECT_THAT(all, testing::Contains("diffusion"));
    EXPECT_THAT(all, testing::Not(testing::Contains("flow")));
}

TEST(Headline, OfAPathWithoutAnMFrameNamesTheDirection) {
    ParameterTexts texts{
        {"discs", "20"}, {"periods", "40"}, {"path", "ellipse:0.8"}, {"direction", "clockwise"}};
    const RunResult result = run(resolve(texts));
    EXPECT_GT(result.rotation.mean_by_time.mean, 0.0);
}

}  // namespace
}  // namespace swirl
