#include "swirl/engine/validate.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "swirl/engine/paper_scene.hpp"
#include "swirl/engine/simulation.hpp"
#include "swirl/math/random.hpp"

namespace swirl {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

TEST(Validate, AcceptsThePapersScene) {
    EXPECT_EQ(validate(paper_scene(48, 1.0, 1)), std::nullopt);
    InitialState circle = paper_scene(5, 1.0, 1);
    // Both paths start at (A, 0).
    circle.path = circular_path(paper_amplitude, paper_period);
    EXPECT_EQ(validate(circle), std::nullopt);
}

TEST(Validate, ReportsWhatIsWrong) {
    struct Case {
        const char* words;
        std::function<void(InitialState&)> spoil;
    };
    const Case cases[] = {
        {"no discs", [](InitialState& s) { s.discs.clear(); }},
        {"the period of the path is 0", [](InitialState& s) { s = InitialState{}; }},
        {"period of the path is nan", [](InitialState& s) { s.path.period = nan; }},
        {"no segments", [](InitialState& s) { s.path.segments.clear(); }},
        {"velocity.y of segment 2 of the path is nan",
         [](InitialState& s) { s.path.segments[2].velocity.y = nan; }},
        {"segment 3 of the path ends at", [](InitialState& s) { s.path.segments[3].end = 0.0; }},
        {"but the next one begins at", [](InitialState& s) { s.path.segments[4].begin -= 1e-3; }},
        {"but the period is", [](InitialState& s) { s.path.period *= 2.0; }},
        {"but the next one starts at", [](InitialState& s) { s.path.segments[7].start.x += 0.01; }},
        {"begins at the time", [](InitialState& s) { s.path.segments[0].begin = -1.0; }},
        {"is an arc",
         [](InitialState& s) {
             s.shape = Shape::sphere;
             s.path = circular_path(1.0, 1.0);
         }},
        {"radius of the container is -1", [](InitialState& s) { s.container_radius = -1.0; }},
        {"mu of the discs is -0.1", [](InitialState& s) { s.disc_surface.mu = -0.1; }},
        {"restitution of the wall is 1.5",
         [](InitialState& s) { s.wall_surface.restitution = 1.5; }},
        {"the deceleration by the floor is nan",
         [](InitialState& s) { s.floor.deceleration = nan; }},
        {"velocity.x of disc 3 is nan", [](InitialState& s) { s.discs[3].velocity.x = nan; }},
        {"inertia of disc 4 is 0", [](InitialState& s) { s.discs[4].inertia = 0.0; }},
        {"can_spin of disc 4 is 0.5", [](InitialState& s) { s.discs[4].can_spin = 0.5; }},
        {"disc 4 has the spin 2, but it cannot spin",
         [](InitialState& s) { s.discs[4].can_spin = 0.0, s.discs[4].spin = 2.0; }},
        {"radius of disc 0 is nan", [](InitialState& s) { s.discs[0].radius = nan; }},
        {"beyond the container", [](InitialState& s) { s.discs[1].position.x += 20.0; }},
        {"discs 1 and 2 overlap",
         [](InitialState& s) {
             s.discs[2].position = s.discs[1].position + Vec2{0.5, 0.5};
         }},
    };
    for (const Case& wrong : cases) {
        InitialState scene = paper_scene(28, 1.0, 1);
        wrong.spoil(scene);
        const auto problem = validate(scene);
        ASSERT_TRUE(problem) << wrong.words;
        EXPECT_NE(problem->find(wrong.words), std::string::npos) << *problem;
    }
}

TEST(Validate, FindsAnOverlapIfAndOnlyIfAllPairsDo) {
    Random random(3);
    int with = 0;
    for (int k = 0; k < 400; ++k) {
        InitialState scene{};
        scene.container_radius = 30.0;
        for (int i = 0; i < 12; ++i) {
            Disc disc{};
            disc.radius = 0.2 + 2.8 * random.uniform();
            disc.position = random.in_disc(26.0);
            scene.discs.push_back(disc);
        }
        bool overlaps = false;
        for (std::size_t i = 0; i < scene.discs.size(); ++i)
            for (std::size_t j = 0; j < i; ++j) {
                const Disc &a = scene.discs[i], &b = scene.discs[j];
                const Vec2 apart = a.position - b.position;
                overlaps |= std::hypot(apart.x, apart.y) < a.radius + b.radius;
            }
        with += overlaps;
        EXPECT_EQ(overlap_in(scene, {0.0, 0.0}, 0.0).has_value(), overlaps) << k;
    }
    // Both kinds of scene occur.
    EXPECT_GT(with, 50);
    EXPECT_LT(with, 350);
}

TEST(ValidateDeathTest, ASimulationOfAnInvalidSceneStopsWithTheReason) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    InitialState scene = paper_scene(28, 1.0, 1);
    scene.discs[2].position = scene.discs[1].position;
    EXPECT_DEATH(Simulation{scene}, "swirl::Simulation: discs 1 and 2 overlap");
    EXPECT_DEATH(Simulation{InitialState{}}, "swirl::Simulation: the period of the path is 0");
    // A state that continues has discs at their own times, but no NaN.
    scene.discs[2].position.x = nan;
    Progress progress;
    progress.periods = 1;
    EXPECT_DEATH((Simulation{scene, progress}), "position.x of disc 2 is nan");
}

}  // namespace
}  // namespace swirl
