// Smoothing of a simulated run, sampled like a camera with known noise.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "swirl/io/track_smoothing.hpp"
#include "swirl/math/random.hpp"
#include "swirl/math/unit_circle.hpp"
#include "swirl/run/measured_series.hpp"
#include "swirl/run/run.hpp"
#include "swirl/run/track_fit.hpp"

namespace swirl {
namespace {

constexpr double pixels = 26.0;  // pixels per radius, as in the laboratory

std::vector<Snapshot> recorded_run(int frames_per_period) {
    RunConfig config;
    config.discs = 48;
    config.periods = 12;
    config.warmup = 4;
    config.seed = 3;
    Run run(config);
    SampleTimes times = run.sample_times(frames_per_period);
    std::vector<Snapshot> frames;
    while (run.next_event()) {
        while (run.next_sample(times))
            if (run.is_warm()) frames.push_back(run.snapshot().up_to_date());
        run.pass_event();
    }
    return frames;
}

const std::vector<Snapshot>& laboratory() {
    static const std::vector<Snapshot> frames = recorded_run(511);
    return frames;
}

TrackScale scale_of(const std::vector<Snapshot>& frames) {
    const Snapshot& first = frames.front();
    TrackScale scale;
    scale.pixels_per_radius = pixels;
    scale.period = first.period;
    scale.frames_per_time = double(frames.size() - 1) / (frames.back().time() - first.time());
    scale.amplitude = std::hypot(first.container_centre.x, first.container_centre.y);
    scale.phase = std::atan2(first.container_centre.y, first.container_centre.x);
    scale.container_radius = first.container_radius;
    return scale;
}

/// Camera tracks of the run, with a normal error of `noise` pixels per coordinate.
Tracks camera_tracks(const std::vector<Snapshot>& frames, double noise) {
    Random random(5);
    Tracks tracks;
    for (const Snapshot& s : frames) {
        TrackFrame frame;
        frame.number = std::int64_t(tracks.frames.size());
        for (std::size_t i = 0; i < s.size(); ++i) {
            const double size = noise * std::sqrt(-2.0 * std::log(1.0 - random.uniform()));
            frame.id.push_back(std::int64_t(i));
            frame.position.push_back(pixels * s.position(i) + size * unit_circle(random.uniform()));
        }
        tracks.frames.push_back(frame);
    }
    return tracks;
}

struct Found {
    Estimate temperature, pinning, depinning;
    Estimate squared_path;  // relative to the container, in 1/73 of a period
    Estimate speed;         // profile, mean over its slices
};

/// Mean and mean error of a column over the rows that were visited.
Estimate mean_of(const ReportTable& table, std::size_t column, std::size_t error) {
    Estimate mean{0.0, 0.0};
    double rows = 0.0;
    for (std::size_t row = 0; row < table.rows(); ++row) {
        if (!std::isfinite(table.at(row, error))) continue;
        mean.mean += table.at(row, column);
        mean.error += table.at(row, error);
        rows += 1.0;
    }
    mean.mean /= rows, mean.error /= rows;
    return mean;
}

Found found_in(const SnapshotSeries& series) {
    const MeasuredSeries measured =
        measure_series(series, {"temperature", "pinned", "diffusion", "profile"});
    const auto row = [&](std::size_t measurement, std::size_t at) {
        return measured.reports.at(measurement).report.rows.at(at).estimate;
    };
    const ReportTable& ways = measured.reports.at(2).report.tables.at(0);
    const ReportTable& slices = measured.reports.at(3).report.tables.at(0);
    return {row(0, 0),
            row(1, 0),
            row(1, 1),
            {ways.at(0, 1), ways.at(0, 2)},
            mean_of(slices, slices.columns.size() - 2, slices.columns.size() - 1)};
}

Found exactly(const std::vector<Snapshot>& frames) {
    return found_in({frames.size(), 0.0, [&](std::uint64_t k) { return frames[k]; }});
}

Found smoothed(const std::vector<Snapshot>& frames, double noise) {
    TrackSmoothing ignored;
    return found_in(smoothed_series(camera_tracks(frames, noise), scale_of(frames), ignored));
}

void expect_same_angle(const Estimate& found, const Estimate& exact) {
    const double apart = std::remainder(found.mean - exact.mean, 360.0);
    EXPECT_LT(std::abs(apart), 2.0 * std::hypot(found.error, exact.error)) << found.mean;
}

/// Differences that are measured as velocities, which the registry of quantities rules out.
SnapshotSeries with_differences(Tracks tracks, const TrackScale& scale) {
    SnapshotSeries series = series_of(std::move(tracks), scale);
    series.velocities_are_differences = false;
    return series;
}

// Negative: without smoothing, both results are wrong.
TEST(SmoothedTracks, FiniteDifferencesBiasPinningAndTemperature) {
    const Found exact = exactly(laboratory());
    const Found raw =
        found_in(with_differences(camera_tracks(laboratory(), 0.2), scale_of(laboratory())));
    EXPECT_GT(raw.pinning.mean - exact.pinning.mean, 20.0);
    EXPECT_GT(raw.temperature.mean, 1.3 * exact.temperature.mean);
}

TEST(SmoothedTracks, RecoversAnglesOfPinningWithinTheirErrors) {
    const Found exact = exactly(laboratory());
    for (const double noise : {0.0, 0.1, 0.2}) {
        const Found found = smoothed(laboratory(), noise);
        expect_same_angle(found.pinning, exact.pinning);
        expect_same_angle(found.depinning, exact.depinning);
    }
}

// Collisions hidden by the noise reduce the temperature: by 12 % at 0.2 pixels in this dense
// container, where finite differences give 37 % too much (bench/NOTES_tracking.md).
TEST(SmoothedTracks, RecoversTheTemperature) {
    const Found exact = exactly(laboratory());
    for (const double noise : {0.0, 0.1, 0.2}) {
        const Found found = smoothed(laboratory(), noise);
        EXPECT_NEAR(found.temperature.mean, exact.temperature.mean, 0.14 * exact.temperature.mean);
        EXPECT_LT(std::abs(found.temperature.mean - exact.temperature.mean),
                  2.0 * found.temperature.error);
    }
}

void expect_same(const Estimate& found, const Estimate& exact, double noise) {
    EXPECT_LT(std::abs(found.mean - exact.mean), found.error + exact.error) << noise;
}

// Displacements over few frames contain the noise of both ends, and noise increases speeds.
TEST(SmoothedTracks, RecoversDiffusionAndSpeedWithinTheirErrors) {
    const Found exact = exactly(laboratory());
    for (const double noise : {0.0, 0.1, 0.2, 0.4}) {
        const Found found = smoothed(laboratory(), noise);
        expect_same(found.squared_path, exact.squared_path, noise);
        expect_same(found.speed, exact.speed, noise);
    }
    const Found raw =
        found_in(with_differences(camera_tracks(laboratory(), 0.4), scale_of(laboratory())));
    EXPECT_GT(raw.squared_path.mean - exact.squared_path.mean,
              raw.squared_path.error + exact.squared_path.error);
    EXPECT_GT(raw.temperature.mean, 2.0 * exact.temperature.mean);
}

std::string line_of(const char* how, double noise, const Found& found) {
    const auto text = [](const Estimate& e, int digits) {
        return std::isfinite(e.mean) && e.error > 0.0  // a single turn has none
                   ? fmt::format("{:.{}f} ± {:.{}f}", e.mean, digits, e.error, digits)
                   : std::string("n/a");
    };
    return fmt::format("| {:.1f} | {} | {} | {} | {} | {} | {} |\n", noise, how,
                       text(found.temperature, 3), text(found.pinning, 1), text(found.depinning, 1),
                       text(found.squared_path, 4), text(found.speed, 3));
}

// The table of bench/NOTES_tracking.md, from the first row on.
TEST(SmoothedTracks, TableInTheNotesIsUpToDate) {
    std::string table = line_of("exact", 0.0, exactly(laboratory()));
    for (const double noise : {0.0, 0.1, 0.2, 0.4}) {
        const Tracks tracks = camera_tracks(laboratory(), noise);
        table += line_of("differences", noise,
                         found_in(with_differences(tracks, scale_of(laboratory()))));
        table += line_of("smoothed", noise, smoothed(laboratory(), noise));
    }
    std::ifstream stream(SWIRL_SOURCE_DIR "/bench/NOTES_tracking.md");
    const std::string page{std::istreambuf_iterator<char>(stream), {}};
    EXPECT_NE(page.find(table), std::string::npos) << table;
}

struct Deviations {
    double velocity_rms = 0.0, position_rms = 0.0, within_one = 0.0, within_two = 0.0;
};

Deviations deviations(const std::vector<Snapshot>& frames, const Tracks& tracks) {
    const TrackScale scale = scale_of(frames);
    const SnapshotSeries series = series_of(tracks, scale);
    const double unit = pixels * scale.camera_time();
    Deviations sum;
    double count = 0.0;
    for (std::size_t k = 0; k < frames.size(); ++k) {
        const Snapshot s = series.frame(k);
        for (std::size_t i = 0; i < s.size(); ++i) {
            const Vec2 d = s.velocity(i) - frames[k].velocity(i);
            const Vec2 p = pixels * (s.position(i) - frames[k].position(i));
            const auto& errors = tracks.frames[k].velocity_error;
            const double error = errors.empty() ? 0.0 : errors[i] / unit;
            for (const double off : {std::abs(d.x), std::abs(d.y)}) {
                sum.within_one += off < error;
                sum.within_two += off < 2.0 * error;
            }
            sum.velocity_rms += dot(d, d);
            sum.position_rms += dot(p, p);
            count += 2.0;
        }
    }
    return {std::sqrt(sum.velocity_rms / count), std::sqrt(sum.position_rms / count),
            sum.within_one / count, sum.within_two / count};
}

TEST(SmoothedTracks, HalvesErrorsAndEstimatesThem) {
    const Tracks raw = camera_tracks(laboratory(), 0.2);
    Tracks smoothed_tracks = raw;
    const TrackSmoothing smoothing = smooth(smoothed_tracks, scale_of(laboratory()));
    ASSERT_TRUE(smoothing.done);
    EXPECT_NEAR(smoothing.noise, 0.2, 0.01);  // collisions add some per cent
    EXPECT_GT(smoothing.window, 4.0);
    const Deviations before = deviations(laboratory(), raw),
                     after = deviations(laboratory(), smoothed_tracks);
    EXPECT_LT(after.position_rms, 0.5 * before.position_rms);
    EXPECT_NEAR(smoothing.position_error, after.position_rms, 0.25 * after.position_rms);
    // At a collision, the velocities before and after cannot be separated within one frame.
    EXPECT_LT(after.velocity_rms, 0.6 * before.velocity_rms);
    // 68 and 95 % for normal errors; the errors omit collisions too weak to be detected.
    EXPECT_GT(after.within_one, 0.55);
    EXPECT_GT(after.within_two, 0.75);
    EXPECT_LT(after.within_one, 0.75);
}

TEST(SmoothedTracks, ExactPositionsAreUnchanged) {
    Tracks tracks = camera_tracks(laboratory(), 0.0);
    ASSERT_TRUE(smooth(tracks, scale_of(laboratory())).done);
    EXPECT_LT(deviations(laboratory(), tracks).position_rms, 0.005);  // a radius has 26 pixels
}

// Clockwise motion in an image with y down must use the matching container path.
TEST(SmoothedTracks, MirroredTracksGiveMirroredVelocities) {
    Tracks upright = camera_tracks(laboratory(), 0.1), mirrored = upright;
    TrackScale scale = scale_of(laboratory());
    smooth(upright, scale);
    for (TrackFrame& f : mirrored.frames)
        for (Vec2& p : f.position) p.y = 300.0 - p.y;  // y down
    mirrored.y_down = true;
    scale.swirl_centre = {0.0, 300.0};
    smooth(mirrored, scale);
    const Vec2 v = upright.frames[700].velocity[7], w = mirrored.frames[700].velocity[7];
    EXPECT_NEAR(w.x, v.x, 1e-9);  // the values are about ten
    EXPECT_NEAR(w.y, -v.y, 1e-9);
    for (TrackFrame& f : mirrored.frames) {
        for (Vec2& p : f.position) p.x = 500.0 - p.x;
        f.velocity.clear();
    }
    scale.swirl_centre = {500.0, 300.0};
    scale.clockwise = true;
    scale.phase = pi - scale.phase;
    const Tracks once = mirrored;
    smooth(mirrored, scale);
    // A second smoothing hardly moves positions; with a wrong path it would, by pixels.
    EXPECT_NEAR(mirrored.frames[700].velocity[7].x, -v.x, 0.05 * std::hypot(v.x, v.y));
    EXPECT_NEAR(mirrored.frames[700].velocity[7].y, -v.y, 0.05 * std::hypot(v.x, v.y));
}

// Negative: too few frames, given velocities, too few positions.
TEST(SmoothedTracks, UnsuitableTracksAreNotSmoothed) {
    const auto few = recorded_run(64);
    Tracks tracks = camera_tracks(few, 0.2);
    const Vec2 position = tracks.frames[9].position[3];
    EXPECT_FALSE(smooth(tracks, scale_of(few)).done);
    EXPECT_EQ(tracks.frames[9].position[3].x, position.x);
    EXPECT_TRUE(tracks.frames[9].velocity.empty());

    Tracks given = camera_tracks(laboratory(), 0.2);
    for (TrackFrame& f : given.frames) f.velocity.assign(f.id.size(), {1.0, 2.0});
    EXPECT_FALSE(smooth(given, scale_of(laboratory())).done);
    EXPECT_EQ(given.frames[9].velocity[3].x, 1.0);

    Tracks two = camera_tracks(laboratory(), 0.2);
    two.frames.resize(2);
    EXPECT_FALSE(smooth(two, scale_of(laboratory())).done);
}

// A long gap separates two independent segments.
TEST(SmoothedTracks, GapsAreNotBridged) {
    Tracks tracks = camera_tracks(laboratory(), 0.2);
    for (std::size_t k = 500; k < 540; ++k) {
        TrackFrame& f = tracks.frames[k];
        f.id.erase(f.id.begin() + 5);
        f.position.erase(f.position.begin() + 5);
    }
    ASSERT_TRUE(smooth(tracks, scale_of(laboratory())).done);
    for (const TrackFrame& f : tracks.frames) {
        ASSERT_EQ(f.velocity.size(), f.id.size());
        for (const Vec2& v : f.velocity) ASSERT_TRUE(std::isfinite(v.x) && std::isfinite(v.y));
    }
}

}  // namespace
}  // namespace swirl
