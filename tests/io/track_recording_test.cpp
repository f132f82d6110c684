#include "swirl/io/track_recording.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "io/scratch.hpp"
#include "swirl/io/file_error.hpp"
#include "swirl/io/hdf5.hpp"

namespace swirl {
namespace {

/// Three discs in three frames; one disc is missing in the second, and another has no spin.
Tracks some_tracks() {
    Tracks tracks;
    tracks.y_down = true;
    for (const std::int64_t number : {4, 5, 7}) {
        TrackFrame f;
        f.number = number;
        for (const std::int64_t id : {0, 2, 9}) {
            if (number == 5 && id == 2) continue;
            f.id.push_back(id);
            f.position.push_back({0.1 * double(number + id), 1.0 / double(3 + id)});
            f.radius.push_back(12.0 + 0.01 * double(id));
            f.spin.push_back(id == 9 ? std::numeric_limits<double>::quiet_NaN() : 0.7);
        }
        tracks.frames.push_back(f);
    }
    return tracks;
}

void write(const std::filesystem::path& path) {
    const Tracks tracks = some_tracks();
    TrackColumn radius{"radius", {}}, spin{"spin", {}};
    for (const TrackFrame& f : tracks.frames) {
        radius.values.push_back(f.radius);
        spin.values.emplace_back();
        for (const double s : f.spin) spin.values.back().push_back(-s);  // y is down
    }
    write_track_recording(path, tracks, {0.4, 0.5, 0.7}, {radius, spin}, {{"version", "1"}});
}

TEST(TrackRecording, RoundTripIsExact) {
    const Scratch scratch;
    write(scratch / "tracks.h5");
    EXPECT_TRUE(is_track_recording(scratch / "tracks.h5"));
    const Tracks given = some_tracks(), found = read_track_recording(scratch / "tracks.h5");
    EXPECT_TRUE(found.y_down);
    ASSERT_EQ(found.frames.size(), given.frames.size());
    for (std::size_t k = 0; k < given.frames.size(); ++k) {
        const TrackFrame &a = given.frames[k], &b = found.frames[k];
        EXPECT_EQ(a.number, b.number);
        ASSERT_EQ(a.id, b.id);
        EXPECT_EQ(a.radius, b.radius);
        for (std::size_t i = 0; i < a.id.size(); ++i) {
            EXPECT_EQ(a.position[i].x, b.position[i].x);
            EXPECT_EQ(a.position[i].y, b.position[i].y);
            EXPECT_EQ(std::isnan(a.spin[i]), std::isnan(b.spin[i]));
            if (!std::isnan(a.spin[i])) {
                EXPECT_EQ(a.spin[i], b.spin[i]);
            }
        }
    }
}

TEST(TrackRecording, AFailedWriteLeavesNoFile) {
    const Scratch scratch;
    std::filesystem::create_directory(scratch / "tracks.h5");  // cannot be replaced by a file
    EXPECT_THROW(write(scratch / "tracks.h5"), FileError);
    const std::filesystem::directory_iterator left(
        std::filesystem::path(scratch / "tracks.h5").parent_path());
    EXPECT_EQ(std::distance(begin(left), end(left)), 1);
}

TEST(TrackRecording, EachDiscKeepsItsColumnAndStepsAreFrameNumbers) {
    const Scratch scratch;
    write(scratch / "tracks.h5");
    const Hdf5File file(scratch / "tracks.h5", JournaledFile::Mode::read);
    EXPECT_EQ(file.integers_attribute("/h5md", "version"), (std::vector<std::int64_t>{1, 1}));
    EXPECT_EQ(file.column("/particles/tracks/id/value").read<std::int64_t>(),
              (std::vector<std::int64_t>{0, 2, 9, 0, -1, 9, 0, 2, 9}));
    EXPECT_EQ(file.column("/particles/tracks/radius/step").read<std::int64_t>(),
              (std::vector<std::int64_t>{4, 5, 7}));
    EXPECT_EQ(file.column("/particles/tracks/id/time").read<double>(),
              (std::vector<double>{0.4, 0.5, 0.7}));
    EXPECT_TRUE(std::isnan(file.column("/particles/tracks/radius/value").read<double>()[4]));
}

std::string error_message(const std::filesystem::path& path) {
    try {
        read_track_recording(path);
    } catch (const FileError& error) {
        return error.what();
    }
    return "";
}

// Negative: another kind of file, a truncated file, and a disc that appears twice in a frame.
TEST(TrackRecording, InvalidFilesAreRejected) {
    const Scratch scratch;
    {
        Hdf5File other(scratch / "other.h5.partial", JournaledFile::Mode::create);
        other.create_group("/particles");
        other.finish(scratch / "other.h5");
    }
    EXPECT_FALSE(is_track_recording(scratch / "other.h5"));
    EXPECT_NE(error_message(scratch / "other.h5").find("holds no tracks"), std::string::npos);

    write(scratch / "cut.h5");
    std::filesystem::resize_file(scratch / "cut.h5",
                                 std::filesystem::file_size(scratch / "cut.h5") / 2);
    // A damaged file is an error, not a file of another kind.
    EXPECT_THROW(is_track_recording(scratch / "cut.h5"), FileError);
    EXPECT_NE(error_message(scratch / "cut.h5"), "");

    write(scratch / "twice.h5");
    {
        Hdf5File file(scratch / "twice.h5", JournaledFile::Mode::change);
        Column ids = file.column("/particles/tracks/id/value");
        const std::vector<std::int64_t> same{0, 0, 9};
        ids.write<std::int64_t>(0, 1, same.data());
        file.flush();
    }
    EXPECT_NE(error_message(scratch / "twice.h5").find("do not ascend"), std::string::npos);

    write(scratch / "back.h5");
    {
        Hdf5File file(scratch / "back.h5", JournaledFile::Mode::change);
        Column times = file.column("/particles/tracks/position/time");
        const std::vector<double> back{0.7, 0.5, 0.4};
        times.write<double>(0, 3, back.data());
        file.flush();
    }
    EXPECT_NE(error_message(scratch / "back.h5").find("is not after the time 0.7 of frame 4"),
              std::string::npos);
    EXPECT_EQ(error_message(scratch / "none.h5").find("contradicts"), std::string::npos);
}

}  // namespace
}  // namespace swirl
