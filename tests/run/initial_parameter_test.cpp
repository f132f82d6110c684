// --initial: a run from the user's own state.
#include "swirl/run/initial_parameter.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "run/rejected_parameters.hpp"
#include "swirl/run/json.hpp"
#include "swirl/run/parameter_readers.hpp"
#include "swirl/run/run.hpp"

namespace swirl {
namespace {

std::string states_text(const InitialState& scene) {
    RunConfig config;
    for (const Disc& d : scene.discs) config.initial.push_back({d.position, d.velocity, d.spin});
    return std::get<std::string>(write_initial(config));
}

// The text has all digits, so the run of a random state repeats from its text, with any seed.
TEST(InitialParameter, ARunFromTheStatesOfAnotherRunIsThatRun) {
    for (ParameterTexts given :
         {ParameterTexts{{"discs", "12"}, {"speed", "2"}, {"mixture", "25%:1.2"}},
          ParameterTexts{{"discs", "5"}, {"ramp", "amplitude=0.5:1@1..3"}, {"path_phase", "90"}}}) {
        given["periods"] = "5";
        const RunConfig config = resolve(given);
        given.erase("discs");
        given["initial"] = states_text(make_initial_state(config));
        given["seed"] = "77";
        const RunConfig given_states = resolve(given);
        for (const RunConfig& same :
             {given_states, resolve(parameters_in(config_text(given_states)))})
            EXPECT_EQ(run(same).state_hash, run(config).state_hash);
    }
}

TEST(InitialParameter, HostileStatesAreRejected) {
    const auto says = [](const std::string& states, const char* message, ParameterTexts more = {}) {
        more["initial"] = "states " + states;
        EXPECT_THAT(error_of(more), testing::HasSubstr(message));
    };
    says("", "has no discs");
    says("1:2:3:4", "disc 0 of --initial is '1:2:3:4'");
    says("2:0:0:0:0 0:0:nan:0:0", "disc 1 of --initial");
    says("2:0:1e16:0:0", "vx of disc 0 is 1e+16");
    says("2:0:0:0:0 2:1:0:0:0", "discs 0 and 1 overlap");
    says("2:0:0:0:0 20:1:0:0:0", "disc 1 at (20, 1) extends");
    // The speed changes the amplitude, and so the position of the container.
    says("11:0:0:0:0", "extends 1.51 beyond the container");
    EXPECT_EQ(error_of({{"initial", "states 11:0:0:0:0"}, {"speed", "2"}, {"period", "11.866"}}),
              "");
    says("2:0:0:0:0", "has 1 disc, but the other options give 2", {{"discs", "2"}});
    says("2:0:0:0:0", "--sizes lists 2 particles", {{"sizes", "list 1 1"}});
    says("2:0:0:0:0", "only for discs without a floor", {{"body", "sphere"}});
    says("2:0:0:0:0", "only for discs without a floor", {{"floor", "sliding"}});
}

}  // namespace
}  // namespace swirl
