#include "track/video/tilt.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "swirl/math/unit_circle.hpp"

namespace swirl::tracking {
namespace tilt_tests {

constexpr int side = 320;
constexpr double radius = 110.0, amplitude = 24.0, radians = pi / 180.0;
constexpr Vec2 image_centre{0.5 * (side - 1), 0.5 * (side - 1)};

/// A camera over a table. Its axis goes through the centre of the image; the table is tilted by
/// `tilt` and `far` pixels away.
struct PinholeCamera {
    double tilt, towards, far;

    /// The point of the table that a pixel shows.
    Vec2 on_table(const Vec2& pixel) const {
        // The axis is z; x and y (down) are the image's. The camera stands towards `side_way`, so
        // that the table is nearer there: its point at u has the depth far − u sin θ.
        const Vec2 side_way{std::cos(towards), -std::sin(towards)};
        const Vec2 across = perpendicular(side_way), q = pixel - image_centre;
        const double a = dot(q, side_way), b = dot(q, across);
        // a = far u cos θ / (far − u sin θ)
        const double u = far * a / (far * std::cos(tilt) + a * std::sin(tilt));
        const double depth = far - u * std::sin(tilt);
        return image_centre + u * side_way + (b * depth / far) * across;
    }
};

/// `shutter`: by how much the container turns further, clockwise, per pixel; rad.
std::vector<PreparedFrame> video_of(const PinholeCamera& camera, double oval = 0.0,
                                    const Vec2& shutter = {0.0, 0.0}) {
    std::vector<PreparedFrame> frames;
    for (int k = 0; k < 24; ++k) {
        cv::Mat grey(side, side, CV_8U);
        for (int row = 0; row < side; ++row)
            for (int column = 0; column < side; ++column) {
                const Vec2 pixel{double(column), double(row)};
                const Vec2 u =
                    unit_circle(k / 24.0 - dot(shutter, pixel - image_centre) / (2.0 * pi));
                const Vec2 centre = image_centre + Vec2{7.0, -4.0} + amplitude * Vec2{u.x, -u.y};
                Vec2 d = camera.on_table(pixel) - centre;
                d.x *= 1.0 + oval;
                const double out = std::clamp(length(d) - radius + 0.5, 0.0, 1.0);
                grey.at<std::uint8_t>(row, column) =
                    static_cast<std::uint8_t>(60.5 + 80.0 * out + (row * 7 + column * 13 + k) % 3);
            }
        frames.emplace_back(grey, 1.0, 1.0);
    }
    return frames;
}

ContainerRim survey_rim() {
    ContainerRim rim;
    rim.radius = radius;
    rim.polarity = -1;
    rim.path_centre = image_centre + Vec2{7.0, -4.0};
    rim.amplitude = amplitude;
    return rim;
}

/// A lens without distortion. Sizes of equal balls then give an apparent one (lens.hpp).
Lens ideal_lens(const PinholeCamera& camera) {
    Lens lens{image_centre, 0.5 * side};
    lens.k_error = 1e-4;
    const double view = 0.5 * side / camera.far;
    lens.size_k = -view * view / 8.0;
    return lens;
}

TEST(Tilt, AngleAndSideAreFoundFromTheRim) {
    for (const double degrees : {3.0, 8.0})
        for (const double towards : {20.0, 250.0}) {
            const PinholeCamera camera{degrees * radians, towards * radians, 700.0};
            ContainerRim rim = survey_rim();
            Lens lens = ideal_lens(camera);
            const Tilt tilt = find_tilt(video_of(camera), {}, rim, lens);
            EXPECT_NEAR(tilt.angle, camera.tilt, 4.0 * tilt.angle_error) << degrees;
            EXPECT_LT(tilt.angle_error, 0.3 * radians);
            EXPECT_LT(std::abs(std::remainder(tilt.towards - camera.towards, 2.0 * pi)),
                      4.0 * tilt.towards_error);
            EXPECT_LT(tilt.towards_error, 5.0 * radians);
            EXPECT_FALSE(tilt.oval);
            EXPECT_FALSE(lens.rolls());
            // The error is below 0.1 pixels, a hundredth of a disc of ten pixels, everywhere in the
            // container.
            for (double x = 60.0; x < 260.0; x += 25.0) {
                const Vec2 p{x, 0.9 * x};
                EXPECT_LT(length(lens.ideal(p) - camera.on_table(p)), 0.1) << x;
            }
        }
}

TEST(Tilt, StraightCameraHasNoTiltAndKeepsItsLens) {
    const PinholeCamera camera{0.0, 0.0, 1e9};
    ContainerRim rim = survey_rim();
    Lens lens = ideal_lens(camera);
    const Tilt tilt = find_tilt(video_of(camera), {}, rim, lens);
    EXPECT_EQ(tilt.angle, 0.0);
    EXPECT_LT(tilt.below, 2.0 * radians);
    EXPECT_GT(tilt.below, 0.0);
    EXPECT_FALSE(lens.tilted());
    EXPECT_FALSE(rim.lens);
    EXPECT_EQ(rim.radius, radius);
}

TEST(Tilt, RollingShutterIsFoundWithAndWithoutATilt) {
    // At 15 frames per period: reads rows in 0.8 of a frame interval, upwards in 0.3, and columns.
    for (const Vec2& shutter : {Vec2{0.0, 1.05e-3}, Vec2{0.0, -3.9e-4}, Vec2{1.05e-3, 0.0}})
        for (const double degrees : {0.0, 5.0}) {
            const PinholeCamera camera{degrees * radians, 20.0 * radians, 700.0};
            ContainerRim rim = survey_rim();
            Lens lens = ideal_lens(camera);
            const Tilt tilt = find_tilt(video_of(camera, 0.0, shutter), {}, rim, lens);
            EXPECT_NEAR(tilt.angle, camera.tilt, 4.0 * tilt.angle_error + 1e-9) << degrees;
            EXPECT_LT(length(lens.shutter - shutter), 4.0 * lens.shutter_error) << degrees;
            EXPECT_LT(lens.shutter_error, 0.05 * length(shutter));
            EXPECT_NEAR(rim.radius, radius, 0.1);  // pixels
        }
}

TEST(Tilt, GivenTiltIsUsed) {
    const PinholeCamera camera{6.0 * radians, 120.0 * radians, 700.0};
    KnownCamera known;
    known.tilt = camera.tilt;
    known.towards = camera.towards;
    ContainerRim rim = survey_rim();
    Lens lens = ideal_lens(camera);
    const Tilt tilt = find_tilt(video_of(camera), known, rim, lens);
    EXPECT_NEAR(tilt.angle, camera.tilt, 1e-9);
    for (double x = 60.0; x < 260.0; x += 25.0)
        EXPECT_LT(length(lens.ideal(Vec2{x, x}) - camera.on_table({x, x})), 0.1) << x;
    known.tilt = 0.0;
    lens = ideal_lens(camera);
    find_tilt(video_of(camera), known, rim, lens);
    EXPECT_FALSE(lens.tilted());
}

TEST(Tilt, OvalContainerContradictsThePerspective) {
    // Squeezed by a hundredth along x; the camera is nearer to the lower side.
    const PinholeCamera camera{3.0 * radians, 270.0 * radians, 700.0};
    ContainerRim rim = survey_rim();
    Lens lens = ideal_lens(camera);
    EXPECT_TRUE(find_tilt(video_of(camera, 0.01), {}, rim, lens).oval);
}

}  // namespace tilt_tests
}  // namespace swirl::tracking
