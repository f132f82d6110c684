#include "swirl/measure/m_frame.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "measure/snapshots.hpp"
#include "swirl/measure/cluster_rotation.hpp"

namespace swirl {
namespace {

TEST(TurnsOf, IsTheInverseOfTheUnitCircle) {
    for (int k = 0; k < 4096; ++k) {
        const double u = k / 4096.0;
        EXPECT_NEAR(turns_of(unit_circle(u)), u, 4e-16) << k;  // two ulp of 1
        EXPECT_NEAR(turns_of(1e-9 * unit_circle(u)), u, 4e-16) << k;
    }
    EXPECT_EQ(turns_of({1.0, 0.0}), 0.0);
    EXPECT_EQ(turns_of({0.0, 2.0}), 0.25);
    EXPECT_EQ(turns_of({-3.0, 0.0}), 0.5);
    EXPECT_EQ(turns_of({0.0, -1.0}), 0.75);
    EXPECT_EQ(turns_of({0.0, 0.0}), 0.0);
    EXPECT_GE(turns_of({1.0, -1e-300}), 0.0);
    EXPECT_LT(turns_of({1.0, -1e-300}), 1.0);
    EXPECT_TRUE(std::isnan(turns_of({not_available, 1.0})));
    EXPECT_TRUE(std::isnan(turns_of({1.0, not_available})));
}

TEST(MFrame, TheSwirlCentreIsAboveAndMIsAtTheBottom) {
    for (int k = 0; k < 30; ++k) {
        const Snapshot s = empty_container(k / 30.0);
        const MFrame f = m_frame(s);
        const Vec2 S = f.position({0.0, 0.0});
        EXPECT_NEAR(S.x, 0.0, 1e-15);
        EXPECT_NEAR(S.y, paper_amplitude, 1e-15);
        const Vec2 M = (1.0 + paper_container_radius / paper_amplitude) * s.container_centre;
        EXPECT_NEAR(f.position(M).x, 0.0, 1e-14);
        EXPECT_NEAR(f.position(M).y, -paper_container_radius, 1e-14);
    }
}

TEST(MFrame, ForwardAndBackIsTheIdentity) {
    for (int k = 0; k < 12; ++k) {
        const Snapshot s = held_earlier(random_discs(20, k, k / 12.0));
        const MFrame f = m_frame(s);
        const Snapshot there = seen_from(f, s);
        for (std::size_t i = 0; i < s.size(); ++i) {
            const Vec2 position = f.lab_position(there.position(i));
            const Vec2 velocity = f.lab_velocity(there.position(i), there.velocity(i));
            // Positions of size 10: a few ulp.
            EXPECT_NEAR(position.x, s.position(i).x, 1e-14);
            EXPECT_NEAR(position.y, s.position(i).y, 1e-14);
            EXPECT_NEAR(velocity.x, s.vx[i], 1e-14);
            EXPECT_NEAR(velocity.y, s.vy[i], 1e-14);
            EXPECT_NEAR(there.spin[i] + f.omega, s.spin[i], 1e-15);
            EXPECT_NEAR(there.orientation(i) + f.angle(), s.orientation(i), 1e-14);
        }
    }
}

TEST(MFrame, ADiscCarriedByTheContainerMovesLikeItsWall) {
    Snapshot s = empty_container(0.3);
    add_disc(s, s.container_centre + Vec2{3.0, 4.0}, s.container_velocity);
    const MFrame f = m_frame(s);
    const Vec2 p = f.position(s.position(0)), v = f.velocity(s.position(0), s.velocity(0));
    EXPECT_NEAR(v.x, -(f.omega * perpendicular(p)).x, 1e-15);
    EXPECT_NEAR(v.y, -(f.omega * perpendicular(p)).y, 1e-15);
    EXPECT_NEAR(cross(p, v), -Omega * 25.0, 1e-13);  // clockwise
}

TEST(MFrame, DiscAtRestInItKeepsItsPosition) {
    // Two moments of a disc that is at rest in the rotating frame.
    for (const double u : {0.1, 0.6}) {
        Snapshot s = empty_container(u);
        const MFrame f = m_frame(s);
        add_disc(s, f.lab_position({2.0, -3.0}), f.lab_velocity({2.0, -3.0}, {0.0, 0.0}));
        const Snapshot later = [&] {
            Snapshot t = empty_container(u + 1e-7);
            add_disc(t, s.position(0) + (1e-7 * paper_period) * s.velocity(0), s.velocity(0));
            return t;
        }();
        const Vec2 p = m_frame(later).position(later.position(0));
        EXPECT_NEAR(p.x, 2.0, 1e-11);  // second order in the step: (Ω dt)² × distance
        EXPECT_NEAR(p.y, -3.0, 1e-11);
    }
}

TEST(MFrame, RotationIsThatInTheLabMinusOmega) {
    for (int k = 0; k < 20; ++k) {
        Snapshot s = random_discs(30, 7 + k, k / 20.0);
        Noise noise(k);
        for (std::size_t i = 0; i < s.size(); ++i) s.mass[i] = 2.0 + noise();
        s.container_velocity = {noise(), noise()};  // any path
        const RotationSample lab = cluster_rotation(s);
        const RotationSample there = cluster_rotation(seen_from(m_frame(s), s));
        EXPECT_NEAR(there.individual, lab.individual - Omega, 1e-12);
        EXPECT_NEAR(there.rigid, lab.rigid - Omega, 1e-14);
    }
}

TEST(MFrame, AStillContainerTurnsWithTheClock) {
    Snapshot s = empty_container(0.0);
    s.container_centre = s.container_velocity = {0.0, 0.0};
    s.clock = 0.25 * s.period;
    EXPECT_NEAR(m_frame(s).down.x, 0.0, 1e-15);
    EXPECT_NEAR(m_frame(s).down.y, 1.0, 1e-15);
}

TEST(MFrameView, EqualsTheFrameDiscByDisc) {
    const Snapshot s = held_earlier(random_discs(13, 3, 0.4));
    const MFrame f = m_frame(s);
    const MFrameView view(s);
    ASSERT_EQ(view.size(), s.size());
    const Snapshot there = seen_from(f, s);
    const CentreOfMass centre = view.centre_of_mass();
    double mean = 0.0;
    for (std::size_t i = 0; i < s.size(); ++i) {
        EXPECT_NEAR(view.x[i], there.x[i], 1e-14);
        EXPECT_NEAR(view.y[i], there.y[i], 1e-14);
        EXPECT_NEAR(view.velocity(i).x, there.vx[i], 1e-14);
        EXPECT_NEAR(view.velocity(i).y, there.vy[i], 1e-14);
        mean += centre.varpi(view.position(i), view.relative_velocity(i)) /
                static_cast<double>(s.size());
    }
    EXPECT_NEAR(mean, cluster_rotation(s).individual, 1e-12);
}

TEST(MFrameView, WorksWithoutDiscsAndForOneDisc) {
    Snapshot s = empty_container();
    EXPECT_EQ(MFrameView(s).size(), 0u);
    add_disc(s, {1.0, 2.0}, {0.0, 0.0});
    const MFrameView view(s);
    EXPECT_TRUE(
        std::isnan(view.centre_of_mass().varpi(view.position(0), view.relative_velocity(0))));
}

TEST(MFrameView, TheCentreOfMassIsWeightedWithTheMasses) {
    Snapshot s = empty_container(0.4);
    const MFrame f = m_frame(s);
    const auto add = [&](const Vec2& place, const Vec2& velocity, double mass) {
        add_disc(s, f.lab_position(place), s.container_velocity + f.rotate_back(velocity), 0.0, 1.0,
                 mass);
    };
    add({1.0, 0.0}, {0.5, -1.0}, 1.0);
    add({5.0, 4.0}, {2.5, 3.0}, 3.0);
    const CentreOfMass centre = MFrameView(s).centre_of_mass();
    EXPECT_NEAR(centre.position.x, 4.0, 1e-14);
    EXPECT_NEAR(centre.position.y, 3.0, 1e-14);
    EXPECT_NEAR(centre.velocity.x, 2.0, 1e-14);
    EXPECT_NEAR(centre.velocity.y, 2.0, 1e-14);
}

}  // namespace
}  // namespace swirl
