// The fuzzers of tests/fuzz start from files in tests/fuzz/seeds. A file that the program rejects
// at once, because its format has changed, reaches only the first lines of a reader. So each file
// must still be accepted. After a change of a format,
//
//     SWIRL_WRITE_SEEDS=1 build/tests/tests/test_study --gtest_filter='FuzzSeeds.*'
//
// writes the checkpoint and the result again.
#include <gtest/gtest.h>

#include <cstdlib>

#include "io/scratch.hpp"
#include "swirl/io/atomic_file.hpp"
#include "swirl/run/json.hpp"
#include "swirl/run/recorded_run.hpp"
#include "swirl/study/collected_sweep.hpp"
#include "swirl/study/sweep.hpp"

namespace swirl {
namespace {

namespace fs = std::filesystem;

fs::path seed(const std::string& name) {
    return fs::path(SWIRL_SOURCE_DIR) / "tests/fuzz/seeds" / name;
}
bool writes_seeds() { return std::getenv("SWIRL_WRITE_SEEDS") != nullptr; }

RunConfig config_of_checkpoint(const fs::path& checkpoint) {
    return resolve(parameters_in(call_in_checkpoint(checkpoint).configuration));
}

// The continued run ends in the state of an uninterrupted one.
TEST(FuzzSeeds, TheCheckpointContinues) {
    const Scratch scratch;
    RunFiles files;
    files.checkpoint = scratch / "checkpoint";
    if (writes_seeds()) {
        files.checkpoint_every = 0.0;  // the last one is written after 256 of the events
        run_recorded(resolve({{"discs", "4"}, {"events", "300"}, {"warmup", "1"}}), files, {}, {});
        fs::copy_file(files.checkpoint, seed("checkpoint/four_discs"),
                      fs::copy_options::overwrite_existing);
    }
    fs::copy_file(seed("checkpoint/four_discs"), files.checkpoint,
                  fs::copy_options::overwrite_existing);
    const RunConfig config = config_of_checkpoint(files.checkpoint);
    files.resume = true;
    const RunResult continued = run_recorded(config, files, {}, {}), whole = run(config);
    EXPECT_TRUE(continued.complete);
    EXPECT_EQ(continued.state_hash, whole.state_hash);
}

// The seeds of the plan and of its result belong together.
TEST(FuzzSeeds, ThePlanAndItsResultAreAccepted) {
    const Scratch scratch;
    fs::copy_file(seed("plan/one.json"), scratch / "plan.json");
    const SweepPlan plan = read_plan(scratch.folder());
    if (writes_seeds()) {
        write_plan(scratch.folder(), plan, nullptr);
        run_sweep(scratch.folder(), plan, {}, {});
        fs::copy_file(scratch / "results/000000.json", seed("result/one.json"),
                      fs::copy_options::overwrite_existing);
    }
    fs::create_directories(scratch / "results");
    fs::copy_file(seed("result/one.json"), scratch / "results/000000.json",
                  fs::copy_options::overwrite_existing);
    EXPECT_EQ(collect_sweep(scratch.folder(), plan).rows.size(), 1u);
}

TEST(FuzzSeeds, TheParametersAreAccepted) {
    for (const char* name : {"disc", "mixture"}) {
        const std::string file = std::string("parameters/") + name + ".json";
        EXPECT_NO_THROW(resolve(parameters_in(read_whole_file(seed(file))))) << name;
    }
}

}  // namespace
}  // namespace swirl
