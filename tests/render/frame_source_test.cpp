#include "swirl/render/frame_source.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "pixels.hpp"
#include "swirl/io/trajectory.hpp"
#include "swirl/render/movie.hpp"
#include "swirl/render/source_player.hpp"
#include "swirl/render/still.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/json.hpp"

namespace swirl {
namespace {

namespace fs = std::filesystem;

RunConfig small_run() {
    RunConfig config;
    config.discs = 12;
    return config;
}

void expect_same_positions(const Snapshot& a, const Snapshot& b, double tolerance) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        EXPECT_NEAR(a.position(i).x, b.position(i).x, tolerance);
        EXPECT_NEAR(a.position(i).y, b.position(i).y, tolerance);
        EXPECT_NEAR(a.orientation(i), b.orientation(i), tolerance);
    }
}

class Recording : public ::testing::Test {
  protected:
    void SetUp() override {
        folder_ = fs::temp_directory_path() / ("swirl-source-" + std::to_string(::getpid()));
        fs::create_directories(folder_);
        const Playback playback = simulated(small_run()).open();
        for (int k = 0; k <= 40; ++k) frames_.push_back(playback(1.0 + k / 20.0));
        TrajectoryWriter writer(path("run.h5"), frames_.front(), {});
        for (const Snapshot& s : frames_) writer.write(s, 0);
        writer.finish();
    }
    void TearDown() override { fs::remove_all(folder_); }
    std::string path(const char* name) const { return (folder_ / name).string(); }

    fs::path folder_;
    std::vector<Snapshot> frames_;
};

TEST(SourcePlayer, TrailsNeverGoBackInTime) {
    FrameSource source;
    double last = 0.0;
    source.open = [&last] {
        return Playback([&last](double periods) {
            EXPECT_GE(periods, last);
            last = periods;
            return Snapshot{};
        });
    };
    SourcePlayer player(source, 0.3, false, 20.0);
    // Some of these instants are points of the trails, apart from rounding.
    for (int k = 0; k < 600; ++k) player.at(20.0 + k * 2.0 / 60.0);
    EXPECT_GT(last, 39.0);
}

TEST(FrameSource, EqualsTheStateOfTheEngine) {
    const RunConfig config = small_run();
    const Playback playback = simulated(config).open();
    Simulation simulation(make_initial_state(config));
    for (double periods : {0.0, 0.3, 0.31, 2.0, 5.75}) {
        const double whole = std::floor(periods);
        simulation.advance_to(static_cast<std::int64_t>(whole), (periods - whole) * config.period);
        const Snapshot expected = simulation.snapshot(), found = playback(periods);
        EXPECT_EQ(found.periods, expected.periods);
        EXPECT_EQ(found.clock, expected.clock);
        EXPECT_EQ(found.x, expected.x);
        EXPECT_EQ(found.y, expected.y);
        EXPECT_EQ(found.angle, expected.angle);
    }
}

TEST(FrameSource, EveryPassStartsAtTheBeginning) {
    const FrameSource source = simulated(small_run());
    const Playback first = source.open();
    first(3.0);
    EXPECT_EQ(source.open()(0.5).x, source.open()(0.5).x);
}

TEST(FrameSource, RollingBallRotatesAccordingToItsSlip) {
    for (const double slip : {0.0, 0.5, 1.0}) {
        RollingBall ball;
        ball.slip = slip;
        const Playback playback = rolling(ball, paper_amplitude, paper_period).open();
        const double turns = (playback(3.0).angle[0] - playback(1.0).angle[0]) / (2.0 * pi);
        EXPECT_NEAR(turns, 2.0 * ball.rotation(), 1e-12) << slip;
    }
}

TEST_F(Recording, ReturnsTheRecordedFrames) {
    const FrameSource source = recorded(path("run.h5"));
    EXPECT_NEAR(*source.from, 1.0, 1e-12);
    EXPECT_NEAR(*source.to, 3.0, 1e-12);
    EXPECT_NEAR(source.amplitude, paper_amplitude,
                0.01);  // no frame need be at a vertex of the polygon
    const Playback playback = source.open();
    for (int k = 0; k <= 40; ++k)
        expect_same_positions(playback(1.0 + k / 20.0), frames_[k], 1e-12);
}

