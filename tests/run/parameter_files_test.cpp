#include "swirl/run/parameter_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "swirl/run/config.hpp"
#include "swirl/run/failure.hpp"

namespace swirl {
namespace {

namespace fs = std::filesystem;

class ParameterFiles : public ::testing::Test {
  protected:
    void SetUp() override { fs::create_directories(folder_); }
    void TearDown() override { fs::remove_all(folder_); }
    std::string written(const std::string& text, const std::string& name = "a.csv") const {
        std::ofstream(folder_ / name, std::ios::binary) << text;
        return (folder_ / name).string();
    }
    std::string path_in(const std::string& text) const {
        return with_file_contents("path", written(text));
    }
    void expect_error(const std::string& text, const char* says) const {
        try {
            resolve({{"path", path_in(text)}, {"discs", "3"}});
            ADD_FAILURE() << "accepted, but should say " << says;
        } catch (const UsageError& error) {
            EXPECT_THAT(error.what(), testing::HasSubstr(says));
        }
    }
    const fs::path folder_ = fs::path(::testing::TempDir()) /
                             ("parameter_files_" + std::to_string(::getpid()) + "_" +
                              ::testing::UnitTest::GetInstance()->current_test_info()->name());
};

TEST_F(ParameterFiles, PathsAreReadInEveryCommonForm) {
    const std::string expected = "points 0:1:0 1:0:1 2:1:0";
    EXPECT_EQ(path_in("t,x,y\n0,1,0\n1,0,1\n2,1,0\n"), expected);
    EXPECT_EQ(path_in("# a comment\r\nT;X;Y\r\n0;1;0\r\n1;0;1\r\n\r\n2;1;0\r\n"), expected);
    EXPECT_EQ(path_in("sep=;\nt;x;y\n0,0;1,0;0\n1;0;1\n2;1;0\n"), expected);
    EXPECT_EQ(path_in("t x y\n0 1 0\n1\t0  1\n2 1 0 # closed\n"), expected);
    EXPECT_EQ(path_in("frame,Y,x,Time\n7,0,1,0\n8,1,0,1\n9,0,1,2\n"), expected);
    EXPECT_EQ(with_file_contents("sizes", "file:" + written("radius,mass\n1,2\n0.5,1\n")),
              "list 1:2 0.5:1");
    EXPECT_EQ(with_file_contents("sizes", "file:" + written("1\n0.5\n")), "list 1 0.5");
    EXPECT_EQ(with_file_contents("sizes", "file:" + written("sep=;\n1,2\n0,5\n")), "list 1.2 0.5");
    EXPECT_EQ(with_file_contents("sizes", "file:" + written("id,r\n3,1\n4,0.5\n")), "list 1 0.5");
    EXPECT_EQ(with_file_contents("initial", written("y,x,vx,vy,spin\n0,2,0,1,-1\n3,2,0,1,0\n")),
              "states 2:0:0:1:-1 2:3:0:1:0");
}

TEST_F(ParameterFiles, OtherTextsAreLeftAlone) {
    for (const char* text : {"polygon", "circle", "ellipse:0.5", "lissajous:1:2:0.5", "spiral", "",
                             "points 0:1:0 1:0:1 2:1:0"})
        EXPECT_EQ(with_file_contents("path", text), text);
    EXPECT_EQ(with_file_contents("sizes", "uniform:0.8:1.2"), "uniform:0.8:1.2");
    EXPECT_EQ(with_file_contents("mu", "a.csv"), "a.csv");
}

TEST_F(ParameterFiles, ListsAreReadPartByPart) {
    const std::string file = written("t,x,y\n0,1,0\n1,0,1\n2,1,0\n");
    EXPECT_EQ(with_file_contents("path", "line," + file + ",ellipse:0.5"),
              "line,points 0:1:0 1:0:1 2:1:0,ellipse:0.5");
    // A file name may contain a comma.
    EXPECT_EQ(with_file_contents("path", written("t,x,y\n0,1,0\n1,0,1\n2,1,0\n", "a,b.csv")),
              "points 0:1:0 1:0:1 2:1:0");
}

TEST_F(ParameterFiles, ANumberIsReadExactly) {
    const double third = 1.0 / 3.0;
    const RunConfig config = resolve(
        {{"path", path_in("t,x,y\n0,0.33333333333333331,0\n1,0,1\n2,0.33333333333333331,0\n")},
         {"discs", "3"}});
    EXPECT_EQ(config.curve.points[0].at.x, third);
}

TEST_F(ParameterFiles, HostileFilesAreRejected) {
    expect_error("", "has no rows");
    expect_error("t,x,y\n", "has no rows");
    expect_error("x,y\n0,1\n", "no column 't'");
    expect_error("t,x\n0,1\n1,0\n", "no column 'y'");
    expect_error("0,1,0\n1,0,1\n2,1,0\n", "line 1: 3 columns without a header");
    expect_error("t,x,y\n0,1,0\n1,zero,1\n2,1,0\n", "line 3: column 'x' is 'zero'");
    expect_error("t,x,y\n0,1,0\n1,nan,1\n2,1,0\n", "'nan'");
    expect_error("t,x,y\n0,1,0\n1,0\n2,1,0\n", "line 3: 2 fields, but the first line has 3");
    expect_error("t,x,y\n0,1,0\n1,,1\n2,1,0\n", "line 3: column 'x' is ''");
    expect_error("t,x,y\n0,1,0\n", "1 point");
    expect_error("t,x,y\n0,1,0\n1,0,1\n2,0,0\n", "not closed");
    expect_error("t,x,y\n0,1,0\n2,0,1\n1,1,0\n", "times must increase");
    expect_error("t,x,y\n0,1,0\n1,0,1\n2,1,0", "line 4: the last line has no line break");
    expect_error(std::string("t,x,y\n0,1,0\n1,\0,1\n2,1,0\n", 26), "line 3");
    expect_error(std::string(1000, '\xff') + "\n", "no column");
    std::string many = "t,x,y\n";
    for (int k = 0; k < 30000; ++k) many += std::to_string(k) + ",1,0\n";
    expect_error(many, "more than 20000 rows");
    expect_error(std::string((1 << 24) + 2, '#'), "more than 16 MB");
    for (const char* text : {"x,y,vx,vy\n2,0,0,0\n", "2,0,0,0\n", "x,y,vx,vy,spin\n2,0,0,0,nan\n"})
        EXPECT_THROW(with_file_contents("initial", written(text)), UsageError) << text;
    // Radii of 1.2, 1.1 and 1.3 with decimal commas, or radii of 1 and masses of 2, 1 and 3.
    for (const char* text : {"1,2\n1,1\n1,3\n", "radius\n1,2\n1,1\n1,3\n", "1\n0.5"})
        EXPECT_THROW(with_file_contents("sizes", "file:" + written(text)), UsageError) << text;
}

TEST_F(ParameterFiles, OnlyRegularFilesAreRead) {
    for (const std::string& name :
         {folder_.string(), (folder_ / "nothing.csv").string(), std::string("/dev/zero")}) {
        EXPECT_THROW(with_file_contents("path", name), UsageError) << name;
        EXPECT_THROW(with_file_contents("sizes", "file:" + name), UsageError) << name;
    }
}

}  // namespace
}  // namespace swirl
