// A simulated run as a camera would see it, with a known noise: what smoothing gives back.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "swirl/io/track_smoothing.hpp"
#include "swirl/math/random.hpp"
#include "swirl/math/unit_circle.hpp"
#include "swirl/run/measured_series.hpp"
#include "swirl/run/run.hpp"
#include "swirl/run/track_fit.hpp"

namespace swirl {
namespace {

constexpr double pixels = 26.0;  // a radius, as in the laboratory

std::vector<Snapshot> recorded_run(int frames_per_swirl) {
    RunConfig config;
    config.discs = 48;
    config.periods = 12;
    config.warmup = 4;
    config.seed = 3;
    Run run(config);
    SampleTimes times = run.sample_times(frames_per_swirl);
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

/// What a camera sees of it, with a normal error of so many pixels in every coordinate.
Tracks seen(const std::vector<Snapshot>& frames, double noise) {
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
    Estimate temperature, becoming_pinned, becoming_free;
    Estimate wandered;  // square of the way relative to the dish, in a seventy-third of a swirl
    Estimate speed;     // of the profile, the mean over its slices
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
    return found_in(smoothed_series(seen(frames, noise), scale_of(frames), ignored));
}

void expect_same_angle(const Estimate& found, const Estimate& exact) {
    const double apart = std::remainder(found.mean - exact.mean, 360.0);
    EXPECT_LT(std::abs(apart), 2.0 * std::hypot(found.error, exact.error)) << found.mean;
}

// Negative: this is what is mended.
TEST(SmoothedTracks, DifferencesOfNoisyPlacesAreWrongInBoth) {
    const Found exact = exactly(laboratory());
    const Found raw = found_in(series_of(seen(laboratory(), 0.2), scale_of(laboratory())));
    EXPECT_GT(raw.becoming_pinned.mean - exact.becoming_pinned.mean, 20.0);
    EXPECT_GT(raw.temperature.mean, 1.3 * exact.temperature.mean);
}

TEST(SmoothedTracks, WhereDiscsBecomePinnedAndFreeComesBackWithinItsError) {
    const Found exact = exactly(laboratory());
    for (const double noise : {0.0, 0.1, 0.2}) {
        const Found found = smoothed(laboratory(), noise);
        expect_same_angle(found.becoming_pinned, exact.becoming_pinned);
        expect_same_angle(found.becoming_free, exact.becoming_free);
    }
}

// Collisions that the noise hides take some of the temperature with them, at 0.2 pixels 12 % in
// this crowded dish, where differences have 37 % too much: docs/camera.md.
TEST(SmoothedTracks, TheTemperatureComesBack) {
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

// Ways of few pictures hold the noise of both ends, and speeds are lengths, to which noise adds.
TEST(SmoothedTracks, DiffusionAndTheSpeedOfTheProfileComeBackWithinTheirErrors) {
    const Found exact = exactly(laboratory());
    for (const double noise : {0.0, 0.1, 0.2, 0.4}) {
        const Found found = smoothed(laboratory(), noise);
        expect_same(found.wandered, exact.wandered, noise);
        expect_same(found.speed, exact.speed, noise);
    }
    const Found raw = found_in(series_of(seen(laboratory(), 0.4), scale_of(laboratory())));
    EXPECT_GT(raw.wandered.mean - exact.wandered.mean, raw.wandered.error + exact.wandered.error);
    EXPECT_GT(raw.temperature.mean, 2.0 * exact.temperature.mean);
}

std::string line_of(const char* how, double noise, const Found& found) {
    const auto text = [](const Estimate& e, int digits) {
        return std::isfinite(e.mean) && e.error > 0.0  // a single turn has none
                   ? fmt::format("{:.{}f} ± {:.{}f}", e.mean, digits, e.error, digits)
                   : std::string("not told");
    };
    return fmt::format("| {:.1f} | {} | {} | {} | {} | {} | {} |\n", noise, how,
                       text(found.temperature, 3), text(found.becoming_pinned, 1),
                       text(found.becoming_free, 1), text(found.wandered, 4), text(found.speed, 3));
}

// The table of docs/camera.md, from "exactly" on.
TEST(SmoothedTracks, TheTable) {
    std::string table = line_of("exactly", 0.0, exactly(laboratory()));
    for (const double noise : {0.0, 0.1, 0.2, 0.4}) {
        const Tracks tracks = seen(laboratory(), noise);
        table += line_of("differences", noise, found_in(series_of(tracks, scale_of(laboratory()))));
        table += line_of("smoothed", noise, smoothed(laboratory(), noise));
    }
    std::ifstream stream(SWIRL_SOURCE_DIR "/docs/camera.md");
    const std::string page{std::istreambuf_iterator<char>(stream), {}};
    EXPECT_NE(page.find(table), std::string::npos) << table;
}

struct Deviations {
    double velocity_rms = 0.0, place_rms = 0.0, within_one = 0.0, within_two = 0.0;
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
            sum.place_rms += dot(p, p);
            count += 2.0;
        }
    }
    return {std::sqrt(sum.velocity_rms / count), std::sqrt(sum.place_rms / count),
            sum.within_one / count, sum.within_two / count};
}

TEST(SmoothedTracks, PlacesAndVelocitiesAreTwiceAsGoodAndTellTheirErrors) {
    const Tracks raw = seen(laboratory(), 0.2);
    Tracks smooth_ones = raw;
    const TrackSmoothing smoothing = smooth(smooth_ones, scale_of(laboratory()));
    ASSERT_TRUE(smoothing.done);
    EXPECT_NEAR(smoothing.noise, 0.2, 0.01);  // collisions add some per cent
    EXPECT_GT(smoothing.window, 4.0);
    const Deviations before = deviations(laboratory(), raw),
                     after = deviations(laboratory(), smooth_ones);
    EXPECT_LT(after.place_rms, 0.5 * before.place_rms);
    EXPECT_NEAR(smoothing.place_error, after.place_rms, 0.25 * after.place_rms);
    // At a collision there is a velocity before and one after, which no picture tells apart.
    EXPECT_LT(after.velocity_rms, 0.6 * before.velocity_rms);
    // 68 and 95 % of normal errors; collisions too weak to be told are not in them.
    EXPECT_GT(after.within_one, 0.55);
    EXPECT_GT(after.within_two, 0.75);
    EXPECT_LT(after.within_one, 0.75);
}

TEST(SmoothedTracks, ExactPlacesStayWhereTheyAre) {
    Tracks tracks = seen(laboratory(), 0.0);
    ASSERT_TRUE(smooth(tracks, scale_of(laboratory())).done);
    EXPECT_LT(deviations(laboratory(), tracks).place_rms, 0.005);  // of 26 pixels
}

// A swirl that ran clockwise in the picture, with y down: the course is the dish's.
TEST(SmoothedTracks, AMirroredPictureIsSmoothedAlike) {
    Tracks upright = seen(laboratory(), 0.1), mirrored = upright;
    TrackScale scale = scale_of(laboratory());
    smooth(upright, scale);
    for (TrackFrame& f : mirrored.frames)
        for (Vec2& p : f.position) p.y = 300.0 - p.y;  // y down
    mirrored.y_down = true;
    scale.swirl_centre = {0.0, 300.0};
    smooth(mirrored, scale);
    const Vec2 v = upright.frames[700].velocity[7], w = mirrored.frames[700].velocity[7];
    EXPECT_NEAR(w.x, v.x, 1e-9);  // of some ten
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
    // Smoothed twice, so the places hardly move any more; with a wrong course they would by pixels.
    EXPECT_NEAR(mirrored.frames[700].velocity[7].x, -v.x, 0.05 * std::hypot(v.x, v.y));
    EXPECT_NEAR(mirrored.frames[700].velocity[7].y, -v.y, 0.05 * std::hypot(v.x, v.y));
}

// Negative: nothing is done where nothing can be known.
TEST(SmoothedTracks, FewPicturesAndGivenVelocitiesAreLeftAlone) {
    const auto few = recorded_run(64);
    Tracks tracks = seen(few, 0.2);
    const Vec2 place = tracks.frames[9].position[3];
    EXPECT_FALSE(smooth(tracks, scale_of(few)).done);
    EXPECT_EQ(tracks.frames[9].position[3].x, place.x);
    EXPECT_TRUE(tracks.frames[9].velocity.empty());

    Tracks given = seen(laboratory(), 0.2);
    for (TrackFrame& f : given.frames) f.velocity.assign(f.id.size(), {1.0, 2.0});
    EXPECT_FALSE(smooth(given, scale_of(laboratory())).done);
    EXPECT_EQ(given.frames[9].velocity[3].x, 1.0);

    Tracks two = seen(laboratory(), 0.2);
    two.frames.resize(2);
    EXPECT_FALSE(smooth(two, scale_of(laboratory())).done);
}

// A disc that is not seen for long has no place between; what is before and after is two stretches.
TEST(SmoothedTracks, AGapIsNotBridged) {
    Tracks tracks = seen(laboratory(), 0.2);
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
