#include "swirl/render/movie_file.hpp"

#include <gtest/gtest.h>
#include <sys/mount.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "pixels.hpp"
#include "swirl/render/planar.hpp"

namespace swirl {
namespace {

namespace fs = std::filesystem;

std::string contents_of(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

std::string output_of(const std::string& command) {
    std::FILE* pipe = ::popen(command.c_str(), "r");
    std::string text;
    std::array<char, 256> part{};
    while (std::fgets(part.data(), part.size(), pipe)) text += part.data();
    ::pclose(pipe);
    return text;
}

class Movie : public ::testing::Test {
  protected:
    void SetUp() override {
        folder_ = fs::temp_directory_path() / ("swirl-movie-" + std::to_string(::getpid()));
        fs::create_directories(folder_);
    }
    void TearDown() override {
        ::setenv("PATH", search_path_.c_str(), 1);
        fs::remove_all(folder_);
    }
    std::string path(const char* name) const { return (folder_ / name).string(); }

    /// Each frame has one grey level.
    void write(MovieWriter& writer, const std::string& file, Size size, int frames) {
        for (int k = 0; k < frames; ++k) {
            const auto grey = static_cast<std::uint8_t>(20 + 10 * k % 200);
            std::vector<std::uint8_t> pixels(4u * size.width * size.height, grey), planes;
            if (movie_format(file) == MovieFormat::gif) {
                writer.write(pixels);
            } else {
                to_planar(pixels, size, planes);
                writer.write(planes);
            }
        }
    }
    void make(const std::string& file, Size size, int fps, int frames) {
        MovieWriter writer(file, *movie_format(file), size, fps);
        write(writer, file, size, frames);
        writer.finish();
    }
    static std::string probe(const std::string& file, const std::string& entries) {
        return output_of(
            "ffprobe -v error -count_frames -select_streams v:0 -of csv=p=0 "
            "-show_entries " +
            entries + " " + file);
    }

    /// Replaces ffmpeg by a shell script.
    void replace_ffmpeg(const std::string& script) {
        const fs::path bin = folder_ / "bin";
        fs::create_directories(bin);
        std::ofstream(bin / "ffmpeg") << "#!/bin/sh\n" << script << "\n";
        fs::permissions(bin / "ffmpeg", fs::perms::owner_all);
        ::setenv("PATH", (bin.string() + ":" + search_path_).c_str(), 1);
    }

    fs::path folder_;
    std::string search_path_ = ::getenv("PATH");
};

TEST_F(Movie, Mp4HasTheGivenProperties) {
    make(path("x.mp4"), {64, 48}, 30, 45);
    EXPECT_EQ(probe(path("x.mp4"),
                    "stream=codec_name,width,height,pix_fmt,color_range,color_space,"
                    "r_frame_rate,duration,nb_read_frames"),
              "h264,64,48,yuv420p,tv,bt709,30/1,1.500000,45\n");
    // The index comes before the frames.
    const std::string bytes = contents_of(path("x.mp4"));
    EXPECT_LT(bytes.find("moov"), bytes.find("mdat"));
}

TEST_F(Movie, WebmIsVp9) {
    make(path("x.webm"), {64, 48}, 25, 20);
    EXPECT_EQ(probe(path("x.webm"), "stream=codec_name,width,height,r_frame_rate,nb_read_frames"),
              "vp9,64,48,25/1,20\n");
    EXPECT_EQ(probe(path("x.webm"), "format=duration"), "0.800000\n");
}

TEST_F(Movie, GifLoopsAndHasTheGivenDuration) {
    make(path("x.gif"), {64, 48}, 25, 20);
    EXPECT_EQ(probe(path("x.gif"), "stream=codec_name,width,height,r_frame_rate,nb_read_frames"),
              "gif,64,48,25/1,20\n");
    EXPECT_NE(contents_of(path("x.gif")).find("NETSCAPE2.0"), std::string::npos);
    EXPECT_EQ(probe(path("x.gif"), "format=duration"), "0.800000\n");
}

TEST_F(Movie, GreyLevelsArePreserved) {
    make(path("x.mp4"), {64, 48}, 30, 3);
    const std::string raw = output_of("ffmpeg -v error -i " + path("x.mp4") +
                                      " -f rawvideo -pix_fmt rgb24 - | od -An -tu1 -j" +
                                      std::to_string(2 * 64 * 48 * 3) + " -N3");
    int red = 0, green = 0, blue = 0;
    ASSERT_EQ(std::sscanf(raw.c_str(), "%d %d %d", &red, &green, &blue), 3);
    // Third frame: 20 + 2·10. Limited range and quantisation change it by up to three levels.
    EXPECT_NEAR(red, 40, 3);
    EXPECT_NEAR(green, 40, 3);
    EXPECT_NEAR(blue, 40, 3);
}

TEST_F(Movie, EqualFramesGiveEqualBytes) {
    for (const char* ending : {"mp4", "webm", "gif"}) {
        const std::string one = path("one.") + ending, two = path("two.") + ending;
        make(one, {128, 96}, 25, 30);
        make(two, {128, 96}, 25, 30);
        EXPECT_EQ(contents_of(one), contents_of(two)) << ending;
    }
}

TEST_F(Movie, MissingFfmpegIsAnErrorWithAHint) {
    ::setenv("PATH", folder_.c_str(), 1);
    try {
        MovieWriter writer(path("x.mp4"), MovieFormat::mp4, {64, 48}, 30);
        FAIL() << "no exception";
    } catch (const DrawFailure& failure) {
        const std::string text = failure.what();
        EXPECT_NE(text.find("apt-get install ffmpeg"), std::string::npos) << text;
        EXPECT_NE(text.find("--frame-files"), std::string::npos) << text;
    }
    EXPECT_TRUE(fs::is_empty(folder_));
}

TEST_F(Movie, FailingFfmpegIsAnErrorAndLeavesNoFile) {
    replace_ffmpeg("head -c 100000 >/dev/null; echo 'the encoder caught fire' >&2; exit 7");
    try {
        make(path("x.mp4"), {640, 480}, 30, 100);
        FAIL() << "no exception";
    } catch (const DrawFailure& failure) {
        const std::string text = failure.what();
        EXPECT_NE(text.find("code 7"), std::string::npos) << text;
        EXPECT_NE(text.find("the encoder caught fire"), std::string::npos) << text;
    }
    EXPECT_FALSE(fs::exists(path("x.mp4")));
    EXPECT_FALSE(fs::exists(path("x.mp4.partial")));
}

TEST_F(Movie, KilledFfmpegIsAnError) {
    replace_ffmpeg("kill -9 $$");
    try {
        make(path("x.mp4"), {640, 480}, 30, 100);
        FAIL() << "no exception";
    } catch (const DrawFailure& failure) {
        EXPECT_NE(std::string(failure.what()).find("signal 9"), std::string::npos)
            << failure.what();
    }
    EXPECT_FALSE(fs::exists(path("x.mp4")));
}

// The script writes some bytes, or nothing, to its last argument, file:NAME.
TEST_F(Movie, FfmpegThatFailsAtTheEndIsAnError) {
    const std::string some = "cat >/dev/null; for last; do :; done; echo some >\"${last#file:}\"; ";
    for (const std::string& how :
         {some + "echo 'No space left on device' >&2; exit 0",
          some + "echo 'Disk quota exceeded' >&2; exit 0",
          some + "echo 'Input/output error' >&2; exit 0", std::string("cat >/dev/null; exit 0")}) {
        replace_ffmpeg(how.c_str());
        EXPECT_THROW(make(path("x.mp4"), {64, 48}, 30, 3), DrawFailure) << how;
        EXPECT_FALSE(fs::exists(path("x.mp4")));
        EXPECT_FALSE(fs::exists(path("x.mp4.partial")));
    }
}

TEST_F(Movie, FullDiskIsAnErrorAndLeavesNoFile) {
    const std::string disk = path("disk");
    fs::create_directory(disk);
    if (::mount("swirl-test", disk.c_str(), "tmpfs", 0, "size=4k") != 0)
        GTEST_SKIP() << "a small disk can be mounted by root only";
    for (const std::string ending : {"mp4", "webm", "gif"}) {
        try {
            make(disk + "/x." + ending, {320, 240}, 25, 50);
            ADD_FAILURE() << "no exception: " << ending;
        } catch (const DrawFailure& failure) {
            EXPECT_NE(std::string(failure.what()).find("No space left"), std::string::npos)
                << failure.what();
        }
        EXPECT_TRUE(fs::is_empty(disk)) << ending;
    }
    ::umount(disk.c_str());
}

TEST_F(Movie, MissingFolderIsAnError) {
    EXPECT_THROW(make(path("no/such/x.mp4"), {64, 48}, 30, 3), DrawFailure);
}

TEST_F(Movie, UnfinishedMovieLeavesNoFile) {
    {
        MovieWriter writer(path("x.mp4"), MovieFormat::mp4, {64, 48}, 30);
        write(writer, path("x.mp4"), {64, 48}, 5);
    }
    EXPECT_TRUE(fs::is_empty(folder_));
}

TEST_F(Movie, ExistingMovieIsReplacedOnlyByACompleteOne) {
    std::ofstream(path("x.mp4")) << "the old one";
    replace_ffmpeg("exit 3");
    EXPECT_THROW(make(path("x.mp4"), {640, 480}, 30, 50), DrawFailure);
    EXPECT_EQ(contents_of(path("x.mp4")), "the old one");
}

TEST(MovieFormat, IsDeterminedByTheExtension) {
    EXPECT_EQ(movie_format("a/b.mp4"), MovieFormat::mp4);
    EXPECT_EQ(movie_format("b.webm"), MovieFormat::webm);
    EXPECT_EQ(movie_format("b.gif"), MovieFormat::gif);
    EXPECT_FALSE(movie_format("b.avi"));
    EXPECT_FALSE(movie_format(".mp4"));
    EXPECT_FALSE(movie_format(""));
}

TEST(MovieFormat, ImpossibleMoviesAreRejected) {
    EXPECT_FALSE(movie_problem(MovieFormat::mp4, {16, 16}, 1));
    EXPECT_FALSE(movie_problem(MovieFormat::mp4, {8192, 8192}, 240));
    EXPECT_TRUE(movie_problem(MovieFormat::mp4, {14, 16}, 30));
    EXPECT_TRUE(movie_problem(MovieFormat::mp4, {8194, 16}, 30));
    EXPECT_TRUE(movie_problem(MovieFormat::mp4, {641, 480}, 30));
    EXPECT_FALSE(movie_problem(MovieFormat::gif, {641, 481}, 25));
    EXPECT_TRUE(movie_problem(MovieFormat::mp4, {640, 480}, 0));
    EXPECT_TRUE(movie_problem(MovieFormat::mp4, {640, 480}, 241));
    // A GIF counts in hundredths of a second.
    EXPECT_TRUE(movie_problem(MovieFormat::gif, {640, 480}, 30));
}

}  // namespace
}  // namespace swirl
