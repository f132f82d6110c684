// Contact laws of one's own (own_law.hpp): the loops compiled with a law equal the reference, the
// law of constants equals the built-in loops, and a disc between two walls follows a closed form.
#include "swirl/engine/own_law.hpp"

#include <gtest/gtest.h>

#include <deque>

#include "engine/same_trajectory.hpp"
#include "engine/scenes.hpp"
#include "swirl/engine/partial_friction.hpp"
#include "swirl/engine/validate.hpp"

namespace swirl {
namespace {

/// One type for all laws of this file, because each type compiles event loops.
struct TestedLaw {
    enum class Kind { constants, softening, of_everything, gaining };
    Kind kind = Kind::constants;
    double a = 0.0;

    Surface operator()(Surface surface, const Impact& impact) const {
        if (kind == Kind::softening) surface.restitution = 1.0 / (1.0 + a * impact.speed);
        if (kind == Kind::gaining) surface.restitution = 1.5;
        return kind == Kind::of_everything ? of_everything(impact) : surface;
    }

  private:
    /// Uses all that a law may depend on.
    static Surface of_everything(const Impact& impact) {
        const double distance = square_root(dot(impact.from_centre_i, impact.from_centre_i) +
                                            dot(impact.from_centre_j, impact.from_centre_j));
        return {.mu = (0.2 + impact.slip) / (1.0 + impact.slip),
                .restitution = 1.0 / (1.0 + 0.1 * impact.speed * impact.effective_mass),
                .tangential_restitution = impact.is_with_wall ? 0.1 : 0.3,
                .contact_duration = 1e-3 * (impact.radius_i + impact.radius_j) * distance /
                                    impact.container_radius};
    }
};
constexpr TestedLaw constants{};
constexpr TestedLaw of_everything{.kind = TestedLaw::Kind::of_everything};
constexpr TestedLaw gaining{.kind = TestedLaw::Kind::gaining};
/// e = 1/(1 + a u).
constexpr TestedLaw softening(double a) { return {.kind = TestedLaw::Kind::softening, .a = a}; }

static_assert(ContactLaw<TestedLaw>);
static_assert(ContactLaw<decltype([](const Surface& s, const Impact&) { return s; })>);
static_assert(!ContactLaw<decltype([](const Surface& s) { return s; })>);
static_assert(!ContactLaw<decltype([](const Surface&, const Impact& i) { return i.speed; })>);

InitialState with_law(InitialState scene, const TestedLaw& law) {
    scene.law = own_law(law);
    return scene;
}

std::vector<InitialState> scenes() {
    InitialState dissipative = paper_container(48);
    dissipative.disc_surface = {.mu = 0.5, .restitution = 0.9, .contact_duration = 1e-3};
    return {paper_container(5),     dissipative,
            mixture_container(),    with_held_spins(paper_container(28), 3),
            gas_at_rest(200, 0.05), sphere_container(20),
            sphere_mixture(),       coin_container(20)};
}

TEST(OwnLaw, OfConstantsGivesTheBuiltInTrajectory) {
    for (const InitialState& scene : scenes()) {
        Simulation built_in(scene), own(with_law(scene, constants));
        built_in.run(3000);
        own.run(3000);
        EXPECT_EQ(own.state_hash(), built_in.state_hash());
        EXPECT_EQ(own.events().elastic_by_tc, built_in.events().elastic_by_tc);
    }
}

TEST(OwnLaw, EqualsTheReference) {
    for (const InitialState& scene : scenes()) {
        expect_same_trajectory(with_law(scene, softening(0.5)), 1500, tuning());
        expect_same_trajectory(with_law(scene, of_everything), 1500, tuning());
    }
}

// With e = 1/(1 + a u), the inverse speed grows by a with each collision.
TEST(OwnLaw, ADiscBetweenTwoWallsFollowsTheClosedForm) {
    InitialState scene = gas_at_rest(1, 0.01);
    scene.discs[0].position = {0.0, 0.0};
    scene.discs[0].velocity = {1.0, 0.0};
    Simulation simulation(with_law(scene, softening(0.25)));
    for (int bounces = 1; bounces <= 20;) {
        if (simulation.step().kind != EventKind::disc_wall) continue;
        // Each bounce rounds the speed a few times.
        EXPECT_NEAR(std::abs(simulation.disc(0).velocity.x), 1.0 / (1.0 + 0.25 * bounces), 1e-14);
        ++bounces;
    }
}

TEST(OwnLaw, StaysWithASimulationThatIsContinued) {
    const InitialState scene = with_law(paper_container(28), softening(0.5));
    expect_bitwise_identical_after_resuming(scene, 3000, 1000);
    Simulation whole(scene), changed(scene);
    whole.advance_to(2, 0.0);
    changed.advance_to(1, 0.0);
    changed.change_surroundings(scene);
    changed.advance_to(2, 0.0);
    EXPECT_EQ(whole.state_hash(), changed.state_hash());
}

TEST(OwnLaw, ForDiscsOnlyIsRejectedForSpheres) {
    InitialState discs = paper_container(5), spheres = sphere_container(5);
    discs.law = spheres.law = without_friction_in(Frictionless::bulk);
    EXPECT_EQ(validate(discs), std::nullopt);
    EXPECT_EQ(validate(spheres),
              "the contact law is for discs only, but the bodies are spheres or coins.");
}

// The loop checks the coefficients that the law has returned.
TEST(OwnLaw, ThatGainsEnergyViolatesTheInvariant) {
    if (!internal_checks) GTEST_SKIP() << "this build does not check the invariants";
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    EXPECT_DEATH(Simulation(with_law(paper_container(28), gaining)).run(1000),
                 "energy_never_grows");
}

}  // namespace
}  // namespace swirl
