#include "track/video/lens.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "swirl/math/random.hpp"
#include "swirl/math/unit_circle.hpp"

namespace swirl::tracking {
namespace lens_tests {

constexpr Vec2 image_centre{319.5, 239.5};

double length(const Vec2& v) { return std::sqrt(dot(v, v)); }

// The last step of Newton's method is below 4e-7 pixels, and it converges quadratically.
TEST(Lens, SeenIsTheInverseOfIdeal) {
    for (const double k : {-0.05, 0.0, 0.03, 0.2}) {
        const Lens lens{image_centre, 240.0, k};
        for (double x = 0.0; x <= 639.0; x += 71.0)
            for (double y = 0.0; y <= 479.0; y += 53.0) {
                const Vec2 p = lens.seen(lens.ideal(Vec2{x, y}));
                EXPECT_LT(length(p - Vec2{x, y}), 1e-7) << k;
            }
    }
}

TEST(Lens, SeenIsTheInverseOfIdealForATiltedCamera) {
    Lens lens{image_centre, 240.0, 0.03};
    lens.squeeze = {0.006, -0.008};
    lens.perspective = {1e-4, 6e-5};
    for (double x = 0.0; x <= 639.0; x += 71.0)
        for (double y = 0.0; y <= 479.0; y += 53.0) {
            const Vec2 p = lens.seen(lens.ideal(Vec2{x, y}));
            EXPECT_LT(length(p - Vec2{x, y}), 1e-7);
        }
    const Lens::Circle container{{300.0, 250.0}, 180.0};
    const Lens::Circle back = lens.ideal(lens.image(container));
    EXPECT_LT(length(back.centre - container.centre), 1e-6);
    EXPECT_NEAR(back.radius, container.radius, 1e-6);
}

TEST(Lens, IdealCircleCorrectsTheShiftOfTheCentre) {
    const Lens lens{image_centre, 240.0, 0.03};
    const Lens::Circle container{{image_centre.x + 40.0, image_centre.y - 10.0}, 180.0};
    // A fit of a circle to the image determines the means over equal steps of the angle about its
    // centre.
    Vec2 centre = lens.seen(container.centre);
    double radius = 0.0;
    for (int pass = 0; pass < 20; ++pass) {
        Vec2 d{0.0, 0.0};
        double sum = 0.0;
        const int n = 720;
        for (int k = 0; k < n; ++k) {
            const Vec2 u = unit_circle(double(k) / n);
            double r = 150.0;  // where the ray meets the image of the circle
            for (int step = 0; step < 60; ++step)
                r += container.radius - length(lens.ideal(centre + r * u) - container.centre);
            sum += r / n;
            d = d + (2.0 * r / n) * u;
        }
        centre = centre + d;
        radius = sum;
    }
    EXPECT_GT(length(lens.ideal(centre) - container.centre), 1.0);  // pixels
    const Lens::Circle found = lens.ideal(Lens::Circle{centre, radius});
    // ideal() uses 24 points, and omits terms of second order in the shift.
    EXPECT_LT(length(found.centre - container.centre), 0.03);
    EXPECT_NEAR(found.radius, container.radius, 0.03);
}

TEST(Lens, IsFoundFromApparentSizes) {
    Random random(3);
    for (const double k : {0.0, 0.03, -0.02}) {
        const Lens lens{image_centre, 240.0, k};
        std::vector<ApparentSize> sizes;
        for (int i = 0; i < 800; ++i) {
            const Vec2 p = image_centre + random.in_disc(215.0);
            double noise = 0.0;
            for (int j = 0; j < 12; ++j) noise += random.uniform() - 0.5;
            const double outlier = i % 20 == 0 ? 0.3 : 0.0;
            sizes.push_back({p, lens.seen_radius(p, 1.0) + 0.01 * noise + outlier});
        }
        const Lens found = fit_lens(sizes, image_centre, 240.0);
        EXPECT_NEAR(found.k, k, 4.0 * found.k_error + 0.001) << k;
        EXPECT_LT(found.k_error, 0.002);
        EXPECT_EQ(found.k == 0.0, k == 0.0);
    }
}

/// k from sizes of balls of 26 pixels that give size_k ± 0.0003, and from contacts.
double combined(double size_k, double contact_k, double contact_k_error) {
    Lens lens{image_centre, 240.0};
    lens.size_k = size_k;
    lens.size_k_error = 0.0003;
    lens.ball_radius = 26.0;
    lens.contact_k = contact_k;
    lens.contact_k_error = contact_k_error;
    lens.combine_distortions();
    return lens.k;
}

TEST(Lens, SizesThatContradictContactsAreNotUsed) {
    // Shade changes the sizes of balls without texture like k = −0.015, and a near
    // camera like −0.0095.
    EXPECT_EQ(combined(-0.015, 0.001, 0.0025), 0.0);
    EXPECT_EQ(combined(-0.0095, 0.001, 0.0025), 0.0);
    EXPECT_EQ(combined(-0.0095, -0.003, 0.0025), 0.0);
}

TEST(Lens, WeakDistortionBySizesNeedsSupportOfContacts) {
    EXPECT_EQ(combined(0.005, 0.004, 0.0025), 0.005);
    EXPECT_EQ(combined(0.005, 0.001, 0.0025), 0.0);  // contacts support no distortion
    EXPECT_EQ(combined(0.005, 0.0, 0.0), 0.0);       // no contacts
}

TEST(Lens, WeakNegativeDistortionIsNone) {
    // Shade makes k too small, and contacts may agree with it by chance: the balls of steel of
    // bench/score_tracking.py give the last values without a lens.
    EXPECT_EQ(combined(-0.006, -0.005, 0.0025), 0.0);
    EXPECT_EQ(combined(-0.0149, -0.0119, 0.0055), 0.0);
    EXPECT_LT(combined(-0.033, -0.029, 0.0025), -0.029);
    // At a contrast of 1.3:1, sizes are unknown, and shade moves contacts by 8.7 errors.
    EXPECT_EQ(combined(0.0, -0.07, 0.008), 0.0);
}

TEST(Lens, StrongDistortionIsAWeightedMean) {
    const double k = combined(0.033, 0.029, 0.0025);
    EXPECT_GT(k, 0.029);
    EXPECT_LT(k, 0.033);
}

}  // namespace lens_tests
}  // namespace swirl::tracking
