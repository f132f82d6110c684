#include "swirl/render/numbered_frames.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "pixels.hpp"
#include "swirl/render/scene.hpp"

namespace swirl {
namespace {

namespace fs = std::filesystem;

TEST(NumberedFramesNames, BelongToTheVideoIfTheyMatchThePattern) {
    EXPECT_TRUE(belongs_to_video("video.mp4", "video.mp4"));
    EXPECT_FALSE(belongs_to_video("video.mp4", "other.mp4"));
    for (const char* name : {"a/00007.png", "a/12345.png", "a/123456.png"})
        EXPECT_TRUE(belongs_to_video("a/%05d.png", name)) << name;
    for (const char* name : {"a/7.png", "a/0000x.png", "b/00007.png", "a/00007.svg", "a/.png", ""})
        EXPECT_FALSE(belongs_to_video("a/%05d.png", name)) << name;
    EXPECT_TRUE(belongs_to_video("a/%d.png", "a/7.png"));
    EXPECT_FALSE(belongs_to_video("a/%d.png", "a/.png"));
}

class NumberedFramesTest : public ::testing::Test {
  protected:
    void SetUp() override {
        folder_ = fs::temp_directory_path() / ("swirl-video-" + std::to_string(::getpid()));
        fs::create_directories(folder_);
    }
    void TearDown() override { fs::remove_all(folder_); }
    std::string path(const char* name) const { return (folder_ / name).string(); }

    void write_image(const std::string& name, double grey) const {
        Canvas canvas(Size{8, 6});
        canvas.fill_page({grey, grey, grey});
        std::ofstream(name, std::ios::binary) << canvas.png();
    }
    static int grey_of(const Image& image) {
        cairo_surface_flush(image.surface());
        return cairo_image_surface_get_data(image.surface())[0];
    }

    fs::path folder_;
};

TEST_F(NumberedFramesTest, ReadsImagesByNumber) {
    for (int k : {3, 4, 12})
        write_image(path("a").append(std::to_string(1000 + k)).append(".png"), k / 15.0);
    NumberedFrames video(path("a%04d.png"));
    EXPECT_EQ(video.name(7), path("a0007.png"));
    EXPECT_FALSE(video.has_file(3));
    EXPECT_TRUE(video.has_file(1003));
    EXPECT_EQ(grey_of(*video.image(1003)), 51);
    EXPECT_EQ(grey_of(*video.image(1004)), 68);
    EXPECT_EQ(grey_of(*video.image(1012)), 204);  // gaps between numbers are allowed
    EXPECT_EQ(video.image(1012)->size().width, 8);
    EXPECT_EQ(video.image(1012)->size().height, 6);
    EXPECT_THROW(video.image(1013), DrawFailure);
}

TEST(NumberedFramesNames, ContainTheNumber) {
    EXPECT_EQ(NumberedFrames("x/%d.png").name(12), "x/12.png");
    EXPECT_EQ(NumberedFrames("%03d_b.png").name(5), "005_b.png");
    EXPECT_EQ(NumberedFrames("%03d_b.png").name(12345), "12345_b.png");
    EXPECT_EQ(NumberedFrames("dish.avi").name(12), "dish.avi");
}

TEST(NumberedFramesNames, InvalidPatternsAreRejected) {
    for (const char* good : {"", "%d.png", "a%05d.jpg", "dish.avi", "%3d.tif"})
        EXPECT_FALSE(video_problem(good)) << good;
    for (const char* bad : {"one.png", "%d/%d.png", "%s.png", "%", "%99d.png", "%05x.jpg"})
        EXPECT_TRUE(video_problem(bad)) << bad;
}

TEST(Backdrop, PixelsAreDrawnAtTheirPositions) {
    // One white pixel in an image of 9 × 7 pixels, in both frames, mirrored and not.
    Snapshot s = container(0.3);
    const SceneStyle style{.orientation = false, .points = false, .path = false};
    for (const double mirror : {1.0, -1.0})
        for (const Frame frame : {Frame::lab, Frame::m}) {
            auto image = std::make_shared<Image>(Size{9, 7});
            std::vector<std::uint8_t> rgb(9 * 7 * 3, 0);
            for (int c = 0; c < 3; ++c) rgb[3 * (2 * 9 + 6) + c] = 255;
            image->fill(rgb.data());
            const Backdrop backdrop{image, {-4.0 * mirror, 3.0}, {mirror, 0.0}, {0.0, -1.0}};
            Canvas canvas(Size{700, 700});
            const View view = fitting_view({0, 0, 700, 700}, frame, 8.6, 1.892);
            canvas.fill_page(style.theme.page);
            draw_scene(canvas, view, style, {.now = s, .backdrop = &backdrop});
            // The centroid of the light is the centre of that pixel: column 6, row 2.
            const Vec2 expected =
                view.on_page(FrameTransform(s, frame).position({(-4.0 + 6.0) * mirror, 3.0 - 2.0}));
            double weight = 0.0;
            Vec2 sum{0.0, 0.0};
            for (int y = -40; y <= 40; ++y)
                for (int x = -40; x <= 40; ++x) {
                    const int px = int(expected.x) + x, py = int(expected.y) + y;
                    const double w = pixel(canvas, px, py).green;
                    weight += w;
                    sum = sum + w * Vec2{px + 0.5, py + 0.5};
                }
            ASSERT_GT(weight, 1000.0);
            EXPECT_NEAR(sum.x / weight, expected.x, 0.6);
            EXPECT_NEAR(sum.y / weight, expected.y, 0.6);
        }
}

}  // namespace
}  // namespace swirl