TEST_F(Recording, HasCaptionAndParametersOfItsRun) {
    EXPECT_EQ(recorded(path("run.h5")).caption, "run.h5");  // it has no parameters
    RunConfig config = small_run();
    config.mu_wall = 0.25;
    const auto write = [&](const char* name, const std::string& parameters) {
        TrajectoryWriter writer(path(name), frames_.front(), {{"parameters", parameters}});
        for (const Snapshot& s : frames_) writer.write(s, 0);
        writer.finish();
        return recorded(path(name));
    };
    const FrameSource complete = write("complete.h5", config_text(config));
    EXPECT_EQ(complete.caption, "12 discs");
    std::vector<std::string> labels = parameter_labels(config);
    labels.emplace_back("41 recorded frames");
    EXPECT_EQ(complete.parameters, labels);
    EXPECT_EQ(write("other.h5", "{\"dishes\": 3}").caption, "other.h5");
    EXPECT_EQ(write("nonsense.h5", "nonsense").caption, "nonsense.h5");
}

TEST(FrameSource, CaptionOfTheBallDescribesItsMotion) {
    RollingBall ball;
    for (const auto& [slip, caption] :
         {std::pair(0.0, "one ball that slips"), std::pair(0.5, "one ball that rolls and slips"),
          std::pair(1.0, "one ball that rolls")}) {
        ball.slip = slip;
        EXPECT_EQ(rolling(ball, 1.0, 1.0).caption, caption);
    }
}

TEST_F(Recording, DiscsMoveOnStraightLinesBetweenFrames) {
    const Playback playback = recorded(path("run.h5")).open();
    const Snapshot middle = playback(1.0 + 4.5 / 20.0);
    for (std::size_t i = 0; i < middle.size(); ++i) {
        const Vec2 expected = 0.5 * (frames_[4].position(i) + frames_[5].position(i));
        EXPECT_NEAR(middle.position(i).x, expected.x, 1e-12);
        EXPECT_NEAR(middle.position(i).y, expected.y, 1e-12);
    }
    EXPECT_NEAR(middle.time(), (1.0 + 4.5 / 20.0) * paper_period, 1e-9);
}

TEST(FrameSource, DiscsOfARecordingNeverOverlap) {
    // Two discs exchange their places between two frames: straight lines lead through each other.
    SnapshotSeries series;
    series.frames = 2;
    series.frame = [](std::uint64_t k) {
        Snapshot s = container(0.1 * static_cast<double>(k));
        const double side = k == 0 ? 1.0 : -1.0;
        add_disc(s, {3.0 * side, 0.0});
        add_disc(s, {-3.0 * side, 0.0});
        return s;
    };
    const Playback playback = recorded(series, "two discs").open();
    for (int k = 0; k <= 20; ++k) {
        const Snapshot s = playback(0.1 * k / 20.0);
        const Vec2 apart = s.position(0) - s.position(1);
        EXPECT_GE(std::sqrt(dot(apart, apart)), 2.0 * 0.99) << k;
    }
    // Where they do not overlap, they move on the straight lines.
    EXPECT_NEAR(playback(0.1).position(0).x, -3.0, 1e-12);
    const Playback again = recorded(series, "two discs").open();
    EXPECT_NEAR(again(0.1 / 6.0).position(0).x, 2.0, 1e-12);
}

TEST_F(Recording, CanBeMadeIntoAMovie) {
    MovieConfig config;
    config.sources = {recorded(path("run.h5"))};
    config.start = 1.0;
    config.pace = 1.0;
    config.frames_per_second = 20;
    config.frames = 41;
    config.frames_folder = path("frames");
    config.appearance.size = {64, 64};
    ASSERT_EQ(problem(config), std::nullopt);
    EXPECT_EQ(make_movie(config).frames, 41);
    EXPECT_TRUE(fs::exists(path("frames/frame-000041.png")));
    EXPECT_FALSE(fs::exists(path("frames/frame-000042.png")));

    config.frames = 42;
    EXPECT_NE(problem(config), std::nullopt);
    config.frames = 1;
    config.start = 0.9;
    EXPECT_NE(problem(config), std::nullopt);
}

TEST_F(Recording, InvalidFilesAreErrors) {
    std::ofstream(path("not.h5")) << "hello";
    EXPECT_THROW(recorded(path("not.h5")), Failure);
    EXPECT_THROW(recorded(path("nowhere.h5")), Failure);
}

TEST(PinnedPlayback, AgreesWithTheMeasurementSevenFramesLater) {
    const RunConfig config = small_run();
    PinnedPlayback pinned_playback(simulated(config), 2.0);
    const Playback playback = simulated(config).open();
    PinnedLoose pinned;
    MFrameView view;
    for (int k = 511; k <= 511 * 3; ++k) {
        view.update(playback(k / 511.0));
        pinned.sample(view);
        const int shown = k - FrameWindow().half_width;
        if (shown < 2 * 511 || shown % 100 != 0) continue;
        EXPECT_EQ(pinned_playback.at(shown / 511.0), pinned.pinned()) << shown;
    }
}

TEST(PinnedPlayback, DiscsAtRestAtTheWallArePinned) {
    // The container does not rotate in the lab, so a disc at rest relative to it moves with the
    // wall.
    FrameSource source;
    source.period = 10.0;
    source.container_radius = 8.6;
    source.open = [] {
        return [](double periods) {
            Snapshot s;
            s.period = 10.0;
            s.periods = static_cast<std::int64_t>(periods);
            const double phase = periods - std::floor(periods);
            s.clock = phase * s.period;
            s.container_radius = 8.6;
            s.container_centre = 1.9 * unit_circle(phase);
            s.container_velocity = (2.0 * pi / 10.0) * perpendicular(s.container_centre);
            s.resize(2);
            s.set(0, {s.container_centre + Vec2{7.6, 0.0}, s.container_velocity, 0.0, 0.0, s.clock,
                      1.0, 1.0, 10.0});
            // At rest in the M-frame: it circles with the swirl.
            s.set(1, {4.0 * unit_circle(phase),
                      (4.0 * 2.0 * pi / 10.0) * perpendicular(unit_circle(phase)), 0.0, 0.0,
                      s.clock, 1.0, 1.0, 10.0});
            return s;
        };
    };
    PinnedPlayback pinned_playback(source, 1.0);
    EXPECT_EQ(pinned_playback.at(1.5), (std::vector<std::uint8_t>{1, 0}));
}

TEST(Turns, AreTheIntegralOfTheRotation) {
    Curve curve;
    for (int k = 0; k <= 640; ++k) {
        curve.time.push_back(k / 64.0);
        curve.raw.push_back(-0.25);
    }
    EXPECT_NEAR(turns_until(curve, 2.0, 2.0), 0.0, 1e-12);
    EXPECT_NEAR(turns_until(curve, 2.0, 4.01), -0.25 * 2.01, 1e-12);
    EXPECT_NEAR(turns_until(curve, 0.0, 10.0), -2.5, 1e-12);
}

TEST_F(Recording, StroboscopicImageNeedsItsFirstInstant) {
    StillConfig config;
    config.sources = {recorded(path("run.h5"))};
    config.out = path("x.png");
    config.appearance.size = {64, 64};
    config.at = 3.0;
    config.flashes = 3;
    EXPECT_EQ(problem(config), std::nullopt);
    make_still(config);
    EXPECT_TRUE(fs::exists(config.out));
    config.flashes = 4;
    EXPECT_NE(problem(config), std::nullopt);
    config.flashes = 1;
    config.at = 3.5;
    EXPECT_NE(problem(config), std::nullopt);
}

}  // namespace
}  // namespace swirl
